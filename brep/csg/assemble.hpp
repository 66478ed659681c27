// SPDX-License-Identifier: MIT
#pragma once

// From the faces that are selected to the boundary of the result: regluing, merging, and leaving out what is no longer needed.
//
// Around a common edge the selected faces begin and end the result in turn; twins are the two that bound one solid wedge. So every result
// is a 2-manifold, whatever coincides: where solids touch along an edge, there are two edges. Then neighbours in one plane with equal
// attributes become one face (join_faces and cut, as links), and points between two edges on one line go (join_vertices).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/radial.hpp>
#include <brep/csg/work.hpp>
#include <brep/edge_uses.hpp>

namespace brep::csg::detail {

class Assemble {
 public:
  // keep: of each face. A kept half-edge whose twin is not kept must be glued anew.
  Assemble(Work& work, std::vector<std::uint8_t> keep)
      : work_(work), keep_(std::move(keep)), removed_(work.halves.size(), 0), groups_(work.faces.size()) {}

  // The half-edge is one of several at its place: its edge stays.
  void hold(std::uint32_t h) {
    removed_[h] = held;
    touching_ = true;
  }

  // Pairs the kept faces around each common edge; false: they do not begin and end in turn.
  [[nodiscard]] bool glue(const Radial& radial);

  // Removes the edge of h if both its faces are kept, lie in one plane, look the same way, and have attributes of which same(i, j) holds.
  template <class Same>
  void merge(std::uint32_t h, Same&& same) {
    const std::uint32_t t = work_.halves[h].twin, f = work_.halves[h].face, g = work_.halves[t].face;
    if (removed_[h] != 0 || !keep_[f] || !keep_[g] || work_.faces[f].plane != work_.faces[g].plane) { return; }
    if (f != g && !same(work_.faces[f].attribute, work_.faces[g].attribute)) { return; }
    const std::uint32_t before_h = work_.halves[h].prev, after_h = work_.halves[h].next;
    const std::uint32_t before_t = work_.halves[t].prev, after_t = work_.halves[t].next;
    if (after_h != t) { work_.link(before_t, after_h); }
    if (after_t != h) { work_.link(before_h, after_t); }
    removed_[h] = removed_[t] = gone;
    groups_.unite(f, g);
  }

  // Removes the points for which candidate(point) holds and where two edges on one line meet and nothing else.
  template <class Candidate>
  void straighten(Candidate&& candidate) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> leaving;  // point, half-edge
    for (std::uint32_t f = 0; f < work_.faces.size(); ++f) {
      if (!keep_[f]) { continue; }
      const WorkFace& face = work_.faces[f];
      for (std::uint32_t i = 0; i < face.count; ++i) {
        const std::uint32_t h = work_.half(face, i);
        if (removed_[h] != gone && candidate(work_.halves[h].point)) { leaving.emplace_back(work_.halves[h].point, h); }
      }
    }
    std::sort(leaving.begin(), leaving.end());
    for (std::size_t first = 0, end = 0; first < leaving.size(); first = end) {
      while (end < leaving.size() && leaving[end].first == leaving[first].first) { ++end; }
      if (!straight(leaving.data() + first, leaving.data() + end)) { continue; }
      const std::uint32_t ahead = work_.target(leaving[first].second);
      for (std::size_t i = first; i < end; ++i) {
        const std::uint32_t h = leaving[i].second;
        if (work_.target(h) != ahead) { continue; }
        drop(h);
      }
    }
  }

  // The same umbrella by umbrella, whatever else meets the point.
  void straighten_umbrellas();

  [[nodiscard]] Boundary run();

 private:
  [[nodiscard]] bool kept(std::uint32_t h) const { return keep_[work_.halves[h].face] != 0; }

  // Removes the vertex at which h begins: the edge of h and the edge before it become one.
  void drop(std::uint32_t h);

  bool pair(const Spine& a, const Spine& b);

  // Do the half-edges that leave a point run along two edges on one line, and each surface straight on?
  [[nodiscard]] bool straight(const std::pair<std::uint32_t, std::uint32_t>* begin,
                              const std::pair<std::uint32_t, std::uint32_t>* end) const;

  static constexpr std::uint8_t gone = 1, held = 2;

  Work& work_;
  bool touching_ = false;
  std::vector<std::uint8_t> keep_, removed_;
  brep::detail::UnionFind groups_;
};

// The boundary with faces as large as they can be, if that may be another one.
template <class Same>
[[nodiscard]] std::optional<Boundary> with_largest_faces(const PlaneTable& planes, const Boundary& boundary, Same&& same) {
  if (!boundary.touching) { return std::nullopt; }
  Work work(planes);
  work.add(boundary, false, false, 0);
  Assemble assemble(work, std::vector<std::uint8_t>(work.faces.size(), 1));
  for (std::uint32_t h = 0; h < work.halves.size(); ++h) { assemble.merge(h, same); }
  assemble.straighten_umbrellas();
  return assemble.run();
}

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/assemble.cpp>
#endif
