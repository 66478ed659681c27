// SPDX-License-Identifier: MIT
#include <radiosity/refinement/leaf_splits.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/refinement/coarse_light.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/leaf_error.hpp>
#include <radiosity/refinement/link_fitting.hpp>
#include <radiosity/support/memory.hpp>

namespace radiosity {

namespace detail {

// Estimate of the variation of one patch's light over another: gradient, as relative change per length of the kernel between their
// centres, and the RMS deviation from that linear function, relative to the mean; 1 if they are too near for an estimate.
struct RoughVariation {
  glm::dvec3 gradient{0.0};
  double rest = 1.0;
};

// Gradient of ln (cos cos / r^2): 4 d / r^2 from the distance, n / height from the height above the other's plane, and a term from the
// variation of the own normal. The remainder is of second order in the largest change over the patch.
[[nodiscard]] HALFLIGHT_INLINE RoughVariation rough_variation(const Node& over, const Patch& patch, const Node& from) {
  const glm::dvec3 d = from.centre - over.centre;
  const double r = glm::length(d);
  const double near = r - from.radius;
  const double height = -glm::dot(from.normal, d);     // of this patch above the other's plane
  const double own_height = glm::dot(over.normal, d);  // of the other patch above this one's plane
  if (!(near > over.radius) || !(height > 0.0) || !(own_height > 0.0)) { return {}; }
  const double most = 0.5 * (over.radius * (4.0 / near + 1.0 / height) + over.deviation * r / own_height);
  if (!(most < 1.0)) { return {}; }
  glm::dvec3 gradient = 4.0 / (r * r) * d + from.normal / height;
  if (patch.bent) { gradient += glm::transpose(patch.bend) * d / own_height; }
  gradient -= glm::dot(gradient, over.normal) * over.normal;
  return {gradient, most * most};
}

// One call of split_leaves_by_light().
class LeafSplitting {
 public:
  LeafSplitting(DiscreteScene& scene, Links& links, const LeafSplitRule& rule)
      : scene_{scene}, hierarchy_{scene.hierarchy}, area_{scene.exposure.area}, links_{links}, light_{coarse_light(scene, links, 3)} {
    const double share = 0.25 * rule.light_epsilon;
    least_error_ = share * share * light_.reflected_square;
    least_area_ = rule.min_area * lit_area(scene);
  }

  [[nodiscard]] LeafSplits operator()(DoubtSum& doubt) {
    choose_candidates();
    set_gradients_at_candidates(doubt);
    LeafSplits result;
    std::vector<Wanted> wanted = find_wanted();
    if (wanted.empty() || scene_.control.cancelled()) { return result; }
    const MemoryBudget::Counts needed{most_nodes(wanted), links_.size()};
    if (!scene_.budget.allows(needed)) {
      result.too_large = scene_.budget.peak(needed);
      return result;
    }
    const std::vector<double> area_before = area_;
    result.count = split(std::move(wanted));
    scene_.expose();
    fit_links(scene_, links_, area_before);
    return result;
  }

 private:
  // A leaf and its squared error.
  struct Wanted {
    std::uint32_t node = no_node;
    double error = 0.0;
    bool again = true;  // may its children be split, too?
  };

  [[nodiscard]] double reflectance(std::size_t i) const { return light_.reflectance[hierarchy_[i].surface]; }
  // False also for lamps with clusters: links of lamp clusters are not made for parts of lamps.
  [[nodiscard]] bool may_split(std::size_t i) const {
    const Node& node = hierarchy_[i];
    return node.leaf() && node.area > least_area_ && area_[i] > 0.0 && !scene_.exposure.partly_buried[i] && reflectance(i) > 0.0 &&
           !(scene_.lamp_exchange && scene_.lamps[node.surface]);
  }
  [[nodiscard]] bool between_leaves(const Link& link) const { return hierarchy_[link.p].leaf() && hierarchy_[link.q].leaf(); }
  // Calls visit(link, i, j, shape) for each end i of a link that is a patch and may have a gradient; j: the other end. Links with
  // clusters have no gradients, except those with clusters of lamps.
  template <class Visit>
  void each_end(const Visit& visit) const {
    for (const Link& link : links_) {
      const bool p_cluster = hierarchy_[link.p].is_cluster(), q_cluster = hierarchy_[link.q].is_cluster();
      if (scene_.clustered() && (p_cluster || q_cluster)) { continue; }
      if (!p_cluster && area_[link.p] > 0.0) { visit(link, link.p, link.q, link.shape_p); }
      if (!q_cluster && area_[link.q] > 0.0) { visit(link, link.q, link.p, link.shape_q); }
    }
  }
  // Irradiance of a node by a link from another one.
  [[nodiscard]] double irradiance(const Link& link, std::uint32_t on, std::uint32_t from) const {
    return static_cast<double>(link.exchange) / area_[on] * light_.radiosity[from];
  }
  // Adds the gradients of a node to its children; to be called for parents first.
  void inherit(std::vector<glm::dvec3>& gradient, std::uint32_t i) const {
    const Node& node = hierarchy_[i];
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { gradient[c] += gradient[i]; }
  }

