// SPDX-License-Identifier: MIT
#include "apps/euler/interactive.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <string_view>

#include <unistd.h>

#include <brep/euler_log.hpp>
#include <brep/euler_script.hpp>
#include <brep/euler_script_parse.hpp>
#include <brep/euler_script_run.hpp>
#include <brep/euler_script_text.hpp>
#include <brep/euler_script_words.hpp>
#include <brep/euler_table.hpp>
#include <brep/handles.hpp>
#include <brep/validate_explain.hpp>

#include "apps/euler/outputs.hpp"
#include "apps/euler/story.hpp"
#include "apps/files.hpp"
#include "apps/text.hpp"

namespace apps::euler {
namespace {

constexpr const char* more_help =
    "arguments    h7, a name that was given with =, next(x) prev(x) twin(x), anchor(f1), anchor(v3)\n"
    "others       undo, redo, expect v 8 e 12 f 6, raw next h3 h5 (damages a record; undo repairs it)\n"
    "             show (all records), face f1, vertex v2 (the walk around it), save FILE (the steps as a script), help, quit\n"
    "keys         Tab completes, the arrows bring back earlier lines\n";

// Words with which a line may begin.
std::vector<std::string> commands() {
  std::vector<std::string> words = statement_words();
  for (const char* const word : {"show", "face", "vertex", "save", "help", "quit"}) { words.emplace_back(word); }
  return words;
}

// Lists the operators with their arguments, their preconditions and their textbook names, which are accepted as well.
std::string help() {
  std::string out;
  for (const brep::OperatorForm& row : brep::operator_forms) {
    std::string call = (row.result == 'h' ? "h = " : "") + std::string(row.name);
    call += row.arguments.size() == 2 ? " a b" : row.arguments.empty() ? "" : row.result == 'h' ? " a" : " h";
    const std::string textbook = row.steps.empty() ? joined(row.textbook) : std::string(row.steps);
    std::array<char, 120> line{};
    std::snprintf(line.data(), line.size(), "%-12s %-23s %-37s %s", out.empty() ? "operators" : "", call.c_str(),
                  std::string(row.where).c_str(), textbook.c_str());
    const std::string text = line.data();
    out += text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  }
  return out + more_help;
}

std::string records_table(const Records& r) {
  const auto name = [](char letter, std::uint32_t i) {
    return i == brep::invalid_index ? std::string("none") : letter + std::to_string(i);
  };
  std::string out = "half-edge   next  prev  vertex  face\n";
  for (std::uint32_t i = 0; i < r.halfedges.size(); ++i) {
    const Records::Halfedge& h = r.halfedges[i];
    if (!h.alive) { continue; }
    std::array<char, 100> line{};
    std::snprintf(line.data(), line.size(), "%-10s %5s %5s %7s %5s\n", name('h', i).c_str(), name('h', h.next).c_str(),
                  name('h', h.prev).c_str(), name('v', h.vertex).c_str(), name('f', h.face).c_str());
    out += line.data();
  }
  const auto anchors = [&](char letter, const std::vector<std::uint32_t>& list) {
    out += letter == 'v' ? "anchors of vertices:" : "anchors of faces:";
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      if (list[i] != brep::invalid_index) { out += " " + name(letter, i) + "-" + name('h', list[i]); }
    }
    out += '\n';
  };
  anchors('v', r.vertices);
  anchors('f', r.faces);
  return out;
}

class Conversation {
 public:
  explicit Conversation(const std::vector<std::string>& outputs) : outputs_(outputs), teller_(solid_, !outputs.empty()) {
    teller_.story().title = "Interactive";
    layout_ = lay_out(teller_.story().frames.back().drawn, {}, smallest);
  }

  // False at the end of the conversation.
  bool take(const std::string& line, std::uint32_t number) {
    const std::size_t begin = line.find_first_not_of(" \t"), end = line.find_last_not_of(" \t\r");
    const std::string text = begin == std::string::npos ? "" : line.substr(begin, end - begin + 1);
    if (text == "quit" || text == "exit" || std::ferror(stdout) != 0) { return false; }
    if (text == "help" || text == "?") {
      say(help());
    } else if (text == "show") {
      say(records_table(teller_.story().frames.back().records));
    } else if (const auto element = asked_walk(text)) {
      say(walk(teller_.story().frames.back().records, *element) + "\n");
    } else if (const std::string word = text.substr(0, text.find_first_of(" \t"));
               (word == "face" || word == "vertex") && text.find('=') == text.npos) {
      say(word + ": expected a " + word + ", such as " + word[0] + "1\n");
    } else if (text == "save" || text.rfind("save ", 0) == 0) {
      save(text.substr(std::min<std::size_t>(5, text.size())));
    } else {
      statement(text, number);
    }
    return true;
  }
  [[nodiscard]] ExitCode code() const { return code_; }
  // Words that Tab can complete: commands, functions, and the names that earlier statements have given.
  [[nodiscard]] std::vector<std::string> words() const {
    std::vector<std::string> words = commands();
    for (const std::string_view function : brep::function_names) { words.emplace_back(function); }
    for (const Frame& frame : teller_.story().frames) {
      const std::size_t equals = frame.statement.find(" = ");
      if (equals != frame.statement.npos) { words.push_back(frame.statement.substr(0, equals)); }
    }
    return words;
  }

