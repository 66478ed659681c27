// SPDX-License-Identifier: MIT
// Booleans of many faces, and of many solids, whose answers are known: spheres, sponges, grids of cubes.
#include "csg_answers.hpp"

using namespace solids;

TEST_CASE("spheres: identical, and two that overlap as four engines agree") {
  const Grid g(glm::dvec3(-2.0), glm::dvec3(2.0));
  const Solid six = made(octasphere(6, glm::dvec3(0.0)), g);
  check(valid(csg::unite(six, six)), {2, 1, 4.01766857131}, 1e-7);  // vertices are snapped to 2^-24: the area times that
  CHECK(valid(csg::subtract(six, six)).empty());
  const Solid a = made(octasphere(11, glm::dvec3(0.0)), g), b = made(octasphere(11, {.503, .307, .201}), g);
  const All x = all(a, b);
  check(x.u, {2, 1, 6.01261766382}, 1e-7);
  check(x.i, {2, 1, 2.26061728631}, 1e-7);
  check(x.d, {2, 1, 1.87600018875}, 1e-7);

  struct Fine {
    int f;
    double u, i, d;
  };
  for (const Fine& fine : {Fine{35, 6.07474501414, 2.2924300873, 1.89115746342}, Fine{112, 6.08095496488, 2.29560833901, 1.89267331293}}) {
    const Solid left = made(octasphere(fine.f, glm::dvec3(0.0)), g), right = made(octasphere(fine.f, {.503, .307, .201}), g);
    const auto volume = [](const Result<Solid>& result) {
      REQUIRE(result);
      return csg::volume(*result);
    };
    CHECK(volume(csg::unite(left, right)) == test::Approx(fine.u).epsilon(0).margin(1e-6));
    CHECK(volume(csg::intersect(left, right)) == test::Approx(fine.i).epsilon(0).margin(1e-6));
    CHECK(volume(csg::subtract(left, right)) == test::Approx(fine.d).epsilon(0).margin(1e-6));
  }
}

TEST_CASE("a chain of twenty spheres is one solid without a handle, from whichever end it is joined") {
  const Grid g(glm::dvec3(-2.0), glm::dvec3(18.0));
  Solid chain[2];
  for (int end = 0; end < 2; ++end) {
    for (int k = 0; k < 20; ++k) {
      const Solid next = made(octasphere(11, {.8 * (end == 0 ? k : 19 - k), 0.0, 0.0}), g);
      chain[end] = k == 0 ? next : valid(csg::unite(chain[end], next));
    }
  }
  const Counts forth = counts(chain[0]), back = counts(chain[1]);
  CHECK((forth.chi() == 2 && forth.shells == 1 && back.chi() == 2 && back.shells == 1));
  CHECK(forth.volume == test::Approx(back.volume).epsilon(1e-12));
}

TEST_CASE("Menger sponges by bars, flush and sticking out") {
  const Counts expected[] = {{0, 0, 0, 1, 5, 20.0, 72.0}, {0, 0, 0, 1, 81, 400.0, 1056.0}, {0, 0, 0, 1, 1409, 8000.0, 18048.0}};
  for (int level : {1, 2, 3}) {
    for (double out : {0.0, 1.0}) {
      const int side = level == 1 ? 3 : level == 2 ? 9 : 27;
      Solid r = made(box(glm::dvec3(0.0), glm::dvec3(side)), Grid(glm::dvec3(-2.0), glm::dvec3(30.0)));
      for (int step = side; step > 1; step /= 3) {
        for (int bar = 0; bar < 3 * (side / step) * (side / step); ++bar) {
          const int axis = bar % 3, i = bar / 3 % (side / step), j = bar / 3 / (side / step);
          glm::dvec3 lo(0.0);
          lo[(axis + 1) % 3] = i * step + step / 3, lo[(axis + 2) % 3] = j * step + step / 3;
          glm::dvec3 hi = lo + glm::dvec3(step / 3);
          lo[axis] = -out, hi[axis] = side + out;
          const auto next = csg::subtract(r, made(box(lo, hi), r.grid()));
          REQUIRE(next);
          r = *next;
        }
      }
      if (level < 3) { CHECK(faults(r) == ""); }
      const Counts c = counts(r), &e = expected[level - 1];
      CHECK((c.shells == e.shells && c.genus == e.genus));
      CHECK(c.volume == test::Approx(e.volume));
      CHECK(c.area == test::Approx(e.area));
    }
  }
}

