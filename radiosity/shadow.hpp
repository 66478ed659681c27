// SPDX-License-Identifier: MIT
#pragma once

// The exact form factor from a point to a polygon behind other polygons: what each blocker hides of the target, a convex cone with its tip
// in the point, is cut away from it, and Lambert's contour is taken of the convex pieces that are left. No sampling, no epsilon on angles:
// the result is continuous in the point and errs by rounding alone, some 1e-14 a blocker (compare Nishita and Nakamae 1985).
//
// Invariant: the pieces are convex, disjoint, and together they are the visible part of the target.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/small_list.hpp>
#include <radiosity/form_factor.hpp>

namespace radiosity {

// A convex polygon, without heap up to twelve corners.
class Piece {
 public:
  void push_back(const glm::dvec3& p) { corners_.push_back(p); }
  void clear() { corners_.clear(); }
  [[nodiscard]] std::size_t size() const { return corners_.size(); }
  [[nodiscard]] bool empty() const { return corners_.empty(); }
  [[nodiscard]] const glm::dvec3& operator[](std::size_t i) const { return corners_[i]; }
  [[nodiscard]] const glm::dvec3* begin() const { return corners_.begin(); }
  [[nodiscard]] const glm::dvec3* end() const { return corners_.end(); }

 private:
  brep::SmallList<glm::dvec3, 12> corners_;
};

struct HalfSpace {
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0};  // into the half-space; any length

  [[nodiscard]] double height(const glm::dvec3& p) const { return glm::dot(normal, p - point); }
};

namespace detail {

// Parts `polygon` at the plane: what lies in the half-space, border included, and the rest. An output without area may be left empty.
inline void part(std::span<const glm::dvec3> polygon, const HalfSpace& plane, Piece& inside, Piece& outside) {
  inside.clear();
  outside.clear();
  if (polygon.empty()) { return; }
  double height = plane.height(polygon[0]);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double next = plane.height(b);
    if (height >= 0.0) { inside.push_back(a); }
    if (height <= 0.0) { outside.push_back(a); }
    if ((height > 0.0 && next < 0.0) || (height < 0.0 && next > 0.0)) {
      const glm::dvec3 cut = a + (b - a) * (height / (height - next));
      inside.push_back(cut);
      outside.push_back(cut);
    }
    height = next;
  }
  if (inside.size() < 3) { inside.clear(); }
  if (outside.size() < 3) { outside.clear(); }
}

[[nodiscard]] inline bool all_outside(std::span<const glm::dvec3> polygon, const HalfSpace& plane) {
  return std::all_of(polygon.begin(), polygon.end(), [&](const glm::dvec3& p) { return plane.height(p) <= 0.0; });
}

// Cuts the common part of the half-spaces out of every piece.
inline void cut_away(std::vector<Piece>& pieces, std::span<const HalfSpace> planes) {
  const std::size_t count = pieces.size();
  std::size_t kept = 0;  // of the old ones; new ones are appended behind them
  Piece inside;
  Piece outside;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::any_of(planes.begin(), planes.end(), [&](const HalfSpace& plane) { return all_outside(pieces[i], plane); })) {
      if (kept != i) { pieces[kept] = pieces[i]; }
      ++kept;
      continue;
    }
    Piece rest = pieces[i];
    for (const HalfSpace& plane : planes) {
      part(rest, plane, inside, outside);
      if (!outside.empty()) { pieces.push_back(outside); }
      rest = inside;
      if (rest.empty()) { break; }
    }
  }
  pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(kept), pieces.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace detail

// A convex planar polygon that stops light from both sides.
struct Blocker {
  std::span<const glm::dvec3> contour;
  glm::dvec3 normal{0.0};  // unit length
};

// Asks about one target from many points; keeps its memory.
class ShadowedTarget {
 public:
  // The target turns its bright side (normal m, unit length) to the points that will ask. Distances below `slack` count as none.
  ShadowedTarget(std::span<const glm::dvec3> target, const glm::dvec3& m, std::span<const Blocker> blockers, double slack)
      : target_{target}, m_{m}, blockers_{blockers}, slack_{slack} {}

  // F from x, unit normal n, to what x sees of the target.
  [[nodiscard]] double form_factor(const glm::dvec3& x, const glm::dvec3& n) {
    const HalfSpace horizon{x, n};
    const HalfSpace before{target_[0], m_};
    detail::part(target_, horizon, first_, second_);
    pieces_.clear();
    if (!first_.empty()) { pieces_.push_back(first_); }
    for (const Blocker& blocker : blockers_) {
      if (pieces_.empty()) { return 0.0; }
      const double height = glm::dot(blocker.normal, x - blocker.contour[0]);
      if (std::abs(height) <= slack_) { continue; }  // seen edge on
      detail::part(blocker.contour, horizon, first_, second_);
      shade_ = first_;
      detail::part(shade_, before, first_, second_);
      if (first_.empty() || flat(first_, horizon) || flat(first_, before)) { continue; }
      planes_.clear();
      for (std::size_t i = 0; i < first_.size(); ++i) {
        const glm::dvec3 across = glm::cross(first_[i] - x, first_[i + 1 < first_.size() ? i + 1 : 0] - x);
        if (glm::dot(across, across) > 0.0) { planes_.push_back({x, height > 0.0 ? -across : across}); }
      }
      detail::cut_away(pieces_, planes_);
    }
    double sum = 0.0;
    for (const Piece& piece : pieces_) { sum += point_to_polygon(x, n, piece); }
    return sum;
  }

 private:
  [[nodiscard]] bool flat(const Piece& polygon, const HalfSpace& plane) const {
    return std::all_of(polygon.begin(), polygon.end(), [&](const glm::dvec3& p) { return plane.height(p) <= slack_; });
  }

  std::span<const glm::dvec3> target_;
  glm::dvec3 m_;
  std::span<const Blocker> blockers_;
  double slack_;
  std::vector<Piece> pieces_;
  std::vector<HalfSpace> planes_;
  Piece first_, second_, shade_;
};

}  // namespace radiosity
