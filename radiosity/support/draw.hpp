// SPDX-License-Identifier: MIT
#pragma once

// Draws one of several elements, each with probability proportional to a weight, and a point of a triangle, uniformly by area.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace radiosity {

// The first element whose cumulated weight exceeds `at`, in [0, sum of weights); `until`: the cumulated weights, each up to and including
// its element. By rounding `at` may reach the sum; then it is the last element.
[[nodiscard]] inline std::size_t drawn_index(std::span<const double> until, double at) {
  return static_cast<std::size_t>(std::upper_bound(until.begin(), until.end() - 1, at) - until.begin());
}

// The same for elements with a member `until`.
template <class Elements>
[[nodiscard]] const auto& drawn(const Elements& elements, double at) {
  const auto exceeds = [](double value, const auto& element) { return value < element.until; };
  return *std::upper_bound(elements.begin(), elements.end() - 1, at, exceeds);
}

[[nodiscard]] inline double triangle_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

// The weights of a triangle's corners (barycentric coordinates) at a point that is uniform by area if u and v are uniform in [0, 1).
[[nodiscard]] inline glm::dvec3 triangle_weights(double u, double v) {
  const double root = std::sqrt(u);
  return {1.0 - root, root * (1.0 - v), root * v};
}

// The point of a triangle with these weights.
[[nodiscard]] inline glm::dvec3 triangle_point(const glm::dvec3& weights, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return weights.x * a + weights.y * b + weights.z * c;
}

}  // namespace radiosity
