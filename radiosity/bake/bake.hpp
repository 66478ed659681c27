// SPDX-License-Identifier: MIT
#pragma once

// The solver for renderers: triangles go in; the radiosity at their corners and vertices comes out, in the order of the input.
//
//     const radiosity::MeshView mesh{.positions = xyz, .indices = triangles, .materials = materials, .material = of_each_triangle};
//     const radiosity::BakeOutcome outcome = radiosity::bake(mesh);
//     if (!outcome.baked) { ... outcome.failure.sentences ... }
//     upload(outcome.baked->colors.vertex);
//
// Units: positions in metres; only ratios of lengths matter to the light. Reflectances and colours are linear (not sRGB), three channels.
// Emission and radiosity are exitances in W/m2, over the hemisphere of the visible side: the radiance of a surface is B / pi, the
// irradiance that it receives is (B - E) / reflectance. A triangle shows its front where its corners run counter-clockwise. A part whose
// front faces away from all light, or that shines into a surface close before it, is turned over (intake.hpp), and Baked::changes says
// so. Any axis may point upwards.
//
// A run ends early with the best solution so far when Control::cancel becomes true, after Options::time (BF-refinement only), or when
// Options::memory does not suffice.
//
// The input is repaired and merged as intake.hpp says; Baked::changes lists what was changed. The buffers are not kept. Nothing is
// printed or thrown, and the result does not depend on the number of threads.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <radiosity/bake/baked_light.hpp>
#include <radiosity/bake/own_rays.hpp>
#include <radiosity/intake/intake.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

// Views of the caller's buffers, laid out as in graphics interfaces.
struct MeshView {
  std::span<const float> positions;        // x y z of each vertex, metres
  std::span<const std::uint32_t> indices;  // three a triangle
  std::span<const Material> materials;
  std::span<const std::uint32_t> material = {};  // of each triangle: an index into materials; empty: all triangles have the first one
  std::uint32_t stride = 3;                      // floats from one vertex to the next
};

struct BakeOptions {
  Options solve;  // accuracy, threads, memory
  IntakeOptions intake;
  AnyRayCaster rays = {};  // a ray caster of the caller (own_rays.hpp), used instead of ours
};

struct Baked {
  BakedColors colors;
  BakedLight light;  // the light between the corners, too
  // Error, times and shortcuts of the run. audit.interrupted: cancelled, this is the best solution until then; audit.shortage: this is
  // the best that fits in memory; audit.coarsened: larger thresholds than requested were used.
  Audit audit;
  std::vector<Change> changes;
  std::size_t faces = 0;  // number of faces of the solved scene
};

struct BakeOutcome {
  std::optional<Baked> baked;
  Failure failure;  // reason when `baked` is empty
};

[[nodiscard]] BakeOutcome bake(const MeshView& mesh, const BakeOptions& options = {}, const Control& control = {});

// The same for polygons with any number of corners.
[[nodiscard]] BakeOutcome bake(const PolygonView& mesh, std::span<const Material> materials, const BakeOptions& options = {},
                               const Control& control = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/bake/bake.cpp>
#endif
