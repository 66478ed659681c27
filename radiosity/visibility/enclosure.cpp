// SPDX-License-Identifier: MIT
#include <radiosity/visibility/enclosure.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/point_query.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

namespace detail {

inline constexpr double enclosure_slack = 1e-9;  // of the scene
inline constexpr std::size_t most_enclosure_parts = 1000;

// A convex face.
struct FrontFace {
  Polygon contour;
  glm::dvec3 normal{0.0};  // of length 1
  std::uint32_t object = 0;
};

// The fronts of a surface; those of no area are left out.
HALFLIGHT_INLINE void add_fronts(const Surface& surface, std::uint32_t object, std::vector<FrontFace>& faces) {
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    if (surface.brep.data(f).sheet == brep::no_sheet) { continue; }
    Polygon contour = corner_polygon(surface.brep, f);
    const glm::dvec3 area = brep::vector_area(contour);
    const double length = glm::length(area);
    if (length > 0.0) { faces.push_back({std::move(contour), area / length, object}); }
  }
}

// Sums up the edges of faces with their direction; what does not cancel is the border.
class EdgeSum {
 public:
  void add(std::span<const glm::dvec3> contour) {
    for (std::size_t i = 0; i < contour.size(); ++i) { add(corner(contour[i]), corner(contour[(i + 1) % contour.size()])); }
  }
  // Corners of the same number are one.
  [[nodiscard]] std::uint32_t corner(const glm::dvec3& p) {
    const auto [at, is_new] = corners_.try_emplace(
        {std::llround(std::ldexp(p.x, 30)), std::llround(std::ldexp(p.y, 30)), std::llround(std::ldexp(p.z, 30))}, positions_.size());
    if (is_new) { positions_.push_back(p); }
    return static_cast<std::uint32_t>(at->second);
  }
  using Edge = std::array<std::uint32_t, 2>;
  // The edges of which a part does not cancel, when each is cut at the corners of others that lie on it; nothing when there are too many to
  // look at.
  [[nodiscard]] std::optional<std::set<Edge>> border() const {
    std::vector<std::pair<Edge, int>> rest;
    std::vector<std::uint32_t> ends;
    for (const auto& [edge, times] : times_) {
      if (times == 0) { continue; }
      rest.push_back({edge, times});
      ends.insert(ends.end(), edge.begin(), edge.end());
    }
    if (rest.size() > most_enclosure_parts) { return {}; }
    EdgeSum pieces;
    std::map<Edge, std::vector<Edge>> owners;
    for (const auto& [edge, times] : rest) {
      const glm::dvec3 a = positions_[edge[0]];
      const glm::dvec3 along = positions_[edge[1]] - a;
      const double square = glm::dot(along, along);
      std::vector<std::pair<double, std::uint32_t>> on{{0.0, edge[0]}, {1.0, edge[1]}};
      for (const std::uint32_t c : ends) {
        const double t = glm::dot(positions_[c] - a, along) / square;
        if (c == edge[0] || c == edge[1] || t <= 0.0 || t >= 1.0) { continue; }
        if (glm::length(positions_[c] - a - t * along) <= enclosure_slack) { on.push_back({t, c}); }
      }
      std::sort(on.begin(), on.end());
      on.erase(std::unique(on.begin(), on.end()), on.end());
      for (std::size_t k = 1; k < on.size(); ++k) {
        pieces.add(on[k - 1].second, on[k].second, times);
        owners[between(on[k - 1].second, on[k].second)].push_back(edge);
      }
    }
    std::set<Edge> border;
    for (const auto& [piece, times] : pieces.times_) {
      if (times != 0) { border.insert(owners[piece].begin(), owners[piece].end()); }
    }
    return border;
  }
  [[nodiscard]] bool touches(const std::set<Edge>& border, std::span<const glm::dvec3> contour) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      if (border.contains(between(corner(contour[i]), corner(contour[(i + 1) % contour.size()])))) { return true; }
    }
    return false;
  }

 private:
  static Edge between(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }
  void add(std::uint32_t a, std::uint32_t b, int times = 1) {
    if (a != b) { times_[between(a, b)] += a < b ? times : -times; }
  }

  std::map<std::array<long long, 3>, std::size_t> corners_;
  std::vector<glm::dvec3> positions_;
  std::map<Edge, int> times_;
};

// Does an edge of `a` pass through the inside of `b`? What touches does not.
[[nodiscard]] HALFLIGHT_INLINE bool pierces(const FrontFace& a, const FrontFace& b) {
  for (std::size_t i = 0; i < a.contour.size(); ++i) {
    const glm::dvec3& p = a.contour[i];
    const glm::dvec3& q = a.contour[(i + 1) % a.contour.size()];
    const double hp = glm::dot(b.normal, p - b.contour[0]);
    const double hq = glm::dot(b.normal, q - b.contour[0]);
    if (!(std::min(hp, hq) < -enclosure_slack && std::max(hp, hq) > enclosure_slack)) { continue; }
    const glm::dvec3 x = p + hp / (hp - hq) * (q - p);
    bool inside = true;
    for (std::size_t k = 0; k < b.contour.size() && inside; ++k) {
      const glm::dvec3 edge = b.contour[(k + 1) % b.contour.size()] - b.contour[k];
      inside = glm::dot(glm::cross(b.normal, edge), x - b.contour[k]) > enclosure_slack * glm::length(edge);
    }
    if (inside) { return true; }
  }
  return false;
}

