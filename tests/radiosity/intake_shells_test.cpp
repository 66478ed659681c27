// SPDX-License-Identifier: MIT
// The intake: which shells become rooms, solids or sheets, and which sides of them are seen.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
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
using soup::Soup;

TEST_CASE("intake: a closed shell around a lamp is a room, whichever way it looked") {
  for (const bool inwards : {false, true}) {
    Soup soup;
    soup::add_box(soup, {0, 0, 0}, {4, 4, 3}, 1, inwards);
    soup.polygon({{1, 1, 2.9}, {1, 2, 2.9}, {2, 2, 2.9}, {2, 1, 2.9}}, 1);
    const radiosity::Intake intake = soup.take_in();
    check_sound(soup, intake);
    const soup::Measure m = measure(intake.objects);
    CHECK(m.rooms == 1);
    CHECK(m.surfaces == 1);
    CHECK(count_of(intake, ChangeKind::room) == (inwards ? 0 : 1));

    // Where something is beyond its walls it is a surface: a room would bury what is there.
    soup::add_box(soup, {10, 0, 0}, {11, 1, 1});
    const radiosity::Intake two = soup.take_in();
    check_sound(soup, two);
    CHECK(measure(two.objects).rooms == 0);
    CHECK(measure(two.objects).solids == 1);
    CHECK(measure(two.objects).area == Approx(m.area + 6.0).epsilon(1e-12));
  }
  // The upper half of a lamp is let into a slab: that is no room.
  Soup soup;
  soup::add_box(soup, {0, 0, 2}, {4, 4, 2.5});
  soup::add_box(soup, {1, 1, 1.9}, {2, 2, 2.1}, 1, false, 1);
  CHECK(measure(soup.take_in().objects).rooms == 0);
  // An empty shell that looks inwards was meant to be seen from outside.
  Soup empty;
  soup::add_box(empty, {0, 0, 0}, {1, 1, 1}, 1, true);
  CHECK(measure(empty.take_in().objects).volume == Approx(1.0).epsilon(1e-12));
  CHECK(count_of(empty.take_in(), ChangeKind::inside_out) == 1);
  const radiosity::IntakeOptions options{.eyes = {{0.5, 0.5, 0.5}}};
  CHECK(measure(empty.take_in(options).objects).rooms == 1);
}

// Whether the lamp's middle is inside the shell is rounding's choice; that it shines into it is not.
TEST_CASE("intake: a closed shell on whose walls lamps lie is a room, wherever it stands") {
  const unsigned seed = 20261123;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int round = 0; round < 40; ++round) {
    const bool inwards = round % 2 == 0, face_up = round % 4 == 2;  // a lamp with its back to an inward shell
    const double size = std::exp(6.0 * unit(random));
    Soup soup, solid;
    soup::add_box(soup, {0, 0, 0}, {4, 4, 3}, round % 3 == 0 ? 3 : 1, inwards);  // by 2 a lamp's edge is one of three faces: no shell
    soup::add_box(soup, {1, 1, 0}, {2, 2, 1});
    std::vector<glm::dvec3> lamp{{1, 1, 3}, {1, 2, 3}, {2, 2, 3}, {2, 1, 3}};  // faces down
    if (face_up) { std::reverse(lamp.begin(), lamp.end()); }
    soup.polygon(lamp, 1);
    // A lamp that lies on a table and faces up does not shine into it.
    soup::add_box(solid, {0, 0, 0}, {4, 4, 3});
    solid.polygon({{1, 1, 3}, {2, 1, 3}, {2, 2, 3}, {1, 2, 3}}, 1);
    const glm::dvec3 by{10.0 * unit(random), 10.0 * unit(random), 10.0 * unit(random)};
    for (Soup* const s : {&soup, &solid}) {
      for (glm::dvec3& p : s->positions) { p = size * (p + by); }
    }
    CHECK(measure(soup.take_in().objects).rooms == 1);
    CHECK(measure(solid.take_in().objects).rooms == 0);
    CHECK(measure(solid.take_in().objects).solids == 1);
  }
}

