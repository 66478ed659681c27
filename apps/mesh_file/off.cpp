// SPDX-License-Identifier: MIT
// OFF (Geomview): an optional keyword, the counts of vertices, faces and edges, one line per vertex, one line per face; the corners of a
// face may continue on the next lines. According to the keyword, a position is followed by a normal, a colour and texture coordinates;
// the corners of a face may be followed by a colour.
#include "apps/mesh_file/reading.hpp"

#include <brep/builder_input.hpp>

namespace apps::mesh_file {
namespace {

class OffReader {
 public:
  OffReader(std::string_view bytes, Output& out) : lines_(bytes, true), out_(out) {}

  void run() {
    if (!header()) { return; }
    for (std::int64_t i = 0; i < vertices_ && !out_.full(); ++i) {
      if (!next("vertex", i, vertices_)) { return; }
      out_.mesh.builder.vertex(read_position(lines_, 0, out_).value_or(glm::dvec3(0.0)));
      out_.mesh.vertex_line.push_back(lines_.line());
      if (colored_) { color(out_.mesh.vertex_color, static_cast<std::size_t>(i), normals_ ? 6 : 3); }
    }
    for (std::int64_t i = 0; i < faces_ && !out_.full(); ++i) {
      if (!next("face", i, faces_)) { return; }
      static_cast<void>(face());  // continues after a bad face
    }
    scale_colors(out_.mesh);
    if (lines_.next()) {
      out_.mesh.notes.push_back("what follows the last face from line " + std::to_string(lines_.line()) +
                                " on was passed over; does the header count too few?");
    }
  }

 private:
  bool next(const char* what, std::int64_t number, std::int64_t count) {
    return lines_.next() || fail(0, std::string("the file ends before ") + what + " " + std::to_string(number + 1) + " of " +
                                        std::to_string(count) + " that the header promises");
  }
  bool fail(std::size_t word, std::string sentence) {
    out_.error(lines_.place(word), std::move(sentence));
    return false;
  }

  // The keyword says what the lines of the vertices contain besides positions, in the form [ST][C][N]OFF; the parts in [] are optional.
  bool header() {
    if (!lines_.next()) { return fail(0, "the file is empty; expected OFF"); }
    std::size_t word = 0;
    std::string_view keyword = lines_.words()[0];
    if (!to_number(keyword)) {
      for (const std::string_view prefix : {"ST", "C", "N"}) {
        if (!keyword.starts_with(prefix)) { continue; }
        keyword.remove_prefix(prefix.size());
        colored_ = colored_ || prefix == "C";
        normals_ = normals_ || prefix == "N";
      }
      if (keyword != "OFF") {
        const bool other = keyword == "4OFF" || keyword == "nOFF" || keyword == "4nOFF";
        return fail(0, (other ? "positions in more than three dimensions are not read: " : "expected OFF, COFF, NOFF or the like, found ") +
                           shown(lines_.words()[0]));
      }
      word = 1;
      if (word < lines_.words().size() && lines_.words()[word] == "BINARY") {
        return fail(word, "binary OFF is not read; convert the file to text, or to PLY");
      }
    }
    if (word == lines_.words().size()) {
      if (!lines_.next()) { return fail(0, "expected the numbers of vertices, faces and edges, found the end of the file"); }
      word = 0;
    }
    for (std::int64_t* const count : {&vertices_, &faces_}) {
      const auto number = word < lines_.words().size() ? to_integer(lines_.words()[word]) : std::nullopt;
      if (!number || *number < 0) {
        const std::string what = count == &vertices_ ? "vertices" : "faces";
        return fail(word, "expected the number of " + what + ", " + found(lines_, word));
      }
      *count = *number;
      ++word;
    }
    return faces_ > 0 || fail(word - 1, no_faces_in(static_cast<std::uint64_t>(vertices_)));
  }

  bool face() {
    const auto& words = lines_.words();
    const auto size = to_integer(words[0]);
    if (!size || *size < 0) { return fail(0, "expected the number of corners of a face, found " + shown(words[0])); }
    const auto missing = [&] { return *size - static_cast<std::int64_t>(words.size() - 1); };
    if (missing() > 0) {
      const Lines line = lines_;
      while (missing() > 0 && lines_.join()) {}
      if (missing() != 0) {  // the next lines do not continue this one
        lines_ = line;
        return fail(words.size(), "the face has " + std::to_string(words.size() - 1) + " of the " + std::to_string(*size) +
                                      " corners that its line promises");
      }
    }
    corners_.clear();
    for (std::size_t i = 1; i <= static_cast<std::size_t>(*size); ++i) {
      const auto index = read_vertex(lines_, i, static_cast<std::uint64_t>(vertices_), out_);
      if (!index) { return false; }
      corners_.push_back(*index);
    }
    out_.mesh.builder.face(corners_, 0);
    out_.mesh.face_line.push_back(lines_.line());
    color(out_.mesh.face_color, out_.mesh.face_line.size() - 1, corners_.size() + 1);
    return true;
  }
  // Reads a colour from three words starting at `first`, if they are numbers. A single number would be an index into a colour map that
  // the file does not contain.
  void color(std::vector<glm::vec3>& list, std::size_t of, std::size_t first) {
    glm::dvec3 value(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto number = first + k < lines_.words().size() ? to_number(lines_.words()[first + k]) : std::nullopt;
      if (!number) { return; }
      value[static_cast<int>(k)] = *number;
    }
    put_color(list, of, value);
  }

  Lines lines_;
  Output& out_;
  std::int64_t vertices_ = 0, faces_ = 0;
  bool colored_ = false, normals_ = false;  // have the vertices colours, and normals?
  std::vector<std::uint32_t> corners_;
};

void read_off(std::string_view bytes, Output& out) { OffReader(bytes, out).run(); }

std::string write_off(const brep::Builder& builder, std::span<const MeshGroup>) {
  std::string out = "OFF\n" + std::to_string(builder.vertex_count()) + " " + std::to_string(builder.face_count()) + " 0\n";
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) { put_position(out, builder.position(v)); }
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    out += std::to_string(builder.corners(f).size());
    for (std::uint32_t v : builder.corners(f)) { out += ' ' + std::to_string(v); }
    out += '\n';
  }
  return out;
}

// "OFF" with the letters for the additional data of its vertices.
bool begins_off(std::span<const std::string_view, 3> words, bool first) {
  return first && words[0].size() <= 8 && words[0].ends_with("OFF") && words[0].find_first_not_of("STCN4nOF") == std::string_view::npos;
}

}  // namespace

constinit const MeshFormat off_format{".off", "an OFF file", "a polygon mesh (OFF)", true, begins_off, read_off, write_off};

}  // namespace apps::mesh_file
