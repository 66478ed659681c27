// SPDX-License-Identifier: MIT
#pragma once

// From faces to objects. A closed shell becomes a solid. A shell that holds a lamp or an eye is seen from inside. It becomes a cavity of
// the solid around it, where there is one (walls with a thickness); a room, where everything else lies in it; or else a surface, because a
// room counts as solid beyond its walls, where other things may stand. A shell that several groups close together (join.hpp) becomes a
// surface, too, because an object belongs to one group. What is open becomes one surface for each group; where it has two sides, its back
// is a surface of its own at the same place.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity::intake {

// A sheet of an object and the face that became it.
struct SheetOrigin {
  PolygonPart part;  // `back`: of the face
  std::uint32_t face = 0;
};

struct MadeObjects {
  std::vector<SceneObject> objects;
  std::vector<SheetOrigin> sheets;
  std::vector<Room> rooms;
};

[[nodiscard]] MadeObjects make_objects(Working& mesh, const Topology& topology, const PolygonView& input,
                                       std::span<const Material> materials, const IntakeOptions& options);

// Of each of `polygons` polygons of the input, in the order of objects and sheets.
[[nodiscard]] PolygonParts parts_of(const Working& mesh, std::span<const SheetOrigin> sheets, std::size_t polygons);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/objects.cpp>
#endif
