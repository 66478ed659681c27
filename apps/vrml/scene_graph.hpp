// SPDX-License-Identifier: MIT
#pragma once

// The scene graph of VRML 1.0 (Bell, Parisi, Pesce 1995), the second format of the paper: nodes with fields and children, of which one may
// stand in many places (USE). It is walked once from its root. Nodes that are no shapes change a state, which shapes then find: transform,
// materials, coordinates, hints. A Separator keeps what its children change to itself, a Group does not.
//
// In VRML 97 (ISO/IEC 14772-1:1997) children, materials and coordinates are values of fields, and every node keeps its changes to itself.
// Its nodes are walked in the same way: a Shape fills a state with what its fields say, and its geometry finds that.
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

enum class Version : unsigned char { v1, v97 };

struct Node;

struct Field {
  Place place;
  std::vector<double> numbers;     // of all values, one after the other
  std::vector<Place> places;       // of the numbers of indices
  std::vector<std::string> words;  // strings, names of values
  std::vector<std::shared_ptr<const Node>> nodes;
  std::string is;  // not empty: the value is that of the prototype's field of this name
};

// A field may be the value of many nodes, because every instance of a prototype has those of its body.
using Fields = std::map<std::string, std::shared_ptr<const Field>, std::less<>>;

struct Node {
  std::string type, name;  // name: by DEF, or empty
  Place place;
  Version version = Version::v1;
  Fields fields;
  std::vector<std::shared_ptr<const Node>> children;
  std::size_t height = 0;  // of the tree below it; 0: nothing is below
  bool open = false;       // a value in this tree is that of a prototype's field

  [[nodiscard]] const Field* find(std::string_view field) const {
    const auto found = fields.find(field);
    return found == fields.end() ? nullptr : found->second.get();
  }
  [[nodiscard]] const Node* node(std::string_view field) const {  // null: none
    const Field* const found = find(field);
    return found == nullptr || found->nodes.empty() ? nullptr : found->nodes[0].get();
  }
  [[nodiscard]] bool is_false(std::string_view field) const { return word(field, "") == "FALSE"; }
  // What the file says, or what holds without.
  [[nodiscard]] double number(std::string_view field, double otherwise) const;
  [[nodiscard]] glm::dvec3 vector(std::string_view field, const glm::dvec3& otherwise) const;
  [[nodiscard]] glm::dvec4 rotation(std::string_view field) const;  // axis and angle; (0, 0, 1, 0)
  [[nodiscard]] std::string_view word(std::string_view field, std::string_view otherwise) const;
};

[[nodiscard]] inline std::string at_line_of(const Node& node) { return "at line " + std::to_string(node.place.line); }

inline constexpr GraphLimits graph_limits;

// --- the nodes with their fields: what stands behind the name of a field can only be read when its type is known.

// How a value is written: so many numbers; in brackets any number of them (`many`); words and strings.
struct FieldType {
  enum class Kind : unsigned char { numbers, indices, image, strings, words, nodes };
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
[[nodiscard]] const NodeType* node_type(Version version, std::string_view name);
[[nodiscard]] const FieldType* field_type(const NodeType& node, std::string_view field);
// "SFFloat", "MFVec3f"; null when there is no such type.
[[nodiscard]] const FieldType* named_type(std::string_view name);
// The names of all nodes.
[[nodiscard]] std::span<const NodeType> node_types(Version version);
[[nodiscard]] std::span<const NodeType> node_types_97();

// --- prototypes of VRML 97 (prototypes.cpp)

using FieldTypes = std::map<std::string, FieldType, std::less<>>;

struct Prototype {
  FieldTypes types;                  // of its fields and events
  Fields defaults;                   // of its fields
  std::shared_ptr<const Node> root;  // what stands in the place of an instance; null: it is in another file
};

// Those that are known at a place. Those that are declared in the body of another one end with it.
class Prototypes {
 public:
  void enter() { scopes_.emplace_back(); }
  void leave() { scopes_.pop_back(); }
  void declare(const std::string& name, std::shared_ptr<const Prototype> prototype) { scopes_.back()[name] = std::move(prototype); }
  // The innermost of this name; null when there is none.
  [[nodiscard]] std::shared_ptr<const Prototype> find(std::string_view name) const;

 private:
  std::vector<std::map<std::string, std::shared_ptr<const Prototype>, std::less<>>> scopes_{1};
};

// Finds out how high the tree below the node is, and whether it is open. Those of its fields and children must be known.
void settle(Node& node);

// The prototype's root in which values given to the instance, or else the defaults, are put where the body names its fields. Only what is
// open is copied; every copy is taken from the budget. Null when that is used up.
[[nodiscard]] std::shared_ptr<const Node> instance(const Prototype& prototype, const Fields& given, std::size_t& budget);

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
  const Node* colors = nullptr;       // of VRML 97: in the place of the material's diffuse colour; null: none
  const Node* named = nullptr;        // of VRML 97: the last node with a name on the way here; null: none
  Binding binding = Binding::overall;
  bool ordered = false, clockwise = false, solid = false, creased = false;  // ShapeHints; creased: with an angle above 0
};

[[nodiscard]] inline glm::dvec3 placed(const State& state, const glm::dvec3& p) { return glm::dvec3(state.transform * glm::dvec4(p, 1.0)); }

// --- cameras and lights (views.cpp)

void add_camera(Model& model, const Node& node, const State& state, Notes& notes);
void add_light(Model& model, const Node& node, const State& state, Notes& notes);

// --- what nodes mean to the walk (traverse.cpp)

// Does the node change what follows it? The state is changed.
bool change(State& state, const Node& node);
// The children that are walked: of a Switch the chosen one, of a LOD the finest.
[[nodiscard]] std::vector<std::shared_ptr<const Node>> walked_children(const Node& node);
// When a node is left: takes back what its children have changed, if it keeps that to itself.
void restore(State& state, const State& before, const Node& node);
[[nodiscard]] inline bool is_camera(const Node& node) { return node.type.ends_with("Camera") || node.type == "Viewpoint"; }
// What the geometry of a Shape finds.
[[nodiscard]] State state_of_shape(const Node& shape, const Node& geometry, const State& around);

// --- shapes of VRML 97 that become faces (swept_faces.cpp)

// As a face set has them.
struct Faces {
  Field points, index;
};
[[nodiscard]] std::optional<Faces> elevation_grid(const Node& node);
[[nodiscard]] std::optional<Faces> extrusion(const Node& node);

// --- looks (looks.cpp)

// The picture that a texture node gives to what follows it; null when it has none, or one that cannot be read, which is noted.
[[nodiscard]] std::shared_ptr<const intake::Picture> picture_of(const Node& texture, const SideFile& side_file, Notes& notes);

// Which material a part, a face or a corner has by the binding of its state, and what of it the model needs: the diffuse colour is the
// reflectance, the emissive colour a radiance L, so that the exitance is pi L.
class Looks {
 public:
  // Among the materials of a state; those beyond the last begin again with the first.
  using Numbers = std::vector<std::size_t>;

  // A face of a face set: its number, how many corners the faces before it have, where its first one stands among all indices.
  struct FaceCorners {
    const Field* indices = nullptr;
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
  intake::Pictures<const Node*> pictures_;
  std::map<std::tuple<const Node*, const Node*, const Node*, Numbers, bool>, std::uint32_t> known_;
};

}  // namespace apps::vrml
