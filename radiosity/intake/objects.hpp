// SPDX-License-Identifier: MIT
#pragma once

// From faces to objects. A closed shell becomes a solid. A shell that contains a lamp or an eye is seen from inside: it becomes a cavity
// of the solid around it, if there is one (walls with a thickness); a room, if everything else lies in it; otherwise a surface, because
// the space beyond the walls of a room counts as solid and other objects may be there. A shell closed by several groups (join.hpp)
// becomes surfaces, too, because an object belongs to one group. Open components become one surface per group; if such a surface has two
// sides, its back is a separate surface at the same place.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity::intake {

// A sheet of an object, and the face from which it was made.
struct SheetOrigin {
  PolygonPart part;  // `back`: does it show the back of the face?
  std::uint32_t face = 0;
};

struct MadeObjects {
  std::vector<SceneObject> objects;
  std::vector<SheetOrigin> sheets;
  std::vector<Room> rooms;
};

[[nodiscard]] MadeObjects make_objects(Working& mesh, const Topology& topology, const PolygonView& input,
                                       std::span<const Material> materials, const IntakeOptions& options);

// The parts of each of the `polygons` input polygons, in the order of objects and sheets.
[[nodiscard]] PolygonParts parts_of(const Working& mesh, std::span<const SheetOrigin> sheets, std::size_t polygons);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/objects.cpp>
#endif
