// SPDX-License-Identifier: MIT
#include <radiosity/run/f_refinement.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <brep/inline.hpp>

#include <radiosity/audit/reflected_light.hpp>
#include <radiosity/audit/view_paths.hpp>
#include <radiosity/hierarchy/buried.hpp>
#include <radiosity/oracle/importance.hpp>
#include <radiosity/oracle/lit_faces.hpp>
#include <radiosity/rays/ray_choice.hpp>
#include <radiosity/refinement/cluster_choice.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/plan.hpp>

namespace radiosity {

namespace detail {

// Fineness::reflected, from the reflected light as a share of the mean emission. By measurement: scenes open to the sky keep about their
// cost, and light through a window, most of it at the edges of a few bright places, becomes as accurate as theirs. Below a share of 0.01
// the result decreases in proportion, so that light which a lamp sends elsewhere has no influence; above 16, where a lamp lights only a
// spot of a large scene, it increases in proportion.
//
// Above a share of 4 the brightest surface lies close beside a lamp, as the inside of a lampshade, and holds most of the reflected light,
// to which errors relate where there is no camera: thresholds become up to four times as large. Five rooms with bulbs in shades otherwise
// took 2 to 5 times as long, for errors of 3.2 % on average instead of 3.6. A camera may see only what is dim beside the shade.
[[nodiscard]] HALFLIGHT_INLINE double brightness_of_reflected(double share, bool for_camera) {
  constexpr double dim = 0.01, bright = 16.0;
  if (share > least_share_beside_lamps) {
    const double beside_lamps = for_camera ? 1.0 : std::min(share, bright) / least_share_beside_lamps;
    return std::max(beside_lamps, share / bright);
  }
  return std::min(1.0, std::pow(4.0 * std::max(dim, share), 1.25)) * std::min(1.0, share / dim);
}

// Limit of the contrast of scene and picture (importance.hpp). Bright spots beside lamps, which the picture may not show, raise the RMS of
// the scene, and a darker picture would gain nothing by that. If the picture is darker than the mean, as in a room that a sky lights
// through a door, its light enters at a few places, which are small relative to the scene and must be found. With a limit of 1, rooms with
// a hundredth of the light outside have an error of 26 %; with 30, the dark end of a hall is up to twice too bright (sky_rooms_test); with
// this limit, by a third.
inline constexpr double most_contrast = 120.0;

HALFLIGHT_INLINE bool lit_through_openings(const Importance& importance) { return importance.contrast() >= most_contrast; }

// The importance of nodes for the picture of the camera, if the picture is all that counts.
[[nodiscard]] HALFLIGHT_INLINE Importance importance_of_view(const Run& run) {
  const DiscreteScene& scene = run.scene;
  if (!scene.control.viewpoint || !run.solution.audit.reflected_share) { return {}; }
  ViewPaths paths = view_paths(scene, *run.tracer, *scene.control.viewpoint);
  if (paths.points.empty()) { return {}; }
  const LitFaces lit{scene.view(), scene.reflectance, scene.emission, buried_nodes(scene.surfaces, scene.hierarchy)};
  // A picture for which no path has met any light counts as darker than the limit.
  const auto contrast_to = [&](double share) {
    return paths.reflected > 0.0 ? std::pow(share * lit.mean_emission() / paths.reflected, 2.0) : most_contrast;
  };
  const double contrast = std::max(std::min(1.0, contrast_to(*run.solution.audit.reflected_share)),
                                   std::min(most_contrast, contrast_to(mean_reflected_light(scene, *run.tracer))));
  return {std::move(paths.points), contrast, lit.area(), scene.inputs.size()};
}

// The number of objects that emit.
[[nodiscard]] HALFLIGHT_INLINE std::size_t emitting_objects(const DiscreteScene& scene) {
  return static_cast<std::size_t>(std::count_if(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
    const auto first = scene.emission.begin() + surface.first_surface;
    return std::any_of(first, first + surface.object->sheet_count(), [](const Color& emission) { return !is_black(emission); });
  }));
}

HALFLIGHT_INLINE double lit_part(const Run& run) {
  const double share = run.solution.audit.reflected_share.value_or(0.0);
  if (!run.rays.cast || share <= least_share_beside_lamps) { return 1.0; }
  const auto spots = static_cast<double>(std::max<std::size_t>(1, emitting_objects(run.scene)));
  return std::pow(least_share_beside_lamps / share, 2.0) / std::sqrt(spots);
}

// With the current thresholds.
[[nodiscard]] HALFLIGHT_INLINE RefineResult refined_by_forms(Run& run) {
  const Audit& audit = run.solution.audit;
  Fineness fineness{audit.epsilon, audit.min_area * lit_part(run), audit.light_epsilon};
  if (run.options.oracle) { fineness.oracle = run.options.oracle; }
  if (audit.reflected_share) {  // or what the faces show themselves, if the reflected light is hardly seen beside it
    const LitFaces lit{run.scene.view(), run.scene.reflectance, run.scene.emission, buried_nodes(run.scene.surfaces, run.scene.hierarchy)};
    fineness.reflected =
        brightness_of_reflected(std::max(*audit.reflected_share, own_light * lit.own_share()), run.scene.control.viewpoint.has_value());
  }
  fineness.importance = &run.importance;
  return radiosity::refine(run.scene, fineness, run.rays.cast ? Linked::lamps : Linked::all);
}

HALFLIGHT_INLINE void refine_by_forms(Run& run) {
  const Plan& plan = run.scene.plan;
  Audit& audit = run.solution.audit;
  if (plan.lit && plan.reflects) {
    run.scene.patches.extend(run.scene.threads);
    audit.reflected_share = reflected_light(run.scene, *run.tracer);
    run.importance = importance_of_view(run);
    const bool beside_lamps = *audit.reflected_share > least_share_beside_lamps;
    if (run.rays.few && (beside_lamps || lit_through_openings(run.importance)) && !run.clusters.build) {
      run.rays = RayChoice{true, {}, run.rays.many_lamps};
    }
  }
  audit.lit_part = lit_part(run);
  run.refined = refined_by_forms(run);
}

HALFLIGHT_INLINE void hurry(Run& run, double epsilon) {
  Audit& audit = run.solution.audit;
  audit.interrupted = true;
  run.scene.control = run.scene.control.unstoppable();
  run.scene.control.decided = nullptr;
  if (epsilon <= run.options.epsilon) { return; }
  audit.coarsened = true;
  audit.epsilon = epsilon;
  audit.min_area = std::max(run.options.min_area, 2.4 * epsilon * epsilon);  // the same relation as in the rounds to an error target
  audit.light_epsilon = std::max(run.options.light_epsilon.value_or(0.0), 0.25 * epsilon);
}

HALFLIGHT_INLINE void refine_coarsely(Run& run) {
  RefineResult lost = std::exchange(run.refined, {});
  lost.linked = {};
  const RayCount rays = lost.rays;
  // Halving epsilon takes some four times as many questions, and the links made then take about twice as long as these.
  constexpr std::uint64_t worth = 100;
  double epsilon = soon_made;
  for (;;) {
    hurry(run, epsilon);
    run.refined = refined_by_forms(run);
    if (run.rays.cast || 0.5 * epsilon <= run.options.epsilon || worth * run.refined.pairs_tested > lost.pairs_tested) { break; }
    epsilon *= 0.5;
  }
  run.refined.rays += rays;
}

HALFLIGHT_INLINE std::string too_large(const Run& run, std::uint64_t needed) {
  return too_much_memory(needed, run.scene.budget,
                         run.options.error               ? "a larger error needs less"
                         : run.scene.budget.a_posteriori ? "a larger target needs less"
                                                         : "a larger epsilon or min_area needs less");
}

HALFLIGHT_INLINE std::optional<Failure> refusal(const Run& run) {
  if (run.refined.cancelled || run.evaluated.cancelled) { return cancelled(); }
  if (run.refined.too_many > 0) { return Failure{Failure::Kind::invalid_options, {too_many_links(run.refined.too_many, run.clusters)}}; }
  if (run.refined.too_large > 0) { return Failure{Failure::Kind::out_of_memory, {too_large(run, run.refined.too_large)}}; }
  return std::nullopt;
}

}  // namespace detail

}  // namespace radiosity
