// SPDX-License-Identifier: MIT
#include "apps/intake/polygon_colors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/camera/tone.hpp>
#include <radiosity/support/draw.hpp>

namespace apps::intake {
namespace {

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t many_colors = 256;  // per material

// A colour in sRGB, quantized to `steps` steps from 0 to 1.
using Levels = std::array<std::uint8_t, 3>;
Levels levels(const radiosity::Color& color, double steps) {
  Levels out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double linear = std::clamp(color[static_cast<int>(k)], 0.0, 1.0);
    // NaN fails this comparison.
    out[k] = linear > 0.0 ? static_cast<std::uint8_t>(std::lround(steps * radiosity::srgb_encode(linear))) : std::uint8_t{0};
  }
  return out;
}
radiosity::Color color_of(const Levels& levels, double steps) {
  radiosity::Color color(0.0);
  for (std::size_t k = 0; k < 3; ++k) { color[static_cast<int>(k)] = radiosity::srgb_decode(levels[k] / steps); }
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
    double area = 0.0, within = 0.0, squares = 0.0;
    radiosity::Color sum{0.0};
    [[nodiscard]] radiosity::Color mean() const { return sum / area; }
    [[nodiscard]] bool by_polygon() const { return squares - area * glm::dot(mean(), mean()) > within; }
  };
  std::vector<Spread> spread(pictures_.size());
  struct Shown {
    std::uint32_t polygon;
    radiosity::Color mean;
    bool dark;  // of a picture of emission
  };
  std::vector<Shown> parts;
  for (std::uint32_t p = 0; p < model.polygons(); ++p) {
    const std::uint32_t material = model.material[p], first = model.first_corner[p], end = model.first_corner[p + 1];
    if (material >= pictures_.size() || !pictures_[material][which].picture || end > places_.size()) { continue; }
    const Picture& picture = *pictures_[material][which].picture;
    Picture::Part all{.dark = true};
    double area = 0.0, known = 0.0;
    for (std::uint32_t c = first + 1; c + 1 < end; ++c) {
      const auto at = [&](std::uint32_t corner) { return model.positions[model.corners[corner]]; };
      const double size = radiosity::triangle_area(at(first), at(c), at(c + 1));
      area += size;
      const glm::dvec2 a(places_[first]), b(places_[c]), d(places_[c + 1]);
      if (!std::isfinite(a.x + a.y + b.x + b.y + d.x + d.y) || !(size > 0.0)) { continue; }
      const Picture::Part part = picture.on_triangle(a, b, d);
      all.mean += size * part.mean;
      all.variance += size * (part.variance + glm::dot(part.mean, part.mean));
      all.dark = all.dark && part.dark;
      known += size;
    }
    if (!(known > 0.0) || !std::isfinite(area)) { continue; }
    all.mean /= known;
    parts.push_back({p, all.mean, of == Of::emission && all.dark});
    if (parts.back().dark) { continue; }
    Spread& of_material = spread[material];
    of_material.area += area;
    of_material.sum += area * all.mean;
    of_material.squares += area * glm::dot(all.mean, all.mean);
    of_material.within += area * std::max(0.0, all.variance / known - glm::dot(all.mean, all.mean));
  }
  for (std::size_t m = 0; m < pictures_.size(); ++m) {
    const auto& [picture, place] = pictures_[m][which];
    if (!picture || m >= model.materials.size()) { continue; }
    notes.add(spread[m].by_polygon() ? "of pictures on surfaces each polygon has the mean colour of its part"
                                     : "pictures on surfaces count with their mean colour",
              place);
    if (spread[m].by_polygon()) { continue; }
    ModelMaterial& material = model.materials[m];
    const radiosity::Color mean = spread[m].area > 0.0 ? spread[m].mean() : picture->mean();
    if (of == Of::emission) { material.emission *= mean; }
    if (of == Of::reflectance) { material.reflectance = material.reflectance.value_or(radiosity::Color(1.0)) * mean; }
  }
  for (const Shown& part : parts) {
    if (part.dark) {
      factors[part.polygon][which] = radiosity::Color(0.0);
    } else if (spread[model.material[part.polygon]].by_polygon()) {
      factors[part.polygon][which] *= part.mean;
    }
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
  std::vector<std::array<std::set<Levels>, 2>> colors(model.materials.size());  // no more than many_colors + 1 of each kind
  for (std::uint32_t p = 0; p < model.polygons(); ++p) {
    for (std::size_t of = 0; of < 2; ++of) {
      std::set<Levels>& known = colors[model.material[p]][of];
      if (known.size() <= many_colors) { known.insert(levels(factors[p][of], 255.0)); }
    }
  }
  std::map<std::tuple<std::uint32_t, Levels, Levels>, std::uint32_t> known;  // the new material for a material and its two colours
  const Levels white = levels(radiosity::Color(1.0), 255.0);
  for (std::uint32_t p = 0; p < model.polygons(); ++p) {
    const std::uint32_t m = model.material[p];
    // A white polygon among coloured ones is really white; if all are white, the program that wrote the file probably knows no colours.
    const bool says_white = is_tinted(p) && !model.materials[m].reflectance && colors[m][0].size() > 1;
    if (levels(factors[p][0], 255.0) == white && levels(factors[p][1], 255.0) == white && !says_white) { continue; }
    const auto steps = [&](std::size_t of) { return colors[m][of].size() > many_colors ? 16.0 : 255.0; };
    const Levels reflected = levels(factors[p][0], steps(0)), emitted = levels(factors[p][1], steps(1));
    const auto [place, is_new] = known.emplace(std::tuple{m, reflected, emitted}, static_cast<std::uint32_t>(model.materials.size()));
    if (is_new) {
      ModelMaterial material = model.materials[m];
      material.mirror = radiosity::Color(0.0);  // what is black in a picture is no mirror
      material.reflectance = material.reflectance.value_or(radiosity::Color(1.0)) * color_of(reflected, steps(0));
      material.emission *= color_of(emitted, steps(1));
      model.materials.push_back(std::move(material));
    }
    model.material[p] = place->second;
  }
}

}  // namespace apps::intake
