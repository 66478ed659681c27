// SPDX-License-Identifier: MIT
#include "apps/commands/render_outputs.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <radiosity/scene/options.hpp>

#include "apps/commands/command.hpp"
#include "apps/memory.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

// WxH, each side from 1 to max_picture_side.
std::optional<radiosity::PictureSize> parse_size(std::string_view text) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto width = number_in<std::uint32_t>(text.substr(0, cross));
  const auto height = number_in<std::uint32_t>(text.substr(std::min(cross + 1, text.size())));
  const auto fits = [](const auto& side) { return side && *side >= 1 && *side <= max_picture_side; };
  return fits(width) && fits(height) ? std::optional(radiosity::PictureSize{*width, *height}) : std::nullopt;
}

// Options about the outputs.
std::vector<Argument> output_arguments(RenderOptions& options) {
  return {
      text("scene", "SCENE", options.scene, scene_description()),
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
           "a .light file, of this scene or, without one, with the scene that it holds: pictures are drawn from it, and nothing is solved; "
           "with "
           "the options of pictures alone")
          .without({"--json", "--onto-input", "--lightmap", "--error", "--target", "--time", "--epsilon", "--min-area", "--light-epsilon",
                    "--discontinuities", "--mesh-error", "--indirect", "--solver", "--reconstruction", "--no-shortcuts"}),
  };
}

// Options about the refinement of the solution.
std::vector<Argument> refinement_arguments(RenderOptions& options) {
  radiosity::Options& solver = options.solver;
  // An argument that limits BF-refinement also selects it.
  const auto bf = [&solver](Argument argument) {
    argument.take = [&solver, keep = argument.take](const std::string& text) {
      solver.refinement = radiosity::Refinement::a_posteriori;
      return keep(text);
    };
    return argument;
  };
  const std::vector<std::string> ends{"--error", "--target", "--time"};  // the refinement ends by at most one of these
  return {
      above_zero(
          "--error", solver.error, 1.0,
          "refine until the measured relative L2 error is at most this; out of reach, that is at 10 million links, the work "
          "of 40 million rays (one to three minutes of CPU time; audits take as much again, or twice and 40 million rays more to show "
          "that it is met), 2 GB "
          "without --memory, the finest thresholds or after half of that work and three rounds without gain, it ends with the best "
          "solution and exit "
          "code 4"),
      one_of<std::optional<ErrorOf>, ErrorOf>(
          "--error-of", options.error_of, {{"picture", ErrorOf::picture}, {"surfaces", ErrorOf::surfaces}},
          "what --error and --mesh-error are about: picture, what the camera sees (the default of --error with a picture, of --mesh-error "
          "with nothing but pictures), or surfaces, all of them by area"),
      bf(above_zero("--target", solver.target, 1.0,
                    "BF-refinement (paper 4.4), split by the light that links carry, until the relative L2 error is at most this, as the "
                    "audit finds it or, where that cannot tell, as the links let "
                    "expect; in 2 GB without --memory"))
          .without({"--error"}),
      bf(above_zero("--time", solver.time, 1e6,
                    "BF-refinement, what promises most first, for this many seconds; the audit and the picture come on top"))
          .without({"--error", "--target"}),
      above_zero("--epsilon", options.epsilon, 1.0,
                 "largest form factor of a link (default " + formatted("%g", solver.epsilon) + "; of a picture by gather alone " +
                     formatted("%g", gathered_epsilon) + ")")
          .without(ends),
      above_zero("--min-area", options.min_area, 1.0,
                 "smallest patch, relative to the area that light falls on, or of about what lamps light of a large one (default " +
                     formatted("%g", solver.min_area) + "; of a picture by gather alone " + formatted("%g", gathered_min_area) + ")")
          .without(ends),
      above_zero("--light-epsilon", solver.light_epsilon, 1.0,
                 "share of the error that the light of a lamp may cause by varying over one patch (default: a quarter of epsilon)")
          .without(ends),
      whole_number("--discontinuities", solver.discontinuities, 0, 1'000'000,
                   "cuts faces along the edges of shadows, at most so many on each, and across their direct light: half the error at equal "
                   "leaves where lamps cause most of it (default: 0, regular refinement)"),
  };
}

