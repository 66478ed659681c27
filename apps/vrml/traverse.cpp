// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {
namespace {

glm::dmat4 turned(const glm::dvec4& rotation) {
  const glm::dvec3 axis(rotation);
  const double length = glm::length(axis);
  return length > 0.0 ? glm::rotate(glm::dmat4(1.0), rotation.w, axis / length) : glm::dmat4(1.0);
}

glm::dmat4 moved(const glm::dvec3& by) { return glm::translate(glm::dmat4(1.0), by); }

// The transform by which the node changes the state; nothing if it is not a transform node.
std::optional<glm::dmat4> transform_of(const Node& node) {
  const glm::dvec3 zero(0.0), one(1.0);
  if (node.type == "Translation") { return moved(node.vector("translation", zero)); }
  if (node.type == "Rotation") { return turned(node.rotation("rotation")); }
  if (node.type == "Scale") { return glm::scale(glm::dmat4(1.0), node.vector("scaleFactor", one)); }
  if (node.type == "MatrixTransform") {  // the rows of a matrix for row vectors are our columns
    const Field* const matrix = node.find("matrix");
    glm::dmat4 result(1.0);
    if (matrix == nullptr || matrix->numbers.size() < 16) { return result; }
    for (int i = 0; i < 16; ++i) { result[i / 4][i % 4] = matrix->numbers[static_cast<std::size_t>(i)]; }
    return result;
  }
  if (node.type == "Transform") {  // VRML 97 has another name for the scale
    const glm::dmat4 tilt = turned(node.rotation("scaleOrientation"));
    const glm::dvec3 centre = node.vector("center", zero);
    return moved(node.vector("translation", zero)) * moved(centre) * turned(node.rotation("rotation")) * tilt *
           glm::scale(glm::dmat4(1.0), node.vector(node.version == Version::v97 ? "scale" : "scaleFactor", one)) * glm::transpose(tilt) *
           moved(-centre);
  }
  return std::nullopt;
}

Binding binding_of(std::string_view word) {
  constexpr std::array<std::string_view, 7> words{"OVERALL",          "PER_PART",   "PER_PART_INDEXED",  "PER_FACE",
                                                  "PER_FACE_INDEXED", "PER_VERTEX", "PER_VERTEX_INDEXED"};
  const auto found = std::find(words.begin(), words.end(), word);
  return found == words.end() ? Binding::overall : static_cast<Binding>(found - words.begin());
}

}  // namespace

bool change(State& state, const Node& node) {
  if (node.version == Version::v97) {
    if (!node.name.empty()) { state.named = &node; }
    if (node.type != "Transform") { return false; }
  }
  if (const auto transform = transform_of(node)) {
    state.transform = state.transform * *transform;
  } else if (node.type == "Material") {
    state.material = &node;
  } else if (node.type == "Texture2") {
    state.texture = &node;
  } else if (node.type == "Coordinate3") {
    state.coordinates = &node;
  } else if (node.type == "MaterialBinding") {
    state.binding = binding_of(node.word("value", "OVERALL"));
  } else if (node.type == "ShapeHints") {
    const std::string_view order = node.word("vertexOrdering", "UNKNOWN_ORDERING");
    state.ordered = order != "UNKNOWN_ORDERING";
    state.clockwise = order == "CLOCKWISE";
    state.solid = node.word("shapeType", "UNKNOWN_SHAPE_TYPE") == "SOLID";
    state.creased = node.number("creaseAngle", 0.0) > 0.0;
  } else {
    return false;
  }
  return true;
}

std::vector<std::shared_ptr<const Node>> walked_children(const Node& node) {
  std::vector<std::shared_ptr<const Node>> all = node.children;
  for (const char* const name : {"children", "choice", "level"}) {
    const Field* const field = node.find(name);
    if (field != nullptr) { all.insert(all.end(), field->nodes.begin(), field->nodes.end()); }
  }
  if (node.type == "Switch") {
    const double which = node.number(node.version == Version::v97 ? "whichChoice" : "whichChild", -1.0);
    // If all children are cameras, all are kept, because a viewer offers all of them.
    const bool views = std::all_of(all.begin(), all.end(), [](const auto& child) { return is_camera(*child); });
    if ((which == -3.0 && node.version == Version::v1) || views) { return all; }
    const bool exists = which >= 0.0 && which < static_cast<double>(all.size());
    if (!exists) { return {}; }
    all = {all[static_cast<std::size_t>(which)]};
  } else if (node.type == "LOD" && !all.empty()) {
    all.resize(1);
  }
  return all;
}

void restore(State& state, const State& before, const Node& node) {
  if (node.version == Version::v97 || node.type == "Separator" || node.type == "WWWAnchor" || node.type == "WWWInline") { state = before; }
  if (node.type == "TransformSeparator") { state.transform = before.transform; }
}

State state_of_shape(const Node& shape, const Node& geometry, const State& around) {
  State state = around;
  const Node* const appearance = shape.node("appearance");
  state.material = appearance != nullptr ? appearance->node("material") : nullptr;
  state.texture = appearance != nullptr ? appearance->node("texture") : nullptr;
  state.coordinates = geometry.node("coord");
  state.colors = geometry.node("color");
  const bool of_faces = geometry.is_false("colorPerVertex");
  state.binding = state.colors == nullptr ? Binding::overall : of_faces ? Binding::per_face_indexed : Binding::per_vertex_indexed;
  state.ordered = true;
  state.clockwise = geometry.is_false("ccw");
  state.solid = !geometry.is_false("solid");
  state.creased = geometry.number("creaseAngle", 0.0) > 0.0;
  return state;
}

}  // namespace apps::vrml
