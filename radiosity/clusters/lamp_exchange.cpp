// SPDX-License-Identifier: MIT
#include <radiosity/clusters/lamp_exchange.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/bundle.hpp>
#include <raycast/scene.hpp>

#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/geometry/hilbert_curve.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/segment_samples.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

HALFLIGHT_INLINE LampExchange::LampExchange(const SceneView& scene, const Exposure* exposure, const ShownAreas& shown,
                                            const std::vector<double>& emission)
    : scene_{scene}, exposure_{exposure}, shown_{&shown} {
  const Hierarchy& nodes = scene.hierarchy;
  first_.push_back(0);
  std::vector<std::uint32_t> faces, open;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {  // in the order of their numbers
    if (!nodes[i].is_cluster()) { continue; }
    faces.clear();
    open.assign(1, i);
    while (!open.empty()) {
      const std::uint32_t top = open.back();
      open.pop_back();
      if (!nodes[top].is_cluster()) {
        if (area(top) > 0.0) { faces.push_back(top); }
        continue;
      }
      for (std::uint32_t k = nodes[top].child_count; k-- > 0;) { open.push_back(nodes[top].first_child + k); }
    }
    add_points(faces, emission);
    first_.push_back(points_.size());
  }
}

HALFLIGHT_INLINE void LampExchange::add_points(const std::vector<std::uint32_t>& faces, const std::vector<double>& emission) {
  std::size_t gauss = 0;
  double all = 0.0, light = 0.0;
  for (const std::uint32_t f : faces) {
    gauss += scene_.patches[f].rule2.size();
    all += area(f);
    light += area(f) * emission[scene_.hierarchy[f].surface];
  }
  const auto relative = [&](std::uint32_t f) { return light > 0.0 ? all * emission[scene_.hierarchy[f].surface] / light : 1.0; };
  if (gauss <= most_points) {
    for (const std::uint32_t f : faces) {
      const Patch& patch = scene_.patches[f];
      const double exposed = relative(f) * area(f) / patch.area;
      for (const QuadraturePoint& x : patch.rule2) { points_.push_back({x.position, patch.normal, exposed * x.weight, f}); }
    }
    return;
  }
  if (faces.size() <= most_points) {
    for (const std::uint32_t f : faces) { points_.push_back({centroid(f), scene_.patches[f].normal, relative(f) * area(f), f}); }
    return;
  }
  add_runs(faces, relative);
}

// Faces that look about the same way, in the order of Hilbert's curve through their centroids, so that consecutive ones are near each other,
// in runs of equal light. A run that looks one way is a point at its centroid with its mean normal and all of its area, which in the mean
// over all directions shows as much as its faces do. Another is a face in its middle.
HALFLIGHT_INLINE void LampExchange::add_runs(const std::vector<std::uint32_t>& faces,
                                             const std::function<double(std::uint32_t)>& relative) {
  struct Face {
    std::uint32_t face = no_node, way = 0;  // way: of the normal, 0...5
    std::uint64_t place = 0;
    double light = 0.0;
  };
  raycast::Box box;
  for (const std::uint32_t f : faces) { box.extend(centroid(f)); }
  const double width = std::max({box.size().x, box.size().y, box.size().z, std::numeric_limits<double>::min()});
  std::vector<Face> sorted;
  double all = 0.0;
  for (const std::uint32_t f : faces) {
    const glm::dvec3& n = scene_.patches[f].normal;
    const glm::dvec3 size = glm::abs(n);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    sorted.push_back({f, static_cast<std::uint32_t>(2 * axis + (n[axis] < 0.0 ? 1 : 0)),
                      along_hilbert_curve((centroid(f) - box.lo) / width), relative(f) * area(f)});
    all += sorted.back().light;
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const Face& a, const Face& b) {
    return std::pair{a.way, a.place} < std::pair{b.way, b.place};
  });
  // Length of the mean normal: the cosine if all faces were tilted by 37 degrees against it.
  constexpr double looks_one_way = 0.8;
  double before = 0.0, of_run = 0.0;  // light of the runs before, and of this one
  glm::dvec3 moment{0.0}, vector{0.0};
  for (std::size_t k = 0, begin = 0; k < sorted.size(); ++k) {
    const auto& [face, way, place, light] = sorted[k];
    of_run += light;
    moment += light * centroid(face);
    vector += light * scene_.patches[face].normal;
    const auto runs = static_cast<double>(points_.size() - first_.back());
    if (k + 1 < sorted.size() && (before + of_run) * most_points < all * (runs + 1.0)) { continue; }
    const std::uint32_t middle = sorted[(begin + k) / 2].face;
    const double shown = glm::length(vector);
    if (shown > looks_one_way * of_run) {
      points_.push_back({moment / of_run, vector / shown, of_run, middle});
    } else {
      points_.push_back({centroid(middle), scene_.patches[middle].normal, of_run, middle});
    }
    before += of_run;
    of_run = 0.0, moment = glm::dvec3{0.0}, vector = glm::dvec3{0.0}, begin = k + 1;
  }
}

