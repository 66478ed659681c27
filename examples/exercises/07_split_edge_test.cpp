// SPDX-License-Identifier: MIT
// Tests exercise 7: by default as it stands here, else the file that EXERCISE names.
#include <brep/brep.hpp>
#include <brep/euler.hpp>
#include <brep/isomorphism.hpp>
#include <brep/validate.hpp>

#include "check.hpp"

#ifndef EXERCISE
#define EXERCISE "07_split_edge.hpp"
#endif
#include EXERCISE

using Solid = brep::BRep<>;

// A triangle with two sides, a spur at one corner and a loop on the other side.
static Solid shape() {
  Solid solid;
  const brep::HalfedgeId h = *brep::make_segment(solid);
  const brep::HalfedgeId k = *brep::split_vertex(solid, brep::twin(h), brep::twin(h));
  (void)brep::split_face(solid, brep::twin(k), h);
  (void)brep::split_vertex(solid, h, h);
  (void)brep::split_face(solid, brep::twin(k), brep::twin(k));
  return solid;
}

int main() {
  const Solid before = shape();
  for (const brep::HalfedgeId h : brep::halfedges(before)) {
    Solid mine = shape(), theirs = shape();
    const brep::VertexId from = mine.vertex(h);
    const brep::HalfedgeId n = split_edge_of_mine(mine, h);
    (void)brep::split_edge(theirs, h);
    const std::string at = " (h" + std::to_string(h.index) + ")";
    check(brep::validate(mine).empty(), "the records are damaged afterwards" + at);
    check(mine.vertex_count() == before.vertex_count() + 1 && mine.edge_count() == before.edge_count() + 1 &&
              mine.face_count() == before.face_count(),
          "a vertex on an edge is one vertex and one edge more, and no face" + at);
    check(mine.vertex(h) == from, "h does not begin where it began" + at);
    check(mine.next(h) == n, "the result is not next(h)" + at);
    check(brep::find_isomorphism(mine, theirs).has_value(), "the new vertex does not lie on the edge of h" + at);
  }
  return solved("exercise 7");
}
