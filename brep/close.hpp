// SPDX-License-Identifier: MIT
#pragma once

// close(): the end of the construction phase. First, independent of the attributes: which half-edge does each corner
// become, and what is wrong; then the records are written in one pass.
//
// Each corner of a face stands for the half-edge from it to the next corner. Two corners that run along the same two vertices
// in opposite directions are the halves of an edge. The edges found so far hang in chains, one for each vertex; an edge hangs at the
// end of lower degree, so that a vertex of high degree (the tip of a cone) does not make the search slow.
// Included by builder.hpp, which says what a user needs to know.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <brep/builder.hpp>

namespace brep {

namespace detail {

class Matching {
 public:
  std::vector<std::uint32_t> halfedge;  // of each corner, in the order of the builder
  std::uint32_t edge_count = 0;
  std::vector<Defect> defects;

  explicit Matching(const Builder& builder) : builder_(builder) {
    check_vertices_and_corners();
    match();
    if (!extras_.empty()) report_doubled();
    if (matched_ != halfedge.size()) report_borders();
    report_fans();
    for (std::uint32_t v = 0; v < degree_.size(); ++v) {
      if (degree_[v] == 0) add(DefectKind::unused_vertex, {VertexId{v}}, name(v) + " is not a corner of any face");
    }
    edge_count = static_cast<std::uint32_t>(edges_.size());
  }

 private:
  static constexpr std::uint32_t none = invalid_index;
  struct Edge {
    std::uint32_t origin, target;         // of the first half
    std::uint32_t next;                   // in the chain
    std::array<std::uint32_t, 2> corner;  // of the first half and of its twin
  };
  struct Extra {  // a further corner that runs along a half-edge which has one already
    std::uint32_t halfedge, corner;
  };

  static std::string name(std::uint32_t v) { return to_string(VertexId{v}); }
  void add(DefectKind kind, std::vector<Element> elements, std::string sentence) {
    defects.push_back({kind, std::move(elements), std::move(sentence)});
  }
  [[nodiscard]] FaceId face_of(std::uint32_t corner) const {
    std::uint32_t lo = 0, hi = builder_.face_count();  // the last face whose first corner is <= corner
    while (hi - lo > 1) {
      const std::uint32_t middle = lo + (hi - lo) / 2;
      (builder_.first_corner(middle) <= corner ? lo : hi) = middle;
    }
    return FaceId{lo};
  }

  void check_vertices_and_corners() {
    const std::uint32_t n = builder_.vertex_count();
    for (std::uint32_t v = 0; v < n; ++v) {
      const glm::dvec3& p = builder_.position(v);
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
      add(DefectKind::bad_position, {VertexId{v}}, name(v) + " has a coordinate that is not a finite number");
    }
    bad_.assign(builder_.face_count(), false);
    degree_.assign(n, 0);
    excused_.assign(n, false);
    std::vector<std::uint32_t> seen(n, none);
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      const auto corners = builder_.corners(f);
      bool bad = corners.size() < 3;
      if (bad) {
        add(DefectKind::few_corners, {FaceId{f}},
            to_string(FaceId{f}) + " has " + std::to_string(corners.size()) + " corners, a face needs three");
      }
      for (std::uint32_t v : corners) {
        if (v >= n) {
          add(DefectKind::bad_index, {FaceId{f}, VertexId{v}},
              to_string(FaceId{f}) + " has the corner " + name(v) + ", but there are only " + std::to_string(n) + " vertices");
          bad = true;
          continue;
        }
        ++degree_[v];
        if (seen[v] == f) {
          add(DefectKind::repeated_corner, {FaceId{f}, VertexId{v}}, to_string(FaceId{f}) + " visits " + name(v) + " twice");
          bad = true;
        }
        seen[v] = f;
      }
      if (!bad) continue;
      bad_[f] = true;
      for (std::uint32_t v : corners) {
        if (v < n) excused_[v] = true;
      }
    }
  }

