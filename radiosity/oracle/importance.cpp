// SPDX-License-Identifier: MIT
#include <radiosity/oracle/importance.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/visibility/leaf_locator.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

namespace detail {

// Weights are reduced because a picture averages over what its points see, which removes most of the error of single leaves, and because
// nothing should change in an ordinary room, where some walls matter a few times as much as others.
inline constexpr double share_of_weight = 0.1;
inline constexpr double most_weight = 1e4;      // what is seen through a keyhole need not be resolved further
inline constexpr std::uint32_t few_points = 4;  // so few points in a node are not significant
inline constexpr double uneven_part = 0.25;     // relative to the area of the node

// Sums over the points in a node.
struct PointSums {
  std::uint32_t count = 0;
  double weight = 0.0, squares = 0.0;
  glm::dvec3 places{0.0};
  void add(const ImportantPoint& point) {
    ++count;
    weight += point.weight;
    places += point.weight * point.at.position;
    squares += point.weight * glm::dot(point.at.position, point.at.position);
  }
  // Area of a disk over which uniform points would have the same variance; twice the true area for points spread over a square.
  [[nodiscard]] double area() const {
    const glm::dvec3 mean = places / weight;
    return 4.0 * std::numbers::pi * std::max(0.0, squares / weight - glm::dot(mean, mean));
  }
};

}  // namespace detail

HALFLIGHT_INLINE Importance::Importance(std::vector<ImportantPoint> points, double contrast, double area, std::size_t surfaces)
    : points_{std::move(points)}, contrast_{contrast}, surfaces_{surfaces} {
  double total = 0.0;
  for (const ImportantPoint& point : points_) { total += point.weight; }
  scale_ = total > 0.0 ? detail::share_of_weight * contrast * area / total : 0.0;
}

HALFLIGHT_INLINE void Importance::extend(const Hierarchy& hierarchy, const Patches& patches) {
  const std::size_t known = nodes_.size();
  if (!(scale_ > 0.0) || known == hierarchy.size()) { return; }
  const LeafLocator leaf_of{hierarchy, patches, surfaces_};
  std::vector<detail::PointSums> sums(hierarchy.size() - known);
  for (const ImportantPoint& point : points_) {
    const std::uint32_t leaf = leaf_of(point.surface, point.at);
    if (leaf != no_node && leaf >= known) { sums[leaf - known].add(point); }
  }
  nodes_.resize(hierarchy.size());
  for (std::size_t i = known; i < nodes_.size(); ++i) {
    const Node& node = hierarchy[i];
    const detail::PointSums& own = sums[i - known];
    if (node.is_cluster() || !(node.area > 0.0)) { continue; }
    Of& of = nodes_[i];
    of.mean = scale_ * own.weight / node.area;
    if (own.count < detail::few_points) {  // use the density of the parent; on an input face, zero
      of.mean = node.parent != no_node && !is_input_face(hierarchy, i) ? nodes_[node.parent].mean : 0.0;
      of.weight = std::clamp(of.mean, 1.0, detail::most_weight);
      continue;
    }
    const double part = std::min(node.area, std::max(own.area(), 1e-6 * node.area));
    of.weight = std::clamp(scale_ * own.weight / part, 1.0, detail::most_weight);
    of.uneven = of.weight > 1.0 && part < detail::uneven_part * node.area;
  }
  const auto counts = [](const Of& of) { return of.weight > 1.0; };
  if (known == 0 && std::none_of(nodes_.begin(), nodes_.end(), counts)) { *this = {}; }
}

}  // namespace radiosity
