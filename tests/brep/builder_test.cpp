// SPDX-License-Identifier: MIT
// The builder: every defect is reported, exactly the injected one, whatever the order of the faces.

#include <brep/builder.hpp>
#include <brep/validate.hpp>

#include <algorithm>
#include <limits>

#include "shapes.hpp"

using namespace brep;

namespace {

using shapes::Faces;
using shapes::faces_of;
using shapes::names;
using shapes::with_faces;

std::vector<Defect> defects(const Builder& b) {
  auto result = close<shapes::Mesh>(b);
  CHECK(result.brep.has_value() == result.defects.empty());
  for (const Defect& d : result.defects) { CHECK_FALSE(d.sentence.empty()); }
  return std::move(result.defects);
}

}  // namespace

TEST_CASE("vertices, faces, anchors, positions and sheets of the BRep are those of the builder") {
  const Builder b = shapes::cube_builder();
  const auto m = shapes::build(b);
  CHECK((m.vertex_count() == 8 && m.edge_count() == 12 && m.face_count() == 6));
  CHECK((shell_count(m) == 1 && genus(m) == 0));
  CHECK(shapes::faults(m) == "");
  for (std::uint32_t f = 0; f < 6; ++f) {
    HalfedgeId h = m.halfedge(FaceId{f});
    for (std::uint32_t v : b.corners(f)) {
      CHECK(m.vertex(h) == VertexId{v});
      CHECK(m.data(m.vertex(h)).position == b.position(v));
      h = m.next(h);
    }
    CHECK(m.data(FaceId{f}).sheet == b.sheet(f));
  }
  CHECK(genus(shapes::build(shapes::torus_builder(5, 4))) == 1);
  CHECK(shapes::build<BRep<>>(Builder()).face_count() == 0);
}

TEST_CASE("the order of the faces and their first corners do not matter") {
  const Builder cube = shapes::prism_builder(7);
  shapes::Random random(11);
  for (int round = 0; round < 50; ++round) {
    Faces faces = faces_of(cube);
    for (std::size_t i = faces.size(); i-- > 1;) { std::swap(faces[i], faces[random.below(i + 1)]); }
    for (auto& f : faces) { std::rotate(f.begin(), f.begin() + random.below(f.size()), f.end()); }
    CHECK(shapes::faults(shapes::build(with_faces(cube, faces))) == "");
  }
}

TEST_CASE("a missing face is reported as one open border around it") {
  for (const Builder& solid :
       {shapes::cube_builder(), shapes::tetrahedron_builder(), shapes::prism_builder(5), shapes::torus_builder(4, 4)}) {
    for (std::size_t f = 0; f < solid.face_count(); ++f) {
      Faces faces = faces_of(solid);
      const auto missing = faces[f];
      faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(f));
      const auto found = defects(with_faces(solid, faces));
      REQUIRE(found.size() == 1);
      CHECK(found[0].kind == DefectKind::open_border);
      CHECK(found[0].elements.size() == 2 * missing.size());  // its vertices and its neighbours
      for (std::uint32_t v : missing) { CHECK(names(found[0], VertexId{v})); }
    }
  }
}

TEST_CASE("a flipped face is reported by its name alone") {
  for (const Builder& solid : {shapes::cube_builder(), shapes::tetrahedron_builder(), shapes::prism_builder(6)}) {
    for (std::uint32_t f = 0; f < solid.face_count(); ++f) {
      Faces faces = faces_of(solid);
      std::reverse(faces[f].begin(), faces[f].end());
      const auto found = defects(with_faces(solid, faces));
      REQUIRE(found.size() == 1);
      CHECK(found[0].kind == DefectKind::flipped_face);
      CHECK(found[0].elements == std::vector<Element>{FaceId{f}});
    }
  }
}

TEST_CASE("an edge where three faces meet is reported with all of them, whatever their directions") {
  // A fin: one more face at the edge v0 - v1 of the cube, with a vertex of its own.
  for (const auto& fin : {Faces::value_type{0, 1, 8}, Faces::value_type{1, 0, 8}}) {
    Faces faces = faces_of(shapes::cube_builder());
    faces.push_back(fin);
    const auto found = defects(with_faces(shapes::cube_builder(), faces, 1));
    REQUIRE(found.size() == 2);
    CHECK(found[0].kind == DefectKind::nonmanifold_edge);
    CHECK(found[0].elements.size() == 5);
    for (const Element e : {Element(VertexId{0}), Element(VertexId{1}), Element(FaceId{0}), Element(FaceId{2}), Element(FaceId{6})}) {
      CHECK(names(found[0], e));
    }
    CHECK(found[1].kind == DefectKind::open_border);  // the fin's other two edges
    CHECK(names(found[1], VertexId{8}));
  }
}

