// SPDX-License-Identifier: MIT
#pragma once

// What is wrong with a builder: all defects at once, each as a sentence about the builder's vertices and faces.
//
// close() calls it only after its fast way has failed, so this file aims at good sentences, not at speed: O(n log n) in the corners.
// Consequences of a reported defect are not reported: the border around a face that could not be used, the doubled edges
// of flipped faces, the fans at a vertex on a border that a face in the hole would join.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/edge_uses.hpp>
#include <brep/finite.hpp>

namespace brep::detail {

// Faces with the same corners in the same order as an earlier one: pairs {earlier, later}, by the later one.
[[nodiscard]] inline std::vector<std::pair<std::uint32_t, std::uint32_t>> duplicate_faces(const Builder& builder,
                                                                                          const std::vector<bool>& skip) {
  struct Key {
    std::uint32_t least, count, after, face;  // the least vertex, the number of corners, the vertex after the least one
    std::size_t start;
  };
  std::vector<Key> keys;
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    if (skip[f]) { continue; }
    const auto corners = builder.corners(f);
    const auto start = static_cast<std::size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
    keys.push_back({corners[start], static_cast<std::uint32_t>(corners.size()), corners[(start + 1) % corners.size()], f, start});
  }
  const auto compare = [&](const Key& a, const Key& b) {
    if (a.least != b.least) { return a.least < b.least ? -1 : 1; }
    if (a.count != b.count) { return a.count < b.count ? -1 : 1; }
    if (a.after != b.after) { return a.after < b.after ? -1 : 1; }
    for (std::size_t k = 2; k < a.count; ++k) {
      const std::uint32_t u = builder.corners(a.face)[(a.start + k) % a.count], w = builder.corners(b.face)[(b.start + k) % b.count];
      if (u != w) { return u < w ? -1 : 1; }
    }
    return 0;
  };
  std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    const int order = compare(a, b);
    return order != 0 ? order < 0 : a.face < b.face;
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 0, first = 0; i < keys.size(); ++i) {
    if (i > 0 && compare(keys[first], keys[i]) == 0) {
      pairs.emplace_back(keys[first].face, keys[i].face);
    } else {
      first = i;
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return pairs;
}

// " v1 v2 v3": at most a dozen names.
[[nodiscard]] inline std::string name_list(const std::vector<Element>& elements, std::size_t begin = 0,
                                           std::size_t end = static_cast<std::size_t>(-1)) {
  constexpr std::size_t most = 12;
  std::string text;
  end = std::min(end, elements.size());
  for (std::size_t i = begin; i < end && i < begin + most; ++i) { text += ' ' + to_string(elements[i]); }
  return end - begin > most ? text + " ..." : text;
}

class Diagnosis {
 public:
  // `builder` holds corners only; the defects of its inserted edges are taken over.
  Diagnosis(const Builder& builder, const Assembly* assembly)
      : builder_(builder), excused_(builder.vertex_count(), false), skip_(unusable(builder)) {
    report_vertices();
    report_corners();
    if (assembly == nullptr) { return; }
    std::erase_if(found_, [&](const Defect& d) {  // the corner invalid_index of a broken face only marks it
      return !d.elements.empty() && d.elements[0].letter == 'f' && assembly->broken[d.elements[0].index];
    });
    found_.insert(found_.end(), assembly->defects.begin(), assembly->defects.end());
    for (const Defect& d : assembly->defects) {
      for (const Element& e : d.elements) {
        if (e.letter == 'v' && e.index < excused_.size()) { excused_[e.index] = true; }
      }
    }
  }

  [[nodiscard]] std::vector<Defect> run() {
    for (const auto& [first, again] : duplicate_faces(builder_, skip_)) {
      skip_[again] = true;
      add(DefectKind::duplicate_face, {FaceId{first}, FaceId{again}},
          to_string(FaceId{again}) + " is " + to_string(FaceId{first}) + " entered again: the same corners in the same order");
    }
    const EdgeUses uses(builder_, skip_);
    const FlipPlan orientation(builder_, uses, skip_);
    report_edges(uses, orientation);
    report_flips(uses, orientation);
    const std::vector<Border> chains = borders(uses, orientation, excused_);
    for (const Border& border : chains) { report_border(border, uses); }
    report_fans(uses, chains);
    std::vector<bool> used(builder_.vertex_count(), false);
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      for (std::uint32_t v : builder_.corners(f)) {
        if (v < used.size()) { used[v] = true; }
      }
    }
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!used[v] && !excused_[v]) {
        add(DefectKind::unused_vertex, {VertexId{v}}, to_string(VertexId{v}) + " is not a corner of any face");
      }
    }
    return std::move(found_);
  }

 private:
  void add(DefectKind kind, std::vector<Element> elements, std::string sentence) {
    found_.push_back({kind, std::move(elements), std::move(sentence)});
  }

  void report_vertices() {
    for (std::uint32_t v = 0; v < builder_.vertex_count(); ++v) {
      if (is_finite(builder_.position(v))) { continue; }
      add(DefectKind::bad_position, {VertexId{v}}, to_string(VertexId{v}) + " has a coordinate that is not a finite number");
    }
  }

  // Reports the faces that cannot be used, and excuses their corners: what is missing around such a face is its consequence.
  void report_corners() {
    const std::uint32_t n = builder_.vertex_count();
    std::vector<std::uint32_t> seen(n, invalid_index);
    for (std::uint32_t i = 0; i < builder_.face_count(); ++i) {
      if (!skip_[i]) { continue; }
      const FaceId f{i};
      const auto corners = builder_.corners(i);
      if (corners.size() < 3) {
        add(DefectKind::few_corners, {f},
            to_string(f) + " has " + std::to_string(corners.size()) + (corners.size() == 1 ? " corner" : " corners") +
                ", a face needs three");
      }
      for (std::uint32_t v : corners) {
        const std::string name = to_string(VertexId{v});
        if (v >= n) {
          add(DefectKind::bad_index, {f, VertexId{v}},
              to_string(f) + " has the corner " + name + ", but there are only " + std::to_string(n) + " vertices");
          continue;
        }
        if (seen[v] == i) { add(DefectKind::repeated_corner, {f, VertexId{v}}, to_string(f) + " visits " + name + " twice"); }
        seen[v] = i;
        excused_[v] = true;
      }
    }
  }

  void report_edges(const EdgeUses& uses, const FlipPlan& orientation) {
    for (std::uint32_t e = 0; e < uses.edge_count(); ++e) {
      const auto all = uses.of(e);
      const std::uint32_t u = all[0].from(), w = all[0].to(), f = uses.face(all[0].corner);
      const auto ends = [&] { return to_string(VertexId{u}) + " to " + to_string(VertexId{w}); };
      if (all.size() == 2 && all[0].forward == all[1].forward && orientation.one_sided[orientation.part[f]]) {
        const FaceId g{uses.face(all[1].corner)};
        add(DefectKind::doubled_edge, {VertexId{u}, VertexId{w}, FaceId{f}, g},
            "the edge from " + ends() + " is used in this direction by two faces, " + to_string(FaceId{f}) + " and " + to_string(g) +
                ", and flipping cannot help: their surface has one side only, as a Moebius strip");
      } else if (all.size() > 2) {
        std::vector<Element> elements{VertexId{all[0].lo}, VertexId{all[0].hi}};
        for (const EdgeUses::Use& use : all) { elements.push_back(FaceId{uses.face(use.corner)}); }
        std::string sentence = "the edge between " + to_string(elements[0]) + " and " + to_string(elements[1]) + " has " +
                               std::to_string(all.size()) + " faces:" + name_list(elements, 2) + "; an edge of a surface has two";
        add(DefectKind::nonmanifold_edge, std::move(elements), std::move(sentence));
      }
    }
  }

  // One defect for each group of flipped faces that hang together.
  void report_flips(const EdgeUses& uses, const FlipPlan& orientation) {
    UnionFind groups(builder_.face_count());
    std::vector<std::uint32_t> sizes(orientation.one_sided.size(), 0);
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      if (orientation.part[f] != invalid_index) { ++sizes[orientation.part[f]]; }
    }
    for (std::uint32_t e = 0; e < uses.edge_count(); ++e) {
      const auto all = uses.of(e);
      if (all.size() != 2) { continue; }
      const std::uint32_t f = uses.face(all[0].corner), g = uses.face(all[1].corner);
      if (orientation.flip[f] && orientation.flip[g]) { groups.unite(f, g); }
    }
    std::vector<std::vector<Element>> members(builder_.face_count());
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      if (orientation.flip[f]) { members[groups.find(f)].push_back(FaceId{f}); }
    }
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      if (members[f].empty()) { continue; }
      const std::size_t others = sizes[orientation.part[f]] - members[f].size();
      std::string sentence = members[f].size() == 1
                                 ? to_string(FaceId{f}) + " is flipped: it runs along its edges the same way as the neighbouring faces"
                                 : std::to_string(members[f].size()) + " faces are flipped against the " + std::to_string(others) +
                                       " others of their component:" + name_list(members[f]);
      add(DefectKind::flipped_face, std::move(members[f]), std::move(sentence));
    }
  }

  void report_border(const Border& border, const EdgeUses& uses) {
    const std::size_t count = border.edges.size();
    std::vector<Element> elements;
    for (const Border::Edge& e : border.edges) { elements.push_back(VertexId{e.from}); }
    if (!border.closed) { elements.push_back(VertexId{border.edges.back().to}); }
    const std::size_t corners = elements.size();
    for (const Border::Edge& e : border.edges) { elements.push_back(FaceId{uses.face(e.corner)}); }
    std::string sentence = "open border of " + std::to_string(count) + (count == 1 ? " edge" : " edges") + " along" +
                           name_list(elements, 0, corners) + ": nothing lies on the other side of" + name_list(elements, corners) +
                           "; a face is missing";
    add(DefectKind::open_border, std::move(elements), std::move(sentence));
  }

  void report_fans(const EdgeUses& uses, const std::vector<Border>& chains) {
    UnionFind fans = uses.fans();
    join_across(fans, chains, uses);
    std::vector<std::vector<Element>> faces(builder_.vertex_count());  // one of each fan
    for (std::uint32_t f = 0; f < builder_.face_count(); ++f) {
      if (skip_[f]) { continue; }
      std::uint32_t corner = builder_.first_corner(f);
      for (std::uint32_t v : builder_.corners(f)) {
        if (fans.find(corner) == corner && !excused_[v]) { faces[v].push_back(FaceId{f}); }
        ++corner;
      }
    }
    for (std::uint32_t v = 0; v < faces.size(); ++v) {
      if (faces[v].size() < 2) { continue; }
      std::vector<Element> elements{VertexId{v}};
      elements.insert(elements.end(), faces[v].begin(), faces[v].end());
      std::string sentence = to_string(VertexId{v}) + " has " + std::to_string(faces[v].size()) +
                             " fans of faces, a vertex has one; a face of each:" + name_list(elements, 1) +
                             "; make one vertex for each fan";
      add(DefectKind::several_fans, std::move(elements), std::move(sentence));
    }
  }

  const Builder& builder_;
  std::vector<bool> excused_;  // vertices where something was reported whose consequences are not
  std::vector<Defect> found_;
  std::vector<bool> skip_;  // faces that were reported by themselves
};

}  // namespace brep::detail

namespace brep {

// All defects of the builder; none exactly when close() gives a BRep.
[[nodiscard]] inline std::vector<Defect> diagnose(const Builder& builder) {
  if (builder.edges().empty()) { return detail::Diagnosis(builder, nullptr).run(); }
  const detail::Assembly assembly = detail::Assembler(builder).run();
  return detail::Diagnosis(assembly.builder, &assembly).run();
}

}  // namespace brep