// Does any of the first `walls` faces cross another face?
[[nodiscard]] HALFLIGHT_INLINE bool any_crossing(const std::vector<FrontFace>& faces, std::size_t walls) {
  std::vector<raycast::Box> boxes;
  for (const FrontFace& face : faces) {
    raycast::Box box;
    for (const glm::dvec3& p : face.contour) { box.extend(p); }
    boxes.push_back(box);
  }
  const raycast::Bvh tree{boxes};
  for (std::size_t i = 0; i < walls; ++i) {
    const raycast::Box& own = boxes[i];
    const bool found = raycast::any_within(
        tree,
        [&](const raycast::Box& box) {
          for (int k = 0; k < 3; ++k) {
            if (box.lo[k] > own.hi[k] || box.hi[k] < own.lo[k]) { return false; }
          }
          return true;
        },
        [&](std::uint32_t j) { return j != i && (pierces(faces[i], faces[j]) || pierces(faces[j], faces[i])); });
    if (found) { return true; }
  }
  return false;
}

// How often the faces wind around x, which counts half for a face that x lies on: the solid angle of each (van Oosterom and Strackee 1983).
[[nodiscard]] HALFLIGHT_INLINE double winding(std::span<const FrontFace> faces, const glm::dvec3& x) {
  double angle = 0.0;
  for (const FrontFace& face : faces) {
    if (std::abs(glm::dot(face.normal, x - face.contour[0])) <= enclosure_slack) { continue; }  // seen edge on, or x lies on it
    const glm::dvec3 a = glm::normalize(face.contour[0] - x);
    for (std::size_t k = 2; k < face.contour.size(); ++k) {
      const glm::dvec3 b = glm::normalize(face.contour[k - 1] - x);
      const glm::dvec3 c = glm::normalize(face.contour[k] - x);
      angle -= 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
    }
  }
  return angle / (4.0 * std::numbers::pi);
}

[[nodiscard]] HALFLIGHT_INLINE glm::dvec3 middle_of(const FrontFace& face) {
  return std::accumulate(face.contour.begin(), face.contour.end(), glm::dvec3{0.0}) / static_cast<double>(face.contour.size());
}

// In the place of a solid that is curved or has many faces.
[[nodiscard]] HALFLIGHT_INLINE std::vector<FrontFace> faces_of_box(const raycast::Box& box, std::uint32_t object) {
  std::vector<FrontFace> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      FrontFace face{{}, glm::dvec3{0.0}, object};
      face.normal[axis] = high ? 1.0 : -1.0;
      for (const auto& [u, v] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
        glm::dvec3 p{0.0};
        p[axis] = high ? box.hi[axis] : box.lo[axis];
        p[(axis + 1) % 3] = u != 0 ? box.hi[(axis + 1) % 3] : box.lo[(axis + 1) % 3];
        p[(axis + 2) % 3] = v != 0 ? box.hi[(axis + 2) % 3] : box.lo[(axis + 2) % 3];
        face.contour.push_back(p);
      }
      if (!high) { std::reverse(face.contour.begin(), face.contour.end()); }
      faces.push_back(std::move(face));
    }
  }
  return faces;
}

// One face of each set of faces that hang together by edges of which each belongs to two faces.
[[nodiscard]] HALFLIGHT_INLINE std::vector<std::size_t> one_of_each_part(const std::vector<FrontFace>& faces, EdgeSum& corners) {
  std::map<std::array<std::uint32_t, 2>, std::vector<std::size_t>> of_edge;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Polygon& contour = faces[i].contour;
    for (std::size_t k = 0; k < contour.size(); ++k) {
      const std::uint32_t a = corners.corner(contour[k]);
      const std::uint32_t b = corners.corner(contour[(k + 1) % contour.size()]);
      of_edge[{std::min(a, b), std::max(a, b)}].push_back(i);
    }
  }
  std::vector<std::size_t> up(faces.size());
  std::iota(up.begin(), up.end(), std::size_t{0});
  const auto first = [&](std::size_t i) {
    while (up[i] != i) { i = up[i] = up[up[i]]; }
    return i;
  };
  for (const auto& [edge, of] : of_edge) {
    if (of.size() != 2) { continue; }
    const std::size_t a = first(of[0]);
    const std::size_t b = first(of[1]);
    up[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::size_t> parts;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (up[i] == i) { parts.push_back(i); }
  }
  return parts;
}

