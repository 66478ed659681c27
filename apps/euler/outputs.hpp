// SPDX-License-Identifier: MIT
#pragma once

// Steps as SVG: one drawing for the page, and the strip of all steps for print; and the page.
//
// Edges are dark, what is new red, the arguments of the step blue. Along each edge run its two half-edges, each a half arrow on
// its left side beside the face that it names. The background of a panel is the outer face. A dashed edge is one
// end of an edge that is cut open to lay a handle flat; the other end has the same name in its tip.

#include <cstdint>
#include <string>
#include <vector>

#include "apps/euler/layout.hpp"
#include "apps/euler/story.hpp"

namespace apps::euler {

// A pale colour of its own for each face: the golden angle keeps neighbours in number apart.
[[nodiscard]] std::string tint(std::uint32_t face);

// The layouts of all frames, one after the other.
[[nodiscard]] std::vector<Layout> lay_out(const Story& story, double smallest);

// The classes of the drawings.
[[nodiscard]] std::string drawing_style();

// The drawing of frame `i` in a square of this width: an SVG group around the origin.
[[nodiscard]] std::string drawing(const Story& story, std::size_t i, const Layout& layout, double width);

// A grid of cells, one for each step, with caption, operator, counts and both sides of the equation.
[[nodiscard]] std::string strip(const Story& story);

// The last frame alone, as a file.
[[nodiscard]] std::string picture(const Story& story, const Layout& layout);

// --- the solid of a step in space (solid_view.cpp), where its script says where vertices lie: comment lines
//
//     #@ v0 0 0 0  v1 1 0 0
//
// which are no captions. A script is topology alone; coordinates are for the eye.

// Reads the coordinates and empties their lines, so that the places of statements stay. What is no coordinate is left as a comment.
[[nodiscard]] Coordinates take_coordinates(std::string& text);

// An SVG group around the origin, in a square of this width; empty when the step has no vertex with coordinates. Faces of which a corner
// has none are left out, as are edges.
[[nodiscard]] std::string solid_view(const Frame& frame, const Coordinates& coordinates, double width);

// The stepper: one page that shows a script step by step; no network, no library, works from a file. It holds all drawings and all records
// as data; its own script shows one step, marks the fields that the step changed, and moves what both pictures have. `#step=12` in the
// address opens that step.
[[nodiscard]] std::string page(const Story& story);

}  // namespace apps::euler
