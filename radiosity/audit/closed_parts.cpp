// SPDX-License-Identifier: MIT
#include <radiosity/audit/closed_parts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/union_find.hpp>

#include <raycast/inline.hpp>
#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

namespace detail {

// From so many the fractions of stray rays are known to 1 %.
inline constexpr std::uint32_t stray_ray_count = 2500;

// When of these four are lost, less than 5e-4 of the light is (95 % bound of a Poisson count): no more than what quadrature and sampling
// have wrong in the row sums, so that to take these for 1 is the better guess. In white rooms the row sums are most of the error. One ray
// may be lost between two triangles that share an edge.
inline constexpr std::uint32_t closing_ray_count = 20'000, most_lost = 4;

// Of fewer rays a part is not known to be closed.
inline constexpr std::uint32_t fewest_closing_rays = 1000;

// Lamps are mostly too small for rays to find them by chance. Each has so many of its own, which only connect; where lamps are many, they
// have none, for then no single one matters.
inline constexpr std::uint32_t rays_of_lamp = 16;
inline constexpr std::size_t most_lamps = 256;

// Leaves, to be drawn by their exposed area.
struct LeafArea {
  std::vector<std::uint32_t> leaves;
  std::vector<double> until;  // cumulative area

  void add(std::uint32_t leaf, double area) {
    leaves.push_back(leaf);
    until.push_back((until.empty() ? 0.0 : until.back()) + area);
  }
  // `part`, in [0, 1): of the area.
  [[nodiscard]] std::uint32_t at(double part) const {
    const auto found = static_cast<std::size_t>(std::upper_bound(until.begin(), until.end(), part * until.back()) - until.begin());
    return leaves[std::min(found, leaves.size() - 1)];
  }
};

struct RayEnd {
  enum class What : char { front, back, nowhere };
  std::uint32_t from = 0, to = 0;  // input surfaces
  What what = What::front;
};

[[nodiscard]] HALFLIGHT_INLINE RayEnd cast_from(const DiscreteScene& scene, std::uint32_t leaf, Random& random) {
  const ExposedPoints* const points = scene.exposure.points(leaf);
  glm::dvec3 p{0.0};
  if (points != nullptr) {
    p = points->draw(scene.patches[leaf], static_cast<std::uint32_t>(random.bits() & 15u), random);
  } else {
    const double u = random.uniform();
    p = sample(scene.patches[leaf], u, random.uniform());
  }
  const Node& node = scene.hierarchy[leaf];
  const std::uint32_t sheet = node.surface - scene.surfaces[node.object].first_surface;
  // A patch is a chord of its surface: where this runs into another object, what is exposed of the chord may be buried of the surface.
  const raycast::SurfacePoint from = scene.objects.object(node.object).project(sheet, p);
  if (scene.objects.covered(from.position, from.normal, node.object)) { return {node.surface, node.surface, RayEnd::What::front}; }
  const double u = random.uniform();
  const glm::dvec3 direction = cosine_direction(from.normal, u, random.uniform()) * scene.objects.diameter();
  const auto hit = scene.objects.closest({from.position, direction}, node.object, sheet);
  if (!hit) { return {node.surface, 0, RayEnd::What::nowhere}; }
  return {node.surface, scene.surfaces[hit->object].first_surface + hit->sheet, hit->front ? RayEnd::What::front : RayEnd::What::back};
}

// One ray from each of `rays` points, spread over the area.
[[nodiscard]] HALFLIGHT_INLINE std::vector<RayEnd> cast(const DiscreteScene& scene, const LeafArea& area, std::uint32_t rays,
                                                        std::uint64_t key) {
  std::vector<RayEnd> ends(area.leaves.empty() ? 0 : rays);
  parallel_for(ends.size(), scene.threads, [&](std::size_t k) {
    Random random{scene.seed, k, key};
    const double part = (static_cast<double>(k) + random.uniform()) / rays;
    ends[k] = cast_from(scene, area.at(part), random);
  });
  return ends;
}

[[nodiscard]] HALFLIGHT_INLINE StrayRays count_stray(const std::vector<RayEnd>& ends) {
  const auto part = [&](RayEnd::What what) {
    const auto is = [what](const RayEnd& end) { return end.what == what; };
    return static_cast<double>(std::count_if(ends.begin(), ends.end(), is)) / static_cast<double>(ends.size());
  };
  if (ends.empty()) { return {}; }
  StrayRays stray;
  stray.escaping = part(RayEnd::What::nowhere);
  stray.to_backs = part(RayEnd::What::back);
  stray.standard_error = 0.5 / std::sqrt(static_cast<double>(ends.size()));
  stray.rays = static_cast<std::uint32_t>(ends.size());
  return stray;
}

// The parts that the rays connect, each by one of its surfaces, with the rays from it.
struct ConnectedParts {
  explicit ConnectedParts(std::size_t surfaces) : joined(surfaces), rays(surfaces, 0), lost(surfaces, 0) {}

