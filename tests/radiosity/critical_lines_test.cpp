// SPDX-License-Identifier: MIT

// Critical lines against the exact light of one lamp past one blocker: it is smooth away from all lines, and not across them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <brep/handles.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/discontinuity/critical_lines.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/shadow.hpp>

#include "catch.hpp"

using radiosity::CriticalLine;
using radiosity::Facets;
using radiosity::Polygon;
using radiosity::Random;

namespace {

const glm::dvec3 up{0.0, 0.0, 1.0};

// One facet with a border.
Facets sheet(const Polygon& contour) {
  const glm::dvec3 n = glm::normalize(glm::cross(contour[1] - contour[0], contour[2] - contour[0]));
  Facets facets;
  facets.facets.push_back({contour, n, glm::dot(n, contour[0]), 1.0});
  for (std::size_t i = 0; i < contour.size(); ++i) {
    facets.edges.push_back({contour[i], contour[(i + 1) % contour.size()], 0, brep::invalid_index});
  }
  return facets;
}

// Corners on a circle in a plane that is tilted a little, so convex.
Polygon random_polygon(Random& random, const glm::dvec3& centre, double radius, bool faces_down) {
  const auto n = static_cast<std::size_t>(3 + random.bits() % 3);
  const glm::dvec3 normal = glm::normalize(glm::dvec3{0.4 * random.uniform() - 0.2, 0.4 * random.uniform() - 0.2, faces_down ? -1.0 : 1.0});
  const auto [s, t] = radiosity::orthonormal(normal);
  Polygon polygon;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = glm::radians(360.0) * (static_cast<double>(i) + 0.6 * random.uniform()) / static_cast<double>(n);
    polygon.push_back(centre + radius * (std::cos(angle) * s + std::sin(angle) * t));
  }
  return polygon;
}

// A lamp above a blocker above the square |x|, |y| <= 1 in the plane z = 0, heights and sizes such that nothing is nearer than 0.3.
struct LitWorld {
  explicit LitWorld(std::uint64_t seed) {
    Random random{seed, 0, 0};
    const auto offset = [&] { return 0.4 * random.uniform() - 0.2; };
    lamp = random_polygon(random, {offset(), offset(), 1.5 + 0.3 * random.uniform()}, 0.3 + 0.2 * random.uniform(), true);
    blocker = random_polygon(random, {offset(), offset(), 0.5 + 0.2 * random.uniform()}, 0.2 + 0.2 * random.uniform(), false);
    find();
  }
  LitWorld(Polygon over, Polygon between) : lamp{std::move(over)}, blocker{std::move(between)} { find(); }

