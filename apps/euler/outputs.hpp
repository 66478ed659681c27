// SPDX-License-Identifier: MIT
#pragma once

// Writes steps as SVG (one drawing for the page, the strip of all steps for print) and the page.
//
// Edges are dark, new elements red, the arguments of the step blue. Beside each edge are its two half-edges, each a half arrow on its
// left side, in the face to which it belongs. The background of a panel is the outer face. A dashed edge is one end of an edge that is
// cut open to draw a handle in the plane; the other end has the same name at its tip.

#include <cstdint>
#include <string>
#include <vector>

#include "apps/euler/layout.hpp"
#include "apps/euler/story.hpp"

namespace apps::euler {

// A pale colour for each face; multiples of the golden angle give consecutive faces different hues.
[[nodiscard]] std::string tint(std::uint32_t face);

// The layouts of all frames; each depends on the one before.
[[nodiscard]] std::vector<Layout> lay_out(const Story& story, double smallest);

// The style sheet of the drawings.
[[nodiscard]] std::string drawing_style();

// The drawing of frame `i` in a square of this width: an SVG group around the origin.
[[nodiscard]] std::string drawing(const Story& story, std::size_t i, const Layout& layout, double width);

// A grid of cells, one for each step, with caption, operator, counts and both sides of the equation.
[[nodiscard]] std::string strip(const Story& story);

// The last frame as a file of its own.
[[nodiscard]] std::string picture(const Story& story, const Layout& layout);

// --- the solid of a step in space (solid_view.cpp), if the script has positions of vertices in comment lines
//
//     #@ v0 0 0 0  v1 1 0 0
//
// which are not captions. A script is purely topological; the coordinates are only for display.

// Reads the coordinates and blanks their lines, so that the positions of statements do not change. An invalid coordinate line remains a
// comment.
[[nodiscard]] Coordinates take_coordinates(std::string& text);

// An SVG group around the origin, in a square of this width; empty if no vertex of the step has coordinates. Faces and edges with a
// vertex without coordinates are left out.
[[nodiscard]] std::string solid_view(const Frame& frame, const Coordinates& coordinates, double width);

// The stepper: one page that shows a script step by step, without network or libraries, also from a file. It contains all drawings and
// records as data; its script shows one step, marks the fields that the step changed, and animates elements that both pictures have.
// `#step=12` in the address opens that step.
[[nodiscard]] std::string page(const Story& story);

}  // namespace apps::euler