  void match() {
    const std::uint32_t n = builder_.vertex_count();
    std::vector<std::uint32_t> chain(n, none);
    halfedge.assign(builder_.corner_count(), none);
    next_corner_.resize(builder_.corner_count());
    edges_.reserve(builder_.corner_count() / 2 + 1);
    std::uint32_t corner = 0;
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      const auto corners = builder_.corners(f);
      const std::uint32_t first = corner;
      if (bad_[f]) {  // already reported
        corner += static_cast<std::uint32_t>(corners.size());
        matched_ += corners.size();
        continue;
      }
      for (std::size_t k = 0; k < corners.size(); ++k, ++corner) {
        const bool last = k + 1 == corners.size();
        next_corner_[corner] = last ? first : corner + 1;
        const std::uint32_t u = corners[k], w = last ? corners[0] : corners[k + 1];
        std::uint32_t& head = chain[degree_[u] < degree_[w] || (degree_[u] == degree_[w] && u < w) ? u : w];
        std::uint32_t e = head;
        while (e != none && !(edges_[e].origin == w && edges_[e].target == u) &&
               !(edges_[e].origin == u && edges_[e].target == w)) {
          e = edges_[e].next;
        }
        if (e == none) {
          halfedge[corner] = static_cast<std::uint32_t>(2 * edges_.size());
          edges_.push_back({u, w, head, {corner, none}});
          head = static_cast<std::uint32_t>(edges_.size() - 1);
          continue;
        }
        const std::uint32_t half = edges_[e].origin == u ? 0 : 1;
        halfedge[corner] = 2 * e + half;
        if (edges_[e].corner[half] == none) {
          edges_[e].corner[half] = corner;
          matched_ += 2;
        } else {
          extras_.push_back({2 * e + half, corner});
        }
      }
    }
  }

  void report_doubled() {
    std::sort(extras_.begin(), extras_.end(), [](const Extra& a, const Extra& b) {
      return a.halfedge != b.halfedge ? a.halfedge < b.halfedge : a.corner < b.corner;
    });
    // The one further use of a half-edge without a twin, or none: such edges are what a flipped face leaves.
    const auto twice = [&](std::uint32_t e) {
      const auto x = std::lower_bound(extras_.begin(), extras_.end(), 2 * e,
                                      [](const Extra& a, std::uint32_t key) { return a.halfedge < key; });
      const bool once = x != extras_.end() && x->halfedge == 2 * e && (x + 1 == extras_.end() || (x + 1)->halfedge / 2 != e);
      return once && edges_[e].corner[1] == none ? x->corner : none;
    };
    std::vector<bool> explained(edges_.size(), false);
    std::uint32_t done = none;  // faces up to here were asked
    std::vector<std::uint32_t> candidates;
    for (const Extra& extra : extras_) {
      candidates.push_back(face_of(extra.corner).index);
      candidates.push_back(face_of(edges_[extra.halfedge / 2].corner[extra.halfedge % 2]).index);
    }
    std::sort(candidates.begin(), candidates.end());
    for (std::uint32_t f : candidates) {
      if (f == done) continue;
      done = f;
      const std::uint32_t begin = builder_.first_corner(f), count = static_cast<std::uint32_t>(builder_.corners(f).size());
      bool flipped = true;
      for (std::uint32_t c = begin; flipped && c < begin + count; ++c) {
        flipped = halfedge[c] != none && twice(halfedge[c] / 2) != none && !explained[halfedge[c] / 2];
      }
      if (!flipped) continue;
      for (std::uint32_t c = begin; c < begin + count; ++c) explained[halfedge[c] / 2] = true;
      add(DefectKind::flipped_face, {FaceId{f}},
          to_string(FaceId{f}) + " is flipped: all its edges run the same way as in the neighbouring faces");
    }
    for (std::size_t i = 0; i < extras_.size();) {
      const std::uint32_t h = extras_[i].halfedge;
      const Edge& e = edges_[h / 2];
      const std::uint32_t u = h % 2 == 0 ? e.origin : e.target, w = h % 2 == 0 ? e.target : e.origin;
      std::vector<Element> elements{VertexId{u}, VertexId{w}, face_of(e.corner[h % 2])};
      std::string faces = to_string(elements[2]);
      for (; i < extras_.size() && extras_[i].halfedge == h; ++i) {
        elements.push_back(face_of(extras_[i].corner));
        faces += ' ' + to_string(elements.back());
      }
      if (explained[h / 2]) continue;
      add(DefectKind::doubled_edge, std::move(elements),
          "the edge from " + name(u) + " to " + name(w) + " is used in this direction by more than one face: " + faces +
              "; one of them is flipped, or entered twice, or more than two faces meet here");
    }
  }

