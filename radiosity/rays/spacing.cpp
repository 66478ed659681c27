// SPDX-License-Identifier: MIT
#include <radiosity/rays/spacing.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>

#include <radiosity/exchange/exchange.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/rays/senders.hpp>
#include <radiosity/rays/shot_light.hpp>
#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/rays/view_importance.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/visibility/leaf_locator.hpp>

namespace radiosity {

namespace detail {

// By node: mean emission of the lamps in a cluster; 0 for nodes that are not clusters.
[[nodiscard]] HALFLIGHT_INLINE std::vector<Color> emission_of_clusters(const DiscreteScene& scene) {
  const Hierarchy& hierarchy = scene.hierarchy;
  std::vector<Color> emission(hierarchy.size(), Color{0.0});
  for (std::size_t i = hierarchy.size(); i-- > 0;) {  // children before parents
    const Node& node = hierarchy[i];
    if (!node.is_cluster()) { continue; }
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      emission[i] += hierarchy[c].area / node.area * (hierarchy[c].is_cluster() ? emission[c] : scene.emission[hierarchy[c].surface]);
    }
  }
  return emission;
}

// Areas by which errors and brightness are weighted: the exposed ones. But what reflects nothing has no error, and may be very large and
// far away, as suns and skies are: it counts as if drawn towards the middle of all that reflects, onto the sphere around that. So it
// counts alike at any distance.
class CountedAreas {
 public:
  explicit CountedAreas(const DiscreteScene& scene) : scene_{scene} {
    raycast::Box reflecting;
    for (std::uint32_t i = 0; i < scene.hierarchy.size(); ++i) {
      const Node& node = scene.hierarchy[i];
      if (!is_input_face(scene.hierarchy, i) || !(scene.exposure.area[i] > 0.0) || is_black(scene.reflectance[node.surface])) { continue; }
      reflecting.extend(node.centre - node.radius);
      reflecting.extend(node.centre + node.radius);
    }
    if (reflecting.empty()) { return; }
    middle_ = reflecting.centre();
    radius_ = 0.5 * reflecting.diameter();
  }
  [[nodiscard]] double operator()(std::uint32_t i) const {
    const Node& node = scene_.hierarchy[i];
    if (!is_black(scene_.reflectance[node.surface])) { return scene_.exposure.area[i]; }
    const double distance = glm::length(node.centre - middle_);
    return scene_.exposure.area[i] * (distance > radius_ ? radius_ / distance * (radius_ / distance) : 1.0);
  }

 private:
  const DiscreteScene& scene_;
  glm::dvec3 middle_{0.0};
  double radius_ = 0.0;
};

// Brightness of each node without interreflection: the reflected direct light of the lamps, plus the node's own emission if it is no
// lamp; in the brightest channel. Lamps count as dark.
struct Brightness {
  std::vector<double> of;
  // RMS over the leaves, by counted area, of the reflected light of lamps, and of other emitters as if their light were constant over the
  // scene.
  double reflected = 0.0;
  double mean = 0.0;  // mean of the same
};
[[nodiscard]] HALFLIGHT_INLINE Brightness brightness_without_lamps(const DiscreteScene& scene, const Links& of_lamps,
                                                                   const CountedAreas& counted) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<Color> of_clusters = emission_of_clusters(scene);
  std::vector<Color> irradiance(hierarchy.size(), Color{0.0});
  const auto emission = [&](std::uint32_t i) { return hierarchy[i].is_cluster() ? of_clusters[i] : scene.emission[hierarchy[i].surface]; };
  const auto shine = [&](std::uint32_t from, std::uint32_t to, double exchange) {
    if (scene.exposure.area[to] > 0.0) { irradiance[to] += exchange / scene.exposure.area[to] * emission(from); }
  };
  for (const Link& link : of_lamps) {
    shine(link.p, link.q, static_cast<double>(link.exchange));
    shine(link.q, link.p, static_cast<double>(link.exchange));
  }
  Color glow{0.0};  // mean over all surfaces that are no lamps
  double area = 0.0;
  const auto counts = [&](std::size_t i) { return hierarchy[i].leaf() && scene.exposure.area[i] > 0.0; };
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (!counts(i)) { continue; }
    area += counted(i);
    if (!scene.lamps[hierarchy[i].surface]) { glow += counted(i) * scene.emission[hierarchy[i].surface]; }
  }
  if (!(area > 0.0)) { return {std::vector<double>(hierarchy.size(), 0.0)}; }
  glow /= area;
  Brightness brightness{std::vector<double>(hierarchy.size(), 0.0)};
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {  // parents before children
    const std::uint32_t parent = hierarchy[i].parent;
    if (hierarchy[i].is_cluster()) { continue; }
    if (parent != no_node && !hierarchy[parent].is_cluster()) { irradiance[i] += irradiance[parent]; }
    const std::uint32_t surface = hierarchy[i].surface;
    if (scene.lamps[surface]) { continue; }
    brightness.of[i] = brightest(scene.emission[surface] + scene.reflectance[surface] * irradiance[i]);
    const double reflected = brightest(scene.reflectance[surface] * (irradiance[i] + glow));
    if (!counts(i)) { continue; }
    brightness.reflected += counted(i) * reflected * reflected;
    brightness.mean += counted(i) * reflected / area;
  }
  brightness.reflected = std::sqrt(brightness.reflected / area);
  return brightness;
}

