// SPDX-License-Identifier: MIT
// Duality: exchange faces and vertices, and split_face becomes split_vertex, join_faces join_vertices, bridge weld, cut unweld. Not only
// up to names: the dual operator on the dual makes the dual of the result, record for record, free lists included.

#include "calls.hpp"
#include "maps.hpp"

using namespace brep;
using calls::Call;
using maps::Bare;
using maps::dual;
using shapes::picture;

namespace {

Operator dual_operator(Operator op) {
  switch (op) {
    case Operator::split_face:
      return Operator::split_vertex;
    case Operator::split_vertex:
      return Operator::split_face;
    case Operator::join_faces:
      return Operator::join_vertices;
    case Operator::join_vertices:
      return Operator::join_faces;
    case Operator::bridge:
      return Operator::weld;
    case Operator::weld:
      return Operator::bridge;
    case Operator::cut:
      return Operator::unweld;
    case Operator::unweld:
      return Operator::cut;
    default:
      return op;
  }
}

// Anchors of the dual may differ: where a new face gets the twin as its anchor, so does the dual vertex, but what an operator that
// removes an edge puts in the place of a lost anchor is the next around the face, or around the vertex.
void check_dual_call(const Bare& start, const Call& call) {
  INFO(calls::to_string(call));
  Bare m = start, d = dual(start);
  const calls::Answer answer = calls::apply(m, call), of_dual = calls::apply(d, {dual_operator(call.op), call.a, call.b});
  CHECK(answer.done == of_dual.done);
  CHECK(answer.made == of_dual.made);
  CHECK(shapes::faults(d) == "");
  CHECK(picture(dual(m), shapes::Anchors::hidden) == picture(d, shapes::Anchors::hidden));
  if (!removes_edge(call.op)) { CHECK(picture(dual(m)) == picture(d)); }
}

void check_all(const Bare& start) {
  CHECK(shapes::faults(dual(start)) == "");
  CHECK(picture(dual(dual(start))) == picture(start));
  for (HalfedgeId a : shapes::all_halfedges(start)) {
    for (Operator op : {Operator::join_faces, Operator::join_vertices, Operator::cut, Operator::unweld}) {
      check_dual_call(start, {op, a, {}});
    }
    for (HalfedgeId b : shapes::all_halfedges(start)) {
      for (Operator op : {Operator::split_face, Operator::split_vertex, Operator::bridge, Operator::weld}) {
        check_dual_call(start, {op, a, b});
      }
    }
  }
}

}  // namespace

TEST_CASE("the dual operator on the dual makes the dual, for every call on every map of up to four edges") {
  for (const maps::Level& level : maps::all_maps(4)) {
    for (const auto& [word, mesh] : level) { check_all(mesh); }
  }
}

TEST_CASE("the dual operator on the dual makes the dual, for two shells and in long random sequences") {
  const auto levels = maps::all_maps(2);
  for (const auto& [word, first] : levels[2]) {
    for (const auto& [other_word, second] : levels[2]) { check_all(maps::together(first, second)); }
  }
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Bare m;
    for (int i = 0; i < 400; ++i) {
      const Call call = calls::random_call(m, random, 50);
      if (dual_operator(call.op) != call.op) { check_dual_call(m, call); }
      calls::apply(m, call);
    }
  }
}

TEST_CASE("the dual of a cube has the counts of an octahedron, and each kind of shell keeps its handles") {
  const Bare cube = shapes::build<Bare>(shapes::cube_builder()), octahedron = dual(cube);
  CHECK((octahedron.vertex_count() == 6 && octahedron.edge_count() == 12 && octahedron.face_count() == 8));
  for (FaceId f : faces(octahedron)) { CHECK(degree(octahedron, f) == 3); }
  CHECK(genus(dual(shapes::build<Bare>(shapes::torus_builder(3, 4)))) == 1);
}
