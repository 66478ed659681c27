// SPDX-License-Identifier: MIT
#include <radiosity/direct/direct_light.hpp>

#include <algorithm>
#include <array>
#include <bit>
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
#include <raycast/bundle.hpp>
#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/hierarchy/curved_area.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/polygon_shaft.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

namespace detail {

// Heights below this count as none, in a scene of size 1 to 2: a thousandth of what a picture or a leaf could tell, far above rounding.
inline constexpr double direct_slack = 1e-9;
// How far segments stay off the surfaces at their ends, in a scene of size 1 to 2: more than single precision's error.
inline constexpr double off_surface = 1e-5;
// How far facets may be off a curved surface, to the object's diameter; and those of a mesh that stands in for an object.
inline constexpr double facet_tolerance = 0.002;
inline constexpr double stand_in_tolerance = 0.0004;
inline constexpr unsigned lamp_samples = 256, first_samples = 64;

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
        return std::any_of(f.contour.begin(), f.contour.end(),
                           [&](const glm::dvec3& p) { return plane.height(p) < -detail::direct_slack; });
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

HALFLIGHT_INLINE LitRegion::LitRegion(const DirectLight& light, const raycast::PatchShape& shape, const glm::dvec3& normal)
    : light_{&light}, owner_{shape.owner} {
  raycast::Box box;
  for (const glm::dvec3& p : shape.contour) { box.extend(p); }
  centre_ = box.centre();
  for (const glm::dvec3& p : shape.contour) { radius_ = std::max(radius_, glm::length(p - centre_)); }
  radius_ += shape.bulge;
  // A point of a surface for which a mesh stands in lies beside that mesh, so it is lifted above it and owned by nothing.
  raycast::PatchShape from = shape;
  lift_ = owner_ != raycast::no_object ? light.lift(owner_) : 0.0;
  if (lift_ > 0.0) {
    from.owner = raycast::no_object;
    from.bulge += lift_;
  }
  const bool planar = normal != glm::dvec3{0.0};
  for (std::uint32_t k = 0; k < light.lamps_.size(); ++k) {
    const DirectLight::Lamp& lamp = light.lamps_[k];
    if (planar && glm::dot(normal, lamp.centre - centre_) <= -lamp.radius - radius_) { continue; }
    if (lamp.flat && lamp.facets.facets[0].height(centre_) <= -radius_) { continue; }
    Reach reach;
    reach.lamp = k;
    reach.list = light.objects_->occluders(from, lamp.shape());
    if (reach.list.blocked()) { continue; }
    if (!reach.list.clear()) {
      reach.between = Between::anything;
      if (lamp.flat && lamp.facets.facets.size() <= 16 && take_bodies(reach, shape)) {
        reach.between = reach.faces.empty() && reach.outlines.empty() ? Between::nothing : Between::bodies;
      }
    }
    reaches_.push_back(std::move(reach));
  }
}

// What may stand between as faces and outlines; false when something is neither.
HALFLIGHT_INLINE bool LitRegion::take_bodies(Reach& reach, const raycast::PatchShape& shape) const {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  const raycast::Scene& objects = *light_->objects_;
  std::vector<std::uint32_t> candidates;
  if (!reach.list.known()) { return false; }
  for (const std::uint32_t s : reach.list.shapes()) { candidates.push_back(light_->whole(objects.object_of(s))); }
  if (!reach.list.rooms_clear()) { candidates.insert(candidates.end(), light_->rooms_.begin(), light_->rooms_.end()); }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  constexpr double slack = detail::direct_slack;
  // With a bulge the contour says too little, and all candidates are taken.
  std::vector<Shaft> shaft;
  if (shape.bulge == 0.0) { shaft.emplace_back(shape.contour, lamp.corners, slack); }
  const auto misses = [&](std::span<const glm::dvec3> corners) { return !shaft.empty() && shaft[0].misses(corners); };
  constexpr std::size_t most_faces = 48;
  for (const std::uint32_t o : candidates) {
    const DirectLight::Body& body = light_->bodies_[o];
    if (body.convex && o == owner_) { continue; }
    if (body.facets.empty()) { return false; }
    if (body.convex && body.closed && !lamp.behind[o]) {
      if (shaft.empty() || !shaft[0].misses(body.bounds)) {
        Reach::Outline outline{&body.facets, 0, {}};
        const auto& facets = body.facets.facets;
        for (std::uint32_t f = 1; f < facets.size(); ++f) {
          if (facets[f].height(centre_) > facets[outline.nearest].height(centre_)) { outline.nearest = f; }
        }
        const auto side = [&](std::uint32_t f) {  // 1: all of the region is before the facet, -1: behind it
          const double height = facets[f].height(centre_);
          return height > radius_ + slack ? 1 : height < -radius_ - slack ? -1 : 0;
        };
        for (const Facets::Edge& edge : body.facets.edges) {
          const int left = side(edge.left);
          if (left != 0 && edge.right != Facets::none && side(edge.right) == left) { continue; }
          outline.corners.push_back(edge.a);
          outline.corners.push_back(edge.b);
        }
        const auto before = [](const glm::dvec3& a, const glm::dvec3& b) {
          return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
        };
        std::sort(outline.corners.begin(), outline.corners.end(), before);
        outline.corners.erase(std::unique(outline.corners.begin(), outline.corners.end()), outline.corners.end());
        reach.outlines.push_back(std::move(outline));
      }
      continue;
    }
    if (!body.convex && !body.exact) { return false; }
    if (body.convex && body.closed && !body.exact) { return false; }
    for (const Facets::Facet& facet : body.facets.facets) {
      if (body.closed && facet.height(centre_) <= slack - radius_) { continue; }  // its back, behind its fronts
      if (misses(facet.contour)) { continue; }
      reach.faces.push_back({facet.contour, facet.normal});
    }
    if (reach.faces.size() > most_faces) { return false; }
  }
  return true;
}

HALFLIGHT_INLINE double LitRegion::unhidden(std::size_t k, const glm::dvec3& x, const glm::dvec3& n) {
  const DirectLight::Lamp& lamp = this->lamp(k);
  const double height = glm::dot(n, lamp.centre - x);
  if (height <= -lamp.radius) { return 0.0; }
  return lamp.correction * radiosity::form_factor(lamp.facets, x, n, height >= lamp.radius, facing_);
}

// The convex hull of the corners as they are seen from x (Andrew 1979): so it does not matter how a curved body was cut into facets.
HALFLIGHT_INLINE void LitRegion::make_cone(const Reach::Outline& outline, const glm::dvec3& x) {
  cone_.clear();
  const auto& facets = outline.facets->facets;
  const Facets::Facet* plane = &facets[outline.nearest];
  if (!(plane->height(x) > detail::direct_slack)) {
    plane = &*std::max_element(facets.begin(), facets.end(), [&](const auto& a, const auto& b) { return a.height(x) < b.height(x); });
    if (!(plane->height(x) > detail::direct_slack)) { return; }
  }
  const glm::dvec3 axis = -plane->normal;  // all corners lie ahead
  const auto [s, t] = orthonormal(axis);
  projected_.clear();
  for (const glm::dvec3& corner : outline.corners) {
    const glm::dvec3 d = corner - x;
    const double ahead = std::max(glm::dot(d, axis), detail::direct_slack);
    projected_.push_back({glm::dot(d, s) / ahead, glm::dot(d, t) / ahead, &corner});
  }
  std::sort(projected_.begin(), projected_.end(),
            [](const Projected& a, const Projected& b) { return a.s != b.s ? a.s < b.s : a.t < b.t; });
  const auto turns_right = [](const Projected& a, const Projected& b, const Projected& c) {
    return !((b.s - a.s) * (c.t - a.t) - (b.t - a.t) * (c.s - a.s) > 0.0);
  };
  hull_.clear();
  const auto half = [&](auto first, auto last) {
    const std::size_t base = hull_.size();
    for (; first != last; ++first) {
      while (hull_.size() >= base + 2 && turns_right(hull_[hull_.size() - 2], hull_.back(), *first)) { hull_.pop_back(); }
      hull_.push_back(*first);
    }
    hull_.pop_back();  // it begins the other half
  };
  half(projected_.begin(), projected_.end());
  half(projected_.rbegin(), projected_.rend());
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const glm::dvec3 across = glm::cross(*hull_[i].corner - x, *hull_[i + 1 < hull_.size() ? i + 1 : 0].corner - x);
    if (glm::dot(across, across) > 0.0) { cone_.push_back({x, across}); }
  }
}

