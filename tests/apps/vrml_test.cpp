// SPDX-License-Identifier: MIT
// VRML 1.0: the scene graph, its one traversal, and the objects that become of it.

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include <radiosity/scene/bounds.hpp>

#include "apps/scene_file.hpp"
#include "apps/vrml/scene_graph.hpp"
#include "models.hpp"

using models::noted;

namespace {

apps::Model read(const std::string& body, const models::Files& files = {}) {
  return models::read("a.wrl", "#VRML V1.0 ascii\n" + body, files);
}
std::string error(const std::string& body) { return models::error("a.wrl", "#VRML V1.0 ascii\n" + body); }

const std::string triangle = "Coordinate3 { point [ 1 0 0, 0 1 0, 0 0 1 ] } IndexedFaceSet { coordIndex [ 0, 1, 2, -1 ] }";

// Of the shapes, in the order of the walk: "sphere:red" and where they stand.
std::vector<std::string> shapes(const apps::Model& model) {
  std::vector<std::string> list;
  for (const radiosity::SceneObject& object : model.objects) {
    const glm::dvec3& t = object.placement.translation;
    list.push_back(object.name + ":" + model.materials[object.material[0]].name + "@" + std::to_string(static_cast<int>(t.x)));
  }
  return list;
}

raycast::Box bounds(const apps::Model& model, std::size_t object) {
  return radiosity::placed_bounds(*model.objects[object].shape, model.objects[object].placement);
}

}  // namespace

TEST_CASE("VRML: transforms act on what follows, the last one first") {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto number = [&] { return std::round(std::uniform_real_distribution(-3.0, 3.0)(random) * 8.0) / 8.0 + 0.0625; };
    const auto text = [](const glm::dvec3& v) { return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z); };
    glm::dmat4 expected(1.0);
    const glm::dmat4 unit(1.0);
    std::string body = "Separator { ";
    for (int i = 0; i < 6; ++i) {
      const glm::dvec3 a(number(), number(), number()), b(number(), number(), number()), c(number(), number(), number());
      const double angle = number(), tilt = number();
      switch (random() % 5) {
        case 0:
          body += "Translation { translation " + text(a) + " }\n";
          expected = expected * glm::translate(unit, a);
          break;
        case 1:
          body += "Rotation { rotation " + text(a) + " " + std::to_string(angle) + " }\n";
          expected = expected * glm::rotate(unit, angle, glm::normalize(a));
          break;
        case 2:
          body += "Scale { scaleFactor " + text(a) + " }\n";
          expected = expected * glm::scale(unit, a);
          break;
        case 3: {  // p' = p M: the translation stands in the last row
          body += "MatrixTransform { matrix " + text(a) + " 0 " + text(b) + " 0 " + text(c) + " 0 7 8 9 1 }\n";
          glm::dmat4 m(1.0);
          m[0] = {a, 0.0}, m[1] = {b, 0.0}, m[2] = {c, 0.0}, m[3] = {7.0, 8.0, 9.0, 1.0};
          expected = expected * m;
          break;
        }
        default:
          body += "Transform { translation " + text(a) + " rotation 0 1 0 " + std::to_string(angle) + " scaleFactor " + text(b) +
                  " scaleOrientation 1 0 0 " + std::to_string(tilt) + " center " + text(c) + " }\n";
          expected = expected * glm::translate(unit, a) * glm::translate(unit, c) * glm::rotate(unit, angle, glm::dvec3(0, 1, 0)) *
                     glm::rotate(unit, tilt, glm::dvec3(1, 0, 0)) * glm::scale(unit, b) * glm::rotate(unit, -tilt, glm::dvec3(1, 0, 0)) *
                     glm::translate(unit, -c);
      }
    }
    const apps::Model model = read(body + triangle + "}");
    REQUIRE(model.polygons() == 1);
    const bool mirrored = glm::determinant(glm::dmat3(expected)) < 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      glm::dvec4 corner(0, 0, 0, 1);
      corner[static_cast<int>(mirrored ? 2 - i : i)] = 1.0;
      const glm::dvec3 p(expected * corner);
      CHECK(glm::length(models::corner(model, 0, i) - p) < 1e-9 * (1.0 + glm::length(p)));
    }
  }
}

