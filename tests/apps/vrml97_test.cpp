// SPDX-License-Identifier: MIT
// VRML 97: what it shares with VRML 1.0 means the same; what is its own has areas and volumes that are known.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/scene/bounds.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "models.hpp"
#include "vrml_twins.hpp"

using models::noted;

namespace {

apps::Model read97(const std::string& body, const models::Files& files = {}) {
  return models::read("a.wrl", vrml_twins::head + body, files);
}
std::string error97(const std::string& body, const models::Files& files = {}) {
  return models::error("a.wrl", vrml_twins::head + body, files);
}
apps::Model read_shape(const std::string& geometry) { return read97("Shape { geometry " + geometry + " }"); }

std::vector<glm::dvec3> outline_of(const apps::Model& model, std::size_t polygon) {
  std::vector<glm::dvec3> points;
  for (std::size_t i = model.first_corner[polygon]; i < model.first_corner[polygon + 1]; ++i) {
    points.push_back(model.positions[model.corners[i]]);
  }
  return points;
}

// The sum of the vector areas' lengths, and the volume by the divergence theorem, positive when faces look outwards.
struct SweptExtent {
  double area = 0.0, volume = 0.0;
};
SweptExtent swept_extent(const apps::Model& model) {
  SweptExtent sum;
  for (std::size_t p = 0; p < model.polygons(); ++p) {
    const std::vector<glm::dvec3> points = outline_of(model, p);
    glm::dvec3 area(0.0);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const glm::dvec3 triangle = 0.5 * glm::cross(points[i] - points[0], points[i + 1] - points[0]);
      area += triangle;
      sum.volume += glm::dot(triangle, points[0]) / 3.0;
    }
    sum.area += glm::length(area);
  }
  return sum;
}

void check_same(const apps::Model& a, const apps::Model& b) {
  const auto same_look = [](const apps::ModelMaterial& m, const apps::ModelMaterial& n) {
    return m.reflectance == n.reflectance && m.emission == n.emission && m.two_sided == n.two_sided;
  };
  REQUIRE(a.objects.size() == b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    const radiosity::SceneObject &x = a.objects[i], &y = b.objects[i];
    CHECK(x.placement.linear == y.placement.linear);
    CHECK(x.placement.translation == y.placement.translation);
    CHECK(radiosity::placed_bounds(*x.shape, x.placement).hi == radiosity::placed_bounds(*y.shape, y.placement).hi);
    CHECK(x.shape->sheet_count() == y.shape->sheet_count());
    CHECK(same_look(a.materials[x.material[0]], b.materials[y.material[0]]));
  }
  CHECK(a.positions == b.positions);
  CHECK(a.corners == b.corners);
  CHECK(a.first_corner == b.first_corner);
  REQUIRE(a.polygons() == b.polygons());
  for (std::size_t p = 0; p < a.polygons(); ++p) { CHECK(same_look(a.materials[a.material[p]], b.materials[b.material[p]])); }
  REQUIRE((a.cameras.size() == 1 && b.cameras.size() == 1 && a.lights.size() == 1 && b.lights.size() == 1));
  CHECK(a.cameras[0].name == b.cameras[0].name);
  CHECK(a.cameras[0].forward == b.cameras[0].forward);
  CHECK(a.cameras[0].field_of_view == b.cameras[0].field_of_view);
  CHECK(a.lights[0].position == b.lights[0].position);
  CHECK(a.lights[0].intensity == b.lights[0].intensity);
}

}  // namespace

TEST_CASE("VRML 97: a random scene is the same model as in VRML 1.0") {
  const unsigned first = std::random_device{}() % 1'000'000'000U;
  for (unsigned seed = first; seed < first + 100; ++seed) {
    CAPTURE(seed);
    const vrml_twins::Twins twins(seed);
    check_same(models::read("a.wrl", twins.v1()), models::read("a.wrl", twins.v97()));
  }
}

