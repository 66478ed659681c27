// SPDX-License-Identifier: MIT
#pragma once

// Builds objects from the statements of a scene: every object is made once, then placed as often as its group is used.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/scene/scene.hpp>

#include "apps/input_errors.hpp"
#include "apps/scene_file.hpp"
#include "apps/scene_file/lexer.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// --- groups (groups.cpp)
//
// The use of groups by other groups. A group that uses itself, directly or indirectly, is refused; so is nesting beyond max_use_depth and
// a scene with more than max_objects objects: both are found by counting, before anything is placed. A use among the operands of a solid
// represents the union of the group's objects.

// Maximal number of operands that uses may add to one solid: nested uses multiply, and the solid is evaluated while the file is read.
inline constexpr std::size_t max_used_operands = 2000;

class Groups {
 public:
  // Reports duplicate names, empty groups, uses of unknown groups, cycles and nesting that is too deep.
  Groups(const SceneSyntax& syntax, Errors& errors);

  // The group of this name, or null.
  [[nodiscard]] const GroupSyntax* find(const Name& group) const;
  // Number of objects that one use of the group places; saturates above max_objects.
  [[nodiscard]] std::size_t size(const GroupSyntax& group) const;

  // Replaces uses among the operands of a union, intersection or difference, also nested ones, by the objects of their groups. False
  // after an error: unknown groups, cycles, too deep nesting, too many operands.
  bool expand(ObjectSyntax& syntax, Errors& errors) const;

 private:
  enum class State : unsigned char { unseen, open, done };
  struct Entry {
    State state = State::unseen;
    std::size_t size = 0;
    std::size_t depth = 1;
  };
  void visit(std::size_t root, Errors& errors);
  struct Expansion {
    std::vector<const GroupSyntax*> open;  // that contain the operand
    std::size_t operands = 0;
  };
  bool expand(ObjectSyntax& syntax, std::size_t depth, Expansion& expansion, Errors& errors) const;
  void report_unknown(const Name& group, Errors& errors) const;

  const SceneSyntax* syntax_;
  std::unordered_map<std::string_view, std::size_t> index_;
  std::vector<Entry> entries_;  // one per group
};

// The statements of a scene as a graph (apps/graph_walk.hpp): the children of the root are the statements of the file, those of a use are
// the statements of its group. The placement and name prefix of a node hold only for its descendants.
//
// Called once for every use of an object, with the names of the uses around it ("first."), their placement, and the place of the
// outermost statement in the file.
using PlaceObject = std::function<void(const ObjectSyntax& object, const std::string& prefix, const raycast::Placement& outer, Place at)>;

// Walks all uses in the order of the file; ends at the first error, or if the scene exceeds max_objects.
void place_all(const std::vector<Item>& items, const Groups& groups, Errors& errors, const PlaceObject& place);

// --- the whole scene

// The scene of the statements; invalid if errors were added.
[[nodiscard]] SceneFile build(const SceneSyntax& syntax, const SideFile& side_file, Errors& errors);

// A camera from valid syntax, with its up direction.
[[nodiscard]] radiosity::Camera make_camera(const CameraSyntax& syntax, Errors& errors);

// (csg.cpp) A union, intersection or difference, and the shapes of its leaves in the order of the file. Its sheets are those of the leaves.
struct CsgShape {
  Shape whole;  // null after an error
  std::vector<Shape> leaves;
};
[[nodiscard]] CsgShape make_csg(const ObjectSyntax& syntax, Errors& errors);

// --- meshes from files of other programs (build_meshes.cpp)
//
// Polygons around a camera or a lamp of the scene are seen from inside, as they would be within their own file, so a mesh is made again
// if one of them lies within its bounds. A mesh of a group is made at most twice, for uses with and without a camera or lamp inside.

// The objects of the file, in its own coordinates, made by to_part(). Nothing after an error.
[[nodiscard]] std::optional<SceneFile> mesh_from_file(const ObjectSyntax& object, const SideFile& side_file,
                                                      const std::vector<glm::dvec3>& eyes, Errors& errors);

// The bounds of all parts of a mesh.
[[nodiscard]] raycast::Box bounds_of(const std::vector<radiosity::SceneObject>& parts);

// The point in the coordinates before the placement; nothing if the placement is not invertible.
[[nodiscard]] std::optional<glm::dvec3> point_within(const raycast::Placement& placement, const glm::dvec3& point);

