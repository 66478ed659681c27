// SPDX-License-Identifier: MIT
#pragma once

// What the mesh readers share: lines of words with their places, numbers, and the list of errors.

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

// The mesh that is read, and what is wrong with the file.
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
  // `comments`: a '#' and what follows it are passed over. `continued`: a backslash at its end joins a line to the next.
  Lines(std::string_view text, bool comments, bool continued = false);

  // Goes to the next line that has words; false at the end.
  bool next();
  // Adds the words of the next line that has some to those of the present one; false at the end.
  bool join();
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  [[nodiscard]] std::string rest() const;  // the words behind the first, with one blank between them: a name may have blanks
  [[nodiscard]] std::uint32_t line() const { return first_line_; }
  [[nodiscard]] Place place(std::size_t word) const;               // of a word; of the line's end for the number of words
  [[nodiscard]] Place place_in_text(std::string_view word) const;  // of a word of an earlier line; reads the text from its start
  [[nodiscard]] std::size_t consumed() const { return at_; }       // bytes up to the end of the present line

 private:
  void cut(std::string_view line);
  void read_line();  // with the lines that continue it

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

// A finite number or an integer that is the whole word; a plus sign is allowed.
[[nodiscard]] std::optional<double> to_number(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> to_integer(std::string_view word);

// The word in quotes for a message: at most 40 characters, what is not printable as '?'.
[[nodiscard]] std::string shown(std::string_view word);

// Texture coordinates and a colour that are not there.
inline constexpr float no_number = std::numeric_limits<float>::quiet_NaN();
inline constexpr glm::vec2 no_place{no_number, no_number};
inline constexpr glm::vec3 no_color{no_number, no_number, no_number};

// Sets the colour of a vertex or a face.
void put_color(std::vector<glm::vec3>& list, std::size_t of, const glm::dvec3& color);
// Some programs write colours from 0 to 1, others from 0 to 255: with any number above 1 in a file all are taken as the latter.
void scale_colors(Mesh& mesh);

// The first three words from `first` on are a position; errors say what is wrong. Nothing when there is an error.
[[nodiscard]] std::optional<glm::dvec3> read_position(const Lines& lines, std::size_t first, Output& out);

// The word as a message names it: "found 'x'", or "found the end of the line".
[[nodiscard]] std::string found(const Lines& lines, std::size_t word);

// The word as a vertex, one of `count` that are counted from 0; an error says what is wrong. Nothing when there is one.
[[nodiscard]] std::optional<std::uint32_t> read_vertex(const Lines& lines, std::size_t word, std::uint64_t count, Output& out);
[[nodiscard]] std::string expected_vertex(std::uint64_t count);  // "expected a vertex, a number from 0 to 7", or that there are none

// "the file has no faces, but 3 vertices and 2 lines 'l': points and lines have no surface". `others`: what there is but vertices.
[[nodiscard]] std::string no_faces_in(std::uint64_t vertices, const std::string& others = {});

// "1 0.5 2" and the end of the line, so that it reads back exactly.
void put_position(std::string& out, const glm::dvec3& p);

}  // namespace apps::mesh_file