TEST_CASE("VRML 97: extrusions have the volumes of prisms, pyramids and rings, and look outwards") {
  const std::string square = " crossSection [ 1 1, 1 -1, -1 -1, -1 1, 1 1 ] ";
  // Bounds of rounding: coordinates are of the order of 10, with six digits in the text.
  CHECK(swept_extent(read_shape("Extrusion { }")).volume == Approx(4.0));
  CHECK(swept_extent(read_shape("Extrusion { }")).area == Approx(4 + 4 + 4 * 2));
  CHECK(swept_extent(read_shape("Extrusion { ccw FALSE }")).volume == Approx(-4.0));
  CHECK(swept_extent(read_shape("Extrusion { beginCap FALSE }")).area == Approx(12.0));
  CHECK(swept_extent(read_shape("Extrusion { beginCap FALSE endCap FALSE }")).area == Approx(8.0));
  CHECK(swept_extent(read_shape("Extrusion { scale [ 1 1, 0 0 ] }")).volume == Approx(4.0 / 3.0));
  CHECK(swept_extent(read_shape("Extrusion { scale 2 0.25 orientation 0 1 0 0.7 }")).volume == Approx(2.0));
  std::mt19937 random(5);
  for (int i = 0; i < 20; ++i) {  // straight spines in any direction, with points between their ends
    const auto number = [&random] { return std::uniform_real_distribution(-3.0, 3.0)(random); };
    const glm::dvec3 from(number(), number(), number()), along(number(), number(), number());
    const std::string spine = "spine [ " + vrml_twins::text(from) + ", " + vrml_twins::text(from) + ", " +
                              vrml_twins::text(from + 0.3 * along) + ", " + vrml_twins::text(from + along) + " ]";
    CHECK(swept_extent(read_shape("Extrusion { " + spine + square + "}")).volume == Approx(4.0 * glm::length(along)).epsilon(1e-4));
  }
  CHECK(swept_extent(read_shape("Extrusion { spine [ 0 0 0, 0 -3 0 ] }")).volume == Approx(12.0));

  // A closed spine, a regular polygon: between two prisms over polygons of circumradius R - 1 and R + 1. Its start makes no difference,
  // nor does a spine that runs the other way round.
  constexpr int n = 12;
  const double R = 5.0, ring = 2.0 * (0.5 * n * std::sin(2.0 * std::numbers::pi / n)) * ((R + 1) * (R + 1) - (R - 1) * (R - 1));
  for (const double turn : {1.0, -1.0}) {
    std::string spine;
    for (int i = 0; i <= n; ++i) {
      const double angle = turn * 2.0 * std::numbers::pi * (i % n) / n;
      spine += vrml_twins::text({R * std::cos(angle), R * std::sin(angle), 0.0}) + ", ";
    }
    const apps::Model made = read_shape("Extrusion { spine [ " + spine + "]" + square + "}");
    CHECK(swept_extent(made).volume == Approx(ring).epsilon(1e-5));
    CHECK(made.polygons() == 4 * n);  // no caps
  }
  // It bends to one side and then to the other, in one plane: the cross-section keeps its z across that plane, so all is 2 high.
  const apps::Model bent = read_shape("Extrusion { spine [ 0 0 0, 0 4 0, 4 8 0, 4 12 0 ] }");
  for (const glm::dvec3& p : bent.positions) { CHECK(std::abs(std::abs(p.z) - 1.0) < 1e-12); }
  CHECK(models::scene("a.wrl", vrml_twins::head + "Shape { geometry Extrusion { spine [ 0 0 0, 0 4 0, 4 8 0, 4 12 0 ] } }")
            .scene.objects.size() == 3);

  // All points in one place, turned: a solid of revolution, here a cylinder of 24 slices.
  std::string places, turns;
  for (int i = 0; i <= 24; ++i) {
    places += "0 0 0, ";
    turns += "0 0 1 " + std::to_string(2.0 * std::numbers::pi * i / 24) + ", ";
  }
  const apps::Model round =
      read_shape("Extrusion { crossSection [ 0 1, 2 1, 2 -1, 0 -1 ] spine [ " + places + "] orientation [ " + turns + "] }");
  CHECK(std::abs(swept_extent(round).volume) == Approx(2.0 * 12.0 * 4.0 * std::sin(2.0 * std::numbers::pi / 24)).epsilon(1e-5));
}

