// SPDX-License-Identifier: MIT
// The intake: polygons that lie on each other in one plane, as naive triangulations of concave polygons and overlapping walls do.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <brep/builder.hpp>
#include <brep/polygon.hpp>

#include <raycast/scene.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "radiosity/foreign_rooms.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using radiosity::ChangeKind;
using rooms::number_in;
using rooms::RandomRooms;
using soup::count_of;
using soup::Soup;

namespace {

// A simple polygon around the origin, mostly concave, counter-clockwise. `steps`: with horizontal and vertical sides alone, a staircase,
// in which corners often lie on a line with others.
std::vector<glm::dvec2> random_outline(RandomRooms& random, bool steps) {
  std::vector<glm::dvec2> outline;
  if (steps) {
    const int count = 2 + static_cast<int>(number_in(random, 0.0, 3.0));
    outline = {{0.0, 0.0}, {static_cast<double>(count), 0.0}};
    for (int i = count; i > 0; --i) {
      outline.emplace_back(i, count - i + 1);
      outline.emplace_back(i - 1, count - i + 1);
    }
    return outline;
  }
  const int count = 4 + static_cast<int>(number_in(random, 0.0, 7.0));
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + number_in(random, -0.3, 0.3)) / count;
    outline.push_back(number_in(random, 0.3, 1.5) * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

// A column with this outline: its sides, then each end as a polygon or as triangles from one of its corners.
struct Column {
  std::vector<std::vector<glm::dvec3>> polygons;

  Column(const std::vector<glm::dvec2>& outline, const glm::dmat3& turn, bool fans, std::array<std::size_t, 2> apex) {
    const std::size_t n = outline.size();
    const auto at = [&](std::size_t i, double z) { return turn * glm::dvec3(outline[i % n], z); };
    for (std::size_t i = 0; i < n; ++i) { polygons.push_back({at(i, 0.0), at(i + 1, 0.0), at(i + 1, 2.0), at(i, 2.0)}); }
    for (const std::size_t end : {0U, 1U}) {
      std::vector<glm::dvec3> face;
      for (std::size_t i = 0; i < n; ++i) { face.push_back(at(apex[end] + (end == 1 ? i : n - i), 2.0 * static_cast<double>(end))); }
      if (!fans) { polygons.push_back(face); }
      for (std::size_t i = 1; fans && i + 1 < n; ++i) { polygons.push_back({face[0], face[i], face[i + 1]}); }
    }
  }

  [[nodiscard]] Soup soup(const std::vector<std::size_t>& order) const {
    Soup result;
    for (const std::size_t i : order) { result.polygon(polygons[i]); }
    return result;
  }
};

glm::dmat3 random_turn(RandomRooms& random) {
  const auto direction = [&] {
    return glm::normalize(glm::dvec3(number_in(random, -1, 1), number_in(random, -1, 1), number_in(random, 0.1, 1)));
  };
  const glm::dvec3 z = direction(), x = glm::normalize(glm::cross(z, direction() + glm::dvec3(2.0, 0.0, 0.0)));
  return {x, glm::cross(z, x), z};
}

}  // namespace

TEST_CASE("intake: a concave polygon is the same whole or in triangles from any of its corners, in any order") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  std::size_t folded = 0;
  for (int round = 0; round < 300; ++round) {
    const std::vector<glm::dvec2> outline = random_outline(random, round % 3 == 2);
    const glm::dmat3 turn = random_turn(random);
    const auto corner = [&] { return static_cast<std::size_t>(number_in(random, 0.0, static_cast<double>(outline.size()) - 1e-9)); };
    const std::array<std::size_t, 2> apex{corner(), corner()};
    const Column whole(outline, turn, false, apex), fans(outline, turn, true, apex);
    std::vector<std::size_t> order(whole.polygons.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    radiosity::IntakeOptions options;
    options.merge = round % 2 == 0;
    const radiosity::Intake expected = whole.soup(order).take_in();
    order.resize(fans.polygons.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    const radiosity::Intake taken = fans.soup(order).take_in(options);
    const std::size_t made_whole = count_of(taken, ChangeKind::unfolded);
    folded += made_whole;
    const soup::Measure measure = soup::measure(taken.objects), right = soup::measure(expected.objects);
    CAPTURE(round, outline.size(), apex[0], apex[1], made_whole, taken.faces);
    CHECK(measure.area == Approx(right.area).epsilon(1e-9));
    CHECK(measure.volume == Approx(right.volume).epsilon(1e-9));
    CHECK(measure.solids == 1);
    if (options.merge) { CHECK(taken.faces == expected.faces); }
  }
  CHECK(folded > 100);
}

TEST_CASE("intake: a flat sheet that is given for both sides is whole, however each side is divided") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  for (int round = 0; round < 100; ++round) {
    const int columns = 1 + static_cast<int>(number_in(random, 0.0, 3.0)), rows = 1 + static_cast<int>(number_in(random, 0.0, 2.0));
    const glm::dmat3 turn = random_turn(random);
    std::vector<std::vector<glm::dvec3>> triangles;
    for (const bool back : {false, true}) {
      for (int x = 0; x < columns; ++x) {
        for (int y = 0; y < rows; ++y) {
          const std::array<glm::dvec3, 4> q{glm::dvec3(x, y, 0), glm::dvec3(x + 1, y, 0), glm::dvec3(x + 1, y + 1, 0),
                                            glm::dvec3(x, y + 1, 0)};
          const glm::dvec3 middle(x + number_in(random, 0.2, 0.8), y + number_in(random, 0.2, 0.8), 0);
          std::vector<std::vector<glm::dvec3>> own;
          const int how = static_cast<int>(random() % 3);
          if (how == 0) { own = {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}; }
          if (how == 1) { own = {{q[0], q[1], q[3]}, {q[1], q[2], q[3]}}; }
          for (std::size_t i = 0; how == 2 && i < 4; ++i) { own.push_back({q[i], q[(i + 1) % 4], middle}); }
          for (std::vector<glm::dvec3>& triangle : own) {
            for (glm::dvec3& p : triangle) { p = turn * p; }
            if (back) { std::swap(triangle[1], triangle[2]); }
            triangles.push_back(triangle);
          }
        }
      }
    }
    std::shuffle(triangles.begin(), triangles.end(), random);
    Soup soup;
    for (const std::vector<glm::dvec3>& triangle : triangles) { soup.polygon(triangle); }
    const radiosity::Intake taken = soup.take_in();
    CAPTURE(round, columns, rows);
    CHECK(count_of(taken, ChangeKind::unfolded) == 0);
    CHECK(soup::measure(taken.objects).area == Approx(2.0 * columns * rows).epsilon(1e-9));
  }
}

namespace {

bool holds(const std::vector<glm::dvec3>& outline, const glm::dvec3& p) {  // seen along z
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const glm::dvec3 &a = outline[i], &b = outline[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) { inside = !inside; }
  }
  return inside;
}

}  // namespace

