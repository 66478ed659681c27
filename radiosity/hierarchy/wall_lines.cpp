// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/wall_lines.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/split_objects.hpp>

#include <raycast/box.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE std::array<double, 2> WallLine::ends(const SurfaceBRep& brep, const brep::Cut& cut) const {
  const auto on_side = [&](brep::HalfedgeId h, double on) {
    return (1.0 - on) * brep.data(brep.vertex(h)).position + on * brep.data(brep.target(h)).position;
  };
  return {at(on_side(cut.a, cut.on_a)), at(on_side(cut.b, cut.on_b))};
}

HALFLIGHT_INLINE void WallLine::join_intervals(double tolerance) {
  std::sort(intervals.begin(), intervals.end());
  std::size_t last = 0;
  for (std::size_t i = 1; i < intervals.size(); ++i) {
    if (intervals[i].first <= intervals[last].second + tolerance) {
      intervals[last].second = std::max(intervals[last].second, intervals[i].second);
    } else {
      intervals[++last] = intervals[i];
    }
  }
  intervals.resize(std::min(intervals.size(), last + 1));
}

HALFLIGHT_INLINE double WallLine::covered(double from, double to) const {
  double sum = 0.0;
  for (const auto& [lo, hi] : intervals) { sum += std::max(0.0, std::min(hi, to) - std::max(lo, from)); }
  return sum;
}

// Sets the thickness: the distance behind each face to the next face that looks the other way. Solids of many faces are no walls.
HALFLIGHT_INLINE void measure_thickness(std::vector<WallFace>& faces) {
  constexpr std::size_t most_faces = 256;
  for (WallFace& face : faces) {
    face.thickness = std::numeric_limits<double>::infinity();
    if (faces.size() > most_faces) { continue; }
    for (const WallFace& other : faces) {
      const double depth = glm::dot(face.normal, face.polygon[0] - other.polygon[0]);
      const bool behind = depth > 0.0 && depth < face.thickness && glm::dot(face.normal, other.normal) < -0.99;
      if (behind && face.box.meets(other.box, (1.0 + 1e-6) * depth)) { face.thickness = depth; }
    }
  }
}

HALFLIGHT_INLINE std::vector<WallFace> wall_faces(const Surface& surface) {
  std::vector<WallFace> faces;
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    if (surface.brep.data(f).sheet == brep::no_sheet) { continue; }
    WallFace face{corner_polygon(surface.brep, f), {}, {}, 0.0, {}};
    const glm::dvec3 area = vector_area(face.polygon);
    if (!(glm::length(area) > 0.0)) { continue; }
    face.normal = glm::normalize(area);
    for (const glm::dvec3& p : face.polygon) { face.box.extend(p); }
    faces.push_back(std::move(face));
  }
  if (surface.object->solid()) { measure_thickness(faces); }
  return faces;
}

// Does the plane of `wall` cut off no more than a strip of this width, as the underside of a wall close above the floor cuts off of the
// walls beside it?
HALFLIGHT_INLINE bool along_border(const WallFace& face, const WallFace& wall, double width) {
  double behind = 0.0;
  double before = 0.0;
  for (const glm::dvec3& p : face.polygon) {
    const double at = glm::dot(wall.normal, p - wall.polygon[0]);
    behind = std::max(behind, -at);
    before = std::max(before, at);
  }
  return std::min(behind, before) < width;
}

HALFLIGHT_INLINE void add_wall(const WallFace& face, const WallFace& wall, double tolerance, std::vector<WallLine>& lines) {
  const glm::dvec3 across = glm::cross(face.normal, wall.normal);
  if (!(glm::length(across) > 1e-6)) { return; }
  const glm::dvec3 along = glm::normalize(across);
  constexpr double steep = 0.5;  // sine of 30 degrees: the plane of the wall meets the face within 1.8 gaps of the foot
  const Polygon& w = wall.polygon;
  const auto height = [&](const glm::dvec3& p) { return glm::dot(face.normal, p - face.polygon[0]); };
  double top = 0.0;
  for (const glm::dvec3& p : w) { top = std::max(top, height(p)); }
  const double foot = std::max(tolerance, glm::length(across) > steep ? foot_gap * top : 0.0);
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  const auto meet = [&](const glm::dvec3& p) {
    from = std::min(from, glm::dot(p - w[0], along));
    to = std::max(to, glm::dot(p - w[0], along));
  };
  for (std::size_t i = 0; i < w.size(); ++i) {
    const glm::dvec3& a = w[i];
    const glm::dvec3& b = w[(i + 1) % w.size()];
    const double ha = height(a);
    const double hb = height(b);
    if (std::abs(ha) <= foot) { meet(a); }
    if ((ha > tolerance && hb < -tolerance) || (ha < -tolerance && hb > tolerance)) { meet(a + ha / (ha - hb) * (b - a)); }
  }
  if (!(top > foot) || !(to - from > tolerance) || along_border(face, wall, foot)) { return; }
  const bool thin = wall.thickness <= thickness_of_wall * (to - from);
  const bool beside_lamp = std::any_of(wall.lamps.begin(), wall.lamps.end(), [&](const raycast::Box& lamp) {
    const double middle = height(lamp.centre()), half = 0.5 * glm::dot(glm::abs(face.normal), lamp.size());
    return middle + half > -tolerance && middle - half < top;
  });
  for (WallLine& line : lines) {
    const double cosine = glm::dot(line.normal, wall.normal);
    if (line.hidden > 0.0 || std::abs(cosine) < 1.0 - 1e-12 || std::abs(glm::dot(line.normal, w[0] - line.point)) > tolerance) { continue; }
    const double turn = glm::dot(along, line.along) < 0.0 ? -1.0 : 1.0;
    const double shift = line.at(w[0]);
    line.intervals.emplace_back(shift + std::min(turn * from, turn * to), shift + std::max(turn * from, turn * to));
    line.thin = line.thin && thin;
    line.beside_lamp = line.beside_lamp || beside_lamp;
    return;
  }
  lines.push_back({w[0], wall.normal, along, {{from, to}}, thin, 0.0, beside_lamp});
}

HALFLIGHT_INLINE void add_outline(const WallFace& face, const WallFace& sheet, double tolerance, std::vector<WallLine>& lines) {
  if (std::abs(glm::dot(face.normal, sheet.normal)) < 1.0 - 1e-6) { return; }
  for (const glm::dvec3& p : sheet.polygon) {
    const double height = glm::dot(face.normal, p - face.polygon[0]);
    if (!(height > tolerance && height <= close_gap * sheet.box.diameter())) { return; }
  }
  for (std::size_t i = 0; i < sheet.polygon.size(); ++i) {
    const glm::dvec3& a = sheet.polygon[i];
    const glm::dvec3 edge = sheet.polygon[(i + 1) % sheet.polygon.size()] - a;
    const double length = glm::length(edge);
    if (length > tolerance) {
      lines.push_back({a,
                       glm::normalize(glm::cross(edge, face.normal)),
                       edge / length,
                       {{0.0, length}},
                       false,
                       glm::length(vector_area(sheet.polygon))});
    }
  }
}

}  // namespace detail

}  // namespace radiosity
