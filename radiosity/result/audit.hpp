// SPDX-License-Identifier: MIT
#pragma once

// The report of a run about itself: its error, its time, and its shortcuts. The error is measured, not guessed
// (error_estimate.hpp, surface_error.hpp).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <radiosity/discontinuity/imprinted_edges.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/left_out.hpp>

namespace radiosity {

struct StageTime {
  std::string name;
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;  // of all threads
  // Largest memory of the process, in bytes, up to the end of the stage; nothing if the system does not tell.
  std::optional<std::uint64_t> peak_bytes{};
};

struct SurfaceMean {
  std::string name;
  double area = 0.0;     // exposed area, in squared units of the scene
  Color radiosity{0.0};  // area-weighted mean, W/m2
};

// Where rays end that leave the exposed surfaces in cosine-distributed directions, as fractions of all rays.
struct StrayRays {
  double escaping = 0.0, to_backs = 0.0;
  double standard_error = 0.0;  // upper bound for either
  std::uint32_t rays = 0;
  // Rays from parts that count as closed (closed_parts.hpp), and how many of these are lost.
  std::uint32_t closed_rays = 0, closed_lost = 0;

  // The number of rays that escape or hit backs.
  [[nodiscard]] std::uint32_t lost() const { return static_cast<std::uint32_t>(std::lround((escaping + to_backs) * rays)); }
};

// The result of Options::mesh_error. Errors are relative L2 of the mesh's colours against gathered light, over the surfaces; or over the
// picture, including the errors of facets at the outlines of curved objects.
struct MeshRefinement {
  double wanted = 0.0;
  ErrorEstimate before, after;
  double outlines_before = 0.0, outlines_after = 0.0;  // the part at the outlines
  std::uint64_t faces_before = 0, faces_after = 0;
  bool met = false;
};

// What became of a run. If several hold, the first in this order is told.
enum class RunStatus { interrupted, out_of_memory, target_missed, estimate_refuted, not_converged, far_off, error_unknown, converged };
inline constexpr const char* name(RunStatus status) {
  constexpr const char* names[] = {"interrupted",   "out of memory", "target missed", "estimate refuted",
                                   "not converged", "far off",       "error unknown", "converged"};
  return names[static_cast<int>(status)];
}

struct Audit {
  [[nodiscard]] RunStatus status() const {
    return interrupted         ? RunStatus::interrupted
           : !shortage.empty() ? RunStatus::out_of_memory
           : target_missed     ? RunStatus::target_missed
           : refuted           ? RunStatus::estimate_refuted
           : !converged        ? RunStatus::not_converged
           : far_off()         ? RunStatus::far_off
           : error_unknown()   ? RunStatus::error_unknown
                               : RunStatus::converged;
  }

  // Has path tracing found that a quarter of the light of the surfaces or of the picture is wrong, and more than was asked for? Then light
  // was not found or invented, whatever the links tell. Nor is a picture believed that is more than 8 of 255 levels off in most of its
  // pixels, although the paths that meet light there are too few to tell how much that is.
  [[nodiscard]] bool far_off() const {
    constexpr double much = 0.25;
    const auto more = [&](const std::optional<ErrorEstimate>& error) { return error && error->above(std::max(much, asked)); };
    const auto seen_off = [&](const PictureError& picture) {
      return !picture.error.within(std::max(much, asked)) && picture.over8.least > 0.5;
    };
    return more(surface_error) || more(leaf_error) || (picture_error && (more(picture_error->error) || seen_off(*picture_error)));
  }

  // May more than half of the light of the surfaces be wrong, as far as the links and an audit tell that could not find it?
  [[nodiscard]] bool error_unknown() const {
    constexpr double most = 0.5;
    return surface_error && !surface_error->within(most) && estimated_error && *estimated_error > most;
  }

