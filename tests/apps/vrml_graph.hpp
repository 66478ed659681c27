// SPDX-License-Identifier: MIT
#pragma once

// Random scene graphs of VRML 1.0 for the test of its reader: transforms, materials and their bindings, hints, solids and face sets in
// groups of every kind, of which some are used again. Each is written as VRML and as a scene file. What a graph means is said here once
// more, by its definition: the tree that results when every use is a copy.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "random_numbers.hpp"

namespace vrml_graph {

using Words = std::vector<std::string>;
using Colors = std::vector<glm::dvec3>;

inline std::string text(double number) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.17g", number);
  return buffer.data();
}
inline std::string text(const glm::dvec3& v) { return text(v.x) + " " + text(v.y) + " " + text(v.z); }
template <class List>
std::string listed(const List& list) {
  std::string result = "[";
  for (const auto& item : list) {
    if constexpr (std::is_integral_v<std::decay_t<decltype(item)>>) {
      result += (result == "[" ? " " : ", ") + std::to_string(item);
    } else {
      result += (result == "[" ? " " : ", ") + text(item);
    }
  }
  return result + " ]";
}

struct Node {
  std::string type, fields;  // as VRML says them
  Words placement;           // of a transform: the clauses of a scene file, in the order in which they act
  Colors diffuse, emissive, points;
  std::string binding;
  std::vector<int> material_index;  // of a face set
  glm::dvec3 size{0.0};             // of a solid
  bool clockwise = false;
  int which = 0;
  std::vector<std::size_t> children;
};

// What nodes leave to those that follow.
struct State {
  Words placement;  // that of the last transform acts first
  const Node* material = nullptr;
  const Node* coordinates = nullptr;
  std::string binding = "OVERALL";
  bool clockwise = false;
};