 private:
  static constexpr double smallest = 0.026;

  // The element named by "face f1" or "vertex v2".
  [[nodiscard]] static std::optional<brep::Element> asked_walk(const std::string& text) {
    for (const char* const word : {"face f", "vertex v"}) {
      const std::string begin = word;
      if (!text.starts_with(begin)) { continue; }
      const brep::Element element = brep::detail::parse_handle(text.substr(begin.size() - 1));
      if (element.letter != 0) { return element; }
    }
    return std::nullopt;
  }
  static void say(const std::string& text) {
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
  }
  bool write(const std::string& path, const std::string& bytes) {
    const auto fault = write_file(path, bytes);
    if (fault) { fail(*fault); }
    return !fault;
  }
  void fail(const std::string& sentence) {
    say(sentence + "\n");
    code_ = ExitCode::failure;
  }
  void save(const std::string& path) {
    if (path.empty()) { return say("save FILE: expected the name of a file\n"); }
    for (const std::string& output : outputs_) {
      if (same_output(path, output)) { return fail(path + " is a picture of this session; the steps need a file of their own"); }
    }
    if (const auto fault = check_writable(path)) { return fail(*fault); }
    if (write(path, brep::to_text(brep::steps(solid_)))) { say("written: " + path + "\n"); }
  }
  void statement(const std::string& text, std::uint32_t number) {
    const std::size_t errors = parser_.errors().size();
    const auto parsed = parser_.parse_line(text, number);
    if (parser_.errors().size() > errors) {
      const brep::ScriptError& e = parser_.errors().back();
      return say("column " + std::to_string(e.place.column) + ": " + e.sentence + meant(text, commands()) + "\n");
    }
    if (!parsed) { return; }
    const std::size_t checks = teller_.story().frames.back().checks.size();
    teller_.tell(*parsed);
    const Frame& frame = teller_.story().frames.back();
    if (parsed->command == brep::Command::expect) {
      const Check& check = frame.checks[checks];
      return say(check.met ? "as expected\n" : check.sentence + "\n");
    }
    const brep::Outcome& outcome = frame.outcome;
    std::string out;
    if (outcome.kind == brep::Outcome::Kind::refused) {
      out = "refused: " + outcome.sentence + "\n";
    } else if (!outcome.sentence.empty()) {
      out = outcome.sentence + "\n";
    } else {
      out = headline(frame) + "\n";
    }
    for (const brep::Fault& fault : outcome.faults) { out += fault.sentence + "\n"; }
    if (!frame.damaged) { out += counts(frame) + "      " + equation(frame) + "\n"; }
    if (!outputs_.empty()) { layout_ = lay_out(frame.drawn, layout_, smallest); }
    for (const std::string& path : outputs_) {
      write(path, path.ends_with(".svg") ? picture(teller_.story(), layout_) : page(teller_.story()));
    }
    say(out);
  }

  const std::vector<std::string>& outputs_;
  Solid solid_;
  Teller teller_;
  brep::ScriptParser parser_;
  Layout layout_;
  ExitCode code_ = ExitCode::ok;
};

}  // namespace

ExitCode converse(const std::vector<std::string>& outputs) {
  const bool terminal = ::isatty(0) == 1 && ::isatty(1) == 1;
  Conversation conversation(outputs);
  TerminalLines lines("> ", [&] { return conversation.words(); });
  if (terminal) { std::fputs("Euler operators; `help` lists them, `quit` ends.\n", stdout); }
  for (std::uint32_t number = 1;; ++number) {
    std::string line;
    std::optional<std::string> read = terminal ? lines.read() : std::getline(std::cin, line) ? std::optional(line) : std::nullopt;
    if (!read || !conversation.take(*read, number)) { break; }
  }
  return conversation.code();
}

}  // namespace apps::euler
