// SPDX-License-Identifier: MIT
#include <radiosity/direct/lit_region.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/inline.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>
#include <raycast/tolerances.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/lamp_samples.hpp>
#include <radiosity/direct/light_vector.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/polygon_shaft.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

HALFLIGHT_INLINE LitRegion::LitRegion(const DirectLight& light, const raycast::PatchShape& shape, const glm::dvec3& normal)
    : light_{&light}, owner_{shape.owner}, normal_{normal} {
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

HALFLIGHT_INLINE bool LitRegion::take_bodies(Reach& reach, const raycast::PatchShape& shape) const {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  const raycast::Scene& objects = *light_->objects_;
  std::vector<std::uint32_t> candidates;
  constexpr std::size_t most_objects = 64;
  if (!reach.list.known() && light_->bodies_.size() > most_objects) { return false; }
  if (reach.list.known()) {
    for (const std::uint32_t s : reach.list.shapes()) { candidates.push_back(light_->whole(objects.object_of(s))); }
  } else {  // few objects of many faces
    for (std::uint32_t o = 0; o < light_->bodies_.size(); ++o) {
      if (!objects.left_out(o)) { candidates.push_back(o); }
    }
  }
  if (!reach.list.rooms_clear()) { candidates.insert(candidates.end(), light_->rooms_.begin(), light_->rooms_.end()); }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  const double slack = light_->slack_;
  // With a bulge the contour says too little, and all candidates are taken.
  std::vector<Shaft> shaft;
  if (shape.bulge == 0.0) { shaft.emplace_back(shape.contour, lamp.corners, slack + lift_); }
  const auto misses = [&](std::span<const glm::dvec3> corners) { return !shaft.empty() && shaft[0].misses(corners); };
  constexpr std::size_t most_faces = 128, most_of_stand_ins = 64;  // past these segments cost less
  bool all = true;
  for (const std::uint32_t o : candidates) {
    const DirectLight::Body& body = light_->bodies_[o];
    if (body.convex && o == owner_) { continue; }
    if (body.facets.empty()) {
      all = false;
      continue;
    }
    if (body.convex && body.closed && !lamp.behind[o]) {
      if (shaft.empty() || !shaft[0].misses(body.bounds)) {
        Reach::Outline outline;
        outline.facets = &body.facets;
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
        for (const glm::dvec3& p : outline.corners) { outline.centre += p / static_cast<double>(outline.corners.size()); }
        for (const glm::dvec3& p : outline.corners) { outline.radius = std::max(outline.radius, glm::length(p - outline.centre)); }
        reach.outlines.push_back(std::move(outline));
      }
      continue;
    }
    if (!body.exact && (body.convex ? body.closed : !(body.lift > 0.0))) {
      all = false;
      continue;
    }
    const std::size_t before = reach.faces.size();
    for (const Facets::Facet& facet : body.facets.facets) {
      if (body.closed && facet.height(centre_) <= slack - radius_) { continue; }  // its back, behind its fronts
      if (misses(facet.contour)) { continue; }
      reach.faces.push_back({facet.contour, facet.normal});
    }
    if (reach.faces.size() > (body.exact ? most_faces : most_of_stand_ins)) {
      reach.faces.resize(before);
      all = false;
    }
  }
  return all;
}

HALFLIGHT_INLINE double LitRegion::unhidden(std::size_t k, const glm::dvec3& x, const glm::dvec3& n) {
  const DirectLight::Lamp& lamp = this->lamp(k);
  const double height_of_lamp = glm::dot(n, lamp.centre - x);
  if (height_of_lamp <= -lamp.radius) { return 0.0; }
  const std::vector<Facets::Part>& parts = lamp.facets.parts;
  Reach& reach = reaches_[k];
  double sum = 0.0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const double height = glm::dot(n, parts[p].centre - x), extent = parts[p].extent(n);
    if (height <= -extent) { continue; }
    sum += height >= extent ? part_above(reach, p, x, n) : radiosity::form_factor(lamp.facets, parts[p], x, n, light_->slack_, facing_);
  }
  return lamp.correction * sum;
}

HALFLIGHT_INLINE const LitRegion::PartLight& LitRegion::known(std::optional<PartLight>& light, const Facets& facets,
                                                              const Facets::Part& part) {
  if (!light) {
    light = PartLight{{facets, part, centre_, radius_}, {}};
    light->vector = LinearLightVector::fit(part, light->outline, centre_, radius_, normal_, light_->slack_, facing_);
  }
  return *light;
}

