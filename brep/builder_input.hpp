// SPDX-License-Identifier: MIT
#pragma once

// What goes into close() and what comes out when it cannot be done: the faces and edges collected by a Builder, and the defects.
// builder.hpp tells the whole story; an object that only emits its approximation needs no more than this file.
//
// A face is given by its corners, or it is made empty and gets its loop from the edges that name it, as in the winged-edge
// structure of the paper (2.2): an edge knows its two vertices and the faces on its left and right. Both ways mix, in any order.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/handles.hpp>

namespace brep {

// The face belongs to no surface of the object: the back of a polygon, a closed hole.
inline constexpr std::uint32_t no_sheet = 0xffffffff;

class Builder {
 public:
  // Makes room at once, where the numbers are known.
  void reserve(std::size_t vertices, std::size_t faces, std::size_t corners) {
    positions_.reserve(vertices);
    corners_.reserve(corners);
    first_corner_.reserve(faces + 1);
    sheets_.reserve(faces);
  }
  // The number of the new vertex: 0, 1, 2 ...
  std::uint32_t vertex(const glm::dvec3& position) {
    positions_.push_back(position);
    return static_cast<std::uint32_t>(positions_.size() - 1);
  }
  // The number of the new face: 0, 1, 2 ... The corners are numbers of vertices, which may be made later.
  std::uint32_t face(std::span<const std::uint32_t> corners, std::uint32_t sheet) {
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
    sheets_.push_back(sheet);
    return static_cast<std::uint32_t>(sheets_.size() - 1);
  }
  std::uint32_t face(std::initializer_list<std::uint32_t> corners, std::uint32_t sheet) {
    return face(std::span<const std::uint32_t>(corners.begin(), corners.size()), sheet);
  }

  // A face without corners: its loop is made of the edges that name it.
  std::uint32_t face(std::uint32_t sheet) { return face(std::span<const std::uint32_t>(), sheet); }

  // The faces on the two sides of an edge that runs from `from` to `to`; invalid_index: not known yet.
  struct Edge {
    std::uint32_t from, to, left, right;
  };
  // Inserts an edge; vertices and faces may be made later. With neither face it only says that the edge must exist: close()
  // reports it unless some face runs along it.
  void edge(std::uint32_t from, std::uint32_t to, std::uint32_t left = invalid_index, std::uint32_t right = invalid_index) {
    edges_.push_back({from, to, left, right});
  }

  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  [[nodiscard]] std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions_.size()); }
  [[nodiscard]] std::uint32_t face_count() const { return static_cast<std::uint32_t>(sheets_.size()); }
  [[nodiscard]] std::uint32_t corner_count() const { return static_cast<std::uint32_t>(corners_.size()); }
  [[nodiscard]] const glm::dvec3& position(std::uint32_t vertex) const { return positions_[vertex]; }
  [[nodiscard]] std::span<const std::uint32_t> corners(std::uint32_t face) const {
    return std::span(corners_).subspan(first_corner_[face], first_corner_[face + 1] - first_corner_[face]);
  }
  [[nodiscard]] std::uint32_t first_corner(std::uint32_t face) const { return first_corner_[face]; }
  [[nodiscard]] std::uint32_t sheet(std::uint32_t face) const { return sheets_[face]; }

 private:
  std::vector<glm::dvec3> positions_;
  std::vector<std::uint32_t> corners_;  // of all faces, one after the other
  std::vector<std::uint32_t> first_corner_{0};
  std::vector<std::uint32_t> sheets_;
  std::vector<Edge> edges_;
};

enum class DefectKind : std::uint8_t {
  bad_index,         // a corner or an edge names a vertex or a face that does not exist
  bad_position,      // a coordinate is not finite
  few_corners,       // fewer than three corners
  repeated_corner,   // a face visits a vertex twice
  broken_loop,       // the edges that name a face do not form one closed loop
  unused_edge,       // an inserted edge, and no face runs along it
  duplicate_face,    // a face was entered twice: the same corners in the same order
  nonmanifold_edge,  // more than two faces meet at an edge
  doubled_edge,      // two faces run along an edge in the same direction, and no flip can help: the surface is one-sided
  flipped_face,      // a face or a group of faces runs against the rest of its component
  open_border,       // edges with a face on one side only: one defect for each chain of them
  several_fans,      // the faces around a vertex form more than one fan
  unused_vertex      // no face has the vertex as a corner
};

struct Defect {
  DefectKind kind;
  std::vector<Element> elements;  // in the order in which the sentence names them
  std::string sentence;
};

namespace detail {

// From edges to faces: a builder with the corners of the faces that another one knows only by their edges.
//
// A half-edge from u to w that names a face f says: on the loop of f, w follows u. The loop of f is whole when every vertex on it
// is entered once and left once, and one walk meets them all. A face that was given by its corners may be named by edges,
// too; then they must be edges of its loop. Vertices and faces keep their numbers.
struct Assembly {
  Builder builder;              // corners only; a broken face has the corner invalid_index besides those of its edges
  std::vector<Defect> defects;  // with inserted edges
  std::vector<bool> broken;     // faces
};

class Assembler {
 public:
  explicit Assembler(const Builder& input) : input_(input) { result_.broken.assign(input.face_count(), false); }

