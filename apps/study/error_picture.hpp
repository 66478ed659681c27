// SPDX-License-Identifier: MIT
#pragma once

// Shows where a method errs: the cells of the reference in the scene's view, coloured by their error. Too dark is blue, too bright
// orange, correct is white: colour-blind readers can distinguish these, and in greyscale print the blue end is darker than the orange
// one. All pictures of a scene have the same scale. Grey: surfaces that emit, and the background. Dark lines are creases and outlines.

#include <radiosity/camera/mesh_picture.hpp>

#include "apps/study/drawing.hpp"
#include "apps/study/results.hpp"

namespace study {

// The error at both ends of the scale: the smallest of 1, 2, 5, 10, ... that 98 % of the cells of all pictures do not exceed.
[[nodiscard]] double error_limit(const SceneStudy& scene);

// The colour of an error; `part` is the error divided by the limit, clamped to -1..1.
[[nodiscard]] Srgb error_color(double part);

// Without scale and text; `width` in pixels, height by the camera's aspect ratio. Cells must be convex.
[[nodiscard]] radiosity::Picture error_picture(const ErrorPicture& errors, const radiosity::Camera& camera, double limit,
                                               std::uint32_t width);

// The scale with its labels.
[[nodiscard]] Drawing error_scale(double limit);

// A complete figure: method and setting above the picture, the scale below it.
[[nodiscard]] Drawing error_figure(const ErrorPicture& errors, const radiosity::Camera& camera, double limit);

}  // namespace study
