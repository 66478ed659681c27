// SPDX-License-Identifier: MIT
#pragma once

// What a builder holds, sound or not: counts, components, borders, and the genus of what is a surface.
//
// A component is a set of faces connected by edges; components that only touch in a vertex stay two. Its Euler
// characteristic v - e + f counts a vertex once for each of its fans. With b borders, and if it is two-sided and no edge has
// more than two faces, its genus h follows from v - e + f + b = 2 - 2h: closing each border with a face makes it a shell.
// Faces that are wrong by themselves (a bad index, fewer than three corners, a vertex twice) are counted and left out.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/edge_uses.hpp>
#include <brep/finite.hpp>

namespace brep {

struct Component {
  FaceId first;  // the face of lowest number
  std::size_t vertices = 0, edges = 0, faces = 0;
  std::size_t borders = 0, border_edges = 0;  // borders: chains; where it is one-sided one border may be several of them
  std::size_t nonmanifold_edges = 0;          // with more than two faces
  bool oriented = true;                       // no edge is used twice in one direction
  bool two_sided = true;                      // flips can make it oriented
  std::optional<long> genus;                  // when it is a two-sided surface, with borders or without
  std::optional<double> volume;               // when it is closed and oriented, and a double can hold it; negative: inside out

  [[nodiscard]] bool closed() const { return border_edges == 0 && nonmanifold_edges == 0; }
  [[nodiscard]] long euler() const { return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(faces); }
};

struct Statistics {
  std::size_t vertices = 0, used_vertices = 0;
  std::size_t edges = 0, border_edges = 0, nonmanifold_edges = 0;
  std::size_t faces = 0, unusable_faces = 0;
  std::map<std::size_t, std::size_t> face_sizes;  // corners -> faces
  std::size_t duplicate_positions = 0;            // vertices less different positions
  bool oriented = true;
  glm::dvec3 lo{0.0}, hi{0.0};  // around the used vertices with finite coordinates
  std::vector<Component> components;

  [[nodiscard]] bool closed() const { return border_edges == 0 && nonmanifold_edges == 0 && unusable_faces == 0; }
  // v - e + f with every used vertex counted once.
  [[nodiscard]] long euler() const {
    return static_cast<long>(used_vertices) - static_cast<long>(edges) + static_cast<long>(faces - unusable_faces);
  }
};

namespace detail {

class StatisticsOf {
 public:
  explicit StatisticsOf(const Builder& builder)
      : builder_(builder), skip_(unusable(builder)), uses_(builder, skip_), orientation_(builder, uses_, skip_) {}

  [[nodiscard]] Statistics run() {
    count_positions();
    find_components();
    count_edges();
    count_vertices_and_genus();
    measure_volumes();
    return std::move(result_);
  }

 private:
  void count_positions() {
    result_.vertices = builder_.vertex_count();
    std::vector<bool> used(builder_.vertex_count(), false);
    result_.faces = builder_.face_count();
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      ++result_.face_sizes[builder_.corners(f).size()];
      if (skip_[f]) { ++result_.unusable_faces; }
      for (std::uint32_t v : builder_.corners(f)) {
        if (!skip_[f]) { used[v] = true; }
      }
    }
    std::vector<glm::dvec3> positions;
    bool first = true;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      const glm::dvec3& p = builder_.position(v);
      if (!is_finite(p)) { continue; }
      positions.push_back(p);
      if (!used[v]) { continue; }
      result_.lo = first ? p : glm::min(result_.lo, p);
      result_.hi = first ? p : glm::max(result_.hi, p);
      first = false;
    }
    result_.used_vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
    std::sort(positions.begin(), positions.end(),
              [](const auto& a, const auto& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    const auto last = std::unique(positions.begin(), positions.end());
    result_.duplicate_positions = static_cast<std::size_t>(positions.end() - last);
  }

  void find_components() {
    UnionFind sets(builder_.face_count());
    for (std::uint32_t e = 0; e < uses_.edge_count(); ++e) {
      for (const EdgeUses::Use& use : uses_.of(e).subspan(1)) { sets.unite(uses_.face(uses_.of(e)[0].corner), uses_.face(use.corner)); }
    }
    component_.assign(builder_.face_count(), invalid_index);
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      if (skip_[f]) { continue; }
      const std::uint32_t root = sets.find(f);  // the lowest number of the set: met first
      if (root == f) {
        component_[f] = static_cast<std::uint32_t>(result_.components.size());
        result_.components.push_back({});
        result_.components.back().first = FaceId{f};
      }
      component_[f] = component_[root];
      Component& c = result_.components[component_[f]];
      ++c.faces;
      if (orientation_.one_sided[orientation_.part[f]]) { c.two_sided = false; }
    }
  }

