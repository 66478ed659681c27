// SPDX-License-Identifier: MIT
#include <raycast/planar.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <span>
#include <string>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

HALFLIGHT_INLINE RayFrame::RayFrame(const Segment& line) : origin_(line.origin) {
  const glm::dvec3& d = line.direction;
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  if (az >= ax && az >= ay) {
    x_ = {d.z, 0.0, -d.x}, y_ = {0.0, d.z, -d.y}, forward_ = d.z > 0.0;
  } else if (ax >= ay) {
    x_ = {-d.y, d.x, 0.0}, y_ = {-d.z, 0.0, d.x}, forward_ = d.x > 0.0;
  } else {
    x_ = {0.0, -d.z, d.y}, y_ = {d.y, -d.x, 0.0}, forward_ = d.y > 0.0;
  }
}

HALFLIGHT_INLINE Plane plane_of(std::span<const glm::dvec3> corners) {
  Plane plane{corners[0], brep::normal(corners), 0.0};
  double mean = 0.0, lowest = 0.0, highest = 0.0, magnitude = 0.0;
  for (const glm::dvec3& p : corners) {
    const double height = glm::dot(p - corners[0], plane.normal);
    mean += height / static_cast<double>(corners.size());
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
    magnitude = std::max(magnitude, Box{p, p}.magnitude());
  }
  if (highest - lowest > eps_plane * magnitude) {
    plane.point += mean * plane.normal;
    plane.slack = std::max(highest - mean, mean - lowest);
  }
  return plane;
}

namespace detail {

HALFLIGHT_INLINE int side_of(const Flat& a, const Flat& b, const Flat& c) {
  const double l = (b[0] - a[0]) * (c[1] - a[1]), r = (b[1] - a[1]) * (c[0] - a[0]);
  const double error = eps_orientation * (std::abs(l) + std::abs(r));
  return l - r > error ? 1 : l - r < -error ? -1 : 0;
}

HALFLIGHT_INLINE bool meet(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k])) { return false; }
  }
  const int abc = side_of(a, b, c), abd = side_of(a, b, d), cda = side_of(c, d, a), cdb = side_of(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) { return true; }
  return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) || (cda == 0 && within(c, d, a)) || (cdb == 0 && within(c, d, b));
}

}  // namespace detail

HALFLIGHT_INLINE double planar_tolerance(std::span<const glm::dvec3> corners, double rounding) {
  Box box;
  for (const glm::dvec3& p : corners) { box.extend(p); }
  const double extent = brep::extent(corners);
  return tol_planar * extent + eps_plane * box.magnitude() + std::min(2.0 * std::sqrt(3.0) * rounding, tol_rounded * extent);
}

HALFLIGHT_INLINE std::optional<std::string> polygon_fault(std::span<const glm::dvec3> corners, double rounding) {
  const std::size_t n = corners.size();
  const auto name = [](std::size_t i) { return std::to_string(i + 1); };  // messages count from one
  const auto parts = [](double part) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", part);
    return std::string(text.data());
  };
  if (n < 3) { return "has " + std::to_string(n) + " corners; it needs at least 3"; }
  for (std::size_t i = 0; i < n; ++i) {
    if (!usable(corners[i])) { return "has a corner (number " + name(i) + ") that is not finite (or beyond 1e60)"; }
  }
  Box box;
  for (const glm::dvec3& p : corners) { box.extend(p); }
  const double extent = brep::extent(corners);
  if (!usable_length(extent, box.magnitude())) { return "has no size (all corners coincide, compared with their coordinates)"; }
  for (std::size_t i = 0; i < n; ++i) {
    if (corners[i] == corners[(i + 1) % n]) {
      return "has two equal corners in succession (numbers " + name(i) + " and " + name((i + 1) % n) + ")";
    }
  }
  const glm::dvec3 area = brep::vector_area(corners);
  if (!(glm::length(area) > tol_area * extent * extent)) { return "has no area: its corners lie on a line, or it crosses itself"; }
  const Plane plane = plane_of(corners);
  if (const double most = planar_tolerance(corners, rounding); plane.slack > most) {
    std::size_t worst = 0;
    const auto height = [&](std::size_t i) { return std::abs(glm::dot(corners[i] - plane.point, plane.normal)); };
    for (std::size_t i = 1; i < n; ++i) {
      if (height(i) > height(worst)) { worst = i; }
    }
    return "is not planar: corner " + name(worst) + " lies " + parts(height(worst) / extent) + " of the polygon's extent off its plane (" +
           parts(most / extent) + " is allowed)";
  }
  if (n == 3) { return std::nullopt; }
  int drop = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(area[k]) > std::abs(area[drop])) { drop = k; }
  }
  const auto flat = [&](std::size_t i) { return detail::Flat{corners[i][(drop + 1) % 3], corners[i][(drop + 2) % 3]}; };
  for (std::size_t i = 0; i < n; ++i) {
    const detail::Flat a = flat(i), b = flat((i + 1) % n), c = flat((i + 2) % n);
    if (detail::side_of(a, b, c) == 0 && (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0.0) {
      return "turns back on itself at corner " + name((i + 1) % n);
    }
    for (std::size_t j = i + 2; j < n; ++j) {
      if (!(i == 0 && j == n - 1) && detail::meet(a, b, flat(j), flat((j + 1) % n))) {
        return "intersects itself: edge " + name(i) + " meets edge " + name(j);
      }
    }
  }
  return std::nullopt;
}

}  // namespace raycast
