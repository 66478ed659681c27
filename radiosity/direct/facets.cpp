// SPDX-License-Identifier: MIT
#include <radiosity/direct/facets.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/flat_parts.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

namespace detail {

// Collects facets given by the numbers of their corners, and finds which of them share an edge.
class FacetCollector {
 public:
  void add(std::span<const std::uint32_t> numbers, Polygon contour) {
    const glm::dvec3 area = vector_area(contour);
    const double length = glm::length(area);
    if (!(length > 0.0)) { return; }
    const glm::dvec3 normal = area / length;
    const auto index = static_cast<std::uint32_t>(facets_.facets.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::size_t next = i + 1 < numbers.size() ? i + 1 : 0;
      const auto other = open_.find({numbers[next], numbers[i]});
      if (other != open_.end()) {
        facets_.edges[other->second].right = index;
        open_.erase(other);
      } else {
        open_.insert_or_assign({numbers[i], numbers[next]}, facets_.edges.size());
        facets_.edges.push_back({contour[i], contour[next], index, brep::invalid_index});
      }
    }
    facets_.facets.push_back({std::move(contour), normal, 0.0, length});
    Facets::Facet& facet = facets_.facets.back();
    for (const glm::dvec3& p : facet.contour) { facet.offset += glm::dot(normal, p) / static_cast<double>(facet.contour.size()); }
  }
  [[nodiscard]] Facets take() { return std::move(facets_); }

 private:
  Facets facets_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> open_;  // edges whose second facet has not been found yet
};

}  // namespace detail

namespace detail {

template <class Counts>
[[nodiscard]] Facets facets_of(const Surface& surface, const Counts& counts) {
  FacetCollector collector;
  std::vector<std::uint32_t> numbers;
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    const std::uint32_t own = surface.brep.data(f).sheet;
    if (own == brep::no_sheet || !counts(own)) { continue; }
    Polygon contour;
    numbers.clear();
    for (const brep::HalfedgeId h : brep::halfedges_of(surface.brep, f)) {
      const brep::VertexId v = surface.brep.vertex(h);
      numbers.push_back(v.index);
      contour.push_back(surface.brep.data(v).position);
    }
    collector.add(numbers, std::move(contour));
  }
  return collector.take();
}

}  // namespace detail

HALFLIGHT_INLINE Facets facets_of(const Surface& surface, std::optional<std::uint32_t> sheet) {
  return detail::facets_of(surface, [&](std::uint32_t s) { return !sheet || s == *sheet; });
}
HALFLIGHT_INLINE Facets facets_of(const Surface& surface, std::span<const std::uint32_t> sheets) {
  return detail::facets_of(surface, [&](std::uint32_t s) { return std::binary_search(sheets.begin(), sheets.end(), s); });
}

HALFLIGHT_INLINE double area_of(const Facets& facets) {
  return std::accumulate(facets.facets.begin(), facets.facets.end(), 0.0, [](double sum, const Facets::Facet& f) { return sum + f.area; });
}

HALFLIGHT_INLINE bool surrounds(const Facets& facets, const glm::dvec3& point, double slack) {
  double in_front = 0.0, total = 0.0;
  for (const Facets::Facet& f : facets.facets) {
    total += f.area;
    in_front += f.height(point) > slack ? f.area : 0.0;
  }
  return in_front > 0.5 * total;
}

HALFLIGHT_INLINE bool convex_within(const Facets& facets, double tolerance) {
  constexpr std::size_t most = 1000;
  if (facets.facets.size() > most) { return false; }
  std::vector<glm::dvec3> corners;
  for (const Facets::Facet& f : facets.facets) { corners.insert(corners.end(), f.contour.begin(), f.contour.end()); }
  const auto before = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; };
  std::sort(corners.begin(), corners.end(), before);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return std::all_of(facets.facets.begin(), facets.facets.end(), [&](const Facets::Facet& f) {
    return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& p) { return f.height(p) <= tolerance; });
  });
}

HALFLIGHT_INLINE void append(Facets& facets, const Facets& more) {
  const auto first = static_cast<std::uint32_t>(facets.facets.size());
  const auto size = [](const auto& all) { return static_cast<std::uint32_t>(all.size()); };
  Facets::Part part{first, 0, size(facets.edges), 0};
  facets.facets.insert(facets.facets.end(), more.facets.begin(), more.facets.end());
  for (Facets::Edge edge : more.edges) {
    edge.left += first;
    if (edge.right != brep::invalid_index) { edge.right += first; }
    facets.edges.push_back(edge);
  }
  part.facets_end = size(facets.facets);
  part.edges_end = size(facets.edges);
  raycast::Box box;
  for (const Facets::Facet& facet : more.facets) {
    for (const glm::dvec3& p : facet.contour) { box.extend(p); }
  }
  part.centre = box.centre();
  part.half = 0.5 * (box.hi - box.lo);
  for (const Facets::Facet& facet : more.facets) {
    for (const glm::dvec3& p : facet.contour) { part.radius = std::max(part.radius, glm::length(p - part.centre)); }
  }
  facets.parts.push_back(part);
}

