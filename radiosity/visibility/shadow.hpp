// SPDX-License-Identifier: MIT
#pragma once

// The exact form factor from a point to a polygon behind other polygons: the part of the target that each blocker hides, a convex cone
// with its apex at the point, is cut away, and Lambert's contour integral is applied to the remaining convex pieces. There is no sampling
// and no tolerance on angles, so the result is continuous in the point and has only rounding errors, some 1e-14 per blocker (compare
// Nishita and Nakamae 1985).
//
// Invariant: the pieces are convex, disjoint, and together they are the visible part of the target.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/small_list.hpp>

namespace radiosity {

// A convex polygon; needs no heap memory up to twelve corners.
class Piece {
 public:
  void push_back(const glm::dvec3& p) {
    corners_.push_back(p);
    square_of_radius_ = -1.0;
  }
  void clear() {
    corners_.clear();
    square_of_radius_ = -1.0;
  }
  // A bounding sphere for quick tests: the mean of the corners, and the squared largest distance of a corner. Negative if bound() has not
  // been called since the last corner was added.
  [[nodiscard]] const glm::dvec3& centre() const { return centre_; }
  [[nodiscard]] double square_of_radius() const { return square_of_radius_; }
  void bound() {
    glm::dvec3 sum{0.0};
    for (const glm::dvec3& p : corners_) { sum += p; }
    centre_ = sum / static_cast<double>(corners_.size());
    square_of_radius_ = 0.0;
    for (const glm::dvec3& p : corners_) { square_of_radius_ = std::max(square_of_radius_, glm::dot(p - centre_, p - centre_)); }
  }
  [[nodiscard]] std::size_t size() const { return corners_.size(); }
  [[nodiscard]] bool empty() const { return corners_.empty(); }
  [[nodiscard]] const glm::dvec3& operator[](std::size_t i) const { return corners_[i]; }
  [[nodiscard]] const glm::dvec3* begin() const { return corners_.begin(); }
  [[nodiscard]] const glm::dvec3* end() const { return corners_.end(); }

 private:
  brep::SmallList<glm::dvec3, 12> corners_;
  glm::dvec3 centre_{0.0};
  double square_of_radius_ = -1.0;
};

struct HalfSpace {
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0};  // points into the half-space; of any length

  [[nodiscard]] double height(const glm::dvec3& p) const { return glm::dot(normal, p - point); }
};

namespace detail {

// Splits `polygon` at the plane, into the part in the half-space, border included, and the rest. A part without area may come out empty.
void part(std::span<const glm::dvec3> polygon, const HalfSpace& plane, Piece& inside, Piece& outside);

// Cuts the intersection of the half-spaces out of every piece. Faster for pieces with a bounding sphere.
void cut_away(std::vector<Piece>& pieces, std::span<const HalfSpace> planes);

}  // namespace detail

// A convex planar polygon that blocks light from both sides.
struct Blocker {
  std::span<const glm::dvec3> contour;
  glm::dvec3 normal{0.0};  // unit length
};

// Evaluates one target from many points; reuses its memory.
class ShadowedTarget {
 public:
  // The target shows its front (normal m, unit length) to the points. Distances below `slack` count as zero.
  ShadowedTarget(std::span<const glm::dvec3> target, const glm::dvec3& m, std::span<const Blocker> blockers, double slack)
      : target_{target}, m_{m}, blockers_{blockers}, slack_{slack} {}

  // F from x, with unit normal n, to the visible part of the target.
  [[nodiscard]] double form_factor(const glm::dvec3& x, const glm::dvec3& n);

  // The same in three steps, for other kinds of blockers. First: sets the view from x, with all of the target above the horizon.
  void look(const glm::dvec3& x, const glm::dvec3& n);
  // Second, for each blocker: removes what a polygon hides, or what lies within all of these planes through x.
  void hide(const Blocker& blocker) { hide(shadow_of(blocker)); }
  void hide(std::span<const HalfSpace> cone) {
    if (!cone.empty()) { detail::cut_away(pieces_, cone); }
  }
  // The planes through x between which the blocker hides the target; none if it hides nothing of it. Valid until the next call.
  [[nodiscard]] std::span<const HalfSpace> shadow_of(const Blocker& blocker);
  // Is it certain that nothing within this sphere hides a part of the target?
  [[nodiscard]] bool misses(const glm::dvec3& centre, double radius) const;
  [[nodiscard]] bool hidden() const { return pieces_.empty(); }
  [[nodiscard]] std::span<const Piece> pieces() const { return pieces_; }
  // Third: the form factor of the rest.
  [[nodiscard]] double form_factor() const;

 private:
  [[nodiscard]] bool flat(const Piece& polygon, const HalfSpace& plane) const {
    return std::all_of(polygon.begin(), polygon.end(), [&](const glm::dvec3& p) { return plane.height(p) <= slack_; });
  }

  std::span<const glm::dvec3> target_;
  glm::dvec3 m_;
  std::span<const Blocker> blockers_;
  double slack_;
  HalfSpace horizon_;
  std::vector<Piece> pieces_;
  std::vector<HalfSpace> planes_;
  std::vector<HalfSpace> sides_;  // planes through the point and the edges of the visible target, which is on their inner side
  Piece first_, second_, shade_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/visibility/shadow.cpp>
#endif
