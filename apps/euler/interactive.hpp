// SPDX-License-Identifier: MIT
#pragma once

// A conversation: operators in, counts and refusals out. See examples/euler for the statements.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/process.hpp"

namespace apps::euler {

// A line that is typed in a terminal: arrows, Home and End move, up and down bring back earlier lines, Tab completes a word. What keys do
// is told apart from the terminal, so that it can be tested.
class LineEditor {
 public:
  explicit LineEditor(std::function<std::vector<std::string>()> words) : words_(std::move(words)) {}

  enum class State { typing, done, end };  // end: Ctrl-D on an empty line, or Ctrl-C
  // One byte of input.
  State take(char byte);
  [[nodiscard]] const std::string& line() const { return line_; }
  [[nodiscard]] std::size_t cursor() const { return cursor_; }
  // The words that Tab could mean when there are several; empty again at the next key.
  [[nodiscard]] const std::vector<std::string>& choices() const { return choices_; }
  // Begins a new line; the old one is remembered.
  void next();

 private:
  void recall(std::size_t index);
  void complete();
  void escape(char byte);

  std::function<std::vector<std::string>()> words_;
  std::vector<std::string> history_, choices_;
  std::string line_, escape_;
  std::size_t cursor_ = 0, at_ = 0;  // at_: in the history
};

// Reads lines from the terminal; nothing at its end.
class TerminalLines {
 public:
  TerminalLines(std::string prompt, std::function<std::vector<std::string>()> words)
      : prompt_(std::move(prompt)), editor_(std::move(words)) {}
  [[nodiscard]] std::optional<std::string> read();

 private:
  std::string prompt_;
  LineEditor editor_;
};

// Reads lines from stdin until `quit` or the end. After each step every output is written anew: OUT.svg the present state, OUT.html
// all steps so far. Bad lines and refusals are told and change nothing; the exit code is ok unless a file cannot be written.
[[nodiscard]] ExitCode converse(const std::vector<std::string>& outputs);

}  // namespace apps::euler
