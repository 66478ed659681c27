// SPDX-License-Identifier: MIT
#pragma once

// Measures of the faces of a BRep whose vertex data have a `position` (glm::dvec3): polygon.hpp and proportion.hpp with a
// face for the polygon. The corners are all the vertices on the loop, T-vertices included, from the anchor on.
//
// A face of more than 16 edges costs one heap allocation a call.

#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/polygon.hpp>
#include <brep/proportion.hpp>
#include <brep/small_list.hpp>

namespace brep {

// The positions of the half-edges of f, from its anchor.
template <class B>
[[nodiscard]] SmallList<glm::dvec3> positions(const B& brep, FaceId f) {
  SmallList<glm::dvec3> result;
  for (HalfedgeId h : halfedges_of(brep, f)) { result.push_back(brep.data(brep.vertex(h)).position); }
  return result;
}

template <class B>
[[nodiscard]] glm::dvec3 vector_area(const B& brep, FaceId f) {
  return vector_area(Polygon(positions(brep, f)));
}
template <class B>
[[nodiscard]] double area(const B& brep, FaceId f) {
  return area(Polygon(positions(brep, f)));
}
template <class B>
[[nodiscard]] glm::dvec3 normal(const B& brep, FaceId f) {
  return normal(Polygon(positions(brep, f)));
}
template <class B>
[[nodiscard]] glm::dvec3 centroid(const B& brep, FaceId f) {
  return centroid(Polygon(positions(brep, f)));
}
template <class B>
[[nodiscard]] double planarity(const B& brep, FaceId f) {
  return planarity(Polygon(positions(brep, f)));
}
template <class B>
[[nodiscard]] bool is_convex(const B& brep, FaceId f) {
  return is_convex(Polygon(positions(brep, f)));
}
template <class B>
[[nodiscard]] double proportion(const B& brep, FaceId f) {
  return proportion(Polygon(positions(brep, f)));
}

}  // namespace brep
