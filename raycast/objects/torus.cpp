// SPDX-License-Identifier: MIT
#include <raycast/objects/torus.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/roots.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

HALFLIGHT_INLINE Made<Torus> Torus::make(const glm::dvec3& centre, const glm::dvec3& axis, double major, double minor) {
  if (!usable(centre) || !usable(axis)) { return "a torus's centre and axis must be finite (and below 1e60)"; }
  if (!usable_length(glm::length(axis), 0.0)) { return "a torus's axis must have a length: it is the direction through the hole"; }
  const double magnitude = Box{centre, centre}.magnitude();
  if (!usable_length(major, magnitude) || !usable_length(minor, magnitude)) {
    return "a torus's radii must be positive, finite and not vanishing beside its centre's coordinates";
  }
  if (!(minor < major)) { return "a torus's minor radius must be below the major one: otherwise the surface passes through itself"; }
  if (!(minor >= thinnest_torus * major)) { return "a torus's minor radius must be at least 1e-4 of the major one"; }
  return std::shared_ptr<const Torus>(new Torus(centre, axis, major, minor));
}

HALFLIGHT_INLINE Box Torus::bounds() const {
  Box box;
  frame_.extend(box, centre_, major_);
  return box.grown(minor_ + eps_bounds * (box.magnitude() + minor_));
}

HALFLIGHT_INLINE void Torus::spans(const Segment& line, Spans& out) const {
  const double shift = nearest_parameter(line, centre_), length = glm::length(line.direction);
  const Tube tube = along(line, shift, length);
  double lo = 0.0, hi = 0.0;
  if (!tube.clip(lo, hi)) { return; }
  std::array<double, 5> ends;  // lo, the extrema between, hi
  const std::size_t count = tube.extrema(lo, hi, ends);
  const auto t = [&](double s) { return shift + s * (major_ / length); };
  bool inside = false;  // the ends of the clipped line are outside, up to rounding
  double entry = 0.0, before = lo;
  for (std::size_t i = 1; i < count; ++i) {
    const double at = ends[i];
    if ((i + 1 < count && tube(at).value < 0.0) == inside) {
      before = at;
      continue;
    }
    const double root = bracketed_root(tube, before, at, inside, 0.5 * (before + at));
    if (inside) { out.push(Span{{t(entry), 0}, {t(root), 0}}); }
    entry = root;
    inside = !inside;
    before = at;
  }
}

HALFLIGHT_INLINE bool Torus::passes_once(const Segment& line) const {
  const Tube tube = along(line, nearest_parameter(line, centre_), glm::length(line.direction));
  double lo = 0.0, hi = 0.0;
  std::array<double, 5> ends;
  return tube.one_extremum() || !tube.clip(lo, hi) || tube.extrema(lo, hi, ends) < 5 || tube(ends[2]).value < 0.0 ||
         !(tube(ends[1]).value < 0.0) || !(tube(ends[3]).value < 0.0);
}

HALFLIGHT_INLINE SurfacePoint Torus::project(std::uint32_t, const glm::dvec3& p) const {
  const glm::dvec3 f = p - centre_, radial = frame_.radial(f);
  const double z = glm::dot(f, frame_.w), x = glm::dot(f, radial) - major_, length = std::hypot(x, z);
  const glm::dvec3 normal = length > 0.0 ? glm::normalize((x / length) * radial + (z / length) * frame_.w) : radial;
  return {centre_ + major_ * radial + minor_ * normal, normal};
}

