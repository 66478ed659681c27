// SPDX-License-Identifier: MIT
#pragma once

// A command of the program as data: every argument is a row with its name, its meaning and the place for its value. command_line.cpp
// reads the command line by these rows; it is the only file that uses CLI11. A new command is one file with a function that returns a
// Command, declared below, and one line in halflight.cpp.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/intake/to_scene.hpp"
#include "apps/process.hpp"
#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps {

struct Argument {
  // How many values follow the name: one; one, and the name may be repeated; one or more; none or one.
  enum class Values { one, repeated, many, optional };

  std::string names;  // "scene", a positional argument, or "-o,--output"
  std::string value;  // placeholder for the value in the help: "FILE"; empty for a flag
  std::string description;
  // Stores a value and returns an empty text, or returns what was expected and found; a flag ignores the text.
  std::function<std::string(const std::string&)> take;
  Values values = Values::one;
  std::string preset = {};  // the default, for the help
  bool required = false;
  std::vector<std::string> excludes = {}, needs = {};  // names of other arguments

  [[nodiscard]] Argument must() const {
    return with([](Argument& a) { a.required = true; });
  }
  [[nodiscard]] Argument without(const std::vector<std::string>& others) const {
    return with([&](Argument& a) { a.excludes = others; });
  }
  [[nodiscard]] Argument needing(const std::string& other) const {
    return with([&](Argument& a) { a.needs = {other}; });
  }
  [[nodiscard]] Argument by_default(const std::string& text) const {
    return with([&](Argument& a) { a.preset = text; });
  }

 private:
  template <class Change>
  [[nodiscard]] Argument with(const Change& change) const {
    Argument result = *this;
    change(result);
    return result;
  }
};

struct Command {
  std::string name, summary;
  std::vector<Argument> arguments;  // their values go into options that `run` captures
  std::function<ExitCode()> run;
  std::function<std::string()> missing = {};  // names what is missing if no single argument is required but one of several
  std::string usage = {};                     // examples, printed below the arguments in the help
};

[[nodiscard]] Command render_command();
[[nodiscard]] Command info_command();
[[nodiscard]] Command mesh_command();
[[nodiscard]] Command check_command();
[[nodiscard]] Command factors_command();
[[nodiscard]] Command stress_command();
[[nodiscard]] Command euler_command();
[[nodiscard]] Command study_command();
[[nodiscard]] Command explain_command();
[[nodiscard]] Command exercise_command();
[[nodiscard]] Command figures_command();

// --- kinds of arguments; `target` must outlive the parsing of the command line

[[nodiscard]] inline Argument flag(std::string names, bool& target, std::string description, bool value = true) {
  const auto take = [&target, value](const std::string&) {
    target = value;
    return std::string();
  };
  return {std::move(names), "", std::move(description), take};
}

template <class Target>
[[nodiscard]] Argument text(std::string names, std::string value, Target& target, std::string description) {
  const auto take = [&target](const std::string& given) {
    target = given;
    return std::string();
  };
  return {std::move(names), std::move(value), std::move(description), take};
}

[[nodiscard]] inline Argument texts(std::string names, std::string value, std::vector<std::string>& target, std::string description,
                                    Argument::Values values = Argument::Values::many) {
  const auto take = [&target](const std::string& given) {
    target.push_back(given);
    return std::string();
  };
  return {std::move(names), std::move(value), std::move(description), take, values};
}

[[nodiscard]] inline std::string scene_description() { return "the scene: a .scene file, or " + model_endings(); }
[[nodiscard]] inline Argument scene_argument(std::string& target) { return text("scene", "SCENE", target, scene_description()).must(); }

// A number in (0, most]; NaN is refused too.
template <class Target>
[[nodiscard]] Argument above_zero(std::string names, Target& target, double most, std::string description) {
  const auto take = [&target, most](const std::string& text) {
    const auto value = number_in<double>(text);
    const bool good = value && *value > 0.0 && *value <= most;
    if (good) { target = *value; }
    return good ? std::string() : "expected a number above 0 and at most " + formatted("%g", most) + ", found '" + text + "'";
  };
  return {std::move(names), "NUMBER", std::move(description), take};
}

