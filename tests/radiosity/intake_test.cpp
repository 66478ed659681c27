// SPDX-License-Identifier: MIT
// The intake: whatever comes in, what goes out can be solved, and is the same surface.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using radiosity::ChangeKind;
using soup::check_sound;
using soup::count_of;
using soup::measure;
using soup::size_of;
using soup::Soup;

TEST_CASE("intake: a box of loose triangles becomes one solid of six faces") {
  Soup soup;
  soup::add_box(soup, {0, 0, 0}, {1, 2, 3}, 4);
  const radiosity::Intake intake = soup.take_in();
  check_sound(soup, intake);
  REQUIRE(intake.objects.size() == 1);
  CHECK(intake.faces == 6);
  CHECK(intake.objects[0].shape->convex());
  CHECK(intake.objects[0].name == "thing");
  CHECK(measure(intake.objects).volume == Approx(6.0).epsilon(1e-12));
  CHECK(count_of(intake, ChangeKind::merged) == soup.count() - 6);
  CHECK(count_of(intake, ChangeKind::t_joint) == 0);

  const radiosity::IntakeOptions as_given{.merge = false};
  CHECK(soup.take_in(as_given).faces == soup.count());
}

// A closed surface is damaged at random in every way that keeps it the same surface to the eye.
TEST_CASE("intake: a damaged closed surface is closed again, with its area and volume") {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
    const auto chance = [&](double p) { return number(0.0, 1.0) < p; };
    Soup whole;
    soup::add_torus(whole, 24, 14);
    const double before = whole.area(), volume = measure(whole.take_in().objects).volume;
    REQUIRE(volume > 0.0);

    const double jitter = 1e-7;  // of each coordinate; the diagonal is 4.04, so the tolerance is 4e-6
    Soup soup;
    std::size_t turned = 0, doubled = 0, flat = 0;
    std::vector<std::size_t> order(whole.count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t f : order) {
      std::vector<glm::dvec3> p = whole.outline(f);
      std::rotate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(random() % p.size()), p.end());
      const bool turn = chance(0.2);
      if (turn) { std::reverse(p.begin(), p.end()); }
      turned += turn ? 1 : 0;
      const auto shaken = [&](std::vector<glm::dvec3> points) {
        for (glm::dvec3& x : points) { x += jitter * glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1)); }
        return points;
      };
      if (chance(0.1)) {
        soup.polygon(shaken(p));
        ++doubled;
      }
      if (chance(0.1)) {
        soup.polygon({p[0], p[1], p[0], p[1]});
        ++flat;
      }
      std::vector<glm::dvec3> points = shaken(p);
      if (chance(0.1)) { points.insert(points.begin() + 1, points[0]); }
      if (chance(0.1)) {  // a T-joint: the other face knows nothing of this corner
        points.insert(points.begin() + 1, 0.5 * (points[0] + points[1]));
      }
      soup.polygon(points);
    }
    const radiosity::Intake intake = soup.take_in();
    check_sound(soup, intake);
    const soup::Measure after = measure(intake.objects);
    for (const radiosity::Change& change : intake.changes) { UNSCOPED_INFO(radiosity::sentence(change)); }
    REQUIRE(intake.objects.size() == 1);
    CHECK(after.solids == 1);
    // A vertex moves by at most sqrt(3) jitter + the tolerance of flattening: the area by that times the length of all edges, 900 of them
    // of length 0.3 each.
    CHECK(after.area == Approx(before).margin(900 * 0.3 * 5e-6));
    CHECK(after.volume == Approx(volume).margin(before * 5e-6));
    CHECK(count_of(intake, ChangeKind::duplicate) == doubled);
    CHECK(count_of(intake, ChangeKind::no_area) == flat);
    CHECK(count_of(intake, ChangeKind::turned) == turned);
    CHECK(size_of(intake, ChangeKind::welded) <= 2.0 * std::sqrt(3.0) * jitter);
    CHECK(count_of(intake, ChangeKind::nonmanifold) == 0);
    CHECK(count_of(intake, ChangeKind::loose) == 0);
  }
}

