// SPDX-License-Identifier: MIT
#include <radiosity/bake/own_rays.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/tolerances.hpp>

namespace radiosity {

namespace baking::detail {

// A sheet that shows the hit triangle, and the parameter at which the ray meets the sheet's plane.
struct FoundSheet {
  double t = 0.0;
  bool front = false;
  PolygonPart part;
};

class CasterAdapter {
 public:
  CasterAdapter(const AnyRayCaster& caster, const PolygonParts& parts, double skin, const raycast::Scene& objects, const Frame& frame)
      : caster_{caster}, parts_{parts}, objects_{objects}, skin_{skin * frame.scale}, frame_{frame} {
    for (std::uint32_t o = 0; o < objects.size(); ++o) {
      first_plane_.push_back(planes_.size());
      const raycast::Box box = objects.object(o).bounds();
      // All sheets are flat, because they come from polygons.
      for (std::uint32_t sheet = 0; sheet < objects.object(o).sheet_count(); ++sheet) {
        const raycast::SurfacePoint at = objects.object(o).project(sheet, 0.5 * (box.lo + box.hi));
        planes_.push_back({at.position, at.normal});
      }
    }
  }

  [[nodiscard]] std::uint32_t occluded16(const raycast::Segments16& segments) const {
    RayPacket packet;
    for (std::uint32_t rest = segments.lanes; rest != 0; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      const raycast::Segment segment = segments.at(i);
      const double near = cut(segment, segments.source[i], segments.source_sheet[i]);
      const double far = 1.0 - cut(segment, segments.target[i], segments.target_sheet[i]);
      if (near < far) { set(packet, i, segment, near, far); }
    }
    return packet.lanes != 0 ? caster_.blocked16(packet) & packet.lanes : 0;
  }

  [[nodiscard]] std::uint32_t closest16(const raycast::Segments16& rays, raycast::Hits16& hits) const {
    std::uint32_t open = 0;
    for (std::uint32_t rest = rays.lanes; rest != 0; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      const raycast::Segment segment = rays.at(i);
      if (!raycast::has_line(segment)) { continue; }
      const CasterRay ray{frame_.to_scene(segment.origin), segment.direction / frame_.scale,
                          cut(segment, rays.source[i], rays.source_sheet[i]), raycast::infinity};
      const std::optional<TriangleHit> hit = caster_.closest(ray);
      if (!hit) { continue; }
      const std::optional<FoundSheet> found = sheet_at(segment, *hit);
      if (!found) {
        open |= 1u << i;
        continue;
      }
      hits.hit[i] = {found->t, found->part.object, found->part.sheet, found->front};
      hits.met |= 1u << i;
    }
    return open;
  }

 private:
  struct SheetPlane {
    glm::dvec3 point{0.0}, normal{0.0};
  };

  void set(RayPacket& packet, unsigned i, const raycast::Segment& segment, double near, double far) const {
    const glm::dvec3 origin = frame_.to_scene(segment.origin), direction = segment.direction / frame_.scale;
    for (int k = 0; k < 3; ++k) {
      packet.origin[k][i] = origin[k];
      packet.direction[k][i] = direction[k];
    }
    packet.near[i] = near;
    packet.far[i] = far;
    packet.lanes |= 1u << i;
  }

  // The parameter length to cut off at this end of the segment, so that it begins a skin above the sheet on which it ends.
  [[nodiscard]] double cut(const raycast::Segment& segment, std::uint32_t owner, std::uint32_t sheet) const {
    if (owner == raycast::no_object) { return 0.0; }
    if (sheet == raycast::unknown_sheet) { return skin_ / glm::length(segment.direction); }
    return skin_ / std::abs(glm::dot(planes_[first_plane_[owner] + sheet].normal, segment.direction));
  }

  // Among the sheets that contain a part of the triangle, prefers one that faces the ray; among those, the one nearest to the hit.
  // Nothing if the triangle was left out.
  [[nodiscard]] std::optional<FoundSheet> sheet_at(const raycast::Segment& segment, const TriangleHit& hit) const {
    std::optional<FoundSheet> best;
    if (hit.triangle + 1 >= parts_.first.size()) { return best; }
    for (const PolygonPart& part : parts_.of(hit.triangle)) {
      const SheetPlane& plane = planes_[first_plane_[part.object] + part.sheet];
      const double step = glm::dot(plane.normal, segment.direction);
      const double t = glm::dot(plane.normal, plane.point - segment.origin) / step;
      const FoundSheet found{t, step < 0.0, part};
      if (!(t > 0.0 && t < raycast::infinity)) { continue; }
      const auto gap = [&](const FoundSheet& to) {
        const glm::dvec3 place = segment.at(hit.t);
        return glm::length(objects_.object(to.part.object).project(to.part.sheet, place).position - place);
      };
      if (!best || (found.front && !best->front) || (found.front == best->front && gap(found) < gap(*best))) { best = found; }
    }
    return best;
  }

  const AnyRayCaster& caster_;
  const PolygonParts& parts_;
  const raycast::Scene& objects_;
  double skin_;  // length in the frame
  Frame frame_;
  std::vector<SheetPlane> planes_;  // of the sheets of all objects
  std::vector<std::size_t> first_plane_;
};

}  // namespace baking::detail

HALFLIGHT_INLINE raycast::OtherCaster caster_of(const AnyRayCaster& caster, const PolygonParts& parts, double skin,
                                                const raycast::Scene& objects, const Frame& frame) {
  const auto adapter = std::make_shared<const baking::detail::CasterAdapter>(caster, parts, skin, objects, frame);
  return {[adapter](const raycast::Segments16& segments) { return adapter->occluded16(segments); },
          [adapter](const raycast::Segments16& rays, raycast::Hits16& hits) { return adapter->closest16(rays, hits); }};
}

HALFLIGHT_INLINE double skin_of(const AnyRayCaster& caster, const PolygonView& mesh, double weld) {
  raycast::Box box;
  for (const std::uint32_t c : mesh.corners) {
    if (c < mesh.positions.size() && raycast::usable(mesh.positions[c])) { box.extend(mesh.positions[c]); }
  }
  return 2.0 * weld * box.diameter() + caster.precision() * box.magnitude();
}

}  // namespace radiosity
