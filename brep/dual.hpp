// SPDX-License-Identifier: MIT
#pragma once

// The dual of a BRep: faces and vertices exchanged (paper 2.1: "the dual graph is revealed by exchanging vertices and faces").
//
// Each half-edge is turned by a quarter: the dual h* of h starts at the vertex of face(h), ends at that of face(twin(h)) and has the face
// of target(h) on its left:
//
//            w                          next*(h*)   = prev(twin(h))*        v* = f,  e* = e,  f* = v
//        f   |h   g       f --h*--> g   vertex*(h*) = face(h)*              s and genus stay
//            v                          face*(h*)   = target(h)*
//
// It is built by Euler operators alone, edge by edge, so its log can be replayed and shown: a spanning tree of the vertices of each
// shell first, then the other edges, which split faces and, as bridges, close the handles. The dual of the dual has every
// half-edge with the roles of its ends exchanged, so twin leads back: it is the same map.

#include <cstddef>
#include <utility>
#include <vector>

#include <brep/brep.hpp>
#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/geometry.hpp>

namespace brep {

// A dual, and what became of the elements of the original, each list indexed by their handles (invalid for dead ones).
template <class D>
struct Dual {
  D brep;
  std::vector<HalfedgeId> halfedge;
  std::vector<VertexId> vertex_of_face;
  std::vector<FaceId> face_of_vertex;
};

namespace detail {

template <class D, class B>
class DualMaker {
 public:
  explicit DualMaker(const B& brep)
      : brep_(brep),
        dual_{D{}, std::vector<HalfedgeId>(brep.halfedge_end()), std::vector<VertexId>(brep.face_end()),
              std::vector<FaceId>(brep.vertex_end())},
        reached_(brep.face_end(), false) {}

  Dual<D> run() {
    for (FaceId f : faces(brep_)) {
      if (!reached_[f.index]) { span_shell(f); }
    }
    for (EdgeId e : edges(brep_)) {
      if (!made(brep::halfedge(e))) { connect(brep::halfedge(e)); }
    }
    for (FaceId f : faces(brep_)) {
      const VertexId v = dual_.vertex_of_face[f.index] = dual_.brep.vertex(image(brep_.halfedge(f)));
      if constexpr (requires { dual_.brep.data(v).position = brep_.data(VertexId{}).position; }) {
        dual_.brep.data(v).position = centroid(brep_, f);
      }
    }
    for (VertexId v : vertices(brep_)) { dual_.face_of_vertex[v.index] = dual_.brep.face(image(twin(brep_.halfedge(v)))); }
    return std::move(dual_);
  }

 private:
  [[nodiscard]] HalfedgeId image(HalfedgeId h) const { return dual_.halfedge[h.index]; }
  [[nodiscard]] bool made(HalfedgeId h) const { return image(h).valid(); }
  void set(HalfedgeId h, HalfedgeId to) {
    dual_.halfedge[h.index] = to;
    dual_.halfedge[twin(h).index] = twin(to);
  }

  // The half-edge before which h* is to be inserted: the next one clockwise of those that are there. Clockwise around the dual vertex of
  // a face lie the duals of its half-edges, backward. Looks both ways, so that n insertions cost O(n log n) in any order.
  [[nodiscard]] HalfedgeId corner(HalfedgeId h) const {
    for (HalfedgeId x = brep_.prev(h), y = brep_.next(h);; x = brep_.prev(x), y = brep_.next(y)) {
      if (made(x)) { return image(x); }
      if (made(y)) { return dual_.brep.next(twin(image(y))); }
    }
  }
  // Both h* and its twin are to be inserted in one corner: which comes first, clockwise?
  [[nodiscard]] HalfedgeId first_in_corner(HalfedgeId h) const {
    for (HalfedgeId x = brep_.prev(h), y = brep_.next(h);; x = brep_.prev(x), y = brep_.next(y)) {
      if (x == twin(h) || made(y)) { return h; }
      if (y == twin(h) || made(x)) { return twin(h); }
    }
  }

  // A tree of edges from the vertex of f to all others of its shell, breadth first; a loop when there are no others.
  void span_shell(FaceId f) {
    std::vector<FaceId> found{f};
    reached_[f.index] = true;
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (HalfedgeId h : halfedges_of(brep_, found[i])) {
        const FaceId g = brep_.face(twin(h));
        if (reached_[g.index]) { continue; }
        reached_[g.index] = true;
        if (found.size() == 1) {
          set(h, unchecked::make_segment(dual_.brep));
        } else {
          const HalfedgeId a = corner(h);
          set(h, unchecked::split_vertex(dual_.brep, a, a));
        }
        found.push_back(g);
      }
    }
    if (found.size() > 1) { return; }
    const HalfedgeId h = unchecked::make_segment(dual_.brep);
    set(brep_.halfedge(f), unchecked::split_face(dual_.brep, h, twin(h)));
    unchecked::join_vertices(dual_.brep, h);
  }

  // Inserts h* between vertices that are there.
  void connect(HalfedgeId h) {
    const HalfedgeId a = corner(h), b = corner(twin(h));
    if (a == b) {
      set(first_in_corner(h), unchecked::split_face(dual_.brep, a, a));
    } else if (dual_.brep.face(a) != dual_.brep.face(b)) {
      set(h, unchecked::bridge(dual_.brep, a, b));
    } else if (first_side_is_shorter(dual_.brep, a, b)) {
      set(h, unchecked::split_face(dual_.brep, a, b));
    } else {
      set(twin(h), unchecked::split_face(dual_.brep, b, a));
    }
  }

  const B& brep_;
  Dual<D> dual_;
  std::vector<bool> reached_;
};

}  // namespace detail

// The dual as a new BRep of type D, all data default but for `position`, if both have it: a vertex of the dual lies in the centroid of its
// face. A log in D tells how it was made.
// Time: O(e log e), and the length of a face of the unfinished dual for each handle.
template <class D, class B>
[[nodiscard]] Dual<D> dual(const B& brep) {
  return detail::DualMaker<D, B>(brep).run();
}
template <class B>
[[nodiscard]] Dual<B> dual(const B& brep) {
  return dual<B, B>(brep);
}

}  // namespace brep
