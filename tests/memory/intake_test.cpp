// SPDX-License-Identifier: MIT
// The intake takes memory in proportion to what it is given.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/intake/intake.hpp>

#include "catch.hpp"
#include "heap.hpp"

namespace {

struct Polygons {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> corners, first{0}, material;

  void close() {
    first.push_back(static_cast<std::uint32_t>(corners.size()));
    material.push_back(0);
  }
};

// The most bytes that the intake holds for so many.
double peak_of(const std::function<Polygons(std::size_t)>& make, std::size_t count) {
  const Polygons made = make(count);
  const std::vector<radiosity::Material> materials{{"grey", glm::dvec3(0.5), glm::dvec3(0.0)}};
  const std::int64_t before = heap::live_bytes();
  heap::reset_peak();
  const radiosity::Intake intake = radiosity::take_in({made.positions, made.corners, made.first, made.material}, materials);
  CHECK(!intake.objects.empty());
  CHECK(intake.polygons + 1 == made.first.size());
  return static_cast<double>(heap::peak_bytes() - before);
}

// Four times as many take four times the memory, up to the spare room of growing arrays; squares would be sixteen.
void check_proportional(const std::function<Polygons(std::size_t)>& make) {
  const double few = peak_of(make, 1000), many = peak_of(make, 4000);
  CHECK(many < 8.0 * few);
}

}  // namespace

TEST_CASE("the intake's memory grows in proportion to the copies of a polygon") {
  check_proportional([](std::size_t count) {
    Polygons out;
    out.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (std::size_t i = 0; i < count; ++i) {
      out.corners.insert(out.corners.end(), {0, 1, 2});
      out.close();
    }
    return out;
  });
}

TEST_CASE("the intake's memory grows in proportion to the corners of a polygon that must be split") {
  check_proportional([](std::size_t count) {
    Polygons out;
    for (std::size_t i = 0; i < count; ++i) {  // a rim that goes up and down
      const double a = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
      out.positions.emplace_back(std::cos(a), std::sin(a), 0.1 * std::sin(5.0 * a));
      out.corners.push_back(static_cast<std::uint32_t>(i));
    }
    out.close();
    return out;
  });
}

TEST_CASE("a polygon whose splitting would take minutes is left out, with a word") {
  Polygons out;
  out.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  out.corners = {0, 1, 2};
  out.close();
  for (std::size_t i = 0; i < 1'000'000; ++i) { out.corners.push_back(static_cast<std::uint32_t>(i % 3)); }
  out.close();
  const std::vector<radiosity::Material> materials{{"grey", glm::dvec3(0.5), glm::dvec3(0.0)}};
  const radiosity::Intake intake = radiosity::take_in({out.positions, out.corners, out.first, out.material}, materials);
  REQUIRE(intake.changes.size() == 1);
  CHECK(radiosity::sentence(intake.changes[0]) == "1 polygon has more than 20 000 corners: left out");
  CHECK(intake.parts.of(0).size() == 1);
  CHECK(intake.parts.of(1).empty());
}
