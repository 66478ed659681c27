// SPDX-License-Identifier: MIT
#include "apps/intake/polygon_colors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/camera/tone.hpp>

namespace apps::intake {
namespace {

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t many_colors = 256;  // per material

// Two colours in sRGB, quantized to `steps` steps from 0 to 1.
using Levels = std::array<std::uint8_t, 6>;
Levels levels(const std::array<radiosity::Color, 2>& colors, double steps) {
  Levels out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    // NaN fails all comparisons, so the next line handles it.
    const double linear = std::clamp(colors[i / 3][static_cast<int>(i % 3)], 0.0, 1.0);
    out[i] = linear > 0.0 ? static_cast<std::uint8_t>(std::lround(steps * radiosity::srgb_encode(linear))) : std::uint8_t{0};
  }
  return out;
}
radiosity::Color color_of(const Levels& levels, std::size_t first, double steps) {
  radiosity::Color color(0.0);
  for (std::size_t k = 0; k < 3; ++k) { color[static_cast<int>(k)] = radiosity::srgb_decode(levels[first + k] / steps); }
  return color;
}

}  // namespace

void PolygonColors::picture(std::uint32_t material, Of of, std::shared_ptr<const Picture> picture, std::string place) {
  if (!picture) { return; }
  if (pictures_.size() <= material) { pictures_.resize(material + std::size_t{1}); }
  pictures_[material][static_cast<std::size_t>(of)] = {std::move(picture), std::move(place)};
}

void PolygonColors::tint(const Model& model, const radiosity::Color& color) {
  tints_.resize(model.polygons(), radiosity::Color(no_number));
  tints_.back() = color;
}

void PolygonColors::lies_at(const Model& model, std::span<const glm::dvec2> corners) {
  places_.resize(model.corners.size(), glm::vec2(no_number));
  std::copy(corners.begin(), corners.end(), places_.end() - static_cast<std::ptrdiff_t>(corners.size()));
}

// Applies one picture of each material: its mean to the material, or the means of its parts to the polygons.
void PolygonColors::lay(Of of, Model& model, std::vector<Factors>& factors, Notes& notes) const {
  const auto which = static_cast<std::size_t>(of);
  struct Spread {
    double within = 0.0, between = 0.0;
  };
  std::vector<Spread> spread(pictures_.size());
  std::vector<std::pair<std::uint32_t, radiosity::Color>> parts;  // by polygon
  for (std::uint32_t p = 0; p < model.polygons(); ++p) {
    const std::uint32_t material = model.material[p], first = model.first_corner[p], end = model.first_corner[p + 1];
    if (material >= pictures_.size() || !pictures_[material][which].picture || end > places_.size()) { continue; }
    const Picture& picture = *pictures_[material][which].picture;
    Picture::Part all;
    double area = 0.0, known = 0.0;
    for (std::uint32_t c = first + 1; c + 1 < end; ++c) {
      const auto at = [&](std::uint32_t corner) { return model.positions[model.corners[corner]]; };
      const double size = 0.5 * glm::length(glm::cross(at(c) - at(first), at(c + 1) - at(first)));
      area += size;
      const glm::dvec2 a(places_[first]), b(places_[c]), d(places_[c + 1]);
      if (!std::isfinite(a.x + a.y + b.x + b.y + d.x + d.y) || !(size > 0.0)) { continue; }
      const Picture::Part part = picture.on_triangle(a, b, d);
      all.mean += size * part.mean;
      all.variance += size * (part.variance + glm::dot(part.mean, part.mean));
      known += size;
    }
    if (!(known > 0.0) || !std::isfinite(area)) { continue; }
    all.mean /= known;
    const glm::dvec3 distance = all.mean - picture.mean();
    spread[material].within += area * std::max(0.0, all.variance / known - glm::dot(all.mean, all.mean));
    spread[material].between += area * glm::dot(distance, distance);
    parts.emplace_back(p, all.mean);
  }
  std::vector<char> by_polygon(pictures_.size(), 0);
  for (std::size_t m = 0; m < pictures_.size(); ++m) {
    const auto& [picture, place] = pictures_[m][which];
    if (!picture || m >= model.materials.size()) { continue; }
    by_polygon[m] = spread[m].between > spread[m].within ? 1 : 0;
    notes.add(by_polygon[m] != 0 ? "of pictures on surfaces each polygon has the mean colour of its part"
                                 : "pictures on surfaces count with their mean colour",
              place);
    if (by_polygon[m] != 0) { continue; }
    ModelMaterial& material = model.materials[m];
    if (of == Of::emission) { material.emission *= picture->mean(); }
    if (of == Of::reflectance) { material.reflectance = material.reflectance.value_or(radiosity::Color(1.0)) * picture->mean(); }
  }
  for (const auto& [polygon, mean] : parts) {
    if (by_polygon[model.material[polygon]] != 0) { factors[polygon][which] *= mean; }
  }
}

void PolygonColors::apply(Model& model, Notes& notes) {
  if (pictures_.empty() && tints_.empty()) { return; }
  std::vector<Factors> factors(model.polygons(), Factors{radiosity::Color(1.0), radiosity::Color(1.0)});
  const auto is_tinted = [&](std::size_t p) { return p < tints_.size() && !std::isnan(tints_[p].x); };
  for (std::size_t p = 0; p < tints_.size(); ++p) {
    if (is_tinted(p)) { factors[p][0] = tints_[p]; }
  }
  lay(Of::reflectance, model, factors, notes);
  lay(Of::emission, model, factors, notes);
  // The new material for a material and a colour; first used to count the colours.
  std::map<std::pair<std::uint32_t, Levels>, std::uint32_t> known;
  std::vector<std::size_t> colors(model.materials.size(), 0);
  for (std::uint32_t p = 0; p < model.polygons(); ++p) {
    const std::uint32_t m = model.material[p];
    if (colors[m] <= many_colors && known.emplace(std::pair{m, levels(factors[p], 255.0)}, 0).second) { ++colors[m]; }
  }
  known.clear();
  const Levels white = levels({radiosity::Color(1.0), radiosity::Color(1.0)}, 255.0);
  for (std::uint32_t p = 0; p < model.polygons(); ++p) {
    const std::uint32_t m = model.material[p];
    // A white polygon among coloured ones is really white; if all are white, the program that wrote the file probably knows no colours.
    const bool says_white = is_tinted(p) && !model.materials[m].reflectance && colors[m] > 1;
    if (levels(factors[p], 255.0) == white && !says_white) { continue; }
    const double steps = colors[m] > many_colors ? 16.0 : 255.0;
    const Levels color = levels(factors[p], steps);
    const auto [place, is_new] = known.emplace(std::pair{m, color}, static_cast<std::uint32_t>(model.materials.size()));
    if (is_new) {
      ModelMaterial material = model.materials[m];
      material.reflectance = material.reflectance.value_or(radiosity::Color(1.0)) * color_of(color, 0, steps);
      material.emission *= color_of(color, 3, steps);
      model.materials.push_back(std::move(material));
    }
    model.material[p] = place->second;
  }
}

}  // namespace apps::intake
