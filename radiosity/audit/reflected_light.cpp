// SPDX-License-Identifier: MIT
#include <radiosity/audit/reflected_light.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/bundle.hpp>
#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

// The triangles of the input faces, to choose points on them with a density that is even over each face.
class FacePoints {
 public:
  // `density`: of a face, by its node.
  template <class Density>
  FacePoints(const DiscreteScene& scene, const Density& density) {
    const Hierarchy& nodes = scene.hierarchy;
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
      const double of_face = is_input_face(nodes, i) ? density(nodes[i]) : 0.0;
      if (!(of_face > 0.0)) { continue; }
      const Patch& patch = scene.patches[i];
      if (patch.parts.empty()) { add(i, patch.contour, of_face); }
      for (const Polygon& part : patch.parts) { add(i, part, of_face); }
    }
  }
  // The integral of the density.
  [[nodiscard]] double total() const { return triangles_.empty() ? 0.0 : triangles_.back().until; }

  struct Point {
    raycast::SurfacePoint at;
    std::uint32_t node = no_node;
    bool covered = false;
  };
  // The point at a share of the total.
  [[nodiscard]] Point point(const DiscreteScene& scene, double share, Random& random) const {
    auto t = std::upper_bound(triangles_.begin(), triangles_.end(), share * total(), [](double a, const auto& b) { return a < b.until; });
    if (t == triangles_.end()) { --t; }
    const double root = std::sqrt(random.uniform());
    const double v = random.uniform();
    const Node& node = scene.hierarchy[t->node];
    const raycast::SurfacePoint at =
        scene.objects.object(node.object)
            .project(scene.inputs[node.surface].sheet, (1.0 - root) * t->a + root * (1.0 - v) * t->b + root * v * t->c);
    return {at, t->node, scene.objects.covered(at.position, at.normal, node.object)};
  }

 private:
  struct Triangle {
    std::uint32_t node = no_node;
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};
    double until = 0.0;  // total up to and with it
  };
  void add(std::uint32_t node, const Polygon& convex, double density) {
    for (std::size_t k = 1; k + 1 < convex.size(); ++k) {
      const double area = 0.5 * glm::length(glm::cross(convex[k] - convex[0], convex[k + 1] - convex[0]));
      if (area > 0.0) { triangles_.push_back({node, convex[0], convex[k], convex[k + 1], total() + area * density}); }
    }
  }
  std::vector<Triangle> triangles_;
};

// The mean of samples so far.
struct Mean {
  double sum = 0.0, squares = 0.0;

  void add(double sample) {
    sum += sample;
    squares += sample * sample;
  }
  [[nodiscard]] double value(double count) const { return sum / count; }
  [[nodiscard]] double doubt(double count) const { return std::sqrt(std::max(0.0, squares / count - value(count) * value(count)) / count); }
};

// What one point tells of the mean square of the reflected radiosity, and the rays that it took.
struct SquareSample {
  double value = 0.0;
  std::uint64_t rays = 0;
};

// At a point spread evenly over the area: the product of two independent estimates, in which the noise of paths cancels on average.
[[nodiscard]] HALFLIGHT_INLINE SquareSample of_area(const DiscreteScene& scene, const PathTracer& tracer, const FacePoints& area,
                                                    double share, Random random) {
  SquareSample sample;
  const FacePoints::Point point = area.point(scene, share, random);
  if (point.covered) { return sample; }
  const Node& node = scene.hierarchy[point.node];
  Color product{1.0};
  for (int k = 0; k < 2; ++k) {
    const auto light =
        tracer.radiosity(point.at.position, point.at.normal, node.object, scene.inputs[node.surface].sheet, random, sample.rays);
    product *= light.all - scene.emission[node.surface];
  }
  sample.value = brightest(product);
  return sample;
}

// Where a ray from a lamp arrives, which is often where the light is: the radiosity there, times what such rays bring in the mean over the
// scene's area, `power`. Light that comes from other surfaces is left out, so the mean of it is too small rather than too large.
[[nodiscard]] HALFLIGHT_INLINE SquareSample of_lamp(const DiscreteScene& scene, const PathTracer& tracer, const FacePoints& lamps,
                                                    double power, double share, Random random) {
  SquareSample sample;
  const FacePoints::Point from = lamps.point(scene, share, random);
  if (from.covered) { return sample; }
  const Node& lamp = scene.hierarchy[from.node];
  const double u = random.uniform();
  const raycast::Segment ray{from.at.position, cosine_direction(from.at.normal, u, random.uniform()) * scene.objects.diameter()};
  ++sample.rays;
  const auto hit = scene.objects.closest(ray, lamp.object, scene.inputs[lamp.surface].sheet);
  if (!hit || !hit->front) { return sample; }
  const raycast::SurfacePoint at = scene.objects.object(hit->object).project(hit->sheet, ray.at(hit->t));
  const Material& material = tracer.material(tracer.surface(hit->object, hit->sheet));
  const auto light = tracer.radiosity(at.position, at.normal, hit->object, hit->sheet, random, sample.rays);
  sample.value = power * brightest(material.reflectance * (light.all - material.emission));
  return sample;
}

}  // namespace detail

HALFLIGHT_INLINE ReflectedLight reflected_light(const DiscreteScene& scene, const PathTracer& tracer) {
  constexpr std::size_t batch = 256, most = 4096;
  const detail::FacePoints area{scene, [](const Node&) { return 1.0; }};
  const detail::FacePoints lamps{scene, [&](const Node& node) { return brightest(scene.emission[node.surface]); }};
  ReflectedLight result;
  if (!(area.total() > 0.0) || !(lamps.total() > 0.0)) { return result; }
  const double emitted = lamps.total() / area.total();
  detail::Mean of_area, of_lamps;
  std::vector<detail::SquareSample> samples(2 * batch);
  for (std::size_t points = 0; points < most && !scene.control.cancelled();) {
    parallel_for(
        samples.size(), scene.threads,
        [&](std::size_t i) {
          Random random{scene.seed, points + i / 2, i % 2 == 0 ? 0x7265666c65637473ull : 0x6c616d7072617973ull};
          const double share = (static_cast<double>(i / 2) + random.uniform()) / static_cast<double>(batch);
          samples[i] = i % 2 == 0 ? detail::of_area(scene, tracer, area, share, random)
                                  : detail::of_lamp(scene, tracer, lamps, emitted, share, random);
        },
        16);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      (i % 2 == 0 ? of_area : of_lamps).add(samples[i].value);
      result.rays += samples[i].rays;
    }
    points += batch;
    const auto count = static_cast<double>(points);
    const detail::Mean& larger = of_area.sum >= of_lamps.sum ? of_area : of_lamps;
    const double square = larger.value(count), doubt = larger.doubt(count);
    const double least = emitted * emitted / (count * count);
    result.share = std::sqrt(std::max(square, least)) / emitted;
    const bool known = square > least && doubt < 0.5 * square;  // a quarter of the root
    if (known || square - doubt > emitted * emitted) { break; }
  }
  return result;
}

}  // namespace radiosity
