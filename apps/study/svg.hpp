// SPDX-License-Identifier: MIT
#pragma once

// A drawing as SVG 1.1: self-contained, text stays text, coordinates to 1/100 pixel. Pictures are named as in SVG 2, by href without xlink.
//
// Colours are attributes and not a style sheet, so that every program reads them; a page that wants other colours in the dark selects
// them by their value, as in  svg [fill="#222222"] { fill: white }.

#include <string>
#include <string_view>

#include "apps/study/drawing.hpp"

namespace study {

// The <svg> element, to stand in a page; `description` is what a screen reader says.
[[nodiscard]] std::string to_svg(const Drawing& drawing, const std::string& description);

// How wide a line of UTF-8 text is at most when it is drawn, bold apart, which is up to an eighth wider.
[[nodiscard]] double text_width(std::string_view text, double size);

// A file of its own.
[[nodiscard]] std::string to_svg_file(const Drawing& drawing, const std::string& description);

}  // namespace study
