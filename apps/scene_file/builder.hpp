// SPDX-License-Identifier: MIT
#pragma once

// From the statements of a scene to its objects: every object is made once, then placed as often as its group is used.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/scene/scene.hpp>

#include "apps/input_errors.hpp"
#include "apps/scene_file.hpp"
#include "apps/scene_file/build.hpp"
#include "apps/scene_file/groups.hpp"
#include "apps/scene_file/mesh_from_file.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// An object with its shape and materials, made once however often its group is used.
struct Made {
  std::shared_ptr<const raycast::Object> shape;
  std::vector<std::uint32_t> material;
  // Of a mesh from a file, in place of one shape: its parts, and how they are where a camera or a lamp lies among them (empty: no other).
  std::vector<radiosity::SceneObject> parts = {}, around_eyes = {};
  std::vector<std::string> notes = {};
  std::uint32_t first_material = 0;  // of the file, in the scene
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
