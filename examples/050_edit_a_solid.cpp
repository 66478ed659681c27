// SPDX-License-Identifier: MIT
// Operators above the Euler operators: extrude, glue, punch a hole. Each is written with Euler operators alone, so what it does is in the
// log and can be undone.

#include <cstdio>

#include <glm/vec3.hpp>

#include <brep/edit.hpp>
#include <brep/euler_log.hpp>
#include <brep/extrude.hpp>
#include <brep/glue.hpp>
#include <brep/replay.hpp>
#include <brep/shells.hpp>
#include <brep/validate.hpp>

struct Point {
  glm::dvec3 position{0.0};
};
using Solid = brep::BRep<Point, brep::NoData, brep::NoData, brep::EulerLog>;

static void print(const char* step, const Solid& solid) {
  std::printf("%-24s v %2zu e %2zu f %2zu  shells %zu  handles %ld  faults %zu\n", step, solid.vertex_count(), solid.edge_count(),
              solid.face_count(), brep::shells(solid).size(), brep::genus(solid), brep::validate(solid).size());
}

// A unit cube with its lower left corner at `at`: a square with two sides, one of them lifted. Returns the top.
static brep::FaceId add_cube(Solid& solid, const glm::dvec3& at) {
  const brep::HalfedgeId first = *brep::make_segment(solid);
  brep::HalfedgeId last = first;
  for (int i = 0; i < 2; ++i) { last = *brep::split_edge(solid, last); }
  const brep::FaceId top = solid.face(*brep::split_face(solid, twin(last), first));  // its loop: first, ..., last, and the new edge
  const glm::dvec3 square[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  int i = 0;
  for (brep::HalfedgeId h : brep::halfedges_of(solid, top)) { solid.data(solid.vertex(h)).position = at + square[i++]; }
  return *brep::extrude_face(solid, top, glm::dvec3{0.0, 0.0, 1.0});
}

// From a half-edge of a quadrilateral across the opposite edge to the face there.
static brep::HalfedgeId across(const Solid& solid, brep::HalfedgeId h) { return twin(solid.next(solid.next(h))); }

int main() {
  Solid solid;
  const brep::FaceId lower = add_cube(solid, {0, 0, 0}), upper = add_cube(solid, {0, 0, 1});
  print("two cubes", solid);

  const brep::HalfedgeId on_lower = solid.halfedge(lower), on_upper = across(solid, twin(solid.halfedge(upper)));
  const std::size_t seam = *brep::glue_faces(solid, on_lower, on_upper);
  print("glued, one on the other", solid);
  std::printf("edges of the seam: %zu\n", seam);

  // A hole from top to bottom. It has the size of the faces that it joins, so both get a smaller face first.
  const auto inset = [](Solid& s, brep::VertexId lifted, brep::VertexId base) {
    const glm::dvec3 p = s.data(base).position;
    s.data(lifted).position = {0.25 + 0.5 * p.x, 0.25 + 0.5 * p.y, p.z};
  };
  const brep::HalfedgeId opposite = across(solid, across(solid, twin(solid.halfedge(upper))));  // down two sides, to the bottom
  const brep::FaceId bottom = solid.face(opposite);
  solid.set_anchor(bottom, opposite);  // the smaller face keeps the anchor, so the anchors of both lie opposite each other
  brep::extrude_face(solid, upper, inset);
  brep::extrude_face(solid, bottom, inset);
  print("smaller faces inset", solid);

  const std::size_t whole = brep::mark(solid);
  brep::punch_hole(solid, solid.halfedge(upper), solid.halfedge(bottom));
  print("hole punched", solid);
  std::puts(brep::glue_faces(solid, on_lower, on_lower).refusal().sentence().c_str());  // nothing changes
  brep::undo_to(solid, whole);
  print("before the hole again", solid);
}
