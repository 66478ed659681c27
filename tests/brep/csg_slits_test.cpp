// SPDX-License-Identifier: MIT
// A hole that touches a wall from inside: the exported faces have no slit where the wall has no thickness.
#include "catch.hpp"

#include <brep/builder.hpp>
#include <brep/csg/csg.hpp>
#include <brep/geometry.hpp>
#include <brep/outline.hpp>
#include <brep/shells.hpp>

#include <vector>

namespace {

struct Place {
  glm::dvec3 position{0.0};
};
struct Sheet {
  std::uint32_t sheet = brep::no_sheet;
};
using Model = brep::BRep<Place, brep::NoData, Sheet>;

// A prism over a polygon in the plane of x and y, counter-clockwise, from z = lo to hi. Its faces have sheets from `first` on.
Model prism(const std::vector<glm::dvec2>& outline, double lo, double hi, std::uint32_t first) {
  brep::Builder builder;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {lo, hi}) {
    for (const glm::dvec2& p : outline) { builder.vertex({p.x, p.y, z}); }
  }
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t i = 0; i < n; ++i) {
    bottom.push_back(n - 1 - i);
    top.push_back(n + i);
    builder.face({i, (i + 1) % n, n + (i + 1) % n, n + i}, first + 2 + i);
  }
  builder.face(std::span<const std::uint32_t>(bottom), first);
  builder.face(std::span<const std::uint32_t>(top), first + 1);
  auto closed = brep::close<Model>(builder);
  REQUIRE(closed.brep);
  return std::move(*closed.brep);
}

}  // namespace

TEST_CASE("csg: a bore that touches a wall from inside leaves the wall whole when slits are closed, wherever it ends") {
  const brep::csg::Grid grid({-8, -8, -8}, {8, 8, 8});
  const auto block = brep::csg::make_solid(prism({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0, 4, 0), grid);
  REQUIRE(block);
  // A bore of square section that stands on its edge: that edge lies in the wall x = 4. It is a cavity, a blind hole, or goes through.
  for (const auto& [lo, hi] : {std::pair(1.0, 3.0), std::pair(1.0, 5.0), std::pair(-1.0, 5.0)}) {
    const auto bore = brep::csg::make_solid(prism({{2, 2}, {3, 1}, {4, 2}, {3, 3}}, lo, hi, 8), grid);
    REQUIRE(bore);
    const auto rest = brep::csg::subtract(*block, *bore);
    REQUIRE(rest);
    const auto whole = brep::csg::close_slits(*rest);
    CHECK(brep::csg::volume(whole) == test::Approx(brep::csg::volume(*rest)).epsilon(1e-12));  // sums of at most 40 terms
    const auto model = brep::csg::to_brep<Model>(whole);
    CAPTURE(lo, hi);
    int walls = 0;
    for (const brep::FaceId f : brep::faces(model)) {
      CHECK_FALSE(brep::Outline(brep::Polygon(brep::positions(model, f))).self_contact());
      if (model.data(f).sheet != 3) continue;  // x = 4
      ++walls;
      CHECK(brep::area(model, f) == 16.0);
    }
    CHECK(walls == 1);
    // As of a bore that just misses the wall: a cavity is a shell of its own, a hole that goes through a handle.
    const auto v = static_cast<long>(model.vertex_count()), e = static_cast<long>(model.edge_count());
    const auto f = static_cast<long>(model.face_count());
    CHECK(v - e + f == (lo > 0 && hi < 4 ? 4 : lo > 0 ? 2 : 0));
  }
}