// Points of a scene that must be visible: the eyes of cameras, and points in front of lamps.
class Eyes {
 public:
  void add(const radiosity::Camera& camera) { points_.push_back({camera.eye, nullptr, count_++}); }
  // Adds a point in front of each emitting sheet of the object. `of`: the statement from which it comes.
  void add_lamps(const radiosity::SceneObject& placed, const std::vector<radiosity::Material>& materials, const ObjectSyntax* of);

  // Adds an object that may be a room around others, with its bounds in the scene.
  void add_room(const raycast::Box& bounds, const ObjectSyntax* of) { rooms_.push_back({bounds, of}); }

  // The points in this box of a mesh, in the coordinates of the mesh. The mesh's own lamps are excluded, because its file takes account
  // of them. A lamp counts if at least half of its points are there: one that stands on an object may reach into it. A lamp partly
  // outside the mesh pierces an object, as a bracket does a column, if some object at least twice as large contains both; otherwise the
  // mesh is a room and the lamp is set into its wall.
  [[nodiscard]] std::vector<glm::dvec3> within(const raycast::Box& box, const raycast::Placement& placement,
                                               const ObjectSyntax* mesh) const;

 private:
  static constexpr std::size_t most = 1000;
  struct Room {
    raycast::Box bounds;
    const ObjectSyntax* of = nullptr;
  };
  [[nodiscard]] bool larger_room(const raycast::Box& mesh, std::size_t first, std::size_t end, const ObjectSyntax* of) const;
  struct Point {
    glm::dvec3 position{0.0};
    const ObjectSyntax* of = nullptr;
    std::size_t lamp = 0;  // number of the camera or lamp to which it belongs
  };
  std::vector<Point> points_;  // points of one lamp are adjacent
  std::vector<Room> rooms_;
  std::size_t count_ = 0;  // number of cameras and lamps
};

// --- the builder

// An object with its shape and materials, made once, however often its group is used.
struct Made {
  std::shared_ptr<const raycast::Object> shape;
  std::vector<std::uint32_t> material;
  // For a mesh from a file, instead of `shape`: its parts, and those for uses with a camera or lamp inside (empty: the same).
  std::vector<radiosity::SceneObject> parts = {}, around_eyes = {};
  std::vector<std::string> notes = {};
  std::uint32_t first_material = 0;  // index in the scene of the first material of the file
};

using SheetNames = std::unordered_map<std::string_view, std::uint32_t>;

class Builder {
 public:
  Builder(const SceneSyntax& syntax, const SideFile& side_file, Errors& errors)
      : syntax_(syntax), side_file_(side_file), errors_(errors), groups_(syntax, errors) {}
  SceneFile build();

 private:
  void materials();
  void cameras();
  void unique_names(const std::vector<Item>& items);
  void make(const std::vector<Item>& items);
  std::optional<std::uint32_t> material_index(const Name& name);
  std::vector<std::uint32_t> sheet_materials(const ObjectSyntax& object, const raycast::Object& shape, const Name* around = nullptr);
  Made make(const ObjectSyntax& object);
  Made make_from_file(const ObjectSyntax& object);
  void take_parts(SceneFile part, const ObjectSyntax& object, std::uint32_t first, std::vector<radiosity::SceneObject>& parts);
  [[nodiscard]] std::vector<glm::dvec3> eyes_of(const ObjectSyntax& object) const;
  void see_from_inside();
  void operand_materials(const ObjectSyntax& object, const Name* around, const CsgShape& csg, std::size_t& leaf,
                         std::vector<std::uint32_t>& out);
  std::uint32_t sheet_index(const Name& sheet, const raycast::Object& shape, const SheetNames& names);
  void place();
  void place(const ObjectSyntax& object, const std::string& prefix, const raycast::Placement& outer, Place at);
  void place(radiosity::SceneObject placed, const ObjectSyntax& object, Place at);
  [[nodiscard]] bool stands_alone(const ObjectSyntax& object) const;

  const SceneSyntax& syntax_;
  const SideFile& side_file_;
  Errors& errors_;
  const Groups groups_;
  SceneFile file_;
  std::unordered_map<std::string_view, std::uint32_t> material_index_;
  std::vector<std::string_view> material_names_;
  std::unordered_map<const ObjectSyntax*, Made> made_;
  Eyes eyes_;
};

}  // namespace apps::scene_file
