// SPDX-License-Identifier: MIT
#pragma once

// The scenes that come with the project.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene_file.hpp"
#include "catch.hpp"

inline radiosity::Scene parsed_scene(const std::string& text, const std::string& name = "text") {
  apps::SceneResult result = apps::parse_scene(text);
  INFO(apps::to_text(result, name));
  REQUIRE(result.file);
  return std::move(result.file->scene);
}

inline radiosity::Scene example_scene(const std::string& name) {
  std::ifstream file{std::string{HALFLIGHT_SCENES} + "/" + name};
  std::ostringstream text;
  text << file.rdbuf();
  return parsed_scene(text.str(), name);
}

// Their file names, sorted.
inline std::vector<std::string> example_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator{HALFLIGHT_SCENES}) {
    if (entry.path().extension() == ".scene") { names.push_back(entry.path().filename().string()); }
  }
  std::sort(names.begin(), names.end());
  return names;
}