  void report_borders() {
    std::vector<bool> doubled(edges_.size(), false);
    for (const Extra& extra : extras_) doubled[extra.halfedge / 2] = true;
    std::vector<std::uint32_t> open, enters(degree_.size(), 0);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      if (edges_[e].corner[1] != none) continue;
      at_defect(edges_[e].origin) = at_defect(edges_[e].target) = true;
      if (doubled[e] || excused_[edges_[e].origin] || excused_[edges_[e].target]) continue;
      open.push_back(e);
      ++enters[edges_[e].target];
    }
    std::stable_sort(open.begin(), open.end(), [&](std::uint32_t a, std::uint32_t b) { return edges_[a].origin < edges_[b].origin; });
    std::vector<std::uint32_t> cursor(degree_.size() + 1, 0);  // open edges by origin: those not yet taken begin here
    for (std::uint32_t e : open) ++cursor[edges_[e].origin + 1];
    for (std::size_t v = 1; v < cursor.size(); ++v) cursor[v] += cursor[v - 1];
    const std::vector<std::uint32_t> begin = cursor;
    const auto take = [&](std::uint32_t v) { return cursor[v] < begin[v + 1] ? open[cursor[v]++] : none; };
    const auto follow = [&](std::uint32_t v) {
      std::vector<std::uint32_t> chain;
      for (std::uint32_t e = take(v); e != none; e = take(edges_[e].target)) chain.push_back(e);
      if (!chain.empty()) report_border(chain);
    };
    for (std::uint32_t e : open) {
      if (enters[edges_[e].origin] == 0) follow(edges_[e].origin);
    }
    for (std::uint32_t e : open) follow(edges_[e].origin);
  }

  void report_border(const std::vector<std::uint32_t>& chain) {
    std::vector<Element> elements;
    for (std::uint32_t e : chain) elements.push_back(VertexId{edges_[e].origin});
    if (edges_[chain.back()].target != edges_[chain.front()].origin) elements.push_back(VertexId{edges_[chain.back()].target});
    std::string path;
    for (std::size_t i = 0; i < elements.size() && i < 12; ++i) path += ' ' + to_string(elements[i]);
    if (elements.size() > 12) path += " ...";
    std::string faces;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      elements.push_back(face_of(edges_[chain[i]].corner[0]));
      if (i < 12) faces += ' ' + to_string(elements.back());
    }
    if (chain.size() > 12) faces += " ...";
    add(DefectKind::open_border, std::move(elements),
        "open border of " + std::to_string(chain.size()) + (chain.size() == 1 ? " edge" : " edges") + " along" + path +
            ": nothing lies on the other side of" + faces + "; a face is missing");
  }

  std::vector<bool>::reference at_defect(std::uint32_t v) {
    if (at_defect_.empty()) at_defect_.assign(degree_.size(), false);
    return at_defect_[v];
  }

  void report_fans() {
    for (const Extra& extra : extras_) at_defect(edges_[extra.halfedge / 2].origin) = at_defect(edges_[extra.halfedge / 2].target) = true;
    for (std::uint32_t v = 0; v < excused_.size(); ++v) {
      if (excused_[v]) at_defect(v) = true;
    }
    // One fan has as many corners as the vertex has; look closer only where the first fan has fewer.
    std::vector<bool> seen(degree_.size(), false);
    std::uint32_t corner = 0;
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      for (std::uint32_t v : builder_.corners(f)) {
        const std::uint32_t c = corner++;
        if (v >= seen.size() || seen[v] || (!at_defect_.empty() && at_defect_[v])) continue;
        seen[v] = true;
        if (walk_fan(c, [](std::uint32_t) {}) == degree_[v]) continue;
        fanned_.push_back(v);
      }
    }
    if (fanned_.empty()) return;
    std::sort(fanned_.begin(), fanned_.end());
    std::vector<std::vector<Element>> elements(fanned_.size());
    std::vector<bool> walked(builder_.corner_count(), false);
    corner = 0;
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      for (std::uint32_t v : builder_.corners(f)) {
        const std::uint32_t c = corner++;
        const auto x = std::lower_bound(fanned_.begin(), fanned_.end(), v);
        if (x == fanned_.end() || *x != v || walked[c]) continue;
        walk_fan(c, [&](std::uint32_t k) { walked[k] = true; });
        std::vector<Element>& list = elements[static_cast<std::size_t>(x - fanned_.begin())];
        if (list.empty()) list.push_back(VertexId{v});
        list.push_back(FaceId{f});
      }
    }
    for (std::vector<Element>& list : elements) {
      std::string faces;
      for (std::size_t i = 1; i < list.size(); ++i) faces += ' ' + to_string(list[i]);
      std::string sentence = to_string(list[0]) + " has " + std::to_string(list.size() - 1) +
                             " fans of faces, a vertex has one; a face of each:" + faces + "; make one vertex for each fan";
      add(DefectKind::several_fans, std::move(list), std::move(sentence));
    }
  }

  // Visits the corners of one fan, clockwise; every edge at its vertex must have both halves. The number of corners.
  template <class Visit>
  std::uint32_t walk_fan(std::uint32_t first, Visit&& visit) const {
    std::uint32_t count = 0, c = first;
    do {
      visit(c);
      ++count;
      const std::uint32_t h = halfedge[c];
      c = next_corner_[edges_[h / 2].corner[1 - h % 2]];
    } while (c != first);
    return count;
  }

  const Builder& builder_;
  std::vector<std::uint32_t> degree_;       // corners at a vertex
  std::vector<bool> bad_;                   // faces that cannot be used
  std::vector<bool> excused_;               // a corner of a bad face: what is missing here has been reported
  std::vector<std::uint32_t> next_corner_;  // on the same face
  std::vector<Edge> edges_;
  std::vector<Extra> extras_;
  std::size_t matched_ = 0;
  std::vector<bool> at_defect_;  // vertices on an edge with a defect, empty when there is none
  std::vector<std::uint32_t> fanned_;
};

}  // namespace detail

