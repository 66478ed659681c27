// SPDX-License-Identifier: MIT
#include <radiosity/direct/direct_light.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>

#include <raycast/box.hpp>
#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/hierarchy/curved_area.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

namespace detail {

// How far facets may be off a curved surface, to the object's diameter; and those of a mesh that stands in for an object.
inline constexpr double facet_tolerance = 0.002;
inline constexpr double stand_in_tolerance = 0.0004;
inline constexpr unsigned lamp_samples = 256;

// A rectangle around points of a plane with this normal.
[[nodiscard]] HALFLIGHT_INLINE std::array<glm::dvec3, 4> rectangle_around(const Facets& facets, const glm::dvec3& n) {
  const glm::dvec3 origin = facets.facets[0].contour[0];
  const glm::dvec3 u = glm::normalize(facets.facets[0].contour[1] - origin);
  const glm::dvec3 v = glm::cross(n, u);
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  for (const Facets::Facet& facet : facets.facets) {
    for (const glm::dvec3& p : facet.contour) {
      const double x = glm::dot(p - origin, u);
      const double y = glm::dot(p - origin, v);
      u0 = std::min(u0, x), u1 = std::max(u1, x), v0 = std::min(v0, y), v1 = std::max(v1, y);
    }
  }
  return {origin + u0 * u + v0 * v, origin + u1 * u + v0 * v, origin + u1 * u + v1 * v, origin + u0 * u + v1 * v};
}

// Points even over the area of the facets: Sobol's, mapped to the facets' triangles laid side by side.
[[nodiscard]] HALFLIGHT_INLINE std::vector<DirectLight::Sample> samples_of(const Facets& facets) {
  struct Triangle {
    glm::dvec3 a{0.0}, b{0.0}, c{0.0}, normal{0.0};
  };
  std::vector<Triangle> triangles;
  std::vector<double> until;  // cumulated area
  double total = 0.0;
  for (const Facets::Facet& facet : facets.facets) {
    for (std::size_t i = 1; i + 1 < facet.contour.size(); ++i) {
      const Triangle t{facet.contour[0], facet.contour[i], facet.contour[i + 1], facet.normal};
      total += 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
      triangles.push_back(t);
      until.push_back(total);
    }
  }
  const Sobol4 sequence{1, 0x6c616d70ull};
  std::vector<DirectLight::Sample> samples;
  for (std::uint32_t k = 0; k < lamp_samples; ++k) {
    const std::array<double, 4> u = sequence(k);
    const double at = u[0] * total;
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(std::upper_bound(until.begin(), until.end(), at) - until.begin()),
                                         triangles.size() - 1);
    const double before = i > 0 ? until[i - 1] : 0.0;
    const double root = std::sqrt(std::clamp((at - before) / (until[i] - before), 0.0, 1.0));
    const Triangle& t = triangles[i];
    samples.push_back({t.a + root * (1.0 - u[1]) * (t.b - t.a) + root * u[1] * (t.c - t.a), t.normal});
  }
  return samples;
}

// A curved object as two meshes of triangles that are open, so that each crossing of a segment decides by itself; none when they make none.
[[nodiscard]] HALFLIGHT_INLINE std::vector<std::shared_ptr<const raycast::Mesh>> open_meshes(const raycast::PlacedObject& object,
                                                                                             double tolerance) {
  brep::Builder builder;
  object.approximate(tolerance, builder);
  std::vector<glm::dvec3> positions;
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) { positions.push_back(builder.position(v)); }
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    const std::span<const std::uint32_t> c = builder.corners(f);
    if (builder.sheet(f) == brep::no_sheet) { continue; }
    if (c.size() > 4) { faces.emplace_back(c.begin(), c.end()); }
    for (std::size_t i = 1; i + 1 < c.size() && c.size() <= 4; ++i) { faces.push_back({c[0], c[i], c[i + 1]}); }
  }
  const auto middle = faces.begin() + static_cast<std::ptrdiff_t>(faces.size() / 2);
  const auto first = raycast::Mesh::make(positions, {faces.begin(), middle});
  const auto second = raycast::Mesh::make(positions, {middle, faces.end()});
  if (!first || !second) { return {}; }
  return {first.object, second.object};
}

[[nodiscard]] HALFLIGHT_INLINE double area_of(const Facets& facets) {
  return std::accumulate(facets.facets.begin(), facets.facets.end(), 0.0, [](double sum, const Facets::Facet& f) { return sum + f.area; });
}

}  // namespace detail

HALFLIGHT_INLINE DirectLight::Lamp DirectLight::make_lamp(const Surface& surface, std::uint32_t sheet, const Color& exitance) {
  const raycast::PlacedObject& object = *surface.object;
  Lamp lamp;
  lamp.surface = surface.first_surface + sheet;
  lamp.exitance = exitance;
  lamp.facets = object.exact() ? facets_of(surface, sheet) : facets_of(object, detail::facet_tolerance * object.bounds().diameter(), sheet);
  if (lamp.facets.empty()) { return lamp; }
  const Facets::Facet& first = lamp.facets.facets[0];
  lamp.flat = object.flat() && std::all_of(lamp.facets.facets.begin(), lamp.facets.facets.end(),
                                           [&](const Facets::Facet& f) { return glm::dot(f.normal, first.normal) > 1.0 - 1e-12; });
  raycast::Box box;
  double true_area = 0.0;
  for (const Facets::Facet& facet : lamp.facets.facets) {
    for (const glm::dvec3& p : facet.contour) { box.extend(p); }
    true_area += object.flat() ? facet.area : curved_area(object, sheet, facet.contour);
  }
  lamp.correction = true_area / detail::area_of(lamp.facets);
  lamp.centre = box.centre();
  for (const Facets::Facet& facet : lamp.facets.facets) {
    for (const glm::dvec3& p : facet.contour) { lamp.radius = std::max(lamp.radius, glm::length(p - lamp.centre)); }
  }
  if (lamp.flat) {
    lamp.corners = detail::rectangle_around(lamp.facets, first.normal);
  } else {
    const auto& c = first.contour;
    lamp.corners = {c[0], c[1], c[2], c[c.size() > 3 ? 3 : 2]};
    lamp.bulge = 2.0 * lamp.radius;
  }
  lamp.samples = detail::samples_of(lamp.facets);
  return lamp;
}

