// SPDX-License-Identifier: MIT
#include "apps/study/measure.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <thread>
#include <utility>

#include <raycast/ray.hpp>

#include <radiosity/audit/picture_error.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/result/comparison.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/left_out.hpp>

#include "apps/memory.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

using radiosity::Color;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string seconds_text(double seconds) { return apps::formatted("%.3g", seconds); }

// Stops a run that takes too long, or if the study itself is stopped.
class RunLimit {
 public:
  RunLimit(double seconds, const radiosity::Control& outer)
      : end_{cpu_seconds() + seconds}, watcher_{[this, &outer](const std::stop_token& done) {
          while (!done.stop_requested()) {
            if (outer.cancelled() || cpu_seconds() > end_) { stop_ = true; }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
          }
        }} {}
  RunLimit(const RunLimit&) = delete;
  RunLimit& operator=(const RunLimit&) = delete;

  [[nodiscard]] radiosity::Control control() const { return {&stop_, {}, {}, {}}; }

 private:
  std::atomic<bool> stop_{false};
  double end_;
  std::jthread watcher_;  // must be last, because it uses the other members
};

// The data of one run, kept until it is known which run is shown as a picture.
struct Measured {
  Run run;
  std::vector<double> cells;  // signed errors of the picture
  std::vector<radiosity::LeftOut> left_out;
};

Measured errors_of_run(const radiosity::Scene& scene, const TrueRadiosity& truth, const radiosity::Solution& solution, std::string setting,
                       std::uint64_t peak_bytes) {
  Measured measured;
  Run& run = measured.run;
  run.setting = std::move(setting);
  run.cpu_seconds = solution.audit.cpu_seconds;
  run.peak_bytes = peak_bytes;
  run.bytes = solution.audit.bytes;
  run.links = solution.audit.links;
  run.leaves = solution.audit.leaves;
  run.rays = solution.audit.rays;
  run.cut_off = solution.audit.shortage;
  const std::vector<Color> leaves = values_at(scene, solution, solution.mesh, truth, &solution.radiosity);
  const std::vector<Color> weighted = values_at(scene, solution, solution.mesh, truth);
  const radiosity::Comparison& comparison = *solution.comparison;
  run.leaves_error = errors_of(truth, leaves);
  run.weighted_error = errors_of(truth, weighted, &measured.cells);
  run.simple_error = errors_of(truth, values_at(scene, solution, comparison.other, truth));
  if (!comparison.dense.empty()) {
    const std::vector<Color> dense = values_at(scene, solution, solution.mesh, truth, &comparison.dense);
    run.parts = ErrorParts{errors_of(truth, dense).points.l2, distance(truth, leaves, dense), solution.audit.residual,
                           distance(truth, weighted, leaves)};
  }
  return measured;
}

// Measures the error of what the scene's camera sees: the true objects, coloured by the solution, at 16 points per pixel. A small number
// of pixels is enough to know the error to about a quarter of itself.
class PictureJudge {
 public:
  PictureJudge(const radiosity::Scene& scene, const radiosity::Camera& camera)
      : scene_{scene},
        view_{radiosity::make_view(camera, camera.size.value_or(radiosity::PictureSize{}))},
        audit_{radiosity::PictureAudit::make(scene)} {}

  [[nodiscard]] std::optional<radiosity::ErrorEstimate> operator()(const radiosity::Solution& solution,
                                                                   const radiosity::Control& control) const {
    if (!audit_) { return std::nullopt; }
    const radiosity::Lookup lookup{scene_, solution.mesh, solution.frame};
    const auto radiosity = [&](std::uint32_t x, std::uint32_t y) {
      std::array<glm::dvec3, 16> directions;
      for (unsigned k = 0; k < 16; ++k) { directions[k] = view_.direction(x + (k % 4 + 0.5) / 4.0, y + (k / 4 + 0.5) / 4.0); }
      Color sum{0.0};
      for (const auto& seen : lookup.seen16(view_.eye, directions)) { sum += seen ? seen->radiosity / 16.0 : Color{0.0}; }
      return sum;
    };
    const radiosity::ShownPicture shown{view_.size.width, view_.size.height,
                                        [&](double x, double y) {
                                          return raycast::Segment{view_.eye, view_.direction(x, y)};
                                        },
                                        radiosity, [](double b) { return b; }};
    const auto error = audit_->measure(shown, {1000, 1'000'000}, 0, 1, control);
    return error ? std::optional{error->error} : std::nullopt;
  }

 private:
  const radiosity::Scene& scene_;
  radiosity::View view_;
  std::optional<radiosity::PictureAudit> audit_;
};