TEST_CASE("a face that was entered twice is reported as that alone, wherever it begins") {
  for (const Builder& solid : {shapes::cube_builder(), shapes::prism_builder(5), shapes::torus_builder(4, 3)}) {
    for (std::uint32_t f = 0; f < solid.face_count(); ++f) {
      Faces faces = faces_of(solid);
      faces.push_back(faces[f]);
      std::rotate(faces.back().begin(), faces.back().begin() + 1, faces.back().end());
      const auto found = defects(with_faces(solid, faces));
      REQUIRE(found.size() == 1);
      CHECK(found[0].kind == DefectKind::duplicate_face);
      CHECK(found[0].elements == std::vector<Element>{FaceId{f}, FaceId{solid.face_count()}});
    }
  }
}

TEST_CASE("a flipped patch is one defect with all its faces, the smaller part of its component") {
  const Builder torus = shapes::torus_builder(6, 5);
  Faces faces = faces_of(torus);
  for (std::uint32_t f : {7u, 8u, 13u, 29u}) { std::reverse(faces[f].begin(), faces[f].end()); }
  const auto found = defects(with_faces(torus, faces));
  REQUIRE(found.size() == 2);
  CHECK((found[0].kind == DefectKind::flipped_face && found[0].elements == std::vector<Element>{FaceId{7}, FaceId{8}, FaceId{13}}));
  CHECK((found[1].kind == DefectKind::flipped_face && found[1].elements == std::vector<Element>{FaceId{29}}));
}

TEST_CASE("a one-sided surface is told from a flipped one: the doubled edge and its two faces") {
  // A Moebius strip of five quadrilaterals: v0..v4 on one rim, v5..v9 on the other, the last one joined crosswise.
  Builder b;
  for (int i = 0; i < 10; ++i) { b.vertex({i, i * i, i % 3}); }
  for (std::uint32_t i = 0; i < 4; ++i) { b.face({i, i + 1, i + 6, i + 5}, 0); }
  b.face({4, 5, 0, 9}, 0);
  const auto found = defects(b);
  REQUIRE_FALSE(found.empty());
  CHECK(found[0].kind == DefectKind::doubled_edge);
  CHECK(names(found[0], FaceId{4}));
  for (const Defect& d : found) { CHECK((d.kind == DefectKind::doubled_edge || d.kind == DefectKind::open_border)); }
}

TEST_CASE("two missing faces that touch in a vertex are two borders, and no fans") {
  Faces faces = faces_of(shapes::torus_builder(5, 5));
  const auto a = faces[6], c = faces[12];  // they have one vertex in common
  faces.erase(faces.begin() + 12);
  faces.erase(faces.begin() + 6);
  const auto found = defects(with_faces(shapes::torus_builder(5, 5), faces));
  REQUIRE(found.size() == 2);
  for (const Defect& d : found) {
    CHECK((d.kind == DefectKind::open_border && d.elements.size() == 8));
    const bool first = std::all_of(a.begin(), a.end(), [&](std::uint32_t v) { return names(d, VertexId{v}); });
    const bool second = std::all_of(c.begin(), c.end(), [&](std::uint32_t v) { return names(d, VertexId{v}); });
    CHECK(first != second);
  }
}

TEST_CASE("a vertex with two fans is reported with a face of each") {
  // Two tetrahedra that share only the vertex v0.
  Faces faces = faces_of(shapes::tetrahedron_builder());
  for (auto f : faces_of(shapes::tetrahedron_builder())) {
    for (std::uint32_t& v : f) { v = v == 0 ? 0 : v + 3; }
    faces.push_back(f);
  }
  const auto found = defects(with_faces(shapes::tetrahedron_builder(), faces, 3));
  REQUIRE(found.size() == 1);
  CHECK(found[0].kind == DefectKind::several_fans);
  CHECK(found[0].elements == std::vector<Element>{VertexId{0}, FaceId{0}, FaceId{4}});
}

