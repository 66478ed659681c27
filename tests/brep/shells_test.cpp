// SPDX-License-Identifier: MIT
// Shells: counts and genus of each connected component.

#include <brep/shells.hpp>

#include <set>

#include <brep/euler.hpp>

#include "shapes.hpp"

using namespace brep;
using Bare = BRep<>;

TEST_CASE("a cube, a tetrahedron and a torus in one BRep are three shells with their own counts and genus") {
  Builder b;
  for (const Builder& part : {shapes::cube_builder(), shapes::tetrahedron_builder(), shapes::torus_builder(4, 3)}) {
    const auto base = static_cast<std::uint32_t>(b.vertex_count());
    for (std::uint32_t v = 0; v < part.vertex_count(); ++v) { b.vertex(part.position(v)); }
    for (std::uint32_t f = 0; f < part.face_count(); ++f) {
      std::vector<std::uint32_t> corners;
      for (std::uint32_t v : part.corners(f)) { corners.push_back(base + v); }
      b.face(corners, 0);
    }
  }
  const Bare m = shapes::build<Bare>(b);
  const auto all = shells(m);
  REQUIRE(all.size() == 3);
  CHECK(shell_count(m) == 3);
  CHECK((all[0].vertices == 8 && all[0].edges == 12 && all[0].faces == 6 && all[0].genus() == 0));
  CHECK((all[1].vertices == 4 && all[1].edges == 6 && all[1].faces == 4 && all[1].genus() == 0));
  CHECK((all[2].vertices == 12 && all[2].edges == 24 && all[2].faces == 12 && all[2].genus() == 1));
  CHECK(genus(m) == 1);
  std::set<HalfedgeId> seen;
  for (const Shell& shell : all) {
    const auto halves = halfedges_of_shell(m, shell.halfedge);
    CHECK(halves.size() == 2 * shell.edges);
    CHECK(halves[0] == shell.halfedge);
    CHECK(faces_of_shell(m, halves.back()).size() == shell.faces);
    CHECK(vertices_of_shell(m, halves.back()).size() == shell.vertices);
    for (HalfedgeId h : halves) {
      CHECK(seen.insert(h).second);
      CHECK(h >= shell.halfedge);
    }
    for (std::size_t i = 0; i < halves.size(); i += 2) { CHECK(halves[i + 1] == twin(halves[i])); }
  }
  CHECK(seen.size() == 2 * m.edge_count());
}

TEST_CASE("nothing has no shells, segments and loops have genus 0, counts add up to those of the BRep after random operators") {
  Bare m;
  CHECK(shells(m).empty());
  shapes::Random random(11);
  for (int step = 0; step < 400; ++step) {
    const auto halves = shapes::all_halfedges(m);
    if (halves.empty() || random.below(8) == 0) {
      REQUIRE(make_segment(m));
      continue;
    }
    const HalfedgeId a = halves[random.below(halves.size())];
    if (random.below(3) == 0) {
      if (!join_vertices(m, a) && !kill_segment(m, a)) { (void)join_faces(m, a); }
    } else if (random.below(2) == 0) {
      REQUIRE(split_face(m, a, m.next(a)));
    } else {
      REQUIRE(split_vertex(m, a, m.next(twin(a))));
    }
    Shell sum{};
    for (const Shell& shell : shells(m)) {
      REQUIRE(shell.genus() == 0);
      REQUIRE(shell.vertices + shell.faces == shell.edges + 2);
      sum.vertices += shell.vertices;
      sum.edges += shell.edges;
      sum.faces += shell.faces;
    }
    REQUIRE((sum.vertices == m.vertex_count() && sum.edges == m.edge_count() && sum.faces == m.face_count()));
    REQUIRE(shells(m).size() == shell_count(m));
  }
}
