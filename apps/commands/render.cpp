// SPDX-License-Identifier: MIT
// halflight render SCENE [-o OUT.png] [-o OUT.ply] ...: solves a scene, writes pictures and meshes, prints the report.
//
// What can be known to fail is refused before the solver starts: extensions, folders, the camera's name. Outputs are
// encoded in memory and then replace their files one by one, each whole (files.hpp).
#include <algorithm>
#include <charconv>
#include <limits>
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
#include "apps/commands/model_arguments.hpp"
#include "apps/commands/render_outputs.hpp"
#include "apps/intake/model.hpp"
#include "apps/interrupt.hpp"
#include "apps/light_file.hpp"
#include "apps/memory.hpp"
#include "apps/progress.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

// WxH, each side from 1 to max_picture_side.
std::optional<PictureSize> parse_size(std::string_view text) {
  PictureSize size;
  const char* const end = text.data() + text.size();
  const auto [cross, width_code] = std::from_chars(text.data(), end, size.width);
  if (width_code != std::errc() || cross == end || *cross != 'x') { return std::nullopt; }
  const auto [rest, height_code] = std::from_chars(cross + 1, end, size.height);
  if (height_code != std::errc() || rest != end) { return std::nullopt; }
  const auto fits = [](std::uint32_t side) { return side >= 1 && side <= max_picture_side; };
  return fits(size.width) && fits(size.height) ? std::optional(size) : std::nullopt;
}

std::string size_fault(const std::string& text) {
  return "expected WIDTHxHEIGHT, each 1 to " + std::to_string(max_picture_side) + ", found '" + text + "'";
}

std::string exposure_fault(const std::string& text) {
  return "expected a number above 0, or stops such as 1ev or -0.5ev, found '" + text + "'";
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
  paths.push_back(options.lightmap);
  paths.push_back(options.json);
  return paths;
}

