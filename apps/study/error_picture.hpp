// SPDX-License-Identifier: MIT
#pragma once

// Where a method errs: the cells of the reference in the scene's view, coloured by their error. Too dark is blue, too bright orange, white
// is right: told apart by colour-blind readers, and in grey print the blue end is darker than the orange one. All pictures
// of a scene have the same scale. Grey: surfaces that emit, and the background. Dark lines are creases and outlines.

#include <radiosity/camera/mesh_picture.hpp>

#include "apps/study/drawing.hpp"
#include "apps/study/results.hpp"

namespace study {

// The error at both ends of the scale: of 1, 2, 5, 10, ... the least that 98 % of the cells of all pictures keep to.
[[nodiscard]] double error_limit(const SceneStudy& scene);

// The colour of an error; `part` is its share of the limit, clamped to -1..1.
[[nodiscard]] Srgb error_color(double part);

// Without scale and words; `width` pixels wide, as high as the camera's picture demands. Cells are convex.
[[nodiscard]] radiosity::Picture error_picture(const ErrorPicture& errors, const radiosity::Camera& camera, double limit,
                                               std::uint32_t width);

// The scale with its words.
[[nodiscard]] Drawing error_scale(double limit);

// As a file of its own: method and setting above, the scale below.
[[nodiscard]] Drawing error_figure(const ErrorPicture& errors, const radiosity::Camera& camera, double limit);

}  // namespace study
