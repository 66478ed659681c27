// SPDX-License-Identifier: MIT
#include <radiosity/oracle/light_oracle.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/shaft.hpp>

#include <radiosity/clusters/cluster_exchange.hpp>
#include <radiosity/clusters/clusters.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/oracle/cluster_oracle.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/oracle/lit_faces.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/scene_view.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

namespace detail {

// Factor by which the light on a leaf no larger than min_area may vary more than on others: places beside lamps are few, but the light
// there changes over short distances. The factor grows as leaves become smaller, so that even a very near lamp does not cause endless
// splitting.
[[nodiscard]] HALFLIGHT_INLINE double tolerance_of(const Node& to, double min_area) {
  return to.leaf() && !(to.area > min_area) ? std::max(4.0, std::sqrt(min_area / to.area)) : 1.0;
}
inline constexpr double smallest_beside_lamps = 65536.0;  // largest ratio of min_area to a leaf's area: the side is 256 times as short

// Does the arriving light, which without blockers ranges from `low` to `high`, vary by more than epsilon (RMS)? see(round) casts segments
// and returns the visible fraction. `tolerance`: factor of epsilon; if it is above 1, shadow edges are ignored.
template <class See>
[[nodiscard]] bool varies(double low, double high, double epsilon, double tolerance, RayCount& rays, const See& see) {
  const bool small = tolerance > 1.0;
  const double variation = (high - low) / (std::sqrt(12.0) * tolerance);
  if (!(std::max(variation, small ? 0.0 : 0.5 * high) > epsilon)) { return false; }  // sqrt(V (1 - V)) is at most one half
  // The smallest shadow that matters covers the share `least` of the patch. Enough segments are cast to meet it three times, unless these
  // would be too many or the first ones already decide.
  const double mean = 0.5 * (low + high);
  const double least = epsilon * epsilon / (mean * mean);
  const double rounds = std::clamp(std::ceil(3.0 / (segments_per_round * least)), 1.0, 16.0);
  double arrives = 0.0;
  for (std::uint64_t round = 0; static_cast<double>(round) < rounds; ++round) {
    const auto [fraction_of_round, cast] = see(round);
    rays += cast;
    arrives += fraction_of_round;
    const double fraction = arrives / static_cast<double>(round + 1);
    const double edges = small ? 0.0 : mean * std::sqrt(std::max(0.0, fraction * (1.0 - fraction)));
    if (std::max(variation * fraction, edges) > epsilon) { return true; }
    if (cast.cast == 0) { return false; }  // proven to be clear or blocked
  }
  return false;
}

// Approximate minimum and maximum of the form factor between a patch and a lamp: over its corners and the point nearest to the lamp, with
// the normals tilted by the deviation of the patch.
struct FactorRange {
  // Adds a point. `facing`: form factor without the cosine at the point; `cosine`: of the angle between the normal and the lamp.
  void add(double facing, double cosine, double tilt) {
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    low = std::min(low, facing * std::max(0.0, std::cos(angle + tilt)));
    high = std::max(high, facing * std::max(0.0, std::cos(std::max(0.0, angle - tilt))));
  }
  double low = 1.0, high = 0.0;
};

[[nodiscard]] HALFLIGHT_INLINE FactorRange factors_to_disk(const Node& to, const Patch& patch, const Node& lamp) {
  FactorRange range;
  const double tilt = std::asin(to.deviation);
  const auto look = [&](const glm::dvec3& x) {
    const glm::dvec3 d = lamp.centre - x;
    const double r = std::sqrt(glm::dot(d, d));
    range.add(disk_estimate(x, d / r, lamp.centre, lamp.normal, lamp.area), glm::dot(to.normal, d) / r, tilt);
  };
  for (const glm::dvec3& x : patch.contour) { look(x); }
  look(nearest_point(to, lamp.centre));
  // A lamp perpendicular to the patch does not light the nearest point but the area in front of it, most strongly at about half of its
  // height.
  const double height = std::max(lamp.radius, std::abs(glm::dot(to.normal, lamp.centre - to.centre)));
  look(nearest_point(to, lamp.centre + 0.58 * height * lamp.normal));
  return range;
}

// A disk cannot represent a tube beside a wall, because most of the wall that it lights is far from its centre.
[[nodiscard]] HALFLIGHT_INLINE bool is_near_and_long(const Node& lamp, const Node& to, const Patch& outline) {
  constexpr double most = 4.0;  // area of the bounding disk relative to that of the lamp; a rectangle of 5 : 1 has this ratio
  const bool is_long = std::numbers::pi * lamp.radius * lamp.radius > most * lamp.area;
  // From a distance of four radii on, the kernel of its centre is within a quarter of that of a line.
  return is_long && outline.parts.empty() && glm::length(lamp.centre - to.centre) < 4.0 * lamp.radius + to.radius;
}

// The point nearest to x on the outline of a polygon.
[[nodiscard]] HALFLIGHT_INLINE glm::dvec3 nearest_on_outline(const Polygon& polygon, const glm::dvec3& x) {
  glm::dvec3 nearest = polygon.front();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3 edge = polygon[(i + 1) % polygon.size()] - a;
    const double square = glm::dot(edge, edge);
    const glm::dvec3 y = square > 0.0 ? a + std::clamp(glm::dot(x - a, edge) / square, 0.0, 1.0) * edge : a;
    if (glm::dot(y - x, y - x) < glm::dot(nearest - x, nearest - x)) { nearest = y; }
  }
  return nearest;
}

