// SPDX-License-Identifier: MIT
//
// Walking around. What lies around an element is a range: for range-for, and for the algorithms of the standard. The dual exchanges
// faces and vertices, so the neighbours of a face are the neighbours of its vertex in the dual, in the same order.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>

#include <brep/builder.hpp>
#include <brep/dual.hpp>
#include <brep/neighbours.hpp>
#include <brep/shells.hpp>

namespace {

using Solid = brep::BRep<>;

template <class Range>
std::string list(const Range& range) {
  std::string text;
  for (const auto& element : range) { text += ' ' + to_string(element); }
  return text;
}

// A prism over a triangle.
brep::Builder prism() {
  brep::Builder builder;
  for (const double z : {0.0, 1.0}) {
    builder.vertex({0, 0, z});
    builder.vertex({1, 0, z});
    builder.vertex({0, 1, z});
  }
  builder.face({2, 1, 0}, 0);
  builder.face({3, 4, 5}, 1);
  for (std::uint32_t i = 0; i < 3; ++i) { builder.face({i, (i + 1) % 3, 3 + (i + 1) % 3, 3 + i}, 2); }
  return builder;
}

}  // namespace

int main() {
  const Solid solid = *brep::close<Solid>(prism()).brep;
  for (brep::FaceId f : brep::faces(solid)) {
    std::printf("%s: corners%s, edges%s, neighbours%s\n", to_string(f).c_str(), list(vertices_of(solid, f)).c_str(),
                list(edges_of(solid, f)).c_str(), list(neighbours_of(solid, f)).c_str());
  }
  const brep::VertexId v{0};
  std::printf("%s: faces%s, edges%s, neighbours%s\n", to_string(v).c_str(), list(faces_of(solid, v)).c_str(),
              list(edges_of(solid, v)).c_str(), list(neighbours_of(solid, v)).c_str());

  const auto is_triangle = [&](brep::FaceId f) { return degree(solid, f) == 3; };
  std::printf("triangles: %d of %zu faces\n", static_cast<int>(std::ranges::count_if(faces(solid), is_triangle)), solid.face_count());

  const brep::Dual<Solid> dual = brep::dual(solid);
  std::printf("\ndual: v %zu e %zu f %zu\n", dual.brep.vertex_count(), dual.brep.edge_count(), dual.brep.face_count());
  for (brep::FaceId f : brep::faces(solid)) {
    const brep::VertexId w = dual.vertex_of_face[f.index];
    std::printf("%s is %s there, with the neighbours%s\n", to_string(f).c_str(), to_string(w).c_str(),
                list(neighbours_of(dual.brep, w)).c_str());
  }

  // Two solids in one BRep are two shells; each can be listed.
  Solid two = solid;
  const brep::HalfedgeId h = *brep::make_segment(two);
  for (const brep::Shell& shell : brep::shells(two)) {
    std::printf("shell of %s: v %zu e %zu f %zu, genus %zu\n", to_string(shell.halfedge).c_str(), shell.vertices, shell.edges, shell.faces,
                shell.genus());
  }
  std::printf("the second:%s,%s,%s\n", list(brep::vertices_of_shell(two, h)).c_str(), list(brep::halfedges_of_shell(two, h)).c_str(),
              list(brep::faces_of_shell(two, h)).c_str());
}
