// SPDX-License-Identifier: MIT
// A cube by Euler operators alone.
//
// Whatever is built with them keeps v - e + f = 2(s - h), here 2: one shell, no handle. We draw a square on a sphere,
// raise a post at each of its corners, and join the tips of the posts.

#include <cstdio>

#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/validate.hpp>

using namespace brep;

static void print(const char* step, const BRep<>& cube) {
  const int v = static_cast<int>(cube.vertex_count()), e = static_cast<int>(cube.edge_count()), f = static_cast<int>(cube.face_count());
  std::printf("%-34s v = %d  e = %2d  f = %d   v - e + f = %d\n", step, v, e, f, v - e + f);
}

int main() {
  BRep<> cube;

  // The smallest shell there is: two vertices, one edge, and one face all around it.
  const HalfedgeId first = *make_segment(cube);
  print("make_segment", cube);

  // Two more vertices on the edge make a path of four corners; an edge between its ends closes the square and divides the
  // sphere in two faces: the bottom of the cube and the rest.
  split_edge(cube, first);
  split_edge(cube, first);
  print("split_edge, twice", cube);
  const HalfedgeId last = cube.next(cube.next(first));
  const HalfedgeId closing = *split_face(cube, twin(last), first);
  const FaceId rest = cube.face(twin(closing));
  print("split_face closes the square", cube);

  // A post at each corner: split_vertex(c, c) leaves all edges where they are and gives a spur inside the face of c.
  HalfedgeId post[4], corner = twin(closing);
  for (HalfedgeId& p : post) {
    p = *split_vertex(cube, corner, corner);  // runs from the corner to the tip
    corner = cube.next(corner);
    print("split_vertex raises a post", cube);
  }

  // An edge from tip to tip cuts a side off the rest. After the last one the rest is the top.
  HalfedgeId rim;
  for (int i = 0; i < 4; ++i) {
    const HalfedgeId h = *split_face(cube, twin(post[i]), i < 3 ? twin(post[i + 1]) : rim);
    if (i == 0) { rim = h; }
    print("split_face closes a side", cube);
  }

  std::printf("\nfaults found: %zu\n", validate(cube).size());
  for (FaceId f : faces(cube)) {
    std::printf("%s:", to_string(f).c_str());
    for (HalfedgeId h : halfedges_of(cube, f)) { std::printf(" %s", to_string(cube.vertex(h)).c_str()); }
    std::printf("%s\n", f == rest ? "   the top" : "");
  }

  // An impossible request changes nothing and says why.
  const HalfedgeId top = cube.halfedge(rest), side = twin(top);
  std::printf("\n%s\n", split_face(cube, top, side).refusal().sentence().c_str());
  print("still", cube);
}
