// SPDX-License-Identifier: MIT
#include "apps/vrml/scene_graph.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace apps::vrml {
namespace {

// The field of the state's material; in VRML 97 a Color node replaces the material's diffuse colour.
const Field* found_in(const State& state, std::string_view field) {
  if (state.colors != nullptr && field == "diffuseColor") { return state.colors->find("color"); }
  return state.material != nullptr ? state.material->find(field) : nullptr;
}

std::size_t values(const State& state, std::string_view field, std::size_t size) {
  const Field* const found = found_in(state, field);
  return found != nullptr ? found->numbers.size() / size : 0;
}

}  // namespace

std::uint32_t Looks::material(const State& state, Numbers numbers, bool two_sided) {
  const std::size_t all = std::max({values(state, "diffuseColor", 3), values(state, "emissiveColor", 3), std::size_t{1}});
  for (std::size_t& number : numbers) { number %= all; }
  std::sort(numbers.begin(), numbers.end());
  if (numbers.front() == numbers.back()) { numbers.resize(1); }
  const auto next = static_cast<std::uint32_t>(model_.materials.size());
  const auto [known, is_new] = known_.emplace(std::tuple(state.material, state.colors, state.texture, numbers, two_sided), next);
  if (!is_new) { return known->second; }
  model_.materials.push_back(made(state, numbers, all));
  model_.materials.back().two_sided = two_sided;
  return next;
}

ModelMaterial Looks::made(const State& state, const Numbers& numbers, std::size_t all) {
  const auto color = [&](const char* field, const glm::dvec3& otherwise) {
    const std::size_t n = values(state, field, 3);
    if (n == 0) { return otherwise; }
    glm::dvec3 sum(0.0);
    for (const std::size_t number : numbers) {
      const double* const c = &found_in(state, field)->numbers[3 * (number % n)];
      sum += glm::max(glm::dvec3(c[0], c[1], c[2]), glm::dvec3(0.0));
    }
    return sum / static_cast<double>(numbers.size());
  };
  ModelMaterial material;
  material.name = state.material == nullptr      ? "default"
                  : state.material->name.empty() ? "material" + std::to_string(model_.materials.size())
                                                 : state.material->name;
  if (all > 1) { material.name += numbers.size() > 1 ? ".mean" : "." + std::to_string(numbers[0]); }
  const Node* const texture = state.texture;
  const auto& picture = pictures_.of(texture, [&] { return texture != nullptr ? picture_of(*texture, side_file_, notes_) : nullptr; });
  // In VRML 97 a coloured picture replaces the diffuse colour; a grey one is multiplied by it.
  const glm::dvec3 mean = picture ? picture->mean() : glm::dvec3(1.0);
  const bool replaces = picture && texture->version == Version::v97 && !(mean.x == mean.y && mean.y == mean.z);
  material.reflectance = (replaces ? glm::dvec3(1.0) : color("diffuseColor", glm::dvec3(0.8))) * mean;
  material.mirror = mirror_of_highlight(color("specularColor", glm::dvec3(0.0)));
  material.emission = std::numbers::pi * color("emissiveColor", glm::dvec3(0.0));
  if (const std::size_t n = values(state, "transparency", 1); n > 0) {
    const std::size_t first = numbers[0] < n ? numbers[0] : 0;
    material.opacity = 1.0 - std::clamp(state.material->find("transparency")->numbers[first], 0.0, 1.0);
  }
  if (material.opacity < 1.0 && material.opacity >= least_opacity) {
    notes_.add("materials that let light through are taken as opaque", at_line_of(*state.material));
  }
  return material;
}