  [[nodiscard]] Assembly run() {
    for (const Builder::Edge& e : input_.edges()) {
      const bool left = add(e.from, e.to, e.left), right = add(e.to, e.from, e.right);
      if (!left && !right) { bare_.push_back({std::min(e.from, e.to), std::max(e.from, e.to)}); }
    }
    std::stable_sort(halves_.begin(), halves_.end(), [](const Half& a, const Half& b) { return a.face < b.face; });
    for (std::uint32_t v = 0; v < input_.vertex_count(); ++v) { result_.builder.vertex(input_.position(v)); }
    auto half = halves_.begin();
    for (std::uint32_t f = 0; f < input_.face_count(); ++f) {
      const auto begin = half;
      while (half != halves_.end() && half->face == f) { ++half; }
      result_.builder.face(loop(f, {begin, half}), input_.sheet(f));
    }
    report_bare();
    return std::move(result_);
  }

 private:
  struct Half {
    std::uint32_t from, to, face;
  };
  using Corners = std::vector<std::uint32_t>;

  static std::string edge_name(std::uint32_t u, std::uint32_t w) { return to_string(VertexId{u}) + " - " + to_string(VertexId{w}); }

  bool add(std::uint32_t from, std::uint32_t to, std::uint32_t face) {
    if (face == invalid_index) { return false; }
    if (face < input_.face_count()) {
      halves_.push_back({from, to, face});
    } else {
      result_.defects.push_back({DefectKind::bad_index,
                                 {FaceId{face}, VertexId{from}, VertexId{to}},
                                 "the edge " + edge_name(from, to) + " names the face " + to_string(FaceId{face}) +
                                     ", but there are only " + std::to_string(input_.face_count()) + " faces"});
    }
    return true;
  }

  Corners loop(std::uint32_t f, const std::vector<Half>& halves) {
    const auto given = input_.corners(f);
    Corners corners(given.begin(), given.end());
    if (halves.empty()) { return corners; }
    if (corners.empty()) {
      std::vector<Half> by_origin = halves;
      std::sort(by_origin.begin(), by_origin.end(), [](const Half& a, const Half& b) { return a.from < b.from; });
      std::uint32_t v = halves[0].from;
      do {
        corners.push_back(v);
        const auto next =
            std::lower_bound(by_origin.begin(), by_origin.end(), v, [](const Half& h, std::uint32_t at) { return h.from < at; });
        if (next == by_origin.end() || next->from != v) { return broken(f, corners, "; it ends at " + to_string(VertexId{v}), halves); }
        if (next + 1 != by_origin.end() && (next + 1)->from == v) {
          return broken(f, {v}, ": two of them leave " + to_string(VertexId{v}), halves);
        }
        v = next->to;
      } while (v != corners[0] && corners.size() < halves.size());
      if (v != corners[0]) { return broken(f, corners, ": they meet " + to_string(VertexId{v}) + " twice", halves); }
      if (corners.size() == halves.size()) { return corners; }
      return broken(f, corners, ": a loop closes at " + to_string(VertexId{corners[0]}) + " and does not meet them all", halves);
    }
    for (const Half& h : halves) {
      bool found = false;
      for (std::size_t k = 0; !found && k < corners.size(); ++k) {
        found = corners[k] == h.from && corners[k + 1 < corners.size() ? k + 1 : 0] == h.to;
      }
      if (!found) {
        return broken(f, {h.from, h.to}, ", as it was given by corners between which the edge " + edge_name(h.from, h.to) + " does not run",
                      halves);
      }
    }
    return corners;
  }

  Corners broken(std::uint32_t f, const Corners& at, const std::string& how, const std::vector<Half>& halves) {
    result_.broken[f] = true;
    std::vector<Element> elements{FaceId{f}};
    for (std::uint32_t v : at) { elements.push_back(VertexId{v}); }
    result_.defects.push_back(
        {DefectKind::broken_loop, std::move(elements),
         "the " + std::to_string(halves.size()) + " inserted edges of " + to_string(FaceId{f}) + " do not form one loop" + how});
    const auto given = input_.corners(f);
    Corners all(given.begin(), given.end());
    for (const Half& h : halves) { all.insert(all.end(), {h.from, h.to}); }
    all.push_back(invalid_index);
    return all;
  }

  // Inserted edges without faces, along which no face of the finished lists runs.
  void report_bare() {
    if (bare_.empty()) { return; }
    std::sort(bare_.begin(), bare_.end());
    bare_.erase(std::unique(bare_.begin(), bare_.end()), bare_.end());
    std::vector<bool> used(bare_.size(), false);
    const Builder& whole = result_.builder;
    for (std::uint32_t f = 0; f < whole.face_count(); ++f) {
      const auto corners = whole.corners(f);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const auto ends = std::minmax(corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]);
        const auto found = std::lower_bound(bare_.begin(), bare_.end(), std::pair<std::uint32_t, std::uint32_t>(ends));
        if (found != bare_.end() && found->first == ends.first && found->second == ends.second) {
          used[static_cast<std::size_t>(found - bare_.begin())] = true;
        }
      }
    }
    for (std::size_t i = 0; i < bare_.size(); ++i) {
      if (used[i]) { continue; }
      const auto [u, w] = bare_[i];
      result_.defects.push_back(
          {DefectKind::unused_edge, {VertexId{u}, VertexId{w}}, "no face runs along the inserted edge " + edge_name(u, w)});
    }
  }

  const Builder& input_;
  Assembly result_;
  std::vector<Half> halves_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> bare_;
};

}  // namespace detail

}  // namespace brep
