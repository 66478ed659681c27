// SPDX-License-Identifier: MIT
// Prototypes of VRML 97: an instance is the body of its prototype, wherever that stands, and no nesting runs without end.

#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <radiosity/scene/bounds.hpp>

#include "seed.hpp"
#include "vrml97.hpp"

using models::noted;

TEST_CASE("VRML 97: an instance of a prototype is its body with the values of the instance") {
  const std::string ball =
      "PROTO Ball [ field SFColor c 1 0 0  exposedField SFFloat r 1 field MFNode kids [ ] eventIn MFNode add ] {\n"
      "  Transform { children [ Shape { appearance Appearance { material Material { diffuseColor IS c } } geometry DEF S Sphere { radius "
      "IS r } }\n"
      "    Group { addChildren IS add children IS kids } Shape { geometry USE S } ] }\n  Shape { geometry Box { } } }\n";
  const apps::Model model =
      vrml97::read(ball + "DEF one Ball { r 2 } Ball { c 0 1 0 kids [ Shape { geometry Box { } } Ball { r 3 } ] } USE one");
  REQUIRE(model.objects.size() == 9);
  const auto width = [&](std::size_t i) { return radiosity::placed_bounds(*model.objects[i].shape, model.objects[i].placement).hi.x; };
  const double widths[] = {2, 2, 1, 1, 3, 3, 1, 2, 2};
  for (std::size_t i = 0; i < 9; ++i) { CHECK(width(i) == Approx(widths[i])); }
  CHECK(model.materials[model.objects[0].material[0]].reflectance == glm::dvec3(1, 0, 0));
  CHECK(model.materials[model.objects[2].material[0]].reflectance == glm::dvec3(0, 1, 0));

  // In the body of another, with its values; names and prototypes of a body are not seen outside.
  const apps::Model nested =
      vrml97::read(ball +
                   "PROTO Two [ field SFFloat size 5 ] { PROTO Ball2 [ field SFFloat q 1 ] { Ball { r IS q } } Ball2 { q IS size } }\n"
                   "Two { } Two { size 6 } Ball2 { q 7 }");
  REQUIRE(nested.objects.size() == 4);
  CHECK(radiosity::placed_bounds(*nested.objects[0].shape, nested.objects[0].placement).hi.x == Approx(5.0));
  CHECK(radiosity::placed_bounds(*nested.objects[2].shape, nested.objects[2].placement).hi.x == Approx(6.0));
  CHECK(noted(nested.notes, "nodes of the type 'Ball2' are not known"));
  CHECK(vrml97::error(ball + "Shape { geometry USE S }").find("USE names 'S'") != std::string::npos);

  const std::string box = "Shape { geometry Box { } }";
  CHECK(noted(vrml97::read("PROTO P [ ] { Group { children P { } } } P { }" + box).notes, "nodes of the type 'P' are not known"));
  CHECK(noted(vrml97::read("EXTERNPROTO P [ field SFInt32 n ] \"p.wrl\" P { n 3 }" + box).notes, "the prototype 'P' is in another file"));
  CHECK(noted(vrml97::read("PROTO P [ field SFFloat f 1 ] { Shape { geometry Box { size IS f } } } P { f 2 g 3 }").notes,
              "P has no field 'g'"));
  CHECK(noted(vrml97::read("PROTO P [ field SFFloat f 1 ] { Shape { geometry Box { size IS f } } } P { }").notes,
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
  const apps::Model expected = vrml97::read(ball + uses);
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
    vrml97::check_same(vrml97::read(external(urls) + uses, files), expected);
  }
  // What stands in another file is told with its name, and pictures are beside it.
  CHECK(noted(vrml97::read(external("\"in/second.wrl#Ball\"") + uses, files).notes, "of in/second.wrl"));
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
  CHECK(noted(vrml97::read(external("\"a.wrl\"") + uses + "Shape { geometry Box { } }", circle).notes, "is in another file"));
  CHECK(vrml97::read(ball).objects.empty());
}

TEST_CASE("VRML 97: no nesting, no prototype and no file in itself makes it crash or run without end") {
  std::string deep, uses, prototypes = "PROTO P0 [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } }\n", chain = prototypes;
  for (int i = 0; i < 100'000; ++i) { deep += "Group { children "; }
  CHECK(vrml97::error(deep).find("nodes are nested deeper than 200") != std::string::npos);
  deep.clear();
  for (int i = 0; i < 100'000; ++i) { deep += "PROTO P [ field SFNode n "; }
  CHECK(vrml97::error(deep).find("nodes are nested deeper than 200") != std::string::npos);
  uses = "DEF a0 Group { }\n";
  for (int i = 1; i < 100'000; ++i) { uses += "DEF a" + std::to_string(i) + " Group { children USE a" + std::to_string(i - 1) + " }\n"; }
  CHECK(vrml97::error(uses).find("nodes are nested deeper than 200") != std::string::npos);
  for (int i = 1; i < 60; ++i) {
    const std::string last = "P" + std::to_string(i - 1) + " { r IS r } ",
                      begin = "PROTO P" + std::to_string(i) + " [ field SFFloat r 1 ] { ";
    prototypes += begin + "Group { children [ " + last + last + "] } }\n";
  }
  CHECK(vrml97::error(prototypes + "P59 { }").find("instances of prototypes make more than 2000000 nodes") != std::string::npos);
  CHECK(vrml97::error("Inline { url \"a.wrl\" }", {{"a.wrl", vrml_twins::head + "Inline { url \"a.wrl\" }"}}).find("longer than 200") !=
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
  const unsigned seed = test::seed();
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