TEST_CASE("VRML 97: elevation grids have the area of their plane and look up") {
  std::string heights;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) { heights += std::to_string(0.5 * i * 2.0 + 0.25 * j * 3.0) + " "; }
  }
  const std::string grid = "ElevationGrid { xDimension 3 zDimension 4 xSpacing 2 zSpacing 3 height [ " + heights + "] ";
  const apps::Model model = read_shape(grid + "}");
  CHECK(model.polygons() == 6);
  CHECK(swept_extent(model).area == Approx(4.0 * 9.0 * std::sqrt(1.0 + 0.25 + 0.0625)));
  const auto up = [](const apps::Model& m) {
    const auto p = outline_of(m, 0);
    return glm::cross(p[1] - p[0], p[2] - p[0]).y > 0.0;
  };
  CHECK(up(model));
  CHECK_FALSE(up(read_shape(grid + "ccw FALSE }")));
  CHECK_FALSE(model.materials[0].two_sided);
  CHECK(read_shape(grid + "solid FALSE }").materials[0].two_sided);
  const apps::Model colored =
      read_shape(grid + "colorPerVertex FALSE color Color { color [ 0.1 0 0, 0.2 0 0, 0.3 0 0, 0.4 0 0, 0.5 0 0, 0.6 0 0 ] } }");
  for (std::size_t p = 0; p < 6; ++p) { CHECK(colored.materials[colored.material[p]].reflectance->x == Approx(0.1 * (1.0 + double(p)))); }
  const std::string with_ball =
      "Shape { geometry Sphere { } } Shape { geometry ElevationGrid { xDimension 1e9 zDimension 1e9 height [ 1 ] } }";
  CHECK(noted(read97(with_ball).notes, "grids and extrusions with fewer numbers than they need"));
}

TEST_CASE("VRML 97: an instance of a prototype is its body with the values of the instance") {
  const std::string ball =
      "PROTO Ball [ field SFColor c 1 0 0  exposedField SFFloat r 1 field MFNode kids [ ] eventIn MFNode add ] {\n"
      "  Transform { children [ Shape { appearance Appearance { material Material { diffuseColor IS c } } geometry DEF S Sphere { radius "
      "IS r } }\n"
      "    Group { addChildren IS add children IS kids } Shape { geometry USE S } ] }\n  Shape { geometry Box { } } }\n";
  const apps::Model model = read97(ball + "DEF one Ball { r 2 } Ball { c 0 1 0 kids [ Shape { geometry Box { } } Ball { r 3 } ] } USE one");
  REQUIRE(model.objects.size() == 9);
  const auto width = [&](std::size_t i) { return radiosity::placed_bounds(*model.objects[i].shape, model.objects[i].placement).hi.x; };
  const double widths[] = {2, 2, 1, 1, 3, 3, 1, 2, 2};
  for (std::size_t i = 0; i < 9; ++i) { CHECK(width(i) == Approx(widths[i])); }
  CHECK(model.materials[model.objects[0].material[0]].reflectance == glm::dvec3(1, 0, 0));
  CHECK(model.materials[model.objects[2].material[0]].reflectance == glm::dvec3(0, 1, 0));

  // In the body of another, with its values; names and prototypes of a body are not seen outside.
  const apps::Model nested =
      read97(ball +
             "PROTO Two [ field SFFloat size 5 ] { PROTO Ball2 [ field SFFloat q 1 ] { Ball { r IS q } } Ball2 { q IS size } }\n"
             "Two { } Two { size 6 } Ball2 { q 7 }");
  REQUIRE(nested.objects.size() == 4);
  CHECK(radiosity::placed_bounds(*nested.objects[0].shape, nested.objects[0].placement).hi.x == Approx(5.0));
  CHECK(radiosity::placed_bounds(*nested.objects[2].shape, nested.objects[2].placement).hi.x == Approx(6.0));
  CHECK(noted(nested.notes, "nodes of the type 'Ball2' are not known"));
  CHECK(error97(ball + "Shape { geometry USE S }").find("USE names 'S'") != std::string::npos);

  const std::string box = "Shape { geometry Box { } }";
  CHECK(noted(read97("PROTO P [ ] { Group { children P { } } } P { }" + box).notes, "nodes of the type 'P' are not known"));
  CHECK(noted(read97("EXTERNPROTO P [ field SFInt32 n ] \"p.wrl\" P { n 3 }" + box).notes, "the prototype 'P' is in another file"));
  CHECK(noted(read97("PROTO P [ field SFFloat f 1 ] { Shape { geometry Box { size IS f } } } P { f 2 g 3 }").notes, "P has no field 'g'"));
  CHECK(noted(read97("PROTO P [ field SFFloat f 1 ] { Shape { geometry Box { size IS f } } } P { }").notes,
              "no prototype around has a field 'f'"));
}

