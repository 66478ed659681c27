// SPDX-License-Identifier: MIT
#include <raycast/objects/superquadric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/roots.hpp>
#include <raycast/spans.hpp>
#include <raycast/superellipse.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

HALFLIGHT_INLINE Made<Superquadric> Superquadric::make(const glm::dvec3& centre, const glm::dvec3& radii, double profile, double around,
                                                       double ring) {
  if (!usable(centre) || !usable(radii)) { return "a superquadric's centre and radii must be finite (and below 1e60)"; }
  const double largest = std::max({radii.x, radii.y, radii.z});
  for (int k = 0; k < 3; ++k) {
    if (!usable_length(radii[k], Box{centre, centre}.magnitude()) || !(radii[k] >= thinnest_superquadric * largest)) {
      return "a superquadric's radii must be positive, finite, not vanishing beside its centre's coordinates and within 1e6 of each "
             "other";
    }
  }
  if (!(profile >= 0.001 && profile <= 10.0) || !(around >= 0.001 && around <= 10.0)) {
    return "a superquadric's exponents must lie between 0.001 (a box) and 10 (blades; above, both their sides are one for rounding)";
  }
  if (ring != 0.0 && !(ring > 1.0 && ring <= 1e4)) {
    return "a superquadric's ring must be 0 (no hole) or lie between 1 and 10000: up to 1 the surface passes through itself";
  }
  return std::shared_ptr<const Superquadric>(new Superquadric(centre, radii, profile, around, ring));
}

HALFLIGHT_INLINE Box Superquadric::bounds() const {
  const glm::dvec3 half = radii_ * limit_;
  const Box box{centre_ - half, centre_ + half};
  return box.grown(eps_bounds * box.magnitude());
}

HALFLIGHT_INLINE void Superquadric::spans(const Segment& line, Spans& out) const {
  const double shift = nearest_parameter(line, centre_);
  const glm::dvec3 d = line.direction / radii_;
  const double length = glm::length(d);
  glm::dvec3 e = d / length, f = (line.at(shift) - centre_) / radii_;
  const double again = -glm::dot(f, e);
  f += again * e;
  double lo = -infinity, hi = infinity;
  for (int k = 0; k < 3; ++k) {
    if (e[k] == 0.0) {
      if (std::abs(f[k]) > limit_[k]) { return; }
      continue;
    }
    const double forward = std::copysign(limit_[k], e[k]);
    lo = std::max(lo, (-forward - f[k]) / e[k]);
    hi = std::min(hi, (forward - f[k]) / e[k]);
  }
  clip_pinched(f, e, lo, hi);
  if (!(lo < hi)) { return; }
  Cut cuts;
  if (convex()) {
    cut_convex(f, e, lo, hi, cuts);
  } else {
    cut_pieces(f, e, lo, hi, cuts);
  }
  for (const auto& [in, leave] : cuts) {
    const auto t = [&](double s) { return shift + (again + s) / length; };
    out.push(Span{{t(in), 0}, {t(leave), 0}});
  }
}

HALFLIGHT_INLINE void Superquadric::clip_pinched(const glm::dvec3& f, const glm::dvec3& e, double& lo, double& hi) const {
  const double limit = (1.0 + ring_) * (1.0 + tol_hull);
  const auto slab = [&](const glm::dvec3& n) {
    const double at = glm::dot(n, f), rate = glm::dot(n, e);
    if (rate == 0.0) {
      if (std::abs(at) > limit) { hi = lo; }
      return;
    }
    const double forward = std::copysign(limit, rate);
    lo = std::max(lo, (-forward - at) / rate);
    hi = std::min(hi, (forward - at) / rate);
  };
  const bool around = !around_.convex(), profile = !profile_.convex();
  for (const double sign : {-1.0, 1.0}) {
    if (around) { slab({1.0, sign, 0.0}); }
    if (around && profile) {
      slab({1.0, sign, 1.0});
      slab({1.0, sign, -1.0});
    } else if (profile) {
      slab({1.0, 0.0, sign});
      slab({0.0, 1.0, sign});
    }
  }
}

