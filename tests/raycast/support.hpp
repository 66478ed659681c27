// SPDX-License-Identifier: MIT
#pragma once

// Random rays and shapes for the tests of raycast/. Every random test prints its seed when it fails, and runs under a new one when
// the environment variable HALFLIGHT_TEST_SEED names it.

#include "catch.hpp"

#include <raycast/objects/box.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/scene.hpp>

#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

namespace test {

using glm::dvec3;
using Corners = std::vector<dvec3>;

constexpr double u = raycast::unit_roundoff;

class Random {
 public:
  Random() {
    if (const char* given = std::getenv("HALFLIGHT_TEST_SEED")) { seed_ = std::strtoull(given, nullptr, 10); }
    engine_.seed(seed_);
  }
  [[nodiscard]] std::uint64_t seed() const { return seed_; }
  double uniform(double a = 0.0, double b = 1.0) { return a + (b - a) * std::ldexp(static_cast<double>(engine_() >> 11), -53); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  dvec3 in_cube(double half = 1.0) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  dvec3 direction() {
    for (;;) {
      const dvec3 v = in_cube();
      const double length = glm::length(v);
      if (length > 0.1 && length <= 1.0) { return v / length; }
    }
  }
  double magnitude(double decades) { return std::pow(10.0, uniform(-decades, decades)); }  // of lengths over 10^+-decades
  glm::dmat3 rotation() {
    const dvec3 x = direction(), z = glm::normalize(glm::cross(x, direction()));
    return {x, glm::cross(z, x), z};
  }

 private:
  std::uint64_t seed_ = 20240607;
  std::mt19937_64 engine_;
};

// Prints the seed if a check of this scope fails.
#define SEEDED(name) \
  test::Random name; \
  INFO("seed " << name.seed())

inline Corners rectangle(const dvec3& origin, const dvec3& a, const dvec3& b) { return {origin, origin + a, origin + a + b, origin + b}; }

inline raycast::Placement room(const glm::dmat3& linear = glm::dmat3(1.0), const dvec3& translation = dvec3(0.0)) {
  return {linear, translation, true};
}
template <class T>
raycast::PlacedObject placed(const raycast::Made<T>& made, const raycast::Placement& placement = {}) {
  INFO(made.refusal);
  REQUIRE(made);
  REQUIRE_FALSE(raycast::check(*made, placement));
  return raycast::PlacedObject(made.object, placement);
}
inline raycast::Spans spans(const raycast::PlacedObject& object, const raycast::Segment& line) {
  raycast::Spans result;
  object.spans(line, result);
  return result;
}

// The six faces of a box as separate polygons whose fronts look out.
inline std::vector<Corners> faces_of(const dvec3& lo, const dvec3& hi) {
  brep::Builder builder;
  raycast::BoxObject::make(lo, hi)->approximate(0.0, builder);
  std::vector<Corners> result;
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    result.emplace_back();
    for (const std::uint32_t v : builder.corners(f)) { result.back().push_back(builder.position(v)); }
  }
  return result;
}
// A mesh object from an object's approximation (of one sheet count per face).
inline raycast::Made<raycast::Mesh> mesh_of(const raycast::Object& object, double tolerance) {
  brep::Builder builder;
  object.approximate(tolerance, builder);
  Corners positions;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) { positions.push_back(builder.position(v)); }
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    const auto corners = builder.corners(f);
    for (std::size_t i = 2; i < corners.size(); ++i) { faces.push_back({corners[0], corners[i - 1], corners[i]}); }
  }
  return raycast::Mesh::make(positions, faces);
}
// An L-shaped block: the smallest solid that shadows itself. Floor z in [0,1], a riser at x = 1 up to z = 2, y in [0,1].
inline raycast::Made<raycast::Mesh> l_block() {
  const double profile[6][2] = {{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};  // x, z
  Corners positions;
  for (int y = 0; y < 2; ++y) {
    for (const auto& p : profile) { positions.push_back({p[0], y, p[1]}); }
  }
  std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2, 3, 4, 5}, {11, 10, 9, 8, 7, 6}};
  for (std::uint32_t i = 0; i < 6; ++i) { faces.push_back({(i + 1) % 6, i, i + 6, (i + 1) % 6 + 6}); }
  return raycast::Mesh::make(positions, faces);
}

}  // namespace test
