// SPDX-License-Identifier: MIT
// Booleans of random solids on few grid points, where almost everything coincides, against points that know the answer; long chains; what
// is refused; what the faces carry; and the arithmetic below it all.

#include <algorithm>
#include <numeric>
#include <random>

#include "csg_answers.hpp"
#include "csg_random.hpp"

using namespace solids;
using namespace brep;

TEST_CASE("wide integers calculate as 128-bit integers do, and beyond them by their laws") {
  std::mt19937_64 random(7);
  const auto any = [&] { return static_cast<csg::Int128>(static_cast<std::int64_t>(random()) >> (random() % 60)); };
  for (int n = 0; n < 2000; ++n) {
    const csg::Int128 x = any(), y = any(), z = any();
    using W = csg::Wide<4>;
    CHECK(W(x) * W(y) == W(x * y));
    CHECK(W(x) - W(y) == W(x - y));
    CHECK(W(x).sign() == (x > 0) - (x < 0));
    const W a = W(x) * W(y) * W(z), b = W(z) * W(x);
    const csg::Int128 u = x * y, v = z * x;
    CHECK(csg::product(u, v) == W(u) * W(v));
    CHECK((a + b) * W(y) == a * W(y) + b * W(y));
    CHECK(csg::Wide<6>(a) * csg::Wide<6>(W(y)) == csg::Wide<6>(a * W(y)));
    const double exact = static_cast<double>(x) * static_cast<double>(y) * static_cast<double>(z);
    CHECK(a.approximate() == test::Approx(exact).epsilon(1e-14));
  }
}

TEST_CASE("side and compare agree with rational arithmetic on random planes") {
  std::mt19937_64 random(11);
  csg::PlaneTable table;
  const csg::Predicates p(table);
  const auto plane = [&](int bits) {
    std::array<std::int64_t, 3> n{};
    for (std::int64_t& x : n) { x = static_cast<std::int64_t>(random() >> (64 - bits)) - (std::int64_t{1} << (bits - 1)); }
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) { n[0] = 1; }
    return table.insert(n, static_cast<csg::Int128>(static_cast<std::int64_t>(random() >> (64 - bits)) - (std::int64_t{1} << (bits - 1))))
        .number();
  };
  int on = 0;
  for (int n = 0; n < 3000; ++n) {
    const int bits = 2 + static_cast<int>(random() % 5);  // few bits: many planes through one point
    const csg::PlaneNumber a = plane(bits), b = plane(bits), c = plane(bits), q = plane(bits);
    const auto h = csg::detail::meet(table[a], table[b], table[c]);
    if (h.w.zero()) { continue; }
    const csg::Point v = p.point(a, b, c);
    csg::Wide<4> value = h.w * csg::Wide<4>(table[q].d);
    for (std::size_t i = 0; i < 3; ++i) { value = value + h.x[i] * csg::Wide<4>(table[q].n[i]); }
    CHECK(p.side(v, q) == value.sign());
    on += value.zero();
    CHECK((p.side(v, a) == 0 && p.side(v, b) == 0 && p.side(v, c) == 0));
    for (int i = 0; i < 3; ++i) {  // rounded down to a multiple of 2^-27
      const double x = h.x[static_cast<std::size_t>(i)].approximate() / h.w.approximate();
      CHECK(std::abs(v.position[i] - x) <= 0x1p-27 + 1e-15 * std::abs(x));
    }
    CHECK(p.equal(v, p.point(c, a, b)));
  }
  CHECK(on > 10);  // the seed gives some zeros
}

TEST_CASE("random trees of solids hold the points that their leaves say") {
  const std::uint32_t seed = GENERATE(range(1u, 41u));
  INFO("seed " << seed);
  const std::string wrong = random_tree(seed, 3, 3);
  CHECK(wrong == "");
}

