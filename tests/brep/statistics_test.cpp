// SPDX-License-Identifier: MIT
// Statistics of builders: counts that agree with the finished BRep, and with known surfaces where no BRep can be made.

#include <brep/builder.hpp>
#include <brep/repair.hpp>
#include <brep/statistics.hpp>

#include <algorithm>

#include "shapes.hpp"

using namespace brep;

namespace {

using shapes::Faces;

Builder without(const Builder& solid, std::vector<std::uint32_t> missing) {
  Builder b;
  for (std::uint32_t v = 0; v < solid.vertex_count(); ++v) { b.vertex(solid.position(v)); }
  for (std::uint32_t f = 0; f < solid.face_count(); ++f) {
    if (std::find(missing.begin(), missing.end(), f) == missing.end()) { b.face(solid.corners(f), solid.sheet(f)); }
  }
  return b;
}

}  // namespace

TEST_CASE("the statistics of a sound builder are those of its BRep") {
  for (const Builder& solid :
       {shapes::cube_builder(), shapes::tetrahedron_builder(), shapes::prism_builder(8), shapes::torus_builder(6, 5)}) {
    const auto mesh = shapes::build(solid);
    const Statistics s = statistics(solid);
    CHECK((s.vertices == mesh.vertex_count() && s.edges == mesh.edge_count() && s.faces == mesh.face_count()));
    CHECK((s.closed() && s.oriented && s.duplicate_positions == 0 && s.unusable_faces == 0));
    REQUIRE(s.components.size() == shell_count(mesh));
    CHECK(s.components[0].genus == genus(mesh));
    CHECK(s.euler() == 2 - 2 * genus(mesh));
  }
  CHECK(*statistics(shapes::cube_builder()).components[0].volume == 1.0);
  CHECK(statistics(Builder()).components.empty());
}

TEST_CASE("holes change the number of borders and not the genus, wherever they touch") {
  const Builder torus = shapes::torus_builder(6, 6);
  for (const auto& missing : {std::vector<std::uint32_t>{0}, {0, 14}, {0, 7}, {0, 1}, {0, 7, 14}}) {
    const Statistics s = statistics(without(torus, missing));
    REQUIRE(s.components.size() == 1);
    const bool joined = missing.size() == 2 && missing[1] == 1;  // side by side: one border
    CHECK(s.components[0].borders == (joined ? 1 : missing.size()));
    CHECK(s.components[0].genus == 1);
    CHECK(s.border_edges == (joined ? 6 : 4 * missing.size()));
    CHECK_FALSE(s.components[0].volume.has_value());
  }
  // A ring of quadrilaterals has two borders and genus 0, a Moebius strip one side and no genus.
  Builder strip;
  for (int i = 0; i < 10; ++i) { strip.vertex({i, i * i, i % 3}); }
  for (std::uint32_t i = 0; i < 4; ++i) { strip.face({i, i + 1, i + 6, i + 5}, 0); }
  Builder ring = strip, moebius = strip;
  ring.face({4, 0, 5, 9}, 0);
  moebius.face({4, 5, 0, 9}, 0);
  const Component a = statistics(ring).components[0], b = statistics(moebius).components[0];
  CHECK((a.borders == 2 && a.genus == 0 && a.two_sided && a.euler() == 0));
  CHECK((!b.two_sided && !b.oriented && !b.genus.has_value() && b.euler() == 0));
}

TEST_CASE("solids that touch in a vertex are two components, a pinched one has its own genus") {
  Builder b = shapes::tetrahedron_builder();
  for (int i = 0; i < 3; ++i) { b.vertex({-1 - i, i * i, -2}); }
  b.face({0, 5, 4}, 0);
  b.face({0, 4, 6}, 0);
  b.face({4, 5, 6}, 0);
  b.face({5, 0, 6}, 0);
  const Statistics s = statistics(b);
  REQUIRE(s.components.size() == 2);
  for (const Component& c : s.components) { CHECK((c.vertices == 4 && c.genus == 0 && c.volume.has_value())); }
  CHECK(s.euler() == 3);  // the shared vertex counts once
}

TEST_CASE("a volume beyond the range of doubles is not given") {
  for (const double size : {1e110, 1e150, 1e300}) {
    Builder big;
    const Builder cube = shapes::cube_builder();
    for (std::uint32_t v = 0; v < cube.vertex_count(); ++v) { big.vertex(size * cube.position(v)); }
    for (std::uint32_t f = 0; f < cube.face_count(); ++f) { big.face(cube.corners(f), 0); }
    CHECK_FALSE(statistics(big).components[0].volume.has_value());
  }
}

TEST_CASE("volume changes its sign with the direction of the faces and does not depend on the place") {
  const Builder cube = shapes::cube_builder();
  Builder far;
  // Coordinates up to 2^20 are exact, and so are all differences and products below.
  for (std::uint32_t v = 0; v < 8; ++v) { far.vertex(cube.position(v) + glm::dvec3(1 << 20, -(1 << 20), 3.0)); }
  for (std::uint32_t f = 0; f < 6; ++f) {
    std::vector<std::uint32_t> corners(cube.corners(f).begin(), cube.corners(f).end());
    std::reverse(corners.begin(), corners.end());
    far.face(corners, 0);
  }
  CHECK(*statistics(far).components[0].volume == Approx(-1.0).epsilon(1e-15));
}

TEST_CASE("unusable faces are counted and left out, repeated positions are told") {
  Builder b = shapes::cube_builder();
  b.face({0, 1}, 0);
  b.face({0, 99, 1}, 0);
  b.vertex(b.position(3));
  const Statistics s = statistics(b);
  CHECK((s.unusable_faces == 2 && s.faces == 8 && s.components.size() == 1 && s.components[0].genus == 0));
  CHECK((s.duplicate_positions == 1 && s.used_vertices == 8 && s.vertices == 9));
  CHECK_FALSE(s.closed());
}

TEST_CASE("what repair makes of random triangles has the genus and shells that the statistics tell") {
  for (std::uint32_t seed = 1; seed <= 1000; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Builder b;
    for (int v = 0; v < 9; ++v) { b.vertex({random.unit(), random.unit(), random.unit()}); }
    for (std::uint32_t f = random.below(9); f > 0; --f) { b.face({random.below(9), random.below(9), random.below(9)}, 0); }
    const RepairResult r = repair(b);
    if (!r.remaining.empty()) { continue; }
    const auto mesh = shapes::build(r.builder);
    const Statistics s = statistics(r.builder);
    CHECK(s.components.size() == shell_count(mesh));
    long sum = 0;
    for (const Component& c : s.components) { sum += c.genus.value(); }
    CHECK(sum == genus(mesh));
  }
}