TEST_CASE("intake: no input is refused, and no area gets lost") {
  for (const unsigned seed : {11U, 12U, 13U, 14U, 15U, 16U, 17U, 18U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
    Soup soup;
    for (int i = 0; i < 40; ++i) { soup.vertex({number(0, 1), number(0, 1), number(0, 1)}); }
    // Triangles of common vertices: edges of many faces, flipped neighbours, vertices with several fans.
    double area = 0.0;
    for (int i = 0; i < 150; ++i) {
      std::vector<std::uint32_t> corners;
      for (int k = 0; k < 3; ++k) { corners.push_back(static_cast<std::uint32_t>(random() % soup.positions.size())); }
      soup.face(corners);
    }
    const radiosity::Intake intake = soup.take_in();
    check_sound(soup, intake);
    std::vector<std::array<std::uint32_t, 3>> kept;  // duplicates cover each other
    for (std::size_t f = 0; f < soup.count(); ++f) {
      std::array<std::uint32_t, 3> key{soup.corners[3 * f], soup.corners[3 * f + 1], soup.corners[3 * f + 2]};
      std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
      if (std::find(kept.begin(), kept.end(), key) != kept.end()) { continue; }
      kept.push_back(key);
      area += brep::area(soup.outline(f));
    }
    const double sides = measure(intake.objects).area;  // surfaces of mixed orientation have two
    CHECK(sides >= area * (1.0 - 1e-9));
    CHECK(sides <= 2.0 * area * (1.0 + 1e-9));
  }
}

TEST_CASE("intake: polygons of any number of corners, planar or not, keep their outline") {
  for (const unsigned seed : {21U, 22U, 23U, 24U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
    Soup soup;
    double flat_area = 0.0;
    for (int i = 0; i < 20; ++i) {  // stars, most of them concave, each at its own place
      const int n = 3 + static_cast<int>(random() % 40);
      const bool bent = i % 2 == 1;
      std::vector<glm::dvec3> points;
      for (int k = 0; k < n; ++k) {
        const double a = 2.0 * std::numbers::pi * k / n, r = number(0.3, 1.0);
        points.emplace_back(r * std::cos(a) + 4.0 * i, r * std::sin(a), bent && n > 3 ? number(-0.05, 0.05) : 0.0);
      }
      soup.polygon(points);
      std::vector<glm::dvec3> shadow = points;
      for (glm::dvec3& p : shadow) { p.z = 0.0; }
      flat_area += brep::area(shadow);
    }
    const radiosity::Intake intake = soup.take_in();
    check_sound(soup, intake);
    CHECK(count_of(intake, ChangeKind::crossing) == 0);
    CHECK(size_of(intake, ChangeKind::not_planar) < 0.15);
    // The triangles of a bent star cover its shadow once: their vector areas add up to that of the outline, whichever diagonals are cut.
    double shadow = 0.0;
    for (const radiosity::SceneObject& object : intake.objects) {
      brep::Builder builder;
      object.shape->approximate(1.0, builder);
      for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
        if (builder.sheet(f) == brep::no_sheet) { continue; }
        std::vector<glm::dvec3> p;
        for (const std::uint32_t v : builder.corners(f)) { p.push_back(builder.position(v)); }
        shadow += brep::vector_area(p).z;
      }
    }
    CHECK(shadow == Approx(flat_area).epsilon(1e-5));  // vertices move by up to the tolerance, 1e-6 of the length of the row
  }
}

// Files have no holes, so their outlines run along a bridge edge to each hole, around it and back.
TEST_CASE("intake: a wall with holes that bridge edges lead to keeps its area, and is not said to cross itself") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  const glm::dvec3 u = glm::normalize(glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1)));
  const glm::dvec3 v = glm::normalize(glm::cross(u, glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1))));
  Soup soup;
  double area = 0.0;
  std::size_t with_holes = 0;
  for (int wall = 0; wall < 20; ++wall) {
    std::vector<glm::dvec3> outline;
    const auto corner = [&](double x, double y) { outline.push_back(x * u + y * v + (2.0 * wall) * glm::cross(u, v)); };
    const int holes = static_cast<int>(random() % 4);
    corner(0, 0);
    area += 4.0 * (holes + 1);
    with_holes += holes > 0 ? 1 : 0;
    for (int i = 0; i < holes; ++i) {
      const double a = i + number(0.1, 0.3), b = i + number(0.6, 0.9), low = number(0.5, 1.0), high = number(2.0, 3.0);
      area -= (b - a) * (high - low);
      corner(a, 0), corner(a, low), corner(a, high), corner(b, high), corner(b, low), corner(a, low), corner(a, 0);
    }
    corner(holes + 1, 0), corner(holes + 1, 4), corner(0, 4);
    soup.polygon(outline);
  }
  const radiosity::Intake intake = soup.take_in();
  check_sound(soup, intake);
  CHECK(measure(intake.objects).area == Approx(area).epsilon(1e-4));  // vertices move by up to the tolerance
  CHECK(count_of(intake, ChangeKind::crossing) == 0);
  CHECK(count_of(intake, ChangeKind::touching) == with_holes);
  CHECK(count_of(intake, ChangeKind::not_planar) == 0);
  soup.polygon({{0, 0, 50}, {number(1, 2), 0, 50}, {0, number(1, 2), 50}, {number(1, 2), number(1, 2), 50}});  // a bow tie
  CHECK(count_of(soup.take_in(), ChangeKind::crossing) == 1);
}