TEST_CASE("the Menger sponge of level 4: 2460 bars united two by two, then taken away at once", "[slow]") {
  const int side = 81;
  const Grid g(glm::dvec3(-2.0), glm::dvec3(side + 2.0));
  std::vector<Solid> bars;
  for (int step = side; step > 1; step /= 3) {
    for (int bar = 0; bar < 3 * (side / step) * (side / step); ++bar) {
      const int axis = bar % 3, i = bar / 3 % (side / step), j = bar / 3 / (side / step);
      glm::dvec3 lo(0.0);
      lo[(axis + 1) % 3] = i * step + step / 3, lo[(axis + 2) % 3] = j * step + step / 3;
      glm::dvec3 hi = lo + glm::dvec3(step / 3);
      lo[axis] = -1.0, hi[axis] = side + 1.0;
      bars.push_back(made(box(lo, hi), g));
    }
  }
  while (bars.size() > 1) {
    std::vector<Solid> pairs;
    for (std::size_t i = 0; i + 1 < bars.size(); i += 2) {
      const auto both = csg::unite(bars[i], bars[i + 1]);
      REQUIRE(both);
      pairs.push_back(*both);
    }
    if (bars.size() % 2 == 1) { pairs.push_back(bars.back()); }
    bars = std::move(pairs);
  }
  const auto sponge = csg::subtract(made(box(glm::dvec3(0.0), glm::dvec3(side)), g), bars[0]);
  REQUIRE(sponge);
  const Counts c = counts(*sponge);
  CHECK((c.shells == 1 && c.genus == 26433));
  CHECK(c.volume == test::Approx(160000.0));
  CHECK(c.area == test::Approx(2 * 160000.0 + 4 * 4096.0));  // 2 20^n + 4 8^n
}

TEST_CASE("a Menger sponge of 400 cubes is the sponge that bars cut out") {
  Solid r;
  const Grid g(glm::dvec3(0.0), glm::dvec3(9.0));
  for (int cell = 0; cell < 729; ++cell) {
    const glm::ivec3 at(cell % 9, cell / 9 % 9, cell / 81);
    const auto holes = [](const glm::ivec3& p) { return (p.x % 3 == 1) + (p.y % 3 == 1) + (p.z % 3 == 1) > 1; };
    if (holes(at) || holes(at / 3)) { continue; }
    const Solid next = made(box(glm::dvec3(at), glm::dvec3(at) + 1.0), g);
    if (r.empty()) {
      r = next;
      continue;
    }
    const auto both = csg::unite(r, next);
    REQUIRE(both);
    r = *both;
  }
  CHECK(faults(r) == "");
  const Counts c = counts(r);
  CHECK((c.shells == 1 && c.genus == 81));
  CHECK(c.volume == test::Approx(400.0));
  CHECK(c.area == test::Approx(1056.0));
}

TEST_CASE("unit cubes: a full grid, a checkerboard and a ring") {
  Solid full, board, ring;
  const Grid g(glm::dvec3(0.0), glm::dvec3(4.0));
  for (int k = 0; k < 27; ++k) {
    const glm::dvec3 at(k % 3, k / 3 % 3, k / 9);
    const Solid c = made(box(at, at + 1.0), g);
    const auto add = [&](Solid& to) {
      const auto sum = to.empty() ? Result<Solid>(c) : csg::unite(to, c);
      REQUIRE(sum);
      to = *sum;
    };
    add(full);
    if (k % 2 == 0) { add(board); }
    if (k < 9 && k != 4) { add(ring); }
  }
  for (const Solid* s : {&full, &board, &ring}) { CHECK(faults(*s) == ""); }
  CHECK(counts(full) == Counts{8, 12, 6, 1, 0, 0, 0});
  check(full, {2, 1, 27.0});
  check(board, {28, 14, 14.0});
  check(ring, {0, 1, 8.0});
  // A checkerboard and its complement in the box are the box again.
  check(valid(csg::unite(board, valid(csg::subtract(full, board)))), {2, 1, 27.0});
}
