// SPDX-License-Identifier: MIT
#pragma once

// Maps (BReps without attributes) as combinatorial objects: a canonical word for each, the dual, the mirror image, the union of two, and
// all maps of few edges.

#include <cstdint>
#include <map>
#include <vector>

#include <brep/euler.hpp>

#include "shapes.hpp"

namespace maps {

using brep::HalfedgeId;
using Bare = brep::BRep<>;
using Word = std::vector<std::uint32_t>;

// Two connected BReps have the same word exactly when an orientation-preserving renaming maps one to the other: number the half-edges in
// the order in which next and twin reach them from a root, write the links down, take the least word of all roots. The
// roots that give the least word are images of each other, so their number is that of the automorphisms.
struct Canonical {
  Word word;
  std::size_t automorphisms = 0;
};
template <class B>
Canonical canonical(const B& mesh) {
  Canonical best;
  for (HalfedgeId root : shapes::all_halfedges(mesh)) {
    std::map<HalfedgeId, std::uint32_t> number{{root, 0}};
    std::vector<HalfedgeId> order{root};
    Word word;
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (HalfedgeId h : {mesh.next(order[i]), twin(order[i])}) {
        const auto found = number.emplace(h, static_cast<std::uint32_t>(order.size()));
        if (found.second) { order.push_back(h); }
        word.push_back(found.first->second);
      }
    }
    if (best.word.empty() || word < best.word) { best = {word, 0}; }
    if (word == best.word) { ++best.automorphisms; }
  }
  return best;
}

// Faces become vertices and vertices faces, free slots included; next*(h) = next(twin(h)). The dual of the dual is the same, record for
// record.
inline Bare dual(const Bare& mesh) {
  using brep::detail::Raw;
  Bare result = mesh;
  for (HalfedgeId h : shapes::all_halfedges(mesh)) {
    auto& r = Raw::at(result, h);
    r.next = mesh.next(twin(h));
    r.prev = twin(mesh.prev(h));
    r.vertex.index = mesh.face(h).index;
    r.face.index = mesh.vertex(h).index;
  }
  Raw::vertices(result) = Raw::faces(mesh);  // records without attributes have one type
  Raw::faces(result) = Raw::vertices(mesh);
  return result;
}

// The same seen in a mirror: every loop runs the other way round, so a half-edge starts where it ended.
inline Bare mirrored(const Bare& mesh) {
  using brep::detail::Raw;
  Bare result = mesh;
  for (HalfedgeId h : shapes::all_halfedges(mesh)) { Raw::at(result, h) = {mesh.prev(h), mesh.next(h), mesh.target(h), mesh.face(h)}; }
  for (brep::VertexId v : brep::vertices(mesh)) { Raw::at(result, v).halfedge = twin(mesh.halfedge(v)); }
  return result;
}

// The elements of b appended to those of a, as further shells.
inline Bare together(const Bare& a, const Bare& b) {
  using brep::detail::Raw;
  Bare result = a;
  std::map<HalfedgeId, HalfedgeId> h;
  std::map<brep::VertexId, brep::VertexId> v;
  std::map<brep::FaceId, brep::FaceId> f;
  for (brep::EdgeId e : brep::edges(b)) {
    h[halfedge(e)] = Raw::new_edge(result);
    h[twin(halfedge(e))] = twin(h[halfedge(e)]);
  }
  for (brep::VertexId x : brep::vertices(b)) { Raw::at(result, v[x] = Raw::new_vertex(result)).halfedge = h[b.halfedge(x)]; }
  for (brep::FaceId x : brep::faces(b)) { Raw::at(result, f[x] = Raw::new_face(result)).halfedge = h[b.halfedge(x)]; }
  for (const auto& [old, made] : h) { Raw::at(result, made) = {h[b.next(old)], h[b.prev(old)], v[b.vertex(old)], f[b.face(old)]}; }
  return result;
}

// All connected maps with n edges for n = 1 ... limit, any genus, reached by the operators alone: every map of two edges or more has an
// edge that can be deleted or contracted and leaves a connected map, so adding an edge in all ways to all maps reaches all.
using Level = std::map<Word, Bare>;
inline std::vector<Level> all_maps(std::size_t limit) {
  Bare segment, loop;
  REQUIRE(make_segment(segment));
  const HalfedgeId h = *make_segment(loop);  // a circle of two edges, one of them contracted
  REQUIRE(split_face(loop, h, twin(h)));
  REQUIRE(join_vertices(loop, h));
  std::vector<Level> levels(limit + 1);
  for (const Bare& first : {segment, loop}) { levels[1].emplace(canonical(first).word, first); }
  for (std::size_t n = 1; n < limit; ++n) {
    for (const auto& entry : levels[n]) {
      const Bare& mesh = entry.second;
      for (HalfedgeId a : shapes::all_halfedges(mesh)) {
        for (HalfedgeId b : shapes::all_halfedges(mesh)) {
          const auto keep = [&](auto&& grow) {
            Bare grown = mesh;
            if (grow(grown)) { levels[n + 1].emplace(canonical(grown).word, grown); }
          };
          keep([&](Bare& m) { return split_face(m, a, b).has_value(); });
          keep([&](Bare& m) { return split_vertex(m, a, b).has_value(); });
          keep([&](Bare& m) { return bridge(m, a, b).has_value(); });
          keep([&](Bare& m) { return weld(m, a, b).has_value(); });
        }
      }
    }
  }
  return levels;
}

}  // namespace maps
