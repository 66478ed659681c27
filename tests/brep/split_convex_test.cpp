// SPDX-License-Identifier: MIT
// split_until_convex: non-convex polygons fall into convex parts, impossible ones are refused.

#include <brep/split.hpp>

#include "outlines.hpp"
#include "shapes.hpp"

using namespace brep;
using outlines::Points;
using shapes::faults;
using shapes::Mesh;

namespace {

std::size_t check_split(const Points& outline) {
  Mesh m = shapes::build(shapes::pillow_builder(outline));
  const double whole = area(m, FaceId{0});
  const glm::dvec3 n = normal(m, FaceId{0});
  REQUIRE(whole > 0.0);
  m.data(FaceId{0}).label = 3;
  const auto parts = split_until_convex(m, FaceId{0});
  if (!parts) { UNSCOPED_INFO(parts.refusal().sentence()); }
  REQUIRE(parts);
  CHECK((*parts)[0] == FaceId{0});
  CHECK(m.face_count() == parts->size() + 1);
  CHECK(m.vertex_count() == outline.size());
  CHECK(faults(m) == "");
  double sum = 0.0;
  for (FaceId f : *parts) {
    CHECK(is_convex(m, f));
    CHECK(glm::dot(normal(m, f), n) > 0.999);
    CHECK(m.data(f).label == 3);
    sum += area(m, f);
  }
  CHECK(sum == test::Approx(whole).epsilon(1e-12));
  return parts->size();
}

Code refused_in_space(const std::vector<glm::dvec3>& points) {
  Builder b;
  std::vector<std::uint32_t> front, back;
  for (const auto& p : points) {
    front.push_back(b.vertex(p));
    back.insert(back.begin(), front.back());
  }
  b.face(front, 0);
  b.face(back, 0);
  Mesh m = shapes::build(b);
  const auto before = shapes::records(m);
  const auto parts = split_until_convex(m, FaceId{0});
  CHECK(shapes::records(m) == before);
  CHECK_FALSE(parts.refusal().sentence().empty());
  return parts.refusal().code;
}

}  // namespace

TEST_CASE("L, U, comb, star and spiral fall into convex parts that cover them") {
  CHECK(check_split({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) == 2);
  CHECK(check_split({{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) <= 4);
  for (unsigned teeth : {2u, 3u, 10u, 40u}) { CHECK(check_split(outlines::comb(teeth)) <= 2 * teeth); }
  for (unsigned points : {3u, 4u, 5u, 17u, 60u}) {
    for (double inner : {0.1, 0.3, 0.45}) { check_split(outlines::star(points, inner)); }
  }
  for (unsigned turns : {1u, 2u, 6u}) { check_split(outlines::spiral(turns)); }
}

TEST_CASE("a convex face, straight corners or not, stays whole") {
  CHECK(check_split({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}) == 1);
  CHECK(check_split({{0, 0}, {1, 0}, {0, 1}}) == 1);
}

TEST_CASE("an L with T-vertices on its edges") {
  check_split({{0, 0}, {0.5, 0}, {1, 0}, {2, 0}, {2, 0.5}, {2, 1}, {1.5, 1}, {1, 1}, {1, 1.5}, {1, 2}, {0, 2}, {0, 1}});
}

TEST_CASE("random star-shaped polygons at any scale fall into convex parts") {
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    const unsigned n = 5 + random.below(60);
    const double scale = std::pow(10.0, 12.0 * random.unit() - 6.0);
    Points p;
    for (unsigned i = 0; i < n; ++i) {
      const double a = 2.0 * shapes::pi * (i + 0.8 * random.unit()) / n, r = scale * (0.1 + random.unit());
      p.push_back({r * std::cos(a), r * std::sin(a)});
    }
    check_split(p);
  }
}

TEST_CASE("self-crossing, touching, bent and degenerate polygons are refused and nothing changes") {
  CHECK(refused_in_space({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}}) == Code::not_simple);              // a bow tie
  CHECK(refused_in_space({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}) == Code::not_simple);   // a corner touches an edge
  CHECK(refused_in_space({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, -1, 0}, {0, 4, 0}}) == Code::not_simple);  // it goes through
  CHECK(refused_in_space({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 4, 0}, {3, 5, 0}, {3, 4, 0}, {0, 4, 0}}) == Code::not_simple);  // a spike
  CHECK(refused_in_space({{0, 0, 0}, {2, 0, 0}, {2, 1, 1}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}) == Code::not_planar);
  CHECK(refused_in_space({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1.5, 0, 0}}) == Code::degenerate_polygon);
  Mesh m;
  REQUIRE(make_segment(m));
  CHECK(split_until_convex(m, FaceId{0}).refusal().code == Code::few_corners);
  CHECK(split_until_convex(m, FaceId{7}).refusal().code == Code::dead);
}
