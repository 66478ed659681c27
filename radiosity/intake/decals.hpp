// SPDX-License-Identifier: MIT
#pragma once

// Decals: flat open surfaces in the plane of a larger one, such as a rug on a floor, a picture on a wall, or a sheet of paper on a desk.
// Of two coplanar surfaces that face the same way the one of the later object is visible (raycast/scene.hpp). But the order of objects in
// a model is arbitrary, and rounding puts a decal in front of the other surface or behind it. So a decal is moved into the plane, only its
// side away from the other surface is visible, and it follows that surface in the order of objects (objects.hpp).
//
// An open surface with a face in the plane of a larger one, such as a cabinet without thickness whose bottom lies in the floor, follows it
// in the order of objects, too.

#include <cstdint>
#include <span>
#include <vector>

#include <radiosity/intake/shells.hpp>
#include <radiosity/intake/topology.hpp>
#include <radiosity/intake/working.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity::intake {

// A face of a decal, and a face of another component on which its centre lies.
struct DecalFace {
  std::uint32_t face = 0, under = 0;
  bool opposite = false;  // do they have opposite orientations?
  bool flat = true;       // is its component in one plane? Else it is no decal, but stands there
};

// Finds all such pairs. A decal is an open component in one plane that does not emit (for lamps see lamps.hpp), has less area than the
// component on which it lies, and is within four tolerances of welding from it. Moves the vertices of the decal, unless they belong to
// another surface, too, into the plane of the nearest face. Also finds faces of other open components in the planes of larger faces, and
// moves nothing of these.
[[nodiscard]] std::vector<DecalFace> lay_decals(Working& mesh, const Topology& topology, std::span<const Material> materials);

// Marks decals of which more than half lies on other faces. One with the opposite orientation is turned if its back would be visible, too.
// Otherwise it stays unchanged, because its file says that it is seen from the other side; and so does one on a surface of which both
// sides are visible, because it may be the other side of it, as a ceiling under a floor. Of components that stand on others, those of which
// a visible side faces the same way as the other face are shown before it. `backs`: by face, is its back visible if it becomes a surface?
// The roles of the shells must be known.
void mark_decals(Working& mesh, const Topology& topology, std::span<const DecalFace> decals, const std::vector<bool>& backs,
                 Shells& shells);

}  // namespace radiosity::intake

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/intake/decals.cpp>
#endif