TEST_CASE("VRML: what a Separator changes stays in it, a Group passes it on") {
  const std::string red = "DEF red Material { diffuseColor 1 0 0 }", go = "Translation { translation 1 0 0 }";
  const auto of = [&](const std::string& body) { return shapes(read("Group { " + body + " Sphere { } }")); };
  using List = std::vector<std::string>;
  CHECK(of("Separator { " + red + go + "}") == List{"sphere:default@0"});
  CHECK(of("Group { " + red + go + "}") == List{"sphere:red@1"});
  CHECK(of("TransformSeparator { " + red + go + "}") == List{"sphere:red@0"});
  CHECK(of("WWWAnchor { name \"x\" " + red + go + "}") == List{"sphere:default@0"});
  CHECK(of("Switch { " + red + go + "}") == List{"sphere:default@0"});
  CHECK(of("Switch { whichChild 0 " + red + go + "}") == List{"sphere:red@0"});
  CHECK(of("Switch { whichChild -3 " + red + go + "}") == List{"sphere:red@1"});
  CHECK(of("LOD { range [ 1 ] " + red + go + "}") == List{"sphere:red@0"});
  CHECK(of("DEF g Group { " + go + " Cube { } } " + red + " USE g") == List{"box:default@1", "box:red@2", "sphere:red@2"});
  CHECK(of("Unknown { a [ 1 2 { 3 } ] b \"}\" } " + go) == List{"sphere:default@1"});
  CHECK(of("Own { fields [ SFFloat a, MFString isA ] a 3 isA [ \"None\" \"Translation\" ] translation 2 0 0 }") ==
        List{"sphere:default@2"});
  CHECK(of("WWWInline { name \"a.wrl\" }") == List{"sphere:default@0"});
  const apps::Model inlined =
      read("Group { WWWInline { name \"b.wrl\" } Translation { translation 3 0 0 } WWWInline { name \"b.wrl\" } Sphere { } }",
           {{"b.wrl", "#VRML V1.0 ascii\nGroup { Translation { translation 1 0 0 } Cube { } }"}});
  CHECK(shapes(inlined) == List{"box:default@1", "box:default@4", "sphere:default@3"});
}

TEST_CASE("VRML: cubes, cylinders and cones stay analytic, their parts have the materials of the binding") {
  const std::string materials =
      "Material { diffuseColor [ 0.1 0 0, 0.2 0 0, 0.3 0 0, 0.4 0 0, 0.5 0 0, 0.6 0 0 ] } MaterialBinding { value PER_PART }";
  const apps::Model model =
      read("Group { " + materials + " Cube { width 1 height 2 depth 3 } Cylinder { radius 0.5 height 4 } Cone { } Sphere { radius 2 } }");
  REQUIRE(model.objects.size() == 4);
  CHECK(bounds(model, 0).hi == glm::dvec3(0.5, 1, 1.5));
  CHECK(glm::length(bounds(model, 1).hi - glm::dvec3(0.5, 2, 0.5)) < 1e-9);
  CHECK(glm::length(bounds(model, 2).lo - glm::dvec3(-1, -1, -1)) < 1e-9);
  const auto red = [&](std::size_t object, const char* sheet) {
    const radiosity::SceneObject& o = model.objects[object];
    for (std::uint32_t s = 0; s < o.shape->sheet_count(); ++s) {
      if (o.shape->sheet_name(s) == sheet) { return model.materials[o.material[s]].reflectance->x; }
    }
    return -1.0;
  };
  // Cube: front, back, left, right, top, bottom. Cylinder: sides, top, bottom. Cone: sides, bottom.
  const std::tuple<std::size_t, const char*, double> parts[] = {{0, "z1", 0.1},     {0, "z0", 0.2},   {0, "x0", 0.3},    {0, "x1", 0.4},
                                                                {0, "y1", 0.5},     {0, "y0", 0.6},   {1, "side", 0.1},  {1, "top", 0.2},
                                                                {1, "bottom", 0.3}, {2, "side", 0.1}, {2, "bottom", 0.2}};
  for (const auto& [object, sheet, value] : parts) {
    CAPTURE(object, sheet);
    CHECK(red(object, sheet) == value);
  }
  const apps::Model open = read("Group { Cylinder { parts (SIDES | BOTTOM) } Cone { parts SIDES } Scale { scaleFactor 1 0 1 } Cube { } }");
  CHECK(open.objects.empty());
  CHECK(open.polygons() == 32 + 1 + 32);
  CHECK(open.materials[open.material[0]].two_sided);
  CHECK(noted(open.notes, "flattened by their transform"));
}

