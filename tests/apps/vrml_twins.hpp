// SPDX-License-Identifier: MIT
#pragma once

// Random scenes in VRML 1.0 and in VRML 97 at once, for the test that both are the same model: groups with transforms that mirror, of which
// some are used again, solids with and without all their parts, face sets with colours, a camera and a light.

#include <cstddef>
#include <string>

#include <glm/vec3.hpp>

#include "random_numbers.hpp"

namespace vrml_twins {

inline const std::string head = "#VRML V2.0 utf8\n";

inline std::string text(const glm::dvec3& v) { return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z); }

class Twins : RandomNumbers {
 public:
  explicit Twins(unsigned seed) : RandomNumbers(seed) {
    group(0);
    const std::string at = text(vector(-5.0, 5.0)), turn = text(vector(0.1, 1.0)) + " " + std::to_string(number(-3.0, 3.0));
    both("DEF view PerspectiveCamera { heightAngle 0.7", "DEF view Viewpoint { fieldOfView 0.7");
    both(" position " + at + " orientation " + turn + " }\nPointLight { location " + at + " color 1 0.5 0 }\n");
  }
  [[nodiscard]] std::string v1() const { return "#VRML V1.0 ascii\nSeparator {\n" + v1_ + "}\n"; }
  [[nodiscard]] std::string v97() const { return head + v97_; }

 private:
  void both(const std::string& v1, const std::string& v97) { v1_ += v1, v97_ += v97; }
  void both(const std::string& same) { both(same, same); }

  void group(int depth) {
    const std::string name = "g" + std::to_string(groups_++), by = text(vector(0.5, 2.0));
    both("DEF " + name + " Separator { Transform {", "DEF " + name + " Transform {");
    const auto turn = [this] { return text(vector(0.1, 1.0)) + " " + std::to_string(number(-3.0, 3.0)); };
    both(" translation " + text(vector(-3.0, 3.0)) + " rotation " + turn() + " scaleOrientation " + turn() + " center " +
         text(vector(-1.0, 1.0)));
    both(" scaleFactor -" + by + " }\n", " scale -" + by + "\nchildren [\n");
    for (int i = 1 + below(3); i > 0; --i) {
      if (depth < 3 && below(2) == 0) {
        group(depth + 1);
      } else {
        shape();
      }
    }
    both("}\n", "] }\n");
    if (depth > 0 && below(3) == 0) { both("USE " + name + "\n"); }
  }

  void shape() {
    const std::string look = "Material { diffuseColor " + text(vector(0.0, 1.0)) + " emissiveColor " + text(vector(0.0, 3.0)) + " }";
    const bool flag = below(2) == 0, other = below(2) == 0;
    both("Separator { " + look, "Shape { appearance Appearance { material " + look + " } geometry ");
    const glm::dvec3 s = vector(0.2, 2.0);
    const std::string x = std::to_string(s.x), y = std::to_string(s.y), z = std::to_string(s.z);
    switch (below(5)) {
      case 0:
        both(" Cube { width " + x + " height " + y + " depth " + z, "Box { size " + text(s));
        break;
      case 1:
        both("Sphere { radius " + x);
        break;
      case 2:
        both(std::string("Cylinder { parts (SIDES") + (flag ? "|TOP" : "") + (other ? "|BOTTOM)" : ")"),
             std::string("Cylinder { top ") + (flag ? "TRUE" : "FALSE") + " bottom " + (other ? "TRUE" : "FALSE"));
        both(" radius " + x + " height " + y);
        break;
      case 3:
        both(std::string("Cone { parts (SIDES") + (other ? "|BOTTOM)" : ")"), std::string("Cone { bottom ") + (other ? "TRUE" : "FALSE"));
        both(" bottomRadius " + x + " height " + y);
        break;
      default: {
        const std::string points = "{ point [ 0 0 0, " + x + " 0 0, 0 " + y + " 0, 0 0 " + z + " ] }",
                          colors = "[ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1 ]", faces = " coordIndex [ 0 2 1 -1 0 1 3 -1 1 2 3 -1 2 0 3 ]";
        const bool list = below(2) == 0, of_faces = below(2) == 0;
        const std::string index = !list ? "" : of_faces ? "Index [ 3 2 0 4 ]" : "Index [ 4 3 2 -1 0 0 1 -1 2 3 4 -1 1 1 1 ]";
        both("Material { diffuseColor " + colors + " } MaterialBinding { value " + (of_faces ? "PER_FACE" : "PER_VERTEX") +
                 "_INDEXED } Coordinate3 " + points + "ShapeHints { vertexOrdering " + (flag ? "COUNTER" : "") + "CLOCKWISE shapeType " +
                 (other ? "SOLID" : "UNKNOWN_SHAPE_TYPE") + " } IndexedFaceSet {" + faces + (list ? " material" + index : ""),
             "IndexedFaceSet { coord Coordinate " + points + " color Color { color " + colors + " } ccw " + (flag ? "TRUE" : "FALSE") +
                 " solid " + (other ? "TRUE" : "FALSE") + " colorPerVertex " + (of_faces ? "FALSE" : "TRUE") + faces +
                 (list ? " color" + index : ""));
        v1_.replace(v1_.rfind(look), look.size(), "");
        v97_.replace(v97_.rfind(look), look.size(), "Material { }");
      }
    }
    both(" } }\n");
  }

  std::string v1_, v97_;
  int groups_ = 0;
};

}  // namespace vrml_twins
