// SPDX-License-Identifier: MIT
#pragma once

// The pictures of Texture2 nodes: a file beside the scene, or pixels in the field `image`: width, height, number of components (1 grey, 2
// grey and opacity, 3 red, green and blue, 4 these and opacity), then a number for each pixel, its first component in the highest byte. A
// surface has the mean of its picture times its diffuse colour.

#include <map>
#include <optional>

#include <radiosity/scene/material.hpp>

#include "apps/intake/model.hpp"
#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {

class Pictures {
 public:
  Pictures(const SideFile& side_file, Notes& notes) : side_file_(side_file), notes_(notes) {}

  // The mean colour that a Texture2 node gives to what follows it; nothing when it has no picture, or one that cannot be read, which is
  // noted. Each is read once.
  [[nodiscard]] std::optional<radiosity::Color> mean(const Node& texture);

 private:
  [[nodiscard]] std::optional<radiosity::Color> read(const Node& texture);

  const SideFile& side_file_;
  Notes& notes_;
  std::map<const Node*, std::optional<radiosity::Color>> means_;
};

}  // namespace apps::vrml
