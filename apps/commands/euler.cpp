// SPDX-License-Identifier: MIT
// halflight euler SCRIPT -o OUT.svg|OUT.html: runs a script of Euler operators and draws each step.
// halflight euler --interactive: reads the statements from the terminal.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include <brep/euler_script.hpp>
#include <brep/euler_script_parse.hpp>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/euler/interactive.hpp"
#include "apps/euler/outputs.hpp"
#include "apps/euler/story.hpp"

namespace apps {
namespace {

struct EulerOptions {
  std::string script;
  std::vector<std::string> outputs;
  bool interactive = false;
};

constexpr std::size_t most_edges = 200000;  // in all pictures of a script; more would mean minutes of drawing and hundreds of megabytes

bool ends_with(const std::string& path, std::string_view end) { return path.size() > end.size() && path.ends_with(end); }

void report(const std::vector<brep::ScriptError>& errors, const std::string& path, const std::string& script) {
  for (const brep::ScriptError& e : errors) {
    const std::string sentence = e.sentence + euler::meant_in(script, e.place.line);
    std::fprintf(stderr, "%s:%u:%u: error: %s\n", path.c_str(), e.place.line, e.place.column, sentence.c_str());
  }
}

std::string summary(const euler::Story& story) {
  const euler::Frame& end = story.frames.back();
  return story.title + "\nsteps: " + std::to_string(story.frames.size() - 1) + "\n" + euler::counts(end) + "\n" + euler::equation(end) +
         "\n";
}

ExitCode run(const EulerOptions& options) {
  ExitCode code = check_outputs(options.outputs, options.interactive ? std::vector<std::string>{} : std::vector{options.script});
  if (code != ExitCode::ok) { return code; }
  if (options.interactive) { return euler::converse(options.outputs); }
  auto text = load_text(options.script, code);
  if (!text) { return code; }
  const euler::Coordinates coordinates = euler::take_coordinates(*text);
  const brep::ScriptResult parsed = brep::parse_script(*text);
  if (!parsed.script) {
    const auto sentence = wrong_kind(shown(options.script), *text, FileKind::script);
    sentence ? complain(*sentence) : report(parsed.errors, options.script, *text);
    return ExitCode::invalid_input;
  }
  const std::string name = std::filesystem::path(options.script).stem().string();
  euler::Story story = euler::tell(*parsed.script, name, false);
  report(story.errors, options.script, *text);
  if (!options.outputs.empty()) {
    if (story.edges > most_edges) {
      return complain(options.script + " is too long to draw: its " + std::to_string(story.frames.size()) + " pictures would show " +
                          std::to_string(story.edges) + " edges together, at most " + std::to_string(most_edges) + " are drawn",
                      ExitCode::failure);
    }
    story = euler::tell(*parsed.script, name);
    story.coordinates = coordinates;
  }
  for (const std::string& output : options.outputs) {
    if (!save(output, ends_with(output, ".svg") ? euler::strip(story) : euler::page(story))) { return ExitCode::failure; }
  }
  std::string out = summary(story);
  for (const std::string& output : options.outputs) { out += "written: " + output + "\n"; }
  if (!print(out, options.outputs)) { return ExitCode::failure; }
  return story.errors.empty() ? ExitCode::ok : ExitCode::invalid_input;
}

}  // namespace

Command euler_command() {
  const auto options = std::make_shared<EulerOptions>();
  Argument output =
      texts("-o,--output", "OUT", options->outputs,
            "OUT.html: a page to step through; OUT.svg: all steps for print (with --interactive: the last step). May be repeated");
  output.take = [keep = output.take](const std::string& path) {
    const bool known = ends_with(path, ".svg") || ends_with(path, ".html");
    return known ? keep(path) : "expected a name that ends in .svg or .html, found '" + path + "'";
  };
  return {"euler",
          "play a script of Euler operators; draw each step",
          {text("script", "SCRIPT", options->script, "the script; see examples/euler"), output,
           flag("--interactive", options->interactive, "read operators from the terminal; `help` lists them").without({"script"})},
          [options] { return run(*options); },
          [options] { return std::string(options->script.empty() && !options->interactive ? "SCRIPT or --interactive" : ""); }};
}

}  // namespace apps
