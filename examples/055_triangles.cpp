// SPDX-License-Identifier: MIT
// A mesh of triangles from a cube: poke, triangulate, flip and collapse, written with Euler operators alone. So the log of a solid is a
// script: it is replayed into another solid, and read back from its text.

#include <cstdio>

#include <brep/edit.hpp>
#include <brep/euler_log.hpp>
#include <brep/euler_script_parse.hpp>
#include <brep/euler_script_run.hpp>
#include <brep/euler_script_text.hpp>
#include <brep/extrude.hpp>
#include <brep/replay.hpp>
#include <brep/triangulate.hpp>
#include <brep/validate.hpp>

struct Point {
  glm::dvec3 position{0.0};
};
using Solid = brep::BRep<Point, brep::NoData, brep::NoData, brep::EulerLog>;

static void print(const char* step, const Solid& solid) {
  std::printf("%-24s v %2zu e %2zu f %2zu  faults %zu\n", step, solid.vertex_count(), solid.edge_count(), solid.face_count(),
              brep::validate(solid).size());
}

int main() {
  // A square with two sides, one of them lifted: a cube.
  Solid solid;
  const brep::HalfedgeId first = *brep::make_segment(solid);
  brep::HalfedgeId last = first;
  for (int i = 0; i < 2; ++i) { last = *brep::split_edge(solid, last); }
  const brep::FaceId lid = solid.face(*brep::split_face(solid, twin(last), first));
  const glm::dvec3 square[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  int i = 0;
  for (brep::HalfedgeId h : brep::halfedges_of(solid, lid)) { solid.data(solid.vertex(h)).position = square[i++]; }
  const brep::FaceId top = *brep::extrude_face(solid, lid, glm::dvec3{0.0, 0.0, 1.0});
  print("cube", solid);

  const brep::HalfedgeId rim = solid.halfedge(top), side = twin(rim);
  brep::poke_face(solid, solid.face(side));
  print("a side poked", solid);
  (void)brep::triangulate_face(solid, top);
  print("the top triangulated", solid);
  const auto triangles = brep::triangulate(solid);
  print("all triangulated", solid);
  const brep::HalfedgeId flipped = *brep::flip_edge(solid, side);
  print("an edge flipped", solid);
  const auto refused = brep::collapse_edge(solid, flipped);
  if (!refused) { std::puts(refused.refusal().sentence().c_str()); }  // nothing changes
  (void)brep::collapse_edge(solid, solid.next(rim));
  print("an edge collapsed", solid);

  Solid copy;
  const brep::Replay replay = brep::replay(brep::steps(solid), copy);
  std::printf("%zu steps replayed%s\n", replay.done, replay ? "" : ", then refused");
  print("the copy", copy);
  Solid from_text;
  const auto script = brep::parse_script(brep::to_text(brep::steps(solid)));
  const auto error = brep::run_script(*script.script, from_text);
  print(error ? error->sentence.c_str() : "the copy from a script", from_text);
  return triangles ? 0 : 1;
}