HALFLIGHT_INLINE double LitRegion::cut(const Reach& reach, const glm::dvec3& x, const glm::dvec3& n) {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  double sum = 0.0;
  for (const Facets::Facet& facet : lamp.facets.facets) {
    if (!(facet.height(x) > 0.0)) { continue; }
    ShadowedTarget target{facet.contour, facet.normal, {}, detail::direct_slack};
    target.look(x, n);
    for (const Blocker& face : reach.faces) {
      if (target.hidden()) { break; }
      target.hide(face);
    }
    for (const Reach::Outline& outline : reach.outlines) {
      if (target.hidden()) { break; }
      make_cone(outline, x);
      if (!cone_.empty()) { target.hide(cone_); }
    }
    sum += target.form_factor();
  }
  return sum;
}

HALFLIGHT_INLINE double LitRegion::seen_share(Reach& reach, const glm::dvec3& x, const glm::dvec3& n) {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  // Away from flat surfaces on which they begin and end, segments need no owners, and single precision decides about nearly all.
  const glm::dvec3 from = x + std::max(lift_, detail::off_surface) * n;
  const bool curved = owner_ != raycast::no_object && !light_->objects_->object(owner_).flat();  // and convex, or a mesh would stand in
  const std::uint32_t source = curved ? owner_ : raycast::no_object;
  const double to_lift = lamp.flat ? detail::off_surface : 0.0;
  const std::uint32_t target = lamp.flat ? raycast::no_object : lamp.object;
  double all = 0.0;
  double seen = 0.0;
  for (unsigned first = 0; first < detail::lamp_samples; first += 16) {
    raycast::Segments16 segments;
    std::array<double, 16> weight{};
    for (unsigned k = 0; k < 16; ++k) {
      const DirectLight::Sample& sample = lamp.samples[first + k];
      const glm::dvec3 d = sample.position - x;
      const double cosines = glm::dot(n, d) * -glm::dot(sample.normal, d);
      if (!(glm::dot(n, d) > 0.0) || !(cosines > 0.0)) { continue; }
      const double r2 = glm::dot(d, d);
      weight[k] = cosines / (r2 * r2);
      segments.set(k, {from, sample.position + to_lift * sample.normal - from}, source, target);
    }
    rays_ += static_cast<unsigned>(std::popcount(segments.lanes));
    const std::uint32_t blocked = segments.lanes != 0 ? light_->objects_->occluded16(segments, reach.list, reach.hint) : 0;
    for (unsigned k = 0; k < 16; ++k) {
      all += weight[k];
      if ((blocked >> k & 1u) == 0) { seen += weight[k]; }
    }
    if (first + 16 == detail::first_samples && (seen == 0.0 || seen == all)) { break; }
  }
  return all > 0.0 ? seen / all : 0.0;
}

HALFLIGHT_INLINE double LitRegion::visible(std::size_t k, const glm::dvec3& x, const glm::dvec3& n) {
  Reach& reach = reaches_[k];
  if (reach.between == Between::nothing) { return 1.0; }
  if (reach.between == Between::anything) { return seen_share(reach, x, n); }
  const double all = unhidden(k, x, n);
  return all > 0.0 ? std::min(1.0, cut(reach, x, n) / all) : 0.0;
}

}  // namespace radiosity