TEST_CASE("VRML: face sets with every binding, orders and hints") {
  const std::string points = "Coordinate3 { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }",
                    colors = "Material { diffuseColor [ 0.1 0 0, 0.2 0 0, 0.3 0 0 ] }";
  const auto reds = [&](const std::string& binding, const std::string& more) {
    const apps::Model model = read("Group { " + points + colors + "MaterialBinding { value " + binding +
                                   " } IndexedFaceSet { coordIndex [ 0 1 2 -1, 0 2 3 -1 ] " + more + "} }");
    std::vector<double> list;
    for (std::size_t p = 0; p < model.polygons(); ++p) { list.push_back(model.materials[model.material[p]].reflectance->x); }
    return list;
  };
  using List = std::vector<double>;
  CHECK(reds("OVERALL", "") == List{0.1, 0.1});
  CHECK(reds("DEFAULT", "") == List{0.1, 0.1});
  CHECK(reds("PER_FACE", "") == List{0.1, 0.2});
  CHECK(reds("PER_FACE_INDEXED", "materialIndex [ 2 1 ]") == List{0.3, 0.2});
  CHECK(reds("PER_FACE_INDEXED", "") == List{0.1, 0.2});
  // A material for each corner: the mean of their colours.
  const auto near = [](const List& list, double first, double second) {
    REQUIRE(list.size() == 2);
    CHECK(list[0] == Approx(first).epsilon(1e-12));
    CHECK(list[1] == Approx(second).epsilon(1e-12));
  };
  near(reds("PER_VERTEX", ""), 0.2, 0.2);  // the fourth corner begins again
  near(reds("PER_VERTEX_INDEXED", "materialIndex [ 2 0 0 -1 1 0 0 -1 ]"), 0.5 / 3.0, 0.4 / 3.0);
  near(reds("PER_VERTEX_INDEXED", ""), 0.2, 0.5 / 3.0);  // by the coordinates: 0 1 2, then 0 2 3, of which 3 begins again

  const auto hinted = [&](const std::string& hints) {
    return read("Group { " + points + "ShapeHints { " + hints + " } IndexedFaceSet { coordIndex [ 0 1 2 3 ] } }");
  };
  CHECK(models::corner(hinted("vertexOrdering CLOCKWISE"), 0, 0) == glm::dvec3(0, 1, 0));
  CHECK(models::corner(hinted("vertexOrdering COUNTERCLOCKWISE"), 0, 0) == glm::dvec3(0, 0, 0));
  CHECK(hinted("").materials[0].two_sided);
  CHECK_FALSE(hinted("vertexOrdering COUNTERCLOCKWISE shapeType SOLID").materials[0].two_sided);
  CHECK(noted(read("Group { Cube { } IndexedFaceSet { coordIndex [ 0 1 2 ] } }").notes, "face sets without coordinates"));
  const std::string triangle = "Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] } IndexedFaceSet { coordIndex [ 0 1 2 ] } }";
  CHECK(noted(read("Group { ShapeHints { creaseAngle 0.6 } " + triangle).notes, "a creaseAngle changes how polygons are shaded"));
  CHECK_FALSE(noted(read("Group { ShapeHints { creaseAngle 0 } " + triangle).notes, "creaseAngle"));
}

TEST_CASE("VRML: cameras, also those to choose from, lights become small lamps") {
  const std::string body =
      "Group { DEF Cameras Switch { whichChild 0 DEF front PerspectiveCamera { position 0 0 5 } "
      "DEF right PerspectiveCamera { position 5 0 0 orientation 0 1 0 1.5707963267948966 heightAngle 1 } "
      "OrthographicCamera { height 3 focalDistance 4 } } PointLight { location 0 3 0 intensity 0.5 } SpotLight { on FALSE } "
      "DirectionalLight { } Sphere { } }";
  const apps::Model model = read(body);
  REQUIRE(model.cameras.size() == 3);
  CHECK(model.cameras[0].name == "front");
  CHECK(glm::length(model.cameras[1].forward - glm::dvec3(-1, 0, 0)) < 1e-12);
  CHECK(model.cameras[1].field_of_view == Approx(2.0 * std::atan(4.0 / 3.0 * std::tan(0.5)) * 180.0 / std::numbers::pi));
  // 3 x 4 are seen at the distance 4.
  CHECK(model.cameras[2].field_of_view == Approx(2.0 * std::atan(0.5 * 4.0 / 4.0) * 180.0 / std::numbers::pi));
  CHECK(noted(model.notes, "cameras without perspective get one that shows as much at their focal distance"));
  REQUIRE(model.lights.size() == 2);
  const apps::SceneFile file = models::scene("a.wrl", "#VRML V1.0 ascii\n" + body);
  REQUIRE(file.scene.objects.size() == 3);
  CHECK(file.scene.objects[1].name == "light");
  CHECK(noted(file.notes, "1 directional light became a sun"));
  CHECK(noted(file.notes, "1 light has no surface: a lamp of"));
  CHECK(file.cameras[0].eye == glm::dvec3(0, -5, 0));
}

