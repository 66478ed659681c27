// SPDX-License-Identifier: MIT
#pragma once

// A planar polygon seen in its own plane: where may it be cut by a diagonal, and which diagonal is the best?
//
// A hole is reached by a bridge edge, on which the outline runs there and back; so corners may coincide where the outline passes
// a point several times without crossing itself.
//
// Used by the face splits of split.hpp and t_vertices.hpp. Coordinates are relative to the first corner; an area counts as
// zero up to 1e-14 times the square of the polygon's extent, some ten times the rounding error of the test.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/polygon.hpp>
#include <brep/small_list.hpp>

namespace brep {

class Outline {
 public:
  using Diagonal = std::pair<std::size_t, std::size_t>;

  // Projects p along its normal; it runs counter-clockwise in the result. Without area all points coincide.
  explicit Outline(Polygon p) : Outline(p, normal(p)) {}
  // Projects p along this normal. If it is zero, all points coincide.
  Outline(Polygon p, const glm::dvec3& n) {
    const glm::dvec3 across = std::abs(n.x) < 0.6 ? glm::dvec3{1.0, 0.0, 0.0} : glm::dvec3{0.0, 1.0, 0.0};
    const glm::dvec3 v = glm::cross(n, across), u = glm::cross(v, n);
    const double unit = glm::length(v) > 0.0 ? 1.0 / glm::length(v) : 0.0;
    for (const glm::dvec3& x : p) { points_.push_back(unit * glm::dvec2{glm::dot(x - p[0], u), glm::dot(x - p[0], v)}); }
    const double size = extent(p);
    tolerance_ = 1e-14 * size * size;
  }

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] const glm::dvec2& operator[](std::size_t i) const { return points_[i]; }
  [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 < size() ? i + 1 : 0; }
  [[nodiscard]] std::size_t prev(std::size_t i) const { return i > 0 ? i - 1 : size() - 1; }

  // Of the triangle of three corners; positive when they run counter-clockwise. Up to the tolerance it counts as zero.
  [[nodiscard]] double twice_area(std::size_t a, std::size_t b, std::size_t c) const {
    return cross(points_[b] - points_[a], points_[c] - points_[a]);
  }
  [[nodiscard]] double tolerance() const { return tolerance_; }

  // 1 when c lies left of the line a -> b, -1 when it lies right, 0 when on it within rounding.
  [[nodiscard]] int side(std::size_t a, std::size_t b, std::size_t c) const {
    const double area = twice_area(a, b, c);
    return area > tolerance_ ? 1 : area < -tolerance_ ? -1 : 0;
  }

  // How far the outline turns left at corner i, in (-pi, pi]: negative at a non-convex corner, 0 where it is straight.
  [[nodiscard]] double turn(std::size_t i) const {
    const glm::dvec2 in = points_[i] - points_[prev(i)], out = points_[next(i)] - points_[i];
    return std::atan2(cross(in, out), glm::dot(in, out));
  }

  // Does the segment from corner i to corner j lie inside, touch the outline nowhere but at these two points, and cut two areas that are
  // not zero? Other corners may coincide with these two (the ends of a bridge): there the angles of the polygon at i and j decide.
  [[nodiscard]] bool inner_diagonal(std::size_t i, std::size_t j) const {
    if (i == j || next(i) == j || next(j) == i || !in_cone(i, j) || !in_cone(j, i)) { return false; }
    const auto at_end = [&](std::size_t k) { return points_[k] == points_[i] || points_[k] == points_[j]; };
    for (std::size_t k = 0; k < size(); ++k) {
      if (!at_end(k) && !at_end(next(k)) && touch(i, j, k, next(k))) { return false; }
    }
    return true;
  }

