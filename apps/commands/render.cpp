// SPDX-License-Identifier: MIT
#include "apps/commands/render.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <limits>
#include <map>
#include <utility>

#include <radiosity/picture_error.hpp>
#include <radiosity/radiosity.hpp>

#include "apps/audited_picture.hpp"
#include "apps/commands/arguments.hpp"
#include "apps/commands/common.hpp"
#include "apps/interrupt.hpp"
#include "apps/memory.hpp"
#include "apps/picture.hpp"
#include "apps/ply.hpp"
#include "apps/png.hpp"
#include "apps/progress.hpp"
#include "apps/raycast_picture.hpp"
#include "apps/report.hpp"

namespace apps {
namespace {

enum class Format { png, ply };

std::optional<Format> format_of(const std::string& path) {
  if (path.size() > 4 && path.ends_with(".png")) { return Format::png; }
  if (path.size() > 4 && path.ends_with(".ply")) { return Format::ply; }
  return std::nullopt;
}

bool has_picture(const RenderOptions& options) {
  for (const std::string& output : options.outputs) {
    if (format_of(output) == Format::png) { return true; }
  }
  return false;
}

// WxH, each side from 1 to max_picture_side.
std::optional<PictureSize> parse_size(const std::string& text) {
  PictureSize size;
  const char* const end = text.data() + text.size();
  const auto [cross, width_code] = std::from_chars(text.data(), end, size.width);
  if (width_code != std::errc() || cross == end || *cross != 'x') { return std::nullopt; }
  const auto [rest, height_code] = std::from_chars(cross + 1, end, size.height);
  if (height_code != std::errc() || rest != end) { return std::nullopt; }
  const auto fits = [](std::uint32_t side) { return side >= 1 && side <= max_picture_side; };
  return fits(size.width) && fits(size.height) ? std::optional(size) : std::nullopt;
}

std::optional<Camera> choose_camera(const SceneFile& file, const std::string& name) {
  if (name.empty()) { return file.cameras.empty() ? automatic_camera(file.scene) : file.cameras.front(); }
  std::string known;
  for (const Camera& camera : file.cameras) {
    if (camera.name == name) { return camera; }
    known += (known.empty() ? "" : ", ") + camera.name;
  }
  complain("there is no camera '" + name + "' in the scene; " + (known.empty() ? "it has none" : "it has: " + known));
  return std::nullopt;
}

std::vector<std::string> all_outputs(const RenderOptions& options) {
  std::vector<std::string> paths = options.outputs;
  paths.push_back(options.json);
  return paths;
}

// Outputs that cannot become files are refused before any work.
ExitCode check(const RenderOptions& options) {
  for (const std::string& path : options.outputs) {
    if (!format_of(path)) {
      complain("--output " + path + ": expected a name that ends with .png or .ply");
      return ExitCode::usage;
    }
  }
  return check_outputs(all_outputs(options), {options.scene});
}

ExitCode report_failure(const radiosity::Failure& failure, const std::string& scene) {
  if (failure.kind == radiosity::Failure::Kind::cancelled) {
    complain("interrupted; nothing was written");
    return ExitCode::failure;
  }
  if (failure.kind == radiosity::Failure::Kind::out_of_memory) {
    complain(failure.sentences.empty() ? "out of memory" : failure.sentences.front());
    return ExitCode::failure;
  }
  if (failure.kind == radiosity::Failure::Kind::invalid_options) {
    for (const std::string& sentence : failure.sentences) { complain(sentence); }
    return ExitCode::usage;
  }
  complain_of(scene, failure.sentences);
  return ExitCode::invalid_input;
}

class Stopwatch {
 public:
  [[nodiscard]] radiosity::StageTime stop(std::string name) const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
    return {std::move(name), wall.count(), static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC, radiosity::peak_memory()};
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

// What --memory leaves for the run: less what the program and the scene hold now. The picture is drawn when the run holds its solution
// alone, a third of its peak at most.
std::optional<std::uint64_t> memory_left(const RenderOptions& options, const Camera& camera) {
  const std::uint64_t held = resident_memory().value_or(0);
  const PictureSize size = options.size.value_or(camera.size.value_or(PictureSize{}));
  constexpr std::uint64_t band = 20'000'000, pixel = 20;  // of samples; of colours and their coded form
  const std::uint64_t picture = has_picture(options) ? band + pixel * size.width * size.height : 0;
  if (held + picture >= *options.memory) {
    complain("--memory allows " + radiosity::memory_text(*options.memory) + ", but the program and the scene hold " +
             radiosity::memory_text(held) + " before the run" +
             (picture > 0 ? ", and the picture takes " + radiosity::memory_text(picture) : std::string()) + "; allow more" +
             (picture > 0 ? " or make the picture smaller" : ""));
    return std::nullopt;
  }
  const std::uint64_t left = *options.memory - held;
  return std::min(left, 3 * (left - picture));
}

struct Output {
  std::string path;
  std::string bytes;
};

// Draws a solution as it will be shown, and audits what it has drawn.
class Artist {
 public:
  Artist(const RenderOptions& options, const SceneFile& file, const Camera& camera)
      : options_{options}, file_{file}, view_{make_view(camera, options.size.value_or(camera.size.value_or(PictureSize{})))} {}