// Splits nodes for indirect light.
class Spacing {
 public:
  Spacing(DiscreteScene& scene, const Links& of_lamps, Importance& importance, double tolerance, double min_area)
      : scene_{scene}, importance_{importance}, links_{of_lamps.size()}, tolerance_{tolerance} {
    importance.extend(scene.hierarchy, scene.patches);
    const CountedAreas counted{scene};
    Brightness brightness = brightness_without_lamps(scene, of_lamps, counted);
    brightness_ = std::move(brightness.of);
    root_mean_square_ = brightness.reflected;
    evenness_ = dark() ? 1.0 : std::min(1.0, 4.0 * brightness.mean / root_mean_square_);
    rest_ = 0.5 * evenness_;
    for (std::uint32_t i = 0; i < scene.hierarchy.size(); ++i) {
      if (!is_input_face(scene.hierarchy, i)) { continue; }
      area_ += counted(i);
      if (!scene.lamps[scene.hierarchy[i].surface]) { open_.push_back(i); }
    }
    least_area_ = min_area * area_;
    if (evenness_ < 1.0) { shots_ = ShotLight{scene, LeafLocator{scene.hierarchy, scene.patches, scene.inputs.size()}, brightness_}; }
    weight_.assign(scene.hierarchy.size(), 1.0);
  }

  // Weights errors by the picture from now on, using what is seen of a coarse spacing. To be called first.
  void look_from(const Viewpoint& from, SpacingResult& result) {
    const std::vector<std::uint32_t> input_faces = open_;
    tolerance_ *= coarse;
    while (step(result)) {}
    tolerance_ /= coarse;
    if (result.cancelled || result.too_large > 0) { return; }
    result.casters.clear();
    ViewImportance importance = view_importance(scene_, std::exchange(views_, {}), brightness_, from);
    open_ = input_faces;
    if (!(importance.reflected > 0.0)) { return; }
    brightness_ = std::move(importance.brightness);
    root_mean_square_ = importance.reflected;
    weight_ = std::move(importance.weight);
    gain_ = 1.0;
    rest_ = 0.5 * evenness_ * evenness_ * importance.pictured / importance.reflected;
  }

  [[nodiscard]] bool dark() const { return !(root_mean_square_ > 0.0); }

