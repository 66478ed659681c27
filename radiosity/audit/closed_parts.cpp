// SPDX-License-Identifier: MIT
#include <radiosity/audit/closed_parts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>
#include <brep/union_find.hpp>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/leaf_locator.hpp>

namespace radiosity {

namespace detail {

// With this many rays the fraction of stray rays is known to 1 %.
inline constexpr std::uint32_t stray_ray_count = 2500;

// When at most most_lost rays are lost, less than 5e-4 of the light is lost (95 % bound of a Poisson count). That is no more than the
// error of the row sums by quadrature and sampling, so setting them to 1 is the better estimate; in white rooms the row sums are most of
// the error. A few lost rays are allowed because a ray may slip between two triangles that share an edge.
inline constexpr std::uint32_t closing_ray_count = 20'000, most_lost = 4;

// A part with fewer rays is not known to be closed.
inline constexpr std::uint32_t fewest_closing_rays = 1000;

// Lamps are mostly too small to be hit by chance, so each casts this many rays of its own, which only connect it to a part. With more
// than most_lamps lamps they cast none, because then no single lamp matters.
inline constexpr std::uint32_t rays_of_lamp = 16;
inline constexpr std::size_t most_lamps = 256;

// Leaves, drawn with probability proportional to their exposed area.
struct LeafArea {
  std::vector<std::uint32_t> leaves;
  std::vector<double> until;  // cumulative area

