// SPDX-License-Identifier: MIT
#pragma once

// What moves the vertices of a glTF primitive before they are placed: first morph targets, then a skin, whose joints are nodes. Both as
// they stand in the file; animations do not count.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "apps/intake/gltf_data.hpp"
#include "apps/intake/json_reader.hpp"
#include "apps/intake/model.hpp"

namespace apps::intake {

// Adds the displacements of the morph targets to the positions, three numbers per vertex, each times its weight: that of the node, or else
// that of the mesh, or else 0 (glTF 2.0, 3.7.2.2). Targets that cannot be read are left out, with a note.
void gltf_morph(const JsonValue& node, const JsonValue& mesh, const JsonValue& primitive, GltfData& data, std::vector<double>& positions,
                Notes& notes, const std::string& place);

// From the coordinates of a skinned primitive to those of the scene, by vertex, in the pose that the joints have in the file (glTF 2.0,
// 3.7.3): the weighted mean of (matrix of the joint) (inverse bind matrix). The matrix of the node with the mesh does not count. A vertex
// without a weight goes with its first joint, with a note.
// `in_scene`: the matrices of all nodes. Nothing if the primitive has no joints and weights, or after an error, with a sentence in `fault`.
[[nodiscard]] std::optional<std::vector<glm::dmat4>> gltf_skin(const JsonValue& skin, GltfData& data, const JsonValue& primitive,
                                                               std::span<const glm::dmat4> in_scene, std::size_t vertices,
                                                               std::string& fault, Notes& notes, const std::string& place);

}  // namespace apps::intake