HALFLIGHT_INLINE void Torus::approximate(double tolerance, brep::Builder& out) const {
  tolerance = std::min(tolerance, 0.25 * minor_);  // the mesh remains a ring
  int n = 8, m = 8;
  for (;;) {
    const double dn = 2 * std::numbers::pi / n, dm = 2 * std::numbers::pi / m;
    const double around = dn * dn * (major_ + minor_), across = dm * dm * minor_;
    if (around + 2 * dn * dm * minor_ + across <= 8 * tolerance || (n >= 512 && m >= 512)) { break; }
    (n < 512 && (around >= across || m >= 512) ? n : m) += 4;
  }
  std::vector<std::uint32_t> ring;
  for (int i = 0; i < n; ++i) {
    const glm::dvec2 turn = circle_point(i, n);
    const glm::dvec3 radial = turn.x * frame_.u + turn.y * frame_.v;
    for (int j = 0; j < m; ++j) {
      const glm::dvec2 p = circle_point(j, m);
      ring.push_back(out.vertex(centre_ + (major_ + minor_ * p.x) * radial + (minor_ * p.y) * frame_.w));
    }
  }
  const auto at = [&](int i, int j) { return ring[static_cast<std::size_t>(i % n * m + j % m)]; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) { out.face({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, 0); }
  }
}

HALFLIGHT_INLINE Sample Torus::Tube::operator()(double s) const {
  const double x = f_.x + s * e_.x, y = f_.y + s * e_.y, z = f_.z + s * e_.z;
  const double rho = std::sqrt(x * x + y * y), off = rho - 1.0, distance = std::sqrt(off * off + z * z);
  return {distance - r_, (off * (x * e_.x + y * e_.y) / rho + z * e_.z) / distance};
}

HALFLIGHT_INLINE bool Torus::Tube::clip(double& lo, double& hi) const {
  const double grown = 1.0 + eps_tube, sphere = (1.0 + r_) * grown, l = glm::length(f_);
  if (!(l < sphere)) { return false; }
  hi = std::sqrt((sphere - l) * (sphere + l));
  lo = -hi;
  const double slab = r_ * grown + eps_tube;
  if (e_.z == 0.0) { return std::abs(f_.z) <= slab; }
  const double middle = -f_.z / e_.z, half = slab / std::abs(e_.z);
  lo = std::max(lo, middle - half);
  hi = std::min(hi, middle + half);
  return lo < hi;
}

HALFLIGHT_INLINE std::size_t Torus::Tube::extrema(double lo, double hi, std::array<double, 5>& ends) const {
  const auto [p, q, turn] = cubic();
  std::array<double, 3> roots{};
  std::size_t found = 1;
  if (std::abs(turn) < 1.0) {  // three real roots (Viete)
    const double angle = std::acos(turn) / 3, radius = 2 * std::sqrt(-p / 3);
    roots = {radius * std::cos(angle + 2 * std::numbers::pi / 3), radius * std::cos(angle - 2 * std::numbers::pi / 3),
             radius * std::cos(angle)};
    found = 3;
  } else {  // one real root (Cardano, with the sum without cancellation first)
    const double half = 0.5 * q, root = std::sqrt(std::max(0.0, half * half + p * p * p / 27));
    const double large = std::cbrt(half >= 0.0 ? -(half + root) : root - half);
    roots[0] = large == 0.0 ? 0.0 : large - p / (3 * large);
  }
  std::size_t count = 0;
  ends[count++] = lo;
  for (std::size_t i = 0; i < found; ++i) {
    for (int newton = 0; newton < 2; ++newton) {
      const double s = roots[i], slope = 3 * s * s + p, step = ((s * s + p) * s + q) / slope;
      if (std::abs(step) <= tol_newton * std::abs(s)) { roots[i] = s - step; }
    }
    if (roots[i] > ends[count - 1] && roots[i] < hi) { ends[count++] = roots[i]; }
  }
  ends[count++] = hi;
  return count;
}

HALFLIGHT_INLINE Torus::Tube::Cubic Torus::Tube::cubic() const {
  const double k = glm::dot(f_, f_) + (1.0 - r_) * (1.0 + r_);
  const double p = k - 2 * (e_.x * e_.x + e_.y * e_.y), q = -2 * (f_.x * e_.x + f_.y * e_.y);
  return {p, q, p < 0.0 ? -0.5 * q / ((-p / 3) * std::sqrt(-p / 3)) : infinity};
}

}  // namespace raycast