// Instances are the same wherever their prototype stands: here, or in another file that has it under any name and folder.
TEST_CASE("VRML 97: prototypes of other files make what prototypes of the file make") {
  const std::string fields = "[ field SFColor c 1 0 0 field SFFloat r 1 ]", types = "[ field SFColor c field SFFloat r ]";
  const auto prototype = [&](const std::string& name, const std::string& geometry) {
    return "PROTO " + name + " " + fields +
           " { Shape { appearance Appearance { material Material { diffuseColor IS c } texture ImageTexture " +
           "{ url \"p.png\" } } geometry " + geometry + " } }\n";
  };
  const std::string ball = prototype("Ball", "Sphere { radius IS r }"), cone = prototype("Cone2", "Cone { height IS r }");
  const std::string uses = "Ball { } Transform { translation 5 0 0 children Ball { c 0 1 0 r 2 } } Viewpoint { } PointLight { }";
  const apps::Model expected = read97(ball + uses);
  REQUIRE(expected.objects.size() == 2);
  const auto external = [&](const std::string& urls) { return "EXTERNPROTO Ball " + types + " " + urls + "\n"; };
  const models::Files files{
      {"first.wrl", vrml_twins::head + ball + cone},
      {"in/second.wrl", vrml_twins::head + cone + ball},
      {"other.wrl", vrml_twins::head + "PROTO Globe " + fields + " { Group { } }\n" + prototype("Globe", "Sphere { radius IS r }")},
      {"in/links.wrl", vrml_twins::head + external("\"second.wrl#Ball\"") + "Box { }"}};
  for (const char* const urls : {"\"first.wrl\"", "[ \"first.wrl#Ball\" ]", "\"in/second.wrl#Ball\"",
                                 "[ \"urn:a:b\" \"http://a.b/c.wrl#Ball\" \"lost.wrl\" \"first.wrl\" ]",
                                 "[ \"first.wrl#Lost\" \"other.wrl#Globe\" ]", "\"./in/links.wrl#Ball\""}) {
    CAPTURE(urls);
    check_same(read97(external(urls) + uses, files), expected);
  }
  // What stands in another file is told with its name, and pictures are beside it.
  CHECK(noted(read97(external("\"in/second.wrl#Ball\"") + uses, files).notes, "of in/second.wrl"));
  std::vector<std::string> asked;
  const apps::SideFile record = [&](const std::string& name, std::string& fault) -> std::optional<std::string> {
    asked.push_back(name);
    return models::beside(files)(name, fault);
  };
  static_cast<void>(models::format("a.wrl").read(vrml_twins::head + external("\"in/second.wrl#Ball\"") + uses, record));
  CHECK(asked == std::vector<std::string>{"in/second.wrl", "in/p.png"});
  // Files that name each other end somewhere; a file with prototypes only has nothing to see.
  const models::Files circle{{"a.wrl", vrml_twins::head + external("\"b.wrl\"") + "Ball { }"},
                             {"b.wrl", vrml_twins::head + external("\"a.wrl\"") + "Ball { }"}};
  CHECK(noted(read97(external("\"a.wrl\"") + uses + "Shape { geometry Box { } }", circle).notes, "is in another file"));
  CHECK(read97(ball).objects.empty());
}