  // Marks leaves whose error may be large.
  void choose_candidates() {
    std::vector<glm::dvec3> gradient(hierarchy_.size(), glm::dvec3{0.0});
    std::vector<double> rest(hierarchy_.size(), 0.0);
    each_end([&](const Link& link, std::uint32_t i, std::uint32_t j, const EndShape& shape) {
      const double light = irradiance(link, i, j);
      if (!between_leaves(link)) {
        gradient[i] += light * shape.gradient();
      } else if (hierarchy_[i].area > least_area_) {
        const RoughVariation varies = rough_variation(hierarchy_[i], scene_.patches[i], hierarchy_[j]);
        gradient[i] += light * varies.gradient;
        rest[i] += light * varies.rest;
      }
    });
    candidate_.assign(hierarchy_.size(), 0);
    for (std::uint32_t i = 0; i < hierarchy_.size(); ++i) {
      inherit(gradient, i);
      if (!may_split(i)) { continue; }
      const double most = reflectance(i) * (rest[i] + 0.5 * hierarchy_[i].radius * glm::length(gradient[i]));
      candidate_[i] = area_[i] * most * most > least_error_ ? 1 : 0;
    }
  }

  // Sets the gradients of links between leaves if one of these is a candidate. Variation that they cannot express counts once the leaf is
  // split.
  void set_gradients_at_candidates(DoubtSum& doubt) {
    std::vector<char> leaf(hierarchy_.size());
    for (std::size_t i = 0; i < leaf.size(); ++i) { leaf[i] = hierarchy_[i].leaf() ? 1 : 0; }
    set_gradients_at(scene_, links_, candidate_, leaf,
                     [&](std::size_t k, const Doubt& left) { doubt.add(links_[k].p, links_[k].q, left); });
  }

  [[nodiscard]] std::vector<Wanted> find_wanted() const {
    std::vector<glm::dvec3> gradient(hierarchy_.size(), glm::dvec3{0.0});
    each_end([&](const Link& link, std::uint32_t i, std::uint32_t j, const EndShape& shape) {
      if (candidate_[i] != 0 || !hierarchy_[i].leaf()) { gradient[i] += irradiance(link, i, j) * shape.gradient(); }
    });
    std::vector<Wanted> wanted;
    for (std::uint32_t i = 0; i < hierarchy_.size(); ++i) {
      inherit(gradient, i);
      if (candidate_[i] == 0) { continue; }
      const double error = area_[i] * reflectance(i) * reflectance(i) * mean_square(scene_.patches[i], gradient[i]);
      if (error > least_error_) { wanted.push_back({i, error}); }
    }
    return wanted;
  }

  // The error that remains in a part with this share of a leaf's area, if the light is linear.
  [[nodiscard]] static double part_of(double error, double share) { return error * share * share; }
  [[nodiscard]] bool worth(const Wanted& leaf) const { return leaf.error > least_error_ && hierarchy_[leaf.node].area > least_area_; }

  [[nodiscard]] std::uint64_t most_nodes(const std::vector<Wanted>& wanted) const {
    std::uint64_t nodes = hierarchy_.size();
    for (const Wanted& leaf : wanted) {
      const std::uint64_t children = hierarchy_[leaf.node].corners;
      nodes += children * (part_of(leaf.error, 0.25) > least_error_ ? 1 + children : 1);
    }
    return nodes;
  }

  std::uint64_t split(std::vector<Wanted> wanted) {
    std::uint64_t count = 0;
    for (std::size_t k = 0; k < wanted.size(); ++k) {  // the list grows
      const Wanted leaf = wanted[k];
      if (at_blade(scene_, leaf.node) || !subdivide(scene_.surfaces, hierarchy_, leaf.node, scene_.meshing)) { continue; }
      ++count;
      const Node& node = hierarchy_[leaf.node];
      for (std::uint32_t c = node.first_child; leaf.again && c < node.first_child + node.child_count; ++c) {
        const Wanted child{c, part_of(leaf.error, hierarchy_[c].area / node.area), false};
        if (worth(child)) { wanted.push_back(child); }
      }
    }
    return count;
  }

  DiscreteScene& scene_;
  Hierarchy& hierarchy_;
  const std::vector<double>& area_;
  Links& links_;
  CoarseLight light_;
  double least_error_ = 0.0;  // squared error from which on a leaf is split
  double least_area_ = 0.0;
  std::vector<char> candidate_;  // by node
};

}  // namespace detail

HALFLIGHT_INLINE LeafSplits split_leaves_by_light(DiscreteScene& scene, Links& links, const LeafSplitRule& rule, DoubtSum& doubt) {
  if (scene.control.cancelled()) { return {}; }
  return detail::LeafSplitting{scene, links, rule}(doubt);
}

}  // namespace radiosity
