// SPDX-License-Identifier: MIT
// glTF 2.0 and GLB, and the JSON that holds them.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "apps/intake/json_reader.hpp"
#include "gltf_sample.hpp"
#include "models.hpp"

using gltf_sample::Sample;
using gltf_sample::substitution;
using models::noted;
using models::read;
using models::scene;

TEST_CASE("glTF: text with its data, a file beside it, and the binary form say the same") {
  for (const int type : {5121, 5123, 5125}) {
    CAPTURE(type);
    const Sample sample(type);
    const apps::Model one = read("a.gltf", sample.embedded());
    const apps::Model two = read("a.gltf", sample.text("my%20data.bin"), {{"my data.bin", sample.binary}});
    const apps::Model three = read("a.glb", sample.glb());
    REQUIRE(one.polygons() == 2);
    CHECK(one.groups == std::vector<std::string>{"square"});
    CHECK(models::corner(one, 1, 1) == glm::dvec3(1, 1, 0));
    const apps::Model four = read("a.glb", sample.glb(5)), five = read("a.glb", sample.glb(7));
    for (const apps::Model* other : {&two, &three, &four, &five}) {
      CHECK(other->positions == one.positions);
      CHECK(other->corners == one.corners);
    }
  }
  CHECK(scene("a.glb", Sample().glb()).scene.objects[1].shape->sheet_count() == 1);  // one face, behind the studio
}

TEST_CASE("glTF: a buffer is looked for without those of its folders that are not there") {
  const Sample sample;
  for (const std::string lost : {"", "assets/", "../old/assets/"}) {
    for (const std::string kept : {"", "data/", "data/of it/"}) {
      CAPTURE(lost, kept);
      CHECK(read("a.gltf", sample.text(lost + kept + "a.bin"), {{kept + "a.bin", sample.binary}}).polygons() == 2);
    }
  }
  std::string deep;
  for (int i = 0; i < 100000; ++i) { deep += "a/"; }
  CHECK(read("a.gltf", sample.text(deep + "a.bin"), {{"a.bin", sample.binary}}).polygons() == 2);  // soon
}

TEST_CASE("glTF: nodes place what is below them") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto number = [&] { return std::uniform_real_distribution(-2.0, 2.0)(random); };
    Sample sample;
    glm::dmat4 expected(1.0);
    sample.nodes = "[";
    for (int i = 0; i < 6; ++i) {
      glm::dmat4 own(1.0);
      std::string text;
      const auto list = [](const auto& values, int count) {
        std::string out = "[";
        for (int k = 0; k < count; ++k) { out += (k > 0 ? "," : "") + std::to_string(values[k]); }
        return out + "]";
      };
      const auto rounded = [](double x) { return std::stod(std::to_string(x)); };
      if (i % 2 == 0) {
        double m[16];
        for (int k = 0; k < 16; ++k) { own[k / 4][k % 4] = m[k] = k % 4 == 3 ? (k == 15 ? 1.0 : 0.0) : rounded(number()); }
        text = "\"matrix\": " + list(m, 16);
      } else {
        const glm::dvec3 t(rounded(number()), rounded(number()), rounded(number())), s(rounded(number()), 2.0, 3.0);
        const double angle = number();
        const double q[4] = {0.0, rounded(std::sin(angle / 2.0)), 0.0, rounded(std::cos(angle / 2.0))};
        own = glm::scale(glm::rotate(glm::translate(glm::dmat4(1.0), t), angle, glm::dvec3(0, 1, 0)), s);
        text = "\"translation\": " + list(t, 3) + ", \"rotation\": " + list(q, 4) + ", \"scale\": " + list(s, 3);
      }
      expected = expected * own;
      sample.nodes += (i > 0 ? ", {" : "{") + text + (i < 5 ? ", \"children\": [" + std::to_string(i + 1) + "]}" : ", \"mesh\": 0}]");
    }
    const apps::Model model = read("a.gltf", sample.embedded());
    REQUIRE(model.polygons() == 2);
    const bool mirrored = glm::determinant(glm::dmat3(expected)) < 0.0;
    const glm::dvec3 p = glm::dvec3(expected * glm::dvec4(1, 1, 0, 1));
    // A rotation is written with six digits: 1e-6 for each of three, times what the others stretch, below 10^6 each way.
    CHECK(glm::length(models::corner(model, 0, mirrored ? 1 : 2) - p) < 1e-4 * (1.0 + glm::length(p)));
  }
}