// A bulb whose faces were given clockwise must not become a room that lights only itself.
TEST_CASE("intake: a closed lamp shines into its room, whichever way it looked") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const glm::dvec3 lo = glm::dvec3(0.2, 0.2, 1.5) + 0.5 * glm::dvec3(unit(random), unit(random), unit(random));
    const glm::dvec3 hi = lo + 0.1 + 0.3 * glm::dvec3(unit(random), unit(random), unit(random));
    const bool thick = round % 4 > 1;
    std::array<soup::Measure, 2> found;
    for (const bool inwards : {false, true}) {
      Soup soup;
      soup::add_box(soup, {0, 0, 0}, {4, 4, 3}, 1, true);
      if (thick) { soup::add_box(soup, {-0.2, -0.2, -0.2}, {4.2, 4.2, 3.2}); }
      soup::add_box(soup, {1, 1, 0.1}, {2, 2, 1});
      soup::add_box(soup, lo, hi, 1 + round % 3, inwards, 1);
      const radiosity::Intake intake = soup.take_in();
      check_sound(soup, intake);
      CHECK(count_of(intake, ChangeKind::inside_out) == (inwards ? 1 : 0));
      found[inwards ? 1 : 0] = measure(intake.objects);
    }
    CHECK(found[1].rooms == found[0].rooms);
    CHECK(found[1].rooms == (thick ? 0 : 1));
    CHECK(found[1].solids == found[0].solids);
    CHECK(found[1].volume == Approx(found[0].volume).epsilon(1e-12));
  }
}

TEST_CASE("intake: a bulb in a shade is a lamp, whichever way it looked, with and without a floor") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 40; ++round) {
    const double width = 0.1 + 0.2 * unit(random), height = 0.1 + 0.5 * unit(random), below = 0.3 * (unit(random) - 0.5);
    Soup soup;
    if (round % 2 == 0) { soup.polygon({{-2, -2, -1}, {2, -2, -1}, {2, 2, -1}, {-2, 2, -1}}); }
    constexpr int sides = 16;
    const auto at = [&](int k, double z) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      return glm::dvec3(2.0 * width * std::cos(angle), 2.0 * width * std::sin(angle), z);
    };
    for (int k = 0; k < sides; ++k) {
      soup.polygon({at(k, below - height), at(k + 1, below - height), at(k + 1, below + height), at(k, below + height)});
    }
    soup::add_box(soup, glm::dvec3(-0.5 * width), glm::dvec3(0.5 * width), 2, round % 4 > 1, 1);
    const radiosity::Intake intake = soup.take_in();
    check_sound(soup, intake);
    CHECK(measure(intake.objects).solids == 1);
    CHECK(measure(intake.objects).volume == Approx(width * width * width).epsilon(1e-9));
  }
}

// A statue whose eyes and teeth are open surfaces within it, and a room with a carpet and a picture; neither has a lamp.
TEST_CASE("intake: an inverted body that holds open surfaces is a solid, walls that hold them are a room") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int run = 0; run < 20; ++run) {
    const bool room = run % 2 == 0;
    const double tube = number(0.2, 0.6);
    Soup outside, model;
    if (room) {
      soup::add_box(outside, {-2, -2, -1}, {2, 2, 1}, 1 + run % 4);
    } else {
      soup::add_torus(outside, 9, 7, 1.0, tube);
    }
    for (std::size_t f = 0; f < outside.count(); ++f) {
      std::vector<glm::dvec3> p = outside.outline(f);
      std::reverse(p.begin(), p.end());
      model.polygon(p);
    }
    for (int i = 0; i < 3; ++i) {
      const double a = number(0.0, 6.3), size = 0.2 * tube;
      const glm::dvec3 at(std::cos(a), std::sin(a), 0.0);
      const auto off = [&] { return size * glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1)); };
      model.polygon({at + off(), at + off(), at + off()});
    }
    const soup::Measure m = measure(model.take_in().objects);
    CHECK(m.rooms == (room ? 1U : 0U));
    CHECK(m.solids == (room ? 0U : 1U));
    CHECK(m.surfaces >= 1);
  }
}

// From outside the outer side of walls around a lit room looks the same.
TEST_CASE("intake: lamps in a room with an eye in it shine into it, even when all of the model is inside out") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const int lamps = 1 + round % 4;
    std::array<soup::Measure, 2> found;
    for (const bool inside_out : {false, true}) {
      Soup soup;
      soup::add_box(soup, {0, 0, 0}, {4, 4, 3}, 1, !inside_out);
      for (int i = 0; i < lamps; ++i) {
        const glm::dvec3 lo = glm::dvec3(0.2 + i, 0.2, 0.1) + 0.5 * glm::dvec3(0.5, unit(random), unit(random));
        soup::add_box(soup, lo, lo + glm::dvec3(0.4, 0.5, 0.6), 1, inside_out, 1);
      }
      radiosity::IntakeOptions inside;
      inside.eyes = {{0.5 + 3.0 * unit(random), 3.0, 2.0}};
      const radiosity::Intake intake = soup.take_in(inside);
      check_sound(soup, intake);
      found[inside_out ? 1 : 0] = measure(intake.objects);
      CHECK(intake.objects.size() == static_cast<std::size_t>(lamps) + 1);
    }
    CHECK(found[1].rooms == 1);
    CHECK(found[0].rooms == 1);
    CHECK(found[1].solids == static_cast<std::size_t>(lamps));
    CHECK(found[0].solids == static_cast<std::size_t>(lamps));
  }
}

