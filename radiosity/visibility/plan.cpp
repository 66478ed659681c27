// SPDX-License-Identifier: MIT
#include <radiosity/visibility/plan.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/extremes.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/enclosure.hpp>

namespace radiosity {

namespace detail {

// Does everything in the scene lie on one side of every face of this flat object? Then no segment between two
// points of the scene can pass through it. Slack: 1e-9 of the scene.
HALFLIGHT_INLINE bool on_the_hull(const Extremes& scene, const SurfaceBRep& own) {
  for (const brep::FaceId f : brep::faces(own)) {
    if (own.data(f).sheet == brep::no_sheet) { continue; }
    const Polygon polygon = corner_polygon(own, f);
    const glm::dvec3 area = vector_area(polygon);
    if (!(glm::length(area) > 0.0)) { return false; }
    const glm::dvec3 normal = glm::normalize(area);
    if (scene.any_above(polygon[0], normal, 1e-9) && scene.any_above(polygon[0], -normal, 1e-9)) { return false; }
  }
  return true;
}

// Sets what follows from the materials alone.
HALFLIGHT_INLINE void look_at_materials(const Scene& scene, Plan& plan) {
  bool grey = true;
  for (const InputSurface& s : radiosity::surfaces(scene)) {
    const Material& material = scene.materials[s.material];
    plan.lit = plan.lit || !is_black(material.emission);
    plan.reflects = plan.reflects || !is_black(material.reflectance);
    grey = grey && is_grey(material.emission) && is_grey(material.reflectance);
  }
  if (!plan.lit) {
    plan.left_out.push_back({"refinement, links, solver and error estimate", "nothing emits light: B = 0 is exact", "the whole solve"});
  } else if (!plan.reflects) {
    plan.left_out.push_back({"refinement, links, solver and error estimate", "nothing reflects: B = E is exact", "the whole solve"});
  }
  if (grey) {
    plan.channels = 1;
    plan.left_out.push_back({"two colour channels", "every material is grey", "two thirds of the solver's arithmetic"});
  }
}

// Finds the outer surfaces and the objects that can stand between two patches, and whether the scene is closed. Returns whether no room
// can stand between any two patches: a convex room with flat walls cannot, nor can a curved convex one that is the only object.
[[nodiscard]] HALFLIGHT_INLINE bool look_at_objects(const std::vector<Surface>& surfaces, Plan& plan) {
  const Surface* room = nullptr;
  bool holes = false;
  bool rooms_clear = true;
  std::vector<std::uint32_t> sheets;  // flat surfaces that block no segment
  plan.outer.assign(surfaces.size(), false);
  const bool sheets_at_all =
      std::any_of(surfaces.begin(), surfaces.end(), [](const Surface& s) { return s.object->flat() && !s.object->solid(); });
  const Extremes extremes = sheets_at_all ? Extremes{surfaces} : Extremes{};
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    const raycast::PlacedObject& object = *surfaces[o].object;
    if (object.inside() && room == nullptr) { room = &surfaces[o]; }
    rooms_clear = rooms_clear && (!object.inside() || (object.convex() && (object.flat() || surfaces.size() == 1)));
    if (object.inside() && object.convex()) { continue; }
    if (object.flat() && !object.solid() && on_the_hull(extremes, surfaces[o].brep)) {
      plan.outer[o] = true;
      sheets.push_back(o);
      continue;
    }
    holes = holes || !object.solid();
    ++plan.occluders;
  }
  const auto on_room = [&](std::uint32_t o) { return room->object->flat() && lies_on(surfaces[o], {room}); };
  plan.closed =
      room != nullptr ? !holes && std::all_of(sheets.begin(), sheets.end(), on_room) : sheets_at_all && enclosed_by_sheets(surfaces);
  return rooms_clear;
}

// Does light decay in a closed scene, and fast enough to be path-traced?
HALFLIGHT_INLINE void look_at_losses(const Scene& scene, Plan& plan) {
  for (const Material& material : scene.materials) {
    const Color& rho = material.reflectance;
    plan.traceable = plan.traceable && (!plan.closed || brightest(rho) <= 1.0 - 1.0 / most_bounces);
  }
  if (!plan.traceable) {
    plan.left_out.push_back(
        {"the error estimate", "closed and nearly lossless: paths would need thousands of bounces", "minutes of path tracing"});
  }
  for (int c = 0; c < 3; ++c) {
    bool emits = false;
    bool absorbs = false;
    for (const InputSurface& input : radiosity::surfaces(scene)) {
      emits = emits || scene.materials[input.material].emission[c] > 0.0;
      absorbs = absorbs || scene.materials[input.material].reflectance[c] < 1.0;
    }
    plan.lossless = plan.lossless || (plan.closed && emits && !absorbs);
  }
}

}  // namespace detail

HALFLIGHT_INLINE Plan make_plan(const Scene& scene, const std::vector<Surface>& surfaces, bool shortcuts) {
  Plan plan;
  detail::look_at_materials(scene, plan);
  const bool rooms_clear = detail::look_at_objects(surfaces, plan);
  detail::look_at_losses(scene, plan);
  if (const auto outer = std::count(plan.outer.begin(), plan.outer.end(), true); outer > 0) {
    plan.left_out.push_back({"occlusion by " + std::to_string(outer) + " outer surface" + (outer > 1 ? "s" : ""),
                             "the whole scene lies on one side of each", ""});
  }
  if (plan.occluders == 0 && rooms_clear) {
    plan.left_out.push_back({"visibility", "no object can stand between two patches", "every ray"});
  }
  const auto convex = std::count_if(surfaces.begin(), surfaces.end(), [](const Surface& s) { return s.object->convex(); });
  if (convex > 0) {
    plan.left_out.push_back({"the owner rule for " + std::to_string(convex) + " of " + std::to_string(surfaces.size()) + " objects",
                             "convex: a segment between two of their points meets them nowhere else", ""});
  }
  if (!shortcuts) {
    plan.shortcuts = false;
    plan.channels = 3;
    plan.left_out.clear();
  }
  return plan;
}

}  // namespace radiosity