// Runs one setting; the result contains errors, or the reason why there are none.
Measured run_once(const radiosity::Scene& scene, const TrueRadiosity& truth, const PictureJudge& judge, const Setting& setting,
                  const MeasureOptions& options, const radiosity::Control& control) {
  constexpr double brief = 0.3;  // seconds; a shorter run is repeated up to three times, and the shortest time counts
  radiosity::Outcome outcome;
  std::uint64_t peak_bytes = 0;
  for (int k = 0; k < 3; ++k) {
    const apps::PeakMeter meter;
    const RunLimit run_limit{options.cpu_seconds_per_run, control};
    const double begin = cpu_seconds();
    radiosity::Outcome again = setting.run(scene, run_limit.control());
    // The solution of an interrupted run states the time of its last round only; all the time spent must count.
    if (again.solution && again.solution->audit.interrupted) { again.solution->audit.cpu_seconds = cpu_seconds() - begin; }
    const bool of_other_setting = again.solution && again.solution->audit.coarsened;
    if (!again.solution || of_other_setting) {
      Measured none;
      none.run.setting = setting.text;
      const bool stopped = of_other_setting || again.failure.kind == radiosity::Failure::Kind::cancelled;
      none.run.refused = stopped ? "takes more than " + seconds_text(options.cpu_seconds_per_run) + " s of CPU time"
                         : again.failure.sentences.empty() ? "out of memory"
                                                           : again.failure.sentences.front();
      return none;
    }
    // Later runs find memory still allocated by the first one. A comparison follows the actual run and is not counted.
    if (k == 0) { peak_bytes = meter.taken(again.solution->audit, "reconstruct").value_or(0); }
    const double before = outcome.solution ? outcome.solution->audit.cpu_seconds : std::numeric_limits<double>::infinity();
    if (again.solution->audit.cpu_seconds < before) { outcome = std::move(again); }
    if (outcome.solution->audit.cpu_seconds > brief) { break; }
  }
  radiosity::Solution& solution = *outcome.solution;
  if (solution.comparison->dense.empty() && solution.audit.leaves <= options.dense_leaves) {
    radiosity::Outcome dense = setting.dense(scene, solution, {control.cancel, {}, {}, {}});
    if (dense.solution && dense.solution->hierarchy.size() == solution.hierarchy.size()) {
      solution.comparison->dense = std::move(dense.solution->comparison->dense);
    }
  }
  Measured measured = errors_of_run(scene, truth, solution, setting.text, peak_bytes);
  measured.left_out = solution.audit.left_out;
  if (solution.audit.interrupted) {
    measured.run.cut_off = "stopped after " + seconds_text(options.cpu_seconds_per_run) + " s of CPU time";
  }
  measured.run.picture_error = judge(solution, control);
  if (setting.without_shortcuts) {
    const RunLimit run_limit{options.cpu_seconds_per_run, control};
    const radiosity::Outcome forced = setting.without_shortcuts(scene, run_limit.control());
    if (forced.solution) { measured.run.seconds_saved = forced.solution->audit.cpu_seconds - solution.audit.cpu_seconds; }
  }
  return measured;
}

// The picture of the run whose error is closest to one per cent (by ratio).
std::optional<ErrorPicture> picture_of(const TrueRadiosity& truth, const Method& method, const std::vector<Measured>& runs) {
  const Measured* best = nullptr;
  const auto away = [](const Measured& m) { return std::abs(std::log(std::max(1e-12, m.run.weighted_error.cells.l2) / 0.01)); };
  for (const Measured& m : runs) {
    if (m.run.refused.empty() && m.run.cut_off.empty() && (best == nullptr || away(m) < away(*best))) { best = &m; }
  }
  if (best == nullptr) { return std::nullopt; }
  ErrorPicture picture{method.name, best->run.setting, {}};
  for (std::size_t i = 0; i < truth.cells.size(); ++i) { picture.cells.push_back({truth.cells[i].corners, best->cells[i]}); }
  return picture;
}

}  // namespace

std::vector<Color> values_at(const radiosity::Scene& scene, const radiosity::Solution& solution, const radiosity::Mesh& mesh,
                             const TrueRadiosity& truth, const std::vector<Color>* leaf_values) {
  radiosity::Mesh constant;
  if (leaf_values != nullptr) {
    constant = mesh;
    for (const radiosity::MeshFace& face : mesh.faces) {
      if (!(solution.area[face.node] > 0.0)) { continue; }  // none of its samples is exposed; neighbouring leaves give its colours
      for (std::uint32_t c = 0; c < face.corner_count; ++c) {
        constant.corners[face.first_corner + c].radiosity = (*leaf_values)[face.node];
      }
    }
  }
  const radiosity::Lookup lookup{scene, leaf_values != nullptr ? constant : mesh, solution.frame};
  std::vector<Color> values;
  values.reserve(truth.points.size());
  for (const ReferencePoint& p : truth.points) { values.push_back(lookup.at(p.at.object, p.at.sheet, p.at.position).value_or(Color{0.0})); }
  return values;
}

void measure(const radiosity::Scene& scene, const TrueRadiosity& truth, const std::vector<MethodPlan>& methods,
             const MeasureOptions& options, const radiosity::Control& control, SceneStudy& study) {
  study.reference = describe(truth);
  const PictureJudge judge{scene, study.camera};
  study.left_out = truth.left_out;
  for (const MethodPlan& plan : methods) {
    if (control.cancelled()) { return; }
    Method method{plan.name, plan.summary, {}};
    std::vector<Measured> runs;
    for (const Setting& setting : plan.settings) {
      Measured measured;
      if (!runs.empty() && !(runs.back().run.refused.empty() && runs.back().run.cut_off.empty())) {
        measured.run.setting = setting.text;
        measured.run.refused = "not tried: a coarser setting was not done in its limits";
      } else {
        measured = run_once(scene, truth, judge, setting, options, control);
        if (control.cancelled()) { break; }
        if (options.finished) { options.finished(method, measured.run); }
      }
      method.runs.push_back(measured.run);
      runs.push_back(std::move(measured));
    }
    if (method.runs.empty()) { return; }
    if (auto picture = picture_of(truth, method, runs)) { study.pictures.push_back(std::move(*picture)); }
    const auto last = std::find_if(runs.rbegin(), runs.rend(), [](const Measured& m) { return m.run.refused.empty(); });
    if (study.methods.empty() && last != runs.rend() && !last->left_out.empty()) { study.left_out = std::move(last->left_out); }
    study.methods.push_back(std::move(method));
  }
}

}  // namespace study