  void add(std::uint32_t leaf, double area) {
    leaves.push_back(leaf);
    until.push_back((until.empty() ? 0.0 : until.back()) + area);
  }
  // The leaf at the fraction `part`, in [0, 1), of the cumulative area.
  [[nodiscard]] std::uint32_t at(double part) const { return leaves[drawn_index(until, part * until.back())]; }
};

struct RayEnd {
  enum class What : char { front, back, nowhere };
  std::uint32_t leaf = 0, from = 0, to = 0;  // where it begins: a leaf and its input face; where it ends: an input face
  What what = What::front;
  raycast::ScenePoint at = {};  // on a back
};

[[nodiscard]] HALFLIGHT_INLINE RayEnd cast_from(const DiscreteScene& scene, const LeafLocator& leaves, std::uint32_t leaf, Random& random) {
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
  // A patch is a chord of its curved surface. Where the surface runs into another object, a point may be exposed on the chord but buried
  // on the surface.
  const std::uint32_t own = input_face(scene.hierarchy, leaf);
  const raycast::ScenePoint from{scene.objects.object(node.object).project(sheet, p), node.object, sheet};
  if (scene.objects.covered(from)) { return {leaf, own, own}; }
  const double u = random.uniform();
  const glm::dvec3 direction = cosine_direction(from.normal, u, random.uniform()) * scene.objects.diameter();
  const auto hit = scene.objects.closest(from, direction);
  if (!hit) { return {leaf, own, own, RayEnd::What::nowhere}; }
  const raycast::ScenePoint at = scene.objects.point(*hit, {from.position, direction});
  if (!hit->front) { return {leaf, own, own, RayEnd::What::back, at}; }
  const std::uint32_t met = leaves(scene.surfaces[hit->object].first_surface + hit->sheet, at);
  return {leaf, own, met == no_node ? own : input_face(scene.hierarchy, met)};
}

// Casts one ray from each of `rays` points, stratified over the area.
[[nodiscard]] HALFLIGHT_INLINE std::vector<RayEnd> cast(const DiscreteScene& scene, const LeafLocator& leaves, const LeafArea& area,
                                                        std::uint32_t rays, std::uint64_t key) {
  std::vector<RayEnd> ends(area.leaves.empty() ? 0 : rays);
  parallel_for(ends.size(), scene.threads, [&](std::size_t k) {
    Random random{scene.seed, k, key};
    const double part = (static_cast<double>(k) + random.uniform()) / rays;
    ends[k] = cast_from(scene, leaves, area.at(part), random);
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

// Input faces joined by rays; each part is named by one of its input faces and counts the rays cast from it.
struct ConnectedParts {
  // but_backs: all that it loses is absorbed by the black backs of a few planes.
  enum class Closed : char { unknown, no, but_backs, yes };

  explicit ConnectedParts(const DiscreteScene& of)
      : scene(of), joined(of.hierarchy.size()), rays(of.hierarchy.size(), 0), lost(rays), lost_for_good(rays), backs(rays.size()) {}

  void connect(const std::vector<RayEnd>& ends) {
    for (const RayEnd& end : ends) {
      if (end.what == RayEnd::What::front) { joined.unite(end.from, end.to); }
    }
  }
  void count(const std::vector<RayEnd>& ends) {
    for (const RayEnd& end : ends) {
      const std::uint32_t part = joined.find(end.from);
      ++rays[part];
      if (end.what == RayEnd::What::front) { continue; }
      ++lost[part];
      lost_for_good[part] += end.what == RayEnd::What::back && add_back(backs[part], end.at) ? 0 : 1;
    }
  }
  // Is the part of this input face closed, judged from `of` rays cast in all?
  [[nodiscard]] Closed closed(std::uint32_t face, std::uint32_t of) {
    const std::uint32_t part = joined.find(face);
    if (std::uint64_t{rays[part]} * closing_ray_count < std::uint64_t{fewest_closing_rays} * of) {
      return lost[part] > 0 ? Closed::no : Closed::unknown;
    }
    const auto few = [&](std::uint32_t count) { return std::uint64_t{count} * of <= std::uint64_t{rays[part]} * most_lost; };
    return few(lost[part]) ? Closed::yes : few(lost_for_good[part]) ? Closed::but_backs : Closed::no;
  }

  const DiscreteScene& scene;
  brep::detail::UnionFind joined;
  std::vector<std::uint32_t> rays, lost, lost_for_good;  // lost_for_good: not on one of `backs`
  std::vector<std::vector<raycast::ScenePoint>> backs;   // a point in each plane of which rays hit the back

 private:
  static constexpr std::size_t most_backs = 64;  // each costs a test for each patch

  // Returns false if the surface is not flat, or there are too many planes.
  [[nodiscard]] bool add_back(std::vector<raycast::ScenePoint>& its, const raycast::ScenePoint& at) const {
    if (!scene.objects.object(at.object).flat()) { return false; }
    const auto same_plane = [&](const raycast::ScenePoint& other) {
      return glm::dot(other.normal, at.normal) > 1.0 - 1e-12 &&
             std::abs(glm::dot(other.position - at.position, at.normal)) <= 1e-9 * scene.objects.diameter();
    };
    if (std::any_of(its.begin(), its.end(), same_plane)) { return true; }
    if (its.size() == most_backs) { return false; }
    its.push_back(at);
    return true;
  }
};

// The nodes of closed parts, and those of parts that only lose light to backs, with all descendants of their input faces.
[[nodiscard]] HALFLIGHT_INLINE PartsWithoutLoss closed_nodes_of(const DiscreteScene& scene, ConnectedParts& parts, std::uint32_t rays) {
  using Closed = ConnectedParts::Closed;
  const Hierarchy& hierarchy = scene.hierarchy;
  // By surface: is some face in a closed part, some in another one?
  std::vector<bool> some(scene.inputs.size(), false), open(scene.inputs.size(), false);
  std::vector<Closed> of(hierarchy.size(), Closed::no);
  PartsWithoutLoss found{std::vector<bool>(hierarchy.size(), false), std::vector<bool>(hierarchy.size(), false), {}};
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {
    if (!is_input_face(hierarchy, i)) { continue; }
    of[i] = parts.closed(i, rays);
    const std::uint32_t surface = hierarchy[i].surface;
    some[surface] = some[surface] || of[i] == Closed::yes;
    open[surface] = open[surface] || of[i] == Closed::no || of[i] == Closed::but_backs;
    if (of[i] == Closed::but_backs && parts.joined.find(i) == i) {
      found.backs.insert(found.backs.end(), parts.backs[i].begin(), parts.backs[i].end());
    }
  }
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) {  // parents come first
    if (hierarchy[i].is_cluster()) { continue; }
    const std::uint32_t surface = hierarchy[i].surface;
    if (!is_input_face(hierarchy, i)) {
      of[i] = of[hierarchy[i].parent];
    } else if (of[i] == Closed::unknown && some[surface] && !open[surface]) {
      of[i] = Closed::yes;
    }
    found.all[i] = of[i] == Closed::yes;
    found.but_backs[i] = of[i] == Closed::but_backs;
  }
  return found;
}

// Is there a closed part that emits light of some channel and absorbs none of it?
[[nodiscard]] HALFLIGHT_INLINE bool keeps_all_light(const DiscreteScene& scene, ConnectedParts& parts, const std::vector<bool>& closed) {
  for (int c = 0; c < 3; ++c) {
    std::vector<bool> emits(closed.size(), false), absorbs(closed.size(), false);  // by part, stored at the input face that names it
    for (std::uint32_t i = 0; i < scene.hierarchy.size(); ++i) {
      if (!is_input_face(scene.hierarchy, i)) { continue; }
      const std::uint32_t part = parts.joined.find(i), surface = scene.hierarchy[i].surface;
      emits[part] = emits[part] || scene.emission[surface][c] > 0.0;
      absorbs[part] = absorbs[part] || !closed[i] || scene.reflectance[surface][c] < 1.0;
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
  const LeafLocator leaves(scene.hierarchy, scene.patches, scene.inputs.size());
  for (const std::uint32_t rays : {detail::stray_ray_count, detail::closing_ray_count}) {
    const std::vector<detail::RayEnd> ends = detail::cast(scene, leaves, all, rays, 0x7374726179ull);
    detail::ConnectedParts parts(scene);
    parts.connect(ends);
    for (std::size_t k = 0; k < lamps.size() && lamps.size() <= detail::most_lamps; ++k) {
      parts.connect(detail::cast(scene, leaves, lamps[k], detail::rays_of_lamp, 0x6c616d70ull + k));
    }
    parts.count(ends);
    found.stray = detail::count_stray(ends);
    // If the whole scene is closed, so are the nodes that no ray has met.
    const bool whole = !ends.empty() && found.stray.lost() <= detail::most_lost;
    found.nodes =
        whole ? PartsWithoutLoss{std::vector<bool>(scene.hierarchy.size(), true), {}, {}} : detail::closed_nodes_of(scene, parts, rays);
    const auto closed = [&](std::uint32_t i) { return scene.loses_nothing(found.nodes, i); };
    bool any = false;
    for (std::uint32_t i = 0; i < scene.hierarchy.size() && !any; ++i) { any = scene.hierarchy[i].leaf() && closed(i); }
    if (!any) {
      found.nodes = {};
      break;
    }
    found.lossless = detail::keeps_all_light(scene, parts, found.nodes.all);
    for (const detail::RayEnd& end : ends) {
      found.stray.closed_rays += closed(end.leaf) ? 1 : 0;
      found.stray.closed_lost += closed(end.leaf) && end.what != detail::RayEnd::What::front ? 1 : 0;
    }
  }
  return found;
}

}  // namespace radiosity
