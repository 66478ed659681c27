// SPDX-License-Identifier: MIT
#pragma once

// Scenes in the formats of other programs. Each format has a reader that fills a Model with polygons, materials, cameras and analytic
// objects as they are in the file, without judging them. to_scene.hpp makes a scene of it: polygons go through the intake
// (radiosity/intake/intake.hpp), which repairs and counts them. A reader refuses invalid files, with file, line, column and advice; it
// notes what it ignores.
//
// No input makes a reader throw, crash, recurse deeply or run without end. Other files are read by a function, so that tests and fuzz
// targets need no file system.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/input_errors.hpp"
#include "apps/scene_file.hpp"

namespace apps {

// A material as described in a file, which may leave values undefined.
struct ModelMaterial {
  std::string name;
  std::optional<radiosity::Color> reflectance;
  radiosity::Color emission{0.0};  // W/m2
  bool two_sided = false;          // does the file say that its surfaces are seen from both sides?
  double opacity = 1.0;            // share of the light that does not pass through
  radiosity::Color mirror{0.0};    // share that is reflected as by a mirror
};

// The colour of highlights (Phong 1975) as a share that is reflected as by a mirror. Some programs write .5 for every material, black ones,
// too: only more than that tells anything.
[[nodiscard]] inline radiosity::Color mirror_of_highlight(const radiosity::Color& specular) {
  return radiosity::brightest(specular) > 0.5 ? specular : radiosity::Color(0.0);
}

// Surfaces that let most light through, such as window panes, are left out of the scene (panes.hpp); others are taken as opaque.
inline constexpr double least_opacity = 0.5;

// A light without a surface, for which a lamp is made (light_lamps.hpp). `intensity` is in W/sr, that of a sun in W/m2 across its rays; or,
// if not `absolute`, relative to one that is bright enough for the scene.
struct ModelLight {
  enum class Kind : unsigned char { point, spot, sun };
  Kind kind = Kind::point;
  glm::dvec3 position{0.0};  // but for a sun
  radiosity::Color intensity{0.0};
  bool absolute = false;
  glm::dvec3 direction{0.0, 0.0, -1.0};  // in which a spot or a sun shines, of any length
  double inner = 0.0, outer = 0.0;       // of a spot, radians from its axis: full light up to `inner`, none beyond `outer`
  // Of a spot: how the light falls from the inner to the outer cone. With the square of a share of the cosine (glTF, KHR_lights_punctual),
  // with a share of the angle (VRML 2.0), or from the axis with a power of the cosine (VRML 1.0, as in OpenGL).
  enum class Fade : unsigned char { squared_cosine, by_angle, power_of_cosine };
  Fade fade = Fade::squared_cosine;
  double power = 0.0;  // of the cosine
  bool fades_otherwise = false;          // in its file: not with the square of the distance, or it ends at a distance
};

// A run of consecutive polygons from one place: an included file or, in formats without lines, a list. The name is empty for the file
// itself.
struct ModelPart {
  std::uint32_t first_polygon = 0;
  std::string name;
};

struct Model {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> corners, first_corner{0};
  std::vector<std::uint32_t> material, group;  // by polygon
  std::vector<std::uint32_t> line;             // by polygon: its line in the file; empty or 0: unknown
  std::vector<ModelPart> parts;                // sorted by first polygon; polygons before the first part are in the file itself
  std::vector<std::string> groups;             // names
  std::vector<ModelMaterial> materials;
  std::vector<radiosity::SceneObject> objects;  // analytic ones; their materials are among the model's
  std::vector<ObjectOrigin> origins;            // one per object
  std::vector<radiosity::Camera> cameras;
  std::vector<ModelLight> lights;
  std::vector<std::string> notes;  // sentences about what was ignored or read differently
  bool tells_sides = true;         // does the format say which surfaces are seen from both sides? Then others are seen only from the front

  [[nodiscard]] std::size_t polygons() const { return first_corner.size() - 1; }
  void polygon(std::span<const std::uint32_t> its_corners, std::uint32_t its_material, std::uint32_t its_group,
               std::uint32_t its_line = 0) {
    corners.insert(corners.end(), its_corners.begin(), its_corners.end());
    first_corner.push_back(static_cast<std::uint32_t>(corners.size()));
    material.push_back(its_material);
    group.push_back(its_group);
    line.push_back(its_line);
  }

  // The polygons added from now on belong to this part.
  void begin_part(const std::string& name);
  // Gives this name to parts without a name.
  void name_file(const std::string& name);
  // Describes the place of a polygon: "at line 12", "at line 12 of part.mgf", "at polygon 3 of 50", "at polygon 3 of 50 in
  // meshes[0].primitives[1]"; polygons count from 1.
  [[nodiscard]] std::string place(std::uint32_t polygon) const;
};

// Notes, which may be the same for many places: each is reported once, with its number and its first place.
class Notes {
 public:
  void add(const std::string& sentence, std::string place = {}) {
    Entry& entry = entries_[sentence];
    if (entry.count++ == 0) { entry = {1, entries_.size(), std::move(place)}; }
  }
  [[nodiscard]] std::vector<std::string> take() const;

 private:
  struct Entry {
    std::size_t count = 0, number = 0;
    std::string place;
  };
  std::map<std::string, Entry> entries_;
};

// Are the camera's numbers within limits, its up vector not parallel to its direction, and its field of view valid? Models must have no
// other cameras.
[[nodiscard]] bool usable(const radiosity::Camera& camera);

struct ModelResult : ErrorReport {
  std::optional<Model> model;  // nothing if there are errors
};

// The result of a reader.
[[nodiscard]] inline ModelResult read_result(Model model, Errors& errors) {
  const bool sound = errors.count() == 0;
  return {errors.take(), sound ? std::optional(std::move(model)) : std::nullopt};
}

enum class UpAxis : unsigned char { x, y, z };

// A format. One file of this folder defines it; it is declared below and listed in formats.cpp.
struct ModelFormat {
  std::string_view ending;                 // of the file's name, in lower case: ".gltf"
  std::string_view name;                   // "glTF"
  UpAxis up;                               // the vertical axis of files of this format
  bool (*begins)(std::string_view bytes);  // can a file of this format begin so? Used for files without a name
  ModelResult (*read)(std::string_view bytes, const SideFile& side_file);
};

namespace intake {
extern const ModelFormat obj, ply, off, stl, gltf, glb, wrl, mgf_format;
}
[[nodiscard]] std::span<const ModelFormat* const> model_formats();

// ".obj, .gltf, ... or .mgf"
[[nodiscard]] std::string model_endings();

// By the ending of the name, in upper or lower case, without ".gz" (".wrz" is ".wrl.gz"); for "-" by the first bytes. Null if no format
// fits. `bytes`: decompressed.
[[nodiscard]] const ModelFormat* model_format(std::string_view path, std::string_view bytes);

}  // namespace apps
