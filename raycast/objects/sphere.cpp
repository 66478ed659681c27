// SPDX-License-Identifier: MIT
#include <raycast/objects/sphere.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>

namespace raycast {

HALFLIGHT_INLINE Made<Sphere> Sphere::make(const glm::dvec3& centre, double radius) {
  if (!usable(centre)) { return "a sphere's centre must be finite (and below 1e60)"; }
  if (!usable_length(radius, Box{centre, centre}.magnitude())) {
    return "a sphere's radius must be positive, finite and not vanishing beside its centre's coordinates";
  }
  return std::shared_ptr<const Sphere>(new Sphere(centre, radius));
}

HALFLIGHT_INLINE void Sphere::spans(const Segment& line, Spans& out) const {
  const glm::dvec3 f = line.origin - centre_;
  const double dd = glm::dot(line.direction, line.direction);
  const double k = -glm::dot(f, line.direction) / dd;
  const double l = glm::length(f + k * line.direction);
  if (!(l < radius_)) { return; }
  const double half = std::sqrt((radius_ - l) * (radius_ + l) / dd);
  out.push(Span{{k - half, 0}, {k + half, 0}});
}

HALFLIGHT_INLINE SurfacePoint Sphere::project(std::uint32_t, const glm::dvec3& p) const {
  const glm::dvec3 f = p - centre_;
  const double length = glm::length(f);
  const glm::dvec3 normal = length > 0.0 ? f / length : glm::dvec3{0.0, 0.0, 1.0};
  return {centre_ + radius_ * normal, normal};
}

HALFLIGHT_INLINE void Sphere::approximate(double tolerance, brep::Builder& out) const {
  const int n = subdivisions(tolerance / radius_);
  std::map<std::array<int, 3>, std::uint32_t> made;  // by integer position on the cube [0,n]^3, because sides share their edges
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, fresh] = made.try_emplace(at, 0u);
    if (fresh) { place->second = out.vertex(centre_ + radius_ * direction(at, n)); }
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int a, int b) {
            std::array<int, 3> p{};
            p[static_cast<std::size_t>(axis)] = end * n;
            p[static_cast<std::size_t>((axis + 1) % 3)] = i + a;
            p[static_cast<std::size_t>((axis + 2) % 3)] = j + b;
            return vertex(p);
          };
          if (end == 1) {
            out.face({at(0, 0), at(1, 0), at(1, 1), at(0, 1)}, 0);
          } else {
            out.face({at(0, 0), at(0, 1), at(1, 1), at(1, 0)}, 0);
          }
        }
      }
    }
  }
}

HALFLIGHT_INLINE double Sphere::grid(int i, int n) {
  if (2 * i == n) { return 0.0; }
  if (i == 0 || i == n) { return i == 0 ? -1.0 : 1.0; }
  if (2 * i < n) { return -grid(n - i, n); }
  return std::tan(std::numbers::pi / 4 * (2.0 * i - n) / n);
}

HALFLIGHT_INLINE double Sphere::chord_error(int n) {
  double worst = 0.0;
  for (int i = n / 2; i < n; ++i) {
    for (int j = n / 2; j <= i; ++j) {
      const glm::dvec3 q[4] = {direction({n, i, j}, n), direction({n, i + 1, j}, n), direction({n, i + 1, j + 1}, n),
                               direction({n, i, j + 1}, n)};
      for (int k = 0; k < 4; ++k) {
        const glm::dvec3 normal = glm::normalize(glm::cross(q[(k + 1) % 4] - q[k], q[(k + 2) % 4] - q[k]));
        worst = std::max(worst, 1.0 - glm::dot(normal, q[k]));
      }
    }
  }
  return worst;
}

HALFLIGHT_INLINE int Sphere::subdivisions(double relative) {
  constexpr int most = 256;
  if (!(relative > 0.0)) { return most; }
  // Near the middle of a side the error is pi^2 / (16 n^2); start below it and count up.
  const double guess = std::floor(0.7 * std::numbers::pi / 4 / std::sqrt(relative));
  int n = guess >= most ? most : std::max(1, static_cast<int>(guess));
  while (n < most && chord_error(n) > relative) { ++n; }
  return n;
}

}  // namespace raycast
