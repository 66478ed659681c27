// SPDX-License-Identifier: MIT
// The intake: open surfaces of which nothing tells the side that is seen.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <radiosity/intake/intake.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using radiosity::ChangeKind;
using soup::add_box;
using soup::count_of;
using soup::measure;
using soup::Soup;

namespace {

// The points of a grid of n by m quadrilaterals, which `at` gives for parameters from 0 to 1.
template <class At>
void add_grid(Soup& out, int n, int m, const At& at) {
  const auto point = [&](int i, int j) { return at(static_cast<double>(i) / n, static_cast<double>(j) / m); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      out.polygon({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      out.polygon({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
}

Soup turned(const Soup& soup) {
  Soup out;
  for (std::size_t f = 0; f < soup.count(); ++f) {
    std::vector<glm::dvec3> p = soup.outline(f);
    std::reverse(p.begin(), p.end());
    out.polygon(p);
  }
  return out;
}

// A body of revolution around z without its ends, from the angle `low` on, where pi / 2 is the upper end.
Soup part_of_ball(double low, double high, int n) {
  Soup soup;
  add_grid(soup, n, n / 2, [&](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, b = low + (high - low) * v;
    return glm::dvec3(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
  });
  return soup;
}

// Half a sphere of sky, seen from within; `apart`: each polygon is an object of its own, as CAD programs write them.
void add_sky(Soup& out, double radius, double from, int n, bool apart) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n / 4; ++j) {
      const auto at = [&](int k, int l) {
        const double a = 2.0 * std::numbers::pi * k / n, b = 2.0 * std::numbers::pi * l / n;
        return glm::dvec3(radius * std::cos(b) * std::cos(a), radius * std::cos(b) * std::sin(a), from + radius * std::sin(b));
      };
      if (apart || i + j == 0) { out.names.push_back("sky"); }
      if (j + 1 < n / 4) {
        out.polygon({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)}, 1);
      } else {
        out.polygon({at(i, j), at(i, j + 1), at(i + 1, j)}, 1);
      }
    }
  }
}

constexpr double pi = std::numbers::pi;
const radiosity::IntakeOptions unknown{.sides_unknown = true}, unknown_beside_lamps{.open_sides_unknown = true};

}  // namespace

TEST_CASE("intake: where nothing tells the side, open surfaces reflect on both, whichever way they were wound") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int run = 0; run < 20; ++run) {
    Soup terrain;
    const double height = number(0.0, 0.3), waves = number(1.0, 3.0), phase = number(0.0, 3.0);
    add_grid(terrain, 12, 9,
             [&](double u, double v) { return glm::dvec3(u, v, height * std::sin(2.0 * waves * u + phase) * std::sin(3.0 * v)); });
    for (const Soup& soup : {terrain, part_of_ball(number(-0.5, -0.3), number(0.3, 0.5), 16), part_of_ball(number(0.4, 1.0), 1.5, 16)}) {
      for (const Soup& wound : {soup, turned(soup)}) {
        const radiosity::Intake taken = wound.take_in(unknown);
        CHECK(measure(taken.objects).area == Approx(2.0 * wound.area()).epsilon(1e-6));
        CHECK(count_of(taken, ChangeKind::open) == 1);
        CHECK(measure(wound.take_in().objects).area == Approx(wound.area()).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("intake: leaves beside a lamp reflect on both sides, the lamp shines on its own alone") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  Soup soup;
  constexpr int leaves = 50;
  for (int i = 0; i < leaves; ++i) {
    const glm::dvec3 p{number(-1, 1), number(-1, 1), number(0, 2)}, a{number(0.05, 0.1), 0, number(0, 0.1)}, b{0, number(0.05, 0.1), 0.02};
    soup.polygon(i % 2 == 0 ? std::vector<glm::dvec3>{p, p + a, p + b} : std::vector<glm::dvec3>{p, p + b, p + a});
  }
  const double of_leaves = soup.area();
  soup.polygon({{-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}, {1, -1, 4}}, 1);
  for (const radiosity::IntakeOptions& options : {unknown, unknown_beside_lamps}) {
    const radiosity::Intake taken = soup.take_in(options);
    CHECK(measure(taken.objects).area == Approx(2.0 * of_leaves + 4.0).epsilon(1e-6));
    CHECK(count_of(taken, ChangeKind::open) == leaves);
  }
}

// The room is one surface, for its lamp is a part of its ceiling; where a cell of a wall is missing hardly anything is seen through it.
TEST_CASE("intake: a room with a lamp in its ceiling and a small hole in a wall is seen from within") {
  constexpr int n = 8;
  const glm::dvec3 size(4.0, 5.0, 3.0);
  for (int missing = -1; missing < 6; ++missing) {
    Soup room;
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2, x = (axis + 1) % 3, y = (axis + 2) % 3;
      const bool far = side % 2 == 1;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          if (side == missing && i == 2 && j == 5) { continue; }
          std::vector<glm::dvec3> p;
          for (const auto& [u, v] : {std::pair(i, j), std::pair(i + 1, j), std::pair(i + 1, j + 1), std::pair(i, j + 1)}) {
            glm::dvec3 corner(0.0);
            corner[axis] = far ? size[axis] : 0.0;
            corner[x] = size[x] * u / n;
            corner[y] = size[y] * v / n;
            p.push_back(corner);
          }
          if (far) { std::reverse(p.begin(), p.end()); }
          room.polygon(p, side == 5 && (i == 3 || i == 4) && (j == 3 || j == 4) ? 1 : 0);
        }
      }
    }
    CAPTURE(missing);
    for (const radiosity::IntakeOptions& options : {radiosity::IntakeOptions{}, unknown, unknown_beside_lamps}) {
      const radiosity::Intake taken = room.take_in(options);
      CHECK(count_of(taken, ChangeKind::inside_out) == 0);
      CHECK(measure(taken.objects).area == Approx(room.area()));
    }
  }
}

TEST_CASE("intake: where nothing tells the side, the walls of an open room and bodies with small holes keep theirs") {
  Soup box;
  soup::add_box(box, {0, 0, 0}, {4, 5, 3}, 1, true);
  for (int missing = 0; missing < 6; ++missing) {
    Soup room;  // one wall is missing, or the ceiling or the floor is
    for (std::size_t f = 0; f < box.count(); ++f) {
      if (static_cast<int>(f) / 2 != missing) { room.polygon(box.outline(f)); }
    }
    CHECK(measure(room.take_in(unknown).objects).area == Approx(room.area()));
    CHECK(measure(turned(room).take_in(unknown).objects).area == Approx(2.0 * room.area()));  // a chest
  }
  const Soup vase = part_of_ball(-0.5 * pi + 0.1, 0.5 * pi - 0.1, 24);
  Soup cells;  // the walls between small boxes, each given once
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 48; ++i) {
      glm::dvec3 at(0.0), u(0.0), v(0.0);
      at[axis] = i / 16;
      at[(axis + 1) % 3] = i / 4 % 4;
      at[(axis + 2) % 3] = i % 4;
      u[(axis + 1) % 3] = 1.0;
      v[(axis + 2) % 3] = 1.0;
      cells.polygon({at, at + u, at + u + v, at + v});
    }
  }
  CHECK(count_of(cells.take_in(unknown), ChangeKind::open) == 0);
  for (const bool inwards : {false, true}) {
    const radiosity::Intake taken = (inwards ? turned(vase) : vase).take_in(unknown);
    CHECK(measure(taken.objects).area == Approx(vase.area()));
    CHECK(count_of(taken, ChangeKind::inside_out) == (inwards ? 1 : 0));
  }
}

