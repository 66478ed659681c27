// SPDX-License-Identifier: MIT
#pragma once

// The mesh from which files for other programs are written: vertices with a normal and a radiosity, polygons, groups. It is made of the
// solution, or of the polygons in the user's file, in that file's order and coordinates. A format is one file in this folder and one line
// in export_mesh.cpp.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/camera/tone.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/scene_file.hpp"

namespace apps {

struct ExportVertex {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};  // unit vector, on the lit side
  radiosity::Color radiosity{0.0};   // W/m2
};

struct ExportGroup {
  std::string name;
  std::uint32_t first_face = 0, first_vertex = 0;  // the group ends where the next one begins; its faces use only its own vertices
};

struct ExportMesh {
  std::vector<ExportVertex> vertices;
  std::vector<std::uint32_t> corners, first_corner{0};  // of face f: first_corner[f] to first_corner[f + 1] - 1
  std::vector<ExportGroup> groups;
  bool z_up = true;
  bool as_given = false;  // the positions are those of the user's file and must not change
  std::vector<radiosity::Camera> cameras;
  // Light as a texture (below): the position of each corner in it, relative to the first row and column; empty if there is none.
  std::vector<glm::vec2> coordinates;
  std::string texture, texture_name;  // the bytes of a PNG; the name of the file with the same light

  [[nodiscard]] std::uint32_t faces() const { return static_cast<std::uint32_t>(first_corner.size() - 1); }
  [[nodiscard]] std::span<const std::uint32_t> face(std::uint32_t f) const {
    return std::span(corners).subspan(first_corner[f], first_corner[f + 1] - first_corner[f]);
  }
};

// A mesh of the solution, in depth order (in_depth_order): one group per object, one face per leaf, and at each position one vertex per
// normal and colour; the sky is as large as in the file.
[[nodiscard]] ExportMesh solution_mesh(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Mesh& mesh);

// The user's polygons and vertices, all of them, in the order of the file; the radiosity of a vertex is the mean of its corners. Nothing
// if the scene did not come from a file of polygons.
[[nodiscard]] std::optional<ExportMesh> given_mesh(const SceneFile& file, const radiosity::Solution& solution);

// The same mesh with one vertex per position in the texture: vertices on seams of the texture are doubled. `of_vertex` gets their
// positions.
[[nodiscard]] ExportMesh split_at_seams(const ExportMesh& mesh, std::vector<glm::vec2>& of_vertex);

struct ExportFormat {
  std::string_view ending;
  std::string (*write)(const ExportMesh& mesh, const radiosity::Tone& tone);
};

namespace exported {
extern const ExportFormat glb, obj;  // each defined in a file of this folder
}
// By the ending of the name; null if no format has it.
[[nodiscard]] const ExportFormat* export_format(std::string_view path);

// If two surfaces lie in one plane, such as a lamp and the ceiling around it, a viewer of meshes finds both at the same depth and shows
// either at random. Every mesh file is therefore written from a mesh whose vertices have been moved slightly apart.
//
// Does another object cover at least a part of the leaf? If both lie in one plane, the leaf must not show through.
[[nodiscard]] bool is_covered(const radiosity::Solution& solution, std::uint32_t node);

// A mesh of the solution with the same faces and corners: vertices that only covered leaves have are moved slightly backwards, those of
// lamps in the plane of a ceiling slightly forwards. The distance is 1e-4 of the diameter of what is lit.
[[nodiscard]] radiosity::Mesh in_depth_order(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Mesh& mesh);

// The mesh without the suns that were made for directional lights. They are so far away that other programs, which show all of a mesh,
// would show a dot.
[[nodiscard]] radiosity::Mesh without_suns(const SceneFile& file, const radiosity::Mesh& mesh);

// The mesh with the sky as large as in the file (EnlargedSky).
[[nodiscard]] radiosity::Mesh with_sky_of_file(const SceneFile& file, radiosity::Mesh mesh);

// --- PLY (ply.cpp)

// The solution as a binary little-endian PLY file (Turk 1994) that mesh viewers display directly.
//
//   vertex  float x y z, float nx ny nz: of the true surface, uchar red green blue: half-edge colours under the exposure, sRGB.
//           A vertex is doubled only if the faces around it differ in normal, as at a crease, or in these bytes.
//   face    list uchar int vertex_indices (3 or 4, counter-clockwise seen from the lit side),
//           float radiosity_r radiosity_g radiosity_b: of the leaf, W/m2, linear and without exposure,
//           int surface: number of the input surface; comment lines give the names: "comment surface 0 floor".
[[nodiscard]] std::string to_ply(const radiosity::Mesh& mesh, const std::vector<radiosity::InputSurface>& surfaces,
                                 const radiosity::Tone& tone);

// The user's own polygons and vertices (export/export_mesh.hpp), in their order, so that colours can be assigned by index:
//
//   vertex  x y z: float if that is exact, else double; float nx ny nz, uchar red green blue as above,
//           float radiosity_r radiosity_g radiosity_b: the mean of the faces around the vertex, W/m2.
//   face    list vertex_indices.
[[nodiscard]] std::string to_ply(const ExportMesh& mesh, const radiosity::Tone& tone);

// --- lightmaps (lightmap.cpp)
//
// The light of an exported mesh as a texture: an atlas with one rectangle per input face or per polygon of the user
// (radiosity/bake/lightmap.hpp), and texture coordinates at the corners of the mesh.

struct LightTexture {
  radiosity::Picture picture;
  double texel = 0.0;  // edge length of a texel, metres
};

// `mesh` is the result of solution_mesh(). A rectangle contains an input face. A curved face is projected onto the plane of the mean
// normal of its leaves, so its normals must be within a right angle of this one. `texel`: wanted size in metres; by default chosen such
// that there are about a million texels. Nothing if no face has an area.
[[nodiscard]] std::optional<LightTexture> solution_texture(const radiosity::Solution& solution, const radiosity::Tone& tone,
                                                           std::optional<double> texel, ExportMesh& mesh);

// `mesh` is the result of given_mesh(). A rectangle contains a polygon of the file, seen from its front or else from its back; polygons
// without light have none.
[[nodiscard]] std::optional<LightTexture> given_texture(const SceneFile& file, const radiosity::Solution& solution,
                                                        const radiosity::Tone& tone, std::optional<double> texel, ExportMesh& mesh);

// --- pages (viewer.cpp)
//
// A page that shows a solution in any browser with WebGL 2, from a file and offline. It contains the light as computed, to be exposed and
// viewed from anywhere, and the leaves and the levels of the hierarchy above them, as outlines and as colours.
//
// `camera`: the initial one. `title` and `sentence` are plain text.
[[nodiscard]] std::string viewer_page(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Camera& camera,
                                      double exposure, const std::string& title, const std::string& sentence);

}  // namespace apps
