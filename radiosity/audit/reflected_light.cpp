// SPDX-License-Identifier: MIT
#include <radiosity/audit/reflected_light.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/buried.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/oracle/lit_faces.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

// The triangles of the input faces, for drawing points with a given density that is constant on each face.
class FacePoints {
 public:
  // `density(node)`: per area, of the input face with this node index.
  template <class Density>
  FacePoints(const DiscreteScene& scene, const Density& density) {
    for (std::uint32_t i = 0; i < scene.hierarchy.size(); ++i) {
      const double of_face = is_input_face(scene.hierarchy, i) ? density(i) : 0.0;
      if (!(of_face > 0.0)) { continue; }
      const Patch& patch = scene.patches[i];
      if (patch.parts.empty()) { add(i, patch.contour, of_face); }
      for (const Polygon& part : patch.parts) { add(i, part, of_face); }
    }
  }
  // The integral of the density.
  [[nodiscard]] double total() const { return triangles_.empty() ? 0.0 : triangles_.back().until; }

  struct Point {
    raycast::ScenePoint at;
    bool covered = false;
  };
  // The point at which the cumulative density reaches `share` of the total.
  [[nodiscard]] Point point(const DiscreteScene& scene, double share, Random& random) const {
    const Triangle& t = drawn(triangles_, share * total());
    const double u = random.uniform();
    const glm::dvec3 chord = triangle_point(triangle_weights(u, random.uniform()), t.a, t.b, t.c);
    const Node& node = scene.hierarchy[t.node];
    const std::uint32_t sheet = scene.inputs[node.surface].sheet;
    const raycast::ScenePoint at{scene.objects.object(node.object).project(sheet, chord), node.object, sheet};
    return {at, scene.objects.covered(at)};
  }

 private:
  struct Triangle {
    std::uint32_t node = no_node;
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};
    double until = 0.0;  // cumulative density up to and including this triangle
  };
  void add(std::uint32_t node, const Polygon& convex, double density) {
    for (std::size_t k = 1; k + 1 < convex.size(); ++k) {
      const double area = triangle_area(convex[0], convex[k], convex[k + 1]);
      if (area > 0.0) { triangles_.push_back({node, convex[0], convex[k], convex[k + 1], total() + area * density}); }
    }
  }
  std::vector<Triangle> triangles_;
};

// Running mean of samples, with its standard error.
struct Mean {
  double sum = 0.0, squares = 0.0;

  void add(double sample) {
    sum += sample;
    squares += sample * sample;
  }
  [[nodiscard]] double value(double count) const { return sum / count; }
  [[nodiscard]] double doubt(double count) const { return std::sqrt(std::max(0.0, squares / count - value(count) * value(count)) / count); }
};

// One estimate of the radiosity that is reflected once, without the emission.
[[nodiscard]] HALFLIGHT_INLINE Color reflected_once(const PathTracer& tracer, const raycast::ScenePoint& at, Random& random) {
  std::uint64_t rays = 0;
  return tracer.radiosity(at, random, rays, 1).direct - tracer.of(at).emission;
}

// Square of that radiosity at a uniformly drawn point: the product of two independent estimates, whose noise cancels on average.
[[nodiscard]] HALFLIGHT_INLINE double square_at_point(const DiscreteScene& scene, const PathTracer& tracer, const FacePoints& area,
                                                      double share, Random random) {
  const FacePoints::Point point = area.point(scene, share, random);
  if (point.covered) { return 0.0; }
  Color product{1.0};
  for (int k = 0; k < 2; ++k) { product *= reflected_once(tracer, point.at, random); }
  return brightest(product);
}

// Point where a ray from a lamp arrives at the front of a surface.
[[nodiscard]] HALFLIGHT_INLINE std::optional<raycast::ScenePoint> end_of_lamp_ray(const DiscreteScene& scene, const FacePoints& lamps,
                                                                                  double share, Random& random) {
  const FacePoints::Point from = lamps.point(scene, share, random);
  if (from.covered) { return std::nullopt; }
  const double u = random.uniform();
  const raycast::Segment ray{from.at.position, cosine_direction(from.at.normal, u, random.uniform()) * scene.objects.diameter()};
  const auto hit = scene.objects.closest(from.at, ray.direction);
  if (!hit || !hit->front) { return std::nullopt; }
  return scene.objects.point(*hit, ray);
}

