// SPDX-License-Identifier: MIT
#pragma once

// Parts of the MGF reader (mgf.cpp): lines, transforms, colours and materials, shapes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include <radiosity/scene/material.hpp>

#include "apps/input_errors.hpp"
#include "apps/intake/model.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake::mgf {

// A line of a file: its words and their places.
struct Line {
  std::vector<std::string_view> words;
  std::vector<Place> places;  // one more than words: the last is the end of the line

  [[nodiscard]] std::string_view word(std::size_t i) const { return i < words.size() ? words[i] : std::string_view(); }
  [[nodiscard]] Place place(std::size_t i) const { return places[i < words.size() ? i : words.size()]; }
};

// The place of the line, for notes.
[[nodiscard]] inline std::string at(const Line& line) { return "at line " + std::to_string(line.place(0).line); }

// The word as a finite number of at most max_number; otherwise reports an error and returns 0.
[[nodiscard]] double number(const Line& line, std::size_t word, Errors& errors);

// The arguments of xf and i in MGF: -t x y z, -rx -ry -rz degrees, -s factor, -mx -my -mz; each applies to the result of those before it.
// -i N repeats the transforms after it N times. -a N makes N copies; the transforms after it apply 0, 1, ... N - 1 times.
class Transforms {
 public:
  // Parses the words from number `first` on.
  Transforms(const Line& line, std::size_t first, Errors& errors);

  [[nodiscard]] std::size_t copies() const { return copies_; }
  [[nodiscard]] glm::dmat4 copy(std::size_t i) const;

 private:
  struct Part {
    glm::dmat4 matrix{1.0};
    std::size_t count = 1;
    bool array = false;
  };
  std::vector<Part> parts_{{}};
  std::size_t copies_ = 1;
};

// Maximal number of copies by one xf.
inline constexpr std::size_t most_copies = 100'000;

struct Chroma {  // CIE 1931
  double x = 1.0 / 3.0, y = 1.0 / 3.0;
};
struct Material {
  std::string name = "default";
  bool two_sided = true;
  radiosity::Color reflectance{0.0}, emission{0.0}, mirror{0.0};
  double diffused = 0.0, transmitted = 0.0;  // shares of the light that passes through: td, ts
  std::optional<std::uint32_t> number;       // its index in the model after its first use; a change resets it
};
struct Vertex {
  glm::dvec3 position{0.0}, normal{0.0};
};

// Colours, materials and vertices of MGF are contexts: "m" selects an unnamed one with default values, "m NAME" a known one, "m NAME =" a
// new one with default values, "m NAME = OTHER" a copy of another. The following lines change the selected one.
template <class Value>
class Contexts {
 public:
  // Selects the context named after the keyword; an error if the name is unknown.
  void choose(const Line& line, Errors& errors) {
    const std::string name(line.word(1));
    if (name.empty() || line.word(2) == "=") {
      Value fresh;
      if (line.words.size() > 3) {
        const Value* const like = find(line, 3, errors);
        if (like == nullptr) { return; }
        fresh = *like;
      }
      current_ = &values_.emplace_back(std::move(fresh));
      if (!name.empty()) { names_[name] = current_; }
    } else if (Value* const known = find(line, 1, errors)) {
      current_ = known;
    }
  }
  Value* find(const Line& line, std::size_t word, Errors& errors) {
    const auto found = names_.find(line.word(word));
    if (found != names_.end()) { return found->second; }
    errors.add(line.place(word), "there is no " + std::string(what_) + " " + mesh_file::shown(line.word(word)));
    return nullptr;
  }
  explicit Contexts(std::string_view what) : what_(what) {}
  Contexts(const Contexts&) = delete;
  Contexts& operator=(const Contexts&) = delete;
  Value& current() { return *current_; }

 private:
  std::string_view what_;
  std::deque<Value> values_{Value{}};
  Value* current_ = &values_.front();
  std::map<std::string, Value*, std::less<>> names_;
};

// The entities of MGF about colours and materials: c with cxy, cspec, cct, cmix; m with sides, rd, rs, ed, td, ts.
class Looks {
 public:
  Looks(Model& model, Notes& notes) : model_{model}, notes_{notes} {}

  // Executes the line; false if its entity is not one of these.
  bool take(const Line& line, Errors& errors);

  // Index of the current material in the model.
  [[nodiscard]] std::uint32_t material();

 private:
  void choose_color(const Line& line, Errors& errors) { colors_.choose(line, errors); }
  void chromaticity(const Line& line, Errors& errors);
  void temperature(const Line& line, Errors& errors);
  void spectrum(const Line& line, Errors& errors);
  void mixture(const Line& line, Errors& errors);
  void choose_material(const Line& line, Errors& errors);
  void sides(const Line& line, Errors& errors) { changed().two_sided = number(line, 1, errors) != 1.0; }
  void reflectance(const Line& line, Errors& errors);
  void emission(const Line& line, Errors& errors);
  void mirror(const Line& line, Errors& errors);
  void transmittance(const Line& line, Errors& errors);

  void set_color(const glm::dvec3& xyz);
  Material& changed();

  Model& model_;
  Notes& notes_;
  Contexts<Chroma> colors_{"colour"};
  Contexts<Material> materials_{"material"};
};

// Vertices and shapes of MGF: v with p and n; f, fh, prism, sph, torus, cyl, cone, ring. Spheres and tori remain analytic; open shapes
// (cylinders and cones without ends, rings) become polygons, all with the same number of sides, so that they fit together.
class Shapes {
 public:
  Shapes(Model& model, Notes& notes, Looks& looks) : model_{model}, notes_{notes}, looks_{looks} {}

  glm::dmat4 transform{1.0};  // from the coordinates of shapes to those of the model
  std::string name;           // for analytic shapes; empty: their kind

  // Executes the line; false if its entity is not one of these.
  bool take(const Line& line, Errors& errors);

 private:
  void choose_vertex(const Line& line, Errors& errors) { vertices_.choose(line, errors); }
  void position(const Line& line, Errors& errors) { vertices_.current().position = vector(line, errors); }
  void normal(const Line& line, Errors& errors) { vertices_.current().normal = vector(line, errors); }
  void face(const Line& line, Errors& errors);
  void face_with_holes(const Line& line, Errors& errors);
  void prism(const Line& line, Errors& errors);
  void sphere(const Line& line, Errors& errors);
  void torus(const Line& line, Errors& errors);
  void cylinder(const Line& line, Errors& errors) { strip_between_vertices(line, 2, errors); }
  void cone(const Line& line, Errors& errors) { strip_between_vertices(line, 4, errors); }
  void ring(const Line& line, Errors& errors);

  [[nodiscard]] static glm::dvec3 vector(const Line& line, Errors& errors);
  // The positions of the vertices named by the words [first, end); fewer after an error.
  [[nodiscard]] std::vector<glm::dvec3> positions_of(const Line& line, std::size_t first, std::size_t end, Errors& errors);
  void polygon(std::vector<glm::dvec3> corners, const Line& line);
  void solid(const char* kind, std::shared_ptr<const raycast::Object> object, bool from_within, const Line& line);
  void strip_between_vertices(const Line& line, std::size_t second_radius, Errors& errors);
  void strip(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& axis, double from, double to, const Line& line);

  Model& model_;
  Notes& notes_;
  Looks& looks_;
  Contexts<Vertex> vertices_{"vertex"};
  std::map<std::array<double, 3>, std::uint32_t> positions_;
};

}  // namespace apps::intake::mgf
