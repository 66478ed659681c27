// SPDX-License-Identifier: MIT
#pragma once

// Everything of a run that comes before light: the frame, the objects compiled for rays, one BRep per object, and the plan of shortcuts.

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/twins.hpp>
#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/plan.hpp>

namespace radiosity {

struct Prepared {
  Frame frame;
  raycast::Scene objects;         // in the frame
  std::vector<Surface> surfaces;  // unrefined boundary of each object; refers to `objects`
  Plan plan;
};

struct PrepareResult {
  std::optional<Prepared> prepared;
  std::vector<std::string> faults;  // the reasons, if `prepared` is empty
};

// Facets of curved objects need not be smaller than this: a quarter of the width of the smallest patch that refinement would make for the
// sake of form factors. Not for lamps, whose shape is seen in the light of all else. The area of the scene is that of its bounds.
[[nodiscard]] inline double least_facet(const Scene& scene, const Frame& frame, double min_area) {
  const raycast::Box bounds = lit_bounds(scene);
  const glm::dvec3 d = frame.scale * (bounds.hi - bounds.lo);
  return 0.25 * std::sqrt(min_area * 2.0 * (d.x * d.y + d.y * d.z + d.z * d.x));
}

// `min_area`: that of the options, or 0.
[[nodiscard]] inline PrepareResult prepare(const Scene& scene, bool shortcuts = true, double min_area = 0.0) {
  std::vector<std::string> sentences = faults(scene);
  if (!sentences.empty()) { return {std::nullopt, std::move(sentences)}; }
  const std::optional<Frame> frame = make_frame(scene);
  if (!frame) { return {std::nullopt, {"the scene has no finite size"}}; }
  Prepared prepared{*frame, compile(scene, *frame), {}, {}};
  const double least = least_facet(scene, *frame, min_area);
  std::uint32_t first_surface = 0;
  for (std::uint32_t o = 0; o < prepared.objects.size(); ++o) {
    const raycast::Box box = prepared.objects.object(o).bounds();
    if (!(glm::length(box.hi - box.lo) > raycast::tol_vanishing)) {  // the size of the frame is between 1 and 2
      sentences.push_back(
          "object '" + scene.objects[o].name +
          "' is smaller than 1e-12 of the scene: beside the scene's coordinates its shape is lost in rounding; leave it out");
      continue;
    }
    SurfaceResult made = make_surface(prepared.objects.object(o), first_surface, shines(scene, scene.objects[o]) ? 0.0 : least);
    first_surface += prepared.objects.object(o).sheet_count();
    if (made.surface) {
      prepared.surfaces.push_back(std::move(*made.surface));
    } else {
      sentences.push_back("object '" + scene.objects[o].name + "': " + made.fault);
    }
  }
  if (!sentences.empty()) { return {std::nullopt, std::move(sentences)}; }
  prepared.objects.leave_out(copies(prepared.surfaces));
  prepared.plan = make_plan(scene, prepared.surfaces, shortcuts);
  return {std::move(prepared), {}};
}

}  // namespace radiosity
