// SPDX-License-Identifier: MIT
#pragma once

// Repairs what can be repaired in a builder, and says what was done: a step from Builder to Builder that comes before close().
//
// In this order: corners that a face repeats in a row, and faces without three corners, are taken away; duplicate faces are dropped;
// flipped faces turn as the majority of their component runs (a whole component is never turned: an inside-out room is legal);
// a border that comes back to itself gets one face with the sheet no_sheet, its other side; a vertex with several fans becomes one
// vertex for each, at the same place; unused vertices are dropped. Positions are never merged or moved. A hole's new face
// need not be planar.
//
// Not repairable: an edge where more than two faces meet, a one-sided surface, a corner or coordinate that does not exist,
// a face that comes back to a vertex later on, a loop of inserted edges that does not close. They stay as they are, are listed in
// `remaining`, and nothing next to a face that cannot be used is filled in.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <brep/diagnosis.hpp>

namespace brep {

enum class RepairKind : std::uint8_t {
  simplified_face,  // corners repeated in a row were taken away
  dropped_face,     // fewer than three corners, or a duplicate
  flipped_face,     // it runs as its neighbours now
  closed_hole,      // a new face lies along a border
  split_vertex,     // each fan has a vertex of its own now
  dropped_vertex    // no face has the vertex as a corner
};

struct Repair {
  RepairKind kind;
  std::vector<Element> elements;
  std::string sentence;
};

// In sentences and elements, vertices and faces bear the numbers of the input; new ones follow after its last.
struct RepairResult {
  Builder builder;
  std::vector<Repair> repairs;            // in the order in which they were made
  std::vector<Defect> remaining;          // none exactly when close(builder) gives a BRep
  std::vector<std::uint32_t> old_vertex;  // of each vertex of `builder`: its number in sentences
  std::vector<std::uint32_t> old_face;
};

namespace detail {

class Repairer {
 public:
  explicit Repairer(const Builder& input) : assembly_(Assembler(input).run()) {
    const Builder& b = assembly_.builder;
    unreadable_ = Diagnosis(b, &assembly_).run();
    std::erase_if(unreadable_, [](const Defect& d) { return d.kind != DefectKind::bad_index; });
    for (std::uint32_t v = 0; v < b.vertex_count(); ++v) { place_.push_back(v); }
    for (std::uint32_t f = 0; f < b.face_count(); ++f) {
      faces_.emplace_back(b.corners(f).begin(), b.corners(f).end());
      for (std::uint32_t& v : faces_.back()) {
        v = v < b.vertex_count() ? v : invalid_index;  // never the number of a new vertex
      }
      sheets_.push_back(b.sheet(f));
    }
    dropped_.assign(faces_.size(), false);
  }

  [[nodiscard]] RepairResult run() {
    simplify();
    drop_duplicates();
    std::size_t before;
    do {  // when fans are parted, a border may come apart from another one and become closed
      before = result_.repairs.size();
      flip_and_close();
      split_fans();
    } while (result_.repairs.size() > before);
    const std::vector<bool> used = drop_vertices();
    find_remaining(used);
    renumber(used);
    return std::move(result_);
  }

 private:
  void add(RepairKind kind, std::vector<Element> elements, std::string sentence) {
    result_.repairs.push_back({kind, std::move(elements), std::move(sentence)});
  }
  // The present state, all numbers kept: dropped faces have no corners.
  [[nodiscard]] Builder snapshot() const {
    Builder b;
    for (std::uint32_t v : place_) { b.vertex(assembly_.builder.position(v)); }
    for (std::size_t f = 0; f < faces_.size(); ++f) { b.face(faces_[f], sheets_[f]); }
    return b;
  }
  // Vertices of faces that cannot be used. Nothing is filled in or parted at them: that would repair a consequence, not the cause.
  [[nodiscard]] std::vector<bool> vertices_of(const std::vector<bool>& bad) const {
    std::vector<bool> touched(place_.size(), false);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (std::uint32_t v : faces_[f]) {
        if (bad[f] && v < touched.size()) { touched[v] = true; }
      }
    }
    return touched;
  }

