// SPDX-License-Identifier: MIT
#pragma once

// Input and options of the intake, and the record of where each polygon went.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>

namespace radiosity {

// The input; the caller keeps the arrays. Polygon p has the corners first_corner[p] to first_corner[p + 1] - 1, each an index into
// positions, counter-clockwise seen from the front.
struct PolygonView {
  std::span<const glm::dvec3> positions;
  std::span<const std::uint32_t> corners;
  std::span<const std::uint32_t> first_corner;   // one entry more than there are polygons
  std::span<const std::uint32_t> material;       // by polygon: an index into the scene's materials
  std::span<const std::uint32_t> group = {};     // by polygon: an index into names; empty: all are in one group
  std::span<const std::string> names = {};       // of the groups
  std::span<const std::uint8_t> two_sided = {};  // by material: do its surfaces reflect on both sides? Empty: no

  [[nodiscard]] std::size_t count() const { return first_corner.empty() ? 0 : first_corner.size() - 1; }
};

inline constexpr double largest_weld = 0.01;

struct IntakeOptions {
  // Vertices closer than this are merged, and a vertex as close as this to an edge lies on it; relative to the diagonal of the bounds of
  // all polygons that do not emit. In [0, largest_weld].
  double weld = 1e-6;
  bool merge = true;       // merge coplanar neighbours of one material
  bool two_sided = false;  // make all surfaces that enclose nothing reflect on both sides
  // The file does not say which side of an open surface is seen: they get two sides, except lamps and the walls of a room.
  bool open_sides_unknown = false;
  // Neither the file nor the light says which side of any surface is seen: as above, and an empty room may have been wound outwards.
  bool sides_unknown = false;
  // Points that must be seen, such as the eyes of cameras: a closed shell around one of them, or around a lamp, is a room.
  std::vector<glm::dvec3> eyes = {};
  // Polygons whose backs are seen, such as those of a roof that was given from outside alone: open surfaces that have one get two sides,
  // except lamps.
  std::vector<std::uint32_t> seen_from_behind = {};
  // Lamps that are not among the polygons, such as spheres, each as six points. A closed shell around all six points is a room.
  std::vector<std::array<glm::dvec3, 6>> lamps = {};
};

// A sheet of an object that contains an input polygon or a part of it, possibly together with others.
struct PolygonPart {
  std::uint32_t object = 0, sheet = 0;
  bool back = false;  // does the sheet show the side from which the polygon's corners run clockwise?
};

// The parts of every polygon. A polygon that was left out has none; a two-sided polygon has parts on both sides.
struct PolygonParts {
  std::vector<std::uint32_t> first{0};  // of polygon p: first[p] to first[p + 1] - 1
  std::vector<PolygonPart> all;

  [[nodiscard]] std::span<const PolygonPart> of(std::size_t polygon) const {
    return std::span(all).subspan(first[polygon], first[polygon + 1] - first[polygon]);
  }
};

// A closed shell that is seen from inside, whether it became an object, a cavity of one, or surfaces of several groups.
struct Room {
  raycast::Box bounds;
  bool within_walls = false;  // does a closed shell that is seen from outside surround it?
};

}  // namespace radiosity
