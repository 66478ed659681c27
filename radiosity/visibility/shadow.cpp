// SPDX-License-Identifier: MIT
#include <radiosity/visibility/shadow.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/tolerances.hpp>

#include <radiosity/geometry/form_factor.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE void part(std::span<const glm::dvec3> polygon, const HalfSpace& plane, Piece& inside, Piece& outside) {
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

[[nodiscard]] HALFLIGHT_INLINE bool all_outside(std::span<const glm::dvec3> polygon, const HalfSpace& plane) {
  return std::all_of(polygon.begin(), polygon.end(), [&](const glm::dvec3& p) { return plane.height(p) <= 0.0; });
}

[[nodiscard]] HALFLIGHT_INLINE bool all_inside(std::span<const glm::dvec3> polygon, const HalfSpace& plane) {
  return std::all_of(polygon.begin(), polygon.end(), [&](const glm::dvec3& p) { return plane.height(p) >= 0.0; });
}

// The side of a plane on which a piece lies, according to its bounding sphere: 1 inside, -1 outside, 0 unknown.
[[nodiscard]] HALFLIGHT_INLINE int side_of_sphere(const Piece& piece, const HalfSpace& plane) {
  constexpr double rounding = 1.0 + 1e-9;  // of heights and radii
  if (piece.square_of_radius() < 0.0) { return 0; }
  const double height = plane.height(piece.centre());
  if (!(height * height > rounding * piece.square_of_radius() * glm::dot(plane.normal, plane.normal))) { return 0; }
  return height > 0.0 ? 1 : -1;
}

[[nodiscard]] HALFLIGHT_INLINE bool any_outside(const Piece& piece, std::span<const HalfSpace> planes) {
  return std::any_of(planes.begin(), planes.end(), [&](const HalfSpace& plane) {
    const int side = side_of_sphere(piece, plane);
    return side < 0 || (side == 0 && all_outside(piece, plane));
  });
}

HALFLIGHT_INLINE void cut_away(std::vector<Piece>& pieces, std::span<const HalfSpace> planes) {
  const std::size_t count = pieces.size();
  std::size_t kept = 0;  // number of old pieces kept; new ones are appended behind them
  Piece buffer[2];
  for (std::size_t i = 0; i < count; ++i) {
    if (any_outside(pieces[i], planes)) {
      if (kept != i) { pieces[kept] = pieces[i]; }
      ++kept;
      continue;
    }
    // A piece that lies outside the intersection, but near one of its corners, is recognised only when nothing remains inside: it is then
    // kept as a whole, because every piece slows down all further blockers.
    const std::size_t before = pieces.size(), most = before + planes.size();
    if (pieces.capacity() < most) { pieces.reserve(2 * most); }  // so that pieces are not reallocated
    const Piece* rest = &pieces[i];
    for (const HalfSpace& plane : planes) {
      if (all_inside(*rest, plane)) { continue; }
      Piece& inside = buffer[rest == &buffer[0] ? 1 : 0];
      Piece& outside = pieces.emplace_back();
      part(*rest, plane, inside, outside);
      if (outside.empty()) {
        pieces.pop_back();
      } else {
        outside.bound();
      }
      rest = &inside;
      if (rest->empty()) { break; }
    }
    if (!rest->empty()) { continue; }
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(before), pieces.end());
    if (kept != i) { pieces[kept] = pieces[i]; }
    ++kept;
  }
  pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(kept), pieces.begin() + static_cast<std::ptrdiff_t>(count));
}

// Appends the planes through x and the edges of a convex polygon, with normals oriented so that `within` holds for them. Where a polygon
// was cut at a corner that lies on the cut up to rounding, two equal corners may result; the edge between them has no direction and is
// skipped.
template <class Within>
void planes_through(const glm::dvec3& x, const Piece& polygon, const Within& within, std::vector<HalfSpace>& planes) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i] - x, b = polygon[i + 1 < polygon.size() ? i + 1 : 0] - x, across = glm::cross(a, b);
    const bool same = glm::dot(b - a, b - a) <= raycast::tol_edge * raycast::tol_edge * (glm::dot(x, x) + glm::dot(a, a));
    if (!same && glm::dot(across, across) > 0.0) { planes.push_back({x, within(across) ? across : -across}); }
  }
}

}  // namespace detail

HALFLIGHT_INLINE void ShadowedTarget::look(const glm::dvec3& x, const glm::dvec3& n) {
  horizon_ = {x, n};
  detail::part(target_, horizon_, first_, second_);
  pieces_.clear();
  sides_.clear();
  if (first_.empty()) { return; }
  first_.bound();
  pieces_.push_back(first_);
  const auto within = [&](const glm::dvec3& normal) { return glm::dot(normal, first_.centre() - x) >= 0.0; };
  detail::planes_through(x, first_, within, sides_);
}

HALFLIGHT_INLINE std::span<const HalfSpace> ShadowedTarget::shadow_of(const Blocker& blocker) {
  const glm::dvec3& x = horizon_.point;
  const HalfSpace before{target_[0], m_};
  const double height = glm::dot(blocker.normal, x - blocker.contour[0]);
  if (std::abs(height) <= slack_) { return {}; }  // seen edge-on
  const auto beside = [&](const HalfSpace& side) { return detail::all_outside(blocker.contour, side); };
  if (std::any_of(sides_.begin(), sides_.end(), beside)) { return {}; }
  detail::part(blocker.contour, horizon_, first_, second_);
  shade_ = first_;
  detail::part(shade_, before, first_, second_);
  if (first_.empty() || flat(first_, horizon_) || flat(first_, before)) { return {}; }
  planes_.clear();
  const auto within = [&](const glm::dvec3&) { return height <= 0.0; };
  detail::planes_through(x, first_, within, planes_);
  return planes_;
}

HALFLIGHT_INLINE bool ShadowedTarget::misses(const glm::dvec3& centre, double radius) const {
  constexpr double rounding = 1.0 + 1e-9;  // of heights and radii
  const auto outside = [&](const HalfSpace& side) {
    const double height = side.height(centre);
    return height < 0.0 && height * height > rounding * radius * radius * glm::dot(side.normal, side.normal);
  };
  return outside(horizon_) || std::any_of(sides_.begin(), sides_.end(), outside);
}

HALFLIGHT_INLINE double ShadowedTarget::form_factor() const {
  double sum = 0.0;
  for (const Piece& piece : pieces_) { sum += point_to_polygon(horizon_.point, horizon_.normal, piece); }
  return sum;
}

HALFLIGHT_INLINE double ShadowedTarget::form_factor(const glm::dvec3& x, const glm::dvec3& n) {
  look(x, n);
  for (const Blocker& blocker : blockers_) {
    if (hidden()) { return 0.0; }
    hide(blocker);
  }
  return form_factor();
}

}  // namespace radiosity
