// SPDX-License-Identifier: MIT
// Pictures on the surfaces of models: their mean colour counts, times the factor that stands beside them.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/camera/mesh_picture.hpp>

#include "apps/intake/texture.hpp"
#include "apps/models.hpp"
#include "apps/picture_file.hpp"
#include "catch.hpp"
#include "seed.hpp"

namespace {

struct Painted {
  std::string file;  // a PNG
  radiosity::Color mean{0.0};
};

// Of random levels: these are kept as they are, so the mean is known.
Painted painted(unsigned seed, std::uint32_t width, std::uint32_t height) {
  std::mt19937 random(seed);
  radiosity::Picture picture(width, height);
  Painted out;
  for (std::size_t i = 0; i < picture.shown.size(); ++i) {
    radiosity::Color c(0.0);
    for (int k = 0; k < 3; ++k) {
      const double v = static_cast<double>(random() % 256) / 255.0;
      c[k] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    picture.set(i, c, c);
    out.mean += c / static_cast<double>(picture.shown.size());
  }
  out.file = apps::to_png(picture);
  return out;
}

std::string base64_of(const std::string& bytes) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  std::uint32_t bits = 0, count = 0;
  for (const char c : bytes) {
    bits = bits << 8U | static_cast<unsigned char>(c);
    for (count += 8; count >= 6; count -= 6) { text += letters[bits >> (count - 6) & 63U]; }
  }
  return count > 0 ? text + letters[bits << (6 - count) & 63U] : text;
}

bool near(const radiosity::Color& a, const radiosity::Color& b) { return glm::length(a - b) < 1e-6; }  // `shown` is in floats

}  // namespace

TEST_CASE("textures: the mean of a PNG is that of its pixels in linear light, what is cut or none is nothing") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    INFO("seed " << seed);
    const Painted picture = painted(seed, 5 + seed, 9);
    const auto read = apps::intake::Picture::read(picture.file);
    REQUIRE(read);
    CHECK(near(read->mean(), picture.mean));
    CHECK_FALSE(apps::intake::Picture::read(picture.file.substr(0, picture.file.size() / 3)));
  }
  CHECK_FALSE(apps::intake::Picture::read(""));
  CHECK_FALSE(apps::intake::Picture::read("not a picture"));
}

TEST_CASE("textures: the part on a triangle has the mean of its points, also on one that is thinner than a pixel, or a line") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto unit = [&] { return std::uniform_real_distribution(0.0, 1.0)(random); };
  for (int run = 0; run < 60; ++run) {
    const std::uint32_t width = 3 + static_cast<std::uint32_t>(random() % 20), height = 3 + static_cast<std::uint32_t>(random() % 40);
    const auto picture = apps::intake::Picture::read(painted(static_cast<unsigned>(random()), width, height).file);
    REQUIRE(picture);
    const auto place = [&] { return 6.0 * glm::dvec2(unit(), unit()) - 3.0; };
    glm::dvec2 a = place(), b = place(), c = place();
    if (run % 3 == 1) { c = a + unit() * (b - a); }                      // on a line
    if (run % 3 == 2) { b.y = a.y + 0.3 * unit() / height, c.y = a.y; }  // within a row or two
    CAPTURE(run, width, height, a.x, a.y, b.x, b.y, c.x, c.y);
    radiosity::Color mean(0.0);
    constexpr int count = 4000;
    for (int k = 0; k < count; ++k) {  // each point is looked up as a triangle of no size
      const double s = std::sqrt(unit()), t = unit();
      const glm::dvec2 p = (1.0 - s) * a + s * (1.0 - t) * b + s * t * c;
      mean += picture->on_triangle(p, p, p).mean / static_cast<double>(count);
    }
    // Random levels vary by 0.29 in linear light, so the mean of the points by sqrt(3) 0.29 / sqrt(4000) = 0.008; strips add a third of it.
    CHECK(glm::length(mean - picture->on_triangle(a, b, c).mean) < 0.05);
  }
}