  void simplify() {
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      std::vector<std::uint32_t>& corners = faces_[f];
      const bool readable = std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return v < place_.size(); });
      if (!readable) { continue; }
      const std::size_t before = corners.size();
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      while (corners.size() > 1 && corners.front() == corners.back()) { corners.pop_back(); }
      const std::string name = to_string(FaceId{f});
      if (corners.size() < 3) {
        add(RepairKind::dropped_face, {FaceId{f}}, name + " was dropped: it has fewer than three different corners");
        drop(f);
      } else if (corners.size() < before) {
        add(RepairKind::simplified_face, {FaceId{f}},
            name + " had corners repeated in a row; " + std::to_string(corners.size()) + " of " + std::to_string(before) + " remain");
      }
    }
  }

  void drop_duplicates() {
    const Builder now = snapshot();
    for (const auto& [first, again] : duplicate_faces(now, unusable(now))) {
      add(RepairKind::dropped_face, {FaceId{again}, FaceId{first}},
          to_string(FaceId{again}) + " was dropped: it is " + to_string(FaceId{first}) + " entered again");
      drop(again);
    }
  }

  void flip_and_close() {
    const Builder now = snapshot();
    const std::vector<bool> bad = unusable(now);
    const EdgeUses uses(now, bad);
    const FlipPlan orientation(now, uses, bad);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (!orientation.flip[f]) { continue; }
      std::reverse(faces_[f].begin() + 1, faces_[f].end());
      add(RepairKind::flipped_face, {FaceId{f}}, to_string(FaceId{f}) + " was flipped: now it runs as its neighbours do");
    }
    for (const Border& border : borders(uses, orientation, vertices_of(bad))) {
      if (!border.closed) { continue; }
      std::vector<std::uint32_t> corners;
      for (const Border::Edge& e : border.edges) { corners.push_back(e.from); }
      std::reverse(corners.begin(), corners.end());
      const FaceId f{static_cast<std::uint32_t>(faces_.size())};
      std::vector<Element> elements{f};
      for (std::uint32_t v : corners) { elements.push_back(VertexId{v}); }
      std::string sentence = "a hole of " + std::to_string(corners.size()) + " edges was closed with the new face " + to_string(f) +
                             " along" + name_list(elements, 1);
      add(RepairKind::closed_hole, std::move(elements), std::move(sentence));
      faces_.push_back(std::move(corners));
      sheets_.push_back(no_sheet);
      dropped_.push_back(false);
    }
  }

  void split_fans() {
    const Builder now = snapshot();
    const std::vector<bool> bad = unusable(now), touched = vertices_of(bad);
    UnionFind fans = EdgeUses(now, bad).fans();
    std::vector<std::uint32_t> owner(now.vertex_count(), invalid_index);      // the fan that keeps the vertex
    std::vector<std::uint32_t> vertex_of(now.corner_count(), invalid_index);  // by the first corner of a fan
    struct Split {
      std::vector<Element> elements;
      std::size_t fans;
    };
    std::vector<Split> splits;
    std::vector<std::uint32_t> split_of(now.vertex_count(), invalid_index);
    for (std::uint32_t f = 0; f < now.face_count(); ++f) {
      if (bad[f]) { continue; }
      std::uint32_t corner = now.first_corner(f);
      for (std::uint32_t& v : faces_[f]) {
        const std::uint32_t fan = fans.find(corner++);
        if (touched[v]) { continue; }
        if (owner[v] == invalid_index) { owner[v] = fan; }
        if (owner[v] == fan) { continue; }
        if (vertex_of[fan] == invalid_index) {
          vertex_of[fan] = static_cast<std::uint32_t>(place_.size());
          place_.push_back(place_[v]);
          if (split_of[v] == invalid_index) {
            split_of[v] = static_cast<std::uint32_t>(splits.size());
            splits.push_back({{VertexId{v}}, 1});
          }
          splits[split_of[v]].elements.push_back(VertexId{vertex_of[fan]});
          ++splits[split_of[v]].fans;
        }
        v = vertex_of[fan];
      }
    }
    for (Split& s : splits) {
      std::string sentence = to_string(s.elements[0]) + " was split, it had " + std::to_string(s.fans) +
                             " fans of faces; the new vertices at its place:" + name_list(s.elements, 1);
      add(RepairKind::split_vertex, std::move(s.elements), std::move(sentence));
    }
  }

  std::vector<bool> drop_vertices() {
    std::vector<bool> used(place_.size(), false);
    for (const auto& corners : faces_) {
      for (std::uint32_t v : corners) {
        if (v < used.size()) { used[v] = true; }
      }
    }
    for (const Defect& d : assembly_.defects) {  // the ends of an inserted edge without a face
      for (const Element& e : d.elements) {
        if (e.letter == 'v' && e.index < used.size()) { used[e.index] = true; }
      }
    }
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!used[v]) {
        add(RepairKind::dropped_vertex, {VertexId{v}}, to_string(VertexId{v}) + " was dropped: it is not a corner of any face");
      }
    }
    return used;
  }

  void find_remaining(const std::vector<bool>& used) {
    const Builder now = snapshot();
    assembly_.broken.resize(faces_.size(), false);
    result_.remaining = Diagnosis(now, &assembly_).run();
    std::vector<Defect>& found = result_.remaining;
    std::erase_if(found, [&](const Defect& d) {  // what was taken away is no defect any more
      const Element& e = d.elements[0];
      if (d.kind == DefectKind::bad_index) { return true; }
      return e.letter == 'f' ? e.index < dropped_.size() && dropped_[e.index] : e.index < used.size() && !used[e.index];
    });
    found.insert(found.begin(), unreadable_.begin(), unreadable_.end());  // their sentences keep the numbers of the input
  }

  void renumber(const std::vector<bool>& used) {
    std::vector<std::uint32_t> new_vertex(place_.size(), invalid_index);
    for (std::uint32_t v = 0; v < place_.size(); ++v) {
      if (!used[v]) { continue; }
      new_vertex[v] = result_.builder.vertex(assembly_.builder.position(place_[v]));
      result_.old_vertex.push_back(v);
    }
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (dropped_[f]) { continue; }
      for (std::uint32_t& v : faces_[f]) { v = v < new_vertex.size() ? new_vertex[v] : invalid_index; }
      result_.builder.face(faces_[f], sheets_[f]);
      result_.old_face.push_back(f);
    }
    for (const Defect& d : assembly_.defects) {  // inserted edges without a face stay as they are
      if (d.kind != DefectKind::unused_edge && d.kind != DefectKind::bad_index) { continue; }
      const std::uint32_t u = d.elements[d.elements.size() - 2].index, w = d.elements.back().index;
      const std::uint32_t face = d.kind == DefectKind::bad_index ? invalid_index - 1 : invalid_index;
      const auto renamed = [&](std::uint32_t v) { return v < assembly_.builder.vertex_count() ? new_vertex[v] : invalid_index; };
      result_.builder.edge(renamed(u), renamed(w), face);
    }
  }

  void drop(std::uint32_t f) {
    dropped_[f] = true;
    faces_[f].clear();
  }

  Assembly assembly_;
  std::vector<Defect> unreadable_;  // indices that name nothing
  std::vector<std::vector<std::uint32_t>> faces_;
  std::vector<std::uint32_t> sheets_;
  std::vector<bool> dropped_;         // faces
  std::vector<std::uint32_t> place_;  // of each vertex, old or new: the input's vertex that has its position
  RepairResult result_;
};

}  // namespace detail

// The repaired builder, what was done, and what remains to be done by hand. O(n log n) in the corners.
[[nodiscard]] inline RepairResult repair(const Builder& builder) { return detail::Repairer(builder).run(); }

}  // namespace brep