  [[nodiscard]] double exposure(const radiosity::Mesh& mesh) const {
    return options_.exposure ? *options_.exposure : automatic_exposure(mesh, file_.scene);
  }
  [[nodiscard]] PictureSize size() const { return view_.size; }
  // Nothing when interrupted.
  [[nodiscard]] std::optional<Picture> draw(const radiosity::Mesh& mesh, const radiosity::Frame& frame,
                                            const radiosity::Control& control) const {
    const double by = exposure(mesh);
    if (options_.method == PictureMethod::mesh) { return apps::draw(mesh, view_, by, 4, control.cancel); }
    const radiosity::Lookup lookup(file_.scene, mesh, frame);
    return apps::draw(lookup, view_, by, options_.solver.threads, 4, control);
  }
  [[nodiscard]] std::optional<radiosity::PictureError> audit(const Picture& picture, double exposure, const radiosity::AuditGoal& goal,
                                                             const radiosity::Control& control) {
    if (!asked_) {
      audit_ = radiosity::PictureAudit::make(file_.scene);
      asked_ = true;
    }
    if (!audit_) { return std::nullopt; }
    return audit_->measure(audited(picture, view_, exposure), goal, options_.solver.threads, options_.solver.seed, control);
  }

 private:
  const RenderOptions& options_;
  const SceneFile& file_;
  View view_;
  std::optional<radiosity::PictureAudit> audit_;
  bool asked_ = false;
};

// Everything that is to be written, in memory. Nothing when interrupted.
std::optional<std::vector<Output>> encode(const RenderOptions& options, const SceneFile& file, const Camera& camera, Artist& artist,
                                          const radiosity::Solution& solution, const radiosity::Control& control, Report& report) {
  if (control.cancelled()) { return std::nullopt; }
  std::vector<Output> outputs;
  std::string png;
  if (has_picture(options)) {
    const Stopwatch watch;
    const auto picture = artist.draw(solution.mesh, solution.frame, control);
    if (!picture) { return std::nullopt; }
    png = to_png(*picture);
    report.picture = PictureReport{camera.name, artist.size().width, artist.size().height, options.method};
    std::vector<radiosity::StageTime> stages{watch.stop("picture")};
    leave_out_others(stages);
    report.picture_time = stages.front();
    if (!report.audit.picture_error && options.solver.audit_points > 0) {
      const Stopwatch audit_watch;
      report.audit.picture_error =
          artist.audit(*picture, report.exposure, radiosity::goal_to_know(report.audit, options.solver.audit_points), control);
      stages = {audit_watch.stop("picture audit")};
      leave_out_others(stages);
      report.audit.stages.push_back(stages.front());
      report.audit.interrupted = report.audit.interrupted || control.cancelled();  // the picture is complete, its error not measured
    }
  }
  for (const std::string& path : options.outputs) {
    const bool is_png = format_of(path) == Format::png;
    outputs.push_back({path, is_png ? png : to_ply(solution.mesh, radiosity::surfaces(file.scene), report.exposure)});
    report.files.push_back(path);
  }
  if (!options.json.empty()) {
    report.files.push_back(options.json);
    outputs.push_back({options.json, to_json(report)});
  }
  return outputs;
}

ExitCode write_all(const std::vector<Output>& outputs) {
  for (const Output& output : outputs) {
    if (!save(output.path, output.bytes)) { return ExitCode::failure; }
  }
  return ExitCode::ok;
}

}  // namespace

void describe(CLI::App& command, RenderOptions& options) {
  radiosity::Options& solver = options.solver;
  command.add_option("scene", options.scene, "the .scene file")->required()->type_name("SCENE");
  command
      .add_option("-o,--output", options.outputs,
                  "what to write: a picture (.png) or a mesh (.ply); repeat for more; without, the report alone")
      ->type_name("FILE")
      ->allow_extra_args(false);
  auto* error =
      command.add_option("--error", solver.error, "refine until the measured relative L2 error is at most this")->check(above_zero(1.0));
  command
      .add_option("--error-of", options.error_of,
                  "what --error is about: picture, what the camera sees (the default with a .png), or surfaces, all of them by area")
      ->transform(one_of(std::map<std::string, ErrorOf>{{"picture", ErrorOf::picture}, {"surfaces", ErrorOf::surfaces}}))
      ->needs(error);
  // BF-refinement is asked for by what ends it.
  const auto bf = [&solver](const std::string&) { solver.refinement = radiosity::Refinement::a_posteriori; };
  auto* target =
      command
          .add_option(
              "--target", solver.target,
              "BF-refinement (paper 4.4), split by the light that links carry, until the estimated relative L2 error is at most this")
          ->check(above_zero(1.0))
          ->each(bf)
          ->excludes(error);
  auto* time = command
                   .add_option("--time", solver.time,
                               "BF-refinement, what promises most first, for this many seconds; the audit and the picture come on top")
                   ->check(above_zero(1e6))
                   ->each(bf)
                   ->excludes(error)
                   ->excludes(target);
  command.add_option("--epsilon", solver.epsilon, "largest form factor of a link (default " + CLI::detail::to_string(solver.epsilon) + ")")
      ->check(above_zero(1.0))
      ->excludes(error)
      ->excludes(target)
      ->excludes(time);
  command.add_option("--min-area", solver.min_area, "smallest patch, relative to the area of the scene")
      ->check(above_zero(1.0))
      ->excludes(error)
      ->excludes(target)
      ->excludes(time);
  command
      .add_option("--light-epsilon", solver.light_epsilon,
                  "share of the error that the light of a lamp may cause by varying over one patch (default: a quarter of epsilon)")
      ->check(above_zero(1.0))
      ->excludes(error)
      ->excludes(target)
      ->excludes(time);
  command.add_option("--camera", options.camera, "camera of the scene (default: the first; without any, an automatic view)");
  command
      .add_option_function<std::string>(
          "--size", [&options](const std::string& text) { options.size = parse_size(text); },
          "picture size in pixels (default: the camera's, else 800x600)")
      ->type_name("WxH")
      ->check([](const std::string& text) {
        return parse_size(text) ? std::string()
                                : "expected WIDTHxHEIGHT, each 1 to " + std::to_string(max_picture_side) + ", found '" + text + "'";
      });
  command
      .add_option("--method", options.method,
                  "what the picture shows: mesh, the triangles of the solution, or raycast, the objects themselves with smooth outlines")
      ->transform(one_of(std::map<std::string, PictureMethod>{{"mesh", PictureMethod::mesh}, {"raycast", PictureMethod::raycast}}));
  command.add_option("--exposure", options.exposure, "factor from radiance to picture (default: automatic)")
      ->check(above_zero(std::numeric_limits<double>::max()));
  command.add_option("--threads", solver.threads, "threads (default: all); results do not depend on it")
      ->check(whole_number(1, most_threads));
  command.add_option("--seed", solver.seed, "seed of all random choices")
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  command.add_option("--audit", solver.audit_points, "points at which the error is measured; 0: none")->check(whole_number(0, 100'000'000));
  std::map<std::string, radiosity::Solver> solvers;
  for (const auto s :
       {radiosity::Solver::conjugate_gradients, radiosity::Solver::jacobi, radiosity::Solver::gauss_seidel, radiosity::Solver::southwell}) {
    solvers.emplace(name(s), s);
  }
  command.add_option("--solver", solver.solver, "cg, jacobi, gauss-seidel or southwell")->transform(one_of(solvers));
  command.add_option("--reconstruction", solver.reconstruction, "weighted or simple (paper fig. 5), or constant: one colour a leaf")
      ->transform(one_of(std::map<std::string, radiosity::Reconstruction>{{"weighted", radiosity::Reconstruction::weighted},
                                                                          {"simple", radiosity::Reconstruction::simple},
                                                                          {"constant", radiosity::Reconstruction::constant}}));
  command.add_flag("!--no-shortcuts", solver.shortcuts,
                   "do all that the report would tell as left out; the result is the same, to the bit");
  command
      .add_option_function<std::string>(
          "--memory", [&options](const std::string& text) { options.memory = parse_memory(text); },
          "most memory that the program may hold, such as 500M or 2G; a run that would need more ends before")
      ->type_name("BYTES")
      ->check(memory_fault);
  command.add_option("--json", options.json, "write the report as JSON, too")->type_name("FILE");
  command.add_flag("--quiet", options.quiet, "no narration and no progress bar");
}

ExitCode run(const RenderOptions& options) {
  const std::atomic<bool>& cancel = watch_interrupts();
  if (options.solver.error && options.solver.audit_points == 0) {
    complain("--error needs the audit as its witness; leave --audit 0 out");
    return ExitCode::usage;
  }
  if (const ExitCode code = check(options); code != ExitCode::ok) { return code; }
  ExitCode code = ExitCode::ok;
  const auto file = load_scene(options.scene, code);
  if (!file) { return code; }
  const auto camera = choose_camera(*file, options.camera);
  if (!camera) { return ExitCode::usage; }

  radiosity::Options settings = options.solver;
  if (options.outputs.empty()) { settings.reconstruction = radiosity::Reconstruction::none; }
  if (options.memory) {
    settings.memory = memory_left(options, *camera);
    if (!settings.memory) { return ExitCode::failure; }
  }
  Progress progress(options.quiet);
  radiosity::Control control;
  control.cancel = &cancel;
  control.progress = [&](std::string_view stage, double part) { progress.report(stage, part); };
  Artist artist(options, *file, *camera);
  if (settings.error && options.error_of.value_or(has_picture(options) ? ErrorOf::picture : ErrorOf::surfaces) == ErrorOf::picture) {
    control.picture_error = [&](const radiosity::Mesh& mesh, const radiosity::Frame& frame,
                                const radiosity::AuditGoal& goal) -> std::optional<radiosity::PictureError> {
      const auto picture = artist.draw(mesh, frame, control);
      if (!picture) { return std::nullopt; }
      return artist.audit(*picture, artist.exposure(mesh), goal, control);
    };
  }
  const radiosity::Outcome outcome = radiosity::solve(file->scene, settings, control);
  if (outcome.solution && outcome.solution->audit.interrupted) { control = control.unstoppable(); }  // what there is, is written
  progress.done();
  if (!outcome.solution) { return report_failure(outcome.failure, options.scene); }

  const radiosity::Solution& solution = *outcome.solution;
  Report report;
  report.scene = options.scene;
  report.options = settings;
  report.audit = solution.audit;
  leave_out_others(report.audit.stages);
  report.automatic_exposure = !options.exposure;
  report.exposure = artist.exposure(solution.mesh);
  const auto outputs = encode(options, *file, *camera, artist, solution, control, report);
  progress.done();
  if (!outputs) { return report_failure({radiosity::Failure::Kind::cancelled, {}}, options.scene); }
  if (code = write_all(*outputs); code != ExitCode::ok) { return code; }
  if (!print(to_text(report), all_outputs(options))) { return ExitCode::failure; }
  if (!solution.audit.shortage.empty()) {
    complain(solution.audit.shortage + "; the outputs show the best solution so far");
    return ExitCode::not_converged;
  }
  if (report.audit.interrupted) {
    complain("interrupted: the outputs show the best solution so far");
    return ExitCode::not_converged;
  }
  if (solution.audit.converged) { return ExitCode::ok; }
  complain("not converged: the outputs show what was reached");
  return ExitCode::not_converged;
}

}  // namespace apps