// Outputs that cannot become files are refused before any work.
ExitCode check(const RenderOptions& options) {
  for (const std::string& path : options.outputs) {
    if (!render_format(path)) {
      complain("--output " + path + ": expected a name that ends with " + render_endings());
      return ExitCode::usage;
    }
  }
  const auto any = [&](bool ply) {
    return std::any_of(options.outputs.begin(), options.outputs.end(), [ply](const std::string& path) {
      const auto format = render_format(path);
      return format == RenderFormat::exported || (ply && format == RenderFormat::ply);
    });
  };
  if (options.onto_input && !any(true)) {
    complain("--onto-input is about outputs that end with .ply, .glb or .obj; there is none");
    return ExitCode::usage;
  }
  if (!options.lightmap.empty() && !any(false)) {
    complain("--lightmap is about outputs that end with .glb or .obj; there is none");
    return ExitCode::usage;
  }
  if (!options.lightmap.empty() && !is_picture(options.lightmap)) {
    complain("--lightmap " + options.lightmap + ": expected a name that ends with .hdr, .pfm or .png");
    return ExitCode::usage;
  }
  if (!options.light.empty() && (options.outputs.empty() || !std::all_of(options.outputs.begin(), options.outputs.end(), is_picture))) {
    complain("--light draws pictures: expected outputs that end with .png, .hdr or .pfm, and nothing else");
    return ExitCode::usage;
  }
  return check_outputs(all_outputs(options), {options.scene, options.light});
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

// What --memory leaves for the run: less what the program and the scene hold now. The picture is drawn when the run holds its solution
// alone, a third of its peak at most.
std::optional<std::uint64_t> memory_left(const RenderOptions& options, const Camera& camera) {
  const std::uint64_t held = resident_memory().value_or(0);
  const PictureSize size = options.size.value_or(camera.size.value_or(PictureSize{}));
  constexpr std::uint64_t band = 20'000'000, pixel = 60;  // of samples; of colours and their coded form
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

ExitCode write_all(const std::vector<RenderOutput>& outputs) {
  for (const RenderOutput& output : outputs) {
    if (!save(output.path, output.bytes)) { return ExitCode::failure; }
  }
  return ExitCode::ok;
}

// Pictures from a solution that was kept.
ExitCode draw_light(const RenderOptions& options, const SceneFile& file, const Camera& camera, const radiosity::Control& control) {
  ExitCode code = ExitCode::ok;
  const auto bytes = load_text(options.light, code);
  if (!bytes) { return code; }
  const LightResult read = read_light_file(*bytes, file.scene);
  if (!read.light) {
    complain(shown(options.light) + ": " + read.reason);
    return ExitCode::invalid_input;
  }
  Artist artist(options, file, camera);
  const Tone tone = artist.tone(read.light->mesh);
  const auto picture = artist.draw(read.light->mesh, read.light->frame, tone, control);
  if (!picture) { return report_failure({radiosity::Failure::Kind::cancelled, {}}, options.scene); }
  std::string text;
  if (options.solver.audit_points > 0) {
    const auto error = artist.audit(*picture, tone, radiosity::goal_to_know({}, options.solver.audit_points), control);
    if (error) { text = picture_error_text(*error, camera.name); }
  }
  const std::vector<RenderOutput> outputs = encode(options, *picture, tone);
  if (code = write_all(outputs); code != ExitCode::ok) { return code; }
  for (const RenderOutput& output : outputs) { text += "written: " + output.path + "\n"; }
  return print(text, options.outputs) ? ExitCode::ok : ExitCode::failure;
}

ExitCode run(const RenderOptions& options) {
  const std::atomic<bool>& cancel = watch_interrupts();
  if (options.solver.error && options.solver.audit_points == 0) {
    complain("--error needs the audit as its witness; leave --audit 0 out");
    return ExitCode::usage;
  }
  if (const ExitCode code = check(options); code != ExitCode::ok) { return code; }
  ExitCode code = ExitCode::ok;
  const auto file = load_scene(options.scene, code, options.model);
  if (!file) { return code; }
  if (options.onto_input && !file->given) {
    complain("--onto-input: " + options.scene + " gives no polygons; only files of other programs (" + model_endings() + ") do");
    return ExitCode::usage;
  }
  const auto camera = choose_camera(*file, options.camera);
  if (!camera) { return ExitCode::usage; }

  radiosity::Options settings = solver_options(options);
  if (options.memory) {
    settings.memory = memory_left(options, *camera);
    if (!settings.memory) { return ExitCode::failure; }
  }
  Progress progress(options.quiet);
  radiosity::Control control;
  control.cancel = &cancel;
  control.progress = [&](std::string_view stage, double part) { progress.report(stage, part); };
  if (!options.light.empty()) { return draw_light(options, *file, *camera, control); }
  Artist artist(options, *file, *camera);
  if (settings.error && options.error_of.value_or(has_picture(options) ? ErrorOf::picture : ErrorOf::surfaces) == ErrorOf::picture) {
    control.picture_error = [&](const radiosity::Mesh& mesh, const radiosity::Frame& frame,
                                const radiosity::AuditGoal& goal) -> std::optional<radiosity::PictureError> {
      const Tone tone = artist.tone(mesh);
      const auto picture = artist.draw(mesh, frame, tone, control);
      if (!picture) { return std::nullopt; }
      return artist.audit(*picture, tone, goal, control);
    };
  }
  const radiosity::Outcome outcome = radiosity::solve(file->scene, settings, control);
  if (outcome.solution && outcome.solution->audit.interrupted) { control = control.unstoppable(); }  // the best so far is drawn and written
  progress.done();
  if (!outcome.solution) { return report_failure(outcome.failure, options.scene); }

  const radiosity::Solution& solution = *outcome.solution;
  Report report;
  report.scene = options.scene;
  report.taken_in = file->notes;
  report.options = settings;
  report.audit = solution.audit;
  leave_out_others(report.audit.stages);
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

// What each option is, and where its value goes.
std::vector<Argument> arguments(RenderOptions& options) {
  radiosity::Options& solver = options.solver;
  // BF-refinement is asked for by what ends it.
  const auto bf = [&solver](Argument argument) {
    argument.take = [&solver, keep = argument.take](const std::string& text) {
      solver.refinement = radiosity::Refinement::a_posteriori;
      return keep(text);
    };
    return argument;
  };
  const std::vector<std::string> ends{"--error", "--target", "--time"};  // of the refinement: one at most
  using radiosity::Indirect, radiosity::Reconstruction, radiosity::Solver;
  return {
      scene_argument(options.scene),
      texts("-o,--output", "FILE", options.outputs,
            "what to write: a picture (.png; .hdr, .pfm: radiance), the light for further pictures (.light), a mesh with its light (.ply, "
            ".glb, .obj) or a page that shows it (.html); repeat for more; without, the report alone",
            Argument::Values::repeated),
      flag("--onto-input", options.onto_input,
           "with .ply, .glb and .obj: the polygons and vertices of the input file in its own order, each vertex with its light"),
      text("--lightmap", "FILE", options.lightmap,
           "with .glb and .obj: the light as a texture of them, too (.hdr, .pfm: radiance; .png), a rectangle for every face"),
      above_zero("--texel", options.texel, 1e30, "side of a texel of the lightmap in metres (default: such that there are a million)")
          .needing("--lightmap"),
      text("--light", "FILE", options.light,
           "a .light file of this scene: pictures are drawn from it, and nothing is solved; with the options of pictures alone")
          .without({"--json", "--onto-input", "--lightmap", "--error", "--target", "--time", "--epsilon", "--min-area", "--light-epsilon",
                    "--discontinuities", "--indirect", "--solver", "--reconstruction", "--no-shortcuts"}),
      above_zero("--error", solver.error, 1.0, "refine until the measured relative L2 error is at most this"),
      one_of<std::optional<ErrorOf>, ErrorOf>(
          "--error-of", options.error_of, {{"picture", ErrorOf::picture}, {"surfaces", ErrorOf::surfaces}},
          "what --error is about: picture, what the camera sees (the default with a .png), or surfaces, all of them by area")
          .needing("--error"),
      bf(above_zero(
             "--target", solver.target, 1.0,
             "BF-refinement (paper 4.4), split by the light that links carry, until the estimated relative L2 error is at most this"))
          .without({"--error"}),
      bf(above_zero("--time", solver.time, 1e6,
                    "BF-refinement, what promises most first, for this many seconds; the audit and the picture come on top"))
          .without({"--error", "--target"}),
      above_zero("--epsilon", options.epsilon, 1.0,
                 "largest form factor of a link (default " + formatted("%g", solver.epsilon) + "; of a picture by gather alone " +
                     formatted("%g", gathered_epsilon) + ")")
          .without(ends),
      above_zero("--min-area", options.min_area, 1.0,
                 "smallest patch, relative to the area of the scene (default " + formatted("%g", solver.min_area) +
                     "; of a picture by gather alone " + formatted("%g", gathered_min_area) + ")")
          .without(ends),
      above_zero("--light-epsilon", solver.light_epsilon, 1.0,
                 "share of the error that the light of a lamp may cause by varying over one patch (default: a quarter of epsilon)")
          .without(ends),
      whole_number("--discontinuities", solver.discontinuities, 0, 1'000'000,
                   "cuts faces along the edges of shadows, at most so many on each, and across their direct light: half the error at equal "
                   "leaves where lamps cause most of it (default: 0, regular refinement)"),
      text("--camera", "TEXT", options.camera, "camera of the scene (default: the first; without any, an automatic view)"),
      parsed("--size", "WxH", options.size, parse_size, size_fault, "picture size in pixels (default: the camera's, else 800x600)"),
      one_of<PictureMethod, PictureMethod>(
          "--method", options.method, {{"mesh", PictureMethod::mesh}, {"gather", PictureMethod::gather}},
          "gather: the objects, in direct light found for each pixel and indirect light gathered from the solution (default); mesh: the "
          "triangles of the solution"),
      parsed("--exposure", "NUMBER", options.exposure, Exposure::parse, exposure_fault,
             "factor from radiance to picture, or stops from the automatic one, such as 1ev or -0.5ev (default: automatic)"),
      one_of<ToneCurve, ToneCurve>("--tone", options.tone, {{"linear", ToneCurve::linear}, {"filmic", ToneCurve::filmic}},
                                   "linear: brightness proportional to light; filmic: bright tones are compressed as on film"),
      whole_number("--threads", solver.threads, 1, most_threads, "threads (default: all); results do not depend on it"),
      whole_number("--seed", solver.seed, 0, std::numeric_limits<std::uint64_t>::max(), "seed of all random choices"),
      whole_number("--audit", solver.audit_points, 0, 100'000'000, "points at which the error is measured; 0: none"),
      one_of<Indirect, Indirect>("--indirect", solver.indirect,
                                 {{"auto", Indirect::automatic}, {"links", Indirect::links}, {"rays", Indirect::rays}},
                                 "auto, links or rays: how light between surfaces that do not shine travels"),
      one_of<Solver, Solver>("--solver", solver.solver,
                             {{"cg", Solver::conjugate_gradients},
                              {"gauss-seidel", Solver::gauss_seidel},
                              {"jacobi", Solver::jacobi},
                              {"southwell", Solver::southwell}},
                             "cg, jacobi, gauss-seidel or southwell"),
      one_of<Reconstruction, Reconstruction>(
          "--reconstruction", solver.reconstruction,
          {{"constant", Reconstruction::constant}, {"simple", Reconstruction::simple}, {"weighted", Reconstruction::weighted}},
          "weighted or simple (paper fig. 5), or constant: one colour a leaf"),
      flag("--no-shortcuts", solver.shortcuts, "do all that the report would tell as left out; the result is the same, to the bit", false),
      parsed("--memory", "BYTES", options.memory, parse_memory, memory_fault,
             "most memory that the program may hold, such as 500M or 2G; a run that would need more ends before"),
      text("--json", "FILE", options.json, "write the report as JSON, too"),
      flag("--quiet", options.quiet, "no narration and no progress bar"),
  };
}

}  // namespace

Command render_command() {
  const auto options = std::make_shared<RenderOptions>();
  return {"render", "solve a scene; write a picture or a mesh and the report", with_model_arguments(arguments(*options), options->model),
          [options] { return run(*options); }};
}

}  // namespace apps
