// SPDX-License-Identifier: MIT
// Repair: what it can mend it mends, what it did it says, what it cannot mend it leaves as it was.

#include <brep/builder.hpp>
#include <brep/repair.hpp>
#include <brep/validate.hpp>

#include <algorithm>
#include <map>
#include <set>

#include "shapes.hpp"

using namespace brep;

namespace {

using shapes::Faces;
using shapes::faces_of;
using shapes::with_faces;

std::vector<std::uint32_t> rotated(std::vector<std::uint32_t> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}
// The faces as a set, wherever they begin.
std::multiset<std::vector<std::uint32_t>> face_set(const Builder& b) {
  std::multiset<std::vector<std::uint32_t>> all;
  for (const auto& corners : faces_of(b)) { all.insert(rotated(corners)); }
  return all;
}
std::map<RepairKind, int> kinds(const RepairResult& r) {
  std::map<RepairKind, int> count;
  for (const Repair& repair : r.repairs) { ++count[repair.kind]; }
  return count;
}
// What must hold of every repair.
void check_laws(const Builder& input, const RepairResult& r) {
  REQUIRE(r.old_vertex.size() == r.builder.vertex_count());
  REQUIRE(r.old_face.size() == r.builder.face_count());
  for (std::uint32_t v = 0; v < r.builder.vertex_count(); ++v) {
    if (r.old_vertex[v] < input.vertex_count()) { CHECK(r.builder.position(v) == input.position(r.old_vertex[v])); }
  }
  for (const Repair& repair : r.repairs) { CHECK((!repair.sentence.empty() && !repair.elements.empty())); }
  for (const Defect& d : r.remaining) { UNSCOPED_INFO("remaining: " << d.sentence); }
  const auto closed = close<shapes::Mesh>(r.builder);
  CHECK(closed.brep.has_value() == r.remaining.empty());
  if (input.edges().empty()) { CHECK(closed.defects.size() == r.remaining.size()); }
  if (closed.brep) { CHECK(shapes::faults(*closed.brep) == ""); }
  const RepairResult again = repair(r.builder);  // a repair leaves nothing that another one would mend
  CHECK(again.repairs.empty());
  CHECK(faces_of(again.builder) == faces_of(r.builder));
}
const std::vector<Builder>& sound_solids() {
  static const std::vector<Builder> all{shapes::cube_builder(), shapes::tetrahedron_builder(), shapes::prism_builder(7),
                                        shapes::torus_builder(5, 4)};
  return all;
}

}  // namespace

TEST_CASE("a sound builder is left as it is, nothing is said") {
  for (const Builder& solid : sound_solids()) {
    const RepairResult r = repair(solid);
    CHECK((r.repairs.empty() && r.remaining.empty()));
    CHECK(faces_of(r.builder) == faces_of(solid));
    for (std::uint32_t f = 0; f < solid.face_count(); ++f) { CHECK(r.builder.sheet(f) == solid.sheet(f)); }
  }
}

TEST_CASE("flipped, doubled and missing faces are mended back to the solid, whatever their order") {
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    const Builder& solid = sound_solids()[seed % sound_solids().size()];
    Faces faces = faces_of(solid);
    for (std::size_t i = faces.size(); i-- > 1;) { std::swap(faces[i], faces[random.below(i + 1)]); }
    int flipped = 0, doubled = 0, missing = 0;
    if (random.below(2) == 0) {
      faces.pop_back();
      missing = 1;
    }
    if (random.below(2) == 0) {
      std::reverse(faces[0].begin(), faces[0].end());
      flipped = 1;
    }
    if (random.below(2) == 0) {
      faces.push_back(faces[1]);
      doubled = 1;
    }
    const Builder broken = with_faces(solid, faces, 2);
    const RepairResult r = repair(broken);
    check_laws(broken, r);
    CHECK(r.remaining.empty());
    auto expected = face_set(solid);
    CHECK(r.builder.face_count() == solid.face_count());
    // With a face missing and one flipped, a tetrahedron may be turned as a whole: two faces against one.
    if (solid.face_count() > 4) { CHECK(face_set(r.builder) == expected); }
    auto count = kinds(r);
    if (solid.face_count() > 4) { CHECK(count[RepairKind::flipped_face] == flipped); }
    CHECK(count[RepairKind::dropped_face] == doubled);
    CHECK(count[RepairKind::closed_hole] == missing);
    CHECK(count[RepairKind::dropped_vertex] == 2);
    CHECK(count[RepairKind::split_vertex] == 0);
    for (std::uint32_t f = 0; f < r.builder.face_count(); ++f) {
      if (r.old_face[f] >= broken.face_count()) { CHECK(r.builder.sheet(f) == no_sheet); }
    }
  }
}