// The centre of the part of a convex polygon that lies above a patch, or, if there is none, the point of its outline nearest to the
// patch's centre. Where a lamp touches the patch along an edge, the middle is lit most, which the outline alone would not show.
[[nodiscard]] HALFLIGHT_INLINE glm::dvec3 nearest_of_lamp(const Node& to, const Patch& patch, const Polygon& outline) {
  Polygon over = outline, part;
  for (std::size_t i = 0; i < patch.contour.size() && over.size() > 2; ++i) {
    part.clear();
    const glm::dvec3 edge = patch.contour[(i + 1) % patch.contour.size()] - patch.contour[i];
    clip_to_horizon(over, patch.contour[i], glm::cross(patch.normal, edge), part);
    std::swap(over, part);
  }
  if (over.size() < 3 || !patch.parts.empty()) { return nearest_on_outline(outline, to.centre); }
  glm::dvec3 middle{0.0};
  for (const glm::dvec3& p : over) { middle += p / static_cast<double>(over.size()); }
  return middle;
}

[[nodiscard]] HALFLIGHT_INLINE FactorRange factors_to_outline(const Node& to, const Patch& patch, const Node& from, const Patch& lamp) {
  FactorRange range;
  const double tilt = std::asin(to.deviation);
  Polygon outline;
  if (to.deviation > 0.0) {
    outline = lamp.contour;
  } else {
    clip_to_horizon(lamp.contour, to.centre, to.normal, outline);
  }
  if (outline.size() < 3) { return {0.0, 0.0}; }
  const auto look = [&](const glm::dvec3& x) {
    const bool in_front = glm::dot(from.normal, x - from.centre) > 0.0;
    const glm::dvec3 light = in_front ? light_vector(x, outline) : glm::dvec3{0.0};
    const double facing = glm::length(light);
    range.add(facing, facing > 0.0 ? glm::dot(to.normal, light) / facing : 0.0, tilt);
  };
  for (const glm::dvec3& x : patch.contour) { look(x); }
  look(nearest_point(to, nearest_of_lamp(to, patch, outline)));
  return range;
}

}  // namespace detail

