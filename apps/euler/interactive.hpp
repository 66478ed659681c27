// SPDX-License-Identifier: MIT
#pragma once

// The interactive mode: reads operators, prints counts and refusals. See examples/euler for the statements.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/process.hpp"

namespace apps::euler {

// Edits a line typed in a terminal: arrow keys, Home and End move the cursor, up and down recall earlier lines, Tab completes a word.
// Independent of the terminal, so that it can be tested.
class LineEditor {
 public:
  explicit LineEditor(std::function<std::vector<std::string>()> words) : words_(std::move(words)) {}

  enum class State { typing, done, end };  // end: Ctrl-D on an empty line, or Ctrl-C
  // One byte of input.
  State take(char byte);
  [[nodiscard]] const std::string& line() const { return line_; }
  [[nodiscard]] std::size_t cursor() const { return cursor_; }
  // The possible completions of a word after Tab if there are several; cleared by the next key.
  [[nodiscard]] const std::vector<std::string>& choices() const { return choices_; }
  // Begins a new line and adds the old one to the history.
  void next();

 private:
  void recall(std::size_t index);
  void complete();
  void escape(char byte);

  std::function<std::vector<std::string>()> words_;
  std::vector<std::string> history_, choices_;
  std::string line_, escape_;
  std::size_t cursor_ = 0, at_ = 0;  // at_: index in the history
};

// Reads lines from the terminal; nothing at the end of input.
class TerminalLines {
 public:
  TerminalLines(std::string prompt, std::function<std::vector<std::string>()> words)
      : prompt_(std::move(prompt)), editor_(std::move(words)) {}
  [[nodiscard]] std::optional<std::string> read();

 private:
  std::string prompt_;
  LineEditor editor_;
};

// Reads lines from stdin until `quit` or the end. After each step every output is rewritten: OUT.svg shows the present state, OUT.html
// all steps so far. Invalid lines and refused operators are reported and change nothing; the exit code is ok unless a file cannot be
// written.
[[nodiscard]] ExitCode converse(const std::vector<std::string>& outputs);

}  // namespace apps::euler
