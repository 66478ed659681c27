// SPDX-License-Identifier: MIT
#include <radiosity/clusters/face_clusters.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/union_find.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

namespace detail {

// The dual graph of a boundary during contraction. Numbers are those of the Grouping.
class FaceContraction {
 public:
  FaceContraction(const Surface& surface, const Hierarchy& roots, const std::vector<std::uint32_t>& numbers)
      : items_{static_cast<std::uint32_t>(numbers.size())}, clusters_(items_), up_(items_) {
    std::vector<std::uint32_t> item_of(roots.size(), no_node);  // item of each root and of each convex part of a root
    for (std::uint32_t i = 0; i < items_; ++i) {
      const Node& node = roots[numbers[i]];
      item_of[numbers[i]] = i;
      for (std::uint32_t c = 0; c < node.child_count; ++c) { item_of[node.first_child + c] = i; }
      clusters_[i].vector_area = node.area * node.normal;
      clusters_[i].area = node.area;
      up_[i] = i;
    }
    find_borders(surface.brep, item_of);
  }

  // Contracts until no cluster has neighbours left.
  [[nodiscard]] Grouping contract() {
    for (std::uint32_t i = 0; i < items_; ++i) {
      tidy(i);
      for (const auto& [neighbour, length] : clusters_[i].borders) {
        if (neighbour > i) { offer(i, neighbour, length); }
      }
    }
    Grouping result{items_, {}, {}};
    while (!queue_.empty()) {
      const auto [cost, a, b] = queue_.top();
      queue_.pop();
      if (!clusters_[a].live || !clusters_[b].live) { continue; }  // stale: one has been merged, and its new cluster has been offered again
      const std::uint32_t merged = merge(a, b);
      for (const auto& [neighbour, length] : clusters_[merged].borders) { offer(merged, neighbour, length); }
      result.groups.push_back({a, b});
    }
    for (std::uint32_t i = 0; i < clusters_.size(); ++i) {
      if (clusters_[i].live) { result.tops.push_back(i); }
    }
    return result;
  }

 private:
  struct Cluster {
    glm::dvec3 vector_area{0.0};
    double area = 0.0, perimeter = 0.0;
    bool live = true;
    std::vector<std::pair<std::uint32_t, double>> borders;  // neighbours (some of them merged since) and lengths of the common border
  };
  struct Contraction {
    double cost = 0.0;
    std::uint32_t a = 0, b = 0;
    bool operator>(const Contraction& other) const { return std::tie(cost, a, b) > std::tie(other.cost, other.a, other.b); }
  };

  void find_borders(const SurfaceBRep& brep, const std::vector<std::uint32_t>& item_of) {
    for (const brep::FaceId f : brep::faces(brep)) {
      if (brep.data(f).sheet == brep::no_sheet) { continue; }
      const std::uint32_t own = item_of[brep.data(f).node];
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
        const double length = glm::length(brep.data(brep.target(h)).position - brep.data(brep.vertex(h)).position);
        const SurfaceFace& beyond = brep.data(brep.face(twin(h)));
        const std::uint32_t other = beyond.sheet == brep::no_sheet ? no_node : item_of[beyond.node];
        if (other == own) { continue; }  // an edge between convex parts of one input face
        clusters_[own].perimeter += length;
        if (other != no_node) { clusters_[own].borders.push_back({other, length}); }
      }
    }
  }

  // The cluster that contains i now.
  [[nodiscard]] std::uint32_t holder(std::uint32_t i) { return brep::detail::find_root(up_, i); }

  // Replaces merged neighbours by the clusters that contain them, and joins duplicates.
  void tidy(std::uint32_t i) {
    auto& borders = clusters_[i].borders;
    for (auto& [neighbour, length] : borders) { neighbour = holder(neighbour); }
    std::sort(borders.begin(), borders.end());
    std::size_t kept = 0;
    for (const auto& [neighbour, length] : borders) {
      if (neighbour == i) { continue; }
      if (kept > 0 && borders[kept - 1].first == neighbour) {
        borders[kept - 1].second += length;
      } else {
        borders[kept++] = {neighbour, length};
      }
    }
    borders.resize(kept);
  }

  void offer(std::uint32_t a, std::uint32_t b, double common) {
    const double area = clusters_[a].area + clusters_[b].area;
    if (!(area > 0.0)) { return queue_.push({0.0, std::min(a, b), std::max(a, b)}); }
    const double perimeter = clusters_[a].perimeter + clusters_[b].perimeter - 2.0 * common;
    const double bent = area - glm::length(clusters_[a].vector_area + clusters_[b].vector_area);
    const double drawn_out = std::max(0.0, perimeter * perimeter / (4.0 * std::numbers::pi) - area);
    queue_.push({bent + drawn_out / 16.0, std::min(a, b), std::max(a, b)});
  }

  // Merges two clusters; returns the number of the new one.
  std::uint32_t merge(std::uint32_t a, std::uint32_t b) {
    const auto merged = static_cast<std::uint32_t>(clusters_.size());
    Cluster both;
    both.vector_area = clusters_[a].vector_area + clusters_[b].vector_area;
    both.area = clusters_[a].area + clusters_[b].area;
    double common = 0.0;
    for (const std::uint32_t part : {a, b}) {
      for (const auto& [neighbour, length] : clusters_[part].borders) {
        if (part == a && holder(neighbour) == b) { common += length; }
      }
      both.borders.insert(both.borders.end(), clusters_[part].borders.begin(), clusters_[part].borders.end());
      clusters_[part].live = false;
      clusters_[part].borders = {};
      up_[part] = merged;
    }
    both.perimeter = clusters_[a].perimeter + clusters_[b].perimeter - 2.0 * common;
    up_.push_back(merged);
    clusters_.push_back(std::move(both));
    tidy(merged);
    return merged;
  }

  std::uint32_t items_;
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> up_;  // union-find links to the cluster that contains each one
  std::priority_queue<Contraction, std::vector<Contraction>, std::greater<>> queue_;
};

}  // namespace detail

HALFLIGHT_INLINE Grouping cluster_faces(const Surface& surface, const Hierarchy& roots, const std::vector<std::uint32_t>& numbers) {
  return detail::FaceContraction{surface, roots, numbers}.contract();
}

}  // namespace radiosity
