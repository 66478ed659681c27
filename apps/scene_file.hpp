// SPDX-License-Identifier: MIT
#pragma once

// The `.scene` file: text written by people, described in examples/scenes/README.md.
//
// Reading gives the scene with its cameras, or a list of errors. Every error says where it is, what stands there and what was expected.
// No input makes reading throw, crash, recurse deeply or run without end: the size of the file, the number of objects made by `use` and
// the corners of one polygon have limits, each with its own error sentence.
//
//     text -> lexer (words, numbers, braces, ends of lines) -> parser (statements with their places)
//          -> build (names resolved, shapes made, groups placed) -> SceneFile

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/camera/view.hpp>
#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/input_errors.hpp"

namespace apps {

inline constexpr std::size_t max_file_bytes = std::size_t{256} << 20;
inline constexpr std::size_t max_objects = 100'000;
inline constexpr std::size_t max_use_depth = 64;
inline constexpr std::size_t max_polygon_corners = 1024;  // the test for self-intersection is quadratic
inline constexpr double max_number = 1e30;                // so that products of four lengths are far from overflow
inline constexpr std::uint32_t max_picture_side = 16'384;

// Data about an object that a run does not need; messages and `halflight info` use it.
struct ObjectOrigin {
  std::string_view kind;  // "box", "mesh", ...
  Place place;
};

// The polygons of a file of another program as they are in the file, so that their light can be written back to them.
struct GivenPolygons {
  std::vector<glm::dvec3> positions, placed;  // in the coordinates of the file; in those of the scene
  std::vector<std::uint32_t> corners, first_corner;
  radiosity::PolygonParts parts;  // of the objects from first_object on
  std::uint32_t first_object = 0;
  bool z_up = false;  // is z the vertical axis of the file?

  [[nodiscard]] std::size_t count() const { return first_corner.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> polygon(std::size_t p) const {
    return std::span(corners).subspan(first_corner[p], first_corner[p + 1] - first_corner[p]);
  }
  // Are all corner indices of the polygon valid? Others are not exported.
  [[nodiscard]] bool sound(std::size_t p) const {
    return std::ranges::all_of(polygon(p), [this](std::uint32_t v) { return v < positions.size(); });
  }
  // The polygons in the scene, all of material 0: `material` holds as many zeros as there are polygons and must outlive the view.
  [[nodiscard]] radiosity::PolygonView in_scene(std::vector<std::uint32_t>& material) const {
    material.assign(count(), 0);
    return {placed, corners, first_corner, material};
  }
};

// A file that was read for a scene: a mesh, materials, a picture, a part.
struct FileBeside {
  std::string name;  // as named in the scene
  std::string path, bytes;
};

// The sky of a file that would hide its suns is enlarged from a point until it lies beyond them; exported meshes have it as the file does.
struct EnlargedSky {
  std::vector<std::uint32_t> objects;
  glm::dvec3 centre{0.0};
  double factor = 1.0;
};

struct SceneFile {
  radiosity::Scene scene;
  std::vector<ObjectOrigin> origins;  // by index of scene.objects
  std::vector<radiosity::Camera> cameras;
  std::vector<std::string> notes;     // about files of other formats: what was changed or read differently
  std::vector<std::string> warnings;  // about such files: what shines otherwise than the file says
  std::vector<std::uint32_t> suns;    // objects made for directional lights: far away, so exported meshes leave them out
  EnlargedSky sky;
  std::string text;  // the file itself, for an output that contains it
  std::vector<FileBeside> beside;
  std::shared_ptr<GivenPolygons> given;  // only for files of other formats, else null
};

// Reads a file by the name that the scene gives it: returns its bytes, or nothing and a sentence such as "cannot be opened: ...".
using SideFile = std::function<std::optional<std::string>(const std::string& name, std::string& fault)>;

// The same; a file that is missing there is looked for with ever fewer of its folders, at last beside the scene: many files contain paths
// of the computer on which they were written, or are passed on without a folder around them.
[[nodiscard]] std::optional<std::string> there_or_beside(const std::string& name, const SideFile& side_file, std::string& fault);

struct SceneResult : ErrorReport {
  std::optional<SceneFile> file;  // nothing if there are errors
};

// The scene that `text` describes. Without `side_file` it cannot use meshes from other files. `first`: a camera to place before its own.
[[nodiscard]] SceneResult parse_scene(std::string_view text, const SideFile& side_file = {},
                                      const std::optional<radiosity::Camera>& first = {});

// Parses the clauses of a camera statement, such as "eye 1 2 1.5 target 0 0 1 fov 60"; commas count as spaces. If the clauses are invalid,
// returns nothing and a sentence in `fault`.
[[nodiscard]] std::optional<radiosity::Camera> parse_camera(std::string_view clauses, std::string& fault);
// The clauses that describe this view, to be changed a little by a person: "eye 1 2 1.5 target 0 0 1 fov 60". Positions are rounded to a
// part in 10^5 of the way from eye to target, or of the eye's coordinates if these are smaller. Without `up` where it is z, the default.
[[nodiscard]] std::string camera_text(const radiosity::Camera& camera);
// Does the text begin with the word of such a clause, so that it is not the name of a camera?
[[nodiscard]] bool begins_camera(std::string_view text);

// The whole file, decompressed if it is one of gzip, "-" for the standard input; or nothing and a sentence in `fault` (missing, a
// directory, unreadable, damaged, too large).
[[nodiscard]] std::optional<std::string> read_text(const std::string& path, std::string& fault);

}  // namespace apps
