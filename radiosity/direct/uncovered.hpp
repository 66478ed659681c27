// SPDX-License-Identifier: MIT
#pragma once

// Of two surfaces that coincide and face the same way, the later one is seen (raycast::Scene::covered). So a lamp may be partly or wholly
// covered: by a picture that hangs in its plane, by a ceiling defined later, by another lamp. The covered part gives no light.

#include <cstdint>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// Removes from the facets of an object's plane sheets what faces of later objects cover: a partly covered facet is replaced by convex
// pieces, a wholly covered one is dropped, others stay unchanged. `surfaces`: those of all objects, in order. Cost: the number of later
// objects whose bounds meet those of the facets, and their faces.
void cut_out_covered(Facets& facets, std::uint32_t object, const raycast::Scene& objects, const std::vector<Surface>& surfaces);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/uncovered.cpp>
#endif
