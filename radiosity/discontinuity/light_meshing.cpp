// SPDX-License-Identifier: MIT
#include <radiosity/discontinuity/light_meshing.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/split_plane.hpp>

#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/discontinuity/direct_variation.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/polygon_shaft.hpp>

namespace radiosity {

namespace detail {

// Distances to a face below this count as contact, in a scene of size 1 to 2.
inline constexpr double tol_touch = 1e-9;
// Lines closer together than this, relative to the face, are joined, because the part between them would be a sliver.
inline constexpr double tol_line = 1e-3;
// A line that covers less than this share of its chord through a patch does not cut it: most of the cut would not be a shadow edge.
inline constexpr double least_share_of_chord = 0.3;

// The share of the chord of a convex polygon along this line that the line itself covers; 0 if it only touches the polygon.
[[nodiscard]] HALFLIGHT_INLINE double share_of_chord(const Polygon& polygon, const glm::dvec3& normal, const CriticalLine& line) {
  const double length = glm::length(line.to - line.from);
  const glm::dvec3 along = (line.to - line.from) / length;
  const glm::dvec3 across = glm::cross(normal, along);
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i] - line.from;
    const glm::dvec3 b = polygon[i + 1 < polygon.size() ? i + 1 : 0] - line.from;
    const double ya = glm::dot(across, a);
    const double yb = glm::dot(across, b);
    if ((ya > 0.0) == (yb > 0.0)) { continue; }
    const double x = glm::dot(along, a + ya / (ya - yb) * (b - a));
    from = std::min(from, x);
    to = std::max(to, x);
  }
  return to > from ? std::max(0.0, std::min(to, length) - std::max(from, 0.0)) / (to - from) : 0.0;
}

// Does the line come within this distance of the point? A quick test, as most lines of a face do not pass near a given patch.
[[nodiscard]] HALFLIGHT_INLINE bool comes_near(const CriticalLine& line, const glm::dvec3& point, double square_of_radius) {
  const glm::dvec3 along = line.to - line.from, d = point - line.from, across = glm::cross(along, d);
  return glm::dot(across, across) <= square_of_radius * glm::dot(along, along);
}

[[nodiscard]] HALFLIGHT_INLINE std::optional<ReceivingFace> receiving_face(const Surface& surface, brep::FaceId f) {
  if (surface.brep.data(f).sheet == brep::no_sheet) { return std::nullopt; }
  ReceivingFace face{corner_polygon(surface.brep, f), {}};
  const glm::dvec3 area = vector_area(face.contour);
  if (!(glm::length(area) > 0.0)) { return std::nullopt; }
  face.normal = glm::normalize(area);
  return face;
}

}  // namespace detail

HALFLIGHT_INLINE LightMeshing::LightMeshing(const raycast::Scene& objects, const std::vector<Surface>& surfaces,
                                            const std::vector<Color>& reflectance, const std::vector<Color>& emission,
                                            std::uint32_t most_edges)
    : light_{objects, surfaces, emission}, reflectance_{reflectance}, object_of_(emission.size(), 0), most_edges_{most_edges} {
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) { object_of_[surfaces[o].first_surface] = o; }
  find_lines(surfaces);
}

HALFLIGHT_INLINE void LightMeshing::find_lines(const std::vector<Surface>& surfaces) {
  std::vector<Facets> bodies;
  for (const Surface& surface : surfaces) { bodies.push_back(surface.object->exact() ? facets_of(surface) : Facets{}); }
  constexpr std::uint64_t most_pairs = 20'000'000;
  std::uint64_t pairs = 0;
  for (const Surface& surface : surfaces) {
    if (!surface.object->flat()) { continue; }
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      const std::optional<ReceivingFace> face = detail::receiving_face(surface, f);
      if (!face || is_black(reflectance_[surface.first_surface + surface.brep.data(f).sheet])) { continue; }
      pairs += bodies.size() * (1 + light_.lamps().size());
      if (pairs > most_pairs) {
        ++not_looked_at_;
        continue;
      }
      std::vector<CriticalLine> lines;
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (&surfaces[b] != &surface && !bodies[b].empty()) { add_contact_lines(*face, bodies[b], detail::tol_touch, lines); }
      }
      for (const DirectLight::Lamp& lamp : light_.lamps()) {
        const auto above = [&](const glm::dvec3& p) { return face->height(p) > detail::tol_touch; };
        if (!lamp.flat || std::none_of(lamp.corners.begin(), lamp.corners.end(), above)) { continue; }
        const Shaft shaft{face->contour, lamp.corners, detail::tol_touch};
        for (std::size_t b = 0; b < bodies.size(); ++b) {
          if (bodies[b].empty() || shaft.misses(surfaces[b].object->bounds())) { continue; }
          add_critical_lines(*face, lamp.facets, bodies[b], detail::tol_touch, lines);
        }
      }
      double size = 0.0;
      for (const glm::dvec3& p : face->contour) { size = std::max(size, glm::length(p - face->contour[0])); }
      join_lines(lines, detail::tol_line * size);
      if (!lines.empty()) { faces_[key(surface, f)].lines = std::move(lines); }
    }
  }
}

