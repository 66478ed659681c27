// SPDX-License-Identifier: MIT
#pragma once

// The light of an exported mesh as a texture: one atlas with a rectangle for each input face or for each polygon of the user
// (radiosity/bake/lightmap.hpp), and texture coordinates at the corners of the mesh.

#include <optional>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/camera/tone.hpp>
#include <radiosity/result/outcome.hpp>

#include "apps/export/export_mesh.hpp"
#include "apps/scene_file.hpp"

namespace apps {

struct LightTexture {
  radiosity::Picture picture;
  double texel = 0.0;  // metres
};

// `mesh` is solution_mesh(). A rectangle holds an input face; what is curved is projected onto the plane of the mean normal of its leaves,
// so a face must not turn by a right angle from there. `texel`: the wanted size, in metres; without, such that there are about a million.
// Nothing when no face has an area.
[[nodiscard]] std::optional<LightTexture> solution_texture(const radiosity::Solution& solution, const radiosity::Tone& tone,
                                                           std::optional<double> texel, ExportMesh& mesh);

// `mesh` is given_mesh(). A rectangle holds a polygon of the file, as seen from its front or else from its back. Polygons without light
// have none.
[[nodiscard]] std::optional<LightTexture> given_texture(const SceneFile& file, const radiosity::Solution& solution,
                                                        const radiosity::Tone& tone, std::optional<double> texel, ExportMesh& mesh);

}  // namespace apps