HALFLIGHT_INLINE DirectLight::DirectLight(const raycast::Scene& objects, const std::vector<Surface>& surfaces,
                                          const std::vector<Color>& emission, const LampLimits& limits)
    : objects_{&objects}, is_lamp_(emission.size(), false), bodies_(objects.size()) {
  struct Candidate {
    std::uint32_t object = 0;
    std::uint32_t sheet = 0;
    double strength = 0.0, area = 0.0;
  };
  for (std::uint32_t o = 0; o < objects.size(); ++o) { slack_ = std::max(slack_, 2.0 * objects.object(o).slack()); }
  std::vector<Candidate> candidates;
  double total = 0.0;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    std::vector<double> area(surfaces[s].object->sheet_count(), 0.0);
    for (const brep::FaceId f : brep::faces(surfaces[s].brep)) {
      const std::uint32_t sheet = surfaces[s].brep.data(f).sheet;
      if (sheet != brep::no_sheet) { area[sheet] += glm::length(vector_area(corner_polygon(surfaces[s].brep, f))); }
    }
    for (std::uint32_t sheet = 0; sheet < area.size(); ++sheet) {
      total += area[sheet];
      const Color& e = emission[surfaces[s].first_surface + sheet];
      if (!is_black(e) && area[sheet] > 0.0) { candidates.push_back({s, sheet, std::max({e.x, e.y, e.z}), area[sheet]}); }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
  double taken = 0.0;
  for (const Candidate& c : candidates) {
    if (lamps_.size() == limits.most) { break; }
    const Surface& surface = surfaces[c.object];
    Lamp lamp = make_lamp(surface, c.sheet, emission[surface.first_surface + c.sheet]);
    if (lamp.facets.empty()) { continue; }
    if (!lamp.flat) {
      taken += c.area;
      if (taken > limits.most_curved * total) { continue; }
    }
    lamp.object = c.object;
    is_lamp_[lamp.surface] = true;
    lamps_.push_back(std::move(lamp));
  }
  if (lamps_.empty()) { return; }
  take_bodies(surfaces);
  for (Lamp& lamp : lamps_) {
    lamp.behind.assign(objects.size(), false);
    const Facets::Facet& plane = lamp.facets.facets[0];
    for (std::uint32_t o = 0; o < bodies_.size() && lamp.flat; ++o) {
      lamp.behind[o] = std::any_of(bodies_[o].facets.facets.begin(), bodies_[o].facets.facets.end(), [&](const Facets::Facet& f) {
        return std::any_of(f.contour.begin(), f.contour.end(), [&](const glm::dvec3& p) { return plane.height(p) < -slack_; });
      });
    }
  }
}

HALFLIGHT_INLINE void DirectLight::take_bodies(const std::vector<Surface>& surfaces) {
  constexpr std::size_t most_facets = 200'000, most_of_one = 4096;
  std::size_t facets = 0;
  std::vector<raycast::PlacedObject> objects, second_halves;
  for (std::uint32_t o = 0; o < objects_->size(); ++o) {
    const raycast::PlacedObject& object = objects_->object(o);
    Body& body = bodies_[o];
    objects.push_back(object);
    if (object.inside()) { rooms_.push_back(o); }
    if (facets > most_facets) { continue; }
    body.closed = object.solid();
    body.convex = object.convex() && !object.inside();
    body.exact = object.exact();
    body.bounds = object.bounds();
    if (body.exact) {
      if (radiating_faces(surfaces[o]) <= most_of_one) { body.facets = facets_of(surfaces[o]); }
    } else if (body.convex) {
      body.facets = facets_of(object, detail::facet_tolerance * object.bounds().diameter());
    }
    facets += body.facets.facets.size();
    if (body.exact || object.inside() || (body.convex && object.object().nearest())) { continue; }
    const double tolerance = detail::stand_in_tolerance * object.bounds().diameter();
    const auto halves = detail::open_meshes(object, tolerance);
    if (halves.empty()) { continue; }
    objects.back() = raycast::PlacedObject{halves[0]};
    second_halves.emplace_back(halves[1]);
    whole_.push_back(o);
    body.lift = 1.5 * tolerance;
    facets += halves[0]->sheet_count() + halves[1]->sheet_count();
  }
  if (whole_.empty()) { return; }
  objects.insert(objects.end(), second_halves.begin(), second_halves.end());
  with_stand_ins_ = std::make_shared<raycast::Scene>(std::move(objects));
  objects_ = with_stand_ins_.get();
}

}  // namespace radiosity