HALFLIGHT_INLINE glm::dvec3 LampExchange::centroid(std::uint32_t i) const {
  return exposure_ != nullptr ? exposure_->centroid[i] : scene_.patches[i].centroid;
}

HALFLIGHT_INLINE std::span<const LampExchange::Point> LampExchange::points_of(std::uint32_t lamp) const {
  const std::uint32_t number = scene_.hierarchy[lamp].cluster;
  return std::span{points_}.subspan(first_[number], first_[number + 1] - first_[number]);
}

namespace detail {

[[nodiscard]] HALFLIGHT_INLINE double point_kernel(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& y, const glm::dvec3& m) {
  const glm::dvec3 d = y - x;
  const double leaves = glm::dot(n, d);
  const double arrives = -glm::dot(m, d);
  if (!(leaves > 0.0 && arrives > 0.0)) { return 0.0; }
  const double r2 = glm::dot(d, d);
  return leaves * arrives / (std::numbers::pi * r2 * r2);
}

}  // namespace detail

HALFLIGHT_INLINE LampExchange::Result LampExchange::operator()(std::uint32_t lamp, std::uint32_t to, std::uint32_t rounds,
                                                               Random random) const {
  Result result;
  const Patch& patch = scene_.patches[to];
  const std::span<const Point> points = points_of(lamp);
  if (!(patch.area > 0.0) || !(area(to) > 0.0)) { return result; }
  std::vector<double> until(points.size(), 0.0);  // unoccluded light of each point; later its cumulative sum
  std::vector<double> light;                      // at the Gauss points of the patch
  light.reserve(patch.rule2.size());
  glm::dvec3 moment{0.0};
  for (const QuadraturePoint& x : patch.rule2) {
    double arrives = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double part = points[k].area * detail::point_kernel(x.position, patch.normal, points[k].position, points[k].normal);
      until[k] += x.weight * part;
      arrives += part;
    }
    light.push_back(arrives);
    result.sent += x.weight * arrives;
    moment += x.weight * arrives * (x.position - patch.centroid);
  }
  if (!(result.sent > 0.0)) { return result; }
  result.slope = patch.inverse_inertia * (moment / result.sent);
  double lowest = 0.0;
  for (const glm::dvec3& x : patch.contour) { lowest = std::min(lowest, glm::dot(result.slope, x - patch.centroid)); }
  if (lowest < -1.0) { result.slope /= -lowest; }  // limit the gradient so that the light stays positive
  const double mean = result.sent / patch.area;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double linear = glm::dot(result.slope, patch.rule2[i].position - patch.centroid);
    const double rest = light[i] / mean - 1.0 - linear;
    result.linear += patch.rule2[i].weight / patch.area * linear * linear;
    result.rest += patch.rule2[i].weight / patch.area * rest * rest;
  }
  result.linear = std::sqrt(result.linear);
  result.rest = std::sqrt(result.rest);
  if (exposure_ != nullptr) { result.sent *= area(to) / patch.area; }
  if (rounds == 0) { return result; }
  for (std::size_t k = 1; k < until.size(); ++k) { until[k] += until[k - 1]; }
  see(result, points, until, to, rounds, random);
  return result;
}

