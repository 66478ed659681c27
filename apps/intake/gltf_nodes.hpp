// SPDX-License-Identifier: MIT
#pragma once

// Where the nodes of a glTF file put things: their matrices, and skins, whose joints are nodes.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "apps/intake/gltf_data.hpp"
#include "apps/intake/json_reader.hpp"

namespace apps::intake {

[[nodiscard]] glm::dmat4 gltf_placed(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale);
// From the coordinates of a node to those of its parent.
[[nodiscard]] glm::dmat4 gltf_matrix(const JsonValue& node);
// From the coordinates of each node to those of the scene. For nodes that are their own ancestors: the identity.
[[nodiscard]] std::vector<glm::dmat4> gltf_scene_matrices(const JsonValue& nodes);

// From the coordinates of a skinned primitive to those of the scene, by vertex, in the pose that the joints have in the file (glTF 2.0,
// 3.7.3): the weighted mean of (matrix of the joint) (inverse bind matrix). The matrix of the node with the mesh does not count.
// `in_scene`: the matrices of all nodes. Nothing if the primitive has no joints and weights, or after an error, with a sentence in `fault`.
[[nodiscard]] std::optional<std::vector<glm::dmat4>> gltf_skin(const JsonValue& skin, GltfData& data, const JsonValue& primitive,
                                                               std::span<const glm::dmat4> in_scene, std::size_t vertices,
                                                               std::string& fault);

}  // namespace apps::intake