// Exporters write solids scaled to nothing, such as the handles of an editor.
TEST_CASE("VRML 97: solids that are lost in rounding beside the model are left out, small ones are not") {
  for (const double size : {1e-30, 1e-13, 1e-6, 1e-3}) {
    CAPTURE(size);
    const std::string factor = "1e" + std::to_string(static_cast<int>(std::lround(std::log10(size))));
    const std::string scale = " scale " + factor + " " + factor + " " + factor;
    const apps::SceneFile file = models::scene("a.wrl", vrml_twins::head + "DEF large Shape { geometry Sphere { } }\nTransform {" + scale +
                                                            " children DEF small Shape { geometry Box { } } }");
    const bool there = std::any_of(file.scene.objects.begin(), file.scene.objects.end(), [](const auto& o) { return o.name == "small"; });
    CHECK(there == (size > 1e-10));
    CHECK(noted(file.notes, "1 solid is smaller than 1e-11 of the model: left out") == !there);
    CHECK(radiosity::prepare(file.scene).faults.empty());
  }
}

TEST_CASE("VRML 97: groups, levels, files, colours of pictures, and what has no surface") {
  const auto objects = [](const std::string& body, const models::Files& files = {}) { return read97(body, files).objects.size(); };
  const std::string box = "Shape { geometry Box { } } ", two = "[ " + box + "Group { children [ " + box + box + "] } ]";
  for (const char* const type : {"Group", "Transform", "Anchor", "Billboard"}) {
    CHECK(objects(type + (" { children " + two + " }")) == 3);
  }
  CHECK(objects("Collision { proxy " + box + "children " + two + " }") == 3);
  CHECK(objects(box + "Switch { choice " + two + " }") == 1);
  CHECK(objects("Switch { whichChoice 1 choice " + two + " }") == 2);
  CHECK(objects("LOD { level " + two + " }") == 1);
  const models::Files files{{"in/b.wrl", vrml_twins::head + box + "Inline { url [ \"c.wrl\" ] }"},
                            {"in/c.wrl", "#VRML V1.0 ascii\nCube { }"}};
  CHECK(objects("Inline { url \"in/b.wrl\" }", files) == 2);
  CHECK(objects("Inline { url \"./in/../in//b.wrl\" }", files) ==
        2);  // one file has one name, or one that names itself has new ones for ever
  CHECK(noted(read97(box + "Shape { geometry Text { string \"x\" } }").notes, "lines, points and texts have no surface"));
  CHECK(objects("ROUTE a.b TO c.d Script { url \"javascript: }\" field SFNode s NULL } DEF t TouchSensor { enabled FALSE }" + box) == 1);

  const auto reflectance = [&](const std::string& texture) {
    return *read97("Shape { appearance Appearance { material Material { diffuseColor 0.5 0 0 } texture " + texture +
                   " } geometry Box { } }")
                .materials[0]
                .reflectance;
  };
  CHECK(reflectance("PixelTexture { image 1 1 3 0x00FF00 }") == glm::dvec3(0, 1, 0));
  CHECK(reflectance("PixelTexture { image 1 1 1 0xFF }") == glm::dvec3(0.5, 0, 0));
  CHECK(reflectance("ImageTexture { url \"none.png\" }") == glm::dvec3(0.5, 0, 0));
}

TEST_CASE("VRML 97: what is wrong is told with its place, what is not known is passed over") {
  const std::pair<std::string, const char*> cases[] = {
      {error97(""), "expected a node such as Shape, found the end of the file"},
      {error97("Shape {\n  geometry Box { size 1 2 x } }"), ":3:27: error: expected a number for 'size', found 'x'"},
      {error97("Group {\n children [ Shape { }"), ":3:22: error: expected a node such as Shape, found the end of the file"},
      {error97("Separator { Cube { } }"), ":2:1: error: Separator is a node of VRML 1.0: let the first line of the file be '#VRML V1.0"},
      {error97("Grop [ ]"), "did you mean 'Group'?"},
      {error97("PROTO P { }"), "expected '[' after the prototype 'P', found '{'"},
      {error97("PROTO P [ field SFFlaot x ]"), "expected the type of a field such as SFFloat, found 'SFFlaot'"},
      {error97("PROTO P [ SFFloat x 1 ] { }"), "expected field, exposedField, eventIn, eventOut or ']', found 'SFFloat'"},
      {error97("PROTO P [ ] { Group { }"), "expected '}' to close the prototype that begins at 2:1"},
      {error97("Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0 ] }\ncoordIndex [ 0 1 2 ] } }"),
       ":3:18: error: there is no vertex '2'; the coordinates have 2, counted from 0"},
      {models::error("a.wrl", "#VRML V3.0\n"), ":1:1: error: expected '#VRML V2.0 utf8' or '#VRML V1.0 ascii' as the first line"},
  };
  for (const auto& [found, sentence] : cases) {
    CAPTURE(found, sentence);
    CHECK(found.find(sentence) != std::string::npos);
  }
  const apps::Model model = read97(
      "Odd { a [ DEF x Group { } ] b { } } Group { children USE x mine [ 1 2 [ 3 ] ] other Sphere { radius 3 } set_it TRUE siez 1 2 }\n"
      "Shape { geometry Box { solid TRUE size 2 2 2 } }");
  CHECK(model.objects.size() == 1);
  CHECK(noted(model.notes, "nodes of the type 'Odd' are not known: passed over, at line 2"));
  CHECK(noted(model.notes, "a Group has no field 'mine'"));
}

