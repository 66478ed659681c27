// SPDX-License-Identifier: MIT
#pragma once

// A small font of strokes for pictures made of pixels: lines and smooth curves as a pen draws them, so it has every size.
// It knows ASCII and the signs that plots need; any other character is drawn as an empty box.

#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace study {

using Polyline = std::vector<glm::dvec2>;

// The strokes of a line of UTF-8 text, whose baseline begins at (0, 0); y down. Capitals are .72 `size` high.
[[nodiscard]] std::vector<Polyline> text_strokes(std::string_view text, double size);

[[nodiscard]] double text_width(std::string_view text, double size);

}  // namespace study
