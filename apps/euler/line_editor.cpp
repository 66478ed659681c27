// SPDX-License-Identifier: MIT
#include "apps/euler/interactive.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include <termios.h>
#include <unistd.h>

namespace apps::euler {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

// Switches off echo and line buffering of the terminal; the destructor restores the previous state.
class RawTerminal {
 public:
  RawTerminal() {
    good_ = ::tcgetattr(0, &before_) == 0;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);
    if (good_) { good_ = ::tcsetattr(0, TCSADRAIN, &raw) == 0; }
  }
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;
  ~RawTerminal() {
    if (good_) { static_cast<void>(::tcsetattr(0, TCSADRAIN, &before_)); }
  }

 private:
  termios before_{};
  bool good_ = false;
};

}  // namespace

LineEditor::State LineEditor::take(char byte) {
  choices_.clear();
  if (!escape_.empty()) {
    escape(byte);
    return State::typing;
  }
  const auto code = static_cast<unsigned char>(byte);
  if (byte == '\n' || byte == '\r') { return State::done; }
  if (code == 3 || (code == 4 && line_.empty())) { return State::end; }
  if (code == 27) {
    escape_ = byte;
  } else if (code == 1) {
    cursor_ = 0;
  } else if (code == 5) {
    cursor_ = line_.size();
  } else if (code == 21) {
    line_.erase(0, cursor_);
    cursor_ = 0;
  } else if (code == 9) {
    complete();
  } else if (code == 127 || code == 8) {
    if (cursor_ > 0) { line_.erase(--cursor_, 1); }
  } else if (code >= 32) {
    line_.insert(cursor_++, 1, byte);
  }
  return State::typing;
}

void LineEditor::escape(char byte) {  // parses ESC [ A and similar sequences
  escape_ += byte;
  if (byte == '[' || byte == 'O' || (byte >= '0' && byte <= '9')) { return; }
  const std::string key = escape_.substr(std::min<std::size_t>(2, escape_.size()));
  escape_.clear();
  if (key == "A" && at_ > 0) { recall(at_ - 1); }
  if (key == "B" && at_ < history_.size()) { recall(at_ + 1); }
  if (key == "C" && cursor_ < line_.size()) { ++cursor_; }
  if (key == "D" && cursor_ > 0) { --cursor_; }
  if (key == "H" || key == "1~") { cursor_ = 0; }
  if (key == "F" || key == "4~") { cursor_ = line_.size(); }
  if (key == "3~" && cursor_ < line_.size()) { line_.erase(cursor_, 1); }
}

void LineEditor::recall(std::size_t index) {
  at_ = index;
  line_ = index < history_.size() ? history_[index] : std::string();
  cursor_ = line_.size();
}

void LineEditor::complete() {
  std::size_t begin = cursor_;
  while (begin > 0 && is_letter(line_[begin - 1])) { --begin; }
  const std::string word = line_.substr(begin, cursor_ - begin);
  std::set<std::string> found;
  for (const std::string& known : words_()) {
    if (!word.empty() && known.starts_with(word)) { found.insert(known); }
  }
  if (found.empty()) { return; }
  const std::string &first = *found.begin(), &last = *found.rbegin();  // all words share what the first and the last have in common
  const auto common = static_cast<std::size_t>(std::mismatch(first.begin(), first.end(), last.begin(), last.end()).first - first.begin());
  const std::string more = first.substr(word.size(), common - word.size()) + (found.size() == 1 ? " " : "");
  line_.insert(cursor_, more);
  cursor_ += more.size();
  if (found.size() > 1) { choices_.assign(found.begin(), found.end()); }
}

void LineEditor::next() {
  if (!line_.empty() && (history_.empty() || history_.back() != line_)) { history_.push_back(line_); }
  at_ = history_.size();
  line_.clear();
  cursor_ = 0;
}

std::optional<std::string> TerminalLines::read() {
  const RawTerminal raw;
  for (LineEditor::State state = LineEditor::State::typing;;) {
    std::string choices;
    for (const std::string& word : editor_.choices()) { choices += word + "  "; }
    if (!choices.empty()) { std::printf("\n%s\n", choices.c_str()); }
    std::printf("\r\033[K%s%s\r\033[%zuC", prompt_.c_str(), editor_.line().c_str(), prompt_.size() + editor_.cursor());
    std::fflush(stdout);
    if (state != LineEditor::State::typing) {
      std::puts("");
      const std::string line = editor_.line();
      editor_.next();
      return state == LineEditor::State::done ? std::optional(line) : std::nullopt;
    }
    char byte = 0;
    state = ::read(0, &byte, 1) == 1 ? editor_.take(byte) : LineEditor::State::end;
  }
}

}  // namespace apps::euler
