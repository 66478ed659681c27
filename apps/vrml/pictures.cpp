// SPDX-License-Identifier: MIT
// The pictures of Texture2 nodes: a file beside the scene, or pixels in the field `image`: width, height, number of components (1 grey, 2
// grey and opacity, 3 red, green and blue, 4 these and opacity), then a number for each pixel, its first component in the highest byte. A
// surface has the mean of its picture times its diffuse colour.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/intake/texture.hpp"
#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {
namespace {

// Of width, height, components and pixels. Nothing when a number is not what it must be.
std::optional<radiosity::Color> mean_of_image(const std::vector<double>& numbers) {
  const auto whole = [](double x) { return x >= 1.0 && x == std::floor(x); };
  if (numbers.size() < 4 || !std::all_of(numbers.begin(), numbers.begin() + 3, whole) || numbers[2] > 4.0) { return std::nullopt; }
  const double components = numbers[2];
  const auto bytes = static_cast<std::size_t>(components);
  const double most = std::exp2(8.0 * components) - 1.0;
  std::vector<std::uint8_t> rgba;
  for (std::size_t i = 3; i < numbers.size(); ++i) {
    if (!(numbers[i] >= 0.0 && numbers[i] <= most) || numbers[i] != std::floor(numbers[i])) { return std::nullopt; }
    const auto pixel = static_cast<std::uint32_t>(numbers[i]);
    const auto component = [&](std::size_t k) { return static_cast<std::uint8_t>(pixel >> (8 * (bytes - 1 - k)) & 0xff); };
    const bool grey = bytes < 3;
    const std::uint8_t opaque = bytes % 2 == 0 ? component(bytes - 1) : std::uint8_t{255};
    rgba.insert(rgba.end(), {component(0), component(grey ? 0 : 1), component(grey ? 0 : 2), opaque});
  }
  return intake::mean_of_pixels(rgba);
}

}  // namespace

std::optional<radiosity::Color> mean_of_texture(const Node& texture, const SideFile& side_file, Notes& notes) {
  const Field* const image = texture.find("image");
  const std::string name(texture.word("filename", ""));
  const bool inside = image != nullptr && image->numbers.size() >= 2 && image->numbers[0] * image->numbers[1] != 0.0;
  if (!inside && name.empty()) { return std::nullopt; }  // the end of an earlier picture
  std::string fault;
  std::optional<radiosity::Color> mean;
  if (inside) {
    mean = mean_of_image(image->numbers);
  } else if (name.find("://") == name.npos) {
    if (const auto bytes = side_file(name, fault)) { mean = intake::mean_color(*bytes); }
  }
  notes.add(mean ? "pictures on surfaces count with their mean colour" : "textures are not read: the diffuse colour stands for the picture",
            "at line " + std::to_string(texture.place.line));
  return mean;
}

}  // namespace apps::vrml
