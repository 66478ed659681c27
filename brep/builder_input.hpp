// SPDX-License-Identifier: MIT
#pragma once

// What goes into close() and what comes out when it cannot be done: the polygons collected by a Builder, and the defects.
// builder.hpp tells the whole story; an object that only emits its approximation needs no more than this file.

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
};

enum class DefectKind : std::uint8_t {
  bad_index,        // a corner names a vertex that does not exist
  bad_position,     // a coordinate is not finite
  few_corners,      // fewer than three corners
  repeated_corner,  // a face visits a vertex twice
  doubled_edge,     // two faces run along an edge in the same direction
  flipped_face,     // all edges of a face run the same way as in its neighbours
  open_border,      // edges with a face on one side only: one defect for each chain of them
  several_fans,     // the faces around a vertex form more than one fan
  unused_vertex     // no face has the vertex as a corner
};

struct Defect {
  DefectKind kind;
  std::vector<Element> elements;  // in the order in which the sentence names them
  std::string sentence;
};

}  // namespace brep
