// SPDX-License-Identifier: MIT
#pragma once

// The `.scene` file: text made for people, described in examples/scenes/README.md.
//
// Reading one gives a value: the scene with its cameras, or a list of errors. Every error says where it lies, what stands there and what
// was expected. No input makes it throw, crash, recurse deeply or run without end: the size of the file, the number of objects that `use`
// may make and the corners of one polygon have limits, each with its sentence.
//
//     text -> lexer (words, numbers, braces, ends of lines) -> parser (statements with their places)
//          -> build (names resolved, shapes made, groups placed) -> SceneFile

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
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
inline constexpr double max_number = 1e30;                // products of four lengths stay far from overflow
inline constexpr std::uint32_t max_picture_side = 16'384;

// What the file says about an object and a run does not need; messages and `halflight info` name it.
struct ObjectOrigin {
  std::string_view kind;  // "box", "mesh", ...
  Place place;
};

// The polygons of a file of another program as they stand in it, so that their light can go back to them.
struct GivenPolygons {
  std::vector<glm::dvec3> positions, placed;  // in the file; in the scene
  std::vector<std::uint32_t> corners, first_corner;
  radiosity::PolygonParts parts;  // of the objects from this one on:
  std::uint32_t first_object = 0;
  bool z_up = false;  // in the file
};

// A file beside a scene that was read for it: a mesh, materials, a picture, a part.
struct FileBeside {
  std::string name;  // as the scene says it
  std::string path, bytes;
};

struct SceneFile {
  radiosity::Scene scene;
  std::vector<ObjectOrigin> origins;  // one per scene.objects
  std::vector<radiosity::Camera> cameras;
  std::vector<std::string> notes;  // of files of other formats: what was changed or taken otherwise
  std::string text;                // the file itself, where an output is to hold it
  std::vector<FileBeside> beside;
  std::shared_ptr<GivenPolygons> given;  // of files of other formats; null: none
};

// A file beside the one that is read, by its name there: its bytes, or nothing and a sentence such as "cannot be opened: ...".
using SideFile = std::function<std::optional<std::string>(const std::string& name, std::string& fault)>;

struct SceneResult : ErrorReport {
  std::optional<SceneFile> file;  // nothing when there are errors
};

// The scene that `text` describes. Without `side_file` no mesh can be in a file of its own. `first`: a camera that comes before its own.
[[nodiscard]] SceneResult parse_scene(std::string_view text, const SideFile& side_file = {},
                                      const std::optional<radiosity::Camera>& first = {});

// A camera by the clauses of its statement, such as "eye 1 2 1.5 target 0 0 1 fov 60", or nothing and a sentence in `fault`.
[[nodiscard]] std::optional<radiosity::Camera> parse_camera(std::string_view clauses, std::string& fault);
// Does the text begin with the word of such a clause, so that it is no name of a camera?
[[nodiscard]] bool begins_camera(std::string_view text);

// The whole file, "-" for the standard input, or nothing and a sentence in `fault` (missing, a directory, unreadable, too large).
[[nodiscard]] std::optional<std::string> read_text(const std::string& path, std::string& fault);

}  // namespace apps
