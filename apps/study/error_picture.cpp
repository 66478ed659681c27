// SPDX-License-Identifier: MIT
#include "apps/study/error_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/camera/tone.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/material.hpp>

#include "apps/picture_file.hpp"
#include "apps/study/numbers.hpp"

namespace study {
namespace {

constexpr Srgb background = 0xb4b4b4;
constexpr double scale_width = 480.0;
constexpr double scale_height = 62.0;

// The radiosity that draw() shows as exactly this colour at exposure 1: pi times the linear value.
radiosity::Color shown_as(Srgb color) {
  radiosity::Color result(0.0);
  for (int c = 0; c < 3; ++c) { result[c] = std::numbers::pi * radiosity::srgb_decode(((color >> (16 - 8 * c)) & 255U) / 255.0); }
  return result;
}

void add_face(radiosity::Mesh& mesh, const std::vector<glm::dvec3>& corners, const radiosity::Color& color) {
  radiosity::MeshFace face;
  face.first_corner = static_cast<std::uint32_t>(mesh.corners.size());
  face.corner_count = static_cast<std::uint32_t>(corners.size());
  for (const glm::dvec3& p : corners) {
    mesh.corners.push_back({static_cast<std::uint32_t>(mesh.positions.size()), color});
    mesh.positions.push_back(p);
  }
  mesh.faces.push_back(face);
}

glm::dvec3 normal_of(const std::vector<glm::dvec3>& corners) {
  glm::dvec3 area(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) { area += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]); }
  const double length = glm::length(area);
  return length > 0.0 ? area / length : glm::dvec3(0.0);
}

// The cells, each with the colour color(cell), in front of a wall with the background colour that fills the view.
template <class ColorOf>
radiosity::Mesh mesh_of(const ErrorPicture& errors, const radiosity::View& view, const ColorOf& color) {
  radiosity::Mesh mesh;
  double farthest = 0.0;
  for (const ErrorCell& cell : errors.cells) {
    if (cell.corners.size() < 3) { continue; }
    add_face(mesh, cell.corners, color(cell));
    for (const glm::dvec3& p : cell.corners) { farthest = std::max(farthest, view.to_view(p).z); }
  }
  const double z = farthest > 0.0 ? 4.0 * farthest : 1.0;
  const double x = 1.5 * z * view.half_width;
  const double y = 1.5 * z * view.half_height();
  std::vector<glm::dvec3> wall;
  for (const auto& [right, down] : {std::pair{-x, y}, std::pair{x, y}, std::pair{x, -y}, std::pair{-x, -y}}) {
    wall.push_back(view.eye + right * view.right + down * view.down + z * view.forward);
  }
  add_face(mesh, wall, shown_as(background));
  return mesh;
}

// Darkens pixels at a crease or an outline, i.e. those whose neighbours have different normals.
void draw_creases(radiosity::Picture& picture, const radiosity::Picture& normals) {
  const auto differ = [&](std::uint32_t x, std::uint32_t y, std::uint32_t u, std::uint32_t v) {
    const radiosity::Rgb8 a = normals.pixel(x, y);
    const radiosity::Rgb8 b = normals.pixel(u, v);
    int sum = 0;
    for (std::size_t c = 0; c < 3; ++c) { sum += std::abs(int{a[c]} - int{b[c]}); }
    return sum > 48;
  };
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      if ((x == 0 || !differ(x, y, x - 1, y)) && (y == 0 || !differ(x, y, x, y - 1))) { continue; }
      picture.shown[std::size_t{y} * picture.width + x] *= 0.12f;  // about two fifths after encoding
    }
  }
}

