// SPDX-License-Identifier: MIT
// Wavefront OBJ: v, vt and f lines. A corner is v, v/vt, v//vn or v/vt/vn; a negative number counts back from the last vertex. Three
// numbers after a position are the vertex colour. A face belongs to the object (o), the group (g) and the material (usemtl) named last.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include <brep/builder_input.hpp>

#include "apps/mesh_file/reading.hpp"
#include "apps/text.hpp"

namespace apps::mesh_file {
namespace {

// Statements that do not affect the shape of the faces.
constexpr std::array<std::string_view, 14> silent{"vn",  "vp",       "s",        "mg",    "usemap",     "maplib",    "bevel",
                                                  "lod", "c_interp", "d_interp", "ctech", "shadow_obj", "trace_obj", "stech"};
// Points, lines, curves and free-form surfaces: geometry that is not read.
constexpr std::array<std::string_view, 21> unread{"p",    "l",    "curv", "curv2", "surf", "cstype", "deg", "bmat", "step", "parm", "trim",
                                                  "hole", "scrv", "sp",   "end",   "con",  "bzp",    "cdc", "cdp",  "res",  "call"};

struct ForwardReference {
  std::string_view word;  // its place is looked up only if there is no such vertex
  std::uint32_t number;   // from 1
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, Output& out) : lines_(bytes, true, true), out_(out) {}

  void run() {
    while (!out_.full() && lines_.next()) { statement(); }
    if (out_.full()) { return; }
    scale_colors(out_.mesh);
    for (const ForwardReference& f : forward_) {
      if (out_.full()) { return; }
      if (f.number > count()) {
        out_.error(lines_.place_in_text(f.word),
                   "there is no vertex " + std::to_string(f.number) + ", the file has " + std::to_string(count()));
      }
    }
    if (out_.good() && out_.mesh.builder.face_count() == 0) { no_faces(); }
    for (const auto& [word, number] : unread_) {
      out_.mesh.notes.push_back(lines_of(word, number) + " passed over: points, lines, curves and free-form surfaces are not read");
    }
    if (foreign_ > 0) {
      out_.mesh.notes.push_back(counted(foreign_, "line that is no statement", "lines that are no statements") +
                                " of OBJ passed over, the first " + first_foreign_);
    }
  }

 private:
  void fail(std::size_t word, std::string sentence) { out_.error(lines_.place(word), std::move(sentence)); }
  static std::string lines_of(std::string_view word, std::size_t number) {
    return counted(number, "line") + " '" + std::string(word) + "'";
  }
  // Reports that there are no faces, and what the file contains instead.
  void no_faces() {
    if (unread_.contains("surf")) {
      return out_.error({1, 1}, "the file has no faces, but free-form surfaces (surf), which are not read: let its program write polygons");
    }
    std::string others;
    for (const auto& [word, number] : unread_) { others += (others.empty() ? "" : ", ") + lines_of(word, number); }
    out_.error({1, 1}, count() == 0 && others.empty() ? "the file has no faces: no line begins with f"
                                                      : no_faces_in(static_cast<std::uint64_t>(count()), others));
  }
  [[nodiscard]] std::int64_t count() const { return out_.mesh.builder.vertex_count(); }

  void statement() {
    const std::string_view word = lines_.words()[0];
    if (word == "v") {
      vertex();
    } else if (word == "vt") {
      place();
    } else if (word == "f" || word == "fo") {
      face();
    } else if (word == "g" || word == "o") {
      (word == "o" ? object_ : group_) = lines_.rest();
      if (word == "o") { group_.clear(); }
      group_number_.reset();
    } else if (word == "usemtl") {
      material_ = number_of(lines_.rest(), out_.mesh.materials, material_numbers_);
    } else if (word == "mtllib") {
      libraries();
    } else if (contains(unread, word)) {
      ++unread_[word];
    } else if (!contains(silent, word)) {
      foreign(word);
    }
  }

