// SPDX-License-Identifier: MIT
#pragma once

// The statements of a scene as a graph (apps/scene_graph.hpp): under the root lie those of the file, under a use those of its group. Each
// node keeps its placement and its name to what lies below it.

#include <functional>
#include <string>
#include <vector>

#include <raycast/transform.hpp>

#include "apps/input_errors.hpp"
#include "apps/scene_file/groups.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// Is told of an object as often as it is used: with the names of the uses around it, "first.", their placement, and the place of the
// statement of the file.
using PlaceObject = std::function<void(const ObjectSyntax& object, const std::string& prefix, const raycast::Placement& outer, Place at)>;

// Walks all uses in the order of the file; ends at the first error, or when the scene grows beyond max_objects.
void place_all(const std::vector<Item>& items, const Groups& groups, Errors& errors, const PlaceObject& place);

}  // namespace apps::scene_file