  void find() {
    add_critical_lines(face, sheet(lamp), sheet(blocker), 1e-9, lines);
    join_lines(lines, 1e-9);
  }
  [[nodiscard]] double light(const glm::dvec3& x) const {
    const radiosity::Blocker one{blocker, sheet(blocker).facets[0].normal};
    return radiosity::ShadowedTarget{lamp, sheet(lamp).facets[0].normal, {&one, 1}, 1e-12}.form_factor(x, up);
  }
  // The fourth difference of the light along a direction. Where the light is smooth it is at most h^4 times the fourth derivative; where
  // the second derivative jumps by J at a distance of h from the middle it is J h^2 / 2.
  [[nodiscard]] double fourth_difference(const glm::dvec3& x, const glm::dvec3& d, double size = h) const {
    const glm::dvec3 step = size * d;
    return light(x - 2.0 * step) - 4.0 * light(x - step) + 6.0 * light(x) - 4.0 * light(x + step) + light(x + 2.0 * step);
  }
  [[nodiscard]] static double distance(const CriticalLine& line, const glm::dvec3& x) {
    const glm::dvec3 along = line.to - line.from;
    const double t = std::clamp(glm::dot(x - line.from, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(line.from + t * along - x);
  }

  static constexpr double h = 1e-3;
  radiosity::ReceivingFace face{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, up};
  Polygon lamp, blocker;
  std::vector<CriticalLine> lines;
};

// Form factors of things at distances from 0.3 have fourth derivatives of some 1e4 at most, h^4 of that is 1e-8; rounding is 1e-14. They
// have larger ones where the edges of lamp and shadow are nearly parallel: halving h divides the difference by 16 there, by 4 across a jump
// of the second derivative.
constexpr double smooth = 1e-8;

}  // namespace

TEST_CASE("critical lines: away from all of them the light is smooth") {
  const std::uint64_t seed = 0x17d15c;
  CAPTURE(seed);
  std::size_t far = 0, kinks_of_others = 0;
  for (std::uint64_t k = 0; k < 40; ++k) {
    const LitWorld world{seed + k};
    CAPTURE(k);
    Random random{seed, k, 1};
    for (int i = 0; i < 250; ++i) {
      const glm::dvec3 x{1.9 * random.uniform() - 0.95, 1.9 * random.uniform() - 0.95, 0.0};
      const double angle = 6.3 * random.uniform();
      const glm::dvec3 d{std::cos(angle), std::sin(angle), 0.0};
      const double most = std::abs(world.fourth_difference(x, d));
      const bool near = std::any_of(world.lines.begin(), world.lines.end(),
                                    [&](const CriticalLine& line) { return LitWorld::distance(line, x) <= 2.0 * LitWorld::h; });
      if (near) {
        kinks_of_others += most > smooth ? 1 : 0;
        continue;
      }
      ++far;
      CAPTURE(x.x, x.y);
      CHECK((most <= smooth || std::abs(world.fourth_difference(x, d, 0.5 * LitWorld::h)) <= most / 8.0));
    }
  }
  CHECK(far > 5000);
  CHECK(kinks_of_others > 20);  // the bound tells a kink from what is smooth
}

TEST_CASE("critical lines: across each the second derivative of the light jumps, and the first where edges are parallel") {
  const std::uint64_t seed = 0x2d15c;
  CAPTURE(seed);
  std::size_t looked_at = 0;
  for (std::uint64_t k = 0; k < 40; ++k) {
    const LitWorld world{seed + k};
    CAPTURE(k, world.lines.size());
    Random random{seed, k, 1};
    for (const CriticalLine& line : world.lines) {
      const glm::dvec3 across = glm::normalize(glm::cross(up, line.to - line.from));
      double most = 0.0;
      int asked = 0;
      for (int i = 0; i < 10; ++i) {
        const glm::dvec3 x = line.from + (0.1 + 0.8 * random.uniform()) * (line.to - line.from);
        const bool alone = std::all_of(world.lines.begin(), world.lines.end(), [&](const CriticalLine& other) {
          return &other == &line || LitWorld::distance(other, x) > 4.0 * LitWorld::h;
        });
        if (!alone) { continue; }
        ++asked;
        most = std::max(most, std::abs(world.fourth_difference(x + LitWorld::h * across, across)));
      }
      if (asked < 5) { continue; }
      ++looked_at;
      CAPTURE(line.degree, most);
      CHECK(most > smooth);
    }
  }
  CHECK(looked_at > 300);
}

TEST_CASE("critical lines of parallel squares: the half-shadow's borders, of degree 1, and what is inside them") {
  const auto square = [](double r, double z, bool down) {
    return down ? Polygon{{-r, -r, z}, {-r, r, z}, {r, r, z}, {r, -r, z}} : Polygon{{-r, -r, z}, {r, -r, z}, {r, r, z}, {-r, r, z}};
  };
  // Lamp of half the side 0.3 at 1.5, blocker 0.2 at 0.5: full shadow |x| < 0.15, half-shadow |x| < 0.45.
  const LitWorld world{square(0.3, 1.5, true), square(0.2, 0.5, false)};
  CHECK(world.lines.size() == 8);
  for (const CriticalLine& line : world.lines) {
    CHECK(line.degree == 1);
    const glm::dvec3 along = line.to - line.from;
    const int axis = std::abs(along.x) > std::abs(along.y) ? 1 : 0;
    CHECK(along[axis] == test::Approx(0.0).margin(1e-12));
    const double at = std::abs(line.from[axis]);
    CHECK(std::min(std::abs(at - 0.15), std::abs(at - 0.45)) < 1e-12);
    CHECK(glm::length(along) == test::Approx(0.9).epsilon(1e-12));
    // The slope jumps: a second difference is of the order of h, where it is of that of h^2 beside the line.
    glm::dvec3 middle = 0.5 * (line.from + line.to);
    middle[1 - axis] = 0.05;
    glm::dvec3 step{0.0};
    step[axis] = LitWorld::h;
    const auto second = [&](const glm::dvec3& x) { return std::abs(world.light(x + step) - 2.0 * world.light(x) + world.light(x - step)); };
    CHECK(second(middle) > 100.0 * std::max(second(middle + 3.0 * step), second(middle - 3.0 * step)));
  }
}

TEST_CASE("contact lines: the light jumps where a wall stands on the face or goes through it") {
  const Polygon lamp{{-0.9, -0.3, 1.5}, {-0.9, 0.3, 1.5}, {-0.5, 0.3, 1.5}, {-0.5, -0.3, 1.5}};
  const radiosity::ReceivingFace face{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, up};
  for (const double foot : {0.0, -0.2}) {
    const Polygon wall{{0.1, -0.5, foot}, {0.2, 0.5, foot}, {0.2, 0.5, 0.6}, {0.1, -0.5, 0.6}};
    std::vector<CriticalLine> lines;
    add_contact_lines(face, sheet(wall), 1e-9, lines);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].degree == 0);
    CHECK(glm::length(lines[0].to - lines[0].from) == test::Approx(std::sqrt(1.01)).epsilon(1e-12));
    const radiosity::Blocker one{wall, sheet(wall).facets[0].normal};
    const auto light = [&](const glm::dvec3& x) {
      return radiosity::ShadowedTarget{lamp, sheet(lamp).facets[0].normal, {&one, 1}, 1e-12}.form_factor(x, up);
    };
    const glm::dvec3 middle = 0.5 * (lines[0].from + lines[0].to);
    const glm::dvec3 across = 1e-6 * glm::normalize(glm::cross(up, lines[0].to - lines[0].from));
    CHECK(std::abs(light(middle + across) - light(middle - across)) > 0.01);
  }
  std::vector<CriticalLine> above;
  add_contact_lines(face, sheet({{0.1, -0.5, 0.1}, {0.2, 0.5, 0.1}, {0.2, 0.5, 0.6}, {0.1, -0.5, 0.6}}), 1e-9, above);
  CHECK(above.empty());
}

