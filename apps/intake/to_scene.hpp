// SPDX-License-Identifier: MIT
#pragma once

// From a model of another program to a scene that can be solved: units and the up axis, what the file leaves open (reflectances, lamps, a
// camera), and the polygons through the intake. Every decision is a sentence in SceneFile::notes.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "apps/intake/model.hpp"
#include "apps/scene_file.hpp"

namespace apps {

// Polygons of other programs reflect at most this: white paint of a file often has reflectance 1, which no surface has, and a closed room
// of it would never get rid of its light.
inline constexpr double most_reflectance = 0.95;

// Of a file of another program: it may have an object for every thing in a town.
inline constexpr std::size_t max_model_objects = 1'000'000;

struct Lamp {
  std::string material;
  double exitance = 100.0;  // W/m2
};

// What the command line says about files of other formats, and a camera for any scene.
struct ModelOptions {
  std::vector<Lamp> lamps;
  bool two_sided = false;
  double reflectance = 0.5;  // of materials that have none
  double metres = 1.0;       // one unit of the file
  std::optional<UpAxis> up;  // default: the format's
  bool merge = true;
  bool lamps_wanted = true;                 // a model in which nothing shines gets a lamp
  std::optional<radiosity::Camera> camera;  // before those of the file, in the scene's coordinates

  // The options as text, such that other options have another text.
  [[nodiscard]] std::string key() const;
};

// "ceiling light=200", "ceiling light"
[[nodiscard]] std::optional<Lamp> parse_lamp(std::string_view text);
// "mm", "cm", "m", "km", "in", "ft" or a number: metres.
[[nodiscard]] std::optional<double> parse_unit(std::string_view text);

// The scene, or nothing and sentences that say why there is none.
[[nodiscard]] std::optional<SceneFile> to_scene(Model model, UpAxis up, const ModelOptions& options, std::vector<std::string>& faults);

// The objects and materials alone, in the file's own coordinates: without cameras and without a lamp that it does not have. `two_sided` as
// in ModelOptions. `eyes`: of cameras around it, in its coordinates; they tell what is seen from inside.
[[nodiscard]] std::optional<SceneFile> to_part(Model model, bool two_sided, const std::vector<glm::dvec3>& eyes,
                                               std::vector<std::string>& faults);

}  // namespace apps