  void count_edges() {
    result_.edges = uses_.edge_count();
    for (std::uint32_t e = 0; e < uses_.edge_count(); ++e) {
      const auto all = uses_.of(e);
      Component& c = component_of(all[0].corner);
      const auto forward = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const auto& use) { return use.forward; }));
      ++c.edges;
      if (all.size() == 1) { ++c.border_edges; }
      if (all.size() > 2) { ++c.nonmanifold_edges; }
      if (forward > 1 || all.size() - forward > 1) { c.oriented = false; }
    }
    for (const Component& c : result_.components) {
      result_.border_edges += c.border_edges;
      result_.nonmanifold_edges += c.nonmanifold_edges;
      result_.oriented = result_.oriented && c.oriented;
    }
  }

  void count_vertices_and_genus() {
    const std::vector<Border> all = borders(uses_, orientation_, std::vector<bool>(builder_.vertex_count(), false));
    UnionFind fans = uses_.fans();
    join_across(fans, all, uses_);
    for (std::uint32_t corner = 0; corner < builder_.corner_count(); ++corner) {
      if (uses_.edge(corner) != invalid_index && fans.find(corner) == corner) { ++component_of(corner).vertices; }
    }
    std::vector<bool> surface(result_.components.size(), true);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      surface[i] = result_.components[i].two_sided && result_.components[i].nonmanifold_edges == 0;
    }
    for (const Border& border : all) {
      const std::uint32_t id = component_[uses_.face(border.edges.front().corner)];
      ++result_.components[id].borders;
      for (const Border::Edge& e : border.edges) {
        const std::uint32_t other = component_[uses_.face(e.corner)];
        if (border.closed && other == id) { continue; }
        surface[id] = surface[other] = false;
      }
    }
    for (std::size_t i = 0; i < surface.size(); ++i) {
      Component& c = result_.components[i];
      if (surface[i]) { c.genus = (2 - c.euler() - static_cast<long>(c.borders)) / 2; }
    }
  }

  // Divergence theorem over triangles from the first corner of each face; relative to a corner of the component, so that its
  // distance from the origin costs no digits. A volume within the rounding error is set to zero: that of a flat sheet and its back.
  void measure_volumes() {
    struct Sum {
      double terms = 0.0, sizes = 0.0, count = 0.0;
    };
    std::vector<Sum> sums(result_.components.size());
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      if (skip_[f]) { continue; }
      Sum& sum = sums[component_[f]];
      const glm::dvec3 origin = builder_.position(builder_.corners(result_.components[component_[f]].first.index)[0]);
      const auto corners = builder_.corners(f);
      const glm::dvec3 a = builder_.position(corners[0]) - origin;
      for (std::size_t k = 2; k < corners.size(); ++k) {
        const glm::dvec3 b = builder_.position(corners[k - 1]) - origin, d = builder_.position(corners[k]) - origin;
        sum.terms += glm::dot(a, glm::cross(b, d));
        sum.sizes += glm::length(a) * glm::length(b) * glm::length(d);
        sum.count += 1.0;
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      // Each term is wrong by less than 2^-49 of its product of lengths, each of the n sums by 2^-53 of the sum of all sizes.
      const double bound = (0x1p-49 + sums[i].count * 0x1p-53) * sums[i].sizes;
      Component& c = result_.components[i];
      if (c.closed() && c.oriented && std::isfinite(bound)) { c.volume = std::abs(sums[i].terms) <= bound ? 0.0 : sums[i].terms / 6.0; }
    }
  }

  Component& component_of(std::uint32_t corner) { return result_.components[component_[uses_.face(corner)]]; }

  const Builder& builder_;
  std::vector<bool> skip_;
  EdgeUses uses_;
  FlipPlan orientation_;
  std::vector<std::uint32_t> component_;  // of each face
  Statistics result_;
};

}  // namespace detail

// O(n log n) in the corners. Inserted edges count by the faces that they make.
[[nodiscard]] inline Statistics statistics(const Builder& builder) {
  if (builder.edges().empty()) { return detail::StatisticsOf(builder).run(); }
  return detail::StatisticsOf(detail::Assembler(builder).run().builder).run();
}

}  // namespace brep
