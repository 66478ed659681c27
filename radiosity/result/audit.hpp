// SPDX-License-Identifier: MIT
#pragma once

// What every run says about itself: how wrong it is, how long it took, what it left out. The error is measured, not guessed
// (error_estimate.hpp, surface_error.hpp).

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/discontinuity/imprinted_edges.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/left_out.hpp>

namespace radiosity {

struct StageTime {
  std::string name;
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;  // of all threads
  // Most memory, in bytes, that the process has held at once until the stage ended; nothing where the system does not tell.
  std::optional<std::uint64_t> peak_bytes{};
};

struct SurfaceMean {
  std::string name;
  double area = 0.0;     // exposed, in the scene's squared unit
  Color radiosity{0.0};  // area-weighted mean, W/m2
};

// Where rays end that leave the exposed surfaces in cosine-distributed directions, as fractions.
struct StrayRays {
  double escaping = 0.0, to_backs = 0.0;
  double standard_error = 0.0;  // of either, at most
  std::uint32_t rays = 0;
  std::uint32_t closed_rays = 0, closed_lost = 0;  // from parts that count as closed (closed_parts.hpp), and of these the lost ones

  // The number of rays that end so.
  [[nodiscard]] std::uint32_t lost() const { return static_cast<std::uint32_t>(std::lround((escaping + to_backs) * rays)); }
};

// What became of Options::mesh_error. Errors are relative L2 over the surfaces, of the colours of the mesh against gathered light; or over
// the picture, with what its facets have wrong at the outlines of curved objects.
struct MeshRefinement {
  double wanted = 0.0;
  ErrorEstimate before, after;
  double outlines_before = 0.0, outlines_after = 0.0;  // by the outlines alone
  std::uint64_t faces_before = 0, faces_after = 0;
  bool met = false;
};

struct Audit {
  // time
  std::vector<StageTime> stages;
  double wall_seconds = 0.0, cpu_seconds = 0.0;  // of all stages but the audit
  // size
  std::uint64_t polygons = 0;  // input faces: the roots of the hierarchy, whatever their number of corners and holes
  std::uint64_t nodes = 0, leaves = 0, links = 0, rays = 0;
  std::uint64_t leaf_splits = 0;  // of the nodes: leaves that were split once links were there, for light that varies over them
  std::uint64_t link_splits = 0;  // links that were replaced by links of the children of an end, for light that they could not express
  std::uint64_t ray_links = 0, stored_rays = 0;     // among the links, made of rays; these
  bool rays_for_view = false;                       // they are more where Control::viewpoint looks (rays/view_importance.hpp)
  std::uint64_t clusters = 0, cluster_links = 0;    // among the nodes; among the links, with one at an end
  std::optional<ImprintedEdges> imprinted;          // of discontinuity meshing, where that was done
  std::uint64_t rays_avoided = 0;                   // at least; by the two proofs:
  std::uint64_t pairs_clear = 0, pairs_hidden = 0;  // links that nothing can block; pairs, with all below, that one object hides
  std::uint64_t audit_rays = 0;                     // over all surfaces, those of its pilots, too
  double ray_price = 1.0;                           // what a ray of the audit's paths costs, in rays among few polygons
  double ray_work = 1.0;                            // what a ray of a path costs, in rays among few polygons
  std::uint64_t bytes = 0;  // held by the result: BReps, hierarchy, links, compiled objects; the peak is that of the last stage
  // the linear system
  struct Range {
    double min = 0.0, mean = 0.0, max = 0.0;
  };
  Range proportion;               // of the leaves: inscribed over circumscribed circle, relative to that of a regular polygon
  Range row_sum;                  // of the form factors of a leaf, area-weighted mean; of the system that was solved
  Range computed_row_sum;         // the same before a closed scene was corrected
  double overfull = 0.0;          // share of the exposed area where row sums were above 1.1, which cannot be: there they were made 1
  std::optional<double> closure;  // RMS by which the row sums of a closed scene were off before they were made 1
  double ray_correction = 0.0;    // RMS correction that took the noise of stored rays out of their row sums, relative to those
  double closure_limit = 0.0;     // what quadrature and sampling explain of one (doubt.hpp); beyond, it is refused
  double energy_balance = 0.0;    // |emitted - absorbed - escaped| / emitted
  double escaped = 0.0;           // fraction of the emitted power that leaves an open scene
  double residual = 0.0;
  std::uint32_t iterations = 0;
  std::vector<std::vector<double>> histories;  // of each channel: the relative residual at the start and after each iteration
  bool converged = true;                       // solver below its residual and, when asked for, error below its target
  bool interrupted = false;                    // the best that the run had when it was told to stop; its error may not be measured
  bool coarsened = false;                      // F-refinement with larger thresholds than asked for, because of either of these:
  std::string shortage;                        // what ended the run early for lack of memory, and what to do; it has not converged then
  // error
  // Relative L2, estimated from what links and leaves cannot express (link_error.hpp): of a picture or the leaves, as was asked for; of the
  // leaves.
  std::optional<double> estimated_error, estimated_leaf_error;
  std::string estimate_doubt;     // why the estimate is no bound of the error, or far above it; empty where it may be taken for one
  bool target_missed = false;     // Options::error, by the audit; Options::target, by the estimate or the audit
  std::string rounds_ended_by;    // of Options::error, where it was missed: what ended the rounds, such as "three rounds without gain"
  std::uint32_t generations = 0;  // of BF-refinement
  std::uint64_t audit_points = 0;
  std::optional<ErrorEstimate> leaf_error;     // over all surfaces, of the constant on each leaf
  std::optional<ErrorEstimate> surface_error;  // over all surfaces, of the reconstructed radiosity, which pictures show
  std::optional<PictureError> picture_error;   // of one picture
  std::optional<MeshRefinement> mesh;          // when it was asked for
  // What steers the rounds to Options::error, from points whose number does not depend on it: the error over all surfaces, and what is
  // wrong in the light that was reflected once, of the square of that error.
  std::optional<ErrorEstimate> steering_error;
  std::optional<double> direct_share;
  // what was done
  std::vector<LeftOut> left_out;
  std::vector<std::string> warnings;  // what in the scene may not be what was meant (warnings.hpp)
  std::optional<StrayRays> stray;     // of a scene that is not proven closed
  std::vector<SurfaceMean> surfaces;
  double epsilon = 0.0, min_area = 0.0, light_epsilon = 0.0;  // as used, see `coarsened`
  double lit_part = 1.0;                  // min_area is a share of this share of the scene: of about what lamps light (Options::min_area)
  std::optional<double> reflected_share;  // RMS of the radiosity that is reflected once, relative to the mean emission: reflected_light.hpp
  double target = 0.0;                    // of BF-refinement; 0 when the time was the limit
  unsigned threads = 1, channels = 3;
  std::uint64_t seed = 0;
};

}  // namespace radiosity