// Digits only: a sign is refused, so that -1 does not become the largest number.
template <class Target>
[[nodiscard]] Argument whole_number(std::string names, Target& target, std::uint64_t least, std::uint64_t most, std::string description) {
  const auto take = [&target, least, most](const std::string& text) {
    const auto value = number_in<std::uint64_t>(text);
    const bool good = value && *value >= least && *value <= most;
    if (good) { target = static_cast<Target>(*value); }
    return good ? std::string()
                : "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most) + ", found '" + text + "'";
  };
  return {std::move(names), "NUMBER", std::move(description), take};
}

// One of the names; stores the value belonging to it.
template <class Target, class Value>
[[nodiscard]] Argument one_of(std::string names, Target& target, std::vector<std::pair<std::string_view, Value>> known,
                              std::string description) {
  const auto take = [&target, known = std::move(known)](const std::string& text) {
    std::vector<std::string_view> words;
    for (const auto& [name, value] : known) {
      if (name == text) {
        target = value;
        return std::string();
      }
      words.push_back(name);
    }
    return "expected " + list_of(words) + ", found '" + text + "'" + suggestion(text, words);
  };
  return {std::move(names), "NAME", std::move(description), take};
}

// Stores the result of `parse`; if there is none, the error message says what was `expected`.
template <class Target, class Value>
[[nodiscard]] Argument parsed(std::string names, std::string value, Target& target, std::optional<Value> (*parse)(std::string_view),
                              std::string expected, std::string description) {
  const auto take = [&target, parse, expected = std::move(expected)](const std::string& text) {
    const auto found = parse(text);
    if (found) { target = *found; }
    return found ? std::string() : "expected " + expected + ", found '" + text + "'";
  };
  return {std::move(names), std::move(value), std::move(description), take};
}

inline constexpr std::uint64_t most_threads = 1024;

// --- options about files of other programs, for every command that takes a scene; they have no effect on a .scene file

[[nodiscard]] inline Argument lamp_argument(std::vector<Lamp>& lamps) {
  const auto take = [&lamps](const std::string& text) {
    const auto lamp = parse_lamp(text);
    if (lamp) { lamps.push_back(*lamp); }
    return lamp ? std::string() : "expected MATERIAL or MATERIAL=W/m2, the name of a material and a number from 0 on, found '" + text + "'";
  };
  return {"--lamp", "MATERIAL[=W/m2]",
          "of a file of another program: a material that shines, with its exitance (default: 100 W/m2); repeat for more", take,
          Argument::Values::repeated};
}

// The arguments of a command, followed by these.
[[nodiscard]] inline std::vector<Argument> with_model_arguments(std::vector<Argument> arguments, ModelOptions& options) {
  arguments.push_back(lamp_argument(options.lamps));
  arguments.push_back(flag("--two-sided", options.two_sided, "of such a file: surfaces that enclose nothing reflect on both sides"));
  arguments.push_back(flag("--opaque", options.opaque, "of such a file: surfaces that let most light through are opaque, not left out"));
  arguments.push_back(
      above_zero("--reflectance", options.reflectance, most_reflectance,
                 "of such a file: reflectance of materials that have none (default: " + formatted("%g", options.reflectance) + ")"));
  arguments.push_back(parsed("--units", "UNIT", options.metres, parse_unit, "mm, cm, m, km, in, ft or a number above 0 (metres)",
                             "of such a file: length of one unit, mm, cm, m, km, in, ft or a number of metres (default: m)"));
  arguments.push_back(one_of<std::optional<UpAxis>, UpAxis>(
      "--up", options.up, {{"x", UpAxis::x}, {"y", UpAxis::y}, {"z", UpAxis::z}},
      "of such a file: axis that points up, x, y or z (default: z for .ply, .off, .stl and .mgf, else y)"));
  arguments.push_back(flag("--as-given", options.merge, "of such a file: coplanar polygons are not merged into faces", false));
  return arguments;
}

// Answers `--help` and `--version`; reports an error in the command line in one sentence.
[[nodiscard]] ExitCode run_program(const std::vector<Command>& commands, int argc, char** argv);

}  // namespace apps
