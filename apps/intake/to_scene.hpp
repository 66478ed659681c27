// SPDX-License-Identifier: MIT
#pragma once

// Makes a scene that can be solved from a model of another program: sets units and vertical axis, chooses what the file leaves undefined
// (reflectances, lamps, a camera), and passes the polygons through the intake. Every decision is a sentence in SceneFile::notes.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "apps/intake/model.hpp"
#include "apps/scene_file.hpp"

namespace apps {

// Upper limit for the reflectance of polygons of other programs. Files often have white of reflectance 1, which no real surface has, and a
// closed room of it would never lose its light. It stands for white paint: a colour with a channel above the limit is scaled down to this.
inline constexpr double most_reflectance = 0.99, white_paint = 0.95;

// Limit for a file of another program, which may have an object for every thing in a town.
inline constexpr std::size_t max_model_objects = 1'000'000;

struct Lamp {
  std::string material;
  double exitance = 100.0;  // W/m2
};

// Options of the command line about files of other formats, and a camera for any scene.
struct ModelOptions {
  std::vector<Lamp> lamps;
  bool two_sided = false;
  double reflectance = 0.5;  // of materials without one
  double metres = 1.0;       // length of one unit of the file
  std::optional<UpAxis> up;  // default: the format's
  bool merge = true;
  bool opaque = false;                      // should surfaces that let most light through remain, as opaque ones?
  bool lamps_wanted = true;                 // should a model without light get a lamp?
  std::optional<radiosity::Camera> camera;  // placed before those of the file, in the scene's coordinates

  // The options as text; different options give different texts.
  [[nodiscard]] std::string key() const;
};

// Parses "ceiling light=200" or "ceiling light".
[[nodiscard]] std::optional<Lamp> parse_lamp(std::string_view text);
// Parses "mm", "cm", "m", "km", "in", "ft" or a number; the result is in metres.
[[nodiscard]] std::optional<double> parse_unit(std::string_view text);

// The scene; or nothing, and sentences that say why.
[[nodiscard]] std::optional<SceneFile> to_scene(Model model, UpAxis up, const ModelOptions& options, std::vector<std::string>& faults);

// The objects and materials only, in the file's own coordinates, without cameras and without an added lamp. `two_sided` as in
// ModelOptions. `eyes`: positions of cameras, in the file's coordinates; they determine what is seen from inside.
[[nodiscard]] std::optional<SceneFile> to_part(Model model, bool two_sided, const std::vector<glm::dvec3>& eyes,
                                               std::vector<std::string>& faults);

}  // namespace apps
