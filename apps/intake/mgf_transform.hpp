// SPDX-License-Identifier: MIT
#pragma once

// The arguments of xf and i in MGF: -t x y z, -rx -ry -rz degrees, -s factor, -mx -my -mz; each acts on what those before it have made.
// -i N repeats what follows it N times. -a N makes N copies: what follows it acts 0, 1, ... N - 1 times.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>

#include "apps/input_errors.hpp"

namespace apps::intake::mgf {

// A line of a file: its words and where they stand.
struct Line {
  std::vector<std::string_view> words;
  std::vector<Place> places;  // one more: the end of the line

  [[nodiscard]] std::string_view word(std::size_t i) const { return i < words.size() ? words[i] : std::string_view(); }
  [[nodiscard]] Place place(std::size_t i) const { return places[i < words.size() ? i : words.size()]; }
};

// For notes.
[[nodiscard]] inline std::string at(const Line& line) { return "at line " + std::to_string(line.place(0).line); }

// A finite number of at most max_number; an error otherwise, and 0.
[[nodiscard]] double number(const Line& line, std::size_t word, Errors& errors);

class Transforms {
 public:
  // The words from this one on.
  Transforms(const Line& line, std::size_t first, Errors& errors);

  [[nodiscard]] std::size_t copies() const { return copies_; }
  [[nodiscard]] glm::dmat4 copy(std::size_t i) const;

 private:
  struct Part {
    glm::dmat4 matrix{1.0};
    std::size_t count = 1;
    bool array = false;
  };
  std::vector<Part> parts_{{}};
  std::size_t copies_ = 1;
};

// Most copies that one xf may make.
inline constexpr std::size_t most_copies = 100'000;

}  // namespace apps::intake::mgf
