// SPDX-License-Identifier: MIT
#pragma once

// The scene graph of VRML 1.0 (Bell, Parisi, Pesce 1995), the second format of the paper: nodes with fields and children; a node may be
// used in several places (USE). It is walked once from its root. Nodes that are not shapes change a state (transform, materials,
// coordinates, hints), which applies to the shapes after them. A Separator confines the changes made by its children, a Group does not.
//
// In VRML 97 (ISO/IEC 14772-1:1997) children, materials and coordinates are values of fields, and every node confines its changes. Its
// nodes are walked in the same way: a Shape sets a state from its fields, to which its geometry refers.
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
  std::vector<double> numbers;     // of all values, concatenated
  std::vector<Place> places;       // of the numbers of index fields
  std::vector<std::string> words;  // strings, names of enumerated values
  std::vector<std::shared_ptr<const Node>> nodes;
  std::string is;  // if not empty: the value is that of the prototype's field of this name
};

// Fields are shared by several nodes, because every instance of a prototype has those of its body.
using Fields = std::map<std::string, std::shared_ptr<const Field>, std::less<>>;

struct Node {
  std::string type, name;  // name: given by DEF, or empty
  Place place;
  std::shared_ptr<const std::string> file;  // named by the scene, in which the node stands; null: the scene itself
  Version version = Version::v1;
  Fields fields;
  std::vector<std::shared_ptr<const Node>> children;
  std::size_t height = 0;  // height of the tree below it; 0 for a leaf
  bool open = false;       // does its tree contain a value of a prototype's field?

  [[nodiscard]] const Field* find(std::string_view field) const {
    const auto found = fields.find(field);
    return found == fields.end() ? nullptr : found->second.get();
  }
  [[nodiscard]] const Node* node(std::string_view field) const {  // null: none
    const Field* const found = find(field);
    return found == nullptr || found->nodes.empty() ? nullptr : found->nodes[0].get();
  }
  [[nodiscard]] bool is_false(std::string_view field) const { return word(field, "") == "FALSE"; }
  // The value in the file, or else the default.
  [[nodiscard]] double number(std::string_view field, double otherwise) const;
  [[nodiscard]] glm::dvec3 vector(std::string_view field, const glm::dvec3& otherwise) const;
  [[nodiscard]] glm::dvec4 rotation(std::string_view field) const;  // axis and angle; default (0, 0, 1, 0)
  [[nodiscard]] std::string_view word(std::string_view field, std::string_view otherwise) const;
};

[[nodiscard]] inline std::string at_line(Place place, const std::shared_ptr<const std::string>& file) {
  return "at line " + std::to_string(place.line) + (file != nullptr ? " of " + *file : "");
}
[[nodiscard]] inline std::string at_line_of(const Node& node) { return at_line(node.place, node.file); }

inline constexpr GraphLimits graph_limits;

// --- node types with their fields: a value can only be parsed if the type of its field is known

// The form of a value: `count` numbers, with `many` any number of values in brackets; words and strings.
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
  bool group = false;  // may it have children?
};

// Null if there is no such node type.
[[nodiscard]] const NodeType* node_type(Version version, std::string_view name);
[[nodiscard]] const FieldType* field_type(const NodeType& node, std::string_view field);
// The type of this name, such as "SFFloat" or "MFVec3f"; null if there is none.
[[nodiscard]] const FieldType* named_type(std::string_view name);
// The names of all nodes.
[[nodiscard]] std::span<const NodeType> node_types(Version version);
[[nodiscard]] std::span<const NodeType> node_types_97();

// --- prototypes of VRML 97 (prototypes.cpp)

using FieldTypes = std::map<std::string, FieldType, std::less<>>;

struct Prototype {
  FieldTypes types;
  Fields defaults;                   // values of its fields without given values
  std::shared_ptr<const Node> root;  // the node of which an instance is a copy; null: it is in another file, which cannot be read
};

// The prototypes known at a place, by nested scopes: those declared in the body of another prototype end with it.
class Prototypes {
 public:
  void enter() { scopes_.emplace_back(); }
  void leave() { scopes_.pop_back(); }
  void declare(const std::string& name, std::shared_ptr<const Prototype> prototype) {
    if (scopes_.size() == 1 && first_ == nullptr) { first_ = prototype; }
    scopes_.back()[name] = std::move(prototype);
  }
  // The innermost one of this name; null if there is none.
  [[nodiscard]] std::shared_ptr<const Prototype> find(std::string_view name) const;
  // The first one declared outside of all others; null if there is none.
  [[nodiscard]] const std::shared_ptr<const Prototype>& first() const { return first_; }

 private:
  std::vector<std::map<std::string, std::shared_ptr<const Prototype>, std::less<>>> scopes_{1};
  std::shared_ptr<const Prototype> first_;
};

// Sets `height` and `open` of the node. Those of its fields' nodes and children must already be set.
void settle(Node& node);

