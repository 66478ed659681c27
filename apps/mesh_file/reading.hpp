// SPDX-License-Identifier: MIT
#pragma once

// Common parts of the mesh readers: lines of words with their places, numbers, and the list of errors.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "apps/mesh_file.hpp"

namespace apps::mesh_file {

// The mesh being read, and the errors in the file.
class Output {
 public:
  Mesh mesh;

  void error(Place place, std::string sentence) { errors_.add(place, std::move(sentence)); }
  [[nodiscard]] bool full() const { return errors_.full(); }
  [[nodiscard]] bool good() const { return errors_.count() == 0; }
  [[nodiscard]] MeshResult take() {
    const bool sound = good();
    return {errors_.take(), sound ? std::optional(std::move(mesh)) : std::nullopt};
  }

 private:
  Errors errors_;
};

// Text line by line; lines end with LF, CR LF or CR. Words are separated by blanks.
class Lines {
 public:
  // `comments`: a '#' and the rest of its line are ignored. `continued`: a backslash at the end, or before blanks at the end,
  // joins a line with the next one.
  Lines(std::string_view text, bool comments, bool continued = false);

  // Advances to the next line that has words; false at the end.
  bool next();
  // Appends the words of the next line that has words to the present ones; false at the end.
  bool join();
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  [[nodiscard]] std::string rest() const;  // the words after the first, separated by one blank, because a name may contain blanks
  [[nodiscard]] std::uint32_t line() const { return first_line_; }
  [[nodiscard]] Place place(std::size_t word) const;               // of a word, or of the end of the line if `word` is the number of words
  [[nodiscard]] Place place_in_text(std::string_view word) const;  // of a word of an earlier line; searches the text from its start
  [[nodiscard]] std::size_t consumed() const { return at_; }       // bytes up to the end of the present line

 private:
  void cut(std::string_view line);
  void read_line();  // including the lines that continue it

  struct Start {
    std::uint32_t line;
    const char* at;
  };
  std::string_view text_;
  bool comments_, continued_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 0, first_line_ = 0;
  std::vector<Start> starts_;  // of the joined lines
  std::vector<std::string_view> words_;
  const char* end_ = nullptr;  // of the present line
};

// The finite number or the integer that the whole word represents; a plus sign is allowed.
[[nodiscard]] std::optional<double> to_number(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> to_integer(std::string_view word);

// The word in quotes for a message: at most 40 characters of UTF-8, each that controls a terminal or is none as '?'.
[[nodiscard]] std::string shown(std::string_view word);

// Missing texture coordinates and colours.
inline constexpr float no_number = std::numeric_limits<float>::quiet_NaN();
inline constexpr glm::vec2 no_place{no_number, no_number};
inline constexpr glm::vec3 no_color{no_number, no_number, no_number};

// Sets the colour of a vertex or a face.
void put_color(std::vector<glm::vec3>& list, std::size_t of, const glm::dvec3& color);
// Some programs write colours from 0 to 1, others from 0 to 255: if any number in the file is above 1, all are divided by 255.
void scale_colors(Mesh& mesh);

// Reads a position from three words starting at `first`; after an error nothing.
[[nodiscard]] std::optional<glm::dvec3> read_position(const Lines& lines, std::size_t first, Output& out);

// The word as it appears in a message: "found 'x'", or "found the end of the line".
[[nodiscard]] std::string found(const Lines& lines, std::size_t word);

// Reads the word as the index of one of `count` vertices, from 0; after an error nothing.
[[nodiscard]] std::optional<std::uint32_t> read_vertex(const Lines& lines, std::size_t word, std::uint64_t count, Output& out);
[[nodiscard]] std::string expected_vertex(std::uint64_t count);  // "expected a vertex, a number from 0 to 7", or that there are none

// "the file has no faces, but 3 vertices and 2 lines 'l': points and lines have no surface". `others`: what the file contains besides
// vertices.
[[nodiscard]] std::string no_faces_in(std::uint64_t vertices, const std::string& others = {});

// Writes "1 0.5 2" and a line end, with digits that read back exactly.
void put_position(std::string& out, const glm::dvec3& p);

}  // namespace apps::mesh_file