HALFLIGHT_INLINE LightOracle::LightOracle(const Scene& input, const SceneView& scene, const ShownAreas& shown, double epsilon,
                                          std::uint64_t seed, const std::vector<bool>& buried)
    : scene_{scene}, shown_{&shown}, sampler_{scene, nullptr, shown}, epsilon_{epsilon}, seed_{seed} {
  const Hierarchy& hierarchy = scene.hierarchy;
  std::vector<Color> reflectance, exitance;
  for (const InputSurface& surface : radiosity::surfaces(input)) {
    reflectance.push_back(input.materials[surface.material].reflectance);
    exitance.push_back(input.materials[surface.material].emission);
    emission_.push_back(brightest(exitance.back()));
    shows_.push_back(std::min(1.0, 2.0 * brightest(reflectance.back())));
  }
  const LitFaces lit{scene, reflectance, exitance, buried};
  scene_area_ = lit.area();
  std::map<std::pair<std::uint32_t, double>, double> alike;  // area of faces with equal emission, by object
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!is_input_face(hierarchy, i) || (i < buried.size() && buried[i])) { continue; }
    const Node& root = hierarchy[i];
    alike[{root.object, emission_[root.surface]}] += root.area;
  }
  lamp_area_.resize(emission_.size());
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    const Node& root = hierarchy[i];
    if (!is_input_face(hierarchy, i)) { continue; }
    // The faces of a room do not form one lamp, because they surround everything.
    const bool room = scene.objects.object(root.object).inside();
    lamp_area_[root.surface] = room ? 0.0 : alike[{root.object, emission_[root.surface]}];
  }
  for (double& e : emission_) { e = lit.mean_emission() > 0.0 ? e / lit.mean_emission() : 0.0; }
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    const Node& node = hierarchy[i];
    if (!node.is_cluster()) { continue; }
    if (of_cluster_.size() <= node.cluster) { of_cluster_.resize(node.cluster + 1); }
    double sum = 0.0;
    double& brightest = of_cluster_[node.cluster].brightest;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      const Node& child = hierarchy[c];
      sum += child.area * emission(child);
      brightest = std::max(brightest, child.is_cluster() ? of_cluster_[child.cluster].brightest : emission(child));
    }
    of_cluster_[node.cluster].mean = node.area > 0.0 ? sum / node.area : 0.0;
  }
  if (!of_cluster_.empty() && !hierarchy[0].is_cluster()) { lamps_.emplace(scene, nullptr, shown, emission_); }
}

HALFLIGHT_INLINE std::uint32_t LightOracle::wants_split(const Question& question) const {
  const Hierarchy& nodes = scene_.hierarchy;
  const std::uint32_t p = question.p, q = question.q;
  RayCount& rays = *question.rays;
  const bool q_shines = emission(nodes[q]) >= emission(nodes[p]);
  const std::uint32_t receiver = q_shines ? p : q;
  const std::uint32_t lamp = q_shines ? q : p;
  const Node& to = nodes[receiver];
  const Node& from = nodes[lamp];
  // A lamp of k parts (faces of one bulb, or pieces of a face) has k links to the receiver; their variations add up to between sqrt(k)
  // and k times that of one.
  const double parts = from.is_cluster() ? 1.0 : std::max(lamp_area_[from.surface], nodes[input_face(nodes, lamp)].area) / from.area;
  const double shown = to.is_cluster() ? 1.0 : shows_[to.surface];
  const double important = question.importance != nullptr ? question.importance->weight(receiver) : 1.0;
  const double weight = shown * emission(from) * std::sqrt(parts * to.area * important / scene_area_);
  if (!(weight > epsilon_)) { return no_node; }
  const double min_area = question.min_area / important;
  const bool by_lamp = lamps_ && from.is_cluster() && !to.is_cluster();
  if (!by_lamp && (to.is_cluster() || from.is_cluster())) {
    const std::uint32_t split = wants_cluster_split(receiver, lamp, weight, rays);
    return split != no_node && nodes[split].area > question.min_area ? split : no_node;
  }
  if (!(to.area > std::min(min_area, question.min_area / detail::smallest_beside_lamps))) { return no_node; }
  if (question.importance != nullptr && question.importance->uneven(receiver) && to.area > min_area) { return receiver; }
  const double tolerance = detail::tolerance_of(to, min_area);
  if (by_lamp) { return varies_by_lamp(receiver, lamp, weight, tolerance, rays) ? receiver : no_node; }

  const detail::FactorRange factor = detail::is_near_and_long(from, to, scene_.patches[lamp])
                                         ? detail::factors_to_outline(to, scene_.patches[receiver], from, scene_.patches[lamp])
                                         : detail::factors_to_disk(to, scene_.patches[receiver], from);
  const bool split = detail::varies(weight * factor.low, weight * factor.high, epsilon_, tolerance, rays, [&](std::uint64_t round) {
    const VisibilityEstimate seen =
        visibility(scene_, *question.between, {patch_end(scene_, nullptr, receiver), patch_end(scene_, nullptr, lamp)}, 1,
                   Random{seed_, (std::uint64_t{p} << 32) | q, 0x736861646f77ull + round});
    return std::pair{seen.fraction, seen.rays};
  });
  return split ? receiver : no_node;
}

