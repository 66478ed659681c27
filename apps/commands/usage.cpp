// SPDX-License-Identifier: MIT
#include "apps/commands/usage.hpp"

#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/scene_file/words.hpp"

namespace apps {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) { names.push_back(command->get_name()); }
  return names;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  return scene_file::suggestion(word, views);
}

bool is_option(std::string_view argument) { return argument.size() > 1 && argument.starts_with("-"); }

// Without a command nothing else can be judged.
std::string no_command(const CLI::App& app, std::span<const char* const> arguments) {
  const std::vector<std::string> names = command_names(app);
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string all = "; the commands are " + scene_file::list_of(views);
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

// Options and words that the command does not take.
std::string not_expected(const CLI::App& command) {
  const std::vector<std::string> rest = command.remaining();
  std::vector<std::string> known;
  std::string takes;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) { known.push_back("--" + name); }
    if (option->get_positional()) { takes += (takes.empty() ? "" : " ") + option->get_type_name(); }
  }
  for (const std::string& word : rest) {
    if (!is_option(word)) { continue; }
    const std::string name = word.substr(0, word.find('='));
    const bool one_dash = name.size() > 2 && !name.starts_with("--");  // -json
    return command.get_name() + " has no option '" + name + "'" + suggestion(one_dash ? "-" + name : name, known);
  }
  const std::string word = rest.empty() ? std::string() : rest.front();
  return "'" + word + "' is one too many: " + command.get_name() + " takes " + (takes.empty() ? "options alone" : takes);
}

// "--size" of "--size: 1 required WxH missing" and "--output is required".
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

}  // namespace

std::string explain(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> arguments) {
  const std::vector<CLI::App*> used = app.get_subcommands();
  return sentence_of(app, error, arguments) + "\n`halflight " + (used.empty() ? "" : used.front()->get_name() + " ") + "--help` says more.";
}

std::optional<std::string> empty_argument(std::span<const char* const> arguments) {
  std::string before = "the command";
  for (const std::string argument : arguments) {
    if (argument.empty()) { return "the value after " + before + " is empty"; }
    if (argument.starts_with("--") && argument.ends_with("=")) { return argument.substr(0, argument.size() - 1) + " needs a value"; }
    before = argument;
  }
  return std::nullopt;
}

}  // namespace apps
