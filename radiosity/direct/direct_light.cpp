// SPDX-License-Identifier: MIT
#include <radiosity/direct/direct_light.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/lamp_samples.hpp>
#include <radiosity/direct/light_vector.hpp>
#include <radiosity/direct/outline_tolerance.hpp>
#include <radiosity/direct/stand_in.hpp>
#include <radiosity/direct/uncovered.hpp>
#include <radiosity/hierarchy/curved_area.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

namespace detail {

// Largest distance of facets from a curved surface, relative to the object's diameter; below, the same for stand-in meshes.
inline constexpr double facet_tolerance = 0.002;
inline constexpr double stand_in_tolerance = 0.0004;
inline constexpr std::size_t samples_of_lamp = 256, samples_of_ball = 128;  // of other bodies half of the samples face a point
// A large lamp gets fine samples, because a point may see only a small part of it; at most most_fine lamps, the brightest ones.
// large_lamp: square root of its area, relative to the scene's diameter. The partial occlusion of a smaller lamp shows only at the edge
// of a shadow.
inline constexpr double large_lamp = 0.25;
inline constexpr std::size_t fine_samples = 4096;
inline constexpr std::size_t most_fine = 4;

// A rectangle around the facets, in a plane with this normal.
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

}  // namespace detail

HALFLIGHT_INLINE DirectLight::Lamp DirectLight::make_lamp(const raycast::Scene& objects, const std::vector<Surface>& surfaces,
                                                          const Candidate& candidate) {
  Lamp lamp;
  lamp.exitance = candidate.exitance;
  raycast::Box box;
  bool flat = true;
  for (const Candidate::OfObject& part : candidate.parts) {
    const Surface& surface = surfaces[part.object];
    const raycast::PlacedObject& object = *surface.object;
    const std::uint32_t sheet = part.sheets[0];
    flat = flat && object.flat();
    Facets facets = part.sheets.size() > 1 ? facets_of(surface, part.sheets)
                    : object.exact()       ? facets_of(surface, sheet)
                                           : facets_for_outline(object, detail::facet_tolerance, sheet);
    cut_out_covered(facets, part.object, objects, surfaces);
    for (const Facets::Facet& facet : facets.facets) {
      for (const glm::dvec3& p : facet.contour) { box.extend(p); }
      lamp.area += object.flat() ? facet.area : curved_area(object, sheet, facet.contour);
    }
    lamp.object_of.insert(lamp.object_of.end(), facets.facets.size(), part.object);
    append(lamp.facets, facets);
    lamp.facets.parts.back().roundness = roundness(lamp.facets, lamp.facets.parts.back());
  }
  lamp.surface = surfaces[candidate.parts[0].object].first_surface + candidate.parts[0].sheets[0];
  lamp.object = candidate.parts.size() == 1 ? candidate.parts[0].object : raycast::no_object;
  if (lamp.facets.empty()) { return lamp; }
  const Facets::Facet& first = lamp.facets.facets[0];
  const bool several = candidate.parts.size() > 1 || candidate.parts[0].sheets.size() > 1;
  lamp.flat =
      flat && std::all_of(lamp.facets.facets.begin(), lamp.facets.facets.end(), [&](const Facets::Facet& f) {
        return glm::dot(f.normal, first.normal) > 1.0 - 1e-12 && (!several || std::abs(first.height(f.contour[0])) < detail::least_slack);
      });
  lamp.correction = lamp.area / area_of(lamp.facets);
  lamp.centre = box.centre();
  for (const Facets::Facet& facet : lamp.facets.facets) {
    for (const glm::dvec3& p : facet.contour) { lamp.radius = std::max(lamp.radius, glm::length(p - lamp.centre)); }
  }
  lamp.width = width_about_longest_edge(lamp.facets, lamp.centre);
  if (lamp.flat) {
    lamp.corners = detail::rectangle_around(lamp.facets, first.normal);
  } else {
    const auto& c = first.contour;
    lamp.corners = {c[0], c[1], c[2], c[c.size() > 3 ? 3 : 2]};
    lamp.bulge = 2.0 * lamp.radius;
  }
  return lamp;
}

HALFLIGHT_INLINE void DirectLight::take_samples(Lamp& lamp, bool fine, std::uint64_t seed) const {
  for (const std::uint32_t o : lamp.object_of) {
    const raycast::PlacedObject& object = objects_->object(o);
    if (bodies_[o].lift > 0.0) {
      lamp.ends.push_back({raycast::no_object, bodies_[o].lift + detail::facet_tolerance * bodies_[o].bounds.diameter()});
    } else {
      lamp.ends.push_back({object.flat() ? raycast::no_object : o, 0.0});
    }
  }
  lamp.ball = lamp.facets.parts.size() == 1 && lamp.facets.parts[0].roundness > 0.0;
  const auto samples = [&](std::size_t count) {
    return lamp.ball ? disk_samples(lamp.ends[0], count, seed) : lamp_samples(lamp.facets, lamp.ends, count, seed);
  };
  lamp.samples = samples(lamp.ball ? detail::samples_of_ball : detail::samples_of_lamp);
  if (lamp.ball) { lamp.rim = rim_samples(lamp.ends[0]); }
  if (fine) { lamp.fine = FineSamples{lamp.samples, samples(detail::fine_samples)}; }
}