// Distributions of points: uniform over the lit faces, and proportional to emission over the faces that are not buried.
struct FacesAndLamps {
  std::vector<bool> buried;
  LitFaces lit;
  FacePoints area, lamps;
  explicit FacesAndLamps(const DiscreteScene& scene)
      : buried{buried_nodes(scene.surfaces, scene.hierarchy)},
        lit{scene.view(), scene.reflectance, scene.emission, buried},
        area{scene, [&](std::uint32_t i) { return lit.weight(i); }},
        lamps{scene, [&](std::uint32_t i) {
                return i < buried.size() && buried[i] ? 0.0 : brightest(scene.emission[scene.hierarchy[i].surface]);
              }} {}
};

// Estimate of the same square from the end of a lamp ray, which often lies in a bright spot: the radiosity there times `power`, the mean
// radiosity that such rays bring over the area of the lit faces.
[[nodiscard]] HALFLIGHT_INLINE double square_by_lamp(const DiscreteScene& scene, const PathTracer& tracer, const FacesAndLamps& faces,
                                                     double power, double share, Random random) {
  const std::optional<raycast::ScenePoint> end = end_of_lamp_ray(scene, faces.lamps, share, random);
  if (!end) { return 0.0; }
  const double counts = faces.lit.weight_of_surface(tracer.surface(end->object, end->sheet));
  if (!(counts > 0.0)) { return 0.0; }
  return power * counts * brightest(tracer.of(*end).reflectance * reflected_once(tracer, *end, random));
}

}  // namespace detail

HALFLIGHT_INLINE double reflected_light(const DiscreteScene& scene, const PathTracer& tracer) {
  constexpr std::size_t batch = 256, most = 16384;
  const detail::FacesAndLamps faces{scene};
  const detail::FacePoints &area = faces.area, &lamps = faces.lamps;
  if (!(area.total() > 0.0) || !(lamps.total() > 0.0)) { return 1.0; }
  const double emitted = lamps.total() / area.total();
  double result = 1.0;
  detail::Mean at_points, by_lamps;
  std::vector<double> samples(2 * batch);
  for (std::size_t points = 0; points < most && !scene.control.cancelled();) {
    parallel_for(
        samples.size(), scene.threads,
        [&](std::size_t i) {
          Random random{scene.seed, points + i / 2, i % 2 == 0 ? 0x7265666c65637473ull : 0x6c616d7072617973ull};
          const double share = (static_cast<double>(i / 2) + random.uniform()) / static_cast<double>(batch);
          samples[i] = i % 2 == 0 ? detail::square_at_point(scene, tracer, area, share, random)
                                  : detail::square_by_lamp(scene, tracer, faces, emitted, share, random);
        },
        16);
    for (std::size_t i = 0; i < samples.size(); ++i) { (i % 2 == 0 ? at_points : by_lamps).add(samples[i]); }
    points += batch;
    const auto count = static_cast<double>(points);
    const detail::Mean& larger = at_points.sum >= by_lamps.sum ? at_points : by_lamps;
    const double square = larger.value(count), doubt = larger.doubt(count);
    if (!(square > 0.0)) { continue; }
    result = std::sqrt(square) / emitted;
    if (doubt < 0.2 * square || square - doubt > emitted * emitted) { break; }  // 10 % of the root
  }
  return result;
}

HALFLIGHT_INLINE double mean_reflected_light(const DiscreteScene& scene, const PathTracer& tracer) {
  constexpr std::uint32_t rays = 1024;
  const detail::FacesAndLamps faces{scene};
  if (!(faces.area.total() > 0.0) || !(faces.lamps.total() > 0.0)) { return 1.0; }
  double sum = 0.0;
  for (std::uint32_t i = 0; i < rays; ++i) {
    Random random{scene.seed, i, 0x6d65616e6c616d70ull};
    const auto end = detail::end_of_lamp_ray(scene, faces.lamps, (i + random.uniform()) / rays, random);
    if (!end) { continue; }
    const std::uint32_t surface = tracer.surface(end->object, end->sheet);
    sum += faces.lit.weight_of_surface(surface) * brightest(tracer.material(surface).reflectance);
  }
  return sum / rays;
}

}  // namespace radiosity
