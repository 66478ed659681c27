// SPDX-License-Identifier: MIT
// VRML 97: what it shares with VRML 1.0 means the same.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <radiosity/visibility/prepare.hpp>

#include "seed.hpp"
#include "vrml97.hpp"

using models::noted;

TEST_CASE("VRML 97: a random scene is the same model as in VRML 1.0") {
  const unsigned first = test::seed() % 1'000'000'000U;
  for (unsigned seed = first; seed < first + 100; ++seed) {
    CAPTURE(seed);
    const vrml_twins::Twins twins(seed);
    vrml97::check_same(models::read("a.wrl", twins.v1()), models::read("a.wrl", twins.v97()));
  }
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
  const auto objects = [](const std::string& body, const models::Files& files = {}) { return vrml97::read(body, files).objects.size(); };
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
        2);                                                    // one file has one name, or one that names itself has new ones for ever
  CHECK(objects("Inline { url \"in\\b.wrl\" }", files) == 2);  // as some systems write paths
  CHECK(objects("Inline { url \".\\in\\..\\in\\\\b.wrl\" }", files) == 2);
  CHECK(noted(vrml97::read(box + "Shape { geometry Text { string \"x\" } }").notes, "lines, points and texts have no surface"));
  CHECK(objects("ROUTE a.b TO c.d Script { url \"javascript: }\" field SFNode s NULL } DEF t TouchSensor { enabled FALSE }" + box) == 1);

  const auto reflectance = [&](const std::string& texture) {
    return *vrml97::read("Shape { appearance Appearance { material Material { diffuseColor 0.5 0 0 } texture " + texture +
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
      {vrml97::error(""), "expected a node such as Shape, found the end of the file"},
      {vrml97::error("Shape {\n  geometry Box { size 1 2 x } }"), ":3:27: error: expected a number for 'size', found 'x'"},
      {vrml97::error("Group {\n children [ Shape { }"), ":3:22: error: expected a node such as Shape, found the end of the file"},
      {vrml97::error("Separator { Cube { } }"),
       ":2:1: error: Separator is a node of VRML 1.0: let the first line of the file be '#VRML V1.0"},
      {vrml97::error("Grop [ ]"), "did you mean 'Group'?"},
      {vrml97::error("PROTO P { }"), "expected '[' after the prototype 'P', found '{'"},
      {vrml97::error("PROTO P [ field SFFlaot x ]"), "expected the type of a field such as SFFloat, found 'SFFlaot'"},
      {vrml97::error("PROTO P [ SFFloat x 1 ] { }"), "expected field, exposedField, eventIn, eventOut or ']', found 'SFFloat'"},
      {vrml97::error("PROTO P [ ] { Group { }"), "expected '}' to close the prototype that begins at 2:1"},
      {vrml97::error("Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0 ] }\ncoordIndex [ 0 1 2 ] } }"),
       ":3:18: error: there is no vertex '2'; the coordinates have 2, counted from 0"},
      {models::error("a.wrl", "#VRML V3.0\n"), ":1:1: error: expected '#VRML V2.0 utf8' or '#VRML V1.0 ascii' as the first line"},
  };
  for (const auto& [found, sentence] : cases) {
    CAPTURE(found, sentence);
    CHECK(found.find(sentence) != std::string::npos);
  }
  const std::string prototypes = "PROTO A [ ] { Shape { geometry Box { } } } PROTO B [ ] { A { } } Group { } ";
  CHECK(noted(vrml97::read(prototypes).notes, "the prototypes of this file have no instances in it"));
  CHECK_FALSE(noted(vrml97::read(prototypes + "B { }").notes, "no instances"));
  const apps::Model model = vrml97::read(
      "Odd { a [ DEF x Group { } ] b { } } Group { children USE x mine [ 1 2 [ 3 ] ] other Sphere { radius 3 } set_it TRUE siez 1 2 }\n"
      "Shape { geometry Box { solid TRUE size 2 2 2 } }");
  CHECK(model.objects.size() == 1);
  CHECK(noted(model.notes, "nodes of the type 'Odd' are not known: passed over, at line 2"));
  CHECK(noted(model.notes, "a Group has no field 'mine'"));
}

TEST_CASE("VRML: a node may be given two names, which the grammar does not allow") {
  const apps::Model model = vrml97::read("DEF a # twice\nDEF b Shape { geometry Box { } } USE a USE b");
  CHECK(model.objects.size() == 3);
  CHECK(models::error("a.wrl", "#VRML V2.0 utf8\nDEF a DEF { }\n").find("expected a name after DEF") != std::string::npos);
}
