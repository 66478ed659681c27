// SPDX-License-Identifier: MIT
#include "apps/mesh_file/reading.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "apps/text.hpp"

namespace apps::mesh_file {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

// The column of `at`, counted from 1. Continuation bytes of UTF-8 characters are not counted.
std::uint32_t column(const char* start, const char* at) {
  return static_cast<std::uint32_t>(1 + std::count_if(start, at, [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

template <class T>
std::optional<T> parse(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') { word.remove_prefix(1); }
  return number_in<T>(word);
}

}  // namespace

Lines::Lines(std::string_view text, bool comments, bool continued)
    : text_(text), comments_(comments), continued_(continued), at_(text.size() - without_mark(text).size()) {
  constexpr char end_of_dos_text = '\x1a';
  if (comments_ && text_.ends_with(end_of_dos_text)) { text_.remove_suffix(1); }
}

bool Lines::next() {
  words_.clear();
  while (words_.empty() && at_ < text_.size()) {
    starts_.clear();
    first_line_ = line_ + 1;
    read_line();
  }
  return !words_.empty();
}

bool Lines::join() {
  const std::size_t before = words_.size();
  while (words_.size() == before && at_ < text_.size()) { read_line(); }
  return words_.size() > before;
}

void Lines::read_line() {
  for (bool more = true; more && at_ < text_.size();) {
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    starts_.push_back({++line_, line.data()});
    at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : end < text_.size() ? 1 : 0);
    const std::size_t comment = comments_ ? line.find('#') : std::string_view::npos;
    const std::size_t last = line.find_last_not_of(" \t\v\f");
    more = continued_ && comment == std::string_view::npos && last != std::string_view::npos && line[last] == '\\';
    line = line.substr(0, more ? last : comment);
    cut(line);
  }
}

void Lines::cut(std::string_view line) {
  end_ = line.data() + line.size();
  for (std::size_t i = 0; i < line.size();) {
    if (is_blank(line[i])) {
      ++i;
      continue;
    }
    const std::size_t begin = i;
    while (i < line.size() && !is_blank(line[i])) { ++i; }
    words_.push_back(line.substr(begin, i - begin));
  }
}

std::string Lines::rest() const {
  std::string text;
  for (std::size_t i = 1; i < words_.size(); ++i) { text.append(i > 1 ? " " : "").append(words_[i]); }
  return text;
}

Place Lines::place(std::size_t word) const {
  if (starts_.empty()) { return {}; }  // an empty text
  const char* const at = word < words_.size() ? words_[word].data() : end_;
  auto start = starts_.begin();
  while (start + 1 != starts_.end() && (start + 1)->at <= at) { ++start; }
  return {start->line, column(start->at, at)};
}

Place Lines::place_in_text(std::string_view word) const {
  const char* const begin = without_mark(text_).data();
  const char* start = begin;
  std::uint32_t line = 1;
  for (const char* at = begin; at != word.data(); ++at) {
    if (*at != '\n' && (*at != '\r' || at[1] == '\n')) { continue; }
    ++line;
    start = at + 1;
  }
  return {line, column(start, word.data())};
}

std::optional<double> to_number(std::string_view word) {
  const auto value = parse<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> to_integer(std::string_view word) { return parse<std::int64_t>(word); }

void put_position(std::string& out, const glm::dvec3& p) { out += shortest(p.x) + ' ' + shortest(p.y) + ' ' + shortest(p.z) + '\n'; }

std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text;
  std::size_t at = 0;
  for (std::size_t count = 0; at < word.size() && count < longest; ++count) {
    const std::size_t length = utf8_length(word, at);
    const std::string_view character = word.substr(at, std::max<std::size_t>(length, 1));
    const bool control = length == 1 ? character[0] < 0x20 || character[0] == 0x7f : character >= "\xc2\x80" && character < "\xc2\xa0";
    text += length == 0 || control ? "?" : character;
    at += character.size();
  }
  return "'" + text + (at < word.size() ? "...'" : "'");
}

std::optional<glm::dvec3> read_position(const Lines& lines, std::size_t first, Output& out) {
  glm::dvec3 position{0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t word = first + i;
    if (word >= lines.words().size()) {
      out.error(lines.place(lines.words().size()), "expected a coordinate, found the end of the line; a vertex has three");
      return std::nullopt;
    }
    const auto value = to_number(lines.words()[word]);
    if (!value) {
      out.error(lines.place(word), "expected a coordinate, a finite number, found " + shown(lines.words()[word]));
      return std::nullopt;
    }
    position[static_cast<int>(i)] = *value;
  }
  return position;
}

void put_color(std::vector<glm::vec3>& list, std::size_t of, const glm::dvec3& color) {
  if (list.size() <= of) { list.resize(of + 1, no_color); }
  list[of] = glm::vec3(glm::clamp(color, 0.0, 255.0));
}

void scale_colors(Mesh& mesh) {
  const auto above_one = [](const glm::vec3& c) { return c.x > 1.0F || c.y > 1.0F || c.z > 1.0F; };
  for (std::vector<glm::vec3>* const list : {&mesh.vertex_color, &mesh.face_color}) {
    if (std::none_of(list->begin(), list->end(), above_one)) { continue; }
    for (glm::vec3& c : *list) { c /= 255.0F; }
  }
}

std::string found(const Lines& lines, std::size_t word) {
  return word < lines.words().size() ? "found " + shown(lines.words()[word]) : "found the end of the line";
}

std::string expected_vertex(std::uint64_t count) {
  return count == 0 ? std::string("there are no vertices") : "expected a vertex, a number from 0 to " + std::to_string(count - 1);
}

std::string no_faces_in(std::uint64_t vertices, const std::string& others) {
  if (vertices == 0 && others.empty()) { return "the file has no faces"; }
  const std::string points = counted(vertices, "vertex", "vertices");
  return "the file has no faces, but " + points + (others.empty() ? ": points have" : " and " + others + ": points and lines have") +
         " no surface that light could fall on";
}

std::optional<std::uint32_t> read_vertex(const Lines& lines, std::size_t word, std::uint64_t count, Output& out) {
  const auto index = to_integer(lines.words()[word]);
  if (index && *index >= 0 && static_cast<std::uint64_t>(*index) < count) { return static_cast<std::uint32_t>(*index); }
  out.error(lines.place(word), expected_vertex(count) + ", " + found(lines, word));
  return std::nullopt;
}

}  // namespace apps::mesh_file
