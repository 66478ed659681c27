// SPDX-License-Identifier: MIT
// Booleans of few faces whose answers are known.
#include "csg_answers.hpp"

using namespace solids;

TEST_CASE("two boxes: identical, touching, overlapping, contained") {
  struct Row {
    const char* name;
    glm::dvec3 lo, hi;
    double facing;
    Expected u, i, d, r;
  };
  const Expected none{0, 0, 0.0}, one{2, 1, 1.0};
  const Row rows[] = {
      {"identical", {0, 0, 0}, {1, 1, 1}, 0, one, one, none, none},
      {"face touch", {1, 0, 0}, {2, 1, 1}, 1, {2, 1, 2}, none, one, one},
      {"partial face touch", {1, .5, .25}, {2, 1.5, 1.25}, .375, {2, 1, 2}, none, one, one},
      {"edge touch", {1, 1, 0}, {2, 2, 1}, 0, {4, 2, 2}, none, one, one},
      {"partial edge touch", {1, 1, .5}, {2, 2, 1.5}, 0, {4, 2, 2}, none, one, one},
      {"vertex touch", {1, 1, 1}, {2, 2, 2}, 0, {4, 2, 2}, none, one, one},
      {"coplanar overlap", {.5, .5, 0}, {1.5, 1.5, 1}, 0, {2, 1, 1.75}, {2, 1, .25}, {2, 1, .75}, {2, 1, .75}},
      {"slide", {.5, 0, 0}, {1.5, 1, 1}, 0, {2, 1, 1.5}, {2, 1, .5}, {2, 1, .5}, {2, 1, .5}},
      {"stacked pillar", {.25, .25, 1}, {.75, .75, 2}, .25, {2, 1, 1.25}, none, one, {2, 1, .25}},
      {"pocket", {.25, .25, .5}, {.75, .75, 1}, 0, one, {2, 1, .125}, {2, 1, .875}, none},
      {"through hole", {.25, .25, 0}, {.75, .75, 1}, 0, one, {2, 1, .25}, {0, 1, .75}, none},
      {"corner bite", {0, 0, 0}, {.5, .5, .5}, 0, one, {2, 1, .125}, {2, 1, .875}, none},
      {"corner in corner", {.5, .5, .5}, {1.5, 1.5, 1.5}, 0, {2, 1, 1.875}, {2, 1, .125}, {2, 1, .875}, {2, 1, .875}},
      {"contained", {-1, -1, -1}, {2, 2, 2}, 0, {2, 1, 27}, one, none, {4, 2, 26}},
      {"apart", {2, 2, 2}, {3, 3, 3}, 0, {4, 2, 2}, none, one, one},
  };
  for (const Row& row : rows) {
    DYNAMIC_SECTION(row.name) {
      const All x = all(cube(), made(box(row.lo, row.hi)), row.facing);
      check(x.u, row.u);
      check(x.i, row.i);
      check(x.d, row.d);
      check(x.r, row.r);
    }
  }
}

TEST_CASE("what was cut apart grows together to the largest faces") {
  const Counts box_counts = counts(cube());
  CHECK(box_counts == Counts{8, 12, 6, 1, 0, 0, 0});
  CHECK(counts(valid(csg::unite(cube(), made(box({1, 0, 0}, {2, 1, 1}))))) == box_counts);
  CHECK(counts(valid(csg::unite(cube(), made(box({.5, 0, 0}, {1.5, 1, 1}))))) == box_counts);
  const Solid left = made(box({0, 0, 0}, {.25, 1, 1}));
  CHECK(counts(valid(csg::unite(left, valid(csg::subtract(cube(), left))))) == box_counts);
  // A plate with a pillar: its upper face has a hole on one bridge edge, 12 + 12 edges and the bridge.
  CHECK(counts(valid(csg::unite(cube(), made(box({.25, .25, 1}, {.75, .75, 2}))))) == Counts{16, 25, 11, 1, 0, 0, 0});
}

