// SPDX-License-Identifier: MIT
#include <radiosity/visibility/exposure.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/geometry.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/point_query.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/curved_area.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/scene_view.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

// The bounds of all objects, for finding those near a patch.
class Neighbourhood {
 public:
  Neighbourhood() = default;
  explicit Neighbourhood(const raycast::Scene& scene) {
    for (std::uint32_t i = 0; i < scene.size(); ++i) {
      boxes_.push_back(scene.object(i).bounds());
      if (scene.object(i).inside()) { rooms_.push_back(i); }
    }
    tree_ = raycast::Bvh{boxes_};
    margin_ = 1e-6 * scene.diameter();  // far more than the tolerance of occlusion (raycast/scene.hpp)
  }

  // Can anything lie on or over this patch of the object? Not if the bounds of all other objects stay clear of it.
  [[nodiscard]] bool may_be_buried(std::uint32_t object, const Patch& patch) const {
    if (rooms_.size() > 1 || (rooms_.size() == 1 && rooms_.front() != object)) { return true; }
    raycast::Box box;
    for (const glm::dvec3& p : patch.contour) { box.extend(p); }
    box = box.grown(margin_);
    return raycast::any_within(
        tree_, [&](const raycast::Box& other) { return other.meets(box); },
        [&](std::uint32_t item) { return item != object && boxes_[item].meets(box); });
  }

 private:
  std::vector<raycast::Box> boxes_;  // by object
  std::vector<std::uint32_t> rooms_;
  raycast::Bvh tree_;
  double margin_ = 0.0;
};

// One call of extend().
class ExposureMeasurement {
 public:
  ExposureMeasurement(Exposure& exposure, const SceneView& scene, unsigned threads, std::uint64_t seed)
      : to_{exposure}, scene_{scene}, threads_{threads}, seed_{seed}, neighbourhood_{scene.objects} {}

  // Measures the leaves among the nodes from `first_new` on.
  void measure_leaves(std::size_t first_new) {
    const Hierarchy& hierarchy = scene_.hierarchy;
    const std::size_t new_nodes = hierarchy.size() - first_new;
    std::vector<char> mixed(new_nodes, 0);
    parallel_for(new_nodes, threads_, [&](std::size_t k) {
      if (hierarchy[first_new + k].leaf()) { mixed[k] = measure_leaf(first_new + k) ? 1 : 0; }
    });
    std::vector<std::uint32_t> nodes;
    for (std::size_t k = 0; k < new_nodes; ++k) {
      if (mixed[k] != 0) { nodes.push_back(static_cast<std::uint32_t>(first_new + k)); }
    }
    draw(nodes);
    for (const std::uint32_t i : nodes) { to_.area[i] = to_.whole[i] * (to_.drawn[to_.drawn_of[i]].count() / 256.0); }
  }

  // Sets areas and centroids of the inner nodes from their children.
  void sum_up() {
    const Hierarchy& hierarchy = scene_.hierarchy;
    to_.buried_leaves = 0;
    for (std::size_t i = hierarchy.size(); i-- > 0;) {
      const Node& node = hierarchy[i];
      if (node.leaf()) {
        to_.buried_leaves += to_.area[i] == 0.0 ? 1 : 0;
        continue;
      }
      to_.whole[i] = to_.area[i] = 0.0;
      to_.centroid[i] = glm::dvec3{0.0};
      for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
        to_.whole[i] += to_.whole[c];
        to_.area[i] += to_.area[c];
        to_.centroid[i] += to_.area[c] * to_.centroid[c];
      }
      to_.centroid[i] = to_.area[i] > 0.0 ? to_.centroid[i] / to_.area[i] : node.centre;
    }
    to_.all_buried = std::none_of(to_.area.begin(), to_.area.end(), [](double a) { return a > 0.0; });
  }

  // Draws exposed points for partly buried patches that have none.
  void draw_partly_buried() {
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t i = 0; i < scene_.hierarchy.size(); ++i) {
      to_.partly_buried[i] = to_.area[i] > 0.0 && to_.area[i] < to_.whole[i];
      if (to_.partly_buried[i] && to_.drawn_of[i] == no_node && !scene_.hierarchy[i].is_cluster()) { nodes.push_back(i); }
    }
    draw(nodes);
  }

 private:
  // Are some, but not all, of 16 stratified points buried? Then the area is that of the whole leaf until more points have been drawn.
  [[nodiscard]] bool measure_leaf(std::size_t i) {
    const Node& node = scene_.hierarchy[i];
    const Surface& surface = scene_.surfaces[node.object];
    const Patch& patch = scene_.patches[i];
    // A separate polygon counts with its own area, because its quad-tree does not follow the curved surface.
    const bool curved = node.deviation > 0.0 && surface.topology == Topology::shared;
    to_.whole[i] = curved ? curved_area(scene_.objects.object(node.object), scene_.sheet(i), patch.contour)
                          : glm::length(brep::vector_area(surface.brep, node.face));
    to_.centroid[i] = patch.centroid;
    to_.area[i] = to_.whole[i];
    if (!neighbourhood_.may_be_buried(node.object, patch)) { return false; }
    Random random{key(i), 16};
    std::uint32_t count = 0;
    for (std::uint32_t c = 0; c < 16; ++c) {
      const double u = (c % 4 + random.uniform()) / 4.0;
      count += buried(scene_.objects, node.object, scene_.sheet(i), sample(patch, u, (c / 4 + random.uniform()) / 4.0)) ? 0u : 1u;
    }
    if (count == 0) { to_.area[i] = 0.0; }
    return count > 0 && count < 16;
  }

  // Draws points for nodes that have none yet.
  void draw(const std::vector<std::uint32_t>& nodes) {
    const std::size_t first = to_.drawn.size();
    to_.drawn.resize(first + nodes.size());
    parallel_for(nodes.size(), threads_, [&](std::size_t k) {
      const std::uint32_t i = nodes[k];
      to_.drawn_of[i] = static_cast<std::uint32_t>(first + k);
      to_.drawn[first + k] = ExposedPoints{scene_.objects, scene_.hierarchy[i].object, scene_.sheet(i), scene_.patches[i], key(i)};
    });
  }

  [[nodiscard]] std::uint64_t key(std::size_t i) const { return Random{seed_, i, 0x6578706f73656421ull}.bits(); }

  Exposure& to_;
  SceneView scene_;
  unsigned threads_;
  std::uint64_t seed_;
  Neighbourhood neighbourhood_;
};

HALFLIGHT_INLINE PatchEnd patch_end(const SceneView& scene, const Exposure* exposure, std::uint32_t i) {
  return {&scene.patches[i], scene.hierarchy[i].object, exposure != nullptr ? exposure->points(i) : nullptr, scene.sheet(i)};
}

HALFLIGHT_INLINE void extend(Exposure& exposure, const SceneView& scene, unsigned threads, std::uint64_t seed) {
  const std::size_t first_new = exposure.area.size(), nodes = scene.hierarchy.size();
  exposure.whole.resize(nodes, 0.0);
  exposure.area.resize(nodes, 0.0);
  exposure.centroid.resize(nodes, glm::dvec3{0.0});
  exposure.drawn_of.resize(nodes, no_node);
  exposure.partly_buried.resize(nodes);
  ExposureMeasurement measurement{exposure, scene, threads, seed};
  measurement.measure_leaves(first_new);
  measurement.sum_up();
  measurement.draw_partly_buried();
}

}  // namespace radiosity