// Draws the scale from `top` downwards.
void draw_scale(Drawing& drawing, double top, double limit) {
  constexpr double left = 20.0;
  constexpr double bar = scale_width - 2.0 * left;
  constexpr int steps = 88;
  drawing.height = top + scale_height;
  for (int i = 0; i < steps; ++i) {
    const double x = left + bar * i / steps;
    // Each rectangle extends a little below the next, so that there is no seam.
    drawing.add(rectangle({x, top + 8.0}, {left + bar * std::min<double>(i + 1.2, steps) / steps, top + 22.0},
                          error_color(2.0 * (i + 0.5) / steps - 1.0)));
  }
  for (int i = -2; i <= 2; ++i) {
    const double x = left + bar * (0.5 + 0.25 * i);
    drawing.add(line({x, top + 22.0}, {x, top + 26.0}, 1.0));
    const std::string sign = i > 0 ? "+" : i < 0 ? "−" : "";
    const Anchor anchor = i == -2 ? Anchor::start : i == 2 ? Anchor::end : Anchor::middle;
    drawing.add(Label{.at = {x + (i == -2  ? -12.0
                                  : i == 2 ? 12.0
                                           : 0.0),
                             top + 39.0},
                      .text = (std::abs(i) == 2 ? (i < 0 ? "≤ " : "≥ ") : "") + sign + percent(std::abs(0.5 * i * limit)),
                      .size = 11.0,
                      .anchor = anchor});
  }
  drawing.add(Label{.at = {left - 12.0, top + 55.0}, .text = "too dark", .size = 11.0});
  drawing.add(Label{.at = {0.5 * scale_width, top + 55.0},
                    .text = "error of the cell mean, of the brightest cell",
                    .size = 11.0,
                    .anchor = Anchor::middle});
  drawing.add(Label{.at = {left + bar + 12.0, top + 55.0}, .text = "too bright", .size = 11.0, .anchor = Anchor::end});
}

}  // namespace

double error_limit(const SceneStudy& scene) {
  std::vector<double> sizes;
  for (const ErrorPicture& picture : scene.pictures) {
    for (const ErrorCell& cell : picture.cells) {
      if (std::isfinite(cell.error)) { sizes.push_back(std::abs(cell.error)); }
    }
  }
  if (sizes.empty()) { return 0.01; }
  const auto nth = sizes.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), nth, sizes.end());
  for (int decade = -6; decade < 3; ++decade) {
    for (const double k : {1.0, 2.0, 5.0}) {
      if (k * std::pow(10.0, decade) >= *nth) { return k * std::pow(10.0, decade); }
    }
  }
  return 1000.0;
}

Srgb error_color(double part) {
  static constexpr std::array<Srgb, 7> colors = {0x08306b, 0x2171b5, 0x8dbfe0, 0xf7f7f7, 0xfbc48a, 0xf08432, 0xb33c00};
  if (!std::isfinite(part)) { return background; }
  const double at = (std::clamp(part, -1.0, 1.0) + 1.0) * 3.0;
  const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(at), 5);
  Srgb result = 0;
  for (unsigned shift = 0; shift <= 16; shift += 8) {
    const double a = (colors[i] >> shift) & 255U;
    const double b = (colors[i + 1] >> shift) & 255U;
    result |= static_cast<Srgb>(std::lround(a + (at - static_cast<double>(i)) * (b - a))) << shift;
  }
  return result;
}

radiosity::Picture error_picture(const ErrorPicture& errors, const radiosity::Camera& camera, double limit, std::uint32_t width) {
  const radiosity::PictureSize shape = camera.size.value_or(radiosity::PictureSize{});
  const auto height = static_cast<std::uint32_t>(std::max(1L, std::lround(static_cast<double>(width) * shape.height / shape.width)));
  const radiosity::View view = radiosity::make_view(camera, {width, height});
  const auto by_error = mesh_of(errors, view, [&](const ErrorCell& cell) { return shown_as(error_color(cell.error / limit)); });
  const auto by_normal =
      mesh_of(errors, view, [](const ErrorCell& cell) { return std::numbers::pi * (0.5 + 0.5 * normal_of(cell.corners)); });
  radiosity::Picture picture = *radiosity::draw(by_error, view, 1.0);
  draw_creases(picture, *radiosity::draw(by_normal, view, 1.0, 1));
  return picture;
}

Drawing error_scale(double limit) {
  Drawing drawing;
  drawing.width = scale_width;
  draw_scale(drawing, 0.0, limit);
  return drawing;
}

Drawing error_figure(const ErrorPicture& errors, const radiosity::Camera& camera, double limit) {
  constexpr double density = 1.5;  // pixels of the picture per unit of the drawing
  constexpr double head = 28.0;
  const radiosity::Picture picture = error_picture(errors, camera, limit, static_cast<std::uint32_t>(density * scale_width));
  const double height = picture.height / density;
  Drawing drawing;
  drawing.width = scale_width;
  drawing.add(Label{.at = {8.0, 19.0}, .text = errors.method + ", " + errors.setting, .size = 13.0, .bold = true});
  drawing.add(Image{{0.0, head}, scale_width, height, apps::to_png(picture)});
  draw_scale(drawing, head + height, limit);
  return drawing;
}

}  // namespace study
