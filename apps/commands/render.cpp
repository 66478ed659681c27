// SPDX-License-Identifier: MIT
// halflight render SCENE [-o OUT.png] [-o OUT.ply] ...: solves a scene, writes pictures and meshes, prints the report.
//
// Foreseeable failures are reported before the solver starts: wrong extensions, missing folders, an unknown camera. Outputs are
// encoded in memory; then each replaces its file completely (files.hpp).
#include <algorithm>
#include <memory>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/memory.hpp>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/commands/render_outputs.hpp"
#include "apps/intake/model.hpp"
#include "apps/light_file.hpp"
#include "apps/memory.hpp"
#include "apps/process.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

std::optional<radiosity::Camera> choose_camera(const SceneFile& file, const std::string& name) {
  if (name.empty()) { return file.cameras.empty() ? radiosity::automatic_camera(file.scene) : file.cameras.front(); }
  std::vector<std::string> known;
  for (const radiosity::Camera& camera : file.cameras) {
    if (camera.name == name) { return camera; }
    known.push_back(camera.name);
  }
  complain("there is no camera '" + name + "' in the scene; " + (known.empty() ? "it has none" : "it has: " + joined(known)));
  return std::nullopt;
}

std::vector<std::string> all_outputs(const RenderOptions& options) {
  std::vector<std::string> paths = options.outputs;
  paths.push_back(options.lightmap);
  paths.push_back(options.json);
  return paths;
}

// Refuses outputs that cannot be written, and options that have no effect, before any work.
ExitCode check(const RenderOptions& options) {
  for (const std::string& path : options.outputs) {
    if (!render_format(path)) {
      return complain("--output " + path + ": expected a name that ends with " + render_endings(), ExitCode::usage);
    }
  }
  const auto any = [&](bool ply) {
    return std::any_of(options.outputs.begin(), options.outputs.end(), [ply](const std::string& path) {
      const auto format = render_format(path);
      return format == RenderFormat::exported || (ply && format == RenderFormat::ply);
    });
  };
  if (options.onto_input && !any(true)) {
    return complain("--onto-input is about outputs that end with .ply, .glb or .obj; there is none", ExitCode::usage);
  }
  if (!options.lightmap.empty() && !any(false)) {
    return complain("--lightmap is about outputs that end with .glb or .obj; there is none", ExitCode::usage);
  }
  if (!options.lightmap.empty() && !is_picture(options.lightmap)) {
    return complain("--lightmap " + options.lightmap + ": expected a name that ends with .hdr, .pfm or .png", ExitCode::usage);
  }
  const auto shows_mesh = [&](const std::string& path) {
    const RenderFormat format = *render_format(path);
    if (is_picture(path)) { return options.method == PictureMethod::mesh; }
    return format == RenderFormat::html || (!options.onto_input && (format == RenderFormat::ply || options.lightmap.empty()));
  };
  if (options.solver.mesh_error && std::none_of(options.outputs.begin(), options.outputs.end(), shows_mesh)) {
    return complain("--mesh-error is about meshes, pages and pictures by --method mesh; there is none", ExitCode::usage);
  }
  if (options.error_of && !options.solver.error && !options.solver.mesh_error) {
    return complain("--error-of says what --error or --mesh-error is about; give one of them", ExitCode::usage);
  }
  if (!options.light.empty() && (options.outputs.empty() || !std::all_of(options.outputs.begin(), options.outputs.end(), is_picture))) {
    return complain("--light draws pictures: expected outputs that end with .png, .hdr or .pfm, and nothing else", ExitCode::usage);
  }
  return check_outputs(all_outputs(options), {options.scene, options.light});
}

// `of_limit`: to be added to the sentence of a run that ran out of memory.
ExitCode report_failure(const radiosity::Failure& failure, const std::string& scene, const std::string& of_limit = {}) {
  using Kind = radiosity::Failure::Kind;
  if (failure.kind == Kind::cancelled) { return complain("interrupted; nothing was written", ExitCode::failure); }
  if (failure.kind == Kind::out_of_memory) {
    return complain((failure.sentences.empty() ? "out of memory" : failure.sentences.front()) + of_limit, ExitCode::failure);
  }
  if (failure.kind == Kind::invalid_options) {
    for (const std::string& sentence : failure.sentences) { complain(sentence); }
    return ExitCode::usage;
  }
  complain_of(scene, failure.sentences);
  return ExitCode::invalid_input;
}

// How --memory is divided. Measured on the examples: beyond the peak of the run, a picture of the mesh takes up to 80 bytes a pixel, and
// one in gathered light 190 bytes a pixel and tables that grow with the solution. The run predicts its own peak up to twice too high, which
// leaves room for these tables. If that is still not enough, for instance where pixels show many things each, the picture shows the mesh
// (Artist::method).
struct MemoryShares {
  std::uint64_t held = 0;     // by the program and the scene, before the run
  std::uint64_t picture = 0;  // 0: there is none
  [[nodiscard]] std::string text() const {
    return "the program and the scene hold " + radiosity::memory_text(held) + " before the run" +
           (picture > 0 ? ", and the picture takes " + radiosity::memory_text(picture) : std::string());
  }
};

