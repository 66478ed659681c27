// SPDX-License-Identifier: MIT
#include <radiosity/audit/reflected_light.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/inline.hpp>
#include <raycast/object.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

// The triangles of the input faces, each with the area up to and with it.
class InputArea {
 public:
  explicit InputArea(const DiscreteScene& scene) {
    const Hierarchy& nodes = scene.hierarchy;
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
      if (!is_input_face(nodes, i)) { continue; }
      const Patch& patch = scene.patches[i];
      emission_ += nodes[i].area * scene.emission[nodes[i].surface];
      if (patch.parts.empty()) { add(i, patch.contour); }
      for (const Polygon& part : patch.parts) { add(i, part); }
    }
  }
  struct Place {
    std::uint32_t node = no_node;
    glm::dvec3 position{0.0};
  };
  // A point of the share `at` of the area.
  [[nodiscard]] Place place(double at, Random& random) const {
    auto t = std::upper_bound(triangles_.begin(), triangles_.end(), at * total_, [](double a, const Triangle& b) { return a < b.until; });
    if (t == triangles_.end()) { --t; }
    const double root = std::sqrt(random.uniform());
    const double v = random.uniform();
    return {t->node, (1.0 - root) * t->a + root * (1.0 - v) * t->b + root * v * t->c};
  }
  [[nodiscard]] bool empty() const { return triangles_.empty(); }
  // Radiant exitance in the mean over the area, of the brightest channel.
  [[nodiscard]] double mean_emission() const { return brightest(emission_) / total_; }

 private:
  struct Triangle {
    std::uint32_t node = no_node;
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};
    double until = 0.0;
  };
  void add(std::uint32_t node, const Polygon& convex) {
    for (std::size_t k = 1; k + 1 < convex.size(); ++k) {
      const double area = 0.5 * glm::length(glm::cross(convex[k] - convex[0], convex[k + 1] - convex[0]));
      if (!(area > 0.0)) { continue; }
      total_ += area;
      triangles_.push_back({node, convex[0], convex[k], convex[k + 1], total_});
    }
  }
  std::vector<Triangle> triangles_;
  Color emission_{0.0};
  double total_ = 0.0;
};

// The product of two independent estimates of the reflected radiosity at a point; its mean over the points has no noise of paths in it.
[[nodiscard]] HALFLIGHT_INLINE Color squared_light(const DiscreteScene& scene, const PathTracer& tracer, const InputArea::Place& place,
                                                   Random& random, std::uint64_t& rays) {
  const Node& node = scene.hierarchy[place.node];
  const InputSurface& input = scene.inputs[node.surface];
  const raycast::SurfacePoint at = scene.objects.object(node.object).project(input.sheet, place.position);
  if (scene.objects.covered(at.position, at.normal, node.object)) { return Color{0.0}; }
  Color product{1.0};
  for (int k = 0; k < 2; ++k) {
    product *= tracer.radiosity(at.position, at.normal, node.object, input.sheet, random, rays).all - scene.emission[node.surface];
  }
  return product;
}

}  // namespace detail

HALFLIGHT_INLINE ReflectedLight reflected_light(const DiscreteScene& scene, const PathTracer& tracer) {
  constexpr std::size_t batch = 256, most = 4096;
  ReflectedLight result;
  const detail::InputArea area{scene};
  const double emitted = area.empty() ? 0.0 : area.mean_emission();
  if (!(emitted > 0.0)) { return result; }
  Color sum{0.0}, squares{0.0};
  std::vector<Color> products(batch);
  std::vector<std::uint64_t> rays(batch);
  for (std::size_t points = 0; points < most && !scene.control.cancelled();) {
    std::fill(rays.begin(), rays.end(), 0);
    parallel_for(
        batch, scene.threads,
        [&](std::size_t i) {
          Random random{scene.seed, points + i, 0x7265666c65637473ull};
          const double at = (static_cast<double>(i) + random.uniform()) / static_cast<double>(batch);
          products[i] = detail::squared_light(scene, tracer, area.place(at, random), random, rays[i]);
        },
        16);
    for (std::size_t i = 0; i < batch; ++i) {
      sum += products[i];
      squares += products[i] * products[i];
      result.rays += rays[i];
    }
    points += batch;
    const double count = static_cast<double>(points);
    const Color mean = sum / count;
    const int c = mean.x >= mean.y && mean.x >= mean.z ? 0 : mean.y >= mean.z ? 1 : 2;
    const double doubt = std::sqrt(std::max(0.0, squares[c] / count - mean[c] * mean[c]) / count);
    const double least = emitted * emitted / (count * count);
    result.share = std::sqrt(std::max(mean[c], least)) / emitted;
    const bool known = mean[c] > least && doubt < 0.5 * mean[c];  // of the square: a quarter of the root
    if (known || mean[c] - doubt > emitted * emitted) { break; }
  }
  return result;
}

}  // namespace radiosity
