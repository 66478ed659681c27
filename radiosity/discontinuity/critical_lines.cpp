// SPDX-License-Identifier: MIT
#include <radiosity/discontinuity/critical_lines.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <radiosity/direct/facets.hpp>

namespace radiosity {

namespace detail {

using Segment2 = std::pair<glm::dvec3, glm::dvec3>;

// The part of the segment a - b where low <= height <= high.
template <class Height>
[[nodiscard]] std::optional<Segment2> part_between(const glm::dvec3& a, const glm::dvec3& b, const Height& height, double low,
                                                   double high) {
  const double ha = height(a);
  const double hb = height(b);
  double from = 0.0;
  double to = 1.0;
  for (const auto& [start, end] : {std::pair{ha - low, hb - low}, std::pair{high - ha, high - hb}}) {
    if (start < 0.0 && end < 0.0) { return std::nullopt; }
    if (start < 0.0) { from = std::max(from, start / (start - end)); }
    if (end < 0.0) { to = std::min(to, start / (start - end)); }
  }
  if (!(from <= to)) { return std::nullopt; }
  const auto at = [&](double t) { return t == 0.0 ? a : t == 1.0 ? b : a + t * (b - a); };
  return Segment2{at(from), at(to)};
}

// The part of the segment a - b that lies on the face; a and b must lie in its plane.
[[nodiscard]] HALFLIGHT_INLINE std::optional<Segment2> part_on(const ReceivingFace& face, const glm::dvec3& a, const glm::dvec3& b) {
  double from = 0.0;
  double to = 1.0;
  for (std::size_t i = 0; i < face.contour.size(); ++i) {
    const glm::dvec3& corner = face.contour[i];
    const glm::dvec3 inward = glm::cross(face.normal, face.contour[i + 1 < face.contour.size() ? i + 1 : 0] - corner);
    const double start = glm::dot(inward, a - corner);
    const double end = glm::dot(inward, b - corner);
    if (start < 0.0 && end < 0.0) { return std::nullopt; }
    if (start < 0.0) { from = std::max(from, start / (start - end)); }
    if (end < 0.0) { to = std::min(to, start / (start - end)); }
  }
  if (!(from < to)) { return std::nullopt; }
  return Segment2{a + from * (b - a), a + to * (b - a)};
}

HALFLIGHT_INLINE void add_line(const ReceivingFace& face, const glm::dvec3& a, const glm::dvec3& b, int degree, double tolerance,
                               std::vector<CriticalLine>& lines) {
  const std::optional<Segment2> part = part_on(face, a, b);
  if (part && glm::length(part->second - part->first) > tolerance) { lines.push_back({part->first, part->second, degree}); }
}

// Where the line from `source` through x meets the plane of the face; source must be higher above it than x.
[[nodiscard]] HALFLIGHT_INLINE glm::dvec3 shadow_of(const ReceivingFace& face, const glm::dvec3& x, const glm::dvec3& source) {
  const double h = face.height(x);
  return x + h / (face.height(source) - h) * (x - source);
}

// Does the edge belong to the outline of its body as seen from x?
[[nodiscard]] HALFLIGHT_INLINE bool on_outline(const Facets& body, const Facets::Edge& edge, const glm::dvec3& x, double tolerance) {
  if (edge.right == brep::invalid_index) { return true; }
  const double left = body.facets[edge.left].height(x);
  const double right = body.facets[edge.right].height(x);
  if (std::abs(left) <= tolerance && std::abs(right) <= tolerance) { return false; }  // an edge between parts of one facet, seen edge-on
  return (left > tolerance) != (right > tolerance);
}

}  // namespace detail

HALFLIGHT_INLINE void add_critical_lines(const ReceivingFace& face, const Facets& lamp, const Facets& blocker, double tolerance,
                                         std::vector<CriticalLine>& lines) {
  const Facets::Facet& plane = lamp.facets[0];
  const auto height = [&](const glm::dvec3& p) { return face.height(p); };
  const auto before_lamp = [&](const glm::dvec3& p) { return plane.height(p); };
  constexpr double any = 1e300;
  // The part of the lamp's outline above the face.
  std::vector<detail::Segment2> outline;
  for (const Facets::Edge& edge : lamp.edges) {
    if (edge.right != brep::invalid_index) { continue; }
    if (const auto part = detail::part_between(edge.a, edge.b, height, tolerance, any)) { outline.push_back(*part); }
  }
  // The parts of the blocker's edges between the planes of lamp and face.
  for (const Facets::Edge& edge : blocker.edges) {
    auto part = detail::part_between(edge.a, edge.b, before_lamp, tolerance, any);
    if (part) { part = detail::part_between(part->first, part->second, height, 0.0, any); }
    if (!part || std::max(face.height(part->first), face.height(part->second)) <= tolerance) { continue; }
    const auto& [a, b] = *part;
    for (const auto& [p, q] : outline) {
      const bool outlined = detail::on_outline(blocker, edge, p, tolerance);
      // VE: the shadow of the blocker's edge from the lamp vertex p.
      const auto below = detail::part_between(a, b, height, 0.0, face.height(p) - tolerance);
      if (outlined && below) {
        const glm::dvec3 across = glm::normalize(glm::cross(a - p, b - p));
        const bool shares_edge = std::abs(glm::dot(across, q - p)) <= tolerance;
        detail::add_line(face, detail::shadow_of(face, below->first, p), detail::shadow_of(face, below->second, p), shares_edge ? 1 : 2,
                         tolerance, lines);
      }
      // EV: the lamp's edge, projected through the end points of the blocker's edge.
      if (!outlined && !detail::on_outline(blocker, edge, q, tolerance)) { continue; }
      for (const glm::dvec3& v : {a, b}) {
        const double h = face.height(v);
        if (h <= tolerance || (v != edge.a && v != edge.b)) { continue; }
        const auto above = detail::part_between(p, q, height, h + tolerance, any);
        if (!above) { continue; }
        const glm::dvec3 across = glm::normalize(glm::cross(p - v, q - v));
        const bool shares_edge = std::abs(glm::dot(across, (v == a ? b : a) - v)) <= tolerance;
        detail::add_line(face, detail::shadow_of(face, v, above->first), detail::shadow_of(face, v, above->second), shares_edge ? 1 : 2,
                         tolerance, lines);
      }
    }
  }
}

HALFLIGHT_INLINE void add_contact_lines(const ReceivingFace& face, const Facets& blocker, double tolerance,
                                        std::vector<CriticalLine>& lines) {
  for (const Facets::Facet& facet : blocker.facets) {
    const Polygon& w = facet.contour;
    double top = 0.0;
    double bottom = 0.0;
    for (const glm::dvec3& p : w) {
      top = std::max(top, face.height(p));
      bottom = std::min(bottom, face.height(p));
    }
    // A facet that lies on the face covers it; one that stands on it or passes through it divides it.
    const bool lies = top <= tolerance && bottom >= -tolerance && glm::dot(facet.normal, face.normal) > 0.0;
    if (!lies && !(top > tolerance)) { continue; }
    std::vector<glm::dvec3> met;
    for (std::size_t i = 0; i < w.size(); ++i) {
      const glm::dvec3& a = w[i];
      const glm::dvec3& b = w[i + 1 < w.size() ? i + 1 : 0];
      const double ha = face.height(a);
      const double hb = face.height(b);
      if (std::abs(ha) <= tolerance && std::abs(hb) <= tolerance) { detail::add_line(face, a, b, 0, tolerance, lines); }
      if (lies) { continue; }
      if (std::abs(ha) <= tolerance) { met.push_back(a); }
      if (ha * hb < 0.0 && std::abs(ha) > tolerance && std::abs(hb) > tolerance) { met.push_back(a + ha / (ha - hb) * (b - a)); }
    }
    if (met.size() == 2 && bottom < -tolerance) { detail::add_line(face, met[0], met[1], 0, tolerance, lines); }
  }
}

namespace detail {

// A line with precomputed length and direction.
struct JoinedLine {
  explicit JoinedLine(const CriticalLine& l) : line{l}, length{glm::length(l.to - l.from)}, along{(l.to - l.from) / length} {}

