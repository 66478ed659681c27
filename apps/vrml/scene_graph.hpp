// SPDX-License-Identifier: MIT
#pragma once

// The scene graph of VRML 1.0 (Bell, Parisi, Pesce 1995), the second format of the paper: nodes with fields and children, of which one may
// stand in many places (USE). It is walked once from its root. Nodes that are no shapes change a state, which shapes then find: transform,
// materials, coordinates, hints. A Separator keeps what its children change to itself, a Group does not.
//
//     text -> parse() -> Node ... -> traverse(root, visitor): the visitor is told of every shape, camera and light, with its state
//
// Whatever is to be done with a scene is a visitor: model.cpp makes polygons and objects of it.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <radiosity/scene/material.hpp>

#include "apps/graph_walk.hpp"
#include "apps/input_errors.hpp"
#include "apps/intake/model.hpp"

namespace apps::vrml {

struct Field {
  Place place;
  std::vector<double> numbers;     // of all values, one after the other
  std::vector<Place> places;       // of the numbers of indices
  std::vector<std::string> words;  // strings, names of values
};

struct Node {
  std::string type, name;  // name: by DEF, or empty
  Place place;
  std::map<std::string, Field, std::less<>> fields;
  std::vector<std::shared_ptr<const Node>> children;

  [[nodiscard]] const Field* find(std::string_view field) const {
    const auto found = fields.find(field);
    return found == fields.end() ? nullptr : &found->second;
  }
  // What the file says, or what holds without.
  [[nodiscard]] double number(std::string_view field, double otherwise) const;
  [[nodiscard]] glm::dvec3 vector(std::string_view field, const glm::dvec3& otherwise) const;
  [[nodiscard]] glm::dvec4 rotation(std::string_view field) const;  // axis and angle; (0, 0, 1, 0)
  [[nodiscard]] std::string_view word(std::string_view field, std::string_view otherwise) const;
};

inline constexpr GraphLimits graph_limits;

// The nodes of the text under one root, or errors.
[[nodiscard]] std::shared_ptr<const Node> parse(std::string_view text, Errors& errors, Notes& notes);

// The mean colour that a Texture2 node gives to what follows it; nothing when it has no picture, or one that cannot be read, which is
// noted.
[[nodiscard]] std::optional<radiosity::Color> mean_of_texture(const Node& texture, const SideFile& side_file, Notes& notes);

// Which of the materials a part, a face or a corner has.
enum class Binding : unsigned char { overall, per_part, per_part_indexed, per_face, per_face_indexed, per_vertex, per_vertex_indexed };

struct State {
  glm::dmat4 transform{1.0};
  const Node* material = nullptr;     // null: the default one
  const Node* coordinates = nullptr;  // null: none
  const Node* texture = nullptr;      // null: none
  Binding binding = Binding::overall;
  bool ordered = false, clockwise = false, solid = false, creased = false;  // ShapeHints; creased: with an angle above 0
};

class Visitor {
 public:
  Visitor() = default;
  Visitor(const Visitor&) = delete;
  Visitor& operator=(const Visitor&) = delete;
  virtual ~Visitor() = default;
  virtual void shape(const Node& node, const State& state) = 0;
  virtual void camera(const Node& node, const State& state) = 0;
  virtual void light(const Node& node, const State& state) = 0;
  // A file that is to stand in the place of the node; null when there is none.
  [[nodiscard]] virtual std::shared_ptr<const Node> inlined(const Node& node) = 0;
};

// False: given up at a limit.
[[nodiscard]] bool traverse(const std::shared_ptr<const Node>& root, Visitor& visitor);

}  // namespace apps::vrml
