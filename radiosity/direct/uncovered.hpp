// SPDX-License-Identifier: MIT
#pragma once

// Of surfaces that coincide and face the same way the later one is seen (raycast::Scene::covered). So a lamp may be partly or wholly
// covered: by a picture that hangs in its plane, by a ceiling that comes later, by another lamp. What is covered gives no light.

#include <cstdint>
#include <vector>

#include <raycast/scene.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

// Cuts out of facets of an object's plane sheets what faces of later objects cover: a facet is replaced by convex pieces of it, one that is
// covered as a whole is dropped. Facets of which nothing is covered stay as they are. `surfaces`: those of all objects, in order.
// Time: later objects whose bounds meet those of the facets, and the faces of these.
void cut_out_covered(Facets& facets, std::uint32_t object, const raycast::Scene& objects, const std::vector<Surface>& surfaces);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/uncovered.cpp>
#endif
