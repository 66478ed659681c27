// SPDX-License-Identifier: MIT
// halflight stress [CASE...]: solves stiff and extreme scenes and compares each figure with its bound; exit code 1 if one fails.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/json.hpp"
#include "apps/stress/case.hpp"
#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps {
namespace {

struct StressOptions {
  std::vector<std::string> cases;  // none: all
  std::string json;
  bool list = false;
};

using stress::Case;
using stress::Figure;
using stress::Findings;

const char* sign(Figure::Bound kind) { return kind == Figure::Bound::at_most ? "<= " : kind == Figure::Bound::at_least ? ">= " : "=  "; }

// How many scenes were solved, warned about and refused.
std::string done(const Findings& findings) {
  const auto count = [](std::size_t n, const char* one, const char* several) { return n == 0 ? std::string{} : counted(n, one, several); };
  return joined(std::vector{count(findings.solved(), "scene solved", "scenes solved"),
                            count(findings.warnings().size(), "warned", "warned"),
                            count(findings.refusals().size(), "refused", "refused")});
}

std::string to_text(const Case& which, const Findings& findings) {
  std::string text = left(std::string{which.name}, 18, 1) + std::string{which.what} + "\n";
  for (const Figure& f : findings.figures()) {
    text += "  " + left(f.what, 66, 1) + left(formatted("%.3g", f.measured), 11, 1) + sign(f.kind) +
            left(formatted("%.3g", f.bound), 9, 1) + (f.holds() ? "ok" : "FAILED") + "\n";
  }
  text += "  " + done(findings) + ": " + std::string{which.why} + "\n";
  if (!findings.refusals().empty()) { text += "  refusal: " + findings.refusals().front() + "\n"; }
  if (!findings.warnings().empty()) { text += "  warning: " + findings.warnings().front() + "\n"; }
  return text + "\n";
}

void write(JsonWriter& json, const Case& which, const Findings& findings) {
  json.open_object().fields("case", which.name, "what", which.what, "why", which.why, "holds", findings.hold(), "solved", findings.solved(),
                            "refusals", findings.refusals(), "warnings", findings.warnings());
  json.key("figures").list(findings.figures(), [&](const Figure& f) {
    constexpr const char* kinds[] = {"at most", "at least", "exactly"};
    json.object("what", f.what, "measured", f.measured, "kind", kinds[static_cast<int>(f.kind)], "bound", f.bound, "holds", f.holds());
  });
  json.close();
}

// The named cases, in the order of the list and each once; complains about every unknown name.
std::vector<const Case*> choose(const std::vector<std::string>& names, bool& known) {
  std::vector<const Case*> chosen;
  for (const Case& c : stress::cases()) {
    if (names.empty() || contains(names, c.name)) { chosen.push_back(&c); }
  }
  known = true;
  for (const std::string& name : names) {
    if (std::any_of(chosen.begin(), chosen.end(), [&](const Case* c) { return c->name == name; })) { continue; }
    std::vector<std::string_view> all;
    for (const Case& c : stress::cases()) { all.push_back(c.name); }
    complain("there is no case '" + name + "'" + suggestion(name, all) + "; there are: " + joined(all));
    known = false;
  }
  return chosen;
}

ExitCode run(const StressOptions& options) {
  bool known = true;
  const std::vector<const Case*> chosen = choose(options.cases, known);
  if (!known) { return ExitCode::usage; }
  if (options.list) {
    std::string list;
    for (const Case* c : chosen) { list += left(std::string{c->name}, 18, 1) + std::string{c->what} + "\n"; }
    return print(list) ? ExitCode::ok : ExitCode::failure;
  }
  const std::vector<std::string> outputs{options.json};
  if (const ExitCode code = check_outputs(outputs, {}); code != ExitCode::ok) { return code; }
  JsonWriter json;
  json.open_array();
  std::vector<std::string_view> failed;
  std::size_t figures = 0;
  const std::clock_t start = std::clock();
  for (const Case* c : chosen) {
    Findings findings;
    c->run(findings);
    if (!print(to_text(*c, findings), outputs)) { return ExitCode::failure; }
    write(json, *c, findings);
    figures += findings.figures().size();
    if (!findings.hold()) { failed.push_back(c->name); }
  }
  json.close();
  if (!options.json.empty() && !save(options.json, json.text())) { return ExitCode::failure; }
  const std::string total = std::to_string(chosen.size()) + " cases, " + std::to_string(figures) + " figures: ";
  if (!print(total + (failed.empty() ? "all hold" : "FAILED: " + joined(failed)) + "\n", outputs)) { return ExitCode::failure; }
  // The time goes to stderr, so that stdout is the same in every run.
  std::fprintf(stderr, "CPU time %.1f s\n", static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  return failed.empty() ? ExitCode::ok : ExitCode::failure;
}

}  // namespace

Command stress_command() {
  const auto options = std::make_shared<StressOptions>();
  return {
      "stress",
      "solve stiff and extreme scenes, each figure against its bound",
      {texts("case", "CASE", options->cases, "cases to run (default: all)"), flag("--list", options->list, "name the cases and run none"),
       text("--json", "FILE", options->json, "write figures, bounds and verdicts as JSON, too")},
      [options] { return run(*options); }};
}

}  // namespace apps
