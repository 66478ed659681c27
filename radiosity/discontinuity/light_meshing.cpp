// SPDX-License-Identifier: MIT
#include <radiosity/discontinuity/light_meshing.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/split_plane.hpp>

#include <raycast/inline.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/facets.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/discontinuity/direct_variation.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/polygon_shaft.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE CriticalLines find_lines(const DirectLight& light, const std::vector<Surface>& surfaces, std::size_t limit) {
  CriticalLines lines;
  std::vector<Facets> bodies(surfaces.size());
  for (std::size_t o = 0; o < surfaces.size(); ++o) {
    if (surfaces[o].object->exact()) { bodies[o] = facets_of(surfaces[o]); }
  }
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    if (!surfaces[o].object->flat()) { continue; }
    for (const brep::FaceId f : brep::faces(surfaces[o].brep)) {
      if (surfaces[o].brep.data(f).sheet == brep::no_sheet) { continue; }
      ReceivingFace face{corner_polygon(surfaces[o].brep, f), {}};
      const glm::dvec3 area = vector_area(face.contour);
      if (!(glm::length(area) > 0.0)) { continue; }
      face.normal = glm::normalize(area);
      double size = 0.0;
      for (const glm::dvec3& p : face.contour) { size = std::max(size, glm::length(p - face.contour[0])); }
      const double tolerance = 1e-9;
      std::vector<CriticalLine>& on = lines.of[{o, surfaces[o].brep.data(f).part}];
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (b != o && !bodies[b].empty()) { add_contact_lines(face, bodies[b], tolerance, on); }
      }
      for (const DirectLight::Lamp& lamp : light.lamps()) {
        const bool reached = std::any_of(lamp.corners.begin(), lamp.corners.end(),
                                         [&](const glm::dvec3& p) { return face.height(p) > tolerance; });
        if (!lamp.flat || !reached) { continue; }
        const Shaft shaft{face.contour, lamp.corners, tolerance};
        for (std::size_t b = 0; b < bodies.size(); ++b) {
          if (bodies[b].empty() || shaft.misses(surfaces[b].object->bounds())) { continue; }
          add_critical_lines(face, lamp.facets, bodies[b], tolerance, on);
        }
      }
      join_lines(on, 1e-3 * size);
      if (on.size() > limit) {
        lines.left_out += on.size() - limit;
        on.resize(limit);
      }
    }
  }
  return lines;
}

// Of the chord of a convex polygon on the line, the share that the line itself covers; 0 where it only touches.
[[nodiscard]] HALFLIGHT_INLINE double share_of_chord(const Polygon& polygon, const glm::dvec3& normal, const CriticalLine& line) {
  const double length = glm::length(line.to - line.from);
  const glm::dvec3 along = (line.to - line.from) / length;
  const glm::dvec3 across = glm::cross(normal, along);
  double from = 1e300, to = -1e300, low = 0.0, high = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i] - line.from;
    const glm::dvec3 b = polygon[i + 1 < polygon.size() ? i + 1 : 0] - line.from;
    const double ya = glm::dot(across, a), yb = glm::dot(across, b);
    low = std::min(low, ya), high = std::max(high, ya);
    if ((ya > 0.0) == (yb > 0.0)) { continue; }
    const double x = glm::dot(along, a + ya / (ya - yb) * (b - a));
    from = std::min(from, x), to = std::max(to, x);
  }
  if (!(to > from) || !(low < 0.0) || !(high > 0.0)) { return 0.0; }
  return std::max(0.0, std::min(to, length) - std::max(from, 0.0)) / (to - from);
}

}  // namespace detail

HALFLIGHT_INLINE LightMeshing::LightMeshing(const raycast::Scene& objects, const std::vector<Surface>& surfaces,
                                            const std::vector<Color>& reflectance, const std::vector<Color>& emission, std::size_t limit)
    : light_{objects, surfaces, emission}, lines_{detail::find_lines(light_, surfaces, limit)}, reflectance_{reflectance}, object_of_(emission.size(), 0) {
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) { object_of_[surfaces[o].first_surface] = o; }
}

HALFLIGHT_INLINE bool LightMeshing::covers(const Node& lamp, const Node& receiver) const {
  return !lamp.is_cluster() && !receiver.is_cluster() && light_.is_lamp(lamp.surface) && receiver.deviation == 0.0 && receiver.area > 0.0;
}

HALFLIGHT_INLINE PatchVariation LightMeshing::look_at(const Surface& surface, brep::FaceId face, const Patch& patch) const {
  const std::uint32_t sheet = surface.brep.data(face).sheet;
  const std::uint32_t object = object_of_[surface.first_surface];
  LitRegion region{light_, {patch.contour, object, 0.0, sheet}, patch.normal};
  std::vector<CriticalLine> crossing;
  const auto found = lines_.of.find({object, surface.brep.data(face).part});
  if (found != lines_.of.end()) {
    for (const CriticalLine& line : found->second) {
      if (detail::share_of_chord(patch.contour, patch.normal, line) > 0.3) { crossing.push_back(line); }
    }
  }
  return patch_variation(region, patch, reflectance_[surface.first_surface + sheet], crossing);
}

HALFLIGHT_INLINE void LightMeshing::measure(const std::vector<std::uint32_t>& nodes, const Hierarchy& hierarchy, const Patches& patches,
                                            const std::vector<Surface>& surfaces, unsigned threads) {
  known_.resize(hierarchy.size(), false);
  measured_.resize(hierarchy.size());
  parallel_for(
      nodes.size(), threads,
      [&](std::size_t k) {
        std::uint32_t leaf = nodes[k];
        while (!hierarchy[leaf].leaf()) { leaf = hierarchy[leaf].first_child; }
        const Surface& surface = surfaces[hierarchy[leaf].object];
        measured_[nodes[k]] = look_at(surface, hierarchy[leaf].face, patches[nodes[k]]);
      },
      4);
  for (const std::uint32_t n : nodes) { known_[n] = true; }
}

HALFLIGHT_INLINE ChildFaces LightMeshing::split(const LeafFace& leaf) const {
  if (!leaf.surface.object->flat()) { return RegularMeshing{}(leaf); }
  const SurfaceFace& face = leaf.surface.brep.data(leaf.face);
  PatchVariation looked;
  if (measured(face.node)) {
    looked = measured_[face.node];
  } else {
    looked = look_at(leaf.surface, leaf.face, make_patch(corner_polygon(leaf.surface.brep, leaf.face)));
  }
  if (looked.cut.normal == glm::dvec3{0.0}) { return {}; }
  return CutBy{brep::AlongPlane{looked.cut.point, looked.cut.normal}}(leaf);
}

}  // namespace radiosity