TEST_CASE("holes, cavities and handles are counted") {
  Solid nested;
  for (int k = 5; k >= 1; --k) {  // cubes of side 2k, added and subtracted in turn
    const Solid next = made(box(glm::dvec3(-k), glm::dvec3(k)));
    nested = k == 5 ? next : valid(k % 2 == 0 ? csg::subtract(nested, next) : csg::unite(nested, next));
  }
  check(nested, {10, 5, 1000.0 - 512.0 + 216.0 - 64.0 + 8.0});

  const Solid vug = valid(csg::subtract(made(box(glm::dvec3(-2.0), glm::dvec3(2.0))), cube()));
  const Solid half = valid(csg::intersect(vug, made(box({-3, -3, -1}, {3, 3, 3}))));
  check(half, {4, 2, 47.0});
  CHECK(csg::area(half) == test::Approx(86.0));

  const Solid drilled = valid(csg::subtract(cube(), made(moved(regular_prism(32, .25, -1, 2), glm::dmat3(1.0), {.5, .5, 0}))));
  check(drilled, {0, 1, .804909677984}, 4e-7);  // half a spacing, 2^-22, times the circumference

  Solid bars = made(box(glm::dvec3(0.0), glm::dvec3(3.0)));
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 lo(1.0), hi(2.0);
    lo[axis] = -1.0, hi[axis] = 4.0;
    bars = valid(csg::subtract(bars, made(box(lo, hi))));
  }
  check(bars, {-8, 1, 20.0});

  // Three square tubes that do not meet; coordinates in tenths and twentieths are not on the grid, hence the tolerance.
  Solid tubes = cube();
  tubes = valid(csg::subtract(tubes, made(box({-1, .15, .15}, {2, .25, .25}))));
  tubes = valid(csg::subtract(tubes, made(box({.75, -1, .45}, {.85, 2, .55}))));
  tubes = valid(csg::subtract(tubes, made(box({.15, .75, -1}, {.25, .85, 2}))));
  check(tubes, {-4, 1, 1.0 - 3 * .01}, 1e-6);

  Solid plate = made(box({0, 0, 0}, {7, 7, 1}));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) { plate = valid(csg::subtract(plate, made(box({2 * i + 1, 2 * j + 1, 0}, {2 * i + 2, 2 * j + 2, 1})))); }
  }
  check(plate, {2 - 2 * 9, 1, 49.0 - 9.0});
  CHECK(plate.face_count() == 6 + 9 * 4);  // the upper face is one polygon with nine holes
}

TEST_CASE("parts that meet in an edge or a vertex stay parts") {
  const Solid c = cube();
  const Solid quarters =
      valid(csg::subtract(valid(csg::subtract(c, made(box({0, 0, 0}, {.5, .5, 1})))), made(box({.5, .5, 0}, {1, 1, 1}))));
  check(quarters, {4, 2, .5});
  const Solid pinch = valid(csg::subtract(valid(csg::subtract(c, made(box({0, 0, 0}, {.5, .5, .5})))), made(box({.5, .5, .5}, {1, 1, 1}))));
  check(pinch, {2, 1, .75});
  // The quarters again as operands: their common edge has four faces around it.
  check(valid(csg::unite(quarters, quarters)), {4, 2, .5});
  check(valid(csg::unite(quarters, c)), {2, 1, 1.0});
  check(valid(csg::subtract(c, quarters)), {4, 2, .5});
  check(valid(csg::intersect(quarters, made(box({0, 0, .25}, {1, 1, .75})))), {4, 2, .25});
}