HALFLIGHT_INLINE LightMeshing::FaceKey LightMeshing::key(const Surface& surface, brep::FaceId face) const {
  return {object_of_[surface.first_surface], surface.brep.data(face).part};
}

HALFLIGHT_INLINE DirectVariation LightMeshing::look_at(const Surface& surface, brep::FaceId face, const Patch& patch) const {
  const std::uint32_t sheet = surface.brep.data(face).sheet;
  LitRegion region{light_, {patch.contour, object_of_[surface.first_surface], 0.0, sheet}, patch.normal};
  std::vector<CriticalLine> crossing;
  if (const auto found = faces_.find(key(surface, face)); found != faces_.end()) {
    double square = 0.0;  // squared radius of the patch
    for (const glm::dvec3& p : patch.contour) { square = std::max(square, glm::dot(p - patch.centroid, p - patch.centroid)); }
    for (const CriticalLine& line : found->second.lines) {
      if (!detail::comes_near(line, patch.centroid, square)) { continue; }
      if (detail::share_of_chord(patch.contour, patch.normal, line) >= detail::least_share_of_chord) { crossing.push_back(line); }
    }
  }
  return direct_variation(region, patch, reflectance_[surface.first_surface + sheet], crossing);
}

HALFLIGHT_INLINE void LightMeshing::measure(const std::vector<std::uint32_t>& nodes, const Hierarchy& hierarchy, const Patches& patches,
                                            const std::vector<Surface>& surfaces, unsigned threads) {
  measured_.resize(hierarchy.size());
  const auto look = [&](std::size_t k) {
    std::uint32_t leaf = nodes[k];
    while (!hierarchy[leaf].leaf()) { leaf = hierarchy[leaf].first_child; }
    measured_[nodes[k]] = {true, look_at(surfaces[hierarchy[leaf].object], hierarchy[leaf].face, patches[nodes[k]])};
  };
  parallel_for(nodes.size(), threads, look, 4);
}

HALFLIGHT_INLINE std::optional<double> LightMeshing::seen_share(const Hierarchy& hierarchy, std::uint32_t lamp, std::uint32_t node) const {
  if (!is_lamp(hierarchy[lamp]) || !is_input_face(hierarchy, lamp) || !measured(node)) { return std::nullopt; }
  const std::uint32_t surface = hierarchy[lamp].surface;
  const auto& lamps = light_.lamps();
  const auto whole = std::find_if(lamps.begin(), lamps.end(), [&](const DirectLight::Lamp& l) { return l.surface == surface; });
  if (!whole->flat || whole->facets.facets.size() != 1) { return std::nullopt; }
  if (hierarchy[lamp].area < (1.0 - 0x1p-20) * whole->facets.facets[0].area) { return std::nullopt; }  // the lamp was cut
  const std::vector<LampSeen>& seen = measured_[node].variation.seen;
  const auto found = std::find_if(seen.begin(), seen.end(), [&](const LampSeen& s) { return s.surface == surface; });
  return found != seen.end() ? std::optional{found->share} : std::nullopt;
}

HALFLIGHT_INLINE ChildFaces LightMeshing::split(const LeafFace& leaf) {
  const std::uint32_t node = leaf.surface.brep.data(leaf.face).node;
  if (leaf.surface.object->flat() && measured(node)) { return cut(leaf, measured_[node].variation); }
  return split_part(leaf);
}

HALFLIGHT_INLINE ChildFaces LightMeshing::split_part(const LeafFace& part) {
  if (!part.surface.object->flat()) { return RegularMeshing{}(part); }
  return cut(part, look_at(part.surface, part.face, make_patch(corner_polygon(part.surface.brep, part.face))));
}

HALFLIGHT_INLINE ChildFaces LightMeshing::cut(const LeafFace& leaf, const DirectVariation& light) {
  const auto cut_by = [&](const CutPlane& plane) { return CutBy{brep::AlongPlane{plane.point, plane.normal}}(leaf); };
  if (light.along) {
    FaceLines& face = faces_[key(leaf.surface, leaf.face)];
    face.limited = face.limited || face.edges >= most_edges_;
    ChildFaces parts = face.edges < most_edges_ ? cut_by(*light.along) : ChildFaces{};
    if (!parts.faces.empty()) {
      ++face.edges;
      return parts;
    }
  }
  return light.halves ? cut_by(*light.halves) : ChildFaces{};
}

HALFLIGHT_INLINE ImprintedEdges LightMeshing::imprinted() const {
  ImprintedEdges sum;
  for (const auto& [key, face] : faces_) {
    sum.edges += face.edges;
    sum.faces += face.edges > 0 ? 1 : 0;
    sum.limited += face.limited ? 1 : 0;
  }
  sum.not_looked_at = not_looked_at_;
  return sum;
}

}  // namespace radiosity
