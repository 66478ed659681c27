// SPDX-License-Identifier: MIT
#pragma once

// All records of a BRep in one state, as plain numbers: what the stepper draws and tabulates, independent of the type of the BRep.

#include <cstdint>
#include <vector>

#include <brep/circulators.hpp>

namespace apps::euler {

struct Records {
  struct Halfedge {
    bool alive = false;
    std::uint32_t next = 0, prev = 0, vertex = 0, face = 0;
    friend bool operator==(const Halfedge&, const Halfedge&) = default;
  };
  std::vector<Halfedge> halfedges;             // by index, dead ones included
  std::vector<std::uint32_t> vertices, faces;  // the anchor half-edges; brep::invalid_index for dead elements
  long v = 0, e = 0, f = 0;

  [[nodiscard]] bool alive(brep::HalfedgeId h) const { return h.index < halfedges.size() && halfedges[h.index].alive; }
};

template <class B>
[[nodiscard]] Records records_of(const B& brep) {
  Records r;
  r.halfedges.resize(brep.halfedge_end());
  r.vertices.assign(brep.vertex_end(), brep::invalid_index);
  r.faces.assign(brep.face_end(), brep::invalid_index);
  for (std::uint32_t i = 0; i < brep.halfedge_end(); ++i) {
    const brep::HalfedgeId h{i};
    if (!brep.alive(h)) { continue; }
    r.halfedges[i] = {true, brep.next(h).index, brep.prev(h).index, brep.vertex(h).index, brep.face(h).index};
  }
  for (brep::VertexId v : brep::vertices(brep)) { r.vertices[v.index] = brep.halfedge(v).index; }
  for (brep::FaceId f : brep::faces(brep)) { r.faces[f.index] = brep.halfedge(f).index; }
  r.v = static_cast<long>(brep.vertex_count());
  r.e = static_cast<long>(brep.edge_count());
  r.f = static_cast<long>(brep.face_count());
  return r;
}

}  // namespace apps::euler
