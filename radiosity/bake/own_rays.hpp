// SPDX-License-Identifier: MIT
#pragma once

// Lets a ray caster of the caller, which a renderer has anyway, answer the rays of a bake. It needs to know the caller's triangles and
// nothing else:
//
//     struct MyCaster {
//       std::uint32_t blocked16(const radiosity::RayPacket& rays) const;                   // bit i: ray i meets a triangle in (near, far)
//       std::optional<radiosity::TriangleHit> closest(const radiosity::CasterRay&) const;  // the first one that it meets in (near, far)
//     };
//     options.rays = my_caster;    // BakeOptions; the caster must outlive the bake
//
// Rays are in the coordinates of the mesh. Both functions are called from many threads at once. Triangles count from both sides.
//
// A caster in single precision stores a triangle slightly off its true place, so a ray that begins or ends on it might hit that same
// triangle. So rays begin and end a small distance, the skin, above their surfaces; objects closer to a surface than that are not seen
// from it. The skin is `precision` times the largest coordinate plus the distance by which the intake may have moved a vertex.
//
// No ray is cast where nothing can stand in between (Options::shortcuts), for the exact shadows of lamps, and where surfaces coincide:
// these cases are computed from the polygons themselves. So the caster should report all triangles and nothing else.

#include <concepts>
#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/frame.hpp>

namespace radiosity {

// The points origin + t direction with near < t < far. The direction need not have length 1.
struct CasterRay {
  glm::dvec3 origin{0.0}, direction{0.0};
  double near = 0.0, far = 0.0;
};

// Sixteen rays; those whose bit in `lanes` is 0 take no part.
struct alignas(64) RayPacket {
  double origin[3][16] = {}, direction[3][16] = {}, near[16] = {}, far[16] = {};
  std::uint32_t lanes = 0;

  [[nodiscard]] CasterRay at(unsigned i) const {
    return {{origin[0][i], origin[1][i], origin[2][i]}, {direction[0][i], direction[1][i], direction[2][i]}, near[i], far[i]};
  }
};

struct TriangleHit {
  double t = 0.0;
  std::uint32_t triangle = 0;  // its index in the mesh; for a PolygonView, that of the polygon
};

template <class Caster>
concept RayCaster = requires(const Caster& caster, const RayPacket& packet, const CasterRay& ray) {
  { caster.blocked16(packet) } -> std::convertible_to<std::uint32_t>;
  { caster.closest(ray) } -> std::convertible_to<std::optional<TriangleHit>>;
};

// Refers to any ray caster; does not own it.
class AnyRayCaster {
 public:
  AnyRayCaster() = default;
  // `precision`: error of the caster's hit points, relative to the largest coordinate.
  template <RayCaster Caster>
  AnyRayCaster(const Caster& caster, double precision = 1e-6)  // implicit, like a reference
      : caster_{&caster},
        blocked16_{
            [](const void* own, const RayPacket& rays) -> std::uint32_t { return static_cast<const Caster*>(own)->blocked16(rays); }},
        closest_{[](const void* own, const CasterRay& ray) -> std::optional<TriangleHit> {
          return static_cast<const Caster*>(own)->closest(ray);
        }},
        precision_{precision} {}
  template <RayCaster Caster>
  AnyRayCaster(const Caster&& gone, double precision = 1e-6) = delete;

  [[nodiscard]] explicit operator bool() const { return caster_ != nullptr; }
  [[nodiscard]] std::uint32_t blocked16(const RayPacket& rays) const { return blocked16_(caster_, rays); }
  [[nodiscard]] std::optional<TriangleHit> closest(const CasterRay& ray) const { return closest_(caster_, ray); }
  [[nodiscard]] double precision() const { return precision_; }

 private:
  const void* caster_ = nullptr;
  std::uint32_t (*blocked16_)(const void*, const RayPacket&) = nullptr;
  std::optional<TriangleHit> (*closest_)(const void*, const CasterRay&) = nullptr;
  double precision_ = 1e-6;
};

// Adapts the caster to the interface of the solver: rays are converted from the frame to the mesh, triangles to sheets of objects.
// `caster`, `objects` and `parts` (from the intake that made the objects) must outlive the result. `skin`: a length in mesh coordinates.
[[nodiscard]] raycast::OtherCaster caster_of(const AnyRayCaster& caster, const PolygonParts& parts, double skin,
                                             const raycast::Scene& objects, const Frame& frame);

// Distance from a surface at which rays begin and end, see above. `weld`: the option of the intake.
[[nodiscard]] double skin_of(const AnyRayCaster& caster, const PolygonView& mesh, double weld);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/bake/own_rays.cpp>
#endif