TEST_CASE("glTF: materials and cameras") {
  Sample sample;
  sample.primitive =
      "{\"attributes\": {\"POSITION\": 0}, \"material\": 0, \"mode\": 5}, {\"attributes\": {\"POSITION\": 0}, \"material\": 1, \"mode\": "
      "6},"
      "{\"attributes\": {\"POSITION\": 0}, \"mode\": 1}, {\"attributes\": {\"POSITION\": 0}}";
  sample.nodes = "[{\"mesh\": 0, \"camera\": 0, \"translation\": [0, 0, 5], \"name\": \"eye\", \"children\": [1]}, {\"camera\": 1}]";
  sample.more =
      ", \"materials\": [{\"name\": \"red\", \"doubleSided\": true, \"pbrMetallicRoughness\": {\"baseColorFactor\": [0.5, 0.25, 0.125, "
      "1]}},"
      "{\"emissiveFactor\": [1, 0.5, 0], \"extensions\": {\"KHR_materials_emissive_strength\": {\"emissiveStrength\": 10}}, "
      "\"pbrMetallicRoughness\": {\"baseColorTexture\": {\"index\": 0}}}], \"cameras\": [{\"type\": \"perspective\", \"perspective\": "
      "{\"yfov\": 1, \"aspectRatio\": 2}}, {\"type\": \"orthographic\", \"orthographic\": {}}]";
  const apps::Model model = read("a.gltf", sample.embedded());
  REQUIRE(model.materials.size() == 3);
  CHECK(model.materials[0].reflectance == radiosity::Color(0.5, 0.25, 0.125));
  CHECK(model.materials[0].two_sided);
  CHECK(model.materials[1].name == "material1");
  CHECK_FALSE(model.materials[1].reflectance);  // a picture that is not read
  CHECK(glm::length(model.materials[1].emission - std::numbers::pi * radiosity::Color(10, 5, 0)) < 1e-12);
  CHECK(model.polygons() == 5);  // a strip of two, a fan of two, one triangle of four vertices
  CHECK(glm::dvec3(0, 0, 5) == models::corner(model, 0, 0));
  CHECK(std::vector<std::uint32_t>(model.corners.begin(), model.corners.begin() + 6) == std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2});
  REQUIRE(model.cameras.size() == 1);
  CHECK(model.cameras[0].name == "eye");
  CHECK(model.cameras[0].eye == glm::dvec3(0, 0, 5));
  CHECK(model.cameras[0].forward == glm::dvec3(0, 0, -1));
  CHECK(model.cameras[0].field_of_view == Approx(2.0 * std::atan(2.0 * std::tan(0.5)) * 180.0 / std::numbers::pi));
  for (const char* part : {"textures are not read", "points and lines have no surface", "without perspective"}) {
    CHECK(noted(model.notes, part));
  }
}

TEST_CASE("glTF: a hidden node hides what is below it, but not its cameras, and joints remain where they are") {
  const auto polygons = [](const std::string& parent, const std::string& child) {
    Sample sample;
    const auto node = [](const std::string& visible, const std::string& more) {
      return "{\"mesh\": 0, \"camera\": 0" + more + ", \"extensions\": {\"KHR_node_visibility\": {" + visible + "}}}";
    };
    sample.nodes =
        "[" + node(parent, ", \"children\": [1]") + ", " + node(child, ", \"children\": [2]") + ", {\"mesh\": 0}, {\"mesh\": 0}]";
    sample.more = ", \"cameras\": [{\"type\": \"perspective\", \"perspective\": {\"yfov\": 1}}]";
    std::string text = sample.embedded();
    text.replace(text.find("\"nodes\": [0]"), 12, "\"nodes\": [0, 3]");
    const apps::Model model = read("a.gltf", text);
    CHECK(model.cameras.size() == 2);
    CHECK(noted(model.notes, "hidden nodes are left out") == (model.polygons() < 8));
    return model.polygons();
  };
  const std::string shown = "\"visible\": true", hidden = "\"visible\": false";
  CHECK(polygons(shown, "") == 8);
  CHECK(polygons(shown, hidden) == 4);
  CHECK(polygons(hidden, shown) == 2);
}

TEST_CASE("glTF: a primitive without positions is left out, the others are read") {
  Sample sample;
  sample.primitive += ", {\"attributes\": {}, \"indices\": 1}, {\"attributes\": {\"NORMAL\": 0}}";
  const apps::Model model = read("a.gltf", sample.embedded());
  CHECK(model.polygons() == 2);
  CHECK(noted(model.notes, "primitives without positions are left out"));
}