TEST_CASE("VRML 97: no nesting, no prototype and no file in itself makes it crash or run without end") {
  std::string deep, uses, prototypes = "PROTO P0 [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } }\n", chain = prototypes;
  for (int i = 0; i < 100'000; ++i) { deep += "Group { children "; }
  CHECK(error97(deep).find("nodes are nested deeper than 200") != std::string::npos);
  deep.clear();
  for (int i = 0; i < 100'000; ++i) { deep += "PROTO P [ field SFNode n "; }
  CHECK(error97(deep).find("nodes are nested deeper than 200") != std::string::npos);
  uses = "DEF a0 Group { }\n";
  for (int i = 1; i < 100'000; ++i) { uses += "DEF a" + std::to_string(i) + " Group { children USE a" + std::to_string(i - 1) + " }\n"; }
  CHECK(error97(uses).find("nodes are nested deeper than 200") != std::string::npos);
  for (int i = 1; i < 60; ++i) {
    const std::string last = "P" + std::to_string(i - 1) + " { r IS r } ",
                      begin = "PROTO P" + std::to_string(i) + " [ field SFFloat r 1 ] { ";
    prototypes += begin + "Group { children [ " + last + last + "] } }\n";
  }
  CHECK(error97(prototypes + "P59 { }").find("instances of prototypes make more than 2000000 nodes") != std::string::npos);
  CHECK(error97("Inline { url \"a.wrl\" }", {{"a.wrl", vrml_twins::head + "Inline { url \"a.wrl\" }"}}).find("longer than 200") !=
        std::string::npos);

  const std::string whole =
      vrml_twins::head +
      "PROTO P [ field SFColor c 1 0 0 field MFNode k [ ] ] { Group { children [ Shape { appearance Appearance { material Material {\n"
      "diffuseColor IS c } } geometry DEF G Box { } } Group { children IS k } ] } }\nEXTERNPROTO Q [ eventIn SFBool b ] [ \"q.wrl\" ]\n"
      "P { c 0 0 1 k [ DEF s Shape { geometry Extrusion { spine [ 0 0 0, 1 1 1, 2 0 0 ] scale [ 1 1, 0 2 ] } } USE s ] } Q { b TRUE }\n"
      "Shape { geometry ElevationGrid { xDimension 2 zDimension 2 height [ 0 1 0 0 ] color Color { color [ 1 0 0 ] } } }\n"
      "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 ] } coordIndex [ 0 1 2 -1 ] } }\n"
      "Script { url \"x\" field SFNode n USE s } ROUTE s.a TO s.b\n";
  CHECK(models::result("a.wrl", whole).model);
  for (std::size_t length = 0; length < whole.size(); ++length) { static_cast<void>(models::result("a.wrl", whole.substr(0, length))); }
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int i = 0; i < 2000; ++i) {
    std::string changed = whole;
    for (int k = 0; k < 4; ++k) {
      const std::size_t at = random() % changed.size(), from = random() % changed.size();
      changed[at] = k == 0 ? "{}[],\"#-0 "[random() % 10] : k == 1 ? static_cast<char>(random()) : changed[from];
      if (k == 3) { changed.insert(at, changed.substr(from, random() % 60)); }
    }
    static_cast<void>(models::result("a.wrl", changed));
  }
}
