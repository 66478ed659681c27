// SPDX-License-Identifier: MIT
#pragma once

// Triangles of any polygon, planar or not. It is looked at along its mean normal (Newell), and the best ear is cut off again and again
// (Meisters 1975): the one of which the worse of ear and rest has the best shape, tilt against the mean normal included. So a
// quadrilateral is cut along the better of its two diagonals. A polygon that crosses itself, or comes within rounding of itself, runs out
// of ears: then the best corner is cut off although others lie in its triangle, and some triangle is turned over in the end. Where that has
// area, the triangles that overlap least are taken instead.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/least_overlap.hpp>
#include <brep/outline.hpp>
#include <brep/polygon.hpp>

namespace brep {
namespace detail {

// 1 for an equilateral triangle that looks along the normal, 0 or less for one without area or that looks away.
inline double shape(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& normal) {
  const double sides = glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(a - c, a - c);
  return sides > 0.0 ? 2.0 * std::sqrt(3.0) * glm::dot(glm::cross(b - a, c - a), normal) / sides : 0.0;
}

class EarClipper {
 public:
  explicit EarClipper(std::span<const glm::dvec3> polygon) : polygon_(polygon), normal_(normal(polygon)) {
    const auto n = static_cast<std::uint32_t>(polygon.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      before_.push_back(i == 0 ? n - 1 : i - 1);
      after_.push_back(i + 1 == n ? 0 : i + 1);
    }
    score_.resize(n);
  }

  std::vector<std::array<std::uint32_t, 3>> run() {
    auto left = static_cast<std::uint32_t>(polygon_.size());
    for (std::uint32_t i = 0; i < left; ++i) { score_[i] = score(i); }
    for (std::uint32_t start = 0; left > 3; --left) {
      std::uint32_t best = best_from(start);
      if (!(score_[best] > 0.0)) {  // corners that were not ears may have become ears when others went
        std::uint32_t i = start;
        do { score_[i] = score(i); } while ((i = after_[i]) != start);
        best = best_from(start);
      }
      triangles_.push_back({before_[best], best, after_[best]});
      after_[before_[best]] = after_[best];
      before_[after_[best]] = before_[best];
      start = before_[best];
      score_[start] = score(start);
      score_[after_[start]] = score(after_[start]);
      start_ = start;
    }
    const std::uint32_t i = start_;
    triangles_.push_back({before_[i], i, after_[i]});
    return std::move(triangles_);
  }

 private:
  [[nodiscard]] std::uint32_t best_from(std::uint32_t start) const {
    std::uint32_t best = start;
    for (std::uint32_t i = after_[start]; i != start; i = after_[i]) {
      if (score_[i] > score_[best]) { best = i; }
    }
    return best;
  }
  // How good it is to cut the corner off; at most 0 where it is no ear.
  [[nodiscard]] double score(std::uint32_t i) const {
    const std::uint32_t b = before_[i], a = after_[i];
    const double ear = shape(polygon_[b], polygon_[i], polygon_[a], normal_);
    if (!(ear > 0.0)) { return ear - 2.0; }
    for (std::uint32_t k = after_[a]; k != b; k = after_[k]) {
      if (holds(b, i, a, k)) { return ear - 1.0; }
    }
    // The corners beside the cut become sharper: what is left there counts, too.
    const double rest = std::min(shape(polygon_[before_[b]], polygon_[b], polygon_[a], normal_),
                                 shape(polygon_[b], polygon_[a], polygon_[after_[a]], normal_));
    return std::max(std::min(ear, rest), 1e-3 * ear);
  }
  // Does the triangle hold a corner, or have it on its border, in another place than its own corners?
  [[nodiscard]] bool holds(std::uint32_t b, std::uint32_t i, std::uint32_t a, std::uint32_t k) const {
    const glm::dvec3 &p = polygon_[k], &u = polygon_[b], &v = polygon_[i], &w = polygon_[a];
    if (p == u || p == v || p == w) { return false; }
    const auto side = [&](const glm::dvec3& from, const glm::dvec3& to) { return glm::dot(glm::cross(to - from, p - from), normal_); };
    return side(u, v) >= 0.0 && side(v, w) >= 0.0 && side(w, u) >= 0.0;
  }

  std::span<const glm::dvec3> polygon_;
  glm::dvec3 normal_{0.0};
  std::vector<std::uint32_t> before_, after_;
  std::vector<double> score_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::uint32_t start_ = 0;
};

}  // namespace detail

// Corners of the triangles, as indices into `polygon`, which has at least 3 corners; n - 2 of them, some perhaps without area. O(n^2)
// as a rule.
// When all of them turn as the polygon does, they cover each of its points once. A planar polygon that is simple, or would be if its
// corners moved by a rounding, is cut so, except for rounding.
[[nodiscard]] inline std::vector<std::array<std::uint32_t, 3>> ears(std::span<const glm::dvec3> polygon) {
  std::vector<std::array<std::uint32_t, 3>> result = detail::EarClipper(polygon).run();
  if (polygon.size() < 4 || polygon.size() > most_corners_of_least_overlap) { return result; }
  const Outline outline(polygon);
  const auto turned_over = [&](const auto& t) { return outline.side(t[0], t[1], t[2]) < 0; };
  return std::any_of(result.begin(), result.end(), turned_over) ? least_overlap(outline) : result;
}

}  // namespace brep