// Cabinets without thickness, with their fronts inside as most models of Cornell boxes have them, stand in a room, closed or with a
// wall missing. They are seen from all sides; the room is seen through the backs of its walls.
TEST_CASE("intake: open boxes that stand in a room reflect on both sides, whichever way they were wound") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int run = 0; run < 60; ++run) {
    CAPTURE(run);
    const glm::dvec3 size{number(3.0, 8.0), number(3.0, 8.0), number(2.4, 4.0)};
    const int open_side = run % 7;  // 6: none
    Soup walls, soup;
    add_box(walls, glm::dvec3(0.0), size, 1, true);
    for (std::size_t f = 0; f < walls.count(); ++f) {
      if (static_cast<int>(f) / 2 != open_side) { soup.polygon(walls.outline(f)); }
    }
    const double seen_once = soup.area();
    for (int k = 0; k < 1 + run % 3; ++k) {
      Soup box;
      const glm::dvec3 lo{0.3 + k * (size.x - 0.3) / 3.0, number(0.1, 0.4) * size.y, number(0.0, 1.0) < 0.5 ? 0.0 : 0.1};
      add_box(box, lo, lo + glm::dvec3(number(0.3, 0.7), number(0.3, 0.5) * size.y, number(0.4, 0.8) * size.z), 1, random() % 4 != 0);
      const int missing = static_cast<int>(random() % 6);
      soup.names.push_back("box");
      for (std::size_t f = 0; f < box.count(); ++f) {
        if (static_cast<int>(f) / 2 != missing) { soup.polygon(box.outline(f)); }
      }
    }
    const double area = seen_once + 2.0 * (soup.area() - seen_once);
    CHECK(measure(soup.take_in(unknown_beside_lamps).objects).area == Approx(area).epsilon(1e-6));
  }
}