HALFLIGHT_INLINE SurfacePoint Superquadric::project(std::uint32_t, const glm::dvec3& p) const {
  glm::dvec3 sign{1.0}, f = p - centre_;  // the nearest point lies in the octant of p
  for (int k = 0; k < 3; ++k) {
    sign[k] = std::signbit(f[k]) ? -1.0 : 1.0;
    f[k] = std::abs(f[k]);
  }
  const glm::dvec3 x = nearest_to(f, off_blade * radii_);
  return {centre_ + sign * x, sign * normal(x)};
}

HALFLIGHT_INLINE glm::dvec3 Superquadric::vertex(std::uint32_t, const glm::dvec3& p) const {
  const double in_plane = tol_symmetry * (std::max({radii_.x, radii_.y, radii_.z}) + Box{centre_, centre_}.magnitude());
  glm::dvec3 sign{1.0}, f = p - centre_, least = off_blade * radii_;
  for (int k = 0; k < 3; ++k) {
    sign[k] = std::signbit(f[k]) ? -1.0 : 1.0;
    f[k] = std::abs(f[k]);
    if (f[k] <= in_plane) { f[k] = least[k] = 0.0; }
  }
  return centre_ + sign * nearest_to(f, least);
}

HALFLIGHT_INLINE glm::dvec3 Superquadric::nearest_to(const glm::dvec3& f, const glm::dvec3& least) const {
  glm::dvec3 x = onto(f);
  double distance = glm::length(f - x);
  const auto take_if_nearer = [&](const glm::dvec3& next) {
    const double there = glm::length(f - next);
    if (!(there < distance)) { return false; }
    x = next;
    distance = there;
    return true;
  };
  take_if_nearer(settle(f, 0.0));
  const bool pinched = !around_.convex() || !profile_.convex();
  const double kept = pinched ? 0.1 : 0.0;
  if (pinched) { take_if_nearer(settle(glm::max(f, least), kept)); }  // leaves the middle of a blade, or goes along its side
  const double small = tol_project * std::max({radii_.x, radii_.y, radii_.z});
  for (int round = 0; round < 32; ++round) {
    // Steps along the tangent plane towards the projection of p, and back onto the surface; shorter while the step increases the distance.
    const glm::dvec3 n = normal(x);
    glm::dvec3 step = (f - x) - glm::dot(f - x, n) * n;
    const auto go = [&] {
      return take_if_nearer(settle(glm::max(x + step, glm::dvec3{0.0}), 0.0)) ||
             (pinched && take_if_nearer(settle(glm::max(x + step, kept * x), kept)));
    };
    while (glm::length(step) > small && !go()) { step *= 0.25; }
    if (glm::length(step) <= small) { break; }
  }
  return x;
}

HALFLIGHT_INLINE void Superquadric::approximate(double tolerance, brep::Builder& out) const {
  // The farthest point of the unit curve is on an axis or half-way between two.
  const double across = limit_.x * std::max(radii_.x, radii_.y) * std::max(1.0, std::numbers::sqrt2 / around_(1.0, 1.0).value);
  if (ring_ > 0.0) {
    tolerance = std::min(tolerance, 0.25 * std::min({radii_.x, radii_.y, radii_.z}));  // the mesh remains a ring
  }
  const int n = around_.points(0.5 * tolerance, limit_.x * radii_.x, limit_.y * radii_.y, 8);
  const int m = profile_.points(0.5 * tolerance, across / limit_.x, radii_.z, 8);
  std::vector<std::uint32_t> ring;
  const int first = ring_ > 0.0 ? 0 : 1 - m / 4, rows = ring_ > 0.0 ? m : m / 2 - 1;
  const auto vertex = [&](const glm::dvec2& column, const glm::dvec2& row) {
    return out.vertex(centre_ + radii_ * glm::dvec3((ring_ + row.x) * column.x, (ring_ + row.x) * column.y, row.y));
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < n; ++i) { ring.push_back(vertex(around_.point(i, n), profile_.point((first + j + m) % m, m))); }
  }
  const auto at = [&](int j, int i) { return ring[static_cast<std::size_t>(j % rows * n + i % n)]; };
  for (int j = 0; j < (ring_ > 0.0 ? rows : rows - 1); ++j) {
    for (int i = 0; i < n; ++i) { out.face({at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)}, 0); }
  }
  if (ring_ > 0.0) { return; }
  const std::uint32_t south = vertex({0.0, 0.0}, {0.0, -1.0}), north = vertex({0.0, 0.0}, {0.0, 1.0});
  for (int i = 0; i < n; ++i) {
    out.face({at(0, i + 1), at(0, i), south}, 0);
    out.face({at(rows - 1, i), at(rows - 1, i + 1), north}, 0);
  }
}

