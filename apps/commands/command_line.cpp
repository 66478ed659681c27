// SPDX-License-Identifier: MIT
// The only file that uses CLI11. An error in the command line is reported in one sentence: an unknown word with the nearest known one, an
// option without its value.
#include "apps/commands/command.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <sstream>
#include <system_error>

#include <CLI/CLI.hpp>

#include "apps/commands/common.hpp"
#include "apps/process.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) { names.push_back(command->get_name()); }
  return names;
}

bool is_option(std::string_view argument) { return argument.size() > 1 && argument.starts_with("-"); }

// Reports a missing or unknown command; without one, nothing else can be checked.
std::string no_command(const CLI::App& app, std::span<const char* const> arguments) {
  const std::vector<std::string> names = command_names(app);
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string all = "; the commands are " + list_of(views);
  for (const std::string argument : arguments) {
    if (is_option(argument)) { continue; }
    std::error_code ignored;
    if (argument.find('.') != argument.npos || std::filesystem::exists(argument, ignored)) {
      return "'" + argument + "' is no command; to solve a scene: halflight render " + argument;
    }
    const std::string nearest = suggestion(argument, names);
    return "there is no command '" + argument + "'" + (nearest.empty() ? all : nearest);
  }
  if (!arguments.empty()) { return "there is no option '" + std::string(arguments.front()) + "' before a command" + all; }
  return "a command is missing" + all;
}

// Reports options and words that the command does not take.
std::string not_expected(const CLI::App& command) {
  const std::vector<std::string> rest = command.remaining();
  std::vector<std::string> known, positional;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) { known.push_back("--" + name); }
    if (option->get_positional()) { positional.push_back(option->get_type_name()); }
  }
  for (const std::string& word : rest) {
    if (!is_option(word)) { continue; }
    const std::string name = word.substr(0, word.find('='));
    const bool one_dash = name.size() > 2 && !name.starts_with("--");  // -json
    return command.get_name() + " has no option '" + name + "'" + suggestion(one_dash ? "-" + name : name, known);
  }
  const std::string word = rest.empty() ? std::string() : rest.front();
  return "'" + word + "' is one too many: " + command.get_name() + " takes " +
         (positional.empty() ? "options alone" : joined(positional, " "));
}

// The option named first: "--size" in "--size: 1 required WxH missing", "--output" in "--output is required".
std::string subject(const std::string& sentence) { return sentence.substr(0, sentence.find_first_of(": ")); }

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

// "SCENE, the .scene file"
std::string described(const CLI::App& command, const std::string& name) {
  const CLI::Option* const option = command.get_option_no_throw(name);
  if (option == nullptr) { return name; }
  const std::string what = option->get_positional() ? option->get_type_name() : name + " " + option->get_type_name();
  return what + ", " + option->get_description();
}

template <class Kind>
bool is(const CLI::ParseError& error) {
  return dynamic_cast<const Kind*>(&error) != nullptr;
}

std::string sentence_of(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> arguments) {
  const std::vector<CLI::App*> used = app.get_subcommands();
  if (used.empty()) { return no_command(app, arguments); }
  const CLI::App& command = *used.front();
  const std::string text = error.what();
  if (is<CLI::ExtrasError>(error)) { return not_expected(command); }
  if (is<CLI::RequiredError>(error)) { return command.get_name() + " needs " + described(command, replaced(text, " is required", "")); }
  if (is<CLI::ExcludesError>(error)) { return replaced(text, " excludes ", " and ") + " cannot be given together"; }
  if (is<CLI::RequiresError>(error)) { return replaced(text, " requires ", " needs "); }
  if (is<CLI::ArgumentMismatch>(error)) {
    const std::string name = subject(text);
    if (text.find("missing") == text.npos) { return name + " is given more than once"; }
    const CLI::Option* const option = command.get_option_no_throw(name);
    return name + " needs a value" + (option == nullptr ? "" : ": " + option->get_type_name());
  }
  return text;
}

