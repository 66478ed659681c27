// SPDX-License-Identifier: MIT
#pragma once

// What the entities of MGF say of colours and materials: c with cxy, cspec, cct, cmix; m with sides, rd, ed. Mirrors and glass are noted.

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <glm/vec3.hpp>

#include <radiosity/scene/material.hpp>

#include "apps/input_errors.hpp"
#include "apps/intake/mgf_transform.hpp"
#include "apps/intake/model.hpp"
#include "apps/mesh_file/reading.hpp"

namespace apps::intake::mgf {

struct Chroma {  // CIE 1931
  double x = 1.0 / 3.0, y = 1.0 / 3.0;
};
struct Material {
  std::string name = "default";
  bool two_sided = true;
  radiosity::Color reflectance{0.0}, emission{0.0};
  std::uint32_t number = none;  // in the model, once something has it
  static constexpr std::uint32_t none = 0xffffffff;
};
struct Vertex {
  glm::dvec3 position{0.0}, normal{0.0};
};

// Colours, materials and vertices of MGF are contexts: "m" makes an unnamed one of defaults the current one, "m NAME" a known one,
// "m NAME =" a new one of defaults, "m NAME = OTHER" a new one like another. What follows changes the current one.
template <class Value>
class Contexts {
 public:
  // What the line says behind its keyword; an error for a name that is not known.
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

class Looks {
 public:
  Looks(Model& model, Notes& notes) : model_{model}, notes_{notes} {}

  // Carries the line out; false when its entity is none of these.
  bool take(const Line& line, Errors& errors);

  // The current material's number in the model.
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
  void mirror_or_glass(const Line& line, Errors& errors);

  void set_color(const glm::dvec3& xyz);
  Material& changed();

  Model& model_;
  Notes& notes_;
  Contexts<Chroma> colors_{"colour"};
  Contexts<Material> materials_{"material"};
};

}  // namespace apps::intake::mgf