HALFLIGHT_INLINE Sample Superquadric::norm(const glm::dvec3& f, const glm::dvec3& e, double s) const {
  const glm::dvec3 p = f + s * e;
  const auto rate = [&](int k) { return std::signbit(p[k]) ? -e[k] : e[k]; };
  const auto [a, da] = around_.along(std::abs(p.x), std::abs(p.y), rate(0), rate(1));
  const auto [value, slope] = profile_.along(a, std::abs(p.z), da, rate(2));
  return {value - 1.0, slope};
}

HALFLIGHT_INLINE void Superquadric::cut_convex(const glm::dvec3& f, const glm::dvec3& e, double lo, double hi, Cut& cuts) const {
  const double step = eps_root * std::max(std::abs(lo), std::abs(hi));
  const auto zero = [&](double from, double to) -> std::optional<double> {
    double s = from;
    for (int i = 0; i < 200; ++i) {
      const Sample at = norm(f, e, s);
      if (!(at.value > 0.0)) { return s; }
      if (!(at.slope * (to - from) < 0.0)) { return std::nullopt; }
      const double next = s - at.value / at.slope;
      if (!(std::abs(next - from) <= std::abs(to - from))) { return std::nullopt; }
      if (std::abs(next - s) <= step) { return next; }
      s = next;
    }
    return s;
  };
  if (const std::optional<double> in = zero(lo, hi)) {
    if (const std::optional<double> leave = zero(hi, lo); leave && *in <= *leave) { cuts.push({*in, *leave}); }
  }
}

