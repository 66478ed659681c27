// SPDX-License-Identifier: MIT
#include <raycast/bvh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/inline.hpp>

namespace raycast {

HALFLIGHT_INLINE Bvh::Bvh(std::span<const Box> boxes, double item_cost) {
  if (boxes.empty()) return;
  items_.resize(boxes.size());
  std::iota(items_.begin(), items_.end(), 0u);
  nodes_.reserve(2 * boxes.size());
  Box all;
  for (const Box& b : boxes) all.extend(b);
  nodes_.push_back(Node{all, 0, static_cast<std::uint32_t>(boxes.size())});
  std::vector<std::pair<std::uint32_t, std::uint32_t>> todo{{0, 0}};  // node, depth
  while (!todo.empty()) {
    const auto [node, depth] = todo.back();
    todo.pop_back();
    if (!split(node, depth, boxes, item_cost)) continue;
    todo.push_back({nodes_[node].first, depth + 1});
    todo.push_back({nodes_[node].first + 1, depth + 1});
  }
}

HALFLIGHT_INLINE std::size_t Bvh::bin_of(const Box& box, const Box& centres, int axis) {
  const double width = centres.hi[axis] - centres.lo[axis];
  const double at = (box.centre()[axis] - centres.lo[axis]) / width * static_cast<double>(bin_count);
  return std::min(static_cast<std::size_t>(std::max(at, 0.0)), bin_count - 1);
}

HALFLIGHT_INLINE bool Bvh::split(std::uint32_t index, std::uint32_t depth, std::span<const Box> boxes, double item_cost) {
  const Node node = nodes_[index];
  if (node.count == 1) return false;
  const auto begin = items_.begin() + node.first, end = begin + node.count;
  Box centres;
  for (auto i = begin; i != end; ++i) centres.extend(boxes[*i].centre());

  int best_axis = -1;
  std::size_t best_bin = 0;
  double best = infinity;
  for (int axis = 0; axis < 3 && depth < 56; ++axis) {
    if (!(centres.lo[axis] < centres.hi[axis])) continue;
    std::array<Bin, bin_count> bins{};
    for (auto i = begin; i != end; ++i) {
      Bin& bin = bins[bin_of(boxes[*i], centres, axis)];
      bin.box.extend(boxes[*i]);
      ++bin.count;
    }
    std::array<double, bin_count> above{};  // cost of bins k, k+1, ...
    Bin sum;
    for (std::size_t k = bin_count; k-- > 1;) {
      sum.box.extend(bins[k].box);
      sum.count += bins[k].count;
      above[k] = sum.count ? sum.box.half_area() * sum.count : 0.0;
    }
    sum = Bin{};
    for (std::size_t k = 1; k < bin_count; ++k) {
      sum.box.extend(bins[k - 1].box);
      sum.count += bins[k - 1].count;
      const double cost = (sum.count ? sum.box.half_area() * sum.count : 0.0) + above[k];
      if (sum.count && sum.count < node.count && cost < best) best = cost, best_axis = axis, best_bin = k;
    }
  }
  const double area = node.box.half_area();
  if (node.count <= 4 && !(2.0 * area + item_cost * best < item_cost * area * node.count)) return false;
  auto middle = begin + node.count / 2;  // equal centres, or too deep: halves
  if (best_axis >= 0) middle = std::partition(begin, end, [&](std::uint32_t i) { return bin_of(boxes[i], centres, best_axis) < best_bin; });

  Node left{Box{}, node.first, static_cast<std::uint32_t>(middle - begin)};
  Node right{Box{}, node.first + left.count, node.count - left.count};
  for (auto i = begin; i != middle; ++i) left.box.extend(boxes[*i]);
  for (auto i = middle; i != end; ++i) right.box.extend(boxes[*i]);
  if (left.box.half_area() < right.box.half_area()) std::swap(left, right);
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[index].count = 0;
  nodes_.push_back(left);
  nodes_.push_back(right);
  return true;
}

}  // namespace raycast
