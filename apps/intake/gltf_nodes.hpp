// SPDX-License-Identifier: MIT
#pragma once

// Where the nodes of a glTF file put things: their matrices.

#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "apps/intake/json_reader.hpp"

namespace apps::intake {

[[nodiscard]] glm::dmat4 gltf_matrix(std::span<const double, 16> columns);
[[nodiscard]] glm::dmat4 gltf_placed(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale);
// From the coordinates of a node to those of its parent.
[[nodiscard]] glm::dmat4 gltf_matrix(const JsonValue& node);
// From the coordinates of each node to those of the scene. For nodes that are their own ancestors: the identity.
[[nodiscard]] std::vector<glm::dmat4> gltf_scene_matrices(const JsonValue& nodes);

}  // namespace apps::intake
