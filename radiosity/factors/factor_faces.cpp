// SPDX-License-Identifier: MIT
#include <radiosity/factors/factor_faces.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/exchange/exchange.hpp>
#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/visibility/polygon_shaft.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE bool hides(const Blocker& blocker, std::span<const glm::dvec3> p, std::span<const glm::dvec3> q, double slack) {
  const std::size_t n = blocker.contour.size();
  return std::all_of(p.begin(), p.end(), [&](const glm::dvec3& x) {
    const double height = glm::dot(blocker.normal, x - blocker.contour[0]);
    return std::all_of(q.begin(), q.end(), [&](const glm::dvec3& y) {
      const double other = glm::dot(blocker.normal, y - blocker.contour[0]);
      if (!(std::min(height, other) < -slack && std::max(height, other) > slack)) { return false; }
      const glm::dvec3 hit = x + (y - x) * (height / (height - other));
      for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec3& corner = blocker.contour[i];
        const glm::dvec3 side = blocker.contour[(i + 1) % n] - corner;
        if (!(glm::dot(glm::cross(side, hit - corner), blocker.normal) > slack * glm::length(side))) { return false; }
      }
      return true;
    });
  });
}

// For two faces that see each other completely: by both contours, unless they are far apart or differ much in size (exchange.hpp).
[[nodiscard]] HALFLIGHT_INLINE Estimate clear_exchange(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q) {
  const Patch a = make_patch({p.begin(), p.end()});
  const Patch b = make_patch({q.begin(), q.end()});
  const double distance = glm::length(b.centre - a.centre);
  const double extent = a.radius + b.radius;
  if (extent < 0.0997 * distance) {  // far rule with two points a side, whose error is 6 (ratio / 3)^4
    const double value = exchange(a, b);
    return {value, 1e-5 * value};
  }
  const double scale = extent + distance;
  const double smaller = std::min(a.area, b.area);
  const double value = std::clamp(contour_exchange(p, q, scale, 1e-9 * smaller), 0.0, smaller);
  return {value, 1e-9 * smaller + 1e-13 * scale * scale};
}

}  // namespace detail

HALFLIGHT_INLINE Estimate exchange(const ConvexFace& p, const ConvexFace& q, std::span<const Blocker> blockers, double slack,
                                   const IntegralLimits& limits, std::uint64_t& asked) {
  const HalfSpace above_p{p.contour[0], p.normal}, above_q{q.contour[0], q.normal};
  Piece upper_p;
  Piece upper_q;
  Piece lower;
  detail::part(p.contour, above_q, upper_p, lower);
  detail::part(q.contour, above_p, upper_q, lower);
  const auto flat = [&](const Piece& piece, const HalfSpace& plane) {
    return std::all_of(piece.begin(), piece.end(), [&](const glm::dvec3& x) { return plane.height(x) <= slack; });
  };
  if (upper_p.empty() || upper_q.empty() || flat(upper_p, above_q) || flat(upper_q, above_p)) { return {}; }
  const double area_p = glm::length(vector_area(upper_p));
  const double area_q = glm::length(vector_area(upper_q));
  if (!(area_p > slack * slack) || !(area_q > slack * slack)) { return {}; }
  const Shaft shaft{upper_p, upper_q, slack};
  std::vector<Blocker> between;
  for (const Blocker& blocker : blockers) {
    if (!shaft.misses(blocker.contour)) { between.push_back(blocker); }
  }
  if (between.empty()) { return detail::clear_exchange(upper_p, upper_q); }
  const bool over_p = area_p <= area_q;
  const Piece& domain = over_p ? upper_p : upper_q;
  const Piece& seen = over_p ? upper_q : upper_p;
  const glm::dvec3& normal = over_p ? p.normal : q.normal;
  const auto hidden = [&](std::span<const glm::dvec3> part) {
    return std::any_of(between.begin(), between.end(), [&](const Blocker& b) { return detail::hides(b, part, seen, slack); });
  };
  if (hidden(domain)) { return {}; }
  ShadowedTarget target{seen, over_p ? q.normal : p.normal, between, slack};
  const auto f = [&](const glm::dvec3& x) { return target.form_factor(x, normal); };
  const auto clear = [&](const glm::dvec3& x) { return point_to_polygon(x, normal, seen); };
  const auto certain = [&](std::span<const glm::dvec3> part) {
    if (hidden(part)) { return true; }
    const Shaft own{part, seen, slack};
    return std::all_of(between.begin(), between.end(), [&](const Blocker& b) { return own.misses(b.contour); });
  };
  return detail::Integral{domain, normal, f, clear, certain, limits}.run(asked);
}

}  // namespace radiosity
