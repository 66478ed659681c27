// SPDX-License-Identifier: MIT
// The intake: polygons that are given whole and again in parts, as modellers leave them behind when a face is divided.

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/intake/intake.hpp>

#include "catch.hpp"
#include "radiosity/foreign_rooms.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using radiosity::ChangeKind;
using rooms::number_in;
using rooms::RandomRooms;
using soup::Soup;

namespace {

using Outline = std::vector<glm::dvec3>;

// A quadrilateral in 2, 3 or more parts: cut across in the middle or at a random place, each part again with a chance, or along its
// diagonal.
std::vector<Outline> in_parts(const Outline& quad, RandomRooms& random, int depth) {
  const double at = random() % 2 == 0 ? 0.5 : number_in(random, 0.2, 0.8);
  const auto along = [&](std::size_t i) { return quad[i] + at * (quad[(i + 1) % 4] - quad[i]); };
  if (depth == 0 && number_in(random, 0, 1) < 0.3) { return {{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}}; }
  const glm::dvec3 m = along(0), n = quad[3] + at * (quad[2] - quad[3]);
  std::vector<Outline> parts;
  for (const Outline& part : {Outline{quad[0], m, n, quad[3]}, Outline{quad[1], quad[2], n, m}}) {
    if (depth > 0 && number_in(random, 0, 1) < 0.5) {
      for (Outline& smaller : in_parts(part, random, depth - 1)) { parts.push_back(std::move(smaller)); }
    } else {
      parts.push_back(part);
    }
  }
  return parts;
}

// A parallelepiped.
std::vector<Outline> sides_of_box(const glm::dvec3& o, const std::array<glm::dvec3, 3>& e) {
  std::vector<Outline> sides;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 &u = e[(k + 1) % 3], &v = e[(k + 2) % 3];
    sides.push_back({o, o + v, o + u + v, o + u});
    sides.push_back({o + e[k], o + e[k] + u, o + e[k] + u + v, o + e[k] + v});
  }
  return sides;
}

}  // namespace

TEST_CASE("intake: a box is the same solid if its sides are given whole, in parts, or both, whichever way these look") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 200; ++round) {
    CAPTURE(round);
    const bool thin = round % 4 == 1, rounded = round % 2 == 1;
    const auto vector = [&] { return glm::dvec3(number_in(random, -1, 1), number_in(random, -1, 1), number_in(random, -1, 1)); };
    std::array<glm::dvec3, 3> edges{glm::dvec3(number_in(random, 1, 3), 0, 0),
                                    glm::dvec3(0, number_in(random, thin ? 0.03 : 1, thin ? 0.1 : 3), 0),
                                    glm::dvec3(0, 0, number_in(random, 1, 3))};
    for (glm::dvec3& edge : edges) { edge += 0.3 * glm::length(edge) * vector(); }
    const auto sides = sides_of_box(10.0 * vector(), edges);
    Soup clean;
    for (const Outline& side : sides) { clean.polygon(side); }
    std::vector<Outline> polygons;
    const bool inwards = random() % 2 == 0, disorder = round % 3 == 0;
    for (const Outline& side : sides) {
      const auto how = random() % (disorder && &side == sides.data() ? 2 : 3);  // all given for both sides would be a sheet
      for (const Outline& part : in_parts(side, random, 2)) {
        if (how == 0) { break; }
        polygons.push_back(part);
        if (part.size() == 4 && random() % 4 == 0) {  // and this part in smaller ones again
          for (const Outline& smaller : in_parts(part, random, 1)) { polygons.push_back(smaller); }
        }
      }
      if (how != 1) { polygons.push_back(side); }
    }
    Soup given;
    std::shuffle(polygons.begin(), polygons.end(), random);
    for (Outline& polygon : polygons) {
      if (inwards != (disorder && random() % 4 == 0)) { std::reverse(polygon.begin(), polygon.end()); }
      if (rounded) {  // to six digits behind the point, as in a file
        for (glm::dvec3& p : polygon) { p = glm::round(1e6 * p) / 1e6; }
      }
      given.polygon(polygon);
    }
    const radiosity::Intake taken = given.take_in();
    soup::check_sound(given, taken);
    for (const radiosity::Change& change : taken.changes) { UNSCOPED_INFO(radiosity::sentence(change)); }
    const soup::Measure expected = soup::measure(clean.take_in().objects), measured = soup::measure(taken.objects);
    CHECK(taken.objects.size() == 1);
    CHECK(measured.solids == 1);
    CHECK(measured.area == Approx(expected.area).epsilon(thin ? 2e-3 : 1e-4));
    CHECK(measured.volume == Approx(expected.volume).epsilon(thin ? 2e-3 : 1e-4));
    CHECK(soup::count_of(taken, ChangeKind::nonmanifold) == 0);
    CHECK(taken.parts.first.back() >= given.count());  // every polygon is somewhere in the result
  }
}
