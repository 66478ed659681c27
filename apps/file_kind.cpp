// SPDX-License-Identifier: MIT
#include "apps/file_kind.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <brep/euler_script.hpp>
#include <brep/euler_table.hpp>

#include "apps/bytes.hpp"
#include "apps/intake/model.hpp"
#include "apps/scene_file/grammar.hpp"
#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view blanks = " \t\r\n\v\f";

// Formats that begin with certain bytes.
constexpr std::array<std::pair<std::string_view, const char*>, 20> signatures = {{
    {"\x89PNG"sv, "a picture (PNG)"},
    {"\xff\xd8\xff"sv, "a picture (JPEG)"},
    {"GIF8"sv, "a picture (GIF)"},
    {"#?RADIANCE"sv, "a picture (Radiance HDR)"},
    {"II*\0"sv, "a picture (TIFF)"},
    {"MM\0*"sv, "a picture (TIFF)"},
    {"\x76\x2f\x31\x01"sv, "a picture (OpenEXR)"},
    {"%PDF"sv, "a document (PDF)"},
    {"PK\x03\x04"sv, "an archive (ZIP)"},
    {"\x1f\x8b"sv, "a compressed file (gzip)"},
    {"\x7f"
     "ELF"sv,
     "a program"},
    {"glTF"sv, "a binary glTF scene"},
    {"Kaydara FBX"sv, "a scene of another program (FBX)"},
    {"BLENDER"sv, "a scene of Blender"},
    {"#VRML"sv, "a scene of another program (VRML)"},
    {"#INVENTOR"sv, "a scene of another program (Open Inventor)"},
    {"\xff\xfe"sv, "text in UTF-16; save it as UTF-8"},
    {"\xfe\xff"sv, "text in UTF-16; save it as UTF-8"},
    {"<"sv, "a page or a drawing (HTML, SVG or other XML)"},
    {"{"sv, "data (JSON)"},
}};

// Splits the first lines that are not empty into words, without comments.
class FirstLines {
 public:
  explicit FirstLines(std::string_view text) : text_(text) {}

  // The first three words of the next line; false at the end.
  bool next(std::array<std::string_view, 3>& words) {
    while (!text_.empty()) {
      std::string_view line = text_.substr(0, text_.find_first_of("\r\n"));
      text_.remove_prefix(std::min(text_.size(), line.size() + 1));
      line = line.substr(0, line.find('#'));
      words = {};
      for (std::string_view& word : words) {
        line.remove_prefix(std::min(line.size(), line.find_first_not_of(blanks)));
        word = line.substr(0, line.find_first_of(blanks));
        line.remove_prefix(word.size());
      }
      if (!words[0].empty()) { return true; }
    }
    return false;
  }

 private:
  std::string_view text_;
};

bool begins_script(const std::array<std::string_view, 3>& words) {
  const std::string_view command = words[1] == "=" ? words[2] : words[0];
  return brep::find_operator(command) != nullptr || (!command.empty() && contains(brep::command_names, command));
}

// Is this the first word of a statement of a scene? For the first line a word close to one is enough, because the author probably meant it.
bool begins_scene(std::string_view word, bool first) {
  return first ? !nearest(word, scene_file::statements()).empty() : contains(scene_file::statements(), word);
}

// Compares the length with the number of triangles in the header.
bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < 84) { return false; }
  const std::uint64_t triangles = bits_at(bytes, 80, 4);
  return triangles > 0 && bytes.size() == 84 + 50 * triangles;
}

// Checks for a line that begins with "solid" and one after it that begins with "facet".
bool begins_stl_text(std::string_view bytes) {
  FirstLines lines(bytes);
  std::array<std::string_view, 3> words;
  return is_stl_text(bytes) && lines.next(words) && lines.next(words) && same_letters(words[0], "facet");
}

// Looks at the first 64 KiB only.
bool is_text(std::string_view bytes) {
  for (std::size_t at = 0; at < std::min<std::size_t>(bytes.size(), 1U << 16U);) {
    const std::size_t length = utf8_length(bytes, at);
    if (length == 0 || (static_cast<unsigned char>(bytes[at]) < 0x20 && blanks.find(bytes[at]) == blanks.npos)) { return false; }
    at += length;
  }
  return true;
}

