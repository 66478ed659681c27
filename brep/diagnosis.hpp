// SPDX-License-Identifier: MIT
#pragma once

// The second half of close(), when something is left over: whatever the matching of the corners could not explain is found
// here, all defects at once, each as a sentence about the builder's vertices and faces.
//
// Consequences are left out: the border around a face that could not be used, the doubled edges of a flipped face, the
// fans at a vertex on an open border. Time is linear, up to sorting the defects.

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <brep/builder_input.hpp>
#include <brep/match.hpp>

namespace brep::detail {

// Adds to the defects of a matching what is wrong with faces and vertices together.
class Diagnosis {
 public:
  Diagnosis(const Builder& builder, Matching& matching) : builder_(builder), m_(matching) {}

  void run() {
    if (!m_.extras.empty()) report_doubled();
    if (m_.matched != m_.halfedge.size()) report_borders();
    report_fans();
    for (std::uint32_t v = 0; v < m_.degree.size(); ++v) {
      if (m_.degree[v] == 0) m_.add(DefectKind::unused_vertex, {VertexId{v}}, Matching::name(v) + " is not a corner of any face");
    }
  }

 private:
  [[nodiscard]] FaceId face_of(std::uint32_t corner) const {
    std::uint32_t lo = 0, hi = builder_.face_count();  // the last face whose first corner is <= corner
    while (hi - lo > 1) {
      const std::uint32_t middle = lo + (hi - lo) / 2;
      (builder_.first_corner(middle) <= corner ? lo : hi) = middle;
    }
    return FaceId{lo};
  }

  void report_doubled() {
    std::sort(m_.extras.begin(), m_.extras.end(), [](const Matching::Extra& a, const Matching::Extra& b) {
      return a.halfedge != b.halfedge ? a.halfedge < b.halfedge : a.corner < b.corner;
    });
    // The one further use of a half-edge without a twin, or none: such edges are what a flipped face leaves.
    const auto twice = [&](std::uint32_t e) {
      const auto x = std::lower_bound(m_.extras.begin(), m_.extras.end(), 2 * e,
                                      [](const Matching::Extra& a, std::uint32_t key) { return a.halfedge < key; });
      const bool once = x != m_.extras.end() && x->halfedge == 2 * e && (x + 1 == m_.extras.end() || (x + 1)->halfedge / 2 != e);
      return once && m_.edges[e].corner[1] == Matching::none ? x->corner : Matching::none;
    };
    std::vector<bool> explained(m_.edges.size(), false);
    std::uint32_t done = Matching::none;  // faces up to here were asked
    std::vector<std::uint32_t> candidates;
    for (const Matching::Extra& extra : m_.extras) {
      candidates.push_back(face_of(extra.corner).index);
      candidates.push_back(face_of(m_.edges[extra.halfedge / 2].corner[extra.halfedge % 2]).index);
    }
    std::sort(candidates.begin(), candidates.end());
    for (std::uint32_t f : candidates) {
      if (f == done) continue;
      done = f;
      const std::uint32_t begin = builder_.first_corner(f), count = static_cast<std::uint32_t>(builder_.corners(f).size());
      bool flipped = true;
      for (std::uint32_t c = begin; flipped && c < begin + count; ++c) {
        flipped = m_.halfedge[c] != Matching::none && twice(m_.halfedge[c] / 2) != Matching::none && !explained[m_.halfedge[c] / 2];
      }
      if (!flipped) continue;
      for (std::uint32_t c = begin; c < begin + count; ++c) explained[m_.halfedge[c] / 2] = true;
      m_.add(DefectKind::flipped_face, {FaceId{f}},
             to_string(FaceId{f}) + " is flipped: all its edges run the same way as in the neighbouring faces");
    }
    for (std::size_t i = 0; i < m_.extras.size();) {
      const std::uint32_t h = m_.extras[i].halfedge;
      const Matching::Edge& e = m_.edges[h / 2];
      const std::uint32_t u = h % 2 == 0 ? e.origin : e.target, w = h % 2 == 0 ? e.target : e.origin;
      std::vector<Element> elements{VertexId{u}, VertexId{w}, face_of(e.corner[h % 2])};
      std::string faces = to_string(elements[2]);
      for (; i < m_.extras.size() && m_.extras[i].halfedge == h; ++i) {
        elements.push_back(face_of(m_.extras[i].corner));
        faces += ' ' + to_string(elements.back());
      }
      if (explained[h / 2]) continue;
      m_.add(DefectKind::doubled_edge, std::move(elements),
             "the edge from " + Matching::name(u) + " to " + Matching::name(w) + " is used in this direction by more than one face: " +
                 faces + "; one of them is flipped, or entered twice, or more than two faces meet here");
    }
  }

