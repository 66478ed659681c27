// SPDX-License-Identifier: MIT
#include "apps/vrml/scene_graph.hpp"

#include <algorithm>

// The nodes of VRML 97, chapter 6 of the standard, each with its fields after their types. Events are left out, because they have no
// value in a file.

namespace apps::vrml {
namespace {

namespace spec97 {

struct Row {
  const char* name;
  std::string_view fields;
};

constexpr Row rows[] = {
    {"Anchor", "MFNode children SFString description MFString parameter url SFVec3f bboxCenter bboxSize"},
    {"Appearance", "SFNode material texture textureTransform"},
    {"AudioClip", "SFString description SFBool loop SFFloat pitch SFTime startTime stopTime MFString url"},
    {"Background", "MFFloat groundAngle skyAngle MFColor groundColor skyColor MFString backUrl bottomUrl frontUrl leftUrl rightUrl topUrl"},
    {"Billboard", "SFVec3f axisOfRotation bboxCenter bboxSize MFNode children"},
    {"Box", "SFVec3f size"},
    {"Collision", "MFNode children SFBool collide SFNode proxy SFVec3f bboxCenter bboxSize"},
    {"Color", "MFColor color"},
    {"ColorInterpolator", "MFFloat key MFColor keyValue"},
    {"Cone", "SFFloat bottomRadius height SFBool side bottom"},
    {"Coordinate", "MFVec3f point"},
    {"CoordinateInterpolator", "MFFloat key MFVec3f keyValue"},
    {"Cylinder", "SFBool bottom side top SFFloat height radius"},
    {"CylinderSensor", "SFBool autoOffset enabled SFFloat diskAngle maxAngle minAngle offset"},
    {"DirectionalLight", "SFFloat ambientIntensity intensity SFColor color SFVec3f direction SFBool on"},
    {"ElevationGrid",
     "SFNode color normal texCoord SFBool ccw colorPerVertex normalPerVertex solid SFFloat creaseAngle "
     "xSpacing zSpacing MFFloat height SFInt32 xDimension zDimension"},
    {"Extrusion",
     "SFBool beginCap ccw convex endCap solid SFFloat creaseAngle MFVec2f crossSection scale MFRotation "
     "orientation MFVec3f spine"},
    {"Fog", "SFColor color SFString fogType SFFloat visibilityRange"},
    {"FontStyle", "MFString family justify SFBool horizontal leftToRight topToBottom SFString language style SFFloat size spacing"},
    {"Group", "MFNode children SFVec3f bboxCenter bboxSize"},
    {"ImageTexture", "MFString url SFBool repeatS repeatT"},
    {"IndexedFaceSet",
     "SFNode color coord normal texCoord SFBool ccw colorPerVertex convex normalPerVertex solid MFInt32 "
     "colorIndex coordIndex normalIndex texCoordIndex SFFloat creaseAngle"},
    {"IndexedLineSet", "SFNode color coord MFInt32 colorIndex coordIndex SFBool colorPerVertex"},
    {"Inline", "MFString url SFVec3f bboxCenter bboxSize"},
    {"LOD", "MFNode level SFVec3f center MFFloat range"},
    {"Material", "SFFloat ambientIntensity shininess transparency SFColor diffuseColor emissiveColor specularColor"},
    {"MovieTexture", "SFBool loop repeatS repeatT SFFloat speed SFTime startTime stopTime MFString url"},
    {"NavigationInfo", "MFFloat avatarSize SFBool headlight SFFloat speed visibilityLimit MFString type"},
    {"Normal", "MFVec3f vector"},
    {"NormalInterpolator", "MFFloat key MFVec3f keyValue"},
    {"OrientationInterpolator", "MFFloat key MFRotation keyValue"},
    {"PixelTexture", "SFImage image SFBool repeatS repeatT"},
    {"PlaneSensor", "SFBool autoOffset enabled SFVec2f maxPosition minPosition SFVec3f offset"},
    {"PointLight", "SFFloat ambientIntensity intensity radius SFVec3f attenuation location SFColor color SFBool on"},
    {"PointSet", "SFNode color coord"},
    {"PositionInterpolator", "MFFloat key MFVec3f keyValue"},
    {"ProximitySensor", "SFVec3f center size SFBool enabled"},
    {"ScalarInterpolator", "MFFloat key keyValue"},
    {"Shape", "SFNode appearance geometry"},
    {"Sound", "SFVec3f direction location SFFloat intensity maxBack maxFront minBack minFront priority SFNode source SFBool spatialize"},
    {"Sphere", "SFFloat radius"},
    {"SphereSensor", "SFBool autoOffset enabled SFRotation offset"},
    {"SpotLight",
     "SFFloat ambientIntensity beamWidth cutOffAngle intensity radius SFVec3f attenuation direction "
     "location SFColor color SFBool on"},
    {"Switch", "MFNode choice SFInt32 whichChoice"},
    {"Text", "MFString string SFNode fontStyle MFFloat length SFFloat maxExtent"},
    {"TextureCoordinate", "MFVec2f point"},
    {"TextureTransform", "SFVec2f center scale translation SFFloat rotation"},
    {"TimeSensor", "SFTime cycleInterval startTime stopTime SFBool enabled loop"},
    {"TouchSensor", "SFBool enabled"},
    {"Transform", "SFVec3f center scale translation bboxCenter bboxSize MFNode children SFRotation rotation scaleOrientation"},
    {"Viewpoint", "SFFloat fieldOfView SFBool jump SFRotation orientation SFVec3f position SFString description"},
    {"VisibilitySensor", "SFVec3f center size SFBool enabled"},
    {"WorldInfo", "MFString info SFString title"},
};

std::vector<NodeType> table() {
  std::vector<NodeType> types;
  for (const Row& row : rows) {
    NodeType& node = types.emplace_back(NodeType{row.name, {}, false});
    const FieldType* type = nullptr;
    for (std::string_view rest = row.fields; !rest.empty();) {
      const std::string_view word = rest.substr(0, rest.find(' '));
      rest.remove_prefix(std::min(rest.size(), word.size() + 1));
      if (const FieldType* const next = named_type(word)) {
        type = next;
      } else {
        node.fields.push_back({word, *type});
      }
    }
  }
  return types;
}

}  // namespace spec97
}  // namespace

std::span<const NodeType> node_types_97() {
  static const std::vector<NodeType> types = spec97::table();
  return types;
}

}  // namespace apps::vrml
