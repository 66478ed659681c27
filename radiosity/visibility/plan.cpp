// SPDX-License-Identifier: MIT
#include <radiosity/visibility/plan.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>

#include <raycast/inline.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/extremes.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

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

// How much of a convex polygon a convex polygon in the same plane covers, both counter-clockwise about `normal`.
HALFLIGHT_INLINE double covered_area(Polygon polygon, const Polygon& cover, const glm::dvec3& normal) {
  Polygon part;
  for (std::size_t i = 0; i < cover.size() && polygon.size() > 2; ++i) {
    const glm::dvec3 inwards = glm::cross(normal, cover[(i + 1) % cover.size()] - cover[i]);
    const double length = glm::length(inwards);
    if (!(length > 0.0)) { continue; }
    part.clear();
    clip_to_horizon(polygon, cover[i], inwards / length, part);
    std::swap(polygon, part);
  }
  return polygon.size() > 2 ? std::max(0.0, glm::dot(normal, vector_area(polygon))) : 0.0;
}

// Does a flat surface lie on the walls of a room and face into it, so that its black back is never seen? The walls in its plane must cover
// it, not their planes alone: a lamp may lie in the plane of a wall and outside the room. Slack: 1e-9 of the scene, off the plane and
// as a strip along the borders.
HALFLIGHT_INLINE bool lies_on_room(const Surface& surface, const Surface& room) {
  if (!room.object->flat()) { return false; }
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    if (surface.brep.data(f).sheet == brep::no_sheet) { continue; }
    const Polygon polygon = corner_polygon(surface.brep, f);
    const glm::dvec3 area = vector_area(polygon);
    const double whole = glm::length(area);
    if (!(whole > 0.0)) { return false; }
    double border = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) { border += glm::length(polygon[(i + 1) % polygon.size()] - polygon[i]); }
    double covered = 0.0;
    for (const brep::FaceId w : brep::faces(room.brep)) {
      const Polygon wall = corner_polygon(room.brep, w);
      const glm::dvec3 wall_area = vector_area(wall);
      if (!(glm::dot(wall_area, area) > 0.999 * glm::length(wall_area) * whole)) { continue; }
      const glm::dvec3 normal = glm::normalize(wall_area);
      const bool in_plane =
          std::all_of(polygon.begin(), polygon.end(), [&](const glm::dvec3& p) { return std::abs(glm::dot(normal, p - wall[0])) <= 1e-9; });
      if (in_plane) { covered += covered_area(polygon, wall, normal); }
    }
    if (covered < whole - 1e-9 * border) { return false; }
  }
  return true;
}

// What the materials alone tell.
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

// Finds the outer surfaces, the objects that can stand between two patches, and whether the scene is closed. Returns whether no room can
// stand between any two patches: a convex room with flat walls cannot, nor can a curved one that is alone.
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
  plan.closed = room != nullptr && !holes &&
                std::all_of(sheets.begin(), sheets.end(), [&](std::uint32_t o) { return lies_on_room(surfaces[o], *room); });
  return rooms_clear;
}

// Whether light that goes round in a closed scene fades, and fast enough to be traced.
HALFLIGHT_INLINE void look_at_losses(const Scene& scene, Plan& plan) {
  for (const Material& material : scene.materials) {
    const Color& rho = material.reflectance;
    plan.traceable = plan.traceable && (!plan.closed || std::max({rho.x, rho.y, rho.z}) <= 1.0 - 1.0 / most_bounces);
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