  void report_borders() {
    std::vector<bool> doubled(m_.edges.size(), false);
    for (const Matching::Extra& extra : m_.extras) doubled[extra.halfedge / 2] = true;
    std::vector<std::uint32_t> open, enters(m_.degree.size(), 0);
    for (std::uint32_t e = 0; e < m_.edges.size(); ++e) {
      if (m_.edges[e].corner[1] != Matching::none) continue;
      at_defect(m_.edges[e].origin) = at_defect(m_.edges[e].target) = true;
      if (doubled[e] || m_.excused[m_.edges[e].origin] || m_.excused[m_.edges[e].target]) continue;
      open.push_back(e);
      ++enters[m_.edges[e].target];
    }
    std::sort(open.begin(), open.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(m_.edges[a].origin, a) < std::pair(m_.edges[b].origin, b); });
    std::vector<std::uint32_t> cursor(m_.degree.size() + 1, 0);  // open edges by origin: those not yet taken begin here
    for (std::uint32_t e : open) ++cursor[m_.edges[e].origin + 1];
    for (std::size_t v = 1; v < cursor.size(); ++v) cursor[v] += cursor[v - 1];
    const std::vector<std::uint32_t> begin = cursor;
    const auto take = [&](std::uint32_t v) { return cursor[v] < begin[v + 1] ? open[cursor[v]++] : Matching::none; };
    const auto follow = [&](std::uint32_t v) {
      std::vector<std::uint32_t> chain;
      for (std::uint32_t e = take(v); e != Matching::none; e = take(m_.edges[e].target)) chain.push_back(e);
      if (!chain.empty()) report_border(chain);
    };
    for (std::uint32_t e : open) {
      if (enters[m_.edges[e].origin] == 0) follow(m_.edges[e].origin);
    }
    for (std::uint32_t e : open) follow(m_.edges[e].origin);
  }

  void report_border(const std::vector<std::uint32_t>& chain) {
    std::vector<Element> elements;
    for (std::uint32_t e : chain) elements.push_back(VertexId{m_.edges[e].origin});
    if (m_.edges[chain.back()].target != m_.edges[chain.front()].origin) elements.push_back(VertexId{m_.edges[chain.back()].target});
    std::string path;
    for (std::size_t i = 0; i < elements.size() && i < 12; ++i) path += ' ' + to_string(elements[i]);
    if (elements.size() > 12) path += " ...";
    std::string faces;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      elements.push_back(face_of(m_.edges[chain[i]].corner[0]));
      if (i < 12) faces += ' ' + to_string(elements.back());
    }
    if (chain.size() > 12) faces += " ...";
    m_.add(DefectKind::open_border, std::move(elements),
           "open border of " + std::to_string(chain.size()) + (chain.size() == 1 ? " edge" : " edges") + " along" + path +
               ": nothing lies on the other side of" + faces + "; a face is missing");
  }

  std::vector<bool>::reference at_defect(std::uint32_t v) {
    if (at_defect_.empty()) at_defect_.assign(m_.degree.size(), false);
    return at_defect_[v];
  }

  void report_fans() {
    for (const Matching::Extra& extra : m_.extras)
      at_defect(m_.edges[extra.halfedge / 2].origin) = at_defect(m_.edges[extra.halfedge / 2].target) = true;
    for (std::uint32_t v = 0; v < m_.excused.size(); ++v) {
      if (m_.excused[v]) at_defect(v) = true;
    }
    // One fan has as many corners as the vertex has; look closer only where the first fan has fewer.
    std::vector<bool> seen(m_.degree.size(), false);
    std::uint32_t corner = 0;
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      for (std::uint32_t v : builder_.corners(f)) {
        const std::uint32_t c = corner++;
        if (v >= seen.size() || seen[v] || (!at_defect_.empty() && at_defect_[v])) continue;
        seen[v] = true;
        if (walk_fan(c, [](std::uint32_t) {}) == m_.degree[v]) continue;
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
      m_.add(DefectKind::several_fans, std::move(list), std::move(sentence));
    }
  }

  // Visits the corners of one fan, clockwise; every edge at its vertex must have both halves. The number of corners.
  template <class Visit>
  std::uint32_t walk_fan(std::uint32_t first, Visit&& visit) const {
    std::uint32_t count = 0, c = first;
    do {
      visit(c);
      ++count;
      const std::uint32_t h = m_.halfedge[c];
      c = m_.next_corner[m_.edges[h / 2].corner[1 - h % 2]];
    } while (c != first);
    return count;
  }

  const Builder& builder_;
  Matching& m_;
  std::vector<bool> at_defect_;  // vertices on an edge with a defect, empty when there is none
  std::vector<std::uint32_t> fanned_;
};

}  // namespace brep::detail