// Turned inside out, a globe or a housing would show what is in it, and hide the room that it lights.
TEST_CASE("intake: a closed thing around a bulb stays a thing while an eye, or its own light, is in the room around it") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 20; ++round) {
    const bool shines = round % 2 == 0, eye = !shines || round % 4 == 0, sides_unknown = round % 3 == 0;
    const bool flush = round % 5 == 0, room_first = unit(random) < 0.5, room_inwards = unit(random) < 0.5;
    CAPTURE(round, shines, eye, sides_unknown, flush, room_first);
    Soup soup;
    const auto room = [&] { soup::add_box(soup, {0, 0, 0}, {4, 4, 3}, 1, room_inwards); };
    if (room_first) { room(); }
    glm::dvec3 lo = glm::dvec3(1.0, 1.0, 1.0) + 0.5 * glm::dvec3(unit(random), unit(random), unit(random)), size(0.4, 0.5, 0.6);
    if (flush) { lo.z = 3.0 - size.z; }
    soup::add_box(soup, lo, lo + size, 1, false, shines ? 1 : 0);
    soup::add_box(soup, lo + glm::dvec3(0.1), lo + glm::dvec3(0.2), 1, false, 1);
    if (!room_first) { room(); }
    radiosity::IntakeOptions options{.sides_unknown = sides_unknown};
    if (eye) { options.eyes = {{0.5, 3.0 * unit(random) + 0.5, 2.0}}; }
    const radiosity::Intake intake = soup.take_in(options);
    check_sound(soup, intake);
    const soup::Measure found = measure(intake.objects);
    CHECK(found.rooms == 1);
    CHECK(found.solids == 2);
  }
}

// Many programs give every material a little light of its own. It must not turn the outer side of the walls into the room.
TEST_CASE("intake: walls that shine stay what walls that do not shine are") {
  for (const bool furnished : {false, true}) {
    std::array<soup::Measure, 2> found;
    for (const std::uint32_t material : {0U, 1U}) {
      Soup soup;
      soup::add_box(soup, {-0.2, -0.2, -0.2}, {4.2, 4.2, 3.2}, 1, false, material);
      soup::add_box(soup, {0, 0, 0}, {4, 4, 3}, 1, true, material);
      if (furnished) { soup::add_box(soup, {1, 1, 0.1}, {2, 2, 1}, 1, false, material); }
      const radiosity::IntakeOptions inside{.eyes = {{0.5, 0.5, 0.5}}};
      const radiosity::Intake intake = soup.take_in(inside);
      check_sound(soup, intake);
      CHECK(count_of(intake, ChangeKind::room) == 0);
      CHECK(count_of(intake, ChangeKind::inside_out) == 0);
      found[material] = measure(intake.objects);
    }
    CHECK(found[1].rooms == 0);
    CHECK(found[1].solids == found[0].solids);
    CHECK(found[1].volume == Approx(found[0].volume).epsilon(1e-12));
  }
  Soup furnace;  // alone, it is a room
  soup::add_box(furnace, {0, 0, 0}, {1, 1, 1}, 1, true, 1);
  CHECK(measure(furnace.take_in().objects).rooms == 1);
}

// What is in a solid is buried, so a room within walls must not be in one.
TEST_CASE("intake: walls with a thickness around a room are a solid with a cavity") {
  for (const bool outwards : {false, true}) {  // how the inner shell looked
    Soup soup;
    soup::add_box(soup, {-0.1, -0.1, -0.1}, {8.1, 4.1, 3.1}, 2);
    soup::add_box(soup, {0, 0, 0}, {4, 4, 3}, 1, !outwards);
    soup::add_box(soup, {4.1, 0, 0}, {8, 4, 3}, 1, !outwards);
    for (const double x : {1.0, 5.0}) {
      soup::add_box(soup, {x, 1, 0.5}, {x + 1, 2, 1});
      soup.polygon({{x, 1, 2.9}, {x, 2, 2.9}, {x + 1, 2, 2.9}, {x + 1, 1, 2.9}}, 1);
    }
    soup::add_box(soup, {9, 0, 0}, {10, 1, 1});  // outside
    const radiosity::Intake intake = soup.take_in();
    check_sound(soup, intake);
    const soup::Measure m = measure(intake.objects);
    CHECK(m.rooms == 0);
    CHECK(m.solids == 4);
    CHECK(m.volume == Approx(8.2 * 4.2 * 3.2 - 4.0 * 4.0 * 3.0 - 3.9 * 4.0 * 3.0 + 0.5 + 0.5 + 1.0).epsilon(1e-9));
    CHECK(count_of(intake, ChangeKind::room) == (outwards ? 2 : 0));
  }
}

