// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include <glm/geometric.hpp>

#include "apps/intake/to_scene.hpp"
#include "apps/mesh_file.hpp"
#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps {
std::span<const ModelFormat* const> model_formats() {
  static constexpr std::array formats{&intake::obj, &intake::gltf, &intake::glb, &intake::ply,
                                      &intake::off, &intake::stl,  &intake::wrl, &intake::mgf_format};
  return formats;
}

std::string model_endings() {
  std::vector<std::string_view> endings;
  for (const ModelFormat* const format : model_formats()) { endings.push_back(format->ending); }
  return list_of(endings);
}

const ModelFormat* model_format(std::string_view path, std::string_view bytes) {
  if (has_ending(path, ".wrz")) { return &intake::wrl; }
  if (has_ending(path, ".gz")) { path.remove_suffix(3); }
  for (const ModelFormat* const format : model_formats()) {
    if (path == "-" ? format->begins(bytes) : has_ending(path, format->ending)) { return format; }
  }
  return nullptr;
}

bool usable(const radiosity::Camera& camera) {
  const auto in_reach = [](const glm::dvec3& v) { return glm::length(v) <= max_number; };  // false for NaN
  const double sine = glm::length(glm::cross(camera.forward, camera.up));
  return in_reach(camera.eye) && in_reach(camera.forward) && in_reach(camera.up) &&
         sine > 1e-9 * glm::length(camera.forward) * glm::length(camera.up) && camera.field_of_view >= 0.001 &&
         camera.field_of_view <= 179.0;
}

void Model::begin_part(const std::string& name) {
  if (!parts.empty() && parts.back().first_polygon == polygons()) { parts.pop_back(); }
  if (name != (parts.empty() ? std::string() : parts.back().name)) { parts.push_back({static_cast<std::uint32_t>(polygons()), name}); }
}

void Model::name_file(const std::string& name) {
  for (ModelPart& part : parts) {
    if (part.name.empty()) { part.name = name; }
  }
  if (parts.empty() || parts.front().first_polygon > 0) { parts.insert(parts.begin(), ModelPart{0, name}); }
}

std::string Model::place(std::uint32_t polygon) const {
  const auto after =
      std::upper_bound(parts.begin(), parts.end(), polygon, [](auto p, const ModelPart& part) { return p < part.first_polygon; });
  const ModelPart part = after == parts.begin() ? ModelPart{} : *(after - 1);
  if (polygon < line.size() && line[polygon] > 0) {
    return "at line " + std::to_string(line[polygon]) + (part.name.empty() ? "" : " of " + part.name);
  }
  const std::size_t end = after == parts.end() ? polygons() : after->first_polygon;
  return "at polygon " + std::to_string(polygon - part.first_polygon + 1) + " of " + std::to_string(end - part.first_polygon) +
         (part.name.empty() ? "" : " in " + part.name);
}

std::vector<std::string> Notes::take() const {
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [sentence, entry] : entries_) {
    std::string text = sentence;
    if (entry.count > 1) { text += ", " + std::to_string(entry.count) + " times"; }
    if (!entry.place.empty()) { text += (entry.count > 1 ? ", first " : ", ") + entry.place; }
    sorted.emplace_back(entry.number, std::move(text));
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::string> sentences;
  for (auto& [number, text] : sorted) { sentences.push_back(std::move(text)); }
  return sentences;
}

// --- options of the command line about files of other formats

namespace {

std::optional<double> positive(std::string_view text, bool zero) {
  const auto value = number_in<double>(text);
  return value && (*value > 0.0 || (zero && *value == 0.0)) && *value <= 1e12 ? value : std::nullopt;
}

}  // namespace

std::string ModelOptions::key() const {
  std::string text = formatted("%.17g", reflectance) + formatted(" %.17g", metres) + (two_sided ? " two-sided" : "") +
                     (merge ? "" : " as given") + (opaque ? " opaque" : "") + (lamps_wanted ? "" : " unlit");
  if (up) { text += " up " + std::to_string(static_cast<int>(*up)); }
  for (const Lamp& lamp : lamps) { text += " lamp " + lamp.material + formatted("=%.17g", lamp.exitance); }
  return text;
}

std::optional<Lamp> parse_lamp(std::string_view text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string_view::npos) { return text.empty() ? std::nullopt : std::optional(Lamp{std::string(text)}); }
  const auto value = positive(text.substr(equals + 1), true);
  if (!value || equals == 0) { return std::nullopt; }
  return Lamp{std::string(text.substr(0, equals)), *value};
}

std::optional<double> parse_unit(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 6> units{
      {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"km", 1e3}, {"in", 0.0254}, {"ft", 0.3048}}};
  for (const auto& [name, metres] : units) {
    if (name == text) { return metres; }
  }
  return positive(text, false);
}

}  // namespace apps
