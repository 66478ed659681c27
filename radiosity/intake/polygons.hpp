// SPDX-License-Identifier: MIT
#pragma once

// The polygons that the intake is given, what it may be told about them, and where each of them went.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>

namespace radiosity {

// The input, which the caller keeps: polygon p has the corners first_corner[p] to first_corner[p + 1] - 1, each an index into positions,
// counter-clockwise seen from the front.
struct PolygonView {
  std::span<const glm::dvec3> positions;
  std::span<const std::uint32_t> corners;
  std::span<const std::uint32_t> first_corner;   // one more than there are polygons
  std::span<const std::uint32_t> material;       // of each polygon: an index into the scene's materials
  std::span<const std::uint32_t> group = {};     // of each polygon: an index into names; empty: all are in one
  std::span<const std::string> names = {};       // of the groups
  std::span<const std::uint8_t> two_sided = {};  // of each material: do its surfaces reflect on both sides? Empty: none does

  [[nodiscard]] std::size_t count() const { return first_corner.empty() ? 0 : first_corner.size() - 1; }
};

inline constexpr double largest_weld = 0.01;

struct IntakeOptions {
  // Vertices closer than this are one, and a vertex so close to an edge lies on it; relative to the diagonal of the bounds of what
  // does not shine. In [0, largest_weld].
  double weld = 1e-6;
  bool merge = true;       // coplanar neighbours of one material
  bool two_sided = false;  // all surfaces that enclose nothing
  // The file does not tell which side of an open surface is seen: they have two, but for lamps and the walls of a room.
  bool open_sides_unknown = false;
  // Neither the file nor the light tells which side of any surface is seen: as above, and a bare room may have been wound outwards.
  bool sides_unknown = false;
  // Points that must be seen, such as the eyes of cameras: a closed shell around one of them, or around a lamp, is a room.
  std::vector<glm::dvec3> eyes = {};
  // Lamps that are not among the polygons, such as spheres: six points on each. A closed shell around all of them is a room.
  std::vector<std::array<glm::dvec3, 6>> lamps = {};
};

// Where a polygon of the input went: it lies on this sheet of an object, alone, together with others, or with a part of it.
struct PolygonPart {
  std::uint32_t object = 0, sheet = 0;
  bool back = false;  // the sheet shows the side from which the polygon's corners run clockwise
};

// Of every polygon its parts. One that was left out has none; one with two sides has them on either.
struct PolygonParts {
  std::vector<std::uint32_t> first{0};  // of polygon p: first[p] to first[p + 1] - 1
  std::vector<PolygonPart> all;

  [[nodiscard]] std::span<const PolygonPart> of(std::size_t polygon) const {
    return std::span(all).subspan(first[polygon], first[polygon + 1] - first[polygon]);
  }
};

// A closed shell that is seen from inside, whatever became of it: an object, a cavity of one, or surfaces of several groups.
struct Room {
  raycast::Box bounds;
  bool within_walls = false;  // a closed shell that is seen from outside surrounds it
};

}  // namespace radiosity
