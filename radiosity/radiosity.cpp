// SPDX-License-Identifier: MIT
#include <radiosity/radiosity.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/audit/accuracy_target.hpp>
#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/out_of_memory.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/own_unit.hpp>
#include <radiosity/run/solve_at.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/light_unit.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

namespace detail {

// As solve(), for valid options and with light scaled to a unit of its own (light_unit.hpp).
HALFLIGHT_INLINE Outcome solve_in_rounds(const Scene& scene, const Options& options, const Control& control) {
  if (!options.error) { return solve_within_memory(scene, options, control); }
  const auto solve_round = [&](const Options& round, std::uint64_t held) { return solve_within_memory(scene, round, control, held); };
  if (!control.picture_error) { return solve_to_error(options, solve_round); }
  Outcome outcome = solve_to_error(options, solve_round, [&](const Solution& solution) {
    const std::optional<PictureError>& so_far = solution.audit.picture_error;
    const AuditGoal goal = goal_to_know(solution.audit, options.audit_points, so_far ? so_far->picture_work : 0);
    return control.picture_error(solution.mesh, solution.frame, goal);
  });
  if (outcome.solution && outcome.solution->audit.target_missed && control.cancelled()) {  // also during the last audit
    outcome.solution->audit.interrupted = true;
  }
  return outcome;
}

// As solve(), except that std::bad_alloc may be thrown.
HALFLIGHT_INLINE Outcome solve_sound(const Scene& scene, const Options& options, const Control& control) {
  std::vector<std::string> sentences = faults(options);
  if (!sentences.empty()) { return failed(Failure::Kind::invalid_options, std::move(sentences)); }
  return solve_in_own_unit(scene, [&](const Scene& in_unit, const LightUnit& unit) {
    Control own = control;
    if (control.picture_error) {
      own.picture_error = [&](const Mesh& mesh, const Frame& frame, const AuditGoal& goal) {
        Mesh in_watts = mesh;
        (void)to_watts(in_watts, unit);
        return control.picture_error(in_watts, frame, goal);
      };
    }
    return solve_in_rounds(in_unit, options, own);
  });
}

}  // namespace detail

HALFLIGHT_INLINE Outcome solve(const Scene& scene, const Options& options, const Control& control) {
  return detail::unless_out_of_memory([&] { return detail::solve_sound(scene, options, control); });
}

}  // namespace radiosity