TEST_CASE("textures: the parts on triangles that tile a rectangle have its mean") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto unit = [&] { return std::uniform_real_distribution(0.0, 1.0)(random); };
  double most = 0.0;
  for (int run = 0; run < 60; ++run) {
    const auto picture = apps::intake::Picture::read(painted(static_cast<unsigned>(random()), 3 + run % 20, 40 - run % 20).file);
    REQUIRE(picture);
    // A rectangle of one to three pictures, anywhere, divided about a point of it.
    const glm::dvec2 low(std::floor(8.0 * unit()) - 4.0 + unit(), std::floor(8.0 * unit()) - 4.0 + unit());
    const glm::dvec2 size(1 + run % 3, 1 + run % 2), high = low + size;
    const glm::dvec2 corners[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
    const glm::dvec2 middle = low + glm::dvec2(0.1 + 0.8 * unit(), 0.1 + 0.8 * unit()) * size;
    radiosity::Color sum(0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::dvec2 &a = corners[i], &b = corners[(i + 1) % 4], ab = b - a, am = middle - a;
      sum += 0.5 * std::abs(ab.x * am.y - ab.y * am.x) * picture->on_triangle(a, b, middle).mean;
    }
    most = std::max(most, glm::length(sum / (size.x * size.y) - picture->mean()));
  }
  CHECK(most < 0.005);  // found: 0.0008 to 0.0016, by strips at corners
}

