// SPDX-License-Identifier: MIT
#pragma once

// Files of other programs for the tests of their readers: from memory, with files beside them that are in memory, too.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/intake/model.hpp"
#include "apps/intake/to_scene.hpp"
#include "catch.hpp"

namespace models {

using Files = std::map<std::string, std::string>;

inline apps::SideFile beside(Files files) {
  return [files = std::move(files)](const std::string& name, std::string& fault) -> std::optional<std::string> {
    const auto found = files.find(name);
    if (found != files.end()) { return found->second; }
    fault = "is not there";
    return std::nullopt;
  };
}

inline const apps::ModelFormat& format(const std::string& name) {
  const apps::ModelFormat* const found = apps::model_format(name, "");
  REQUIRE(found != nullptr);
  return *found;
}

inline apps::ModelResult result(const std::string& name, const std::string& bytes, const Files& files = {}) {
  apps::ModelResult read = format(name).read(bytes, beside(files));
  CHECK(read.model.has_value() == read.errors.empty());
  return read;
}

inline apps::Model read(const std::string& name, const std::string& bytes, const Files& files = {}) {
  apps::ModelResult read = result(name, bytes, files);
  INFO(apps::to_text(read, name));
  REQUIRE(read.model);
  return std::move(*read.model);
}

// The first error as text, without the file's name.
inline std::string error(const std::string& name, const std::string& bytes, const Files& files = {}) {
  const std::string text = apps::to_text(result(name, bytes, files), "");
  return text.substr(0, text.find('\n'));
}

inline apps::SceneFile scene(const std::string& name, const std::string& bytes, const Files& files = {},
                             const apps::ModelOptions& options = {}) {
  std::vector<std::string> faults;
  auto file = apps::to_scene(read(name, bytes, files), format(name).up, options, faults);
  for (const std::string& fault : faults) { UNSCOPED_INFO(fault); }
  REQUIRE(file);
  CHECK(radiosity::faults(file->scene).empty());
  CHECK(file->origins.size() == file->scene.objects.size());
  return std::move(*file);
}

inline bool noted(const std::vector<std::string>& notes, const std::string& part) {
  for (const std::string& note : notes) {
    if (note.find(part) != std::string::npos) { return true; }
  }
  return false;
}

inline glm::dvec3 corner(const apps::Model& model, std::size_t polygon, std::size_t i) {
  return model.positions[model.corners[model.first_corner[polygon] + i]];
}

// A room of 4 x 3 x 4 as OBJ with y up, its faces inwards, all of one material.
inline const std::string room_obj =
    "mtllib room.mtl\no room\nusemtl wall\n"
    "v 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nv 0 3 0\nv 4 3 0\nv 4 3 4\nv 0 3 4\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

}  // namespace models