// Builds the BRep, or reports every defect. Vertex data get `.position`, face data get `.sheet`, if they have such members.
// A defect that is only the consequence of a reported one (the border around a face with a bad index) is not reported.
template <class B>
[[nodiscard]] BuildResult<B> close(const Builder& builder) {
  using detail::Raw;
  detail::Matching matching(builder);
  BuildResult<B> result;
  result.defects = std::move(matching.defects);
  if (!result.defects.empty()) return result;

  B& brep = result.brep.emplace();
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) {
    [[maybe_unused]] auto& data = brep.data(Raw::new_vertex(brep));
    if constexpr (requires { data.position = builder.position(v); }) data.position = builder.position(v);
  }
  for (std::uint32_t e = 0; e < matching.edge_count; ++e) (void)Raw::new_edge(brep);
  std::uint32_t corner = 0;
  for (std::uint32_t i = 0; i < builder.face_count(); ++i) {
    const FaceId f = Raw::new_face(brep);
    [[maybe_unused]] auto& data = brep.data(f);
    if constexpr (requires { data.sheet = builder.sheet(i); }) data.sheet = builder.sheet(i);
    const std::span<const std::uint32_t> corners = builder.corners(i);
    const HalfedgeId first{matching.halfedge[corner]};
    HalfedgeId prev{matching.halfedge[corner + corners.size() - 1]}, h = first;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const HalfedgeId next = k + 1 < corners.size() ? HalfedgeId{matching.halfedge[corner + k + 1]} : first;
      Raw::at(brep, h) = {next, prev, VertexId{corners[k]}, f};
      Raw::at(brep, VertexId{corners[k]}).halfedge = h;
      prev = h;
      h = next;
    }
    Raw::at(brep, f).halfedge = first;
    corner += static_cast<std::uint32_t>(corners.size());
  }
  return result;
}

}  // namespace brep
