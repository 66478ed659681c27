// SPDX-License-Identifier: MIT
#pragma once

// A drawing as data: shapes, labels and images in drawing order; later ones cover earlier ones. plot.hpp and error_picture.hpp make
// drawings; to_svg() writes one as SVG 1.1: text remains text, coordinates are rounded to 1/100 pixel; images are referenced as in SVG 2,
// by href without xlink.
//
// Units are CSS pixels; x to the right, y down. Colours are attributes, not a style sheet, so that every program can read them. Three of
// them have a meaning: a page replaces them in dark mode by their values, as in  svg [fill="#222222"] { fill: white }.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>

namespace study {

using Srgb = std::uint32_t;  // 0xrrggbb, sRGB

inline constexpr Srgb ink = 0x222222;    // text and axes
inline constexpr Srgb paper = 0xffffff;  // the background
inline constexpr Srgb faint = 0xdddddd;  // grid lines

// A polygon or a polyline.
struct Shape {
  std::vector<glm::dvec2> points = {};
  bool closed = false;
  bool filled = false;
  Srgb fill = paper;
  double stroke_width = 0.0;  // 0: no outline
  Srgb stroke = ink;
  std::vector<double> dashes = {};  // lengths on, off, on, ...; empty: solid
  double opacity = 1.0;
  std::string title = {};  // tooltip shown by a browser
};

enum class Anchor { start, middle, end };

// One line of text; `at` is on its baseline.
struct Label {
  glm::dvec2 at{0.0};
  std::string text;  // UTF-8
  double size = 12.0;
  Anchor anchor = Anchor::start;
  Srgb color = ink;
  bool bold = false;
  bool upright = true;  // horizontal; otherwise it runs from bottom to top
};

// An image, scaled to fill a rectangle.
struct Image {
  glm::dvec2 low{0.0};  // the upper left corner
  double width = 0.0;
  double height = 0.0;
  std::string png;  // the bytes of the PNG file
};

struct Drawing {
  double width = 0.0;
  double height = 0.0;
  std::vector<std::variant<Shape, Label, Image>> items;

  Shape& add(Shape shape) { return std::get<Shape>(items.emplace_back(std::move(shape))); }
  Label& add(Label label) { return std::get<Label>(items.emplace_back(std::move(label))); }
  Image& add(Image image) { return std::get<Image>(items.emplace_back(std::move(image))); }
};

[[nodiscard]] inline Shape line(const glm::dvec2& from, const glm::dvec2& to, double width, Srgb color = ink) {
  return {.points = {from, to}, .stroke_width = width, .stroke = color};
}

[[nodiscard]] inline Shape rectangle(const glm::dvec2& low, const glm::dvec2& high, Srgb fill) {
  return {.points = {low, {high.x, low.y}, high, {low.x, high.y}}, .closed = true, .filled = true, .fill = fill};
}

// An upper limit for the width of a line of UTF-8 text; bold text may be up to an eighth wider.
[[nodiscard]] double text_width(std::string_view text, double size);

// The <svg> element for a page, and a complete file; `description` is for screen readers.
[[nodiscard]] std::string to_svg(const Drawing& drawing, const std::string& description);
[[nodiscard]] std::string to_svg_file(const Drawing& drawing, const std::string& description);

}  // namespace study
