// SPDX-License-Identifier: MIT
#pragma once

// A ray caster of the user's, which a renderer has anyhow, answers the rays of a bake. It knows the caller's triangles and nothing else:
//
//     struct MyCaster {
//       std::uint32_t blocked16(const radiosity::RayPacket& rays) const;                   // bit i: ray i meets a triangle in (near, far)
//       std::optional<radiosity::TriangleHit> closest(const radiosity::CasterRay&) const;  // the first one that it meets in (near, far)
//     };
//     options.rays = my_caster;    // BakeOptions; the caster must outlive the bake
//
// Rays lie in the coordinates of the mesh. Both functions are called from many threads at once. Which side of a triangle is met does not
// matter.
//
// A caster in single precision has the triangle on which a ray begins or ends a little off its true place, and would find that triangle
// itself. So rays begin and end a skin above the surfaces on which they stand: what stands closer to a surface than that is not seen from
// it. The skin is `precision` of the largest coordinate, plus what the intake may have moved a vertex by.
//
// No ray is cast, by anyone, where nothing can stand in between (Options::shortcuts), for the exact shadows of lamps, and where surfaces
// coincide: there the polygons themselves decide. So a caster should stop rays at all triangles, and at nothing else.

#include <concepts>
#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/frame.hpp>

namespace radiosity {

// Its points are origin + t direction, near < t < far. The direction is not normalised.
struct CasterRay {
  glm::dvec3 origin{0.0}, direction{0.0};
  double near = 0.0, far = 0.0;
};

// Sixteen of them; lanes without a bit take no part.
struct alignas(64) RayPacket {
  double origin[3][16] = {}, direction[3][16] = {}, near[16] = {}, far[16] = {};
  std::uint32_t lanes = 0;

  [[nodiscard]] CasterRay at(unsigned i) const {
    return {{origin[0][i], origin[1][i], origin[2][i]}, {direction[0][i], direction[1][i], direction[2][i]}, near[i], far[i]};
  }
};

struct TriangleHit {
  double t = 0.0;
  std::uint32_t triangle = 0;  // its number in the mesh; of a PolygonView that of the polygon
};

template <class Caster>
concept RayCaster = requires(const Caster& caster, const RayPacket& packet, const CasterRay& ray) {
  { caster.blocked16(packet) } -> std::convertible_to<std::uint32_t>;
  { caster.closest(ray) } -> std::convertible_to<std::optional<TriangleHit>>;
};

// Any of them, by reference.
class AnyRayCaster {
 public:
  AnyRayCaster() = default;
  // `precision`: of a point where it says that a ray meets a triangle, relative to the largest coordinate.
  template <RayCaster Caster>
  AnyRayCaster(const Caster& caster, double precision = 1e-6)  // implicit, as references are
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

// The caster as the solver asks it: rays of the frame become rays of the mesh, triangles become sheets of objects. `caster` and `parts`, of
// the intake that made the objects, and these must outlive what this makes. `skin`: a length of the mesh.
[[nodiscard]] raycast::OtherCaster caster_of(const AnyRayCaster& caster, const PolygonParts& parts, double skin,
                                             const raycast::Scene& objects, const Frame& frame);

// How far from a surface rays begin and end: see above. `weld` of the intake.
[[nodiscard]] double skin_of(const AnyRayCaster& caster, const PolygonView& mesh, double weld);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/bake/own_rays.cpp>
#endif
