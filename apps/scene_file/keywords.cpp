// SPDX-License-Identifier: MIT
#include "apps/scene_file/keywords.hpp"

#include <algorithm>
#include <array>

namespace apps::scene_file {
namespace {

constexpr std::array<std::string_view, 6> polygon_words = {"vertex", "material", "move", "rotate", "scale", "sheet"};
constexpr std::array<std::string_view, 8> box_words = {"from", "to", "material", "sheet", "move", "rotate", "scale", "inside"};
constexpr std::array<std::string_view, 8> sphere_words = {"center", "radius", "material", "sheet", "move", "rotate", "scale", "inside"};
constexpr std::array<std::string_view, 9> cylinder_words = {"base", "axis",   "radius", "material", "sheet",
                                                            "move", "rotate", "scale",  "inside"};
constexpr std::array<std::string_view, 8> disk_words = {"center", "normal", "radius", "material", "sheet", "move", "rotate", "scale"};
constexpr std::array<std::string_view, 10> cone_words = {"base",  "axis", "radius", "top",   "material",
                                                         "sheet", "move", "rotate", "scale", "inside"};
constexpr std::array<std::string_view, 10> torus_words = {"center", "axis", "radius", "tube",  "material",
                                                          "sheet",  "move", "rotate", "scale", "inside"};
constexpr std::array<std::string_view, 10> superquadric_words = {"center", "radii", "exponents", "ring",  "material",
                                                                 "sheet",  "move",  "rotate",    "scale", "inside"};
constexpr std::array<std::string_view, 8> mesh_words = {"vertex", "face", "material", "sheet", "move", "rotate", "scale", "inside"};

// What may stand in a union, intersection or difference: clauses first, then operands.
constexpr std::array<std::string_view, most_words> csg_words = {"material", "move",         "rotate",     "scale", "inside",       "box",
                                                                "sphere",   "cylinder",     "cone",       "torus", "superquadric", "mesh",
                                                                "union",    "intersection", "difference", "use",   "polygon",      "disk"};

// Clauses that may stand several times; any other one is refused the second time.
constexpr std::array<std::string_view, 6> repeatable = {"vertex", "face", "sheet", "move", "rotate", "scale"};

constexpr std::array<Kind, 12> kinds = {Kind::polygon, Kind::disk,         Kind::box,  Kind::sphere, Kind::cylinder,     Kind::cone,
                                        Kind::torus,   Kind::superquadric, Kind::mesh, Kind::unite,  Kind::intersection, Kind::difference};

}  // namespace

Words clause_words(Kind kind) {
  switch (kind) {
    case Kind::polygon:
      return polygon_words;
    case Kind::box:
      return box_words;
    case Kind::sphere:
      return sphere_words;
    case Kind::cylinder:
      return cylinder_words;
    case Kind::disk:
      return disk_words;
    case Kind::cone:
      return cone_words;
    case Kind::torus:
      return torus_words;
    case Kind::superquadric:
      return superquadric_words;
    case Kind::unite:
    case Kind::intersection:
    case Kind::difference:
      return csg_words;
    case Kind::mesh:
      break;
  }
  return mesh_words;
}

bool is_repeatable(std::string_view word) { return contains(repeatable, word); }

bool is_operand(std::string_view word) { return word == "use" || kind_of(word).has_value(); }

bool contains(Words words, std::string_view word) { return std::find(words.begin(), words.end(), word) != words.end(); }

std::size_t index_in(Words words, std::string_view word) {
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
}

std::optional<Kind> kind_of(std::string_view word) {
  for (const Kind kind : kinds) {
    if (word == to_string(kind)) { return kind; }
  }
  return std::nullopt;
}

std::string_view to_string(Kind kind) {
  switch (kind) {
    case Kind::polygon:
      return "polygon";
    case Kind::box:
      return "box";
    case Kind::sphere:
      return "sphere";
    case Kind::cylinder:
      return "cylinder";
    case Kind::disk:
      return "disk";
    case Kind::cone:
      return "cone";
    case Kind::torus:
      return "torus";
    case Kind::superquadric:
      return "superquadric";
    case Kind::unite:
      return "union";
    case Kind::intersection:
      return "intersection";
    case Kind::difference:
      return "difference";
    case Kind::mesh:
      break;
  }
  return "mesh";
}

}  // namespace apps::scene_file
