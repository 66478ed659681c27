// SPDX-License-Identifier: MIT
#pragma once

// The solver for renderers: triangles go in, the light on their corners and vertices comes out, in the order of the input.
//
//     const radiosity::MeshView mesh{.positions = xyz, .indices = triangles, .materials = materials, .material = of_each_triangle};
//     const radiosity::BakeOutcome outcome = radiosity::bake(mesh);
//     if (!outcome.baked) { ... outcome.failure.sentences ... }
//     upload(outcome.baked->colors.vertex);
//
// Units: positions in metres; only the ratios of lengths matter to the light. Reflectances and colours are linear, three channels, no sRGB.
// Emission and radiosity are exitances in W/m2, over all directions of the side that is seen; the radiance of a surface is B / pi, the
// irradiance that it receives is (B - E) / reflectance. Counter-clockwise corners are seen from the front; what then shows its back to
// all light, or shines into a surface close before it, is turned (intake.hpp), and Baked::changes says so. Which side is up does not
// matter.
//
// A run ends early with the best that it has when Control::cancel becomes true, after Options::time (BF-refinement), or for lack of
// Options::memory; see there.
//
// The input is repaired and merged as intake.hpp tells, and nothing of it is kept. What was changed comes back as sentences. Nothing is
// printed or thrown; the result does not depend on the number of threads.

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

// Buffers of the caller, as graphics interfaces have them.
struct MeshView {
  std::span<const float> positions;        // x y z of each vertex, metres
  std::span<const std::uint32_t> indices;  // three a triangle
  std::span<const Material> materials;
  std::span<const std::uint32_t> material = {};  // of each triangle: an index into materials; empty: all have the first one
  std::uint32_t stride = 3;                      // floats from one vertex to the next
};

struct BakeOptions {
  Options solve;  // accuracy, threads, memory
  IntakeOptions intake;
  AnyRayCaster rays = {};  // of your own (own_rays.hpp): asked in place of ours
};

struct Baked {
  BakedColors colors;
  BakedLight light;  // between the corners, too
  // How wrong it is, how long it took, what was left out. audit.interrupted: the best until it was cancelled; audit.shortage: the best
  // within the memory that there was; audit.coarsened: with larger thresholds than asked for.
  Audit audit;
  std::vector<Change> changes;
  std::size_t faces = 0;  // of the scene that was solved
};

struct BakeOutcome {
  std::optional<Baked> baked;
  Failure failure;  // when there is nothing
};

[[nodiscard]] BakeOutcome bake(const MeshView& mesh, const BakeOptions& options = {}, const Control& control = {});

// The same for polygons with any number of corners.
[[nodiscard]] BakeOutcome bake(const PolygonView& mesh, std::span<const Material> materials, const BakeOptions& options = {},
                               const Control& control = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/bake/bake.cpp>
#endif