TEST_CASE("intake: walls that stand alone under a sky reflect on both sides, as they do without it") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int run = 0; run < 20; ++run) {
    Soup soup;
    const double high = number(2.0, 4.0), reach = number(10.0, 15.0);
    soup.polygon({{-reach, -reach, 0}, {reach, -reach, 0}, {reach, reach, 0}, {-reach, reach, 0}});
    const int walls = 1 + run % 4;
    for (int w = 0; w < walls; ++w) {
      const double turn = number(0.0, 2.0 * pi);
      const glm::dvec3 from{4.0 * (w % 2) - 2.0, 4.0 * (w / 2) - 2.0, 0.0},
          to = from + 1.5 * glm::dvec3(std::cos(turn), std::sin(turn), 0.0);
      soup.names.push_back("wall");
      soup.polygon({from, to, to + glm::dvec3(0, 0, high), from + glm::dvec3(0, 0, high)});
    }
    const double seen = soup.area();
    add_sky(soup, 2.5 * reach, -1.0, 16, false);
    const radiosity::Intake taken = soup.take_in(unknown);
    CHECK(count_of(taken, ChangeKind::open) == static_cast<std::size_t>(walls) + 1);
    CHECK(measure(taken.objects).area == Approx(soup.area() + seen).epsilon(1e-6));
  }
}

TEST_CASE("intake: a sky whose polygons are objects of their own shines inwards, and what it lights is not turned") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int run = 0; run < 20; ++run) {
    Soup soup;
    soup.polygon({{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}});
    for (int k = 0; k < 4; ++k) {
      const glm::dvec3 lo{number(-6.0, 0.0), 4.0 * k - 8.0, 0.0};
      soup.names.push_back("house");
      add_box(soup, lo, lo + glm::dvec3(number(1.0, 5.0), number(1.0, 3.0), number(1.0, 5.0)));
    }
    add_sky(soup, number(18.0, 40.0), number(-2.0, 0.0), 12 + 4 * (run % 4), true);
    const radiosity::Intake taken = soup.take_in(unknown);
    CHECK(count_of(taken, ChangeKind::to_light) == 0);
    for (const radiosity::SceneObject& object : taken.objects) {
      if (object.name.substr(0, 3) != "sky") { continue; }
      brep::Builder builder;
      object.shape->approximate(1.0, builder);
      for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
        std::vector<glm::dvec3> p;
        for (const std::uint32_t v : builder.corners(f)) { p.push_back(builder.position(v)); }
        CHECK((builder.sheet(f) == brep::no_sheet || glm::dot(p[0], brep::vector_area(p)) < 0.0));
      }
    }
  }
}