// The prototype's root with the values given to the instance, or else the defaults, inserted where the body refers to its fields. Only
// open nodes are copied; every copy is subtracted from the budget. Null if that is exhausted.
[[nodiscard]] std::shared_ptr<const Node> instance(const Prototype& prototype, const Fields& given, std::size_t& budget);

// --- reading and walking

struct ParsedFile {
  std::shared_ptr<const Node> root;  // of all nodes; null after errors
  Prototypes prototypes;
};

// The files that a scene names, by Inline and EXTERNPROTO, and the files that these name. Each is read once.
class OtherFiles {
 public:
  OtherFiles(const SideFile& side_file, Notes& notes) : side_file_(side_file), notes_(notes) {}

  // Null, and a note, if the file cannot be read; null if it is being read.
  const ParsedFile* read(const std::string& name, const std::string& place);
  // The prototype at a URL such as "a.wrl#Table" in this file; without a name the first one there. Null if it cannot be read.
  std::shared_ptr<const Prototype> prototype(std::string_view url, const std::shared_ptr<const std::string>& in, const std::string& place);

 private:
  const SideFile& side_file_;
  Notes& notes_;
  std::size_t depth_ = 0;  // files that are being read
  std::map<std::string, std::unique_ptr<ParsedFile>> files_;
};

// The name, as seen from the scene, of what a file names by this URL; empty if that is not beside the scene.
[[nodiscard]] std::string name_beside(const std::shared_ptr<const std::string>& file, std::string_view url);

// `file`: as in Node.
[[nodiscard]] ParsedFile parse(std::string_view text, Errors& errors, Notes& notes, OtherFiles& others,
                               const std::shared_ptr<const std::string>& file = nullptr);

// Which of the materials a part, a face or a corner uses.
enum class Binding : unsigned char { overall, per_part, per_part_indexed, per_face, per_face_indexed, per_vertex, per_vertex_indexed };

struct State {
  glm::dmat4 transform{1.0};
  const Node* material = nullptr;     // null: the default one
  const Node* coordinates = nullptr;  // null: none
  const Node* texture = nullptr;      // null: none
  const Node* colors = nullptr;       // VRML 97: replaces the material's diffuse colour; null: none
  const Node* named = nullptr;        // VRML 97: the last named node on the path to here; null: none
  Binding binding = Binding::overall;
  bool ordered = false, clockwise = false, solid = false, creased = false;  // ShapeHints; creased: with an angle above 0
};

[[nodiscard]] inline glm::dvec3 placed(const State& state, const glm::dvec3& p) { return glm::dvec3(state.transform * glm::dvec4(p, 1.0)); }

// --- cameras and lights (views.cpp)

void add_camera(Model& model, const Node& node, const State& state, Notes& notes);
void add_light(Model& model, const Node& node, const State& state);

// --- the meaning of nodes for the walk (traverse.cpp)

// Does the node change the state for the nodes after it? If so, changes it.
bool change(State& state, const Node& node);
// The children to walk: the selected one of a Switch, the finest of a LOD.
[[nodiscard]] std::vector<std::shared_ptr<const Node>> walked_children(const Node& node);
// Called when a node is left: undoes the changes of its children, if it confines them.
void restore(State& state, const State& before, const Node& node);
[[nodiscard]] inline bool is_camera(const Node& node) { return node.type.ends_with("Camera") || node.type == "Viewpoint"; }
// The state to which the geometry of a Shape refers.
[[nodiscard]] State state_of_shape(const Node& shape, const Node& geometry, const State& around);

// --- shapes of VRML 97 that become faces (swept_faces.cpp)

// The fields of a face set.
struct Faces {
  Field points, index;
};
[[nodiscard]] std::optional<Faces> elevation_grid(const Node& node);
[[nodiscard]] std::optional<Faces> extrusion(const Node& node);

// --- looks (looks.cpp)

// The picture of a texture node, for the shapes after it; null if it has none, or one that cannot be read, which is noted.
[[nodiscard]] std::shared_ptr<const intake::Picture> picture_of(const Node& texture, const SideFile& side_file, Notes& notes);

// Determines the material of a part, a face or a corner by the binding of its state, and converts it for the model: the diffuse colour is
// the reflectance; the emissive colour is a radiance L, so the exitance is pi L.
class Looks {
 public:
  // Indices of materials of a state; indices beyond the last one wrap around.
  using Numbers = std::vector<std::size_t>;

  // A face of a face set: its number, the number of corners of the faces before it, the position of its first corner among all indices.
  struct FaceCorners {
    const Field* indices = nullptr;
    std::size_t face = 0, before = 0, first = 0, count = 0;
  };

  Looks(Model& model, const SideFile& side_file, Notes& notes) : model_(model), side_file_(side_file), notes_(notes) {}

  // Index in the model of the material with these numbers; several materials are averaged.
  std::uint32_t material(const State& state, Numbers numbers, bool two_sided = false);

  // The numbers for a face. Materials of its corners should be interpolated; here a face has one colour.
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