TEST_CASE("VRML: what is wrong is told with its place") {
  const std::pair<std::string, const char*> cases[] = {
      {models::error("a.wrl", "Separator { }"), ":1:1: error: expected '#VRML V2.0 utf8' or '#VRML V1.0 ascii' as the first line"},
      {error(""), "expected a node such as Separator, found the end of the file"},
      {error("Group {\n  Cube { }\n"), ":4:1: error: expected '}' to close the node Group that begins at 2:1, found the end of the file"},
      {error("Group { Cube { width x } }"), ":2:22: error: expected a number for 'width', found 'x'"},
      {error("Group { Sphere }"), ":2:16: error: expected '{' after the node 'Sphere', found '}'"},
      {error("Group { Spehre [ ] }"), "did you mean 'Sphere'?"},
      {error("Group { USE x }"), "USE names 'x', but no node before it is called that by DEF"},
      {error("Group { DEF x Group { USE x } }"), "USE names 'x'"},
      {error("Group { Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] }\n\n IndexedFaceSet { coordIndex [ 0, 1, 3 ] } }"),
       ":4:38: error: there is no vertex '3'; the coordinates have 3, counted from 0"},
      {error("Group { Coordinate3 { point [ 0 0 0"), "expected ']' to close the values of 'point'"},
      {error("Group { Info { string \"x } }"), "expected '}' to close the node Info"},
      {error("Group { fields [ SFFlaot x ] }"), "expected the type of a field such as SFFloat, found 'SFFlaot'"},
  };
  for (const auto& [text, sentence] : cases) {
    CAPTURE(text, sentence);
    CHECK(text.find(sentence) != std::string::npos);
  }
  CHECK(
      noted(read("Group { Sphere { raduis 3 } }").notes, "a Sphere has no field 'raduis'; did you mean 'radius'?: passed over, at line 2"));
  // Ends of lines of every kind are counted alike.
  CHECK(models::error("a.wrl", "#VRML V1.0 ascii\r\rGroup {\r  x }").substr(0, 5) == ":4:5:");
  CHECK(models::error("a.wrl", "#VRML V1.0 ascii\r\n\r\nGroup {\r\n  Cube { width x }").substr(0, 6) == ":4:16:");
}

TEST_CASE("VRML: a file cannot change what the fields of a known node are") {
  const std::string redeclared =
      "Coordinate3 { point [ 1 0 0, 0 1 0, 0 0 1 ] } IndexedFaceSet { fields [ MFFloat coordIndex ] coordIndex [ 0, 1, 2, -1 ] }";
  CHECK(read(redeclared).polygons() == read(triangle).polygons());
}

TEST_CASE("VRML: no nesting and no use of uses makes it crash or run without end") {
  std::string deep, uses = "Group { DEF a0 Group { Cube { } }";
  for (int i = 0; i < 100'000; ++i) { deep += "Group { "; }
  CHECK(error(deep).find("nodes are nested deeper than 200") != std::string::npos);
  for (int i = 1; i < 40; ++i) {
    const std::string last = "USE a" + std::to_string(i - 1) + " ";
    uses += "DEF a" + std::to_string(i) + " Group { " + last + last + "}\n";
  }
  CHECK(error(uses + "}").find("uses of uses make more than") != std::string::npos);
  CHECK(models::error("a.wrl", "#VRML V1.0 ascii\nWWWInline { name \"a.wrl\" }",
                      {{"a.wrl", "#VRML V1.0 ascii\nWWWInline { name \"a.wrl\" }"}})
            .find("a way through it is longer than") != std::string::npos);

  const unsigned seed = 9;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const std::string whole =
      "#VRML V1.0 ascii\nSeparator { DEF m Material { diffuseColor [ 1 0 0, 0 1 0 ] } fields [ SFFloat a ] isA \"Group\" " + triangle +
      "ShapeHints { vertexOrdering CLOCKWISE } Cylinder { parts (SIDES|TOP) } USE m Texture2 { image 2 1 1 0xFF 7 } Switch { whichChild 0 "
      "Cone { } } }";
  for (std::size_t length = 0; length < whole.size(); ++length) { static_cast<void>(models::result("a.wrl", whole.substr(0, length))); }
  for (int i = 0; i < 1000; ++i) {
    std::string changed = whole;
    for (int k = 0; k < 3; ++k) {
      changed[random() % changed.size()] = k == 0 ? "{}[](),\"#|-0 "[random() % 13] : static_cast<char>(random());
    }
    static_cast<void>(models::result("a.wrl", changed));
  }
}

TEST_CASE("VRML: files of others are read, damaged ones refused with a place") {
  namespace fs = std::filesystem;
  const fs::path data = HALFLIGHT_REFERENCE_DATA;
  if (!fs::exists(data / "vrml1")) { SKIP_TEST("no files of others"); }
  std::size_t count = 0;
  for (const char* folder : {"vrml1", "vrml1_malformed"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(data / folder)) {
      if (entry.path().extension() != ".wrl") { continue; }
      const std::string name = entry.path().filename().string();
      std::string fault;
      const auto result = models::result(name, apps::read_text(entry.path().string(), fault).value());
      INFO(name << " " << apps::to_text(result, name));
      const bool damaged = std::string_view(folder) == "vrml1_malformed" && name != "lone_cr.wrl";
      CHECK(result.model.has_value() == !damaged);
      ++count;
    }
  }
  CHECK(count == 26);
}
