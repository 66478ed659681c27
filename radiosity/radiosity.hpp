// SPDX-License-Identifier: MIT
#pragma once

// The facade: a scene goes in, a mesh with radiosities and the audit of the run come out.
//
//   objects -> one BRep an object -> roots -> refine (oracle) -> expose -> evaluate links -> solve -> reconstruct -> audit
//
// Data flows one way; the objects stay untouched. The library prints nothing, opens no file and throws nothing.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <radiosity/audit.hpp>
#include <radiosity/audit_effort.hpp>
#include <radiosity/bf_refine.hpp>
#include <radiosity/cluster_choice.hpp>
#include <radiosity/clusters.hpp>
#include <radiosity/comparison.hpp>
#include <radiosity/evaluate.hpp>
#include <radiosity/exposure.hpp>
#include <radiosity/frame.hpp>
#include <radiosity/light_unit.hpp>
#include <radiosity/long_faces.hpp>
#include <radiosity/memory.hpp>
#include <radiosity/mesh.hpp>
#include <radiosity/options.hpp>
#include <radiosity/outcome.hpp>
#include <radiosity/polygons.hpp>
#include <radiosity/prepare.hpp>
#include <radiosity/reconstruct.hpp>
#include <radiosity/refine.hpp>
#include <radiosity/scene.hpp>
#include <radiosity/solve.hpp>
#include <radiosity/summary.hpp>
#include <radiosity/transport.hpp>
#include <radiosity/wall_cuts.hpp>
#include <radiosity/warnings.hpp>

namespace radiosity {

namespace detail {

// What is in the unit becomes W/m2; false when the light is more than a double holds.
[[nodiscard]] inline bool to_watts(Color& c, const LightUnit& unit) {
  c = unit.to_watts(c);
  return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
}
[[nodiscard]] inline bool to_watts(Mesh& mesh, const LightUnit& unit) {
  bool finite = true;
  for (MeshCorner& corner : mesh.corners) { finite = to_watts(corner.radiosity, unit) && finite; }
  for (MeshFace& face : mesh.faces) { finite = to_watts(face.radiosity, unit) && finite; }
  return finite;
}
[[nodiscard]] inline bool to_watts(Solution& solution, const LightUnit& unit) {
  bool finite = to_watts(solution.mesh, unit);
  for (Color& c : solution.radiosity) { finite = to_watts(c, unit) && finite; }
  for (SurfaceMean& mean : solution.audit.surfaces) { finite = to_watts(mean.radiosity, unit) && finite; }
  if (solution.comparison) {
    finite = to_watts(solution.comparison->other, unit) && finite;
    for (Color& c : solution.comparison->dense) { finite = to_watts(c, unit) && finite; }
  }
  return finite;
}

// What `solve` makes of the scene in its own unit, in W/m2.
template <class Solve>
[[nodiscard]] Outcome solve_in_own_unit(const Scene& scene, const Solve& solve) {
  std::vector<std::string> sentences = faults(scene);
  if (!sentences.empty()) { return failed(Failure::Kind::invalid_scene, std::move(sentences)); }
  const LightUnit unit = light_unit(scene);
  Outcome outcome = solve(in_unit(scene, unit), unit);
  if (outcome.solution && !to_watts(*outcome.solution, unit)) {
    return failed(Failure::Kind::invalid_scene, {"the light is stronger than a number can hold; give the emissions in a larger unit"});
  }
  return outcome;
}

// Calls `attempt`; memory that runs out in it, here or on another thread, is an outcome in a program that is compiled with exceptions.
template <class Attempt>
[[nodiscard]] Outcome unless_out_of_memory(const Attempt& attempt) {
#if defined(__cpp_exceptions)
  try {
    return attempt();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {}  // a table longer than the address space
  Outcome outcome{std::nullopt, {Failure::Kind::out_of_memory, {}}};
  try {
    outcome.failure.sentences.emplace_back(
        "the system has no more memory for this run; a larger epsilon, min_area, target or error needs less");
  } catch (const std::bad_alloc&) {}  // not even for a sentence
  return outcome;
#else
  return attempt();
#endif
}

}  // namespace detail

// As many rays of paths as the solution took time: a ray of a path costs as much as two segments of links or two thirds of a link.
[[nodiscard]] inline std::uint64_t rays_worth(const Audit& audit) { return (audit.rays + 3 * audit.links) / 2; }

// For an audit without a target: as long as the solution took, or 2000 rays a point.
[[nodiscard]] inline AuditGoal goal_to_know(const Audit& audit, std::uint32_t points) {
  return {points, std::max<std::uint64_t>(rays_worth(audit), 2000 * std::uint64_t{points})};
}

// Solves the scene. With an error target the run starts coarse and refines until the audit witnesses the target: the upper end of its 95 %
// interval is at most that. Times are those of all rounds together. A run whose error stays above says so by audit.converged; when it
// gives up stands in accuracy_target.hpp.
//
// Memory that runs out is an outcome, too (Failure::Kind::out_of_memory, or the best solution so far with audit.shortage), and a thread that
// cannot be started is done without. A program that is compiled without exceptions is ended by the platform where memory runs out, as
// anywhere; Options::memory ends a run before that.
[[nodiscard]] Outcome solve(const Scene& scene, const Options& options = {}, const Control& control = {});

}  // namespace radiosity

#ifndef HALFLIGHT_RADIOSITY_APART
#include <radiosity/run.hpp>
#endif