TEST_CASE("join_lines: pieces of one line become one, which covers them and no more") {
  const std::uint64_t seed = 0x30113;
  CAPTURE(seed);
  Random random{seed, 0, 0};
  for (int k = 0; k < 50; ++k) {
    const double angle = 6.3 * random.uniform();
    const glm::dvec3 along{std::cos(angle), std::sin(angle), 0.0};
    std::vector<CriticalLine> lines;
    double low = 1e300, high = -1e300;
    double reached = 0.0;
    for (int i = 0; i < 6; ++i) {  // each begins within the one before
      const double from = reached - 0.05 * random.uniform();
      reached = from + 0.1 + 0.2 * random.uniform();
      const bool turned = random.bits() % 2 == 0;
      lines.push_back({(turned ? reached : from) * along, (turned ? from : reached) * along, 1 + static_cast<int>(random.bits() % 2)});
      low = std::min(low, from);
      high = std::max(high, reached);
    }
    lines.push_back({(high + 0.1) * along, (high + 0.2) * along, 2});                          // apart
    lines.push_back({0.01 * glm::cross(up, along), along + 0.01 * glm::cross(up, along), 2});  // beside
    const int lowest = std::min_element(lines.begin(), lines.begin() + 6, [](auto& a, auto& b) { return a.degree < b.degree; })->degree;
    std::rotate(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(random.bits() % lines.size()), lines.end());
    join_lines(lines, 1e-6);
    REQUIRE(lines.size() == 3);
    const CriticalLine* const whole = &*std::max_element(lines.begin(), lines.end(), [&](const CriticalLine& a, const CriticalLine& b) {
      const auto on = [&](const CriticalLine& l) {
        return std::abs(glm::dot(glm::cross(up, along), l.from)) < 1e-6 ? glm::length(l.to - l.from) : 0.0;
      };
      return on(a) < on(b);
    });
    CHECK(whole->degree == lowest);
    CHECK(std::min(glm::dot(whole->from, along), glm::dot(whole->to, along)) == test::Approx(low).margin(1e-12));
    CHECK(std::max(glm::dot(whole->from, along), glm::dot(whole->to, along)) == test::Approx(high).margin(1e-12));
  }
}