  // Counts unknown statements: programs add their own, such as the creases of subdivision surfaces (t) or the weights of a skeleton (vw).
  void foreign(std::string_view word) {
    const bool is_name = std::all_of(word.begin(), word.end(), [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
    if (!is_name) { return fail(0, "expected a statement such as v, f or vn, found " + shown(word)); }
    if (foreign_++ == 0) { first_foreign_ = shown(word) + " at line " + std::to_string(lines_.line()); }
  }

  void vertex() {
    for (std::size_t i = 4; i < lines_.words().size(); ++i) {  // a weight, or a colour
      if (!to_number(lines_.words()[i])) { return fail(i, "expected a number, " + found(lines_, i)); }
    }
    const auto position = read_position(lines_, 1, out_);
    out_.mesh.builder.vertex(position.value_or(glm::dvec3(0.0)));
    out_.mesh.vertex_line.push_back(lines_.line());
    if (lines_.words().size() >= 7) {
      put_color(out_.mesh.vertex_color, static_cast<std::size_t>(count() - 1),
                {*to_number(lines_.words()[4]), *to_number(lines_.words()[5]), *to_number(lines_.words()[6])});
    }
  }

  // Texture coordinates. Invalid ones count as missing.
  void place() {
    const auto number = [&](std::size_t i) { return i < lines_.words().size() ? to_number(lines_.words()[i]) : std::optional(0.0); };
    const auto u = number(1), v = number(2);
    places_.push_back(u && v ? glm::vec2(static_cast<float>(*u), static_cast<float>(*v)) : no_place);
  }

  void face() {
    corners_.clear();
    corner_places_.clear();
    if (lines_.words().size() == 1) { return fail(1, "expected the corners of a face, found the end of the line"); }
    for (std::size_t i = 1; i < lines_.words().size(); ++i) {
      const auto number = corner(lines_.words()[i]);
      if (!number) { return fail(i, "expected a corner such as 3, 3/1, 3//2 or 3/1/2, " + found(lines_, i)); }
      if (*number == 0) { return fail(i, "vertices are counted from 1, found 0"); }
      const std::int64_t index = *number > 0 ? *number : count() + 1 + *number;
      if (index < 1) {
        return fail(i, "the corner " + std::to_string(*number) + " counts back from the last vertex, but only " + std::to_string(count()) +
                           " stand before this line");
      }
      if (index >= std::int64_t{std::numeric_limits<std::uint32_t>::max()}) {
        return fail(i, "there is no vertex " + std::to_string(index));
      }
      if (index > count()) { forward_.push_back({lines_.words()[i], static_cast<std::uint32_t>(index)}); }
      corners_.push_back(static_cast<std::uint32_t>(index - 1));
      corner_places_.push_back(place_of(lines_.words()[i]));
    }
    out_.mesh.builder.face(corners_, 0);
    put_places();
    out_.mesh.face_line.push_back(lines_.line());
    if (!group_number_) { group_number_ = number_of(group_name(), out_.mesh.groups, group_numbers_); }
    if (!material_) { material_ = number_of("default", out_.mesh.materials, material_numbers_); }
    out_.mesh.face_group.push_back(*group_number_);
    out_.mesh.face_material.push_back(*material_);
  }

  // The texture coordinates of a corner such as 3/1, among those defined before it.
  [[nodiscard]] glm::vec2 place_of(std::string_view word) const {
    const std::size_t slash = word.find('/');
    if (slash == word.npos || places_.empty()) { return no_place; }
    word.remove_prefix(slash + 1);
    const std::int64_t number = to_integer(word.substr(0, word.find('/'))).value_or(0), all = static_cast<std::int64_t>(places_.size());
    const std::int64_t index = number > 0 ? number : all + 1 + number;
    return number != 0 && index >= 1 && index <= all ? places_[static_cast<std::size_t>(index - 1)] : no_place;
  }
  void put_places() {
    corner_count_ += corners_.size();
    if (places_.empty()) { return; }
    std::vector<glm::vec2>& list = out_.mesh.corner_place;
    list.resize(corner_count_ - corners_.size(), no_place);
    list.insert(list.end(), corner_places_.begin(), corner_places_.end());
  }

  // The vertex number of a corner; texture and normal, if present, must be numbers as well.
  static std::optional<std::int64_t> corner(std::string_view word) {
    const auto number = to_integer(word.substr(0, word.find('/')));
    for (int slashes = 0; number && word.find('/') != std::string_view::npos; ++slashes) {
      word.remove_prefix(word.find('/') + 1);
      const std::string_view part = word.substr(0, word.find('/'));
      if (slashes == 2 || (!part.empty() && !to_integer(part))) { return std::nullopt; }
    }
    return number;
  }

  using Numbers = std::unordered_map<std::string, std::uint32_t>;

  static std::uint32_t number_of(const std::string& name, std::vector<std::string>& names, Numbers& numbers) {
    const auto [found, is_new] = numbers.emplace(name, static_cast<std::uint32_t>(names.size()));
    if (is_new) { names.push_back(name); }
    return found->second;
  }
  [[nodiscard]] std::string group_name() const {
    if (object_.empty() || group_.empty()) { return object_.empty() && group_.empty() ? "mesh" : object_ + group_; }
    return object_ == group_ ? object_ : object_ + "." + group_;
  }
  // One line may name several files; a single name may contain blanks, or stand in quotes.
  void libraries() {
    std::vector<std::string>& list = out_.mesh.libraries;
    std::vector<std::string> named;
    const auto& words = lines_.words();
    const bool several = std::count_if(words.begin(), words.end(), [](auto word) { return word.ends_with(".mtl"); }) > 1;
    if (several) {
      named.assign(words.begin() + 1, words.end());
    } else if (words.size() > 1) {
      named.push_back(lines_.rest());
    }
    for (std::string& name : named) {
      if (name.size() > 2 && name.front() == '"' && name.back() == '"') { name = name.substr(1, name.size() - 2); }
      if (list.size() < 100 && !contains(list, name)) { list.push_back(std::move(name)); }
    }
  }

  Lines lines_;
  Output& out_;
  std::string object_, group_;
  std::optional<std::uint32_t> group_number_, material_;
  Numbers group_numbers_, material_numbers_;
  std::vector<std::uint32_t> corners_;
  std::vector<glm::vec2> places_, corner_places_;  // of all vt lines; of the corners of the present face
  std::size_t corner_count_ = 0;                   // of all faces together
  std::vector<ForwardReference> forward_;
  std::map<std::string_view, std::size_t> unread_;
  std::size_t foreign_ = 0;
  std::string first_foreign_;
};

void read_obj(std::string_view bytes, Output& out) { ObjReader(bytes, out).run(); }

std::string write_obj(const brep::Builder& builder, std::span<const MeshGroup> groups) {
  std::string out;
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) {
    out += "v ";
    put_position(out, builder.position(v));
  }
  auto group = groups.begin();
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    for (; group != groups.end() && group->first_face <= f; ++group) { out += "o " + group->name + '\n'; }
    out += 'f';
    for (std::uint32_t v : builder.corners(f)) { out += ' ' + std::to_string(std::uint64_t{v} + 1); }
    out += '\n';
  }
  return out;
}

bool begins_obj(std::span<const std::string_view, 3> words, bool) {
  constexpr std::array<std::string_view, 5> names = {"mtllib", "usemtl", "o", "g", "s"};
  constexpr std::array<std::string_view, 4> numbers = {"v", "vn", "vt", "f"};
  if (words[1].empty() || words[1] == "=") { return false; }  // "s = ..." is a line of a script
  return contains(names, words[0]) || (contains(numbers, words[0]) && words[1].find_first_of("+-.0123456789eE") == 0);
}

}  // namespace

constinit const MeshFormat obj_format{".obj", "an OBJ file", "a polygon mesh (Wavefront OBJ)", true, begins_obj, read_obj, write_obj};

}  // namespace apps::mesh_file