HALFLIGHT_INLINE DirectLight::Sheets DirectLight::sheets_of(const std::vector<Surface>& surfaces, const std::vector<Color>& emission) {
  Sheets all;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    std::vector<double> area(surfaces[s].object->sheet_count(), 0.0);
    for (const brep::FaceId f : brep::faces(surfaces[s].brep)) {
      const std::uint32_t sheet = surfaces[s].brep.data(f).sheet;
      if (sheet == brep::no_sheet) { continue; }
      const Polygon corners = corner_polygon(surfaces[s].brep, f);
      area[sheet] += glm::length(vector_area(corners));
      if (!is_black(emission[surfaces[s].first_surface + sheet])) { continue; }
      for (const glm::dvec3& p : corners) { all.dark.extend(p); }
    }
    for (std::uint32_t sheet = 0; sheet < area.size(); ++sheet) {
      all.area += area[sheet];
      const Color& e = emission[surfaces[s].first_surface + sheet];
      if (!is_black(e) && area[sheet] > 0.0) { all.candidates.push_back({{{s, {sheet}}}, e, brightest(e), area[sheet]}); }
    }
  }
  return all;
}

HALFLIGHT_INLINE void DirectLight::set_tolerances(const raycast::Box& dark) {
  const double size = dark.empty() ? 1.0 : std::min(1.0, dark.diameter());
  slack_ = std::max(detail::rounding_slack, detail::least_slack * size);
  std::vector<double> diameters;
  for (std::uint32_t o = 0; o < objects_->size(); ++o) {
    const raycast::Box box = objects_->object(o).bounds();
    if (!dark.empty() && !box.meets(dark)) { continue; }  // a sun
    slack_ = std::max(slack_, 2.0 * objects_->object(o).slack());
    diameters.push_back(box.diameter());
  }
  if (diameters.empty()) { return; }
  constexpr double off_small = 0.01, above_rounding = 1e-12;  // shadows move by a hundredth of a small object, one in 8 being smaller
  const auto small = diameters.begin() + static_cast<std::ptrdiff_t>(diameters.size() / 8);
  std::nth_element(diameters.begin(), small, diameters.end());
  off_surface_ = std::max(above_rounding, std::min(off_surface_ * size, off_small * *small));
}

HALFLIGHT_INLINE void DirectLight::mark_behind(Lamp& lamp) const {
  lamp.behind.assign(true_objects_->size(), false);
  for (std::uint32_t o = 0; o < bodies_.size() && lamp.flat; ++o) {
    lamp.behind[o] = std::any_of(bodies_[o].facets.facets.begin(), bodies_[o].facets.facets.end(), [&](const Facets::Facet& f) {
      return std::any_of(f.contour.begin(), f.contour.end(),
                         [&](const glm::dvec3& p) { return lamp.facets.facets[0].height(p) < -slack_; });
    });
  }
}

HALFLIGHT_INLINE DirectLight::DirectLight(const raycast::Scene& objects, const std::vector<Surface>& surfaces,
                                          const std::vector<Color>& emission, const LampLimits& limits)
    : objects_{&objects}, true_objects_{&objects}, lamp_of_(emission.size(), brep::invalid_index), bodies_(objects.size()) {
  auto [candidates, total, dark] = sheets_of(surfaces, emission);
  set_tolerances(dark);
  if (limits.bodies && candidates.size() > limits.most) { candidates = join_alike(candidates, objects, limits.most); }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
  std::vector<bool> is_fine;  // by lamp
  std::size_t fine_ones = 0;
  double taken = 0.0;
  for (const Candidate& c : candidates) {
    if (lamps_.size() == limits.most) { break; }
    Lamp lamp = make_lamp(objects, surfaces, c);
    if (lamp.facets.empty()) { continue; }
    const bool fine = std::sqrt(c.area) > detail::large_lamp * objects.diameter() && fine_ones < detail::most_fine;
    fine_ones += fine ? 1 : 0;
    if (surrounds(lamp.facets, lamp.centre, detail::least_slack)) {
      taken += c.area;
      if (taken > limits.most_surrounding * total) { continue; }
    }
    for (const Candidate::OfObject& part : c.parts) {
      for (const std::uint32_t sheet : part.sheets) {
        lamp_of_[surfaces[part.object].first_surface + sheet] = static_cast<std::uint32_t>(lamps_.size());
      }
    }
    lamps_.push_back(std::move(lamp));
    is_fine.push_back(fine);
  }
  if (lamps_.empty()) { return; }
  take_bodies(surfaces);
  for (std::size_t k = 0; k < lamps_.size(); ++k) { take_samples(lamps_[k], is_fine[k], k); }
  for (Lamp& lamp : lamps_) { mark_behind(lamp); }
}

