// SPDX-License-Identifier: MIT
// Tests exercise 9: by default as it stands here, else the file that EXERCISE names.
#include <cmath>

#include <brep/builder.hpp>
#include <brep/conditions.hpp>
#include <brep/geometry.hpp>
#include <brep/split.hpp>
#include <brep/validate.hpp>

#include "check.hpp"

#ifndef EXERCISE
#define EXERCISE "09_split_object.hpp"
#endif
#include EXERCISE

struct Vertex {
  glm::dvec3 position{0.0};
};
using Mesh = brep::BRep<Vertex>;

// A polygon of n corners on an ellipse, with two sides.
static Mesh polygon(unsigned n) {
  brep::Builder builder;
  std::vector<std::uint32_t> there, back;
  for (unsigned i = 0; i < n; ++i) {
    const double angle = 2.0 * 3.14159265358979 * (i + 0.3) / n;
    there.push_back(builder.vertex({3.0 * std::cos(angle), std::sin(angle), 0.0}));
    back.insert(back.begin(), i);
  }
  builder.face(there, 0);
  builder.face(back, brep::no_sheet);
  return *brep::close<Mesh>(builder).brep;
}

int main() {
  for (unsigned n = 4; n <= 13; ++n) {
    Mesh mesh = polygon(n);
    std::vector<glm::dvec3> at;
    for (const brep::HalfedgeId h : brep::halfedges_of(mesh, brep::FaceId{0})) { at.push_back(mesh.data(mesh.vertex(h)).position); }
    double shortest = 1e9;
    for (unsigned i = 0; i < n; ++i) {
      for (unsigned j = i + 2; j < n; ++j) {
        if (i > 0 || j + 1 < n) { shortest = std::min(shortest, glm::length(at[j] - at[i])); }
      }
    }
    const std::string of = " (polygon of " + std::to_string(n) + " corners)";
    const brep::Cut cut = ShortestDiagonal{}(mesh, brep::FaceId{0});
    check(mesh.alive(cut.a) && mesh.alive(cut.b), "there is no cut" + of);
    check(mesh.face(cut.a) == brep::FaceId{0} && mesh.face(cut.b) == brep::FaceId{0}, "the cut leaves its face" + of);
    const double length = glm::length(mesh.data(mesh.vertex(cut.b)).position - mesh.data(mesh.vertex(cut.a)).position);
    check(cut.b != mesh.next(cut.a) && cut.a != mesh.next(cut.b) && cut.a != cut.b, "the cut runs along an edge" + of);
    check(length <= shortest * (1.0 + 1e-12), "there is a shorter diagonal" + of);
    const auto parts = brep::split_recursively(mesh, brep::FaceId{0}, ShortestDiagonal{}, brep::triangles);
    check(parts && parts->faces.size() == n - 2 && parts->unfinished.empty(), "cut after cut does not end in triangles" + of);
    check(brep::validate(mesh).empty(), "the records are damaged afterwards" + of);
  }
  return solved("exercise 9");
}
