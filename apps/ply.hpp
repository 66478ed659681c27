// SPDX-License-Identifier: MIT
#pragma once

// The solution as a binary little-endian PLY file (Turk 1994) that mesh viewers show as it is.
//
//   vertex  float x y z, float nx ny nz: of the true surface, uchar red green blue: half-edge colours under the exposure, sRGB.
//           A vertex is doubled only where the faces around it differ in normal, as at a crease, or in these bytes.
//   face    list uchar int vertex_indices (3 or 4, counter-clockwise from the bright side),
//           float radiosity_r radiosity_g radiosity_b: of the leaf, W/m2, linear and without exposure,
//           int surface: number of the input surface; comment lines give the names: "comment surface 0 floor".

#include <string>
#include <vector>

#include <radiosity/camera/tone.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/export/export_mesh.hpp"

namespace apps {

// The user's own polygons and vertices (export/export_mesh.hpp), in their order, so that colours can be taken over by number:
//
//   vertex  x y z: float where that is exact, else double; float nx ny nz, uchar red green blue as above,
//           float radiosity_r radiosity_g radiosity_b: the mean of the faces around, W/m2.
//   face    list vertex_indices.
[[nodiscard]] std::string to_ply(const ExportMesh& mesh, const radiosity::Tone& tone);

[[nodiscard]] std::string to_ply(const radiosity::Mesh& mesh, const std::vector<radiosity::InputSurface>& surfaces,
                                 const radiosity::Tone& tone);

}  // namespace apps