  // Joins another line if it lies within the tolerance of this line's infinite extension and meets or overlaps this line; otherwise
  // returns false.
  [[nodiscard]] bool take(const CriticalLine& other, double tolerance) {
    const glm::dvec3 to_from = other.from - line.from, to_to = other.to - line.from;
    const auto beside = [&](const glm::dvec3& d) {
      const glm::dvec3 across = glm::cross(along, d);
      return glm::dot(across, across) > tolerance * tolerance;
    };
    if (beside(to_from) || beside(to_to)) { return false; }
    const double from = glm::dot(along, to_from), to = glm::dot(along, to_to);
    const double low = std::min(from, to), high = std::max(from, to);
    if (low > length + tolerance || high < -tolerance) { return false; }
    if (low >= 0.0 && high <= length) { return true; }
    const glm::dvec3 start = line.from;
    if (low < 0.0) { line.from = start + low * along; }
    if (high > length) { line.to = start + high * along; }
    *this = JoinedLine{line};
    return true;
  }

  CriticalLine line;
  double length;
  glm::dvec3 along;
};

}  // namespace detail

HALFLIGHT_INLINE void join_lines(std::vector<CriticalLine>& lines, double tolerance) {
  const auto length = [](const CriticalLine& line) { return glm::length(line.to - line.from); };
  const auto before = [&](const CriticalLine& a, const CriticalLine& b) {
    return a.degree != b.degree ? a.degree < b.degree : length(a) > length(b);
  };
  std::stable_sort(lines.begin(), lines.end(), before);
  for (bool again = true; again;) {
    std::vector<detail::JoinedLine> joined;
    for (const CriticalLine& line : lines) {
      const auto takes = [&](detail::JoinedLine& other) { return other.take(line, tolerance); };
      if (std::none_of(joined.begin(), joined.end(), takes)) { joined.emplace_back(line); }
    }
    again = joined.size() < lines.size();
    lines.clear();
    for (const detail::JoinedLine& line : joined) { lines.push_back(line.line); }
  }
  std::stable_sort(lines.begin(), lines.end(), before);
}

}  // namespace radiosity
