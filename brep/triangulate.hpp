// SPDX-License-Identifier: MIT
#pragma once

// Triangulation by Euler operators: of one face, or of all. No vertex is added; every cut is the best proportioned inner diagonal.
//
// Faces that are not planar are cut as they look along their mean normal. BReps without positions are cut in fans around the
// anchors. Faces of up to three edges stay as they are, also those of one and two edges.

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <brep/circulators.hpp>
#include <brep/extrude.hpp>  // Placed
#include <brep/split.hpp>

namespace brep {

namespace detail {

template <class B>
[[nodiscard]] Result<std::vector<FaceId>> triangulate(B& brep, std::vector<FaceId> faces) {
  if constexpr (Placed<B>) {
    for (FaceId f : faces) {
      if (brep.alive(f) && triangles(brep, f)) { continue; }
      if (const Refusal refusal = check_polygon(brep, f, HUGE_VAL); refusal.code != Code::none) { return refusal; }
    }
    Result<Parts> parts = split_recursively(brep, std::span<const FaceId>(faces), NiceSplit{}, triangles);
    if (!parts) { return parts.refusal(); }
    if (parts->unfinished.empty()) { return std::move(parts->faces); }
    FaceId stuck = parts->unfinished.front();  // a part: on the way back it becomes the face that was given
    for (; !parts->steps.empty(); parts->steps.pop_back()) {
      const Parts last{{}, {}, {parts->steps.back()}};
      if (brep.face(twin(last.steps[0].h)) == stuck) { stuck = brep.face(last.steps[0].h); }
      take_back(brep, last);
    }
    return Refusal{Code::degenerate_polygon, {stuck}};
  } else {
    const auto ear = [](const B& b, FaceId f) { return Cut{b.halfedge(f), b.next(b.next(b.halfedge(f)))}; };
    Result<Parts> parts = split_recursively(brep, std::span<const FaceId>(faces), ear, triangles);
    if (!parts) { return parts.refusal(); }
    return std::move(parts->faces);
  }
}

}  // namespace detail

// Cuts f of n edges into n - 2 triangles and returns them, f first.                                   counts: e+n-3 f+n-3
// A bridge edge to a hole counts twice: the loop of f runs along both sides of it.
// Refused (nothing changes): f is dead, has no area or a boundary that crosses or touches itself; no handle is left.
// Inverse: join_faces for the new edges, last made first.     Time: O(n^2 log n) for the diagonals of each cut.
template <class B>
[[nodiscard]] Result<std::vector<FaceId>> triangulate_face(B& brep, FaceId f) {
  return detail::triangulate(brep, {f});
}

// The same for all faces. Returns the number of new faces. Refused (nothing changes) when one of the faces is.
template <class B>
[[nodiscard]] Result<std::size_t> triangulate(B& brep) {
  std::vector<FaceId> all;
  for (FaceId f : faces(brep)) { all.push_back(f); }
  const auto parts = detail::triangulate(brep, all);
  if (!parts) { return parts.refusal(); }
  return parts->size() - all.size();
}

}  // namespace brep