TEST_CASE("results are operands twenty levels deep, and nothing grows but the solid") {
  const Grid g(glm::dvec3(-2.0), glm::dvec3(2.0));
  Solid deep = valid(leaf(octasphere(3, glm::dvec3(0.0)), g));
  double held = csg::volume(deep);
  for (int k = 0; k < 20; ++k) {
    const glm::dmat3 turn = rotation({1.0, 2.0 + k, 3.0}, .7 * k);
    const Solid bite = valid(leaf(moved(box(glm::dvec3(-.1), glm::dvec3(.1, .1, 2)), turn, .02 * k * turn[0]), g));
    const Solid kept = valid(csg::subtract(deep, bite)), lost = valid(csg::intersect(deep, bite));
    CHECK(csg::volume(kept) + csg::volume(lost) == test::Approx(held).epsilon(1e-12));
    CHECK(csg::volume(valid(csg::unite(kept, lost))) == test::Approx(held).epsilon(1e-12));
    deep = kept;
    held = csg::volume(deep);
  }
}

TEST_CASE("ten turned cubes have one union in any order") {
  const Grid g(glm::dvec3(-2.0), glm::dvec3(2.0));
  std::vector<Solid> cubes;
  for (int k = 0; k < 10; ++k) {
    const glm::dmat3 turn = rotation({std::sin(k), std::cos(3.0 * k), 1.0}, 1.3 * k);
    cubes.push_back(valid(leaf(moved(box(glm::dvec3(-.5), glm::dvec3(.5)), turn, .4 * turn[1]), g)));
    CHECK(cubes.back().face_count() == 6);  // planes first: turned faces stay squares
  }
  std::vector<std::size_t> order(cubes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(5);
  Counts first;
  for (int n = 0; n < 5; ++n) {
    Solid sum = cubes[order[0]];
    for (std::size_t k = 1; k < order.size(); ++k) { sum = valid(csg::unite(sum, cubes[order[k]])); }
    const Counts c = counts(sum);
    if (n == 0) { first = c; }
    CHECK(c == first);
    CHECK(c.volume == test::Approx(first.volume).epsilon(1e-12));
    CHECK(c.area == test::Approx(first.area).epsilon(1e-12));
    std::shuffle(order.begin(), order.end(), random);
  }
}

TEST_CASE("the same operands in another order of vertices and faces give the same solid") {
  const Grid g(glm::dvec3(-2.0), glm::dvec3(2.0));
  std::mt19937 random(3);
  const Builder a = octasphere(4, glm::dvec3(0.0)), b = octasphere(4, {.3, .2, .1});
  const auto shuffled = [&](const Builder& given) {
    std::vector<std::uint32_t> vertex(given.vertex_count()), face(given.face_count());
    std::iota(vertex.begin(), vertex.end(), 0u);
    std::iota(face.begin(), face.end(), 0u);
    std::shuffle(vertex.begin(), vertex.end(), random);
    std::shuffle(face.begin(), face.end(), random);
    std::vector<std::uint32_t> place(vertex.size());
    Builder result;
    for (std::uint32_t v : vertex) { place[v] = result.vertex(given.position(v)); }
    for (std::uint32_t f : face) {
      std::vector<std::uint32_t> corners;
      for (std::uint32_t v : given.corners(f)) { corners.push_back(place[v]); }
      std::rotate(corners.begin(), corners.begin() + random() % 3, corners.end());
      result.face(corners, given.sheet(f));
    }
    return result;
  };
  const Solid first = valid(csg::unite(valid(leaf(a, g)), valid(leaf(b, g))));
  for (int n = 0; n < 3; ++n) {
    const Solid again = valid(csg::unite(valid(leaf(shuffled(a), g)), valid(leaf(shuffled(b), g))));
    CHECK(counts(again) == counts(first));
    CHECK(csg::volume(again) == test::Approx(csg::volume(first)).epsilon(1e-14));
    std::multiset<std::array<double, 3>> p, q;
    for (const csg::Point& x : first.faces().points) { p.insert({x.position.x, x.position.y, x.position.z}); }
    for (const csg::Point& x : again.faces().points) { q.insert({x.position.x, x.position.y, x.position.z}); }
    CHECK(p == q);
  }
}

TEST_CASE("faces keep what they carry, and neighbours with different attributes stay apart") {
  const Grid g(glm::dvec3(-4.0), glm::dvec3(4.0));
  const auto painted = [&](const Builder& b, std::uint32_t paint) {
    const Mesh m = mesh(b);
    return csg::make_solid<std::uint32_t>(
        m, g, [&](VertexId v) { return m.data(v).position; }, [&](FaceId f) { return paint + m.data(f).sheet; });
  };
  const Solid a = valid(painted(box(glm::dvec3(0.0), glm::dvec3(1.0)), 0)), b = valid(painted(box({.25, .25, 0}, {.75, .75, 1}), 10));
  const auto carried = [](const Solid& s) {
    std::multiset<std::uint32_t> all;
    for (std::size_t f = 0; f < s.face_count(); ++f) { all.insert(s.attribute(f)); }
    return all;
  };
  CHECK(carried(valid(csg::subtract(a, b))) == std::multiset<std::uint32_t>{0, 1, 2, 3, 4, 5, 12, 13, 14, 15});
  CHECK(carried(valid(csg::intersect(a, b))) == std::multiset<std::uint32_t>{0, 1, 12, 13, 14, 15});  // on common planes a's
  CHECK(carried(valid(csg::intersect(b, a))) == std::multiset<std::uint32_t>{10, 11, 12, 13, 14, 15});
  // A row of two boxes: the long sides are of two paints, and with one paint they are one.
  const Solid right = valid(painted(box({1, 0, 0}, {2, 1, 1}), 20));
  CHECK(valid(csg::unite(a, right)).face_count() == 10);
  CHECK(valid(csg::unite(a, valid(painted(box({1, 0, 0}, {2, 1, 1}), 0)))).face_count() == 6);
  const Mesh back = csg::to_brep<Mesh>(valid(csg::unite(a, right)));
  for (FaceId f : faces(back)) { CHECK(back.data(f).sheet == valid(csg::unite(a, right)).attribute(f.index)); }
}

TEST_CASE("a result goes through a BRep and back, with its holes, and turned") {
  const Grid g(glm::dvec3(-8.0), glm::dvec3(8.0));
  Solid plate = valid(leaf(box({0, 0, 0}, {5, 5, 1}), g));
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 at(2 * (i % 2) + 1, 2 * (i / 2) + 1, 0);
    plate = valid(csg::subtract(plate, valid(leaf(box(at, at + 1.0), g))));
  }
  const Mesh m = csg::to_brep<Mesh>(plate);
  const Solid again = valid(csg::make_solid(m, g));
  CHECK(counts(again) == counts(plate));
  CHECK(valid(csg::subtract(again, plate)).empty());
  const auto turned = [&](const Mesh& given, double angle) {
    const glm::dmat3 turn = rotation({1, 2, 3}, angle);
    return csg::make_solid<std::uint32_t>(
        given, g, [&](VertexId v) { return turn * given.data(v).position; }, [&](FaceId f) { return given.data(f).sheet; });
  };
  for (double angle : {.4, 1e-6}) {  // three faces at every vertex: they stay whole, with their holes
    const Solid other = valid(turned(m, angle));
    CHECK(counts(other) == counts(plate));
    CHECK(csg::volume(other) == test::Approx(21.0).epsilon(1e-12));
  }
  // A sphere cut by another has other vertices, too: there the faces fall into triangles.
  const Solid bowl = valid(csg::subtract(valid(leaf(octasphere(4, glm::dvec3(0.0)), g)), valid(leaf(octasphere(4, glm::dvec3(.5)), g))));
  const Solid bowl_again = valid(csg::make_solid(csg::to_brep<Mesh>(bowl), g));
  CHECK(bowl_again.face_count() > bowl.face_count());
  CHECK(csg::volume(bowl_again) == test::Approx(csg::volume(bowl)).epsilon(1e-6));
  // Planes first: a prism of 24 sides stays one, although its snapped vertices are in no plane.
  const Solid prism = valid(turned(mesh(regular_prism(24, 1, -1, 1)), .7));
  CHECK(prism.face_count() == 26);
  const Solid drilled =
      valid(csg::subtract(valid(leaf(box(glm::dvec3(-1.5), glm::dvec3(1.5)), g)), valid(turned(mesh(regular_prism(24, .5, -3, 3)), .7))));
  CHECK(counts(drilled).genus == 1);
  CHECK(csg::volume(valid(csg::make_solid(csg::to_brep<Mesh>(drilled), g))) == test::Approx(csg::volume(drilled)).epsilon(1e-6));
}

