// SPDX-License-Identifier: MIT
#pragma once

// Closes the slits in the faces of a solid that is to be exported.
//
// Where a wall has no thickness along an edge - a round hole that touches the front of its block from inside - four faces meet there. The
// operations take the two of each solid wedge as neighbours, so the front is cut along the edge: its boundary runs there and back, and each
// side goes on in the hole. Programs that read polygons fail on such a slit. Here the parts of the front are neighbours instead, and so
// are those of the hole. The surface is the same set of points, still a closed 2-manifold; the slit is gone.

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include <brep/csg/assemble.hpp>
#include <brep/csg/solid.hpp>
#include <brep/csg/work.hpp>

namespace brep::csg {

// The same solid, whose faces(), which are exported, have no slits; boundary(), with which operations go on, stays.     Time: O(v log v).
template <class F>
[[nodiscard]] Solid<F> close_slits(const Solid<F>& solid) {
  if (!solid.boundary().touching) { return solid; }
  detail::Work work(solid.grid().planes());
  work.add(solid.boundary(), false, false, 0);
  // Half-edges in one plane, looking the same way, by the points between which they run.
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> seen;
  for (std::uint32_t h = 0; h < work.halves.size(); ++h) {
    const auto plane = work.faces[work.halves[h].face].plane.code;
    const std::uint32_t from = work.halves[h].point, to = work.target(h);
    seen.emplace(std::tuple(from, to, plane), h);
    const auto found = seen.find(std::tuple(to, from, plane));
    if (found == seen.end() || work.halves[h].twin == found->second) { continue; }
    const std::uint32_t g = found->second, across_h = work.halves[h].twin, across_g = work.halves[g].twin;
    work.halves[h].twin = g;
    work.halves[g].twin = h;
    work.halves[across_h].twin = across_g;
    work.halves[across_g].twin = across_h;
  }
  detail::Assemble assemble(work, std::vector<std::uint8_t>(work.faces.size(), 1));
  const auto same = [&](std::uint32_t i, std::uint32_t j) { return solid.attributes()[i] == solid.attributes()[j]; };
  for (std::uint32_t h = 0; h < work.halves.size(); ++h) { assemble.merge(h, same); }
  assemble.straighten_umbrellas();
  return Solid<F>(solid.grid(), solid.boundary(), assemble.run(), solid.attributes());
}

}  // namespace brep::csg