HALFLIGHT_INLINE void LampExchange::see(Result& result, std::span<const Point> points, const std::vector<double>& until, std::uint32_t to,
                                        std::uint32_t rounds, Random random) const {
  const Patch& patch = scene_.patches[to];
  const PatchEnd ground = patch_end(scene_, exposure_, to);
  WeighedSegments first, further;
  const std::uint32_t deciding = deciding_rounds(rounds);
  std::uint32_t decisive = 0;
  std::uint32_t hint = raycast::no_shape;
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const auto shift = static_cast<std::uint32_t>(random.bits() & 15u);
    raycast::Segments16 segments;
    std::array<double, 16> weights{};
    for (std::uint32_t i = 0; i < 16; ++i) {
      const double at = (i + random.uniform()) / 16.0 * until.back();
      const std::size_t k = drawn_index(until, at);
      const std::uint32_t face = points[k].face;
      const glm::dvec3 y = draw_exposed(patch_end(scene_, exposure_, face), static_cast<std::uint32_t>(random.bits() & 15u), random);
      const glm::dvec3 x = draw_exposed(ground, detail::opposite_cell(i, shift), random);
      const double share = until[k] - (k > 0 ? until[k - 1] : 0.0);
      if (!(share > 0.0)) { continue; }
      weights[i] = detail::point_kernel(x, patch.normal, y, scene_.patches[face].normal) * points[k].area / share;
      if (!(weights[i] > 0.0)) { continue; }
      segments.set(i, {x, y - x}, ground.object, scene_.hierarchy[face].object, ground.sheet, scene_.sheet(face));
    }
    const std::uint32_t occluded = scene_.objects.occluded16(segments, hint);
    WeighedSegments& sum = round < deciding ? first : further;
    for (std::uint32_t i = 0; i < 16; ++i) {
      if (!(weights[i] > 0.0)) { continue; }
      ++result.rays.cast;
      decisive += round < deciding ? 1 : 0;
      sum.total += weights[i];
      if ((occluded >> i & 1u) == 0) { sum.arrived += weights[i]; }
    }
    if (round + 1 == deciding && (first.arrived == first.total || first.arrived == 0.0)) { break; }
  }
  if (further.total > 0.0) {
    result.fraction = share_of_mixed(first, further, decisive);
  } else {
    result.fraction = first.total > 0.0 ? first.arrived / first.total : 0.0;
  }
}

HALFLIGHT_INLINE glm::dvec3 LampExchange::way(std::uint32_t lamp, std::uint32_t to) const {
  const Patch& patch = scene_.patches[to];
  glm::dvec3 sum{0.0};
  for (const QuadraturePoint& x : patch.rule2) {
    for (const Point& y : points_of(lamp)) {
      const double part = y.area * detail::point_kernel(x.position, patch.normal, y.position, y.normal);
      if (part > 0.0) { sum += x.weight * part * glm::normalize(x.position - y.position); }
    }
  }
  return glm::normalize(sum);
}

HALFLIGHT_INLINE LampExchange::Result LampExchange::evaluate(Link& link, std::uint32_t rounds, Random random) const {
  const Hierarchy& nodes = scene_.hierarchy;
  const bool p_shines = nodes[link.p].is_cluster();
  const std::uint32_t lamp = p_shines ? link.p : link.q;
  const std::uint32_t to = p_shines ? link.q : link.p;
  const Result result = (*this)(lamp, to, rounds, random);
  link.exchange = static_cast<float>(result.sent * result.fraction);
  if (!(link.exchange > 0.0f)) { return result; }
  // A cluster may show next to no area towards the centre of a patch close by; then the mean direction of the light is used instead.
  constexpr double least_shown = 1e-3;
  glm::dvec3 direction = EndShape::stored_direction(glm::normalize(nodes[to].centre - nodes[lamp].centre));
  if (!(shown_->of(nodes[lamp], aim(direction)) > least_shown * area(lamp))) { direction = EndShape::stored_direction(way(lamp, to)); }
  const double shown = shown_->of(nodes[lamp], aim(direction));
  const EndShape shape = EndShape::of_cluster(direction, shown);
  const double stored = shown > 0.0 ? shown_->of(nodes[lamp], aim(shape.direction_over_shown())) : 0.0;
  if (!(stored > 0.0)) {
    link.exchange = 0.0f;
    return result;
  }
  // The stored shape is rounded by up to 0.4 %, equally for all patches in one direction; the exchange is divided by the rounded value to
  // compensate.
  link.exchange = static_cast<float>(result.sent * result.fraction / stored);
  (p_shines ? link.shape_p : link.shape_q) = shape;
  (p_shines ? link.shape_q : link.shape_p) = EndShape::of_patch(glm::vec3{result.slope});
  return result;
}

}  // namespace radiosity