// What is not known shines rather not: most of such a picture is black, and its factor is 1.
TEST_CASE("glTF and OBJ: surfaces whose emissive picture is not read do not shine") {
  Sample sample;
  sample.primitive.insert(sample.primitive.size() - 1, ", \"material\": 0");
  sample.more =
      ", \"materials\": [{\"emissiveFactor\": [1, 1, 1], \"emissiveTexture\": {\"index\": 0}}], \"textures\": [{\"extensions\": "
      "{\"EXT_texture_webp\": {\"source\": 0}}}], \"images\": [{\"uri\": \"a.webp\"}]";
  const apps::Model gltf = read("a.gltf", sample.embedded(), {{"a.webp", "RIFF"}});
  const apps::Model obj = read("a.obj", models::room_obj, {{"room.mtl", "newmtl wall\nmap_Ke a.webp\nKe 1 1 1\n"}, {"a.webp", "RIFF"}});
  for (const apps::Model* const model : {&gltf, &obj}) {
    CHECK(radiosity::is_black(model->materials.at(0).emission));
    CHECK(noted(model->notes, "surfaces whose emissive picture is not read do not shine"));
  }
}

// A source of I W/sr sends 4 pi I; so must the small lamp that stands for it.
TEST_CASE("glTF: lights without a surface become lamps of the same power, where they stand") {
  Sample sample;
  sample.nodes =
      "[{\"mesh\": 0, \"scale\": [10, 10, 10], \"children\": [1, 2, 3]}, {\"translation\": [0, 0, 0.5], \"extensions\": "
      "{\"KHR_lights_punctual\": {\"light\": 0}}}, {\"extensions\": {\"KHR_lights_punctual\": {\"light\": 1}}}, "
      "{\"extensions\": {\"KHR_lights_punctual\": {\"light\": 2}}}]";
  sample.more =
      ", \"extensions\": {\"KHR_lights_punctual\": {\"lights\": [{\"type\": \"point\", \"intensity\": 40, \"color\": [1, 0.5, 0.25]}, "
      "{\"type\": \"directional\"}, {\"type\": \"spot\", \"spot\": {}}]}}";
  const apps::SceneFile file = models::scene("a.gltf", sample.embedded());
  std::vector<const radiosity::SceneObject*> lamps;
  for (const radiosity::SceneObject& object : file.scene.objects) {
    if (!radiosity::is_black(file.scene.materials[object.material[0]].emission)) { lamps.push_back(&object); }
  }
  REQUIRE(lamps.size() == 3);  // the second is a sun, the third a spot
  const double radius = 0.5 * lamps[0]->shape->bounds().size().x;
  const radiosity::Color intensity = radius * radius * file.scene.materials[lamps[0]->material[0]].emission;
  CHECK(glm::length(intensity - 40.0 * radiosity::Color(1, 0.5, 0.25)) < 1e-9 * glm::length(intensity));
  CHECK(glm::length(lamps[0]->shape->bounds().centre() - glm::dvec3(0, -5, 0)) < 1e-9);  // y was up
  for (const char* part : {"1 directional light became a sun", "1 spot light became a small lamp", "1 light has no surface"}) {
    CHECK(noted(file.notes, part));
  }
  sample.more = "";
  CHECK(models::error("a.gltf", sample.embedded()).find("there is no such light") != std::string::npos);
}