std::string explain(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> arguments) {
  const std::vector<CLI::App*> used = app.get_subcommands();
  return sentence_of(app, error, arguments) + "\n`halflight " + (used.empty() ? "" : used.front()->get_name() + " ") + "--help` says more.";
}

// Reports an empty argument, such as in --json "" or --json=; no option accepts one.
std::optional<std::string> empty_argument(std::span<const char* const> arguments) {
  std::string before = "the command";
  for (const std::string argument : arguments) {
    if (argument.empty()) { return "the value after " + before + " is empty"; }
    if (argument.starts_with("--") && argument.ends_with("=")) { return argument.substr(0, argument.size() - 1) + " needs a value"; }
    before = argument;
  }
  return std::nullopt;
}

void add(CLI::App& command, const Argument& argument) {
  if (argument.value.empty()) {
    command.add_flag_callback(
        argument.names, [take = argument.take] { static_cast<void>(take({})); }, argument.description);
    return;
  }
  using Values = Argument::Values;
  CLI::Option* option = nullptr;
  if (argument.values == Values::optional) {  // CLI11 does not validate a missing value
    option = command.add_option_function<std::string>(
        argument.names, [take = argument.take](const std::string& text) { static_cast<void>(take(text)); }, argument.description);
    option->expected(0, 1);
  } else {
    if (argument.values == Values::one) {
      option = command.add_option_function<std::string>(
          argument.names, [](const std::string&) {}, argument.description);
    } else {
      option = command.add_option_function<std::vector<std::string>>(
          argument.names, [](const std::vector<std::string>&) {}, argument.description);
      option->allow_extra_args(argument.values == Values::many);
    }
    option->check(CLI::Validator([take = argument.take](std::string& text) { return take(text); }, ""));
  }
  option->type_name(argument.value)->required(argument.required);
  if (!argument.preset.empty()) { option->default_str(argument.preset); }
}

void describe(CLI::App& app, const Command& command) {
  CLI::App& described = *app.add_subcommand(command.name, command.summary);
  for (const Argument& argument : command.arguments) { add(described, argument); }
  for (const Argument& argument : command.arguments) {
    CLI::Option* const option = described.get_option(argument.names.substr(argument.names.find(',') + 1));
    for (const std::string& other : argument.excludes) { option->excludes(described.get_option(other)); }
    for (const std::string& other : argument.needs) { option->needs(described.get_option(other)); }
  }
  if (!command.usage.empty()) { described.footer(command.usage + "\n" + app.get_footer()); }
  if (!command.missing) { return; }
  described.callback([missing = command.missing] {
    if (const std::string what = missing(); !what.empty()) { throw CLI::RequiredError(what); }
  });
}

}  // namespace

ExitCode run_program(const std::vector<Command>& commands, int argc, char** argv) {
  CLI::App app("Radiosity for scenes of diffuse surfaces: every run says how wrong it is and how long it took.", "halflight");
  app.set_version_flag("--version", std::string("halflight ") + version);
  app.footer(
      "Exit codes: 0 done, 1 failure, 2 wrong usage, 3 invalid scene, mesh or script, 4 not converged, which is an\n"
      "accuracy or residual that was asked for and not reached, or an end before time by a signal or for want of memory.\n"
      "'-' as a scene is the standard input; as the output of --json, --csv, explain or exercise, whose format is known, it is\n"
      "the standard output, and what is told goes to stderr then.");
  app.require_subcommand(1);
  for (const Command& command : commands) { describe(app, command); }
  const std::span<const char* const> arguments(argv + 1, argv + argc);
  if (const auto fault = empty_argument(arguments)) { return complain(*fault, ExitCode::usage); }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) { return complain(explain(app, error, arguments), ExitCode::usage); }
    std::ostringstream help;
    app.exit(error, help);
    return print(help.str()) ? ExitCode::ok : ExitCode::failure;
  }
  for (const Command& command : commands) {
    if (app.got_subcommand(command.name)) { return command.run(); }
  }
  return ExitCode::usage;
}

}  // namespace apps