HALFLIGHT_INLINE glm::dvec3 DirectLight::lifted(std::uint32_t o, const glm::dvec3& x, const glm::dvec3& n) const {
  // Objects with more sheets are skipped, because each sheet would be projected to for each point.
  constexpr std::uint32_t most_sheets = 64;
  const double lift = bodies_[o].lift;
  if (!(lift > 0.0)) { return x; }
  glm::dvec3 above = x + lift * n;
  const std::uint32_t sheets = true_objects_->object(o).sheet_count();
  for (std::uint32_t sheet = 0; sheet < sheets && sheets <= most_sheets; ++sheet) {
    const raycast::SurfacePoint beside = true_objects_->object(o).project(sheet, x);
    const glm::dvec3 off = x - beside.position;
    const double height = glm::dot(off, beside.normal);
    constexpr double same = 1.0 - 1e-6;  // of the normals: the point's own sheet, or one that continues it smoothly
    if (glm::dot(off, off) < lift * lift && height >= -1e-3 * lift && glm::dot(n, beside.normal) < same) {
      above += (lift - height) * beside.normal;
    }
  }
  return above;
}

HALFLIGHT_INLINE void DirectLight::take_bodies(const std::vector<Surface>& surfaces) {
  constexpr std::size_t most_facets = 200'000, most_of_one = 4096;
  std::size_t facets = 0;
  std::vector<raycast::PlacedObject> objects, second_halves;
  std::vector<std::uint32_t> copies;  // duplicate objects that the scene leaves out (raycast::Scene::leave_out)
  for (std::uint32_t o = 0; o < objects_->size(); ++o) {
    const raycast::PlacedObject& object = objects_->object(o);
    Body& body = bodies_[o];
    objects.push_back(object);
    if (objects_->left_out(o)) {
      copies.push_back(o);
      continue;
    }
    if (object.inside()) { rooms_.push_back(o); }
    if (facets > most_facets) { continue; }
    body.closed = object.solid();
    body.convex = object.convex() && !object.inside();
    body.exact = object.exact();
    body.bounds = object.bounds();
    if (body.exact) {
      if (radiating_faces(surfaces[o]) <= most_of_one) { body.facets = facets_of(surfaces[o]); }
      // Corners in files are mostly rounded, so round bodies are not quite convex; treating their many faces one by one would cost far
      // more.
      if (body.closed && !body.convex && !object.inside() && !body.facets.empty()) {
        body.convex = convex_within(body.facets, detail::stand_in_tolerance * object.bounds().diameter());
      }
    } else if (body.convex) {
      body.facets = facets_of(object, outline_tolerance(object, detail::facet_tolerance));
    }
    facets += body.facets.facets.size();
    if (body.exact || object.inside() || (body.convex && object.object().nearest())) { continue; }
    const double tolerance = detail::stand_in_tolerance * object.bounds().diameter();
    std::vector<StandIn> halves = open_meshes(object, tolerance);
    if (halves.empty()) { continue; }
    objects.back() = raycast::PlacedObject{halves[0].mesh};
    second_halves.emplace_back(halves[1].mesh);
    whole_.push_back(o);
    body.lift = 1.5 * tolerance;
    const std::size_t faces = halves[0].sheets.size() + halves[1].sheets.size();
    body.sheets = {std::move(halves[0].sheets), std::move(halves[1].sheets)};
    facets += faces;
    if (!body.convex && faces <= most_of_one) { body.facets = facets_of(object, tolerance); }
  }
  for (Body& body : bodies_) {
    body.runs.resize((body.facets.facets.size() + Body::of_run - 1) / Body::of_run);
    for (std::size_t f = 0; f < body.facets.facets.size(); ++f) {
      for (const glm::dvec3& p : body.facets.facets[f].contour) { body.runs[f / Body::of_run].extend(p); }
    }
  }
  if (whole_.empty()) { return; }
  objects.insert(objects.end(), second_halves.begin(), second_halves.end());
  const auto with_stand_ins = std::make_shared<raycast::Scene>(std::move(objects));
  with_stand_ins->leave_out(copies);
  with_stand_ins_ = with_stand_ins;
  objects_ = with_stand_ins_.get();
}

}  // namespace radiosity
