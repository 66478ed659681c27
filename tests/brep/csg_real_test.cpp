// SPDX-License-Identifier: MIT
// Real closed meshes as operands, with themselves turned and shifted.

#include <fstream>
#include <sstream>

#include "csg_solids.hpp"

#include "catch.hpp"

using namespace solids;
using namespace brep;

namespace {

// Positions and faces of a Wavefront file; nothing else.
Builder read_obj(const std::string& path) {
  Builder b;
  std::ifstream in(path);
  for (std::string line, word; std::getline(in, line);) {
    std::istringstream text(line);
    text >> word;
    if (word == "v") {
      glm::dvec3 p{0.0};
      text >> p.x >> p.y >> p.z;
      b.vertex(p);
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (text >> word) { corners.push_back(static_cast<std::uint32_t>(std::stoul(word)) - 1); }
      b.face(corners, 0);
    }
  }
  return b;
}

}  // namespace

TEST_CASE("a cow united with, cut by and taken from itself, turned and near") {
  const Builder spot = read_obj(std::string(HALFLIGHT_REFERENCE_DATA) + "/meshes/spot.obj");
  if (spot.face_count() == 0) { SKIP_TEST("no meshes of others in " HALFLIGHT_REFERENCE_DATA); }
  const Grid g(glm::dvec3(-2.0), glm::dvec3(2.0));
  const auto a = leaf(spot, g);
  INFO(a.refusal().sentence());
  REQUIRE(a);
  const double held = csg::volume(*a);
  CHECK(counts(*a).shells == 1);
  for (double angle : {1.0, .1, 1e-3, 1e-6}) {
    INFO("turned by " << angle);
    const auto b = leaf(moved(spot, rotation({1, 2, 3}, angle), glm::dvec3(.1 * angle)), g);
    INFO(b.refusal().sentence());
    REQUIRE(b);
    const auto u = csg::unite(*a, *b), i = csg::intersect(*a, *b), d = csg::subtract(*a, *b), r = csg::subtract(*b, *a);
    REQUIRE((u && i && d && r));
    const double sum = held + csg::volume(*b);
    CHECK(csg::volume(*u) + csg::volume(*i) == test::Approx(sum).epsilon(1e-12));
    CHECK(csg::volume(*d) + csg::volume(*i) == test::Approx(held).epsilon(1e-12));
    CHECK(csg::volume(*r) + csg::volume(*i) == test::Approx(csg::volume(*b)).epsilon(1e-12));
    for (const Solid* s : {&*u, &*i, &*d, &*r}) {
      const Mesh m = csg::to_brep<Mesh>(*s);
      CHECK(validate(m).empty());
      CHECK(m.face_count() == s->face_count());
    }
    const auto back = csg::unite(*d, *i);
    REQUIRE(back);
    CHECK(csg::volume(*back) == test::Approx(held).epsilon(1e-12));
    CHECK(csg::area(*back) == test::Approx(csg::area(*a)).epsilon(1e-12));
    const auto nothing = csg::subtract(*back, *a);
    REQUIRE(nothing);
    CHECK(nothing->empty());
  }
}
