// SPDX-License-Identifier: MIT
#pragma once

// The output of the parser for the builder: the statements of the file, with the places needed for later errors. Names are not
// resolved yet. A statement with an error is kept with sound == false: its name is known, so that statements that refer to it
// are not reported, but it is not built.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/transform.hpp>

#include "apps/scene_file.hpp"
#include "apps/scene_file/grammar.hpp"

namespace apps::scene_file {

struct Name {
  std::string text;
  Place place;
};

// The numbers of a clause: one, two or three.
struct Given {
  std::string_view word;
  Place place;
  std::array<double, 3> numbers{};
};

struct PlacedVertex {
  glm::dvec3 value{0.0};
  Place place;
  std::size_t digits = 0;  // largest number of significant digits of its coordinates
};

struct MaterialSyntax {
  Name name;
  radiosity::Color reflectance{0.0};
  radiosity::Color emission{0.0};
};

struct CameraSyntax {
  radiosity::Camera camera;
  Place place;  // of the name
  bool sound = true;
};

struct SheetSyntax {
  Name sheet;
  Name material;
};

struct FaceSyntax {
  std::uint32_t first = 0;  // into ObjectSyntax::corners
  std::uint32_t count = 0;
  Place place;
};

struct ObjectSyntax {
  const ObjectKind* kind = nullptr;
  Name name;
  bool sound = true;
  std::optional<Name> material;
  std::vector<SheetSyntax> sheets;
  raycast::Placement placement;
  std::optional<Place> inside;
  std::optional<Name> file;        // of a mesh in another file
  std::optional<Place> two_sided;  // of such a mesh: surfaces that enclose nothing reflect on both sides
  std::vector<Given> given;        // clauses of its own kind from the grammar table, except for vertices and faces
  std::vector<PlacedVertex> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<FaceSyntax> faces;
  std::vector<ObjectSyntax> operands;
  std::optional<Name> group;  // of a use among operands, stored as a union: its operands are the objects of this group

  // Null if the clause was not given.
  [[nodiscard]] const Given* find(std::string_view word) const {
    const auto found = std::find_if(given.begin(), given.end(), [&](const Given& g) { return g.word == word; });
    return found == given.end() ? nullptr : &*found;
  }
  // The clause must have been given.
  [[nodiscard]] double number(std::string_view word) const { return find(word)->numbers[0]; }
  [[nodiscard]] glm::dvec3 vector(std::string_view word) const {
    const auto& [x, y, z] = find(word)->numbers;
    return {x, y, z};
  }
  [[nodiscard]] Place place(std::string_view word) const { return find(word)->place; }
};

struct UseSyntax {
  Name group;
  Name name;
  raycast::Placement placement;
  bool sound = true;
};

// Converts a use among operands to a union of the group's objects.
[[nodiscard]] inline ObjectSyntax as_operand(const UseSyntax& use) {
  ObjectSyntax result;
  result.kind = kind_of("union");
  result.name = use.name;
  result.sound = use.sound;
  result.placement = use.placement;
  result.group = use.group;
  return result;
}

using Item = std::variant<ObjectSyntax, UseSyntax>;

struct GroupSyntax {
  Name name;
  std::vector<Item> items;
};

struct SceneSyntax {
  std::vector<MaterialSyntax> materials;
  std::vector<CameraSyntax> cameras;
  std::vector<GroupSyntax> groups;
  std::vector<Item> items;
  bool complete = true;  // false: reading stopped before the end of the text
};

}  // namespace apps::scene_file