TEST_CASE("glTF: what is wrong is told with its place") {
  const auto broken = [](const std::function<void(Sample&)>& change) {
    Sample sample;
    change(sample);
    return models::error("a.gltf", sample.embedded());
  };
  const std::pair<std::string, const char*> cases[] = {
      {broken([](Sample& s) { s.accessors = "[{\"bufferView\": 0, \"componentType\": 5126, \"count\": 5, \"type\": \"VEC3\"}]"; }),
       "accessor 0 reaches beyond its view"},
      {broken([](Sample& s) { s.views = "[{\"buffer\": 0, \"byteLength\": 480}]"; }), "its view reaches beyond its buffer"},
      {broken([](Sample& s) { s.views = "[{\"buffer\": 3, \"byteLength\": 48}]"; }), "there is no buffer 3"},
      {broken([](Sample& s) { s.accessors.replace(s.accessors.find("\"count\": 6"), 10, "\"count\": 6, \"byteOffset\": 2"); }),
       "accessor 1 reaches beyond its view"},
      {broken([](Sample& s) { s.binary[48] = 9; }), "an index names vertex 9 of 4"},
      {broken([](Sample& s) {
         s.accessors.insert(s.accessors.find("\"count\": 4"), substitution(s, {2}, std::vector<std::string>(4, "123456789012"), true));
         s.binary[60] = 4;  // the index
       }),
       "accessor 0 substitutes an element that it does not have"},
      {broken([](Sample& s) { s.accessors.insert(s.accessors.find("\"count\": 4"), "\"sparse\": {\"count\": 9}, "); }),
       "accessor 0 substitutes more elements than it has"},
      {broken([](Sample& s) { s.accessors.insert(s.accessors.find("\"count\": 4"), "\"sparse\": {\"count\": 2}, "); }),
       "accessor 0, its indices: the type of numbers is missing"},
      {broken([](Sample& s) { s.accessors.replace(s.accessors.find("5126"), 4, "5126.5"); }), "accessor 0 is not of the type VEC3"},
      {broken([](Sample& s) { s.accessors.replace(s.accessors.find("5126"), 4, "1e308"); }), "accessor 0 is not of the type VEC3"},
      {broken([](Sample& s) { s.accessors.replace(s.accessors.find("5126"), 4, "-1e308"); }), "accessor 0 is not of the type VEC3"},
      {broken([](Sample& s) { s.accessors.replace(s.accessors.find("5126"), 4, "5124"); }), "accessor 0 is not of the type VEC3"},
      {broken([](Sample& s) { s.primitive = "{\"attributes\": {}}"; }), "there is no such accessor"},
      {broken([](Sample& s) { s.primitive = "{\"attributes\": {\"POSITION\": 1}}"; }), "accessor 1 is not of the type VEC3"},
      {broken([](Sample& s) { s.primitive = "{\"attributes\": {\"POSITION\": 0}, \"material\": 0}"; }), "there is no such material"},
      {broken([](Sample& s) { s.nodes = "[{\"mesh\": 7}]"; }), "there is no such mesh"},
      {broken([](Sample& s) { s.nodes = "[{\"children\": [4]}]"; }), "there is no such node; the file has 1"},
      {broken([](Sample& s) { s.nodes = "[{\"children\": [0]}]"; }), "the scene of this file has no triangles"},
      {models::error("a.gltf", "{\"asset\": {\"version\": \"1.0\"}}"), ":1:1: error: expected glTF 2.0"},
      {models::error("a.gltf", "{\"asset\": [1,\n 2,, 3]}"), ":2:4: error: expected a value, found ', 3]}'"},
      {models::error("a.gltf", Sample().text("data:,x")), "are not base64"},
      {models::error("a.gltf", Sample().text("x.bin")), "the file 'x.bin' is not there"},
      {models::error("a.gltf", Sample().text("https://x.y/z.bin")), "is not in this file nor beside it"},
      {models::error("a.glb", "glTF\x01"), ":byte 6: error: the file ends within its header"},
      {models::error("a.glb", "OFF"), "expected a binary glTF file"},
  };
  for (const auto& [text, sentence] : cases) {
    CAPTURE(text, sentence);
    CHECK(text.find(sentence) != std::string::npos);
  }
}

TEST_CASE("glTF: files that were cut or changed are read or refused") {
  const unsigned seed = 5;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const Sample sample;
  for (const auto& [name, whole] : {std::pair<std::string, std::string>("a.gltf", sample.embedded()), {"a.glb", sample.glb()}}) {
    for (std::size_t length = 0; length < whole.size(); length += 7) { static_cast<void>(models::result(name, whole.substr(0, length))); }
    for (int i = 0; i < 500; ++i) {
      std::string changed = whole;
      for (int k = 0; k < 3; ++k) { changed[random() % changed.size()] = static_cast<char>(random()); }
      static_cast<void>(models::result(name, changed));
    }
  }
}

TEST_CASE("JSON: values, marks in strings, and what is wrong") {
  apps::JsonFault fault;
  const auto value =
      apps::parse_json("\xef\xbb\xbf {\"a\": [1, -2.5e1, true, null, \"\\u00e9\\ud83d\\ude00\\n\"], \"b\": {\"c\": 3}} ", fault);
  REQUIRE(value);
  CHECK((*value)["a"][1].number() == -25.0);
  CHECK((*value)["a"][2].boolean());
  CHECK((*value)["a"][4].string() == "\xc3\xa9\xf0\x9f\x98\x80\n");
  CHECK((*value)["b"]["c"].index() == 3);
  CHECK_FALSE((*value)["a"][1].index());
  CHECK_FALSE((*value)["nothing"]["below"][7]);
  const std::tuple<const char*, std::size_t, const char*> wrong[] = {
      {"", 0, "found the end of the file"}, {"[1", 2, "expected ',' or ']'"},
      {"{\"a\" 1}", 5, "expected ':'"},     {"{a: 1}", 1, "a key in quotes"},
      {"[1] 2", 4, "the end of the file"},  {"\"a", 2, "is not closed"},
      {"\"\\x\"", 2, "means nothing"},      {"[1e999]", 1, "beyond"},
      {"[tru]", 1, "expected a value"},
  };
  for (const auto& [text, offset, sentence] : wrong) {
    CAPTURE(text, fault.sentence);
    CHECK_FALSE(apps::parse_json(text, fault));
    CHECK(fault.offset == offset);
    CHECK(fault.sentence.find(sentence) != std::string::npos);
  }
  CHECK_FALSE(apps::parse_json(std::string(100'000, '['), fault));
  CHECK(fault.sentence == "values are nested deeper than 64");
}
