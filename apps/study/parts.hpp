// SPDX-License-Identifier: MIT
#pragma once

// A study distributed over several machines: part I of N measures every Nth pair of a scene and a method and writes its results to one
// file, part-I-of-N.study; merging combines the parts as if one machine had measured them all. Everything except time and memory is
// bit-identical, because runs depend only on their scene, options and seed.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/study/results.hpp"

namespace study {

struct PartNumber {
  std::size_t index = 1, count = 1;  // index: 1 ... count

  // Does this pair, numbered over all scenes and methods, belong to the part?
  [[nodiscard]] bool has(std::size_t pair) const { return pair % count == index - 1; }
};
// Parses "3/8".
[[nodiscard]] std::optional<PartNumber> parse_part(std::string_view text);

struct Part {
  PartNumber number;
  std::string asked;                              // scenes, limits and version; equal for all parts of a study
  std::size_t scene_count = 0, method_count = 0;  // of the whole study
  std::vector<std::vector<std::size_t>> methods;  // by scene of `study`: indices of its methods among all methods
  std::vector<std::size_t> scenes;                // indices of the scenes of `study` among all scenes
  Study study;
};

[[nodiscard]] std::string part_file(const PartNumber& number);
[[nodiscard]] std::string to_bytes(const Part& part);
// Nothing if the bytes are damaged or not a part.
[[nodiscard]] std::optional<Part> read_part(std::string_view bytes);

struct Merged {
  std::optional<Study> study;
  std::string fault;  // a part is missing, given twice, or belongs to another study
};
[[nodiscard]] Merged merge(std::vector<Part> parts);

}  // namespace study
