// SPDX-License-Identifier: MIT
// STL (3D Systems 1989), as text and as binary: triangles with three positions each. Equal positions become one vertex, so the triangles
// of a solid form one surface. Normals are ignored, because the order of the corners gives the orientation.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "apps/bytes.hpp"
#include "apps/file_kind.hpp"
#include "apps/intake/model.hpp"
#include "apps/mesh_file/reading.hpp"
#include "apps/words.hpp"

namespace apps::intake {
namespace {

using namespace std::string_literals;

class StlReader {
 public:
  explicit StlReader(std::string_view bytes) : bytes_(bytes), lines_(bytes, false) {
    model_.tells_sides = false;
    model_.materials.push_back({"default", {}, radiosity::Color(0.0), false});
  }

  ModelResult run() {
    if (is_stl_text(bytes_)) {
      text();
    } else {
      binary();
    }
    if (model_.groups.empty()) { model_.groups.emplace_back("mesh"); }
    return read_result(std::move(model_), errors_);
  }

 private:
  std::uint32_t vertex(const glm::dvec3& p) {
    const std::array<double, 3> key{p.x + 0.0, p.y + 0.0, p.z + 0.0};  // turns minus zero into zero
    const auto [at, fresh] = vertices_.try_emplace(key, static_cast<std::uint32_t>(model_.positions.size()));
    if (fresh) { model_.positions.push_back(p); }
    return at->second;
  }

  // A header of 80 arbitrary bytes, the number of triangles, and 50 bytes per triangle: normal, corners, an unused number.
  void binary() {
    constexpr std::size_t header = 84, size = 50, corners = 12;
    const auto place = [](std::size_t at) { return Place{0, static_cast<std::uint32_t>(at + 1)}; };
    if (bytes_.size() < header || bytes_.substr(0, header).find('\0') == bytes_.npos) {
      return errors_.add(Place{}, "expected an STL file: text that begins with 'solid', or 84 bytes and then 50 for each triangle");
    }
    const std::uint64_t count = bits_at(bytes_, 80, 4), fitting = (bytes_.size() - header) / size;
    if (count == 0) { return errors_.add(place(80), "the file has no triangles"); }
    if (count > fitting) {
      return errors_.add(place(bytes_.size()), "the file ends within triangle " + std::to_string(fitting + 1) + " of the " +
                                                   std::to_string(count) + " that its header promises");
    }
    if (bytes_.size() > header + count * size) {
      model_.notes.push_back("what follows the last triangle was passed over; does the header count too few?");
    }
    for (std::size_t t = 0; t < count && !errors_.full(); ++t) {
      std::array<std::uint32_t, 3> triangle{};
      bool finite = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = header + t * size + corners + 12 * k;
        glm::dvec3 p{0.0};
        for (int c = 0; c < 3; ++c) {
          p[c] = std::bit_cast<float>(static_cast<std::uint32_t>(bits_at(bytes_, at + 4 * static_cast<std::size_t>(c), 4)));
        }
        finite = finite && std::isfinite(p.x + p.y + p.z);
        if (finite) { triangle[k] = vertex(p); }
      }
      if (!finite) {
        errors_.add(place(header + t * size + corners), "a coordinate of triangle " + std::to_string(t + 1) + " is not a finite number");
        continue;
      }
      model_.polygon(triangle, 0, 0);
    }
  }

  // "solid NAME", facets of the form "facet normal x y z outer loop vertex x y z ... endloop endfacet", "endsolid NAME", possibly
  // repeated. Reading ends at the first error, because what follows cannot be assigned to a facet.
  void text() {
    while (next()) {
      if (is("solid")) {
        const std::string name = word_ == 0 ? lines_.rest() : ""s;
        model_.groups.push_back(name.empty() ? "mesh" : name);
        pass_line();
      } else if (is("endsolid")) {
        pass_line();
      } else if (is("facet")) {
        if (!facet()) { return; }
      } else {
        static_cast<void>(fail("solid, facet or endsolid"));
        return;
      }
    }
    if (model_.polygons() == 0) {
      errors_.add(lines_.place(lines_.words().size()), "the file has no facets; the name of a solid ends with its line");
    }
  }

  bool facet() {
    const std::uint32_t line = lines_.line();
    if (!expect("normal")) { return false; }
    for (int c = 0; c < 3; ++c) {
      if (!next()) { return fail("a number"); }
    }
    if (!expect("outer") || !expect("loop")) { return false; }
    std::vector<std::uint32_t> corners;
    while (next() && is("vertex")) {
      glm::dvec3 p{0.0};
      for (int c = 0; c < 3; ++c) {
        const auto number = next() ? mesh_file::to_number(lines_.words()[word_]) : std::nullopt;
        if (!number) { return fail("a coordinate, a finite number"); }
        p[c] = *number;
      }
      corners.push_back(vertex(p));
    }
    if (corners.size() < 3 || !is("endloop")) { return fail(corners.size() < 3 ? "vertex" : "vertex or endloop"); }
    if (!expect("endfacet")) { return false; }
    model_.polygon(corners, 0, static_cast<std::uint32_t>(model_.groups.size() - 1), line);
    return true;
  }

  // Goes to the next word of the file.
  bool next() {
    if (++word_ < lines_.words().size()) { return true; }
    word_ = 0;
    return lines_.next();
  }
  void pass_line() { word_ = lines_.words().size(); }
  [[nodiscard]] bool is(std::string_view word) const { return word_ < lines_.words().size() && same_letters(lines_.words()[word_], word); }
  bool expect(std::string_view word) { return (next() && is(word)) || fail(word); }
  // Reports that the present word is not the expected one.
  bool fail(std::string_view wanted) {
    const bool ended = word_ >= lines_.words().size();
    errors_.add(lines_.place(word_),
                "expected " + std::string(wanted) + (ended ? ", found the end of the file" : ", " + mesh_file::found(lines_, word_)));
    return false;
  }

  std::string_view bytes_;
  mesh_file::Lines lines_;
  std::size_t word_ = static_cast<std::size_t>(-1);
  std::map<std::array<double, 3>, std::uint32_t> vertices_;
  Model model_;
  Errors errors_;
};

bool begins_stl(std::string_view bytes) { return guess_kind(bytes).kind == FileKind::stl; }
ModelResult read_stl(std::string_view bytes, const SideFile&) { return StlReader(bytes).run(); }

}  // namespace

constinit const ModelFormat stl{".stl", "STL", UpAxis::z, begins_stl, read_stl};

}  // namespace apps::intake
