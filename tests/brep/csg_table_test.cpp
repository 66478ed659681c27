// SPDX-License-Identifier: MIT
// Booleans whose answers are known: Euler characteristic, shells, genus and volume of every result, both ways round, with the identities
//   vol(u) + vol(i) = vol(A) + vol(B),   vol(A - B) + vol(i) = vol(A),   A - B = A n ~B,   (A u B) - B = A - B
// and the areas of regular sets: area(u) + area(i) = area(A) + area(B) - 2 area of what faces each other.

#include "csg_solids.hpp"

#include "catch.hpp"

using namespace solids;
using namespace brep;

namespace {

constexpr double eps = 1e-12;  // volumes are of order 1 with coordinates of 2^-53, of which some hundred are multiplied and added

const Grid& grid() {
  static const Grid g(glm::dvec3(-8.0), glm::dvec3(8.0));
  return g;
}
Solid made(const Builder& b, const Grid& g = grid()) {
  const auto result = leaf(b, g);
  INFO(result.refusal().sentence());
  REQUIRE(result);
  return *result;
}
Solid valid(const Result<Solid>& result) {
  INFO(result.refusal().sentence());
  REQUIRE(result);
  CHECK(faults(*result) == "");
  return *result;
}
Solid cube() { return made(box(glm::dvec3(0.0), glm::dvec3(1.0))); }

struct All {
  Solid u, i, d, r;
};
All all(const Solid& a, const Solid& b, double facing = -1.0) {
  All x{valid(csg::unite(a, b)), valid(csg::intersect(a, b)), valid(csg::subtract(a, b)), valid(csg::subtract(b, a))};
  const auto u = valid(csg::unite(b, a)), i = valid(csg::intersect(b, a));
  const double va = csg::volume(a), vb = csg::volume(b), scale = va + vb;
  CHECK(csg::volume(x.u) + csg::volume(x.i) == test::Approx(va + vb).epsilon(0).margin(eps * scale));
  CHECK(csg::volume(x.d) + csg::volume(x.i) == test::Approx(va).epsilon(0).margin(eps * scale));
  CHECK(csg::volume(x.r) + csg::volume(x.i) == test::Approx(vb).epsilon(0).margin(eps * scale));
  CHECK(csg::volume(u) == test::Approx(csg::volume(x.u)).epsilon(0).margin(eps * scale));
  CHECK(csg::volume(i) == test::Approx(csg::volume(x.i)).epsilon(0).margin(eps * scale));
  CHECK(counts(u).chi() == counts(x.u).chi());
  CHECK(counts(i).chi() == counts(x.i).chi());
  const auto again = valid(csg::subtract(x.u, b));
  CHECK(csg::volume(again) == test::Approx(csg::volume(x.d)).epsilon(0).margin(eps * scale));
  CHECK(valid(csg::subtract(x.d, x.d)).empty());
  CHECK(valid(csg::subtract(csg::subtract(x.u, a).has_value() ? *csg::subtract(x.u, a) : x.u, b)).empty());
  if (facing >= 0.0) {
    CHECK(csg::area(x.u) + csg::area(x.i) ==
          test::Approx(csg::area(a) + csg::area(b) - 2.0 * facing).epsilon(0).margin(eps * (csg::area(a) + csg::area(b))));
  }
  return x;
}
struct Expected {
  long chi;
  std::size_t shells;
  double volume;
};
void check(const Solid& solid, const Expected& e, double tolerance = eps) {
  const Counts c = counts(solid);
  CHECK(c.chi() == e.chi);
  CHECK(c.shells == e.shells);
  CHECK(c.volume == test::Approx(e.volume).epsilon(0).margin(tolerance * std::max(1.0, std::abs(e.volume))));
}

}  // namespace

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
    for (int j = 0; j < 3; ++j) plate = valid(csg::subtract(plate, made(box({2 * i + 1, 2 * j + 1, 0}, {2 * i + 2, 2 * j + 2, 1}))));
  }
  check(plate, {2 - 2 * 9, 1, 49.0 - 9.0});
  CHECK(plate.face_count() == 6 + 9 * 4);  // the upper face is one polygon with nine holes
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

TEST_CASE("a Menger sponge of 400 cubes is the sponge that bars cut out") {
  Solid r;
  const Grid g(glm::dvec3(0.0), glm::dvec3(9.0));
  for (int cell = 0; cell < 729; ++cell) {
    const glm::ivec3 at(cell % 9, cell / 9 % 9, cell / 81);
    const auto holes = [](const glm::ivec3& p) { return (p.x % 3 == 1) + (p.y % 3 == 1) + (p.z % 3 == 1) > 1; };
    if (holes(at) || holes(at / 3)) continue;
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
    if (k % 2 == 0) add(board);
    if (k < 9 && k != 4) add(ring);
  }
  for (const Solid* s : {&full, &board, &ring}) CHECK(faults(*s) == "");
  CHECK(counts(full) == Counts{8, 12, 6, 1, 0, 0, 0});
  check(full, {2, 1, 27.0});
  check(board, {28, 14, 14.0});
  check(ring, {0, 1, 8.0});
  // A checkerboard and its complement in the box are the box again.
  check(valid(csg::unite(board, valid(csg::subtract(full, board)))), {2, 1, 27.0});
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
    if (k == 1) u = counts(x.u), i = counts(x.i), d = counts(x.d);
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