Argument camera_argument(RenderOptions& options) {
  const auto take = [&options](const std::string& text) -> std::string {
    if (!begins_camera(text)) {
      options.camera = text;
      return {};
    }
    std::string fault;
    options.model.camera = parse_camera(text, fault);
    return fault;
  };
  return {"--camera", "NAME",
          "camera of the scene (default: the first; without any, an automatic view), or one of your own as in a .scene file, in metres, z "
          "upwards: \"eye 1 2 1.6 target 3 3 1 fov 60\"",
          take};
}

// Options about the drawing of pictures.
std::vector<Argument> picture_arguments(RenderOptions& options) {
  return {
      camera_argument(options),
      parsed("--size", "WxH", options.size, parse_size, "WIDTHxHEIGHT, each 1 to " + std::to_string(max_picture_side),
             "picture size in pixels (default: the camera's, else 800x600)"),
      one_of<PictureMethod, PictureMethod>(
          "--method", options.method, {{"mesh", PictureMethod::mesh}, {"gather", PictureMethod::gather}},
          "gather: the objects, in direct light found for each pixel and indirect light gathered from the solution (default); mesh: the "
          "triangles of the solution"),
      parsed("--exposure", "NUMBER", options.exposure, Exposure::parse, "a number above 0, or stops such as 1ev or -0.5ev",
             "factor from radiance to picture, or stops from the automatic one, such as 1ev or -0.5ev (default: automatic)"),
      one_of<radiosity::ToneCurve, radiosity::ToneCurve>(
          "--tone", options.tone, {{"linear", radiosity::ToneCurve::linear}, {"filmic", radiosity::ToneCurve::filmic}},
          "linear: brightness proportional to light; filmic: bright tones are compressed as on film"),
  };
}

// Options about the solver and its messages.
std::vector<Argument> solver_arguments(RenderOptions& options) {
  radiosity::Options& solver = options.solver;
  using radiosity::Indirect, radiosity::Reconstruction, radiosity::Solver;
  return {
      whole_number("--threads", solver.threads, 1, most_threads, "threads (default: all); results do not depend on it"),
      whole_number("--seed", solver.seed, 0, std::numeric_limits<std::uint64_t>::max(), "seed of all random choices"),
      whole_number(
          "--audit", solver.audit_points, 0, 100'000'000,
          "points at which the error is measured, the surfaces and the picture each, in about as many rays as the solution took, or "
          "1500 a point, fewer where rays are dear; 0: none"),
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
      above_zero(
          "--mesh-error", solver.mesh_error, 1.0,
          "with meshes and pages, and pictures by --method mesh: colours are gathered as for pictures, and faces split until the mesh is "
          "off by at most this relative L2 error; --onto-input and lightmaps stay as they are")
          .without({"--error"}),
      flag("--no-shortcuts", solver.shortcuts, "do all that the report would tell as left out; the result is the same, to the bit", false),
      parsed("--memory", "BYTES", options.memory, parse_memory, memory_form,
             "most memory that the program may hold, such as 500M or 2G; a run that would need more ends before (meshes, pages and "
             "lightmaps are made after it, and not counted)"),
      text("--json", "FILE", options.json, "write the report as JSON, too"),
      flag("--quiet", options.quiet, "no narration and no progress bar"),
  };
}

}  // namespace

std::vector<Argument> render_arguments(RenderOptions& options) {
  std::vector<Argument> all;
  for (const auto part : {output_arguments, refinement_arguments, picture_arguments, solver_arguments}) {
    for (Argument& argument : part(options)) { all.push_back(std::move(argument)); }
  }
  return with_model_arguments(std::move(all), options.model);
}

}  // namespace apps
