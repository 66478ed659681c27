// SPDX-License-Identifier: MIT
#pragma once

// Scenes in the formats of other programs. Each format has a reader that fills a Model: polygons, materials, cameras and analytic objects
// as the file has them, unjudged. to_scene.hpp makes a scene of it: polygons go through the intake (radiosity/intake/intake.hpp), which
// repairs and counts. A reader refuses what cannot be read, with file, line, column and what to do; what it passes over it notes.
//
// No input makes a reader throw, crash, recurse deeply or run without end. Files beside the first one are asked for by a function, so that
// tests and fuzz targets need no file system.

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

// A material as files have it: what is not said stays open.
struct ModelMaterial {
  std::string name;
  std::optional<radiosity::Color> reflectance;
  radiosity::Color emission{0.0};  // W/m2
  bool two_sided = false;          // the file says that its surfaces are seen from both sides
};

// A light without a surface, which becomes a small lamp. `intensity`: W/sr, or, of one that is bright enough for any scene, 1 1 1.
struct ModelLight {
  glm::dvec3 position{0.0};
  radiosity::Color intensity{0.0};
  bool absolute = false;  // in W/sr
};

// A run of polygons that stand together: in an included file, or, in formats without lines, in one list. Its name is empty for the file
// itself.
struct ModelPart {
  std::uint32_t first_polygon = 0;
  std::string name;
};

struct Model {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> corners, first_corner{0};
  std::vector<std::uint32_t> material, group;  // of each polygon
  std::vector<std::uint32_t> line;             // of each polygon: where it stands in the file; empty or 0: nowhere
  std::vector<ModelPart> parts;                // of the polygons, in their order; before the first: the file itself
  std::vector<std::string> groups;             // names
  std::vector<ModelMaterial> materials;
  std::vector<radiosity::SceneObject> objects;  // analytic ones; their materials are among the model's
  std::vector<ObjectOrigin> origins;            // one per object
  std::vector<radiosity::Camera> cameras;
  std::vector<ModelLight> lights;
  std::vector<std::string> notes;  // sentences about what was passed over or taken otherwise
  bool tells_sides = true;         // its format says which surfaces are seen from both sides; the others are seen from the front

  [[nodiscard]] std::size_t polygons() const { return first_corner.size() - 1; }
  void polygon(std::span<const std::uint32_t> its_corners, std::uint32_t its_material, std::uint32_t its_group,
               std::uint32_t its_line = 0) {
    corners.insert(corners.end(), its_corners.begin(), its_corners.end());
    first_corner.push_back(static_cast<std::uint32_t>(corners.size()));
    material.push_back(its_material);
    group.push_back(its_group);
    line.push_back(its_line);
  }

  // The polygons from now on stand in this part.
  void begin_part(const std::string& name);
  // What has no other name stands in this file.
  void name_file(const std::string& name);
  // "at line 12", "at line 12 of part.mgf", "at polygon 3 of 50", "at polygon 3 of 50 in meshes[0].primitives[1]"; polygons from 1 on.
  [[nodiscard]] std::string place(std::uint32_t polygon) const;
};

// Notes that are the same for many places: each is told once, with how often and where first.
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

// Does it look somewhere, with its up beside its view, and through a lens that a picture can have? Others must not get into a model.
[[nodiscard]] bool usable(const radiosity::Camera& camera);

struct ModelResult : ErrorReport {
  std::optional<Model> model;  // nothing when there are errors
};

// What a reader gives back in the end.
[[nodiscard]] inline ModelResult read_result(Model model, Errors& errors) {
  const bool sound = errors.count() == 0;
  return {errors.take(), sound ? std::optional(std::move(model)) : std::nullopt};
}

enum class UpAxis : unsigned char { x, y, z };

// A format: one file of this folder defines it; it is named below, and in the list of formats.cpp.
struct ModelFormat {
  std::string_view ending;                 // of the name, in small letters: ".gltf"
  std::string_view name;                   // "glTF"
  UpAxis up;                               // what files of this format mean by up
  bool (*begins)(std::string_view bytes);  // does a file of this format begin so? For files without a name
  ModelResult (*read)(std::string_view bytes, const SideFile& side_file);
};

namespace intake {
extern const ModelFormat obj, ply, off, stl, gltf, glb, wrl, mgf_format;
}
[[nodiscard]] std::span<const ModelFormat* const> model_formats();

// ".obj, .gltf, ... or .mgf"
[[nodiscard]] std::string model_endings();

// By the ending of the name, in any case; of "-" by the first bytes. Null when none has it.
[[nodiscard]] const ModelFormat* model_format(std::string_view path, std::string_view bytes);

}  // namespace apps