HALFLIGHT_INLINE Facets facets_of(const raycast::PlacedObject& object, double tolerance, std::optional<std::uint32_t> sheet) {
  brep::Builder builder;
  object.approximate(tolerance, builder);
  detail::FacetCollector collector;
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    if (builder.sheet(f) == brep::no_sheet || (sheet && builder.sheet(f) != *sheet)) { continue; }
    const std::span<const std::uint32_t> corners = builder.corners(f);
    std::vector<FaceCorners> parts;
    append_flat_parts(builder, {corners.begin(), corners.end()}, parts);
    for (const FaceCorners& part : parts) {
      Polygon contour;
      for (const std::uint32_t v : part) { contour.push_back(builder.position(v)); }
      collector.add(part, std::move(contour));
    }
  }
  return collector.take();
}

HALFLIGHT_INLINE glm::dvec3 contour_vector(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 to_a = a - x;
  const glm::dvec3 to_b = b - x;
  const glm::dvec3 cross = glm::cross(to_b, to_a);
  const double sine = glm::length(cross);
  return sine > 0.0 ? cross * (std::atan2(sine, glm::dot(to_a, to_b)) / sine) : glm::dvec3{0.0};
}

namespace detail {

// Contour integral over the part of the facing facets above the horizon of x: along the horizon, and along the other edges.
struct ContourAboveHorizon {
  const glm::dvec3 &x, &n;
  double offset = glm::dot(n, x);

  [[nodiscard]] double height(const glm::dvec3& p) const { return glm::dot(n, p) - offset; }
  [[nodiscard]] double term(const glm::dvec3& a, const glm::dvec3& b) const { return glm::dot(n, contour_vector(x, a, b)); }
  [[nodiscard]] glm::dvec3 at_horizon(const glm::dvec3& a, const glm::dvec3& b) const {
    const double ha = height(a), hb = height(b);
    return a + (b - a) * (ha / (ha - hb));
  }
  // The term along the horizon, from where the contour of a facet goes below it to where it comes up again.
  [[nodiscard]] double along(std::span<const glm::dvec3> contour) const {
    glm::dvec3 down{0.0}, up{0.0};
    bool crosses = false;
    const glm::dvec3* before = &contour.back();
    bool was_above = height(*before) >= 0.0;
    for (const glm::dvec3& p : contour) {
      const bool is_above = height(p) >= 0.0;
      if (was_above != is_above) { (is_above ? up : down) = at_horizon(*before, p); }
      crosses = crosses || was_above != is_above;
      before = &p;
      was_above = is_above;
    }
    return crosses ? term(down, up) : 0.0;
  }
  // The term of the part of an edge above the horizon.
  [[nodiscard]] double above(const glm::dvec3& a, const glm::dvec3& b) const {
    const bool a_above = height(a) >= 0.0, b_above = height(b) >= 0.0;
    if (a_above && b_above) { return term(a, b); }
    if (!a_above && !b_above) { return 0.0; }
    return a_above ? term(a, at_horizon(a, b)) : term(at_horizon(a, b), b);
  }
};

// Sets `facing` for the facets from `first` to `end`.
HALFLIGHT_INLINE void find_facing(const Facets& facets, std::uint32_t first, std::uint32_t end, const glm::dvec3& x, double slack,
                                  std::vector<char>& facing) {
  facing.resize(facets.facets.size());
  for (std::uint32_t f = first; f < end; ++f) { facing[f] = facets.facets[f].height(x) > slack; }
}

[[nodiscard]] inline std::span<const Facets::Edge> edges_of(const Facets& facets, const Facets::Part& part) {
  return std::span{facets.edges}.subspan(part.edges_begin, part.edges_end - part.edges_begin);
}

}  // namespace detail

HALFLIGHT_INLINE double form_factor(const Facets& facets, const Facets::Part& part, const glm::dvec3& x, const glm::dvec3& n, double slack,
                                    std::vector<char>& facing) {
  const detail::ContourAboveHorizon contour{x, n};
  detail::find_facing(facets, part.facets_begin, part.facets_end, x, slack, facing);
  double sum = 0.0;
  for (std::uint32_t f = part.facets_begin; f < part.facets_end; ++f) {
    if (facing[f] != 0) { sum += contour.along(facets.facets[f].contour); }
  }
  for_outline(detail::edges_of(facets, part), facing, [&](const glm::dvec3& a, const glm::dvec3& b) { sum += contour.above(a, b); });
  return std::max(0.0, sum / (2.0 * std::numbers::pi));
}

HALFLIGHT_INLINE double form_factor(const Facets& facets, const glm::dvec3& x, const glm::dvec3& n, double slack,
                                    std::vector<char>& facing) {
  const auto size = [](const auto& all) { return static_cast<std::uint32_t>(all.size()); };
  return form_factor(facets, Facets::Part{0, size(facets.facets), 0, size(facets.edges)}, x, n, slack, facing);
}

HALFLIGHT_INLINE double width_about_longest_edge(const Facets& facets, const glm::dvec3& centre) {
  glm::dvec3 longest{0.0};
  for (const Facets::Facet& facet : facets.facets) {
    for (std::size_t k = 0; k < facet.contour.size(); ++k) {
      const glm::dvec3 edge = facet.contour[(k + 1) % facet.contour.size()] - facet.contour[k];
      if (glm::dot(edge, edge) > glm::dot(longest, longest)) { longest = edge; }
    }
  }
  const double length = glm::length(longest);
  const glm::dvec3 axis = length > 0.0 ? longest / length : longest;
  double radius = 0.0;
  for (const Facets::Facet& facet : facets.facets) {
    for (const glm::dvec3& p : facet.contour) { radius = std::max(radius, glm::length(glm::cross(axis, p - centre))); }
  }
  return 2.0 * radius;
}

}  // namespace radiosity