TEST_CASE("bad indices, coordinates, corners and unused vertices are reported without their consequences") {
  const Builder cube = shapes::cube_builder();
  Faces faces = faces_of(cube);
  faces[2][1] = 99;
  auto found = defects(with_faces(cube, faces));
  REQUIRE(found.size() == 1);
  CHECK((found[0].kind == DefectKind::bad_index && names(found[0], FaceId{2}) && names(found[0], VertexId{99})));

  faces = faces_of(cube);
  faces[2][1] = faces[2][3];
  found = defects(with_faces(cube, faces));
  REQUIRE(found.size() == 1);
  CHECK((found[0].kind == DefectKind::repeated_corner && names(found[0], FaceId{2})));

  faces = faces_of(cube);
  faces[2].resize(2);
  found = defects(with_faces(cube, faces));
  REQUIRE_FALSE(found.empty());
  CHECK((found[0].kind == DefectKind::few_corners && names(found[0], FaceId{2})));

  found = defects(with_faces(cube, faces_of(cube), 2));
  REQUIRE(found.size() == 2);
  CHECK((found[0].kind == DefectKind::unused_vertex && names(found[0], VertexId{8}) && names(found[1], VertexId{9})));

  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Builder b;
    for (std::uint32_t v = 0; v < 8; ++v) { b.vertex(v == 5 ? glm::dvec3{0.0, bad, 0.0} : cube.position(v)); }
    for (const auto& f : faces_of(cube)) { b.face(f, 0); }
    found = defects(b);
    REQUIRE(found.size() == 1);
    CHECK((found[0].kind == DefectKind::bad_position && names(found[0], VertexId{5})));
  }
}

TEST_CASE("independent defects are reported all at once") {
  const Builder cube = shapes::cube_builder();
  Builder b;
  for (int i = 0; i < 3; ++i) {
    for (std::uint32_t v = 0; v < 8; ++v) { b.vertex(cube.position(v) + glm::dvec3{3.0 * i, 0.0, 0.0}); }
  }
  const Faces faces = faces_of(cube);
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (std::uint32_t f = 0; f < 6; ++f) {
      auto corners = faces[f];
      for (std::uint32_t& v : corners) { v += 8 * i; }
      if (i == 0 && f == 0) continue;                                      // missing
      if (i == 1 && f == 1) std::reverse(corners.begin(), corners.end());  // flipped
      if (i == 2 && f == 2) corners[0] = 1000;                             // bad index
      b.face(corners, 0);
    }
  }
  std::vector<DefectKind> kinds;
  for (const Defect& d : defects(b)) { kinds.push_back(d.kind); }
  std::sort(kinds.begin(), kinds.end());
  CHECK(kinds == std::vector<DefectKind>{DefectKind::bad_index, DefectKind::flipped_face, DefectKind::open_border});
}

TEST_CASE("random rubbish never crashes the builder: it is refused with reasons, or the BRep is valid") {
  for (std::uint32_t seed = 1; seed <= 3000; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Builder b;
    const std::uint32_t n = 1 + random.below(6);
    for (std::uint32_t v = 0; v < n; ++v) { b.vertex({random.unit(), random.unit(), random.unit()}); }
    for (std::uint32_t f = random.below(8); f > 0; --f) {
      std::vector<std::uint32_t> corners(random.below(5));
      for (std::uint32_t& v : corners) { v = random.below(n + (random.below(20) == 0 ? 2 : 0)); }
      b.face(corners, 0);
    }
    auto result = close<shapes::Mesh>(b);
    REQUIRE(result.brep.has_value() == result.defects.empty());
    if (result.brep) { REQUIRE(shapes::faults(*result.brep) == ""); }
  }
}

TEST_CASE("a vertex of high degree does not make closing slow") {
  // A double cone over 200 000 points: quadratic search would take minutes.
  Builder b;
  const std::uint32_t n = 200000;
  const std::uint32_t top = b.vertex({0, 0, 1}), bottom = b.vertex({0, 0, -1});
  for (std::uint32_t i = 0; i < n; ++i) { b.vertex({std::cos(2 * shapes::pi * i / n), std::sin(2 * shapes::pi * i / n), 0}); }
  for (std::uint32_t i = 0; i < n; ++i) {
    b.face({2 + i, 2 + (i + 1) % n, top}, 0);
    b.face({2 + (i + 1) % n, 2 + i, bottom}, 0);
  }
  const auto m = shapes::build(b);
  CHECK(degree(m, VertexId{top}) == n);
  CHECK(shapes::faults(m) == "");
}