TEST_CASE("intake: where polygons of one surface overlap in a plane, exactly one of them is seen") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  RandomRooms random(seed);
  std::size_t overlapping = 0;
  for (int round = 0; round < 60; ++round) {
    // A floor, and on it polygons of any size, place and orientation, some of which share corners or edges with others.
    Soup soup;
    std::vector<std::vector<glm::dvec3>> given{{{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}};
    const int count = 2 + static_cast<int>(number_in(random, 0.0, 6.0));
    for (int i = 0; i < count; ++i) {
      const bool on_grid = random() % 2 == 0;
      const auto number = [&](double lo, double hi) { return on_grid ? std::round(number_in(random, lo, hi)) : number_in(random, lo, hi); };
      const double x = number(0.0, 6.0), y = number(0.0, 6.0), w = number(1.0, 2.0), h = number(1.0, 2.0);
      given.push_back({{x, y, 0}, {x + w, y, 0}, {x + w, y + h, 0}, {x, y + h, 0}});
      if (random() % 3 == 0) { given.back().erase(given.back().begin()); }
      if (random() % 4 == 0) { std::reverse(given.back().begin(), given.back().end()); }
    }
    std::shuffle(given.begin(), given.end(), random);
    for (const std::vector<glm::dvec3>& outline : given) { soup.polygon(outline); }
    const radiosity::Intake taken = soup.take_in();
    overlapping += count_of(taken, ChangeKind::overlapping);
    std::vector<raycast::PlacedObject> placed;
    for (const radiosity::SceneObject& object : taken.objects) { placed.emplace_back(object.shape, object.placement); }
    const raycast::Scene scene(std::move(placed));
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 p{number_in(random, 0.0, 8.0), number_in(random, 0.0, 8.0), 0.0};
      for (const double up : {1.0, -1.0}) {
        std::size_t seen = 0, there = 0;
        for (std::uint32_t k = 0; k < taken.objects.size(); ++k) {
          brep::Builder builder;
          taken.objects[k].shape->approximate(1.0, builder);
          std::size_t own = 0;
          for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
            if (builder.sheet(f) == brep::no_sheet) { continue; }
            std::vector<glm::dvec3> outline;
            for (const std::uint32_t v : builder.corners(f)) { outline.push_back(builder.position(v)); }
            if (!(brep::vector_area(outline).z * up > 0.0) || !holds(outline, p)) { continue; }
            ++own;
          }
          CHECK(own <= 1);
          there += own;
          if (own == 1 && !scene.covered(p, {0.0, 0.0, up}, k)) { ++seen; }
        }
        CAPTURE(round, p.x, p.y, up, there);
        CHECK(seen == std::min<std::size_t>(there, 1));
      }
    }
  }
  CHECK(overlapping > 30);
}

TEST_CASE("intake: of two floors that overlap the smaller is seen, whichever comes first in the file") {
  for (const bool smaller_first : {false, true}) {
    for (const bool two_sided : {false, true}) {
      Soup soup;  // they share parts of two edges, so that they are one surface
      const auto larger = [&] { soup.polygon({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}); };
      const auto smaller = [&] { soup.polygon({{0, 2, 0}, {4, 2, 0}, {4, 4, 0}, {0, 4, 0}}); };
      if (smaller_first) { smaller(); }
      larger();
      if (!smaller_first) { smaller(); }
      if (two_sided) { soup.two_sided = {1, 0}; }
      const radiosity::Intake taken = soup.take_in();
      CAPTURE(smaller_first, two_sided);
      CHECK(count_of(taken, ChangeKind::overlapping) == 1);
      std::vector<raycast::PlacedObject> placed;
      for (const radiosity::SceneObject& object : taken.objects) { placed.emplace_back(object.shape, object.placement); }
      const raycast::Scene scene(std::move(placed));
      for (const double up : {1.0, -1.0}) {
        if (up < 0.0 && !two_sided) { continue; }
        const auto hit = scene.closest({{2.1, 2.5, up}, {0, 0, -2.0 * up}});
        REQUIRE(hit);
        CHECK(hit->front);
        CHECK(soup::measure({taken.objects[hit->object]}).area == Approx(8.0));
      }
    }
  }
}