MemoryShares memory_shares(const RenderOptions& options, const radiosity::Camera& camera) {
  constexpr std::uint64_t unread = 4'000'000;  // parts of the program itself that are loaded only when they are executed
  const radiosity::PictureSize size = options.size.value_or(camera.size.value_or(radiosity::PictureSize{}));
  const bool gathered = options.method == PictureMethod::gather;
  const std::uint64_t tables = gathered ? 12'000'000 : 4'000'000, pixel = gathered ? 200 : 80;  // bytes
  return {resident_memory().value_or(0) + unread, has_picture(options) ? tables + pixel * size.width * size.height : 0};
}

ExitCode write_all(const std::vector<RenderOutput>& outputs) {
  for (const RenderOutput& output : outputs) {
    if (!save(output.path, output.bytes)) { return ExitCode::failure; }
  }
  return ExitCode::ok;
}

// The scene for a .light file: the one named on the command line, or else the one in the file.
std::optional<SceneFile> scene_of_light(const RenderOptions& options, const std::string& bytes, ExitCode& code) {
  if (!options.scene.empty()) {
    ModelOptions model = options.model;
    model.camera.reset();  // the camera must not change the scene that was solved
    return load_scene(options.scene, all_outputs(options), code, model);
  }
  std::string reason;
  const auto source = source_in_light_file(bytes, reason);
  if (source) { return load_scene(*source, code); }
  code = complain(shown(options.light) + ": " + reason, ExitCode::invalid_input);
  return std::nullopt;
}

// Says that the picture could not be gathered within --memory, if so.
ExitCode complain_of_picture(const Artist& artist) {
  if (artist.method() == artist.options().method) { return ExitCode::ok; }
  return complain(
      "the picture in gathered light would take more memory than --memory allows, so it shows the mesh; allow more or make the "
      "picture smaller",
      ExitCode::not_converged);
}

// Draws pictures from a stored solution.
ExitCode draw_light(const RenderOptions& options, const radiosity::Control& control) {
  ExitCode code = ExitCode::ok;
  const auto bytes = load_text(options.light, code);
  const auto file = bytes ? scene_of_light(options, *bytes, code) : std::nullopt;
  if (!file) { return code; }
  const auto chosen = choose_camera(*file, options.camera);
  if (!chosen) { return ExitCode::usage; }
  const radiosity::Camera& camera = options.model.camera ? *options.model.camera : *chosen;
  const LightResult read = read_light_file(*bytes, file->scene);
  if (!read.light) { return complain(shown(options.light) + ": " + read.reason, ExitCode::invalid_input); }
  Artist artist(options, *file, camera);
  const radiosity::Tone tone = artist.tone(read.light->mesh);
  const auto picture = artist.draw(read.light->mesh, read.light->frame, tone, control);
  if (!picture) { return report_failure({radiosity::Failure::Kind::cancelled, {}}, options.scene); }
  std::string text;
  if (options.solver.audit_points > 0) {
    const auto error = artist.audit(*picture, tone, radiosity::goal_to_know({}, options.solver.audit_points, artist.worth()), control);
    if (error) { text = picture_error_text(*error, camera.name); }
  }
  const std::vector<RenderOutput> outputs = encode(options, *picture, tone);
  if (code = write_all(outputs); code != ExitCode::ok) { return code; }
  for (const RenderOutput& output : outputs) { text += "written: " + output.path + "\n"; }
  return print(text, options.outputs) ? complain_of_picture(artist) : ExitCode::failure;
}

// Writes the outputs of a solution and the report.
ExitCode write_solution(Artist& artist, const radiosity::Solution& solution, const radiosity::Options& settings,
                        const std::string& of_limit, const radiosity::Control& control, Progress& progress) {
  const RenderOptions& options = artist.options();
  Report report;
  report.scene = options.scene;
  report.taken_in = artist.file().notes;
  report.options = settings;
  report.audit = solution.audit;
  report.audit.warnings.insert(report.audit.warnings.begin(), artist.file().warnings.begin(), artist.file().warnings.end());
  leave_out_others(report.audit.stages);
  const auto outputs = encode(artist, solution, control, report);
  progress.done();
  if (const ExitCode code = write_all(outputs); code != ExitCode::ok) { return code; }
  if (!print(to_text(report), all_outputs(options))) { return ExitCode::failure; }
  if (!solution.audit.shortage.empty()) {
    return complain(solution.audit.shortage + of_limit + "; the outputs show the best solution so far", ExitCode::not_converged);
  }
  if (report.audit.interrupted) {
    const bool of_mesh = report.picture && report.picture->method != options.method;
    return complain(std::string("interrupted: the outputs show the best solution so far") + (of_mesh ? ", pictures its mesh" : ""),
                    ExitCode::not_converged);
  }
  if (const ExitCode code = complain_of_picture(artist); code != ExitCode::ok) { return code; }
  // No accuracy was asked for, so an error that path tracing has found is not a failure: the report states it.
  using Status = radiosity::RunStatus;
  const Status status = solution.audit.status();
  if (status == Status::converged || status == Status::estimate_refuted || status == Status::far_off || status == Status::error_unknown) {
    return ExitCode::ok;
  }
  return complain("not converged: the outputs show what was reached", ExitCode::not_converged);
}