HALFLIGHT_INLINE void Superquadric::cut_pieces(const glm::dvec3& f, const glm::dvec3& e, double lo, double hi, Cut& cuts) const {
  const Line line{f, e, -f / e, lo, hi};
  std::array<double, 5> ends{lo};
  std::size_t count = 1;
  for (int k = 0; k < 3; ++k) {
    if (line.crosses(k)) { ends[count++] = line.zero[k]; }
  }
  ends[count++] = hi;
  std::sort(ends.begin(), ends.begin() + count);
  struct Change {
    double s;
    bool inner, enters;
  };
  InlineVector<Change, 16> changes;
  bool outside[2] = {true, false};  // is lo outside the outer surface, is it within the inner one?
  const double negligible = eps_norm * (1.0 + ring_) * (1.0 + 1.0 / around_.p() + 1.0 / profile_.p());
  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (!(ends[i] < ends[i + 1])) { continue; }
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    const glm::dvec3 rate{line.rate(0, middle), line.rate(1, middle), line.rate(2, middle)};
    for (int inner = 0; inner <= (ring_ > 0.0 ? 1 : 0); ++inner) {
      const double sign = inner ? -1.0 : 1.0;
      const auto gauge = [&](double s) {  // of the profile, minus one: positive outside the surface
        const auto [a, da] = around_.along(line.at(0, s), line.at(1, s), rate.x, rate.y);
        const double w = sign * (a - ring_);
        if (!(w > 0.0)) { return Sample{line.at(2, s) - 1.0, rate.z}; }
        const auto [value, slope] = profile_.along(w, line.at(2, s), sign * da, rate.z);
        return Sample{value - 1.0, slope};
      };
      const auto split = [&](double s) {
        const auto [a, da] = around_.along(line.at(0, s), line.at(1, s), rate.x, rate.y);
        const Sample b = profile_.width(line.at(2, s));
        const double db = rate.z == 0.0 ? 0.0 : -b.slope * rate.z;
        SplitSample at{sign * (a - ring_) - b.value, 0.0, 0.0};
        (around_.convex() != static_cast<bool>(inner) ? at.convex : at.concave) += sign * da;
        (profile_.convex() ? at.convex : at.concave) += db;
        return at;
      };
      if (i == 0) { outside[inner] = !(split(lo).value < 0.0); }
      sign_changes(split, ends[i], ends[i + 1], negligible, [&](double a, double b, bool rising, double guess) {
        changes.push({bracketed_root(gauge, a, b, rising, guess), inner == 1, !rising});
      });
    }
  }
  std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.s < b.s; });
  double entry = lo;
  for (const Change& change : changes) {
    const bool before = !outside[0] && !outside[1];
    outside[change.inner ? 1 : 0] = !change.enters;
    const bool after = !outside[0] && !outside[1];
    if (after && !before) { entry = change.s; }
    if (before && !after) { cuts.push({entry, change.s}); }
  }
  if (!outside[0] && !outside[1]) { cuts.push({entry, hi}); }
}

HALFLIGHT_INLINE glm::dvec3 Superquadric::onto(const glm::dvec3& f) const {
  const glm::dvec3 p = f / radii_;
  const double a = around_(p.x, p.y).value, w = from_ring(a), m = profile_(std::abs(w), p.z).value;
  if (!(m > 0.0)) { return radii_ * (a > 0.0 ? glm::dvec3((ring_ + 1.0) / a * p.x, (ring_ + 1.0) / a * p.y, 0.0) : glm::dvec3(0, 0, 1.0)); }
  const double to = ring_ + w / m;
  return radii_ * (a > 0.0 ? glm::dvec3(to / a * p.x, to / a * p.y, p.z / m) : glm::dvec3(to, 0.0, p.z / m));
}

HALFLIGHT_INLINE std::pair<double, glm::dvec3> Superquadric::level(const glm::dvec3& x) const {
  const glm::dvec3 p = x / radii_;
  const auto a = around_(p.x, p.y);
  const double w = from_ring(a.value);
  const auto m = profile_(std::abs(w), p.z);
  const double outward = w == 0.0 ? 0.0 : std::copysign(m.dx, w);
  glm::dvec3 n{p.x == 0.0 ? 0.0 : outward * a.dx, p.y == 0.0 ? 0.0 : outward * a.dy, p.z == 0.0 ? 0.0 : m.dy};
  for (int k = 0; k < 3; ++k) { n[k] = std::clamp(n[k], -1e100, 1e100) / radii_[k]; }
  return {m.value - 1.0, n};
}

HALFLIGHT_INLINE glm::dvec3 Superquadric::normal(const glm::dvec3& x) const {
  const glm::dvec3 n = level(x).second;
  const double length = glm::length(n);
  return length > 0.0 ? n / length : glm::dvec3(0.0, 0.0, 1.0);
}

HALFLIGHT_INLINE glm::dvec3 Superquadric::settle(glm::dvec3 x, double kept) const {
  for (int i = 0; i < 16; ++i) {
    const auto [value, gradient] = level(x);
    const double squared = glm::dot(gradient, gradient);
    if (std::abs(value) <= eps_gauge || !(squared > 0.0)) { break; }
    x = glm::max(x - (value / squared) * gradient, kept * x);
  }
  return onto(x);
}

}  // namespace raycast
