// SPDX-License-Identifier: MIT
#include <limits>

#include <glm/geometric.hpp>

#include <brep/circulators.hpp>
#include <brep/split.hpp>

struct ShortestDiagonal {
  template <class B>
  brep::Cut operator()(const B& mesh, brep::FaceId f) const {
    brep::Cut best;
    double least = std::numeric_limits<double>::infinity();
    for (const brep::HalfedgeId a : brep::halfedges_of(mesh, f)) {
      for (const brep::HalfedgeId b : brep::halfedges_of(mesh, f)) {
        if (a == b || b == mesh.next(a) || a == mesh.next(b)) { continue; }
        const double length = glm::length(mesh.data(mesh.vertex(b)).position - mesh.data(mesh.vertex(a)).position);
        if (length < least) { least = length, best = {a, b}; }
      }
    }
    return best;
  }
};
