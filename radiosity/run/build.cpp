// SPDX-License-Identifier: MIT

// Stage: from the scene to the roots of the hierarchy (paper 4.1, 4.2).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/scene.hpp>

#include <radiosity/audit/warnings.hpp>
#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/long_faces.hpp>
#include <radiosity/hierarchy/polygons.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/wall_cuts.hpp>
#include <radiosity/refinement/cluster_choice.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/lamp_choice.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

namespace detail {

// Number of input faces that emit.
[[nodiscard]] HALFLIGHT_INLINE std::uint64_t faces_that_shine(const std::vector<Surface>& surfaces, const std::vector<Color>& emission) {
  std::uint64_t count = 0;
  for (const Surface& surface : surfaces) {
    for (const std::vector<brep::FaceId>& parts : input_faces(surface)) {
      count += is_black(emission[surface.first_surface + surface.brep.data(parts.front()).sheet]) ? 0 : 1;
    }
  }
  return count;
}

// Chooses which light goes by links and which by stored rays. Accordingly puts clusters above the input faces: above lamps only, if these
// are many; above all faces, if these are many and no rays are cast. But not if most are those of a sky: what a cluster receives goes to
// all of its faces that are turned to the light, also to those in a room behind a wall, where a sky's light is a hundred times what passes
// the window. `uncut_lamps`: emitting faces before long ones were cut.
HALFLIGHT_INLINE void choose_ways_of_light(Run& run, std::uint64_t uncut_lamps) {
  const Options& options = run.options;
  DiscreteScene& scene = run.scene;
  const std::vector<bool> lamps = choose_lamps(scene);  // by input surface
  FaceCounts faces{.uncut_shining = uncut_lamps};
  for (std::size_t i = 0; i < scene.hierarchy.size(); ++i) {
    if (!is_input_face(scene.hierarchy, i)) { continue; }
    const std::uint32_t surface = scene.hierarchy[i].surface;
    ++faces.all;
    faces.shining += is_black(scene.emission[surface]) ? 0 : 1;
    faces.lamps += lamps[surface] ? 1 : 0;
  }
  if (run.needs_links()) { run.rays = choose_rays(faces, options); }
  if (run.rays.many_lamps) {
    scene.lamps = lamps;
    if (faces.lamps > 0) {
      std::vector<Color> exitance(lamps.size(), Color{0.0});
      for (std::size_t s = 0; s < exitance.size(); ++s) { exitance[s] = lamps[s] ? scene.emission[s] : Color{0.0}; }
      scene.hierarchy = make_lamp_clusters(scene.surfaces, scene.hierarchy, exitance);
    }
  }
  if (run.rays.cast) {
    run.clusters = {false, "between surfaces that do not shine light goes by stored rays"};
  } else if (run.rays.many_lamps) {
    run.clusters = {false, "lamps of many faces have clusters of their own"};
  } else if (faces.of_sky() && !faces.many_pairs()) {
    run.clusters = {false, "most input faces shine, and are few enough to be linked one by one"};
  } else {
    run.clusters = choose_clusters(scene.hierarchy.size(), options);
  }
  if (run.clusters.build) { scene.hierarchy = make_clusters(scene.surfaces, scene.hierarchy); }
  run.solution.audit.clusters = static_cast<std::uint64_t>(
      std::count_if(scene.hierarchy.begin(), scene.hierarchy.end(), [](const Node& n) { return n.is_cluster(); }));
}

}  // namespace detail

namespace stage {

HALFLIGHT_INLINE std::optional<Failure> build(detail::Run& run) {
  const Options& options = run.options;
  DiscreteScene& scene = run.scene;
  Audit& audit = run.solution.audit;
  audit.epsilon = options.epsilon;
  audit.min_area = options.min_area;
  audit.light_epsilon = options.light_epsilon.value_or(0.25 * options.epsilon);

  if (std::optional<Failure> failure = run.prepare_scene()) { return failure; }
  std::vector<Surface>& boundaries = scene.surfaces;
  if (options.topology == Topology::separate) {
    for (Surface& surface : boundaries) { surface = separate_polygons(surface); }
  }
  run.tracer.emplace(scene.input, scene.objects, boundaries);
  if (options.discontinuities > 0 && run.needs_links()) {
    scene.light_meshing.emplace(scene.objects, boundaries, scene.reflectance, scene.emission, options.discontinuities);
    scene.evaluator.use(*scene.light_meshing);
    scene.meshing = [&scene](const LeafFace& leaf) { return scene.light_meshing->split(leaf); };
  }
  audit.warnings = warnings(scene.input, scene.frame, boundaries);
  if (const std::size_t left = cut_at_walls(boundaries, scene.objects.diameter(), most_wall_pairs, scene.emission)) {
    audit.warnings.push_back(warning_of_uncut(left));
  }
  const std::uint64_t uncut_lamps = detail::faces_that_shine(boundaries, scene.emission);
  cut_long_faces(boundaries, options.min_area);
  scene.hierarchy = make_roots(boundaries, scene.budget.arrays);
  detail::choose_ways_of_light(run, uncut_lamps);
  if (scene.plan.lossless) {
    return Failure{Failure::Kind::invalid_scene,
                   {"the scene is closed and nothing in it absorbs light in some channel in which it emits: "
                    "the light would grow without end; give some surface a reflectance below 1"}};
  }
  run.watch.lap("build");
  return std::nullopt;
}

}  // namespace stage

}  // namespace radiosity