HALFLIGHT_INLINE double LitRegion::part_above(Reach& reach, std::size_t p, const glm::dvec3& x, const glm::dvec3& n) {
  const Facets& facets = light_->lamps_[reach.lamp].facets;
  const Facets::Part& part = facets.parts[p];
  if (part.roundness > 0.0) {
    const glm::dvec3 d = part.centre - x;
    const double r2 = glm::dot(d, d);
    return part.roundness * glm::dot(n, d) / (r2 * std::sqrt(r2));
  }
  constexpr std::uint32_t few_edges = 16;  // the light of so few is found from all of them
  if (part.edges_end - part.edges_begin <= few_edges) { return radiosity::form_factor(facets, part, x, n, light_->slack_, facing_); }
  reach.parts.resize(facets.parts.size());
  const PartLight& light = known(reach.parts[p], facets, part);
  return std::max(0.0, glm::dot(n, light.vector ? light.vector->at(x) : light.outline.light_vector(x, light_->slack_, facing_)));
}

// The convex hull of the corners as they are seen from x (Andrew 1979): so it does not matter how a curved body was cut into facets.
HALFLIGHT_INLINE void LitRegion::make_cone(const Reach::Outline& outline, const glm::dvec3& x) {
  cone_.clear();
  const auto& facets = outline.facets->facets;
  const Facets::Facet* plane = &facets[outline.nearest];
  if (!(plane->height(x) > light_->slack_)) {
    plane = &*std::max_element(facets.begin(), facets.end(), [&](const auto& a, const auto& b) { return a.height(x) < b.height(x); });
    if (!(plane->height(x) > light_->slack_)) { return; }
  }
  const glm::dvec3 axis = -plane->normal;  // all corners lie ahead
  const auto [s, t] = orthonormal(axis);
  projected_.clear();
  for (const glm::dvec3& corner : outline.corners) {
    const glm::dvec3 d = corner - x;
    const double ahead = std::max(glm::dot(d, axis), light_->slack_);
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
    const glm::dvec3 a = *hull_[i].corner - x, b = *hull_[i + 1 < hull_.size() ? i + 1 : 0].corner - x, across = glm::cross(a, b);
    // Of two that are seen in one place, as those of an edge seen from its end, there is no plane.
    constexpr double least = raycast::tol_edge * raycast::tol_edge;
    if (glm::dot(across, across) > least * glm::dot(a, a) * glm::dot(b, b)) { cone_.push_back({x, across}); }
  }
}

HALFLIGHT_INLINE double LitRegion::cut(const Reach& reach, const glm::dvec3& x, const glm::dvec3& n, std::vector<detail::LampPart>* left) {
  const DirectLight::Lamp& lamp = light_->lamps_[reach.lamp];
  double sum = 0.0;
  for (std::uint32_t f = 0; f < lamp.facets.facets.size(); ++f) {
    const Facets::Facet& facet = lamp.facets.facets[f];
    if (!(facet.height(x) > light_->slack_)) { continue; }
    ShadowedTarget target{facet.contour, facet.normal, {}, light_->slack_};
    target.look(x, n);
    for (const Blocker& face : reach.faces) {
      if (target.hidden()) { break; }
      target.hide(face);
    }
    for (const Reach::Outline& outline : reach.outlines) {
      if (target.hidden()) { break; }
      if (target.misses(outline.centre, outline.radius)) { continue; }
      make_cone(outline, x);
      if (!cone_.empty()) { target.hide(cone_); }
    }
    sum += target.form_factor();
    if (left == nullptr) { continue; }
    for (const Piece& piece : target.pieces()) {
      detail::LampPart& part = left->emplace_back(detail::LampPart{{}, f, point_to_polygon(x, n, piece)});
      for (const glm::dvec3& p : piece) { part.contour.push_back(p); }
    }
  }
  return sum;
}

HALFLIGHT_INLINE double LitRegion::visible(std::size_t k, const glm::dvec3& x, const glm::dvec3& n) {
  Reach& reach = reaches_[k];
  if (reach.between == Between::nothing) { return 1.0; }
  const bool all_known = reach.between == Between::bodies;
  const std::size_t shadows = reach.faces.size() + reach.outlines.size();
  constexpr std::size_t many_shadows = 16;  // take longer to cut out than segments take to tell whether that is needed
  if (!all_known && (shadows == 0 || (shadows > many_shadows && mostly_open(reach, x, n)))) { return seen_share(reach, x, n); }
  const glm::dvec3 above = x + lift_ * n;  // the faces of a mesh that stands in for its own object
  const double all = unhidden(k, above, n);
  if (!(all > 0.0)) { return 0.0; }
  std::vector<detail::LampPart> left;
  const double open = std::min(1.0, cut(reach, above, n, all_known ? nullptr : &left) / all);
  if (all_known || left.empty()) { return open; }
  constexpr double little = 0.25;  // of a lamp: few of the segments that are even over it would tell
  return open < little ? open * seen_share_of(reach, x, n, left) : seen_share(reach, x, n);
}

}  // namespace radiosity