// A tetrahedron's faces, counter-clockwise from outside.
inline constexpr int tetrahedron[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

class Graph : RandomNumbers {
 public:
  explicit Graph(unsigned seed) : RandomNumbers(seed) { group("Group", 0); }

  [[nodiscard]] std::string vrml() {
    met_.assign(nodes_.size(), false);
    return write(nodes_.size() - 1);
  }

  // The statements of the solids, those of face sets after all others, as the reader has them.
  [[nodiscard]] std::string scene() {
    State state;
    expand(nodes_.size() - 1, state);
    return solids_ + face_sets_;
  }

 private:
  std::size_t keep(Node node) {
    nodes_.push_back(std::move(node));
    return nodes_.size() - 1;
  }

  static std::string rotate(const glm::dvec3& axis, double angle) {
    return "rotate " + text(axis) + " " + text(angle * 180.0 / std::numbers::pi);
  }
  glm::dvec3 scales() {
    glm::dvec3 by = vector(0.7, 1.4);
    if (below(3) == 0) { by.x = -by.x; }  // a mirror
    return by;
  }

  std::size_t transform() {
    Node node;
    const glm::dvec3 to = vector(-6.0, 6.0), axis = vector(-1.0, 1.0), by = scales();
    const double angle = number(-3.0, 3.0);
    const auto be = [&node](const char* type, std::string fields, Words placement) {
      node.type = type, node.fields = std::move(fields), node.placement = std::move(placement);
    };
    switch (below(5)) {
      case 0:
        be("Translation", "translation " + text(to), {"move " + text(to)});
        break;
      case 1:
        be("Rotation", "rotation " + text(axis) + " " + text(angle), {rotate(axis, angle)});
        break;
      case 2:
        be("Scale", "scaleFactor " + text(by), {"scale " + text(by)});
        break;
      case 3: {  // rows of a matrix behind a row vector
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(axis)));
        std::string rows;
        for (int i = 0; i < 3; ++i) { rows += text(turn[i] * by[i]) + " 0 "; }
        be("MatrixTransform", "matrix " + rows + text(to) + " 1", {"scale " + text(by), rotate(axis, angle), "move " + text(to)});
        break;
      }
      default: {
        const glm::dvec3 tilt_axis = vector(-1.0, 1.0), centre = vector(-1.0, 1.0);
        const double tilt = number(-3.0, 3.0);
        be("Transform",
           "translation " + text(to) + " rotation " + text(axis) + " " + text(angle) + " scaleFactor " + text(by) + " scaleOrientation " +
               text(tilt_axis) + " " + text(tilt) + " center " + text(centre),
           {"move " + text(-centre), rotate(tilt_axis, -tilt), "scale " + text(by), rotate(tilt_axis, tilt), rotate(axis, angle),
            "move " + text(centre), "move " + text(to)});
      }
    }
    return keep(std::move(node));
  }

  std::size_t look() {
    Node node;
    switch (below(4)) {
      case 0: {
        constexpr std::array<const char*, 7> bindings{"OVERALL",          "PER_PART",   "PER_PART_INDEXED",  "PER_FACE",
                                                      "PER_FACE_INDEXED", "PER_VERTEX", "PER_VERTEX_INDEXED"};
        node.type = "MaterialBinding";
        node.binding = bindings[static_cast<std::size_t>(below(7))];
        node.fields = "value " + node.binding;
        break;
      }
      case 1:
        node.type = "ShapeHints";
        node.clockwise = below(2) == 0;
        node.fields = std::string("shapeType SOLID vertexOrdering ") + (node.clockwise ? "CLOCKWISE" : "COUNTERCLOCKWISE");
        break;
      default:
        node.type = "Material";
        for (int i = below(6); i >= 0; --i) { node.diffuse.push_back(vector(0.05, 0.9)); }
        for (int i = below(3) == 0 ? below(3) : 0; i > 0; --i) { node.emissive.push_back(vector(0.0, 5.0)); }
        node.fields = "diffuseColor " + listed(node.diffuse);
        if (!node.emissive.empty()) { node.fields += " emissiveColor " + listed(node.emissive); }
    }
    return keep(std::move(node));
  }

  std::size_t shape() {
    Node node;
    node.size = vector(0.4, 1.6);
    switch (below(5)) {
      case 0:
        node.type = "Cube";
        node.fields = "width " + text(node.size.x) + " height " + text(node.size.y) + " depth " + text(node.size.z);
        break;
      case 1:
        node.type = "Sphere";
        node.fields = "radius " + text(node.size.x);
        break;
      case 2:
        node.type = "Cylinder";
        node.fields = "parts (SIDES | TOP | BOTTOM) radius " + text(node.size.x) + " height " + text(node.size.y);
        break;
      case 3:
        node.type = "Cone";
        node.fields = "parts ALL bottomRadius " + text(node.size.x) + " height " + text(node.size.y);
        break;
      default: {  // its coordinates; the face set comes later, somewhere
        const double s = node.size.x;
        node.type = "Coordinate3";
        node.points = {s * vector(-0.1, 0.1), glm::dvec3(s, 0, 0) + s * vector(-0.1, 0.1), glm::dvec3(0, s, 0) + s * vector(-0.1, 0.1),
                       glm::dvec3(0, 0, s) + s * vector(-0.1, 0.1)};
        node.fields = "point " + listed(node.points);
      }
    }
    return keep(std::move(node));
  }

  // Closed, so that it is a solid whichever order the hints in front of it say.
  std::size_t face_set() {
    Node node;
    node.type = "IndexedFaceSet";
    const bool listed_materials = below(2) == 0;
    std::vector<int> index;
    for (const auto& face : tetrahedron) { index.insert(index.end(), {face[0], face[1], face[2], -1}); }
    node.fields = "coordIndex " + listed(index);
    for (int i = 0; i < 16 && listed_materials; ++i) { node.material_index.push_back(i % 4 == 3 ? -1 : below(5)); }
    if (listed_materials) { node.fields += " materialIndex " + listed(node.material_index); }
    return keep(std::move(node));
  }

  std::size_t group(std::string type, int depth) {
    Node node;
    node.type = std::move(type);
    for (int i = 2 + below(4); i > 0; --i) {
      const int kind = below(12);
      if (kind < 3) {
        node.children.push_back(transform());
      } else if (kind < 5) {
        node.children.push_back(look());
      } else if (kind < 8) {
        node.children.push_back(shape());
        if (nodes_.back().type == "Coordinate3") { node.children.push_back(face_set()); }
      } else if (kind < 9 && !nodes_.empty()) {  // USE; only what is closed is in the list
        node.children.push_back(static_cast<std::size_t>(below(static_cast<int>(nodes_.size()))));
      } else if (depth < 4) {
        constexpr std::array<const char*, 6> groups{"Separator", "Group", "TransformSeparator", "WWWAnchor", "Switch", "LOD"};
        node.children.push_back(group(groups[static_cast<std::size_t>(below(6))], depth + 1));
      }
    }
    if (node.type == "Switch") {
      constexpr std::array<int, 4> choices{-3, 0, 1, -1};
      node.which = choices[static_cast<std::size_t>(below(4))];
      node.fields = "whichChild " + std::to_string(node.which);
    }
    if (node.type == "LOD") { node.fields = "range [ 3 ]"; }
    return keep(std::move(node));
  }

  std::string write(std::size_t n) {
    if (met_[n]) { return "USE n" + std::to_string(n) + "\n"; }
    std::string result = "DEF n" + std::to_string(n) + " " + nodes_[n].type + " { " + nodes_[n].fields + "\n";
    for (const std::size_t child : nodes_[n].children) { result += write(child); }
    met_[n] = true;
    return result + "}\n";
  }

  void expand(std::size_t n, State& state) {
    const Node& node = nodes_[n];
    const State before = state;
    state.placement.insert(state.placement.begin(), node.placement.begin(), node.placement.end());
    if (node.type == "Material") { state.material = &node; }
    if (node.type == "Coordinate3") { state.coordinates = &node; }
    if (node.type == "MaterialBinding") { state.binding = node.binding; }
    if (node.type == "ShapeHints") { state.clockwise = node.clockwise; }
    if (node.size != glm::dvec3(0.0) && node.points.empty()) { solid(node, state); }
    if (node.type == "IndexedFaceSet" && state.coordinates != nullptr) { faces(node, state); }
    const auto children = static_cast<int>(node.children.size());
    for (int i = 0; i < children; ++i) {
      const bool chosen = node.type == "Switch" ? node.which == -3 || node.which == i : node.type != "LOD" || i == 0;
      if (chosen) { expand(node.children[static_cast<std::size_t>(i)], state); }
    }
    if (node.type == "Separator" || node.type == "WWWAnchor") { state = before; }
    if (node.type == "TransformSeparator") { state.placement = before.placement; }
  }

  // A material of the state by its numbers: their mean.
  std::string material(const State& state, const std::vector<int>& numbers) {
    const std::string name = "m" + std::to_string(materials_++);
    glm::dvec3 diffuse(0.0), emissive(0.0);
    for (const int number : numbers) {
      const auto of = [&](const Colors& list, std::size_t all) {
        return list.empty() ? glm::dvec3(0.0) : list[static_cast<std::size_t>(number) % all % list.size()];
      };
      const std::size_t all = state.material == nullptr ? 1 : std::max(state.material->diffuse.size(), state.material->emissive.size());
      diffuse += (state.material == nullptr ? glm::dvec3(0.8) : of(state.material->diffuse, all)) / static_cast<double>(numbers.size());
      if (state.material != nullptr) { emissive += of(state.material->emissive, all) / static_cast<double>(numbers.size()); }
    }
    solids_ += "material " + name + " reflectance " + text(diffuse) + " emission " + text(std::numbers::pi * emissive) + "\n";
    return "material " + name;
  }

  static std::string placed(const State& state) {
    std::string result;
    for (const std::string& clause : state.placement) { result += clause + "\n"; }
    return result + "rotate 1 0 0 90\n";  // y was up
  }

  void solid(const Node& node, const State& state) {
    const double h = node.size.y;
    const std::string axis = " base 0 " + text(-0.5 * h) + " 0 axis 0 " + text(h) + " 0 radius " + text(node.size.x);
    std::string kind, clauses;
    Words parts;  // the sheets in the order of VRML's parts
    if (node.type == "Cube") {
      kind = "box", clauses = " from " + text(-0.5 * node.size) + " to " + text(0.5 * node.size);
      parts = {"z1", "z0", "x0", "x1", "y1", "y0"};
    } else if (node.type == "Sphere") {
      kind = "sphere", clauses = " center 0 0 0 radius " + text(node.size.x);
    } else if (node.type == "Cylinder") {
      kind = "cylinder", clauses = axis, parts = {"side", "top", "bottom"};
    } else {
      kind = "cone", clauses = axis, parts = {"side", "bottom"};
    }
    std::string surface = " " + material(state, {0});
    if (state.binding.starts_with("PER_PART")) {
      for (std::size_t p = 0; p < parts.size(); ++p) { surface += " sheet " + parts[p] + " " + material(state, {static_cast<int>(p)}); }
    }
    solids_ += kind + " o" + std::to_string(objects_++) + clauses + surface + " {\n" + placed(state) + "}\n";
  }

  void faces(const Node& node, const State& state) {
    std::string body;
    for (const glm::dvec3& p : state.coordinates->points) { body += "vertex " + text(p) + "\n"; }
    for (int f = 0; f < 4; ++f) {
      const auto& corners = tetrahedron[f];
      std::vector<int> numbers{0};
      const bool indexed = state.binding.ends_with("INDEXED"), from_list = indexed && !node.material_index.empty();
      if (state.binding.starts_with("PER_VERTEX")) {
        numbers.clear();
        for (int k = 0; k < 3; ++k) {
          numbers.push_back(from_list ? node.material_index[static_cast<std::size_t>(4 * f + k)] : indexed ? corners[k] : 3 * f + k);
        }
      } else if (state.binding != "OVERALL") {
        const int number = from_list ? node.material_index[static_cast<std::size_t>(f)] : f;
        numbers = {number < 0 ? f : number};
      }
      body += "face " + std::to_string(corners[0]) + " " + std::to_string(corners[1]) + " " + std::to_string(corners[2]) + "\n";
      body += "sheet f" + std::to_string(f) + " " + material(state, numbers) + "\n";
    }
    face_sets_ += "mesh o" + std::to_string(objects_++) + " {\n" + body + placed(state) + "}\n";
  }

  std::vector<Node> nodes_;
  std::vector<bool> met_;
  std::string solids_, face_sets_;
  int materials_ = 0, objects_ = 0;
};

}  // namespace vrml_graph
