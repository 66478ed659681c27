// SPDX-License-Identifier: MIT
#pragma once

// Data passed from one step of the intake to the next: positions, faces with the input polygons they come from, and the changes.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/handles.hpp>

#include <radiosity/intake/change.hpp>
#include <radiosity/intake/polygons.hpp>

namespace radiosity::intake {

inline constexpr std::uint32_t none = brep::invalid_index;

// An input polygon that a face represents.
struct Source {
  std::uint32_t polygon = 0;
  bool turned = false;  // opposite orientation to the input
  bool back = false;    // given for the other side of the face
};

struct Face {
  std::vector<std::uint32_t> corners;  // indices into Working::positions
  std::uint32_t material = 0, group = 0;
  std::uint32_t polygon = 0;      // of the input
  bool turned = false;            // opposite orientation to the input
  bool mixed = false;             // part of a surface for which it is unknown which side was meant to be seen
  std::vector<Source> more = {};  // further polygons besides `polygon`: duplicates and merged ones
  std::uint32_t shell = group;    // faces of one shell may be neighbours: a group, or groups that together close a shell (join.hpp)
  std::uint32_t back = none;      // material of its other side, from polygons given for that (backs.hpp)
  std::uint32_t piece = none;     // faces of one piece are connected across edges with no other face (orient)

  void stand_for(const Face& other) {
    more.push_back({other.polygon, other.turned});
    more.insert(more.end(), other.more.begin(), other.more.end());
  }
  // Reverses the orientation.
  void turn() {
    std::reverse(corners.begin(), corners.end());
    turned = !turned;
    for (Source& source : more) { source.turned = !source.turned; }
    if (back != none) { std::swap(material, back); }
  }
};

// The corners rotated so that the least comes first, in unchanged order.
inline std::vector<std::uint32_t> canonical(std::vector<std::uint32_t> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

struct Working {
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  double tolerance = 0.0;  // a length; points closer than this are the same place
  std::array<Change, static_cast<std::size_t>(ChangeKind::merged) + 1> changes{};

  void changed(ChangeKind kind, std::uint32_t polygon, double size = 0.0, std::size_t count = 1) {
    Change& change = changes[static_cast<std::size_t>(kind)];
    change.kind = kind;
    const bool worse = change.count == 0 || size > change.size || (size == change.size && polygon < change.worst);
    change.worst = worse ? polygon : change.worst;
    change.first = change.count == 0 ? polygon : std::min(change.first, polygon);
    change.count += count;
    change.size = std::max(change.size, size);
  }
  // The positions of a face's corners. Valid until the next call.
  [[nodiscard]] std::span<const glm::dvec3> outline(const std::vector<std::uint32_t>& corners) {
    outline_.clear();
    for (const std::uint32_t v : corners) { outline_.push_back(positions[v]); }
    return outline_;
  }
  [[nodiscard]] std::span<const glm::dvec3> outline(const Face& face) { return outline(face.corners); }

 private:
  std::vector<glm::dvec3> outline_;
};

}  // namespace radiosity::intake