TEST_CASE("turned cones: bases of many corners that are not plane on the grid fall into triangles, and no volume is lost") {
  const Grid g(glm::dvec3(-2.0), glm::dvec3(2.0));
  std::mt19937 random(8);
  const auto any = [&] { return 2.0 * static_cast<double>(random()) / 0x1p32 - 1.0; };
  for (const std::uint32_t n : {5u, 8u, 24u, 64u}) {
    Builder cone;
    std::vector<std::uint32_t> base;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * i / n;
      base.insert(base.begin(), cone.vertex({std::cos(angle), std::sin(angle), -.5}));
    }
    const std::uint32_t apex = cone.vertex({.3, .2, 1});  // where n faces meet: planes cannot come first
    cone.face(base, 0);
    for (std::uint32_t i = 0; i < n; ++i) { cone.face({i, (i + 1) % n, apex}, 1 + i); }
    const double volume = n / 2.0 * std::sin(6.283185307179586 / n) * 1.5 / 3.0;
    for (int k = 0; k < 25; ++k) {
      INFO(n << " corners, rotation " << k);
      const Solid turned = valid(leaf(moved(cone, rotation({any(), any(), any()}, 3.0 * any()), glm::dvec3(.1 * any())), g));
      CHECK(csg::volume(turned) == test::Approx(volume).epsilon(1e-6));
    }
  }
}