  // Do two edges touch that are not neighbours, except for bridges and coinciding corners around a hole, or does the outline turn back on
  // itself? Then one of the corners.
  // O(n log n) for reasonable outlines (sweep along x), O(n^2) at worst.
  [[nodiscard]] std::optional<std::size_t> self_contact() const {
    std::vector<std::size_t> order(size());
    for (std::size_t k = 0; k < size(); ++k) {
      order[k] = k;
      const glm::dvec2 in = points_[k] - points_[prev(k)], out = points_[next(k)] - points_[k];
      if (out == glm::dvec2{0.0} || (side(prev(k), k, next(k)) == 0 && glm::dot(in, out) < 0.0)) { return k; }
    }
    const auto lo = [&](std::size_t k) { return std::min(points_[k].x, points_[next(k)].x); };
    const auto hi = [&](std::size_t k) { return std::max(points_[k].x, points_[next(k)].x); };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return lo(a) < lo(b); });
    for (std::size_t a = 0; a < size(); ++a) {
      for (std::size_t b = a + 1; b < size() && lo(order[b]) <= hi(order[a]); ++b) {
        const std::size_t k = order[a], l = order[b];
        if (next(k) != l && next(l) != k && touch(k, next(k), l, next(l)) && !legal_contact(k, l)) { return k; }
      }
    }
    return std::nullopt;
  }

  // The inner diagonal whose worse part is best proportioned, among those that start at `from`, or among all without it.
  // Proportion is measured by 4 pi area / perimeter^2, which needs no more than running sums.
  [[nodiscard]] std::optional<Diagonal> best_diagonal(std::optional<std::size_t> from = std::nullopt) const {
    std::vector<double> area(size() + 1, 0.0), length(size() + 1, 0.0);
    for (std::size_t k = 0; k < size(); ++k) {
      area[k + 1] = area[k] + 0.5 * cross(points_[k], points_[next(k)]);
      length[k + 1] = length[k] + glm::distance(points_[k], points_[next(k)]);
    }
    struct Candidate {
      double score;
      Diagonal diagonal;
    };
    std::vector<Candidate> candidates;
    const auto add = [&](std::size_t i, std::size_t j) {  // i < j
      const double chord = glm::distance(points_[i], points_[j]);
      const double first = area[j] - area[i] + 0.5 * cross(points_[j], points_[i]), second = area[size()] - first;
      const double a = length[j] - length[i] + chord, b = length[size()] - length[j] + length[i] + chord;
      const double score = std::min(first / (a * a), second / (b * b));
      if (score > 0.0) { candidates.push_back({score, {i, j}}); }
    };
    for (std::size_t i = 0; i < size(); ++i) {
      if (from && i != *from) {
        add(std::min(i, *from), std::max(i, *from));
      } else if (!from) {
        for (std::size_t j = i + 2; j < size(); ++j) { add(i, j); }
      }
    }
    const auto worse = [](const Candidate& a, const Candidate& b) {
      return a.score != b.score ? a.score < b.score : a.diagonal > b.diagonal;
    };
    std::make_heap(candidates.begin(), candidates.end(), worse);
    while (!candidates.empty()) {
      std::pop_heap(candidates.begin(), candidates.end(), worse);
      const Diagonal best = candidates.back().diagonal;
      if (inner_diagonal(best.first, best.second)) { return best; }
      candidates.pop_back();
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] static double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

  // Does corner j lie strictly inside the angle of the polygon at corner i?
  [[nodiscard]] bool in_cone(std::size_t i, std::size_t j) const {
    const int after = side(i, next(i), j), before = side(prev(i), i, j);
    return side(prev(i), i, next(i)) >= 0 ? after > 0 && before > 0 : after > 0 || before > 0;
  }
  // Do the segments a-b and c-d have a point in common?
  [[nodiscard]] bool touch(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    const int c_side = side(a, b, c), d_side = side(a, b, d), a_side = side(c, d, a), b_side = side(c, d, b);
    if (c_side == 0 && d_side == 0) {  // on one line: compare along it
      const glm::dvec2 along = points_[b] - points_[a];
      const double end = glm::dot(along, along);
      const double s = glm::dot(points_[c] - points_[a], along), t = glm::dot(points_[d] - points_[a], along);
      return std::max(s, t) >= 0.0 && std::min(s, t) <= end;
    }
    return c_side * d_side <= 0 && a_side * b_side <= 0;
  }

  // The edges k and l touch. Is that harmless: do only corners coincide, and does neither enter the angle of the other? Edges that overlap
  // and are not the two sides of a bridge need no test of their own: a neighbour of theirs touches too, unless the outline runs twice
  // along the same points.
  [[nodiscard]] bool legal_contact(std::size_t k, std::size_t l) const {
    const std::size_t m = next(k), n = next(l);
    bool coincide = false;
    for (const auto& [i, j] : {Diagonal{k, l}, Diagonal{k, n}, Diagonal{m, l}, Diagonal{m, n}}) {
      if (points_[i] != points_[j]) { continue; }
      if (in_cone(i, next(j)) || in_cone(i, prev(j)) || in_cone(j, next(i)) || in_cone(j, prev(i))) { return false; }
      coincide = true;
    }
    return coincide && (points_[k] != points_[l] || points_[m] != points_[n]);
  }

  SmallList<glm::dvec2> points_;
  double tolerance_ = 0.0;
};

}  // namespace brep
