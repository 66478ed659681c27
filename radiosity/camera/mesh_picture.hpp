// SPDX-License-Identifier: MIT
#pragma once

// Draws the triangles of the solution's mesh, Gouraud-shaded from their half-edge colours (paper 4.5), with a z-buffer. No light is
// computed here, so a further view is cheap.
//
//   coverage  Every pixel has samples x samples sample points on a regular grid. Vertices are snapped to 1/4096 of their
//             distance and edge functions are integers with a top-left rule: triangles that share an edge leave no gap
//             and cover no sample twice. Back faces are not drawn, so one looks into a room from outside.
//   depth     1/z is evaluated from the plane of the triangle in view space, not interpolated, so coplanar surfaces of
//             different triangulation agree to rounding; within 1e-7 the later input surface wins (a lamp in a ceiling).
//   colour    Radiosity is linear over the triangle in space (perspective-correct). Each sample is exposed and clamped
//             to [0,1], then the samples of a pixel are averaged in linear light, then encoded: the edge of a lamp that
//             is a hundred times too bright stays as smooth as any other.

#include <atomic>
#include <optional>

#include <radiosity/camera/picture.hpp>
#include <radiosity/camera/tone.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

// Draws the mesh on a black background. Nothing when `cancel` became true.
[[nodiscard]] std::optional<Picture> draw(const Mesh& mesh, const View& view, const Tone& tone, unsigned samples = 4,
                                          const std::atomic<bool>* cancel = nullptr);

// The exposure that maps the 98th percentile of the visible luminance to 0.8 in linear light: lit walls are bright, and there is room
// above for places close to a lamp. What emits more than it reflects does not count, unless it is paint that glows and fills more of the
// picture than all other paint. If nothing visible reflects more than it emits, the brightest visible emission is mapped to 1; if nothing visible emits either, the result is 1. The light is that of the mesh, so that all methods
// use the same exposure.
[[nodiscard]] double automatic_exposure(const Mesh& mesh, const Scene& scene, const View& view);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/camera/mesh_picture.cpp>
#endif