TEST_CASE("textures: of OBJ and glTF they count times their factors, wherever they lie, unreadable ones are told") {
  const Painted wood = painted(7, 8, 8), glow = painted(8, 3, 4);
  const models::Files files{{"a.mtl",
                             "newmtl wood\nmap_Kd -s 1 2 1 my/wood.png\nKd 0.5 0.5 0.25\nnewmtl plain\nKd 0 0 0\nmap_Kd my\\wood.png\n"
                             "newmtl lamp\nKe 2\nmap_Ke C:\\work\\glow 1.png\nnewmtl lost\nKd 0.3\nmap_Kd lost.png\n"},
                            {"my/wood.png", wood.file},
                            {"glow 1.png", glow.file}};
  const apps::Model obj = models::read("a.obj",
                                       "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\nusemtl plain\nf 1 2 3\nusemtl lamp\n"
                                       "f 1 2 3\nusemtl lost\nf 1 2 3\n",
                                       files);
  REQUIRE(obj.materials.size() == 4);
  CHECK(near(*obj.materials[0].reflectance, wood.mean * radiosity::Color(0.5, 0.5, 0.25)));
  CHECK(near(*obj.materials[1].reflectance, wood.mean));
  CHECK(near(obj.materials[2].emission / std::acos(-1.0), 2.0 * glow.mean));
  CHECK(near(*obj.materials[3].reflectance, radiosity::Color(0.3)));
  for (const char* const part : {"pictures on surfaces count with their mean colour", "textures are not read: Kd stands for the picture"}) {
    CHECK(models::noted(obj.notes, part));
  }

  std::string positions(36, '\0');  // a triangle without size would do, but for the corners
  const float numbers[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  for (std::size_t i = 0; i < 9; ++i) { std::memcpy(&positions[4 * i], &numbers[i], 4); }
  const std::string bytes = positions + glow.file;
  const apps::Model gltf = models::read(
      "a.gltf",
      "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"mesh\": 0}], \"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, "
      "\"material\": 0}]}], \"buffers\": [{\"byteLength\": " +
          std::to_string(bytes.size()) + ", \"uri\": \"data:;base64," + base64_of(bytes) +
          "\"}], \"bufferViews\": [{\"buffer\": 0, \"byteLength\": 36}, {\"buffer\": 0, \"byteOffset\": 36, \"byteLength\": " +
          std::to_string(glow.file.size()) +
          "}], \"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 3, \"type\": "
          "\"VEC3\"}], \"images\": [{\"uri\": \"my/wood.png\"}, {\"bufferView\": 1, \"mimeType\": \"image/png\"}, {\"uri\": "
          "\"data:image/png;base64," +
          base64_of(wood.file) +
          "\"}, {\"bufferView\": 9}], \"textures\": [{\"source\": 0}, {\"source\": 1}, {\"source\": 2}, {\"source\": 3}], "
          "\"materials\": [{\"pbrMetallicRoughness\": {\"baseColorTexture\": {\"index\": 0}}, \"emissiveFactor\": [1, 1, 0.5], "
          "\"emissiveTexture\": {\"index\": 1}}, {\"pbrMetallicRoughness\": {\"baseColorTexture\": {\"index\": 2}, \"baseColorFactor\": "
          "[0.5, 1, 1, 1]}}, {\"pbrMetallicRoughness\": {\"baseColorTexture\": {\"index\": 3}}}]}",
      files);
  REQUIRE(gltf.materials.size() == 3);
  CHECK(near(*gltf.materials[0].reflectance, wood.mean));
  CHECK(near(gltf.materials[0].emission / std::acos(-1.0), glow.mean * radiosity::Color(1, 1, 0.5)));
  CHECK(near(*gltf.materials[1].reflectance, wood.mean * radiosity::Color(0.5, 1, 1)));
  CHECK_FALSE(gltf.materials[2].reflectance);
  CHECK(models::noted(gltf.notes, "textures are not read: the base colour factor stands for the picture"));
}

TEST_CASE("textures: of VRML they count times the diffuse colour until the next one, from files and from pixels of each kind") {
  const Painted wood = painted(9, 6, 5);
  const auto linear = [](double level) {
    const double v = level / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  const std::string head = "#VRML V1.0 ascii\n";
  const apps::Model model =
      models::read("a.wrl",
                   head +
                       "Material { diffuseColor 0.5 1 0.25 } Cube { } Separator { Texture2 { filename \"wood.png\" } Cube { } } Cube { }\n"
                       "Texture2 { image 2 1 3 0xFF8000 0x0040ff } Cube { }\n"
                       "Texture2 { image 1 2 1 0x80 0x20 } Cube { }\n"
                       "Texture2 { image 2 1 2 0x80ff 0xff00 } Cube { }\n"
                       "Texture2 { image 1 1 4 0x80402080 } Cube { }\n"
                       "Texture2 { } Cube { }\n",
                   {{"wood.png", wood.file}});
  const radiosity::Color diffuse(0.5, 1.0, 0.25);
  const auto grey = [&](double level) { return radiosity::Color(linear(level)); };
  const std::vector<radiosity::Color> expected{
      radiosity::Color(1.0),
      wood.mean,
      radiosity::Color(1.0),
      0.5 * radiosity::Color(linear(255) + linear(0), linear(128) + linear(64), linear(0) + linear(255)),
      0.5 * (grey(128) + grey(32)),
      grey(128),
      {linear(128), linear(64), linear(32)},
      radiosity::Color(1.0)};
  REQUIRE(model.objects.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    INFO("cube " << i);
    CHECK(near(*model.materials[model.objects[i].material[0]].reflectance, diffuse * expected[i]));
  }
  CHECK(models::noted(model.notes, "pictures on surfaces count with their mean colour"));

  // What is wrong with a picture is told, and the diffuse colour stands for it.
  for (const std::string field :
       {"filename \"lost.png\"", "filename \"http://a/b.png\"", "image 1 1 5 7", "image 1 1 0 0", "image 1 1 1 256", "image 1 1 1 -1",
        "image 1 1 3 0.5", "image 1 1 2 0xff00", "image -1 -1 1 3", "image 0.5 2 1 3"}) {
    INFO(field);
    const apps::Model wrong = models::read("a.wrl", head + "Texture2 { " + field + " } Cube { }");
    CHECK(near(*wrong.materials.at(0).reflectance, radiosity::Color(0.8)));
    CHECK(models::noted(wrong.notes, "textures are not read: the diffuse colour stands for the picture"));
  }
  CHECK(models::error("a.wrl", head + "Texture2 { image 2 1 1 0xFF } Cube { }").find("expected a number for 'image'") != std::string::npos);
  CHECK(models::error("a.wrl", head + "Texture2 { image 1e300 1e300 1 0 } Cube { }").find("expected a number for 'image'") !=
        std::string::npos);
}