// How much of a convex polygon a convex polygon in the same plane covers, both counter-clockwise about `normal`.
[[nodiscard]] HALFLIGHT_INLINE double covered_area(Polygon polygon, const Polygon& cover, const glm::dvec3& normal) {
  Polygon part;
  for (std::size_t i = 0; i < cover.size() && polygon.size() > 2; ++i) {
    const glm::dvec3 inwards = glm::cross(normal, cover[(i + 1) % cover.size()] - cover[i]);
    const double length = glm::length(inwards);
    if (!(length > 0.0)) { continue; }
    part.clear();
    clip_to_horizon(polygon, cover[i], inwards / length, part);
    std::swap(polygon, part);
  }
  return polygon.size() > 2 ? std::max(0.0, glm::dot(normal, brep::vector_area(polygon))) : 0.0;
}

}  // namespace detail

HALFLIGHT_INLINE bool lies_on(const Surface& surface, const std::vector<const Surface*>& walls) {
  std::vector<detail::FrontFace> faces;
  for (const Surface* wall : walls) { detail::add_fronts(*wall, 0, faces); }
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    if (surface.brep.data(f).sheet == brep::no_sheet) { continue; }
    const Polygon polygon = corner_polygon(surface.brep, f);
    const glm::dvec3 area = brep::vector_area(polygon);
    const double whole = glm::length(area);
    if (!(whole > 0.0)) { return false; }
    double border = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) { border += glm::length(polygon[(i + 1) % polygon.size()] - polygon[i]); }
    double covered = 0.0;
    for (const detail::FrontFace& wall : faces) {
      const auto in_plane = [&](const glm::dvec3& p) {
        return std::abs(glm::dot(wall.normal, p - wall.contour[0])) <= detail::enclosure_slack;
      };
      if (!(glm::dot(wall.normal, area) > 0.999 * whole) || !std::all_of(polygon.begin(), polygon.end(), in_plane)) { continue; }
      covered += detail::covered_area(polygon, wall.contour, wall.normal);
    }
    if (covered < whole - detail::enclosure_slack * border) { return false; }
  }
  return true;
}

HALFLIGHT_INLINE bool enclosed_by_sheets(const std::vector<Surface>& surfaces) {
  std::vector<std::uint32_t> sheets;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    if (surfaces[o].object->inside()) { return false; }
    if (surfaces[o].object->solid()) { continue; }
    if (!surfaces[o].object->flat()) { return false; }
    sheets.push_back(o);
  }
  const auto faces_of = [&](const std::vector<std::uint32_t>& objects) {
    std::vector<detail::FrontFace> faces;
    for (const std::uint32_t o : objects) { detail::add_fronts(surfaces[o], o, faces); }
    return faces;
  };
  const auto sum_of = [](const std::vector<detail::FrontFace>& faces) {
    detail::EdgeSum sum;
    for (const detail::FrontFace& face : faces) { sum.add(face.contour); }
    return sum;
  };
  std::vector<detail::FrontFace> faces = faces_of(sheets);
  if (faces.size() < 4) { return false; }
  detail::EdgeSum sum = sum_of(faces);
  auto border = sum.border();
  if (!border) { return false; }
  if (!border->empty()) {  // what has a border may lie on a wall
    std::vector<std::uint32_t> walls;
    std::vector<std::uint32_t> others;
    for (const std::uint32_t o : sheets) {
      const auto of_object = [&](const detail::FrontFace& face) { return face.object == o && sum.touches(*border, face.contour); };
      (std::any_of(faces.begin(), faces.end(), of_object) ? others : walls).push_back(o);
    }
    if (others.size() > 64) { return false; }
    std::vector<const Surface*> behind;
    for (const std::uint32_t o : walls) { behind.push_back(&surfaces[o]); }
    if (!std::all_of(others.begin(), others.end(), [&](std::uint32_t o) { return lies_on(surfaces[o], behind); })) { return false; }
    faces = faces_of(walls);
    sum = sum_of(faces);
    border = sum.border();
    if (faces.size() < 4 || !border || !border->empty()) { return false; }
  }
  const std::vector<std::size_t> parts = detail::one_of_each_part(faces, sum);
  if (parts.size() > detail::most_enclosure_parts) { return false; }
  const std::span<const detail::FrontFace> walls{faces};
  for (const std::size_t part : parts) {
    if (std::abs(detail::winding(walls, detail::middle_of(faces[part])) - 0.5) > 0.01) { return false; }
  }
  std::vector<detail::FrontFace> all = faces;
  std::size_t looked_at = 0;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    if (!surfaces[o].object->solid()) { continue; }
    if (++looked_at > detail::most_enclosure_parts) { return false; }
    std::vector<detail::FrontFace> own;
    if (surfaces[o].object->flat()) { detail::add_fronts(surfaces[o], o, own); }
    if (own.empty() || own.size() > 100) { own = detail::faces_of_box(surfaces[o].object->bounds(), o); }
    double most = 0.0;
    for (const detail::FrontFace& face : own) {
      const double around = detail::winding(walls, detail::middle_of(face));
      if (around < 0.49) { return false; }
      most = std::max(most, around);
    }
    if (most < 0.99) { return false; }
    all.insert(all.end(), own.begin(), own.end());
  }
  return !detail::any_crossing(all, faces.size());
}

}  // namespace radiosity