TEST_CASE("a solid that is inside out stays inside out") {
  Faces faces = faces_of(shapes::cube_builder());
  for (auto& corners : faces) { std::reverse(corners.begin(), corners.end()); }
  CHECK(repair(with_faces(shapes::cube_builder(), faces)).repairs.empty());
}

TEST_CASE("solids that touch in a vertex are parted there, each fan gets a vertex at the same place") {
  // n tetrahedra around v0.
  for (std::uint32_t n = 2; n <= 5; ++n) {
    Faces faces;
    for (std::uint32_t i = 0; i < n; ++i) {
      for (auto f : faces_of(shapes::tetrahedron_builder())) {
        for (std::uint32_t& v : f) { v = v == 0 ? 0 : v + 3 * i; }
        faces.push_back(f);
      }
    }
    const Builder broken = with_faces(shapes::tetrahedron_builder(), faces, 3 * (n - 1));
    const RepairResult r = repair(broken);
    check_laws(broken, r);
    REQUIRE(r.remaining.empty());
    REQUIRE(r.repairs.size() == 1);
    CHECK(r.repairs[0].kind == RepairKind::split_vertex);
    CHECK(r.repairs[0].elements.size() == n);
    CHECK(r.builder.vertex_count() == 4 * n);
    for (std::uint32_t v = broken.vertex_count(); v < r.builder.vertex_count(); ++v) { CHECK(r.builder.position(v) == broken.position(0)); }
    CHECK(shell_count(shapes::build(r.builder)) == n);
  }
}

TEST_CASE("holes that touch in a vertex are closed with two faces and the vertex stays one") {
  const Builder torus = shapes::torus_builder(5, 5);
  Faces faces = faces_of(torus);
  faces.erase(faces.begin() + 12);
  faces.erase(faces.begin() + 6);
  const RepairResult r = repair(with_faces(torus, faces));
  check_laws(with_faces(torus, faces), r);
  CHECK(kinds(r) == std::map<RepairKind, int>{{RepairKind::closed_hole, 2}});
  CHECK(face_set(r.builder) == face_set(torus));
}

TEST_CASE("sheets that touch in a vertex get their backs and are parted") {
  Builder b;
  for (int i = 0; i < 5; ++i) { b.vertex({i % 3, i / 3, i * i}); }
  b.face({0, 1, 2}, 0);
  b.face({0, 3, 4}, 0);
  const RepairResult r = repair(b);
  check_laws(b, r);
  CHECK(kinds(r) == std::map<RepairKind, int>{{RepairKind::closed_hole, 2}, {RepairKind::split_vertex, 1}});
  CHECK(shell_count(shapes::build(r.builder)) == 2);
}

TEST_CASE("corners repeated in a row are taken away, what has no three corners is dropped") {
  Faces faces = faces_of(shapes::cube_builder());
  faces[0].push_back(faces[0].front());
  faces[1].insert(faces[1].begin() + 2, 2, faces[1][2]);
  faces.push_back({3, 3, 3});
  faces.push_back({0, 1, 0});
  faces.emplace_back();
  const Builder broken = with_faces(shapes::cube_builder(), faces);
  const RepairResult r = repair(broken);
  check_laws(broken, r);
  CHECK(kinds(r) == std::map<RepairKind, int>{{RepairKind::simplified_face, 2}, {RepairKind::dropped_face, 3}});
  CHECK(face_set(r.builder) == face_set(shapes::cube_builder()));
}

