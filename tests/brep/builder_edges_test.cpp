// SPDX-License-Identifier: MIT
// The construction phase by edges (paper 2.2): edges with the faces on their two sides, in any order.

#include <brep/builder.hpp>
#include <brep/validate.hpp>

#include <algorithm>

#include "shapes.hpp"

using namespace brep;

namespace {

using shapes::names;

// The edges of a builder's faces, each with the faces on its sides.
std::vector<Builder::Edge> edges_of(const Builder& solid) {
  const auto mesh = shapes::build(solid);
  std::vector<Builder::Edge> all;
  for (EdgeId e : edges(mesh)) {
    const HalfedgeId h = halfedge(e);
    all.push_back({mesh.vertex(h).index, mesh.target(h).index, mesh.face(h).index, mesh.face(twin(h)).index});
  }
  return all;
}

// The solid by its edges alone: empty faces first, then the edges.
Builder by_edges(const Builder& solid, const std::vector<Builder::Edge>& list) {
  Builder b;
  for (std::uint32_t f = 0; f < solid.face_count(); ++f) { b.face(solid.sheet(f)); }
  for (const Builder::Edge& e : list) { b.edge(e.from, e.to, e.left, e.right); }
  for (std::uint32_t v = 0; v < solid.vertex_count(); ++v) { b.vertex(solid.position(v)); }
  return b;
}

}  // namespace

TEST_CASE("edges in any order and direction give the same faces as corners do") {
  for (const Builder& solid :
       {shapes::cube_builder(), shapes::tetrahedron_builder(), shapes::prism_builder(9), shapes::torus_builder(4, 5)}) {
    const auto expected = shapes::build(solid);
    shapes::Random random(5);
    for (int round = 0; round < 20; ++round) {
      auto list = edges_of(solid);
      for (std::size_t i = list.size(); i-- > 1;) { std::swap(list[i], list[random.below(i + 1)]); }
      for (Builder::Edge& e : list) {
        if (random.below(2) == 0) { e = {e.to, e.from, e.right, e.left}; }
      }
      const auto mesh = shapes::build(by_edges(solid, list));
      CHECK(shapes::faults(mesh) == "");
      for (FaceId f : faces(mesh)) {
        CHECK(mesh.data(f).sheet == expected.data(f).sheet);
        std::vector<std::uint32_t> a, b;
        for (HalfedgeId h : halfedges_of(mesh, f)) { a.push_back(mesh.vertex(h).index); }
        for (HalfedgeId h : halfedges_of(expected, f)) { b.push_back(expected.vertex(h).index); }
        std::rotate(a.begin(), std::min_element(a.begin(), a.end()), a.end());
        std::rotate(b.begin(), std::min_element(b.begin(), b.end()), b.end());
        CHECK(a == b);
      }
    }
  }
}

TEST_CASE("a missing edge is named by the two loops that it breaks, and by nothing else") {
  const Builder solid = shapes::cube_builder();
  const auto list = edges_of(solid);
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto fewer = list;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    const auto found = diagnose(by_edges(solid, fewer));
    REQUIRE(found.size() == 2);
    for (const Defect& d : found) { CHECK(d.kind == DefectKind::broken_loop); }
    CHECK(
        (names(found[0], FaceId{std::min(list[i].left, list[i].right)}) && names(found[1], FaceId{std::max(list[i].left, list[i].right)})));
  }
}

TEST_CASE("an edge with a wrong, unknown or missing face is reported") {
  const Builder solid = shapes::tetrahedron_builder();
  auto list = edges_of(solid);
  list[0].left = 77;
  auto found = diagnose(by_edges(solid, list));
  REQUIRE_FALSE(found.empty());
  CHECK(std::any_of(found.begin(), found.end(),
                    [](const Defect& d) { return d.kind == DefectKind::bad_index && d.elements[0] == FaceId{77}; }));

  list = edges_of(solid);
  std::swap(list[2].left, list[2].right);
  found = diagnose(by_edges(solid, list));
  REQUIRE(found.size() == 2);
  for (const Defect& d : found) { CHECK(d.kind == DefectKind::broken_loop); }

  list = edges_of(solid);
  list.push_back(list[3]);
  found = diagnose(by_edges(solid, list));
  REQUIRE(found.size() == 2);
  for (const Defect& d : found) { CHECK(d.kind == DefectKind::broken_loop); }
}

TEST_CASE("edges and corners mix: an edge must be on the loop of the face that it names, one without faces must be used") {
  Builder b = shapes::cube_builder();
  b.edge(0, 2, 0, 4);
  b.edge(1, 0);
  CHECK(shapes::faults(shapes::build(b)) == "");
  b.edge(0, 7);
  auto found = diagnose(b);
  REQUIRE(found.size() == 1);
  CHECK((found[0].kind == DefectKind::unused_edge && found[0].elements == std::vector<Element>{VertexId{0}, VertexId{7}}));

  b = shapes::cube_builder();
  b.edge(2, 0, 0);  // the wrong way round
  found = diagnose(b);
  REQUIRE(found.size() == 1);
  CHECK((found[0].kind == DefectKind::broken_loop && found[0].elements == std::vector<Element>{FaceId{0}, VertexId{2}, VertexId{0}}));
}

TEST_CASE("random edges never crash the builder: they are refused with reasons, or the BRep is valid") {
  for (std::uint32_t seed = 1; seed <= 2000; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    const Builder solid = shapes::prism_builder(3);
    auto list = edges_of(solid);
    for (std::uint32_t k = random.below(4); k > 0; --k) {
      Builder::Edge& e = list[random.below(list.size())];
      std::uint32_t* const field[] = {&e.from, &e.to, &e.left, &e.right};
      *field[random.below(4)] = random.below(8) == 0 ? invalid_index : random.below(7);
    }
    const Builder b = by_edges(solid, list);
    const auto result = close<shapes::Mesh>(b);
    REQUIRE(result.brep.has_value() == result.defects.empty());
    if (result.brep) { REQUIRE(shapes::faults(*result.brep) == ""); }
  }
}