  // One generation; returns false when no node is open.
  [[nodiscard]] bool step(SpacingResult& result) {
    std::erase_if(open_, [&](std::uint32_t i) { return !(scene_.exposure.area[i] > 0.0); });
    if (open_.empty()) { return false; }
    const StoredRays rays = cast(result);
    if (result.cancelled) { return false; }
    const std::vector<Arrived> arrived = arrived_by_shots();
    std::vector<std::uint32_t> wanting;
    std::uint64_t nodes = scene_.hierarchy.size();
    for (const std::uint32_t i : open_) {
      const Node& node = scene_.hierarchy[i];
      const Weights weight = weights(i, rays, arrived[i]);
      const double varies = node.radius * rays.nearness(i, 0.1 * node.radius);
      const double counts = std::max(weight_[i], importance_.weight(i));
      const bool fine = (varies * weight.mean + node.radius * weight.near) * std::sqrt(counts * node.area / area_) <= tolerance_ &&
                        !importance_.uneven(i);
      if (fine || (node.leaf() && !(counts * node.area > least_area_))) {
        result.casters.push_back({i, weight.scatter * std::sqrt(weight_[i])});
        views_.push_back(view(i, rays));
      } else {
        wanting.push_back(i);
        nodes += node.leaf() ? node.corners : 0;
      }
    }
    const MemoryBudget::Counts needed{nodes, links_};
    if (!scene_.budget.allows(needed)) {
      result.too_large = scene_.budget.peak(needed);
      return false;
    }
    descend(wanting, result);
    ++result.generations;
    if (scene_.control.after_generation) { scene_.control.after_generation(scene_.surfaces); }
    return true;
  }

  void split_as_senders(SpacingResult& result) const {
    std::vector<double> brightness = brightness_;
    for (double& of_node : brightness) { of_node /= root_mean_square_; }
    result.casters = split_senders(scene_, std::move(result.casters), views_, brightness, tolerance_ / 3.0);
  }

 private:
  static constexpr double coarse = 2.0;  // factor of the tolerance for the coarse spacing
  static constexpr std::uint32_t rays_each = std::tuple_size_v<decltype(CasterView::rays)>;

  // Casts rays_each rays from each open node.
  [[nodiscard]] StoredRays cast(SpacingResult& result) const {
    std::vector<std::uint32_t> counts(scene_.hierarchy.size(), 0);
    for (const std::uint32_t i : open_) { counts[i] = rays_each; }
    StoredRays rays = cast_rays(scene_, LeafLocator{scene_.hierarchy, scene_.patches, scene_.inputs.size()}, counts, RayUse::spacing);
    result.rays += rays.size();
    result.cancelled = scene_.control.cancelled();
    return rays;
  }

  // Sums over the shots that hit a node: of the squared brightness of their sources, and of brightness over length. The weight of one of
  // the node's own rays is 1.
  struct Arrived {
    double square = 0.0, near = 0.0;
  };
  [[nodiscard]] std::vector<Arrived> arrived_by_shots() const {
    const Hierarchy& hierarchy = scene_.hierarchy;
    std::vector<Arrived> arrived(hierarchy.size());
    if (evenness_ == 1.0) { return arrived; }
    std::vector<bool> open(hierarchy.size(), false);
    for (const std::uint32_t i : open_) { open[i] = true; }
    for (const ShotLight::Ray& ray : shots_.on(hierarchy, LeafLocator{hierarchy, scene_.patches, scene_.inputs.size()}, open)) {
      const double own = rays_each / scene_.exposure.area[ray.on];
      const double part = own / (own + shots_.density(hierarchy, ray.from));
      const double brightness = brightness_[ray.from] / root_mean_square_;
      arrived[ray.on].square += part * brightness * brightness;
      arrived[ray.on].near += part * brightness / ray.length;
    }
    return arrived;
  }

