// SPDX-License-Identifier: MIT
//
// Split objects say where a face is cut, condition objects when it is finished (paper 2.2); split_recursively combines any two. Both
// are function objects, so a lambda will do, and conditions compose by && || and !.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <brep/builder.hpp>
#include <brep/geometry.hpp>
#include <brep/refine.hpp>
#include <brep/split.hpp>
#include <brep/t_vertices.hpp>

namespace {

struct Vertex : brep::Tag {  // the split level of regular refinement
  glm::dvec3 position{0.0};
};
struct Face : brep::Tag {};
using Mesh = brep::BRep<Vertex, brep::NoData, Face>;

constexpr brep::FaceId front{0};

// A polygon of n corners on an ellipse, with two sides; the front is f0.
Mesh polygon(std::uint32_t n) {
  brep::Builder builder;
  std::vector<std::uint32_t> there, back;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2.0 * 3.14159265358979323846 * i / n;
    there.push_back(builder.vertex({3.0 * std::cos(angle), std::sin(angle), 0.0}));
    back.insert(back.begin(), i);
  }
  builder.face(there, 0);
  builder.face(back, brep::no_sheet);
  return *brep::close<Mesh>(builder).brep;
}

template <class Split, class Condition>
void show(const char* what, const Split& split, const Condition& finished) {
  Mesh mesh = polygon(12);
  const auto parts = brep::split_recursively(mesh, front, split, finished);
  double least = 1.0;
  for (brep::FaceId f : parts->faces) { least = std::min(least, brep::proportion(mesh, f)); }
  std::printf("%-36s %2zu parts, %2zu unfinished, least proportion %.3f\n", what, parts->faces.size(), parts->unfinished.size(), least);
  brep::rejoin(mesh, *parts);  // takes all cuts back
  if (mesh.face_count() != 2 || brep::degree(mesh, front) != 12) { std::puts("not rejoined"); }
}

}  // namespace

int main() {
  using brep::AreaBelow, brep::BesidePlane, brep::Convex, brep::NiceSplit, brep::ProportionAbove, brep::quadrangles, brep::triangles;
  const auto halve = [](const Mesh& mesh, brep::FaceId f) {  // a split object of one's own: from the anchor to the corner opposite
    brep::Cut cut{mesh.halfedge(f), mesh.halfedge(f)};
    for (std::size_t i = 0; i < degree(mesh, f) / 2; ++i) { cut.b = mesh.next(cut.b); }
    return cut;
  };
  show("well shaped triangles", NiceSplit{}, triangles);
  show("halves to triangles", halve, triangles);
  show("quadrangles", NiceSplit{}, quadrangles);
  show("quadrangles below an area of 1", NiceSplit{}, quadrangles && AreaBelow{1.0});
  show("well shaped, or triangles", NiceSplit{}, (Convex{} && ProportionAbove{0.4}) || triangles);
  show("small, but no triangles", NiceSplit{}, AreaBelow{2.0} && !triangles);
  const glm::dvec3 origin{0.0}, diagonal{1.0, 1.0, 0.0};
  show("on one side of a plane", brep::AlongPlane{origin, diagonal}, BesidePlane{origin, diagonal});

  // A square, refined once; one child refined again leaves T-vertices on its neighbours, which splitting along them eliminates.
  Mesh mesh = polygon(4);
  const std::vector<brep::FaceId> children = *brep::refine(mesh, front);
  (void)brep::refine(mesh, children[1]);
  std::size_t with_t_vertices = 0, added = 0;
  for (brep::FaceId f : children) { with_t_vertices += brep::NoTVertices{}(mesh, f) ? 0 : 1; }
  for (brep::FaceId f : children) { added += brep::eliminate_t_vertices(mesh, f); }
  std::printf("faces with T-vertices: %zu; eliminated by %zu more faces\n", with_t_vertices, added);
}