std::string name_of(FileKind kind, const MeshFormat* format) {
  if (format != nullptr) { return std::string(format->file); }
  return kind == FileKind::scene ? "a scene" : kind == FileKind::script ? "a script of Euler operators" : "a file that halflight reads";
}

// What the user should do with the file instead.
std::string advice(const std::string& path, FileKind found, FileKind wanted) {
  const std::string of_scenes =
      "a scene is text that names materials and objects (examples/scenes/README.md), or a file of another program: " + model_endings();
  const bool mesh_wanted = wanted == FileKind::mesh;
  if (found == FileKind::mesh && mesh_wanted) { return "give it a name that ends with the right letters"; }
  if (found == FileKind::mesh && wanted == FileKind::scene) {
    return "give it a name that ends with the right letters (" + mesh_endings() + "), and it is read as a scene";
  }
  if (found == FileKind::mesh) { return "`halflight check " + path + "` examines it"; }
  if (found == FileKind::stl && mesh_wanted && has_ending(path, ".stl")) { return "`halflight mesh " + path + " -o OUT.obj` converts it"; }
  if (found == FileKind::stl) { return "give it a name that ends with .stl, and it is read as a scene"; }
  if (found == FileKind::light) { return "`halflight render --light " + path + " -o OUT.png` draws a picture of it"; }
  if (found == FileKind::script) { return "`halflight euler " + path + "` plays it"; }
  if (found == FileKind::scene) {
    return "`halflight info " + path + "` says what is in it" +
           (mesh_wanted ? ", `halflight mesh " + path + " -o OUT.obj` writes its polygons" : "");
  }
  if (mesh_wanted) { return "expected a polygon mesh: " + mesh_endings(); }
  return wanted == FileKind::scene ? of_scenes : std::string("a script is text with one operator a line (examples/euler)");
}

}  // namespace

bool is_stl_text(std::string_view bytes) {
  FirstLines lines(without_mark(bytes));
  std::array<std::string_view, 3> words;
  constexpr std::size_t header = 84;  // of a binary file; the number of triangles in it is below 2^24 and so has a zero byte
  return bytes.substr(0, header).find('\0') == bytes.npos && lines.next(words) && same_letters(words[0], "solid");
}

FileGuess guess_kind(std::string_view bytes) {
  bytes = without_mark(bytes);
  if (bytes.find_first_not_of(blanks) == bytes.npos) { return {FileKind::empty, "empty", nullptr}; }
  if (bytes.starts_with("halflight light ")) { return {FileKind::light, "the light of a solved scene", nullptr}; }
  for (const auto& [start, what] : signatures) {
    if (bytes.starts_with(start)) { return {FileKind::other, what, nullptr}; }
  }
  if (is_binary_stl(bytes)) { return {FileKind::stl, "a polygon mesh (STL)", nullptr}; }
  FirstLines lines(bytes);
  std::array<std::string_view, 3> words;
  for (int i = 0; lines.next(words); ++i) {
    for (const MeshFormat* const format : mesh_formats()) {
      if (format->begins(words, i == 0)) { return {FileKind::mesh, std::string(format->content), format}; }
    }
    if (i == 0 && begins_stl_text(bytes)) { return {FileKind::stl, "a polygon mesh (STL)", nullptr}; }
    if (begins_scene(words[0], i == 0)) { return {FileKind::scene, "a scene", nullptr}; }
    if (begins_script(words)) { return {FileKind::script, "a script of Euler operators", nullptr}; }
    if (i == 0 && !is_text(bytes)) { return {FileKind::other, "a binary file", nullptr}; }
  }
  return {};
}

std::optional<std::string> wrong_kind(const std::string& path, std::string_view bytes, FileKind wanted, const MeshFormat* format) {
  const FileGuess guess = guess_kind(bytes);
  if (guess.kind == wanted && guess.format == format) { return std::nullopt; }
  if (guess.kind == FileKind::empty) { return path + " is empty; " + advice(path, guess.kind, wanted); }
  if (guess.what.empty()) { return path + " is not " + name_of(wanted, format) + "; " + advice(path, guess.kind, wanted); }
  return path + " is " + guess.what + ", not " + name_of(wanted, format) + "; " + advice(path, guess.kind, wanted);
}

}  // namespace apps
