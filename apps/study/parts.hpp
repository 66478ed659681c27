// SPDX-License-Identifier: MIT
#pragma once

// A study spread over machines: part I of N measures every Nth pair of a scene and a method, and keeps all that was found in one file,
// part-I-of-N.study; merging puts the parts together as if one machine had measured them all. Everything but time and memory is the same to
// the last bit, because runs depend on nothing but their scene, options and seed.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/study/results.hpp"

namespace study {

struct PartNumber {
  std::size_t index = 1, count = 1;  // 1 ... count

  // Is this pair, counted over all scenes and methods, one of the part?
  [[nodiscard]] bool has(std::size_t pair) const { return pair % count == index - 1; }
};
// "3/8".
[[nodiscard]] std::optional<PartNumber> parse_part(std::string_view text);

struct Part {
  PartNumber number;
  std::string asked;                              // scenes, limits and version: parts of one study agree in it
  std::size_t scene_count = 0, method_count = 0;  // of the whole study
  std::vector<std::vector<std::size_t>> methods;  // of each scene of `study`: which of all methods it has
  std::vector<std::size_t> scenes;                // which of all scenes these are
  Study study;
};

[[nodiscard]] std::string part_file(const PartNumber& number);
[[nodiscard]] std::string to_bytes(const Part& part);
// Nothing when the bytes are damaged or no part.
[[nodiscard]] std::optional<Part> read_part(std::string_view bytes);

struct Merged {
  std::optional<Study> study;
  std::string fault;  // a part is missing, twice there, or of another study
};
[[nodiscard]] Merged merge(std::vector<Part> parts);

}  // namespace study