  void connect(const std::vector<RayEnd>& ends) {
    for (const RayEnd& end : ends) {
      if (end.what == RayEnd::What::front) { joined.unite(end.from, end.to); }
    }
  }
  void count(const std::vector<RayEnd>& ends) {
    for (const RayEnd& end : ends) {
      ++rays[joined.find(end.from)];
      lost[joined.find(end.from)] += end.what == RayEnd::What::front ? 0 : 1;
    }
  }
  // May the part of this surface be closed, by so many rays in all?
  [[nodiscard]] bool closed(std::size_t surface, std::uint32_t of) {
    const std::uint32_t part = joined.find(static_cast<std::uint32_t>(surface));
    return std::uint64_t{rays[part]} * closing_ray_count >= std::uint64_t{fewest_closing_rays} * of &&
           std::uint64_t{lost[part]} * of <= std::uint64_t{rays[part]} * most_lost;
  }

  brep::detail::UnionFind joined;
  std::vector<std::uint32_t> rays, lost;
};

// Is there a closed part that emits light of some channel and absorbs none of it?
[[nodiscard]] HALFLIGHT_INLINE bool keeps_all_light(const DiscreteScene& scene, ConnectedParts& parts, const std::vector<bool>& closed) {
  for (int c = 0; c < 3; ++c) {
    std::vector<bool> emits(closed.size(), false), absorbs(closed.size(), false);  // of each part, at one of its surfaces
    for (std::size_t s = 0; s < closed.size(); ++s) {
      const std::uint32_t part = parts.joined.find(static_cast<std::uint32_t>(s));
      emits[part] = emits[part] || scene.emission[s][c] > 0.0;
      absorbs[part] = absorbs[part] || !closed[s] || scene.reflectance[s][c] < 1.0;
    }
    for (std::size_t part = 0; part < closed.size(); ++part) {
      if (parts.rays[part] > 0 && emits[part] && !absorbs[part]) { return true; }
    }
  }
  return false;
}

}  // namespace detail

HALFLIGHT_INLINE ClosedParts find_closed_parts(const DiscreteScene& scene) {
  detail::LeafArea all;
  std::vector<detail::LeafArea> lamps(scene.inputs.size());
  for (std::uint32_t i = 0; i < scene.hierarchy.size(); ++i) {
    const Node& node = scene.hierarchy[i];
    if (!node.leaf() || !(scene.exposure.area[i] > 0.0)) { continue; }
    all.add(i, scene.exposure.area[i]);
    if (!is_black(scene.emission[node.surface])) { lamps[node.surface].add(i, scene.exposure.area[i]); }
  }
  std::erase_if(lamps, [](const detail::LeafArea& lamp) { return lamp.leaves.empty(); });
  ClosedParts found;
  for (const std::uint32_t rays : {detail::stray_ray_count, detail::closing_ray_count}) {
    const std::vector<detail::RayEnd> ends = detail::cast(scene, all, rays, 0x7374726179ull);
    detail::ConnectedParts parts(scene.inputs.size());
    parts.connect(ends);
    for (std::size_t k = 0; k < lamps.size() && lamps.size() <= detail::most_lamps; ++k) {
      parts.connect(detail::cast(scene, lamps[k], detail::rays_of_lamp, 0x6c616d70ull + k));
    }
    parts.count(ends);
    found.stray = detail::count_stray(ends);
    // Where the whole scene is closed, so is what no ray has met.
    const bool whole = found.stray.lost() <= detail::most_lost;
    found.surfaces.assign(scene.inputs.size(), false);
    for (std::size_t s = 0; s < found.surfaces.size(); ++s) { found.surfaces[s] = !ends.empty() && (whole || parts.closed(s, rays)); }
    if (std::find(found.surfaces.begin(), found.surfaces.end(), true) == found.surfaces.end()) {
      found.surfaces.clear();
      found.lossless = false;
      break;
    }
    found.lossless = detail::keeps_all_light(scene, parts, found.surfaces);
    for (const detail::RayEnd& end : ends) {
      found.stray.closed_rays += found.surfaces[end.from] ? 1 : 0;
      found.stray.closed_lost += found.surfaces[end.from] && end.what != detail::RayEnd::What::front ? 1 : 0;
    }
  }
  return found;
}

}  // namespace radiosity