  // The light that a node reflects of what it sees, relative to the scene. mean: over its rays, for the variation of the light over the
  // node; scatter: RMS over its rays, for their noise. What is seen has reflected the light of lamps once. Light reflected more often is
  // more even: it is taken as a quarter of all where everything is lit alike; where little is lit, its mean is about as bright as that
  // light.
  struct Weights {
    double mean = 0.0, scatter = 0.0;
    double near = 0.0;  // light seen along shots, weighted by 1 / length; not included in the mean
  };
  [[nodiscard]] Weights weights(std::uint32_t i, const StoredRays& rays, const Arrived& arrived) const {
    double sum = 0.0;
    double square = arrived.square;
    const auto count = static_cast<double>(rays.count(i));
    for (const StoredRay& ray : rays.of(i)) {
      if (ray.to == no_node) { continue; }
      const double brightness = brightness_[ray.to] / root_mean_square_;
      const double density = count / scene_.exposure.area[i];
      const double part = density / (density + shots_.density(scene_.hierarchy, ray.to));
      sum += part * brightness;
      square += part * brightness * brightness;
    }
    const double most = brightest(scene_.reflectance[scene_.hierarchy[i].surface]);
    return {most * (gain_ * sum / count + rest_), most * (gain_ * std::sqrt(square / count) + rest_), most * gain_ * arrived.near / count};
  }

  [[nodiscard]] CasterView view(std::uint32_t i, const StoredRays& rays) const {
    CasterView result{i, weight_[i] * scene_.exposure.area[i] / area_, brightest(scene_.reflectance[scene_.hierarchy[i].surface]), {}};
    std::transform(rays.of(i).begin(), rays.of(i).end(), result.rays.begin(), [](const StoredRay& ray) {
      return CasterView::Seen{ray.to, ray.length};
    });
    return result;
  }

  // Opens the children of the nodes; leaves that the BRep refuses to split become casters.
  void descend(const std::vector<std::uint32_t>& nodes, SpacingResult& result) {
    open_.clear();
    Hierarchy& hierarchy = scene_.hierarchy;
    for (const std::uint32_t i : nodes) {
      if (hierarchy[i].leaf() && !subdivide(scene_.surfaces, hierarchy, i, scene_.meshing)) {
        result.casters.push_back({i, 1.0});
        continue;
      }
      for (std::uint32_t k = 0; k < hierarchy[i].child_count; ++k) { open_.push_back(hierarchy[i].first_child + k); }
    }
    for (std::size_t i = brightness_.size(); i < hierarchy.size(); ++i) {
      brightness_.push_back(brightness_[hierarchy[i].parent]);
      weight_.push_back(weight_[hierarchy[i].parent]);
    }
    scene_.expose();
    importance_.extend(hierarchy, scene_.patches);
  }

  DiscreteScene& scene_;
  Importance& importance_;
  std::uint64_t links_;
  double tolerance_;
  std::vector<double> brightness_;  // by node
  double root_mean_square_ = 0.0;   // of the reflected light, over the scene
  std::vector<double> weight_;      // by node: ViewImportance::weight
  double gain_ = 1.5, rest_ = 0.5;  // see weights()
  double evenness_ = 1.0;           // of the light: 1 unless little of the scene is lit
  ShotLight shots_;                 // empty if evenness_ is 1
  double area_ = 0.0, least_area_ = 0.0;
  std::vector<std::uint32_t> open_;
  std::vector<CasterView> views_;  // by caster
};

}  // namespace detail

HALFLIGHT_INLINE SpacingResult space_casters(DiscreteScene& scene, Links& of_lamps, Importance& importance, double tolerance,
                                             double min_area) {
  SpacingResult result;
  const std::size_t before = scene.hierarchy.size();
  std::vector<bool> was_leaf(before);
  for (std::size_t i = 0; i < before; ++i) { was_leaf[i] = scene.hierarchy[i].leaf(); }
  detail::Spacing spacing{scene, of_lamps, importance, tolerance, min_area};
  if (spacing.dark()) { return result; }
  if (scene.control.viewpoint) { spacing.look_from(*scene.control.viewpoint, result); }
  while (result.too_large == 0 && spacing.step(result)) {}
  spacing.split_as_senders(result);
  const auto split = [&](std::uint32_t i) { return was_leaf[i] && !scene.hierarchy[i].leaf(); };
  for (Link& link : of_lamps) {  // links of clusters have gradients already
    if (scene.hierarchy[link.p].is_cluster() || scene.hierarchy[link.q].is_cluster()) { continue; }
    if (split(link.p) || split(link.q)) { set_gradients(link, variations(scene.patches[link.p], scene.patches[link.q])); }
  }
  return result;
}

}  // namespace radiosity