HALFLIGHT_INLINE bool LightOracle::varies_by_lamp(std::uint32_t receiver, std::uint32_t lamp, double weight, double tolerance,
                                                  RayCount& rays) const {
  const Node& to = scene_.hierarchy[receiver];
  const Node& from = scene_.hierarchy[lamp];
  double low = 1.0;
  double high = 0.0;
  const double tilt = std::asin(to.deviation);
  const auto look = [&](const glm::dvec3& x) {
    const glm::dvec3 d = from.centre - x;
    const double r = glm::length(d);
    const double angle = std::acos(std::clamp(glm::dot(to.normal, d) / r, -1.0, 1.0));
    const double area = most_shown(from, *shown_, -d / r, 0.0);
    const double facing = area / (std::numbers::pi * r * r + area);
    low = std::min(low, facing * std::max(0.0, std::cos(angle + tilt)));
    high = std::max(high, facing * std::max(0.0, std::cos(std::max(0.0, angle - tilt))));
  };
  for (const glm::dvec3& x : scene_.patches[receiver].contour) { look(x); }
  look(nearest_point(to, from.centre));
  return detail::varies(weight * low, weight * high, epsilon_, tolerance, rays, [&](std::uint64_t round) {
    const LampExchange::Result seen =
        (*lamps_)(lamp, receiver, 1, Random{seed_, (std::uint64_t{receiver} << 32) | lamp, 0x736861646f77ull + round});
    return std::pair{seen.fraction, seen.rays};
  });
}

HALFLIGHT_INLINE std::uint32_t LightOracle::wants_cluster_split(std::uint32_t receiver, std::uint32_t source, double weight,
                                                                RayCount& rays) const {
  const Node& to = scene_.hierarchy[receiver];
  const Node& from = scene_.hierarchy[source];
  const glm::dvec3 d = from.centre - to.centre;
  const double r = glm::length(d);
  // A cluster that contains one much brighter element is split first, so that the lamp gets its own link.
  const bool mixed = from.is_cluster() && of_cluster_[from.cluster].brightest > 2.0 * of_cluster_[from.cluster].mean;
  const double area = most_shown(from, *shown_, -d / r, 0.0);
  const auto at = [&](double distance) { return area / (std::numbers::pi * distance * distance + area); };
  const double high = at(r - to.radius);
  const double low = at(r + to.radius);
  if (weight * (high - low) > std::sqrt(12.0) * epsilon_) { return mixed ? source : receiver; }
  if (!(weight * high * 0.5 > epsilon_)) { return no_node; }
  if (mixed) { return source; }
  const ClusterExchange seen = sampler_(sampler_.end(receiver, d), sampler_.end(source, -d), 1,
                                        Random{seed_, (std::uint64_t{receiver} << 32) | source, 0x736861646f77ull});
  rays.cast += seen.rays;
  const double mean = 0.5 * (low + high);
  return weight * mean * std::sqrt(seen.fraction * (1.0 - seen.fraction)) > epsilon_ ? receiver : no_node;
}

}  // namespace radiosity
