// SPDX-License-Identifier: MIT
#include "apps/vrml/scene_graph.hpp"

#include <algorithm>
#include <iterator>

namespace apps::vrml {
namespace {

namespace spec {

using Kind = FieldType::Kind;
constexpr FieldType number{Kind::numbers, 1, false}, vec2{Kind::numbers, 2, false}, vec3{Kind::numbers, 3, false},
    rotation{Kind::numbers, 4, false}, matrix{Kind::numbers, 16, false}, numbers{Kind::numbers, 1, true}, vec2s{Kind::numbers, 2, true},
    vec3s{Kind::numbers, 3, true}, rotations{Kind::numbers, 4, true}, indices{Kind::indices, 1, true}, image{Kind::image, 1, false},
    text{Kind::strings, 1, false}, texts{Kind::strings, 1, true}, word{Kind::words, 1, false}, node{Kind::nodes, 1, false},
    nodes{Kind::nodes, 1, true};

// Node types with their fields; `true`: the node may have children.
const std::vector<NodeType> types{
    {"AsciiText", {{"string", texts}, {"spacing", number}, {"justification", word}, {"width", numbers}}},
    {"Cone", {{"parts", word}, {"bottomRadius", number}, {"height", number}}},
    {"Coordinate3", {{"point", vec3s}}},
    {"Cube", {{"width", number}, {"height", number}, {"depth", number}}},
    {"Cylinder", {{"parts", word}, {"radius", number}, {"height", number}}},
    {"DirectionalLight", {{"on", word}, {"intensity", number}, {"color", vec3}, {"direction", vec3}}},
    {"FontStyle", {{"size", number}, {"family", word}, {"style", word}}},
    {"Group", {}, true},
    {"IndexedFaceSet", {{"coordIndex", indices}, {"materialIndex", indices}, {"normalIndex", indices}, {"textureCoordIndex", indices}}},
    {"IndexedLineSet", {{"coordIndex", indices}, {"materialIndex", indices}, {"normalIndex", indices}, {"textureCoordIndex", indices}}},
    {"Info", {{"string", text}}},
    {"LOD", {{"range", numbers}, {"center", vec3}}, true},
    {"Material",
     {{"ambientColor", vec3s},
      {"diffuseColor", vec3s},
      {"specularColor", vec3s},
      {"emissiveColor", vec3s},
      {"shininess", numbers},
      {"transparency", numbers}}},
    {"MaterialBinding", {{"value", word}}},
    {"MatrixTransform", {{"matrix", matrix}}},
    {"Normal", {{"vector", vec3s}}},
    {"NormalBinding", {{"value", word}}},
    {"OrthographicCamera",
     {{"position", vec3},
      {"orientation", rotation},
      {"focalDistance", number},
      {"height", number},
      {"nearDistance", number},
      {"farDistance", number}}},
    {"PerspectiveCamera",
     {{"position", vec3},
      {"orientation", rotation},
      {"focalDistance", number},
      {"heightAngle", number},
      {"nearDistance", number},
      {"farDistance", number}}},
    {"PointLight", {{"on", word}, {"intensity", number}, {"color", vec3}, {"location", vec3}}},
    {"PointSet", {{"startIndex", number}, {"numPoints", number}}},
    {"Rotation", {{"rotation", rotation}}},
    {"Scale", {{"scaleFactor", vec3}}},
    {"Separator", {{"renderCulling", word}}, true},
    {"ShapeHints", {{"vertexOrdering", word}, {"shapeType", word}, {"faceType", word}, {"creaseAngle", number}}},
    {"Sphere", {{"radius", number}}},
    {"SpotLight",
     {{"on", word},
      {"intensity", number},
      {"color", vec3},
      {"location", vec3},
      {"direction", vec3},
      {"dropOffRate", number},
      {"cutOffAngle", number}}},
    {"Switch", {{"whichChild", number}}, true},
    {"Texture2", {{"filename", text}, {"image", image}, {"wrapS", word}, {"wrapT", word}}},
    {"Texture2Transform", {{"translation", vec2}, {"rotation", number}, {"scaleFactor", vec2}, {"center", vec2}}},
    {"TextureCoordinate2", {{"point", vec2s}}},
    {"Transform", {{"translation", vec3}, {"rotation", rotation}, {"scaleFactor", vec3}, {"scaleOrientation", rotation}, {"center", vec3}}},
    {"TransformSeparator", {}, true},
    {"Translation", {{"translation", vec3}}},
    {"WWWAnchor", {{"name", text}, {"description", text}, {"map", word}}, true},
    {"WWWInline", {{"name", text}, {"bboxSize", vec3}, {"bboxCenter", vec3}}},
};

struct NamedType {
  std::string_view name;
  FieldType type;
};
constexpr NamedType named[] = {{"SFBitMask", word},      {"SFBool", word},     {"SFColor", vec3},    {"SFEnum", word},
                               {"SFFloat", number},      {"SFImage", image},   {"SFLong", number},   {"SFMatrix", matrix},
                               {"SFRotation", rotation}, {"SFString", text},   {"SFVec2f", vec2},    {"SFVec3f", vec3},
                               {"MFColor", vec3s},       {"MFFloat", numbers}, {"MFLong", indices},  {"MFRotation", rotations},
                               {"MFString", texts},      {"MFVec2f", vec2s},   {"MFVec3f", vec3s},   {"SFTime", number},
                               {"MFEnum", texts},        {"SFInt32", number},  {"MFInt32", indices}, {"MFTime", numbers},
                               {"SFNode", node},         {"MFNode", nodes}};

}  // namespace spec

template <class List>
auto find(const List& list, std::string_view name) {
  const auto found = std::find_if(std::begin(list), std::end(list), [&](const auto& entry) { return entry.name == name; });
  return found == std::end(list) ? nullptr : &*found;
}

}  // namespace

const NodeType* node_type(Version version, std::string_view name) { return find(node_types(version), name); }

const FieldType* field_type(const NodeType& node, std::string_view field) {
  const FieldEntry* const entry = find(node.fields, field);
  return entry == nullptr ? nullptr : &entry->type;
}

const FieldType* named_type(std::string_view name) {
  const spec::NamedType* const entry = find(spec::named, name);
  return entry == nullptr ? nullptr : &entry->type;
}

std::span<const NodeType> node_types(Version version) { return version == Version::v97 ? node_types_97() : spec::types; }

// --- values of a node's fields

double Node::number(std::string_view field, double otherwise) const {
  const Field* const found = find(field);
  return found != nullptr && !found->numbers.empty() ? found->numbers[0] : otherwise;
}

glm::dvec3 Node::vector(std::string_view field, const glm::dvec3& otherwise) const {
  const Field* const found = find(field);
  return found != nullptr && found->numbers.size() >= 3 ? glm::dvec3(found->numbers[0], found->numbers[1], found->numbers[2]) : otherwise;
}

glm::dvec4 Node::rotation(std::string_view field) const {
  const Field* const found = find(field);
  if (found == nullptr || found->numbers.size() < 4) { return {0.0, 0.0, 1.0, 0.0}; }
  return {found->numbers[0], found->numbers[1], found->numbers[2], found->numbers[3]};
}

std::string_view Node::word(std::string_view field, std::string_view otherwise) const {
  const Field* const found = find(field);
  return found != nullptr && !found->words.empty() ? std::string_view(found->words[0]) : otherwise;
}

}  // namespace apps::vrml
