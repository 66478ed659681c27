// SPDX-License-Identifier: MIT
#pragma once

// The scene graph of VRML 1.0 (Bell, Parisi, Pesce 1995), the second format of the paper: nodes with fields and children, of which one may
// stand in many places (USE). It is walked once from its root. Nodes that are no shapes change a state, which shapes then find: transform,
// materials, coordinates, hints. A Separator keeps what its children change to itself, a Group does not.
//
//     text -> parse() -> Node ... -> GraphWalk, with a state: model.cpp makes polygons and objects of every shape, camera and light

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <radiosity/scene/material.hpp>

#include "apps/graph_walk.hpp"
#include "apps/input_errors.hpp"
#include "apps/intake/model.hpp"
#include "apps/intake/texture.hpp"

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

// --- the nodes of VRML 1.0 with their fields: what stands behind the name of a field can only be read when its type is known.

// How a value is written: so many numbers; in brackets any number of them (`many`); words and strings.
struct FieldType {
  enum class Kind : unsigned char { numbers, indices, image, strings, words };
  Kind kind = Kind::numbers;
  unsigned char count = 1;
  bool many = false;
};

struct FieldEntry {
  std::string_view name;
  FieldType type;
};

struct NodeType {
  std::string_view name;
  std::vector<FieldEntry> fields;
  bool group = false;  // may have children
};

// Null when there is no such node.
[[nodiscard]] const NodeType* node_type(std::string_view name);
[[nodiscard]] const FieldType* field_type(const NodeType& node, std::string_view field);
// "SFFloat", "MFVec3f"; null when there is no such type.
[[nodiscard]] const FieldType* named_type(std::string_view name);
// The names of all nodes.
[[nodiscard]] std::span<const NodeType> node_types();

// --- reading and walking

// The nodes of the text under one root, or errors.
[[nodiscard]] std::shared_ptr<const Node> parse(std::string_view text, Errors& errors, Notes& notes);

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

// --- what nodes mean to the walk (traverse.cpp)

// Does the node change what follows it? The state is changed.
bool change(State& state, const Node& node);
// The children that are walked: of a Switch the chosen one, of a LOD the finest.
[[nodiscard]] std::vector<std::shared_ptr<const Node>> walked_children(const Node& node);
// When a node is left: takes back what its children have changed, if it keeps that to itself.
void restore(State& state, const State& before, const Node& node);
[[nodiscard]] inline bool is_camera(const Node& node) { return node.type.ends_with("Camera"); }

// --- looks (looks.cpp)

// The mean colour that a Texture2 node gives to what follows it; nothing when it has no picture, or one that cannot be read, which is
// noted.
[[nodiscard]] std::optional<radiosity::Color> mean_of_texture(const Node& texture, const SideFile& side_file, Notes& notes);

// Which material a part, a face or a corner has by the binding of its state, and what of it the model needs: the diffuse colour is the
// reflectance, the emissive colour a radiance L, so that the exitance is pi L.
class Looks {
 public:
  // Among the materials of a state; those beyond the last begin again with the first.
  using Numbers = std::vector<std::size_t>;

  // A face of a face set: its number, how many corners the faces before it have, where its first one stands among all indices.
  struct FaceCorners {
    std::size_t face = 0, before = 0, first = 0, count = 0;
  };

  Looks(Model& model, const SideFile& side_file, Notes& notes) : model_(model), side_file_(side_file), notes_(notes) {}

  // The number in the model of the material with these numbers; of several the mean of their colours.
  std::uint32_t material(const State& state, Numbers numbers, bool two_sided = false);

  // Those of a face. Corners of different materials blend into each other; a face has one colour here.
  [[nodiscard]] Numbers numbers(const Node& face_set, const State& state, const FaceCorners& of);

 private:
  [[nodiscard]] ModelMaterial made(const State& state, const Numbers& numbers, std::size_t all);

  Model& model_;
  const SideFile& side_file_;
  Notes& notes_;
  intake::PictureMeans<const Node*> pictures_;
  std::map<std::tuple<const Node*, const Node*, Numbers, bool>, std::uint32_t> known_;
};

}  // namespace apps::vrml
