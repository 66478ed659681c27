// SPDX-License-Identifier: MIT
#pragma once

// What goes into close() and what comes out when it cannot be done: the faces and edges collected by a Builder, and the defects.
// builder.hpp tells the whole story; an object that only emits its approximation needs no more than this file.
//
// A face is given by its corners, or it is made empty and gets its loop from the edges that name it, as in the winged-edge
// structure of the paper (2.2): an edge knows its two vertices and the faces on its left and right. Both ways mix, in any order.

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
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
  flipped_face,      // a face or a patch of faces runs against the rest of its component
  open_border,       // edges with a face on one side only: one defect for each chain of them
  several_fans,      // the faces around a vertex form more than one fan
  unused_vertex      // no face has the vertex as a corner
};

struct Defect {
  DefectKind kind;
  std::vector<Element> elements;  // in the order in which the sentence names them
  std::string sentence;
};

}  // namespace brep