TEST_CASE("imprint cuts both solids along each other and selects nothing") {
  const Grid g(glm::dvec3(-4.0), glm::dvec3(4.0));
  const Solid a = valid(leaf(box(glm::dvec3(0.0), glm::dvec3(1.0)), g)), b = valid(leaf(box({.25, .25, .5}, {.75, .75, 1.5}), g));
  const auto cut = csg::imprint(a, b);
  REQUIRE(cut);
  CHECK((csg::volume(cut->a) == test::Approx(1.0) && csg::volume(cut->b) == test::Approx(.25)));
  CHECK((cut->a.face_count() == 7 && cut->b.face_count() == 10));
  CHECK(std::count(cut->side_a.begin(), cut->side_a.end(), csg::Side::inside) == 1);
  CHECK(std::count(cut->side_b.begin(), cut->side_b.end(), csg::Side::inside) == 5);
  for (const Solid& s : {cut->a, cut->b}) {
    const Mesh m = csg::to_brep<Mesh>(s);
    CHECK(validate(m).empty());
    CHECK(m.face_count() == s.face_count());
  }
  const auto flush = csg::imprint(a, valid(leaf(box({0, 0, 1}, {1, .5, 2}), g)));
  REQUIRE(flush);
  CHECK(std::count(flush->side_a.begin(), flush->side_a.end(), csg::Side::on_opposite) == 1);
  CHECK(std::count(flush->side_b.begin(), flush->side_b.end(), csg::Side::on_opposite) == 1);
}