TEST_CASE("intake: a quadrilateral that is not planar is cut along the better diagonal") {
  // Over 0 and 2 it folds into a roof, over 1 and 3 into a thin valley: the first one bends less.
  Soup soup;
  soup.polygon({{0, 0, 0}, {1, 0, 0.02}, {2, 2, 0}, {0, 1, 0.02}});
  radiosity::IntakeOptions options;
  const radiosity::Intake intake = soup.take_in(options);
  check_sound(soup, intake);
  CHECK(intake.faces == 2);
  CHECK(count_of(intake, ChangeKind::not_planar) == 1);
  CHECK(radiosity::sentence(intake.changes[0]) == "1 polygon was not planar by 10 mm: split");
}

TEST_CASE("intake: of each change the polygon is known where it was largest, and the first") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  for (int k = 0; k < 20; ++k) {
    // Pairs of squares that share an edge but for gaps of up to 50 nm, and single squares whose last corner is off by up to 1 um, 10 m
    // apart.
    constexpr std::uint32_t pairs = 10;
    Soup soup;
    double widest = 0.0, highest = 0.0;
    std::uint32_t at_widest = 0, at_highest = 0;
    for (std::uint32_t i = 0; i < pairs; ++i) {
      const double x = 10.0 * i, gap = number(1e-9, 5e-8), off = number(1e-7, 1e-6);
      soup.polygon({{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}});
      soup.polygon({{x + 1 + gap, 0, 0}, {x + 2, 0, 0}, {x + 2, 1, 0}, {x + 1, 1, 0}});
      soup.polygon({{x + 5, 0, 0}, {x + 6, 0, 0}, {x + 6, 1, 0}, {x + 5, 1, off}});
      if (gap > widest) { widest = gap, at_widest = 3 * i + 1; }
      if (off > highest) { highest = off, at_highest = 3 * i + 2; }
    }
    const radiosity::Intake intake = soup.take_in();
    check_sound(soup, intake);
    const auto change = [&](ChangeKind kind) {
      const auto found = std::find_if(intake.changes.begin(), intake.changes.end(), [&](const auto& c) { return c.kind == kind; });
      REQUIRE(found != intake.changes.end());
      return *found;
    };
    CHECK(change(ChangeKind::welded).count == 2 * pairs);
    CHECK(change(ChangeKind::welded).first == 1);
    CHECK(change(ChangeKind::welded).worst == at_widest);
    CHECK(change(ChangeKind::flattened).first == 2);
    CHECK(change(ChangeKind::flattened).worst == at_highest);
    CHECK(radiosity::tells_size(change(ChangeKind::flattened)));
  }
}

