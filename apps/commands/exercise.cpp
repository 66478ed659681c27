// SPDX-License-Identifier: MIT
// halflight exercise N FILE: says in a sentence what is still wrong with a student's solution.
#include <filesystem>
#include <memory>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/exercise/exercises.hpp"

namespace apps {
namespace {

struct ExerciseOptions {
  std::size_t number = 0;
  std::string file, output;
};

std::string list() {
  std::string out;
  for (std::size_t n = 1; n <= exercise::all().size(); ++n) {
    const exercise::Exercise& e = exercise::all()[n - 1];
    out += (n < 10 ? " " : "") + std::to_string(n) + "  " + e.title + "   (" + e.file + ")\n";
  }
  return out +
         "`halflight exercise N -o FILE` writes the text of an exercise and its beginning, `halflight exercise N FILE` checks yours.\n";
}

ExitCode run(const ExerciseOptions& options) {
  if (options.number == 0) { return print(list()) ? ExitCode::ok : ExitCode::failure; }
  const exercise::Exercise& chosen = exercise::all()[options.number - 1];
  const std::string name = "exercise " + std::to_string(options.number);
  if (options.file.empty()) {
    if (options.output.empty()) { return print(exercise::beginning(chosen)) ? ExitCode::ok : ExitCode::failure; }
    ExitCode code = check_outputs({options.output}, {});
    if (code == ExitCode::ok && std::filesystem::is_regular_file(options.output)) {
      return complain(options.output + " is there already, and may hold your solution; name another file, or remove it", ExitCode::failure);
    }
    if (code == ExitCode::ok && !save(options.output, exercise::beginning(chosen))) { code = ExitCode::failure; }
    return code;
  }
  if (chosen.fault == nullptr) {
    return complain(name + " is a program: `sh examples/exercises/check.sh " + std::to_string(options.number) + " " + options.file +
                        "` compiles it and tests it",
                    ExitCode::usage);
  }
  ExitCode code = ExitCode::ok;
  const auto text = load_text(options.file, code);
  if (!text) { return code; }
  const auto fault = chosen.fault(*text);
  const bool told = print(fault ? "not yet: " + *fault + "\n" : name + ": solved\n");
  return !told ? ExitCode::failure : fault ? ExitCode::invalid_input : ExitCode::ok;
}

}  // namespace

Command exercise_command() {
  const auto options = std::make_shared<ExerciseOptions>();
  return {"exercise",
          "list the exercises; give one out; check a solution",
          {whole_number("number", options->number, 1, exercise::all().size(), "which one; none: the list"),
           text("file", "FILE", options->file, "your solution; none: the text of the exercise is printed"),
           text("-o,--output", "FILE", options->output, "writes the text and the beginning there").without({"file"})},
          [options] { return run(*options); }};
}

}  // namespace apps
