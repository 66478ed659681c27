// SPDX-License-Identifier: MIT
// PLY (Turk 1994): a header declares elements and their properties; then come the values, as text or as binary in either byte order. Read
// are x, y and z of the element vertex, the list vertex_indices (or vertex_index) of the elements face and tristrips, and red, green and
// blue of vertex and face; everything else is skipped. In a list of triangle strips, -1 separates them.
#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include <brep/builder_input.hpp>
#include <brep/finite.hpp>

#include "apps/mesh_file/ply_types.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::mesh_file {
namespace {

using ply::is_float, ply::size_of, ply::Type, ply::type_of;

struct Property {
  enum class Role : std::uint8_t { other, x, y, z, red, green, blue, corners };
  Type type;
  bool is_list;
  Type count;  // of a list: the type of its length
  Role role = Role::other;
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, Output& out) : bytes_(bytes), lines_(bytes, false), out_(out) {}

  void run() {
    if (!header() || !check_header()) { return; }
    at_ = lines_.consumed();
    for (const Element& element : elements_) {
      // An element without properties takes no space, so its count cannot be checked against the size of the file: it is skipped.
      for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        if (out_.full() || !(text_ ? text_element(element, i) : binary_element(element, i))) { return; }
      }
    }
    if (out_.good() && out_.mesh.builder.face_count() == 0) {  // strips in which every triangle has a repeated corner
      out_.error(text_ ? lines_.place(0) : Place{0, static_cast<std::uint32_t>(at_)}, no_faces_in(vertices_));
    }
    scale_colors(out_.mesh);
    const bool more = text_ ? lines_.next() : at_ < bytes_.size();
    if (more) { out_.mesh.notes.push_back("what follows the last element was passed over; does the header count too few?"); }
  }

 private:
  // --- the header
  bool fail(std::size_t word, const std::string& sentence) {
    out_.error(lines_.place(word), sentence);
    return false;
  }
  [[nodiscard]] std::string found(std::size_t word) const { return mesh_file::found(lines_, word); }
  [[nodiscard]] std::string_view word(std::size_t i) const { return i < lines_.words().size() ? lines_.words()[i] : std::string_view(); }

  bool header() {
    if (!lines_.next() || word(0) != "ply") { return fail(0, "expected ply in the first line of a PLY file"); }
    bool has_format = false;
    while (lines_.next()) {
      const std::string_view statement = word(0);
      if (statement == "comment" || statement == "obj_info") { continue; }
      if (statement == "end_header") {
        return has_format || fail(0, "expected a line such as 'format ascii 1.0' before the end of the header");
      }
      if (statement == "format") {
        if (!format()) { return false; }
        has_format = true;
      } else if (statement == "element") {
        const auto count = to_integer(word(2));
        if (lines_.words().size() != 3 || !count || *count < 0) { return fail(2, "expected 'element NAME COUNT', " + found(2)); }
        elements_.push_back({std::string(word(1)), static_cast<std::uint64_t>(*count), {}});
      } else if (statement == "property") {
        if (!property()) { return false; }
      } else {
        return fail(0, "expected element, property, comment or end_header, " + found(0));
      }
    }
    return fail(0, "the file ends within its header: no line end_header");
  }

  bool format() {
    text_ = word(1) == "ascii";
    big_ = word(1) == "binary_big_endian";
    if (!text_ && !big_ && word(1) != "binary_little_endian") {
      return fail(1, "expected ascii, binary_little_endian or binary_big_endian, " + found(1));
    }
    return word(2) == "1.0" || fail(2, "expected the version 1.0, " + found(2));
  }

  bool property() {
    if (elements_.empty()) { return fail(0, "a property stands before the first element"); }
    const bool is_list = word(1) == "list";
    const std::size_t type_at = is_list ? 3 : 1;
    Type count = Type::uint8;
    if (is_list) {
      const auto of_length = type_of(word(2));
      if (!of_length || is_float(*of_length)) { return fail(2, "expected an integer type for the length of a list, " + found(2)); }
      count = *of_length;
    }
    const auto type = type_of(word(type_at));
    if (!type) { return fail(type_at, "expected a type such as float, uchar or int32, " + found(type_at)); }
    if (lines_.words().size() != type_at + 2) { return fail(type_at + 1, "expected one name for the property, " + found(type_at + 1)); }
    const std::string_view name = word(type_at + 1);
    Element& element = elements_.back();
    Property property{*type, is_list, count};
    using Role = Property::Role;
    if (element.name == "vertex" && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
      if (is_list) { return fail(1, "the coordinate " + std::string(name) + " cannot be a list"); }
      property.role = std::array{Role::x, Role::y, Role::z}[static_cast<std::size_t>(name[0] - 'x')];
    } else if ((element.name == "face" || element.name == "tristrips") && (name == "vertex_indices" || name == "vertex_index")) {
      if (!is_list || is_float(*type)) { return fail(1, "the corners of faces must be a list of integers"); }
      property.role = Role::corners;
    } else if (!is_list && (element.name == "vertex" || element.name == "face")) {
      property.role = color_role(name);
    }
    for (const Property& p : element.properties) {
      if (p.role == property.role && property.role >= Role::red && property.role <= Role::blue) { property.role = Role::other; }
      if (p.role != Role::other && p.role == property.role) { return fail(type_at + 1, shown(name) + " is declared twice"); }
    }
    element.properties.push_back(property);
    return true;
  }

  bool check_header() {
    const Element *vertex = nullptr, *face = nullptr, *strips = nullptr;
    for (const Element& element : elements_) {
      const Element** const known = element.name == "vertex"      ? &vertex
                                    : element.name == "face"      ? &face
                                    : element.name == "tristrips" ? &strips
                                                                  : nullptr;
      if (known == nullptr) { continue; }
      if (*known != nullptr) { return fail(0, "the element " + element.name + " is declared twice"); }
      *known = &element;
    }
    const auto has = [](const Element& element, Property::Role role) {
      return std::any_of(element.properties.begin(), element.properties.end(), [&](const Property& p) { return p.role == role; });
    };
    using Role = Property::Role;
    if (vertex == nullptr || !has(*vertex, Role::x) || !has(*vertex, Role::y) || !has(*vertex, Role::z)) {
      return fail(0, "expected an element vertex with the properties x, y and z");
    }
    const auto is_there = [](const Element* element) { return element != nullptr && element->count > 0; };
    if (!is_there(face) && !is_there(strips)) { return fail(0, no_faces_in(vertex->count)); }
    for (const Element* const element : {face, strips}) {
      if (is_there(element) && !has(*element, Role::corners)) {
        return fail(0, "expected the element " + element->name + " to have the property list vertex_indices");
      }
    }
    vertices_ = vertex->count;
    return true;
  }

  // --- values, handled in the same way for text and binary files
  void take(const Element& element, Place place) {
    if (element.name == "vertex") {
      if (!brep::is_finite(position_)) { out_.error(place, "a coordinate is not a finite number"); }
      out_.mesh.builder.vertex(position_);
      if (text_) { out_.mesh.vertex_line.push_back(place.line); }
      if (colors_ == 3) { put_color(out_.mesh.vertex_color, out_.mesh.builder.vertex_count() - 1, color_); }
    } else if (element.name == "face") {
      face(corners_, place);
      if (colors_ == 3) { put_color(out_.mesh.face_color, out_.mesh.builder.face_count() - 1, color_); }
    } else if (element.name == "tristrips") {
      for (std::size_t first = 0; first < corners_.size();) {
        const auto end = std::find(corners_.begin() + static_cast<std::ptrdiff_t>(first), corners_.end(), between_strips);
        strip(std::span(corners_).subspan(first, static_cast<std::size_t>(end - corners_.begin()) - first), place);
        first = static_cast<std::size_t>(end - corners_.begin()) + 1;
      }
    }
    corners_.clear();
    colors_ = 0;
  }
  void face(std::span<const std::uint32_t> corners, Place place) {
    out_.mesh.builder.face(corners, 0);
    if (text_) { out_.mesh.face_line.push_back(place.line); }
  }
  // Every second triangle of a strip has the opposite orientation. A repeated corner reverses the strip and makes degenerate triangles,
  // which are skipped.
  void strip(std::span<const std::uint32_t> corners, Place place) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const std::uint32_t a = corners[i - 2], b = corners[i - 1], c = corners[i];
      if (a == b || b == c || c == a) { continue; }
      face(i % 2 == 0 ? std::array{a, b, c} : std::array{b, a, c}, place);
    }
  }
  static Property::Role color_role(std::string_view name) {
    if (name.starts_with("diffuse_")) { name.remove_prefix(8); }
    using Role = Property::Role;
    return name == "red" ? Role::red : name == "green" ? Role::green : name == "blue" ? Role::blue : Role::other;
  }
  // Integers are colours relative to the largest value of their type.
  void set_number(const Property& property, double value) {
    using Role = Property::Role;
    if (property.role >= Role::x && property.role <= Role::z) {
      position_[static_cast<int>(property.role) - static_cast<int>(Role::x)] = value;
    } else if (property.role >= Role::red && property.role <= Role::blue) {
      const double most = property.type == Type::uint8 ? 255.0 : property.type == Type::uint16 ? 65535.0 : 1.0;
      color_[static_cast<int>(property.role) - static_cast<int>(Role::red)] = value / most;
      ++colors_;
    }
  }
  static std::string which(const Element& element, std::uint64_t i) {
    return element.name + " " + std::to_string(i + 1) + " of " + std::to_string(element.count);
  }

  bool text_element(const Element& element, std::uint64_t i) {
    if (!lines_.next()) { return fail(0, "the file ends before " + which(element, i) + " that the header promises"); }
    std::size_t at = 0;
    for (const Property& property : element.properties) {
      std::uint64_t values = 1;
      if (property.is_list) {
        const auto count = to_integer(word(at));
        if (!count || *count < 0) { return fail(at, "expected the length of a list, " + found(at)); }
        values = static_cast<std::uint64_t>(*count);
        ++at;
      }
      for (; values > 0; --values, ++at) {
        if (at >= lines_.words().size()) { return fail(at, "the line of " + which(element, i) + " has too few values"); }
        if (property.role == Property::Role::corners && word(at) == "-1" && element.name == "tristrips") {
          corners_.push_back(between_strips);
        } else if (property.role == Property::Role::corners) {
          const auto index = read_vertex(lines_, at, vertices_, out_);
          if (!index) { return false; }
          corners_.push_back(*index);
        } else if (property.role != Property::Role::other) {
          const auto value = to_number(word(at));
          if (!value && property.role >= Property::Role::red) { continue; }
          if (!value) { return fail(at, "expected a coordinate, a finite number, " + found(at)); }
          set_number(property, *value);
        }
      }
    }
    if (at < lines_.words().size()) { return fail(at, "the line of " + which(element, i) + " has too many values"); }
    take(element, lines_.place(0));
    return true;
  }

  bool binary_element(const Element& element, std::uint64_t i) {
    const Place place{0, static_cast<std::uint32_t>(at_ + 1)};
    const auto ends = [&] {
      out_.error(place, "the file ends within " + which(element, i) + " that the header promises");
      return false;
    };
    for (const Property& property : element.properties) {
      std::uint64_t values = 1;
      if (property.is_list) {
        if (bytes_.size() - at_ < size_of(property.count)) { return ends(); }
        const double count = value(property.count);
        if (count < 0) {
          out_.error(place, "a list in " + which(element, i) + " has a negative length");
          return false;
        }
        values = static_cast<std::uint64_t>(count);
      }
      if ((bytes_.size() - at_) / size_of(property.type) < values) { return ends(); }
      if (property.role == Property::Role::other) {
        at_ += values * size_of(property.type);
      } else if (property.role != Property::Role::corners) {
        set_number(property, value(property.type));
      } else {
        for (; values > 0; --values) {
          const double index = value(property.type);
          if (index == -1.0 && element.name == "tristrips") {
            corners_.push_back(between_strips);
            continue;
          }
          if (index < 0 || index >= static_cast<double>(vertices_)) {
            out_.error(place, which(element, i) + " has the corner " + std::to_string(static_cast<std::int64_t>(index)) + "; " +
                                  expected_vertex(vertices_));
            return false;
          }
          corners_.push_back(static_cast<std::uint32_t>(index));
        }
      }
    }
    take(element, place);
    return true;
  }

  // The next value; the caller must have checked that it exists.
  double value(Type type) {
    const double number = ply::number_at(bytes_, at_, type, big_);
    at_ += size_of(type);
    return number;
  }

  std::string_view bytes_;
  Lines lines_;
  Output& out_;
  bool text_ = true, big_ = false;
  std::vector<Element> elements_;
  std::uint64_t vertices_ = 0;
  std::size_t at_ = 0;  // position in a binary file
  glm::dvec3 position_{0.0}, color_{0.0};
  int colors_ = 0;  // number of colour components that the present element has
  static constexpr std::uint32_t between_strips = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> corners_;
};

void read_ply(std::string_view bytes, Output& out) { PlyReader(bytes, out).run(); }

std::string write_ply(const brep::Builder& builder, std::span<const MeshGroup>) {
  std::size_t most = 0;
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) { most = std::max(most, builder.corners(f).size()); }
  const bool wide = most > 255;  // more corners than fit into a byte
  std::string out =
      ply_header({}, {{"vertex", builder.vertex_count(), {"double x", "double y", "double z"}},
                      {"face", builder.face_count(), {wide ? "list int int vertex_indices" : "list uchar int vertex_indices"}}});
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) {
    for (int i = 0; i < 3; ++i) { put(out, builder.position(v)[i]); }
  }
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    const std::size_t corners = builder.corners(f).size();
    wide ? put(out, static_cast<std::uint32_t>(corners)) : put(out, static_cast<std::uint8_t>(corners));
    for (const std::uint32_t v : builder.corners(f)) { put(out, v); }
  }
  return out;
}

bool begins_ply(std::span<const std::string_view, 3> words, bool first) { return first && words[0] == "ply"; }

}  // namespace

constinit const MeshFormat ply_format{".ply", "a PLY file", "a polygon mesh (PLY)", false, begins_ply, read_ply, write_ply};

}  // namespace apps::mesh_file
