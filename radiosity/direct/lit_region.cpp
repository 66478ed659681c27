// SPDX-License-Identifier: MIT
#include <radiosity/direct/lit_region.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/facets.hpp>
#include <radiosity/direct/light_vector.hpp>

namespace radiosity {

HALFLIGHT_INLINE LitRegion::LitRegion(const DirectLight& light, const raycast::PatchShape& shape, const glm::dvec3& normal, Shadows shadows)
    : light_{&light}, owner_{shape.owner}, shadows_{shadows} {
  region_.normal = normal;
  raycast::Box box;
  for (const glm::dvec3& p : shape.contour) { box.extend(p); }
  region_.centre = box.centre();
  for (const glm::dvec3& p : shape.contour) { region_.radius = std::max(region_.radius, glm::length(p - region_.centre)); }
  region_.radius += shape.bulge;
  // A point on a surface that a mesh stands in for lies close to that mesh, so it is lifted above it and has no owner.
  raycast::PatchShape from = shape;
  lift_ = owner_ != raycast::no_object ? light.lift(owner_) : 0.0;
  if (lift_ > 0.0) {
    from.owner = raycast::no_object;
    from.bulge += lift_;
  }
  for (std::uint32_t k = 0; k < light.lamps_.size(); ++k) {
    const DirectLight::Lamp& lamp = light.lamps_[k];
    if (region_.planar() && glm::dot(normal, lamp.centre - region_.centre) <= -lamp.radius - region_.radius) { continue; }
    if (lamp.flat && lamp.facets.facets[0].height(region_.centre) <= -region_.radius) { continue; }
    Reach reach;
    reach.lamp = k;
    reach.list = light.objects_->occluders(from, lamp.shape());
    if (reach.list.blocked()) { continue; }
    if (!reach.list.clear()) {
      reach.between = Between::anything;
      if (lamp.flat && lamp.facets.facets.size() <= 16) {
        const bool all = take_bodies(reach, shape);
        if (all) { reach.between = reach.faces.empty() && reach.outlines.empty() ? Between::nothing : Between::bodies; }
        if (shape.bulge == 0.0 && lift_ == 0.0) { leave_out_hidden(reach, shape.contour); }
      }
    }
    const glm::dvec3 d = lamp.centre - region_.centre;
    reach.may_give = brightest(lamp.exitance) * lamp.area / std::max(glm::dot(d, d), lamp.radius * lamp.radius);
    reaches_.push_back(std::move(reach));
  }
  std::stable_sort(reaches_.begin(), reaches_.end(), [](const Reach& a, const Reach& b) { return a.may_give > b.may_give; });
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
    light = PartLight{{facets, part, region_}, {}};
    light->vector = LinearLightVector::fit(part, light->outline, region_, light_->slack_, facing_);
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
  constexpr std::uint32_t few_edges = 16;  // with so few edges, testing all of them is fast enough
  if (part.edges_end - part.edges_begin <= few_edges) { return radiosity::form_factor(facets, part, x, n, light_->slack_, facing_); }
  reach.parts.resize(facets.parts.size());
  const PartLight& light = known(reach.parts[p], facets, part);
  return std::max(0.0, glm::dot(n, light.vector ? light.vector->at(x) : light.outline.light_vector(x, light_->slack_, facing_)));
}

HALFLIGHT_INLINE double LitRegion::visible(std::size_t k, const glm::dvec3& x, const glm::dvec3& n, const Color& others) {
  Reach& reach = reaches_[k];
  if (reach.between == Between::nothing) { return 1.0; }
  const bool all_known = reach.between == Between::bodies;
  const std::size_t shadows = reach.faces.size() + reach.outlines.size();
  const std::size_t segments = segments_for(lamp(k), x, n, others);
  // Cutting out `some_shadows` takes longer than the minimum number of segments; cutting out `many_shadows` takes longer than
  // the segments that decide whether it is needed.
  constexpr std::size_t some_shadows = 4, many_shadows = 16;
  if ((!all_known && shadows == 0) || (shadows > some_shadows && segments <= detail::fewest_segments) ||
      (!all_known && shadows > many_shadows && mostly_open(reach, x, n))) {
    return seen_share(reach, x, n, segments);
  }
  const glm::dvec3 above = lifted(x, n);  // lifted above the faces of the mesh that stands in for its own object
  const double all = unhidden(k, above, n);
  if (!(all > 0.0)) { return 0.0; }
  std::vector<detail::LampPart> left;
  const double open = std::min(1.0, cut(reach, above, n, all_known ? nullptr : &left) / all);
  if (all_known || left.empty()) { return open; }
  constexpr double little = 0.25;  // visible share below which few of the lamp's evenly spread segments would hit it
  return open < little ? open * seen_share_of(reach, x, n, left) : seen_share(reach, x, n, segments);
}

}  // namespace radiosity