TEST_CASE("what cannot be repaired stays and is reported under its old numbers") {
  // v0 is unused, so that every number changes: three faces at an edge, a bad index, a face that comes back to a vertex.
  Builder b;
  b.vertex({-1, -1, -1});
  const Builder cube = shapes::cube_builder();
  for (std::uint32_t v = 0; v < 8; ++v) { b.vertex(cube.position(v)); }
  for (auto corners : faces_of(cube)) {
    for (std::uint32_t& v : corners) { ++v; }
    b.face(corners, 0);
  }
  const std::uint32_t tip = b.vertex({0, -1, 0});
  b.face({1, 2, tip}, 0);
  b.face({3, 99, 4}, 0);
  b.face({5, 6, 5, 7}, 0);
  const RepairResult r = repair(b);
  check_laws(b, r);
  std::map<DefectKind, const Defect*> found;
  for (const Defect& d : r.remaining) { found[d.kind] = &d; }
  REQUIRE(found.count(DefectKind::nonmanifold_edge) == 1);
  CHECK(found[DefectKind::nonmanifold_edge]->sentence.find("between v1 and v2 has 3 faces") != std::string::npos);
  REQUIRE(found.count(DefectKind::bad_index) == 1);
  CHECK(found[DefectKind::bad_index]->elements == std::vector<Element>{FaceId{7}, VertexId{99}});
  REQUIRE(found.count(DefectKind::repeated_corner) == 1);
  CHECK(found[DefectKind::repeated_corner]->elements[0] == FaceId{8});
  CHECK(kinds(r) == std::map<RepairKind, int>{{RepairKind::dropped_vertex, 1}});
}

TEST_CASE("a one-sided strip is not repaired, and said to be one") {
  Builder b;
  for (int i = 0; i < 10; ++i) { b.vertex({i, i * i, i % 3}); }
  for (std::uint32_t i = 0; i < 4; ++i) { b.face({i, i + 1, i + 6, i + 5}, 0); }
  b.face({4, 5, 0, 9}, 0);
  const RepairResult r = repair(b);
  check_laws(b, r);
  REQUIRE_FALSE(r.remaining.empty());
  CHECK(r.remaining[0].kind == DefectKind::doubled_edge);
  CHECK(r.repairs.empty());
}

TEST_CASE("random damage to solids: the laws of repair hold, and close() gives a BRep exactly when diagnose() is silent") {
  std::size_t mended = 0, refused = 0;
  for (std::uint32_t seed = 1; seed <= 3000; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    const Builder& solid = sound_solids()[random.below(sound_solids().size())];
    Faces faces = faces_of(solid);
    for (std::uint32_t k = 1 + random.below(5); k > 0; --k) {
      auto& corners = faces[random.below(faces.size())];
      if (corners.size() < 3) { continue; }
      switch (random.below(7)) {
        case 0:
          std::reverse(corners.begin(), corners.end());
          break;
        case 1:
          faces.push_back(corners);
          break;
        case 2:
          corners[random.below(corners.size())] = random.below(solid.vertex_count() + 1);
          break;
        case 3:
          corners.erase(corners.begin() + random.below(corners.size()));
          break;
        case 4:
          std::swap(corners[0], corners[random.below(corners.size())]);
          break;
        case 5:
          faces.push_back({random.below(solid.vertex_count()), random.below(solid.vertex_count()), random.below(solid.vertex_count())});
          break;
        default:
          corners.clear();
      }
    }
    const Builder broken = with_faces(solid, faces, random.below(2));
    CHECK(close<shapes::Mesh>(broken).brep.has_value() == diagnose(broken).empty());
    const RepairResult r = repair(broken);
    check_laws(broken, r);
    ++(r.remaining.empty() ? mended : refused);
  }
  CHECK((mended > 300 && refused > 300));  // both sides were tried
}

TEST_CASE("random soup of triangles and quadrilaterals: the laws of repair hold") {
  for (std::uint32_t seed = 1; seed <= 3000; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Builder b;
    const std::uint32_t n = 4 + random.below(8);
    for (std::uint32_t v = 0; v < n; ++v) { b.vertex({random.unit(), random.unit(), random.unit()}); }
    for (std::uint32_t f = random.below(12); f > 0; --f) {
      std::vector<std::uint32_t> corners(3 + random.below(2));
      for (std::uint32_t& v : corners) { v = random.below(n); }
      b.face(corners, 0);
    }
    for (std::uint32_t e = random.below(3) == 0 ? 2 : 0; e > 0; --e) { b.edge(random.below(n + 1), random.below(n)); }
    CHECK(close<shapes::Mesh>(b).brep.has_value() == diagnose(b).empty());
    check_laws(b, repair(b));
  }
}
