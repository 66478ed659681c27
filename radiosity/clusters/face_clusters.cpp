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

#include <raycast/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

HALFLIGHT_INLINE Grouping cluster_faces(const Surface& surface, const Hierarchy& roots, const std::vector<std::uint32_t>& numbers) {
  const auto items = static_cast<std::uint32_t>(numbers.size());
  std::vector<std::uint32_t> item_of(roots.size(), no_node);  // of the roots, and of the parts of those that have parts
  for (std::uint32_t i = 0; i < items; ++i) {
    item_of[numbers[i]] = i;
    for (std::uint32_t c = 0; c < roots[numbers[i]].child_count; ++c) { item_of[roots[numbers[i]].first_child + c] = i; }
  }
  struct Cluster {
    glm::dvec3 vector_area{0.0};
    double area = 0.0, perimeter = 0.0;
    bool live = true;
    std::vector<std::pair<std::uint32_t, double>> borders;  // neighbours, of which some have been merged since, and common lengths
  };
  std::vector<Cluster> clusters(items);
  std::vector<std::uint32_t> up(items);  // towards the cluster that holds it now
  for (std::uint32_t i = 0; i < items; ++i) {
    const Node& node = roots[numbers[i]];
    clusters[i].vector_area = node.area * node.normal;
    clusters[i].area = node.area;
    up[i] = i;
  }
  const SurfaceBRep& brep = surface.brep;
  for (const brep::FaceId f : brep::faces(brep)) {
    if (brep.data(f).sheet == brep::no_sheet) { continue; }
    const std::uint32_t own = item_of[brep.data(f).node];
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) {
      const double length = glm::length(brep.data(brep.target(h)).position - brep.data(brep.vertex(h)).position);
      const SurfaceFace& beyond = brep.data(brep.face(twin(h)));
      const std::uint32_t other = beyond.sheet == brep::no_sheet ? no_node : item_of[beyond.node];
      if (other == own) { continue; }  // between convex parts of one input face
      clusters[own].perimeter += length;
      if (other != no_node) { clusters[own].borders.push_back({other, length}); }
    }
  }
  const auto holder = [&](std::uint32_t i) {
    while (up[i] != i) { i = up[i] = up[up[i]]; }
    return i;
  };
  // Names the neighbours of today, each once.
  const auto tidy = [&](std::uint32_t i) {
    auto& borders = clusters[i].borders;
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
  };
  struct Contraction {
    double cost = 0.0;
    std::uint32_t a = 0, b = 0;
    bool operator>(const Contraction& other) const { return std::tie(cost, a, b) > std::tie(other.cost, other.a, other.b); }
  };
  std::priority_queue<Contraction, std::vector<Contraction>, std::greater<>> queue;
  const auto offer = [&](std::uint32_t a, std::uint32_t b, double common) {
    const double area = clusters[a].area + clusters[b].area;
    if (!(area > 0.0)) { return queue.push({0.0, std::min(a, b), std::max(a, b)}); }
    const double perimeter = clusters[a].perimeter + clusters[b].perimeter - 2.0 * common;
    const double bent = area - glm::length(clusters[a].vector_area + clusters[b].vector_area);
    const double drawn_out = std::max(0.0, perimeter * perimeter / (4.0 * std::numbers::pi) - area);
    queue.push({bent + drawn_out / 16.0, std::min(a, b), std::max(a, b)});
  };
  for (std::uint32_t i = 0; i < items; ++i) {
    tidy(i);
    for (const auto& [neighbour, length] : clusters[i].borders) {
      if (neighbour > i) { offer(i, neighbour, length); }
    }
  }
  Grouping result{items, {}, {}};
  while (!queue.empty()) {
    const auto [cost, a, b] = queue.top();
    queue.pop();
    if (!clusters[a].live || !clusters[b].live) { continue; }  // another offer stands for what they are now
    const auto merged = static_cast<std::uint32_t>(clusters.size());
    Cluster both;
    both.vector_area = clusters[a].vector_area + clusters[b].vector_area;
    both.area = clusters[a].area + clusters[b].area;
    double common = 0.0;
    for (const std::uint32_t part : {a, b}) {
      for (const auto& [neighbour, length] : clusters[part].borders) {
        if (part == a && holder(neighbour) == b) { common += length; }
      }
      both.borders.insert(both.borders.end(), clusters[part].borders.begin(), clusters[part].borders.end());
      clusters[part].live = false;
      clusters[part].borders = {};
      up[part] = merged;
    }
    both.perimeter = clusters[a].perimeter + clusters[b].perimeter - 2.0 * common;
    up.push_back(merged);
    clusters.push_back(std::move(both));
    tidy(merged);
    for (const auto& [neighbour, length] : clusters[merged].borders) { offer(merged, neighbour, length); }
    result.groups.push_back({a, b});
  }
  for (std::uint32_t i = 0; i < clusters.size(); ++i) {
    if (clusters[i].live) { result.tops.push_back(i); }
  }
  return result;
}

}  // namespace radiosity
