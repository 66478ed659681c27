// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/long_faces.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/split.hpp>
#include <brep/split_objects.hpp>
#include <brep/split_plane.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// longest_face: faces up to this proportion are left unchanged; longest_part: limit of the parts of longer ones. All leaves of a part have
// its proportion, and how fine they must be depends on their radius: of the rectangles with one radius those of 4 : 1 have 0.6 of the area
// of those of 2 : 1, so more of them are needed. With 4, a corridor of 1000 : 1 had a third more leaves, and an error of 6.4 % instead of
// 4.8 %.
inline constexpr double longest_face = 8.0, longest_part = 2.0;

// Faces with a smaller share of the total area are left unchanged, because refinement makes few patches of them.
inline constexpr double least_long_share = 0.01;

namespace detail {

// Do two consecutive edges lie on one straight line?
[[nodiscard]] HALFLIGHT_INLINE bool goes_straight_on(const glm::dvec3& before, const glm::dvec3& after) {
  constexpr double straight = 1e-9;  // sine of the angle
  return glm::dot(before, after) > 0.0 && glm::length(glm::cross(before, after)) <= straight * glm::length(before) * glm::length(after);
}

// Extent of a face along its longest side. A side may contain corners where a neighbour was cut.
struct FaceLength {
  glm::dvec3 along{0.0};  // unit
  glm::dvec3 middle{0.0};
  double length = 0.0, width = 0.0, area = 0.0;

  explicit FaceLength(const Polygon& polygon) {
    const std::size_t count = polygon.size();
    const auto edge = [&](std::size_t i) { return polygon[(i + 1) % count] - polygon[i % count]; };
    double longest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      if (goes_straight_on(edge(i + count - 1), edge(i))) { continue; }  // a corner within a side
      std::size_t last = i;
      while (last + 1 < i + count && goes_straight_on(edge(last), edge(last + 1))) { ++last; }
      const glm::dvec3 side = polygon[(last + 1) % count] - polygon[i];
      if (glm::length(side) > longest * (1.0 + 0x1p-20)) {
        longest = glm::length(side);
        along = side / longest;
      }
    }
    double low = 0.0;
    double high = 0.0;
    for (const glm::dvec3& p : polygon) {
      const double at = glm::dot(p - polygon[0], along);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    length = high - low;
    area = glm::length(vector_area(polygon));
    width = length > 0.0 ? area / length : 0.0;
    middle = polygon[0] + 0.5 * (low + high) * along;
  }
};

}  // namespace detail

HALFLIGHT_INLINE void cut_long_faces(std::vector<Surface>& surfaces, double min_area) {
  double area = 0.0;
  for (const Surface& surface : surfaces) {
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      if (surface.brep.data(f).sheet != brep::no_sheet) { area += glm::length(brep::vector_area(surface.brep, f)); }
    }
  }
  const double smallest = 4.0 * min_area * area;
  for (Surface& surface : surfaces) {
    const auto is_long = [&](const SurfaceBRep& brep, brep::FaceId f, double proportion) {
      const detail::FaceLength face{corner_polygon(brep, f)};
      return face.length > proportion * face.width && face.area > smallest;
    };
    const auto finished = [&](const SurfaceBRep& brep, brep::FaceId f) { return !is_long(brep, f, longest_part); };
    const auto across = [&](const SurfaceBRep& brep, brep::FaceId f) {
      const detail::FaceLength face{corner_polygon(brep, f)};
      const brep::Cut cut = brep::AlongPlane{face.middle, face.along}(brep, f);
      if (!cut.a.valid() || surface.object->flat()) { return cut; }
      const double touch = 1e-12 * surface.object->bounds().diameter();
      const auto on_surface = [&](brep::HalfedgeId h, double on) {
        const glm::dvec3 p = (1.0 - on) * brep.data(brep.vertex(h)).position + on * brep.data(brep.target(h)).position;
        return glm::length(surface.object->project(brep.data(f).sheet, p).position - p) <= touch;
      };
      return on_surface(cut.a, cut.on_a) && on_surface(cut.b, cut.on_b) ? cut : brep::Cut{};
    };
    std::vector<brep::FaceId> faces;
    for (const std::vector<brep::FaceId>& parts : input_faces(surface)) {
      if (parts.size() > 1 || !is_long(surface.brep, parts[0], longest_face)) { continue; }
      if (glm::length(brep::vector_area(surface.brep, parts[0])) >= least_long_share * area) { faces.push_back(parts[0]); }
    }
    // If the operators refuse, the face stays whole, which costs more links but is valid.
    for (const brep::FaceId f : faces) { (void)brep::split_recursively(surface.brep, f, across, finished, 1u << 17); }
  }
}

}  // namespace radiosity