TEST_CASE("tetrahedra that touch a cube with a vertex, an edge, or cut through") {
  const Solid c = cube();
  const auto tetra = [](glm::dvec3 p, glm::dvec3 q, glm::dvec3 r, glm::dvec3 s) { return made(tetrahedron({p, q, r, s})); };
  const Solid on_face = tetra({.5, .5, 1}, {.25, .25, 2}, {.75, .25, 2}, {.5, .75, 2});
  const Solid on_edge = tetra({.5, 1, 1}, {.25, 1, 2}, {.75, 1, 2}, {.5, 2, 2});
  const Solid edge_on_face = tetra({.25, .5, 1}, {.75, .5, 1}, {.5, .25, 2}, {.5, .75, 2});
  for (const Solid& t : {on_face, on_edge, edge_on_face}) {
    const All x = all(c, t, 0.0);
    check(x.u, {4, 2, 1.0 + csg::volume(t)});
    CHECK(x.i.empty());
    check(valid(csg::intersect(x.u, c)), {2, 1, 1.0});
    check(valid(csg::subtract(x.u, t)), {2, 1, 1.0});
  }
  all(c, tetra({.5, .5, .5}, {.25, .25, 2}, {.75, .25, 2}, {.5, .75, 2}), 0.0);
  // Stella octangula: all edges cross edges.
  const Solid p = tetra({0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}), q = tetra({1, 1, 1}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  const All stella = all(p, q, 0.0);
  check(stella.u, {2, 1, .5});
  check(stella.i, {2, 1, 1.0 / 6.0});
  // An octahedron whose vertices lie in the middle of the faces.
  const Solid octahedron = made(octasphere(1, glm::dvec3(.5), .5));
  const All inside = all(c, octahedron, 0.0);
  check(inside.u, {2, 1, 1.0});
  check(inside.d, {4, 2, 1.0 - 1.0 / 6.0});
}

TEST_CASE("prisms on common caps") {
  const double root = std::sqrt(.5);
  const Solid a = made(box(glm::dvec3(-.5), glm::dvec3(.5))), b = made(regular_prism(4, root, -.5, .5));
  const All x = all(a, b, 0.0);
  check(x.u, {2, 1, 2.0 - (2.0 * std::sqrt(2.0) - 2.0)}, 1e-6);
  check(x.i, {2, 1, 2.0 * std::sqrt(2.0) - 2.0}, 1e-6);
  CHECK(counts(x.i).faces == 10);
  const Solid up = made(regular_prism(3, 1, 0, 1, .1)), down = made(regular_prism(3, 1, 0, 1, .1 + 3.141592653589793));
  const All star = all(up, down, 0.0);
  const double t = csg::volume(up);
  check(star.u, {2, 1, 4.0 / 3.0 * t}, 1e-6);
  check(star.i, {2, 1, 2.0 / 3.0 * t}, 1e-6);
  // One edge of a cube crosses an edge of the other in its middle.
  all(a, made(moved(box(glm::dvec3(-.5), glm::dvec3(.5)), rotation({1, 0, 0}, .785398163397448), {.25, 0, .5 + root})));
}

TEST_CASE("the smaller the perturbation, the same the combinatorics") {
  const Solid c = made(box(glm::dvec3(-.5), glm::dvec3(.5)), Grid(glm::dvec3(-1.0), glm::dvec3(1.0)));
  Counts u, i, d;
  for (int k = 1; k <= 6; ++k) {  // 10^-7 would move the corners, and a seventh of it the faces, by less than a spacing
    const double t = std::pow(10.0, -k);
    const auto turned = leaf(moved(box(glm::dvec3(-.5), glm::dvec3(.5)), rotation({1, 2, 3}, t), glm::dvec3(0.0)), c.grid());
    REQUIRE(turned);
    const All x = all(c, *turned);
    if (k == 1) { u = counts(x.u), i = counts(x.i), d = counts(x.d); }
    INFO("10^-" << k);
    CHECK(counts(x.u) == u);
    CHECK(counts(x.i) == i);
    CHECK(counts(x.d) == d);
    const glm::dvec3 shift = t * glm::dvec3{1, 1.0 / 3.0, 1.0 / 7.0};
    const All s = all(c, made(box(glm::dvec3(-.5) + shift, glm::dvec3(.5) + shift), c.grid()), 0.0);
    CHECK(counts(s.u) == Counts{20, 30, 12, 1, 0, 0, 0});
    CHECK(counts(s.i) == Counts{8, 12, 6, 1, 0, 0, 0});
    CHECK(counts(s.d) == Counts{14, 21, 9, 1, 0, 0, 0});
    CHECK(csg::volume(s.i) == test::Approx((1 - shift.x) * (1 - shift.y) * (1 - shift.z)).epsilon(0).margin(4e-7));
  }
}

TEST_CASE("perturbations below the grid are none: the operands are equal, or the laws hold all the same") {
  const Grid g(glm::dvec3(-1.0), glm::dvec3(1.0));
  const Solid c = made(box(glm::dvec3(-.5), glm::dvec3(.5)), g);
  for (int k = 7; k <= 17; ++k) {
    INFO("10^-" << k);
    const double t = std::pow(10.0, -k);
    const Solid turned = made(moved(box(glm::dvec3(-.5), glm::dvec3(.5)), rotation({1, 2, 3}, t), glm::dvec3(0.0)), g);
    const All x = all(c, turned);
    const glm::dvec3 shift = t * glm::dvec3{1, 1.0 / 3.0, 1.0 / 7.0};
    const All s = all(c, made(box(glm::dvec3(-.5) + shift, glm::dvec3(.5) + shift), g), 0.0);
    // A slab that would vanish is not taken for nothing, it is refused.
    const auto slab = leaf(box({-.9, -.9, 0}, {.9, .9, t}), g);
    CHECK(slab.has_value() == (t > 0.5 * g.spacing()));
    if (!slab) { CHECK(slab.refusal().code == Code::collapsed); }
    check(x.u, {2, 1, 1.0}, 6 * g.spacing());
    check(x.i, {2, 1, 1.0}, 6 * g.spacing());
    if (t > 0.5 * g.spacing()) { continue; }
    for (const Solid& r : {s.u, s.i}) { check(r, {2, 1, 1.0}); }
    CHECK(s.d.empty());
  }
}

TEST_CASE("walls, slabs and gaps down to one spacing of the grid") {
  const Grid g(glm::dvec3(-1.0), glm::dvec3(2.0));
  const Solid c = made(box(glm::dvec3(0.0), glm::dvec3(1.0)), g);
  for (double e = .125; e >= g.spacing(); e /= 8.0) {
    check(valid(csg::subtract(c, made(box({-1, -1, .5}, {2, 2, .5 + e}), g))), {4, 2, 1.0 - e});
    check(valid(csg::subtract(c, made(box({e, -1, -1}, {2, 2, 2}), g))), {2, 1, e});
    check(valid(csg::unite(c, made(box({1 + e, 0, 0}, {2, 1, 1}), g))), {4, 2, 2.0 - e});
    check(valid(csg::unite(c, made(box({1 - e, 0, 0}, {2, 1, 1}), g))), {2, 1, 2.0});
  }
}

TEST_CASE("bit boxes: volumes of set expressions") {
  const Grid g(glm::dvec3(0.0), glm::dvec3(8.0));
  const auto bit = [&](double from, double to) { return made(box({from, 0, 0}, {to, 1, 1}), g); };
  const Solid m1 = bit(0, 1), m2 = bit(1, 3), m4 = bit(3, 7), m3 = bit(0, 3), m7 = bit(0, 7), none = valid(csg::intersect(m1, m2));
  const auto volume = [](const Result<Solid>& s) { return csg::volume(valid(s)); };
  CHECK(volume(csg::intersect(m1, m2)) == 0.0);
  CHECK(volume(csg::unite(valid(csg::unite(m1, m2)), m4)) == test::Approx(7.0));
  CHECK(volume(csg::subtract(valid(csg::unite(m1, m2)), m4)) == test::Approx(3.0));
  CHECK(volume(csg::unite(m1, valid(csg::intersect(m2, m4)))) == test::Approx(1.0));
  CHECK(volume(csg::subtract(m7, m3)) == test::Approx(4.0));
  CHECK(volume(csg::subtract(m3, m2)) == test::Approx(1.0));
  CHECK(volume(csg::subtract(m7, m4)) == test::Approx(3.0));
  CHECK(volume(csg::unite(none, m3)) == test::Approx(3.0));
  CHECK(volume(csg::subtract(m1, none)) == test::Approx(1.0));
  CHECK(volume(csg::intersect(none, m7)) == 0.0);
  CHECK(volume(csg::intersect(valid(csg::unite(m2, m4)), m4)) == test::Approx(4.0));
}