// If the error of the picture is the target of a run, has the rounds measure it; and if it decides what matters, has errors weighted by
// what the camera sees. `artist` and `control` must live as long as the run.
void judge_by_picture(const RenderOptions& options, const radiosity::Options& settings, Artist& artist, radiosity::Control& control) {
  if (settings.error && options.error_of.value_or(has_picture(options) ? ErrorOf::picture : ErrorOf::surfaces) == ErrorOf::picture) {
    control.picture_error = [&artist, &control](const radiosity::Mesh& mesh, const radiosity::Frame& frame,
                                                const radiosity::AuditGoal& goal) -> std::optional<radiosity::PictureError> {
      const radiosity::Tone tone = artist.tone(mesh);
      const auto picture = artist.draw(mesh, frame, tone, control);
      if (!picture) { return std::nullopt; }
      return artist.audit(*picture, tone, goal.wanted ? goal.and_picture(artist.worth()) : goal, control);
    };
  }
  const bool only_pictures = has_picture(options) && std::all_of(options.outputs.begin(), options.outputs.end(), is_picture);
  if (options.error_of.value_or(only_pictures ? ErrorOf::picture : ErrorOf::surfaces) == ErrorOf::picture) {
    control.viewpoint = artist.viewpoint();
  }
}

ExitCode run(const RenderOptions& options) {
  if (options.solver.error && options.solver.audit_points == 0) {
    return complain("--error needs the audit as its witness; leave --audit 0 out", ExitCode::usage);
  }
  if (const ExitCode code = check(options); code != ExitCode::ok) { return code; }
  Progress progress(options.quiet);
  radiosity::Control control;
  control.progress = [&](std::string_view stage, double part) { progress.report(stage, part); };
  if (!options.light.empty()) {
    control.cancel = &watch_interrupts();
    return draw_light(options, control);
  }
  ExitCode code = ExitCode::ok;
  auto text = load_text(options.scene, code);
  auto file = text ? load_scene(options.scene, *text, all_outputs(options), code, options.model) : std::nullopt;
  if (!file) { return code; }
  const auto is_light = [](const std::string& path) { return render_format(path) == RenderFormat::light; };
  if (std::any_of(options.outputs.begin(), options.outputs.end(), is_light)) { file->text = std::move(*text); }
  text.reset();
  if (options.onto_input && !file->given) {
    return complain("--onto-input: " + options.scene + " gives no polygons; only files of other programs (" + model_endings() + ") do",
                    ExitCode::usage);
  }
  const auto camera = choose_camera(*file, options.camera);
  if (!camera) { return ExitCode::usage; }
  control.cancel = &watch_interrupts();  // from here on there may be something to show; until here a signal ends the program

  radiosity::Options settings = solver_options(options);
  std::string of_limit;  // what else the memory is needed for; told if the limit ends the run
  if (options.memory) {
    const MemoryShares others = memory_shares(options, *camera);
    const std::string limit = "--memory allows " + radiosity::memory_text(*options.memory);
    if (others.held + others.picture >= *options.memory) {
      const bool gathered = options.method == PictureMethod::gather;
      return complain(
          limit + ", but " + others.text() + "; allow more" +
              (others.picture > 0 ? std::string(" or make the picture smaller") + (gathered ? " or of the mesh (--method mesh)" : "")
                                  : std::string()),
          ExitCode::failure);
    }
    settings.memory = *options.memory - others.held - others.picture;
    if (others.picture > 0) { of_limit = "; " + limit + ", of which " + others.text(); }
  }
  Artist artist(options, *file, *camera);
  judge_by_picture(options, settings, artist, control);
  const radiosity::Outcome outcome = radiosity::solve(file->scene, settings, control);
  progress.done();
  if (!outcome.solution) { return report_failure(outcome.failure, options.scene, of_limit); }

  return write_solution(artist, *outcome.solution, settings, of_limit, control, progress);
}

}  // namespace

Command render_command() {
  const auto options = std::make_shared<RenderOptions>();
  const std::string what = "SCENE, " + scene_description() + "; or --light";
  return {"render", "solve a scene; write a picture or a mesh and the report", render_arguments(*options),
          [options] { return run(*options); },
          [options, what] { return options->scene.empty() && options->light.empty() ? what : std::string(); }};
}

}  // namespace apps
