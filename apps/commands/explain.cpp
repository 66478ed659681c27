// SPDX-License-Identifier: MIT
// halflight explain SCENE -o page.html: replays how a scene is solved; --text prints it as text.
#include <filesystem>
#include <memory>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/explain/recording.hpp"

namespace apps {
namespace {

struct ExplainOptions {
  std::string scene, output;
  bool text = false;
  explain::Wanted wanted;
};

ExitCode run(const ExplainOptions& options) {
  ExitCode code = check_outputs({options.output}, {options.scene});
  if (code != ExitCode::ok) { return code; }
  const auto file = load_scene(options.scene, {options.output}, code);
  if (!file) { return code; }
  const std::string name = std::filesystem::path(options.scene).stem().string();
  const explain::RecordResult result = explain::record(file->scene, name, options.wanted);
  if (!result.recording && !result.invalid) { return complain(options.scene + ": " + result.sentences.front(), ExitCode::failure); }
  if (!result.recording) {
    complain_of(options.scene, result.sentences);
    return ExitCode::invalid_input;
  }
  if (!options.output.empty() && !save(options.output, explain::page(*result.recording))) { return ExitCode::failure; }
  std::string out = options.text ? explain::story(*result.recording) : "";
  if (!options.output.empty()) { out += "written: " + options.output + "\n"; }
  return print(out, {options.output}) ? ExitCode::ok : ExitCode::failure;
}

}  // namespace

Command explain_command() {
  const auto options = std::make_shared<ExplainOptions>();
  return {"explain",
          "replay how a small scene is solved: links, rays, light, T-vertices, solvers",
          {scene_argument(options->scene), text("-o,--output", "OUT", options->output, "OUT.html: a page to look at in any browser"),
           flag("--text", options->text, "tell the same in the terminal"),
           above_zero("--epsilon", options->wanted.epsilon, 1.0, "largest form factor of a link").by_default("0.05"),
           above_zero("--min-area", options->wanted.min_area, 1.0, "smallest patch, relative to the area that light falls on")
               .by_default("0.002"),
           above_zero("--light-epsilon", options->wanted.light_epsilon, 1e30, "most that a lamp's light may vary; default: epsilon"),
           above_zero("--target", options->wanted.target, 1.0, "estimated error at which BF-refinement ends").by_default("0.1")},
          [options] { return run(*options); },
          [options] { return std::string(options->output.empty() && !options->text ? "--output OUT.html or --text" : ""); }};
}

}  // namespace apps