Looks::Numbers Looks::numbers(const Node& face_set, const State& state, const FaceCorners& of) {
  const Field* const list = face_set.find(face_set.version == Version::v97 ? "colorIndex" : "materialIndex");
  const auto listed = [&](std::size_t i, double otherwise) {
    const double number = list != nullptr && i < list->numbers.size() && list->numbers[i] >= 0.0 ? list->numbers[i] : otherwise;
    return static_cast<std::size_t>(std::min(number, 1e9));
  };
  switch (state.binding) {
    case Binding::per_part:
    case Binding::per_face:
      return {of.face};
    case Binding::per_part_indexed:
    case Binding::per_face_indexed:
      return {listed(of.face, static_cast<double>(of.face))};
    case Binding::per_vertex:
    case Binding::per_vertex_indexed: {
      notes_.add("faces with a material for each corner have the mean of their colours", at_line_of(face_set));
      Numbers numbers;
      for (std::size_t k = 0; k < of.count; ++k) {  // without an index list of their own, colours use the coordinate indices
        const std::size_t i = of.first + k;
        numbers.push_back(state.binding == Binding::per_vertex ? of.before + k : listed(i, of.indices->numbers[i]));
      }
      return numbers;
    }
    default:
      return {0};
  }
}

// --- pictures

namespace {

// Reads a picture from numbers: width, height, components and pixels. Null if a number is invalid.
std::shared_ptr<const intake::Picture> picture_of_image(const std::vector<double>& numbers) {
  const auto whole = [](double x) { return x >= 1.0 && x == std::floor(x); };
  if (numbers.size() < 4 || !std::all_of(numbers.begin(), numbers.begin() + 3, whole) || numbers[2] > 4.0) { return nullptr; }
  const double components = numbers[2];
  const auto bytes = static_cast<std::size_t>(components);
  const double most = std::exp2(8.0 * components) - 1.0;
  std::vector<std::uint8_t> rgba;
  for (std::size_t i = 3; i < numbers.size(); ++i) {
    if (!(numbers[i] >= 0.0 && numbers[i] <= most) || numbers[i] != std::floor(numbers[i])) { return nullptr; }
    const auto pixel = static_cast<std::uint32_t>(numbers[i]);
    const auto component = [&](std::size_t k) { return static_cast<std::uint8_t>(pixel >> (8 * (bytes - 1 - k)) & 0xff); };
    const bool grey = bytes < 3;
    const std::uint8_t opaque = bytes % 2 == 0 ? component(bytes - 1) : std::uint8_t{255};
    rgba.insert(rgba.end(), {component(0), component(grey ? 0 : 1), component(grey ? 0 : 2), opaque});
  }
  return intake::Picture::of_pixels(static_cast<std::uint32_t>(rgba.size() / 4), rgba);  // as one row, because only its mean is used
}

}  // namespace

// The pictures of texture nodes: a file beside the scene, or pixels in the field `image`: width, height, number of components (1 grey; 2
// grey, opacity; 3 red, green, blue; 4 red, green, blue, opacity), then one number per pixel, with its first component in the highest
// byte. A surface has the mean of its picture times its diffuse colour.
std::shared_ptr<const intake::Picture> picture_of(const Node& texture, const SideFile& side_file, Notes& notes) {
  const Field* const image = texture.find("image");
  const std::string_view url = texture.word(texture.version == Version::v97 ? "url" : "filename", "");
  const bool inside = image != nullptr && image->numbers.size() >= 2 && image->numbers[0] * image->numbers[1] != 0.0;
  if (!inside && url.empty()) { return nullptr; }  // ends the effect of an earlier picture
  std::string fault;
  std::shared_ptr<const intake::Picture> picture;
  if (inside) {
    picture = picture_of_image(image->numbers);
  } else if (const std::string name = name_beside(texture.file, url); !name.empty()) {
    if (const auto bytes = side_file(name, fault)) { picture = intake::Picture::read(*bytes); }
  }
  notes.add(
      picture ? "pictures on surfaces count with their mean colour" : "textures are not read: the diffuse colour stands for the picture",
      at_line_of(texture));
  return picture;
}

}  // namespace apps::vrml
