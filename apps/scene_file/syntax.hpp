// SPDX-License-Identifier: MIT
#pragma once

// What the parser hands to the builder: the statements of the file, each with the places that later errors need.
// Names are not resolved yet. A statement that had an error of its own is kept with sound == false: its name is
// known, so that nothing that refers to it is blamed, but it is not built.

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

namespace apps::scene_file {

struct Name {
  std::string text;
  Place place;
};

template <class T>
struct Placed {
  T value{};
  Place place;
};

struct MaterialSyntax {
  Name name;
  radiosity::Color reflectance{0.0};
  radiosity::Color emission{0.0};
};

struct CameraSyntax {
  Camera camera;
  Place place;  // of the name
  bool sound = true;
};

enum class Kind { polygon, disk, box, sphere, cylinder, cone, torus, superquadric, mesh, unite, intersection, difference };
[[nodiscard]] std::string_view to_string(Kind kind);

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
  Kind kind = Kind::polygon;
  Name name;
  bool sound = true;
  std::optional<Name> material;
  std::vector<SheetSyntax> sheets;
  raycast::Placement placement;
  std::optional<Place> inside;
  // box: from, to; sphere: center, radius; disk: center, normal, radius; cylinder: base, axis, radius; cone: base, axis, radius, top;
  // torus: center, axis, radius, tube; superquadric: center, radii, exponents, ring; polygon: vertices; mesh: vertices, faces;
  // unite, intersection, difference: operands
  std::optional<Placed<glm::dvec3>> from, to, center, base, axis, normal, radii;
  std::optional<Placed<double>> radius, top, tube, ring;
  std::optional<Placed<std::array<double, 2>>> exponents;
  std::vector<Placed<glm::dvec3>> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<FaceSyntax> faces;
  std::vector<ObjectSyntax> operands;
  std::optional<Name> group;  // of a union that is written as a use, among operands: its operands are what is in the group
};

struct UseSyntax {
  Name group;
  Name name;
  raycast::Placement placement;
  bool sound = true;
};

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
  bool complete = true;  // false: the text was given up before its end
};

}  // namespace apps::scene_file
