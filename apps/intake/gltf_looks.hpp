// SPDX-License-Identifier: MIT
#pragma once

// The appearance of the surfaces of a glTF file: materials, their pictures, vertex colours.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "apps/intake/gltf_data.hpp"
#include "apps/intake/json_reader.hpp"
#include "apps/intake/model.hpp"
#include "apps/intake/polygon_colors.hpp"

namespace apps::intake {

// The materials in the order of the file. Their pictures are added to `colors`.
[[nodiscard]] std::vector<ModelMaterial> read_gltf_materials(const JsonValue& root, GltfData& data, PolygonColors& colors, Notes& notes);

// The texture coordinates of a primitive's vertices in the picture of its material; empty if it has none.
[[nodiscard]] std::vector<glm::dvec2> gltf_texture_places(const JsonValue& root, GltfData& data, const JsonValue& primitive,
                                                          std::optional<std::size_t> material, std::size_t vertices);

// Three numbers per vertex, in linear light; empty if the primitive has none or they cannot be read.
[[nodiscard]] std::vector<double> gltf_vertex_colors(const JsonValue& root, GltfData& data, const JsonValue& primitive,
                                                     std::size_t vertices, Notes& notes, const std::string& place);

}  // namespace apps::intake