TEST_CASE("what is no solid is refused with its faces, and operands must share a grid") {
  const Grid g(glm::dvec3(-2.0), glm::dvec3(2.0));
  const auto code = [&](const Builder& b) { return leaf(b, g).refusal().code; };
  CHECK(code(box({0, 0, 0}, {1, 1, 99})) == Code::outside_grid);
  CHECK(code(box({0, 0, 0}, {1, 1, 1e-9})) == Code::collapsed);
  const Mesh unit = mesh(box(glm::dvec3(0.0), glm::dvec3(1.0)));
  const auto nowhere = csg::make_solid<int>(
      unit, g, [](VertexId) { return glm::dvec3(std::nan("")); }, [](FaceId) { return 0; });
  CHECK(nowhere.refusal().code == Code::outside_grid);
  CHECK(code(moved(box({0, 0, 0}, {1, 1, 1}), glm::dmat3(-1.0), glm::dvec3(0.0))) == Code::inside_out);
  // Two boxes in one BRep that overlap, one within the other looking the wrong way, and one within the other that is a cavity.
  const auto two = [&](const Builder& a, const Builder& b, bool turned) {
    Builder sum = moved(a, glm::dmat3(1.0), glm::dvec3(0.0));
    for (std::uint32_t v = 0; v < b.vertex_count(); ++v) { sum.vertex(b.position(v)); }
    for (std::uint32_t f = 0; f < b.face_count(); ++f) {
      std::vector<std::uint32_t> corners;
      for (std::uint32_t v : b.corners(f)) { corners.push_back(a.vertex_count() + v); }
      if (turned) { std::reverse(corners.begin(), corners.end()); }
      sum.face(corners, 0);
    }
    return sum;
  };
  const Builder big = box(glm::dvec3(0.0), glm::dvec3(1.0)), small = box(glm::dvec3(.25), glm::dvec3(.75));
  const Refusal crossing = leaf(two(big, box(glm::dvec3(.5), glm::dvec3(1.5)), false), g).refusal();
  CHECK(crossing.code == Code::self_intersecting);
  CHECK(crossing.elements[0].letter == 'f');
  CHECK(crossing.sentence().find("intersects") != std::string::npos);
  CHECK(code(two(big, small, false)) == Code::inside_out);
  CHECK(code(two(big, box(glm::dvec3(1.0), glm::dvec3(1.5)), false)) == Code::none);  // touches in a vertex
  const auto cavity = leaf(two(big, small, true), g);
  REQUIRE(cavity);
  CHECK(csg::volume(*cavity) == test::Approx(.875));
  CHECK(valid(csg::unite(*cavity, valid(leaf(small, g)))).face_count() == 6);
  // A polygon and its back enclose nothing.
  Builder pillow;
  for (const glm::dvec3& p : {glm::dvec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) { pillow.vertex(p); }
  pillow.face({0, 1, 2}, 0);
  pillow.face({0, 2, 1}, 1);
  CHECK(code(pillow) == Code::self_intersecting);
  const Solid a = valid(leaf(big, g)), b = valid(leaf(big, Grid(glm::dvec3(-2.0), glm::dvec3(2.0))));
  CHECK(csg::unite(a, b).refusal().code == Code::different_grids);
}

TEST_CASE("check_export names what rounding to double makes of thin parts") {
  const Grid g(glm::dvec3(-1.0), glm::dvec3(1.0));
  // Two planes that differ in the last bit of their normals cut a cube: between them lies a wedge thinner than a double can show.
  const Solid c = valid(leaf(box(glm::dvec3(-.5), glm::dvec3(.5)), g));
  CHECK(csg::check_export(c).empty());
  const auto half = [&](double tilt) {
    return valid(leaf(moved(box({-.9, -.9, -.9}, {.8, .7, .01}), rotation({1, 2, .5}, tilt), glm::dvec3(0.0)), g));
  };
  int reported = 0;
  for (double angle : {1e-6, 1e-12, 1e-14, 3e-15, 2e-15, 1e-15, 7e-16, 4e-16}) {
    const Solid wedge = valid(csg::intersect(c, valid(csg::subtract(half(.3), half(.3 + angle)))));
    CHECK((angle < 1e-14 || !wedge.empty()));
    const auto collapses = csg::check_export(wedge);
    const Mesh m = csg::to_brep<Mesh>(wedge);
    bool short_edge = false;
    for (EdgeId e : edges(m)) {
      short_edge = short_edge || m.data(m.vertex(halfedge(e))).position == m.data(m.target(halfedge(e))).position;
    }
    CHECK((!short_edge || !collapses.empty()));
    if (collapses.empty()) { continue; }
    ++reported;
    CHECK(angle < 1e-12);
    CHECK(collapses[0].elements[0].letter == 'f');
    CHECK(!collapses[0].sentence.empty());
  }
  CHECK(reported > 0);
}