  // time
  std::vector<StageTime> stages;
  double wall_seconds = 0.0, cpu_seconds = 0.0;  // of all stages except the audit
  // size
  std::uint64_t polygons = 0;  // input faces: the roots of the hierarchy, whatever their number of corners and holes
  std::uint64_t nodes = 0, leaves = 0, links = 0, rays = 0;
  std::uint64_t leaf_splits = 0;                    // leaves that were split by their light once there were links
  std::uint64_t link_splits = 0;                    // links replaced by links of the children because of light that they could not express
  std::uint64_t ray_links = 0, stored_rays = 0;     // links made of rays (included in links); their rays
  bool rays_for_view = false;                       // are there more of them where Control::viewpoint looks (rays/view_importance.hpp)?
  std::uint64_t clusters = 0, cluster_links = 0;    // included in nodes; links with a cluster at one end, included in links
  std::optional<ImprintedEdges> imprinted;          // of discontinuity meshing, if done
  std::uint64_t rays_avoided = 0;                   // lower bound, from two proofs:
  std::uint64_t pairs_clear = 0, pairs_hidden = 0;  // links that nothing can block; pairs that one object hides, with all pairs below
  std::uint64_t audit_rays = 0;                     // of the audit over all surfaces, including its pilots
  std::uint64_t reserve_used = 0;                   // of AuditGoal::reserve, in rays among few polygons
  double ray_price = 1.0;                           // cost of a ray of the audit's paths, relative to a scene of few polygons
  double ray_work = 1.0;                            // cost of a ray of a path, relative to a scene of few polygons
  std::uint64_t bytes = 0;  // held by the result: BReps, hierarchy, links, compiled objects; the last stage has the peak
  // the linear system
  struct Range {
    double min = 0.0, mean = 0.0, max = 0.0;
  };
  Range proportion;               // of the leaves: inscribed over circumscribed circle, relative to a regular polygon
  Range row_sum;                  // sum of the form factors of a leaf, area-weighted mean; in the system that was solved
  Range computed_row_sum;         // the same before the correction of a closed scene
  double overfull = 0.0;          // share of the exposed area with row sums above 1.1, which are impossible and were set to 1
  std::optional<double> closure;  // RMS error of the row sums of a closed scene before they were set to 1
  double ray_correction = 0.0;    // RMS correction of row sums for the noise of stored rays, relative to the row sums
  double closure_limit = 0.0;     // largest closure that quadrature and sampling explain (doubt.hpp); a larger one is refused
  double energy_balance = 0.0;    // |emitted - absorbed - escaped| / emitted
  double escaped = 0.0;           // fraction of the emitted power that leaves an open scene
  double residual = 0.0;
  std::uint32_t iterations = 0;
  std::vector<std::vector<double>> histories;  // by channel: the relative residual at the start and after each iteration
  // Residual reached and, if an error target was requested, that target. Without a target: not refuted.
  bool converged = true;
  bool interrupted = false;  // stopped early with the best solution so far; its error may not be measured
  bool coarsened = false;    // F-refinement used larger thresholds than requested, because it was interrupted or short of memory
  std::string shortage;      // what ended the run early for lack of memory, and advice; then not converged
  // error
  // Relative L2, estimated from the variation that links and leaves cannot express (link_error.hpp): of a picture or of the leaves, as
  // requested; of the leaves.
  std::optional<double> estimated_error, estimated_leaf_error;
  std::string estimate_doubt;     // why the estimate is no bound of the error, or far above it; empty if it may be taken as one
  double asked = 0.0;             // Options::error, or ::target of BF-refinement; 0: no accuracy was asked for
  bool target_missed = false;     // of Options::error or ::target, by the audit; where that cannot tell about ::target, by the estimate
  bool refuted = false;           // without a target: did the audit find more than three times the estimated error?
  std::string rounds_ended_by;    // if Options::error was missed: the reason why the rounds ended, such as "three rounds without gain"
  std::uint32_t generations = 0;  // of BF-refinement
  std::uint64_t audit_points = 0;
  std::optional<ErrorEstimate> leaf_error;     // over all surfaces, of constant radiosity on each leaf
  std::optional<ErrorEstimate> surface_error;  // over all surfaces, of the reconstructed radiosity that pictures show
  std::optional<PictureError> picture_error;   // of one picture
  std::optional<MeshRefinement> mesh;          // if requested
  // Used to plan the rounds to Options::error, from a fixed number of points that does not depend on it: the error over all surfaces, and
  // the share of its square caused by light that was reflected once.
  std::optional<ErrorEstimate> steering_error;
  std::optional<double> direct_share;
  // what was done
  std::vector<LeftOut> left_out;
  std::vector<std::string> warnings;  // doubtful properties of the scene (warnings.hpp)
  std::optional<StrayRays> stray;     // if the scene is not proven closed
  std::vector<SurfaceMean> surfaces;
  double epsilon = 0.0, min_area = 0.0, light_epsilon = 0.0;  // as used; see `coarsened`
  double lit_part = 1.0;  // min_area is relative to this share of the scene, about that which lamps light (Options::min_area)
  std::optional<double> reflected_share;  // RMS radiosity reflected once, relative to the mean emission (reflected_light.hpp)
  double target = 0.0;                    // of BF-refinement; 0 if time was the limit
  unsigned threads = 1, channels = 3;
  std::uint64_t seed = 0;
};

}  // namespace radiosity
