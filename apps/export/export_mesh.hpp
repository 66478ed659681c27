// SPDX-License-Identifier: MIT
#pragma once

// What files for other programs are written from: vertices with a normal and a radiosity, polygons, groups. It is made of the solution, or
// of the polygons that the user's file gave, in that file's own order and coordinates. A format is one file of this folder, and one line in
// export_mesh.cpp.

#include <cstddef>
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
  glm::dvec3 normal{0.0, 0.0, 1.0};  // of length 1, on the side that is lit
  radiosity::Color radiosity{0.0};   // W/m2
};

struct ExportGroup {
  std::string name;
  std::uint32_t first_face = 0, first_vertex = 0;  // up to those of the next one; its faces use its vertices alone
};

struct ExportMesh {
  std::vector<ExportVertex> vertices;
  std::vector<std::uint32_t> corners, first_corner{0};  // of face f: first_corner[f] to first_corner[f + 1] - 1
  std::vector<ExportGroup> groups;
  bool z_up = true;
  bool as_given = false;  // the positions are those of the user's file, and stay so
  std::vector<radiosity::Camera> cameras;
  // Light as a texture (below): of each corner its place there, from the first row and column on; empty when there is none.
  std::vector<glm::vec2> coordinates;
  std::string texture, texture_name;  // a PNG; the name of the file in which the same light is

  [[nodiscard]] std::uint32_t faces() const { return static_cast<std::uint32_t>(first_corner.size() - 1); }
  [[nodiscard]] std::span<const std::uint32_t> face(std::uint32_t f) const {
    return std::span(corners).subspan(first_corner[f], first_corner[f + 1] - first_corner[f]);
  }
};

// A mesh of the solution, in depth order (in_depth_order): a group an object, a face a leaf, a vertex for each normal and colour that a
// place has.
[[nodiscard]] ExportMesh solution_mesh(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Mesh& mesh);

// The user's polygons and vertices, all of them, in the order of the file; a vertex has the mean of its corners. Nothing when the scene
// came from no file of polygons.
[[nodiscard]] std::optional<ExportMesh> given_mesh(const SceneFile& file, const radiosity::Solution& solution);

// Has the polygon corners that the file has? Others are not in given_mesh().
[[nodiscard]] bool is_sound(const GivenPolygons& given, std::size_t polygon);

// The same mesh with a vertex for each place in the texture: where that jumps, vertices are doubled. `of_vertex`: their places.
[[nodiscard]] ExportMesh split_at_seams(const ExportMesh& mesh, std::vector<glm::vec2>& of_vertex);

struct ExportFormat {
  std::string_view ending;
  std::string (*write)(const ExportMesh& mesh, const radiosity::Tone& tone);
};

namespace exported {
extern const ExportFormat glb, obj;  // a file of this folder each
}
// By the ending of the name; null when none has it.
[[nodiscard]] const ExportFormat* export_format(std::string_view path);

// Where two surfaces lie in one plane, such as a lamp and the ceiling that it is set into, a viewer of meshes finds both at the same depth
// and shows now the one and now the other. Every file of a mesh is therefore written from one whose places have moved a little apart.
//
// Does another object cover the leaf, or a part of it? Where both lie in one plane the leaf must not show through.
[[nodiscard]] bool is_covered(const radiosity::Solution& solution, std::uint32_t node);

// A mesh of the solution with the same faces and corners: corners that only covered leaves have lie a little behind their places, lamps in
// the plane of a ceiling a little before theirs. The distance is 1e-4 of the scene's diameter.
[[nodiscard]] radiosity::Mesh in_depth_order(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Mesh& mesh);

// --- PLY (ply.cpp)

// The solution as a binary little-endian PLY file (Turk 1994) that mesh viewers show as it is.
//
//   vertex  float x y z, float nx ny nz: of the true surface, uchar red green blue: half-edge colours under the exposure, sRGB.
//           A vertex is doubled only where the faces around it differ in normal, as at a crease, or in these bytes.
//   face    list uchar int vertex_indices (3 or 4, counter-clockwise from the bright side),
//           float radiosity_r radiosity_g radiosity_b: of the leaf, W/m2, linear and without exposure,
//           int surface: number of the input surface; comment lines give the names: "comment surface 0 floor".
[[nodiscard]] std::string to_ply(const radiosity::Mesh& mesh, const std::vector<radiosity::InputSurface>& surfaces,
                                 const radiosity::Tone& tone);

// The user's own polygons and vertices (export/export_mesh.hpp), in their order, so that colours can be taken over by number:
//
//   vertex  x y z: float where that is exact, else double; float nx ny nz, uchar red green blue as above,
//           float radiosity_r radiosity_g radiosity_b: the mean of the faces around, W/m2.
//   face    list vertex_indices.
[[nodiscard]] std::string to_ply(const ExportMesh& mesh, const radiosity::Tone& tone);

// --- lightmaps (lightmap.cpp)
//
// The light of an exported mesh as a texture: one atlas with a rectangle for each input face or for each polygon of the user
// (radiosity/bake/lightmap.hpp), and texture coordinates at the corners of the mesh.

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

// --- pages (viewer.cpp)
//
// A page that shows a solution in any browser with WebGL 2, from a file and offline: nothing is loaded from elsewhere. The light as it was
// computed, to be exposed and looked at from everywhere; the leaves and the levels of the hierarchy above them, as borders and as colours.
//
// `camera`: the one that the page begins with. `title` and `sentence` are plain text.
[[nodiscard]] std::string viewer_page(const SceneFile& file, const radiosity::Solution& solution, const radiosity::Camera& camera,
                                      double exposure, const std::string& title, const std::string& sentence);

}  // namespace apps