// As programs write them that know no material with two sides.
TEST_CASE("intake: walls that were given twice, for both sides, bury nothing") {
  for (const bool inwards_first : {false, true}) {
    const auto twice = [&](Soup& soup, const glm::dvec3& lo, const glm::dvec3& hi) {
      soup::add_box(soup, lo, hi, 1, inwards_first);
      soup::add_box(soup, lo, hi, 1, !inwards_first);
    };
    Soup room;
    twice(room, {0, 0, 0}, {4, 4, 3});
    twice(room, {1, 1, 0}, {2, 2, 1});
    room.polygon({{1, 1, 2.9}, {1, 2, 2.9}, {2, 2, 2.9}, {2, 1, 2.9}}, 1);
    const radiosity::Intake lit = room.take_in();
    CHECK(measure(lit.objects).rooms == 1);
    CHECK(measure(lit.objects).solids == 1);
    CHECK(count_of(lit, ChangeKind::duplicate) == 24);
    CHECK(lit.faces == 13);
    // With something beyond them both sides are seen.
    soup::add_box(room, {10, 0, 0}, {11, 1, 1});
    const radiosity::Intake outside = room.take_in();
    CHECK(measure(outside.objects).rooms == 0);
    CHECK(measure(outside.objects).solids == 2);
    CHECK(outside.faces == 6 + 6 + 6 + 6 + 1);
    radiosity::Scene scene{room.materials, outside.objects};
    CHECK(radiosity::faults(scene).empty());
  }
}

TEST_CASE("intake: solids that touch in an edge or a vertex stay solids") {
  Soup soup;
  soup::add_box(soup, {0, 0, 0}, {1, 1, 1});
  soup::add_box(soup, {1, 1, 0}, {2, 2, 1});
  soup::add_box(soup, {2, 2, 1}, {3, 3, 2});
  const radiosity::Intake intake = soup.take_in();
  check_sound(soup, intake);
  CHECK(measure(intake.objects).solids == 3);
  CHECK(measure(intake.objects).volume == Approx(3.0).epsilon(1e-12));
  CHECK(count_of(intake, ChangeKind::nonmanifold) == 0);
}

TEST_CASE("intake: sheets have two sides where the caller, the material or the file's own disorder says so") {
  Soup soup;
  soup.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK(measure(soup.take_in().objects).area == Approx(1.0));
  const radiosity::IntakeOptions options{.two_sided = true};
  CHECK(measure(soup.take_in(options).objects).area == Approx(2.0));
  soup.two_sided = {1, 0};
  CHECK(measure(soup.take_in().objects).area == Approx(2.0));
  // Both sides are in the file: nothing is added, nothing is taken away.
  soup.two_sided.clear();
  soup.polygon({{0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}});
  CHECK(measure(soup.take_in().objects).area == Approx(2.0));
  check_sound(soup, soup.take_in());

  Soup strip;  // Moebius: 12 quadrilaterals, half a turn
  const auto at = [](int i, double side) {
    const double a = 2.0 * std::numbers::pi * i / 12, half = a / 2.0;
    const glm::dvec3 out(std::cos(a), std::sin(a), 0.0);
    return 2.0 * out + side * (std::cos(half) * out + std::sin(half) * glm::dvec3(0, 0, 1));
  };
  for (int i = 0; i < 12; ++i) { strip.polygon({at(i, -0.3), at(i + 1, -0.3), at(i + 1, 0.3), at(i, 0.3)}); }
  const radiosity::Intake intake = strip.take_in();
  check_sound(strip, intake);
  CHECK(count_of(intake, ChangeKind::moebius) >= 1);
  CHECK(count_of(intake, ChangeKind::both_sides) == 1);
  CHECK(measure(intake.objects).area == Approx(measure(strip.take_in(options).objects).area));  // as if all were asked for
}