TEST_CASE("intake: a wall with a window becomes few convex faces, of each material its own") {
  Soup soup;
  double area = 0.0;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 9; ++j) {
      if (i >= 4 && i < 8 && j >= 3 && j < 6) { continue; }
      const glm::dvec3 a(i, j, 0), b(i + 1, j, 0), c(i + 1, j + 1, 0), d(i, j + 1, 0);
      const std::uint32_t m = i == 0 ? 1 : 0;
      soup.polygon({a, b, c}, m);
      soup.polygon({a, c, d}, m);
      area += 1.0;
    }
  }
  const radiosity::Intake intake = soup.take_in();
  check_sound(soup, intake);
  REQUIRE(intake.objects.size() == 1);
  CHECK(measure(intake.objects).area == Approx(area).epsilon(1e-12));
  CHECK(intake.faces <= 12);
  CHECK(std::count(intake.objects[0].material.begin(), intake.objects[0].material.end(), 1U) == 1);
}

TEST_CASE("intake: what cannot be used is counted, not followed") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Soup soup;
  soup.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  soup.polygon({{0, 0, 0}, {std::nan(""), 0, 0}, {1, 1, 0}});
  soup.polygon({{0, 0, 0}, {infinity, 0, 0}, {1, 1, 0}});
  soup.polygon({{0, 0, 0}, {1e300, 0, 0}, {1, 1, 0}});
  soup.face({0, 1, 4'000'000'000U});
  soup.face({0, 1, 2}, 7);
  soup.face({});
  soup.face({0});
  const radiosity::Intake intake = soup.take_in();
  check_sound(soup, intake);
  CHECK(intake.faces == 1);
  CHECK(count_of(intake, ChangeKind::unusable) == 5);
  CHECK(count_of(intake, ChangeKind::no_area) == 2);
  CHECK(Soup().take_in().objects.empty());
  Soup point;
  point.polygon({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  CHECK(point.take_in().objects.empty());
}

TEST_CASE("intake: scale by a power of two changes nothing but the scale") {
  Soup soup;
  soup::add_torus(soup, 12, 8);
  soup.polygon({{3, 0, 0}, {4, 0, 0.1}, {4, 1, 0}, {3, 1, 0.1}});
  soup::add_box(soup, {5, 0, 0}, {6, 1, 1}, 3);
  const radiosity::Intake one = soup.take_in();
  for (const int power : {-40, -3, 20, 60}) {
    Soup scaled = soup;
    for (glm::dvec3& p : scaled.positions) { p *= std::ldexp(1.0, power); }
    const radiosity::Intake other = scaled.take_in();
    REQUIRE(other.changes.size() == one.changes.size());
    CHECK(other.faces == one.faces);
    for (std::size_t i = 0; i < one.changes.size(); ++i) {
      CHECK(other.changes[i].kind == one.changes[i].kind);
      CHECK(other.changes[i].count == one.changes[i].count);
      CHECK(other.changes[i].size == std::ldexp(one.changes[i].size, power));
    }
  }
}

TEST_CASE("lengths are told with two digits and a unit") {
  CHECK(radiosity::length_text(0.0018) == "1.8 mm");
  CHECK(radiosity::length_text(0.00996) == "10 mm");
  CHECK(radiosity::length_text(12.34) == "12 m");
  CHECK(radiosity::length_text(4.5e-7) == "450 nm");
  CHECK(radiosity::length_text(2345.0) == "2.3 km");
  CHECK(radiosity::length_text(0.0) == "0 mm");
  // What only rounding tells from nothing is not told.
  CHECK(radiosity::sentence({radiosity::ChangeKind::welded, 2, 1e-17, 0}) ==
        radiosity::sentence({radiosity::ChangeKind::welded, 2, 0.0, 0}));
}
