// SPDX-License-Identifier: MIT
#include "apps/vrml/node_types.hpp"

#include <algorithm>
#include <iterator>

namespace apps::vrml {
namespace {

namespace spec {

using Kind = FieldType::Kind;
constexpr FieldType number{Kind::numbers, 1, false}, vec2{Kind::numbers, 2, false}, vec3{Kind::numbers, 3, false},
    rotation{Kind::numbers, 4, false}, matrix{Kind::numbers, 16, false}, numbers{Kind::numbers, 1, true}, vec2s{Kind::numbers, 2, true},
    vec3s{Kind::numbers, 3, true}, rotations{Kind::numbers, 4, true}, indices{Kind::indices, 1, true}, image{Kind::image, 1, false},
    text{Kind::strings, 1, false}, texts{Kind::strings, 1, true}, word{Kind::words, 1, false};

constexpr FieldEntry ascii_text[] = {{"string", texts}, {"spacing", number}, {"justification", word}, {"width", numbers}};
constexpr FieldEntry cone[] = {{"parts", word}, {"bottomRadius", number}, {"height", number}};
constexpr FieldEntry coordinate[] = {{"point", vec3s}};
constexpr FieldEntry cube[] = {{"width", number}, {"height", number}, {"depth", number}};
constexpr FieldEntry cylinder[] = {{"parts", word}, {"radius", number}, {"height", number}};
constexpr FieldEntry directional[] = {{"on", word}, {"intensity", number}, {"color", vec3}, {"direction", vec3}};
constexpr FieldEntry font[] = {{"size", number}, {"family", word}, {"style", word}};
constexpr FieldEntry faces[] = {
    {"coordIndex", indices}, {"materialIndex", indices}, {"normalIndex", indices}, {"textureCoordIndex", indices}};
constexpr FieldEntry info[] = {{"string", text}};
constexpr FieldEntry lod[] = {{"range", numbers}, {"center", vec3}};
constexpr FieldEntry material[] = {{"ambientColor", vec3s},  {"diffuseColor", vec3s}, {"specularColor", vec3s},
                                   {"emissiveColor", vec3s}, {"shininess", numbers},  {"transparency", numbers}};
constexpr FieldEntry binding[] = {{"value", word}};
constexpr FieldEntry matrix_transform[] = {{"matrix", matrix}};
constexpr FieldEntry normal[] = {{"vector", vec3s}};
constexpr FieldEntry orthographic[] = {{"position", vec3}, {"orientation", rotation}, {"focalDistance", number},
                                       {"height", number}, {"nearDistance", number},  {"farDistance", number}};
constexpr FieldEntry perspective[] = {{"position", vec3},      {"orientation", rotation}, {"focalDistance", number},
                                      {"heightAngle", number}, {"nearDistance", number},  {"farDistance", number}};
constexpr FieldEntry point_light[] = {{"on", word}, {"intensity", number}, {"color", vec3}, {"location", vec3}};
constexpr FieldEntry points[] = {{"startIndex", number}, {"numPoints", number}};
constexpr FieldEntry rotation_node[] = {{"rotation", rotation}};
constexpr FieldEntry scale[] = {{"scaleFactor", vec3}};
constexpr FieldEntry separator[] = {{"renderCulling", word}};
constexpr FieldEntry hints[] = {{"vertexOrdering", word}, {"shapeType", word}, {"faceType", word}, {"creaseAngle", number}};
constexpr FieldEntry sphere[] = {{"radius", number}};
constexpr FieldEntry spot[] = {{"on", word},        {"intensity", number},   {"color", vec3},        {"location", vec3},
                               {"direction", vec3}, {"dropOffRate", number}, {"cutOffAngle", number}};
constexpr FieldEntry switch_node[] = {{"whichChild", number}};
constexpr FieldEntry texture[] = {{"filename", text}, {"image", image}, {"wrapS", word}, {"wrapT", word}};
constexpr FieldEntry texture_transform[] = {{"translation", vec2}, {"rotation", number}, {"scaleFactor", vec2}, {"center", vec2}};
constexpr FieldEntry texture_coordinate[] = {{"point", vec2s}};
constexpr FieldEntry transform[] = {
    {"translation", vec3}, {"rotation", rotation}, {"scaleFactor", vec3}, {"scaleOrientation", rotation}, {"center", vec3}};
constexpr FieldEntry translation[] = {{"translation", vec3}};
constexpr FieldEntry anchor[] = {{"name", text}, {"description", text}, {"map", word}};
constexpr FieldEntry inline_node[] = {{"name", text}, {"bboxSize", vec3}, {"bboxCenter", vec3}};

constexpr NodeType types[] = {{"AsciiText", ascii_text},
                              {"Cone", cone},
                              {"Coordinate3", coordinate},
                              {"Cube", cube},
                              {"Cylinder", cylinder},
                              {"DirectionalLight", directional},
                              {"FontStyle", font},
                              {"Group", {}, true},
                              {"IndexedFaceSet", faces},
                              {"IndexedLineSet", faces},
                              {"Info", info},
                              {"LOD", lod, true},
                              {"Material", material},
                              {"MaterialBinding", binding},
                              {"MatrixTransform", matrix_transform},
                              {"Normal", normal},
                              {"NormalBinding", binding},
                              {"OrthographicCamera", orthographic},
                              {"PerspectiveCamera", perspective},
                              {"PointLight", point_light},
                              {"PointSet", points},
                              {"Rotation", rotation_node},
                              {"Scale", scale},
                              {"Separator", separator, true},
                              {"ShapeHints", hints},
                              {"Sphere", sphere},
                              {"SpotLight", spot},
                              {"Switch", switch_node, true},
                              {"Texture2", texture},
                              {"Texture2Transform", texture_transform},
                              {"TextureCoordinate2", texture_coordinate},
                              {"Transform", transform},
                              {"TransformSeparator", {}, true},
                              {"Translation", translation},
                              {"WWWAnchor", anchor, true},
                              {"WWWInline", inline_node}};

struct NamedType {
  std::string_view name;
  FieldType type;
};
constexpr NamedType named[] = {
    {"SFBitMask", word}, {"SFBool", word},     {"SFColor", vec3},        {"SFEnum", word},          {"SFFloat", number}, {"SFImage", image},
    {"SFLong", number},  {"SFMatrix", matrix}, {"SFRotation", rotation}, {"SFString", text},        {"SFVec2f", vec2},   {"SFVec3f", vec3},
    {"MFColor", vec3s},  {"MFFloat", numbers}, {"MFLong", indices},      {"MFRotation", rotations}, {"MFString", texts}, {"MFVec2f", vec2s},
    {"MFVec3f", vec3s},  {"SFTime", number},   {"MFEnum", texts}};

}  // namespace spec

template <class List>
auto find(const List& list, std::string_view name) {
  const auto found = std::find_if(std::begin(list), std::end(list), [&](const auto& entry) { return entry.name == name; });
  return found == std::end(list) ? nullptr : &*found;
}

}  // namespace

const NodeType* node_type(std::string_view name) { return find(spec::types, name); }

const FieldType* field_type(const NodeType& node, std::string_view field) {
  const FieldEntry* const entry = find(node.fields, field);
  return entry == nullptr ? nullptr : &entry->type;
}

const FieldType* named_type(std::string_view name) {
  const spec::NamedType* const entry = find(spec::named, name);
  return entry == nullptr ? nullptr : &entry->type;
}

std::span<const NodeType> node_types() { return spec::types; }

}  // namespace apps::vrml
