// SPDX-License-Identifier: MIT
// MGF: entities, contexts, transforms with copies, and what light it makes.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/intake/mgf_color.hpp"
#include "apps/models.hpp"
#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"

namespace {

const std::string square = "v a =\n p 0 0 0\nv b =\n p 1 0 0\nv c =\n p 1 1 0\nv d =\n p 0 1 0\n";

// Area and volume (of what is closed) of the polygons of a model.
double area(const apps::Model& model) {
  double sum = 0.0;
  for (std::size_t f = 0; f < model.polygons(); ++f) {
    glm::dvec3 twice(0.0);
    const std::size_t n = model.first_corner[f + 1] - model.first_corner[f];
    for (std::size_t i = 2; i < n; ++i) {
      const glm::dvec3 a = models::corner(model, f, 0);
      twice += glm::cross(models::corner(model, f, i - 1) - a, models::corner(model, f, i) - a);
    }
    sum += 0.5 * glm::length(twice);
  }
  return sum;
}
double volume(const apps::Model& model) {
  double six = 0.0;
  for (std::size_t f = 0; f < model.polygons(); ++f) {
    for (std::size_t i = 2; i < model.first_corner[f + 1] - model.first_corner[f]; ++i) {
      six += glm::dot(models::corner(model, f, 0), glm::cross(models::corner(model, f, i - 1), models::corner(model, f, i)));
    }
  }
  return six / 6.0;
}

bool close(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-12; }

}  // namespace

TEST_CASE("mgf: contexts are made, made like others, recalled and changed") {
  const apps::Model model = models::read("a.mgf", square +
                                                      "m white =\n c\n rd 0.7\n sides 1\n"
                                                      "m dark = white\n rd 0.2\n"
                                                      "c red =\n cxy 0.64 0.33\n"
                                                      "m lamp =\n c red\n ed 179\n"
                                                      "f a b c d\nm white\nf a b c\nm dark\nf a c d\nm\nf a b d\n"
                                                      "m white\nc\nrd 0.5\nf b c d\n");
  REQUIRE(model.polygons() == 5);
  const auto material = [&](std::size_t f) { return model.materials[model.material[f]]; };
  CHECK(material(0).name == "lamp");
  CHECK(material(0).two_sided);
  // Chromaticity of the red primary: nothing in the other channels, and the luminance is that of 1 W of white light.
  CHECK(material(0).emission.x > 1.0);
  CHECK((std::abs(material(0).emission.y) < 1e-12 && std::abs(material(0).emission.z) < 1e-12));
  CHECK((close(*material(1).reflectance, glm::dvec3(0.7)) && !material(1).two_sided));
  CHECK((close(*material(2).reflectance, glm::dvec3(0.2)) && !material(2).two_sided));
  CHECK((*material(3).reflectance == glm::dvec3(0.0) && material(3).two_sided));
  CHECK(close(*material(4).reflectance, glm::dvec3(0.5)));
  CHECK(models::noted(model.notes, "179 lm"));
}

TEST_CASE("mgf: a chromaticity and its luminance come back from the colour") {
  std::mt19937 random(11);
  const glm::dmat3 primaries({0.64 / 0.33, 1, 0.03 / 0.33}, {0.5, 1, 1.0 / 6}, {2.5, 1, 0.79 / 0.06});
  const glm::dvec3 white = glm::inverse(primaries) * glm::dvec3(1.0);
  for (int i = 0; i < 100; ++i) {  // inside of the triangle of primaries
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double a = std::sqrt(unit(random)), b = unit(random);
    const glm::dvec2 xy = (1 - a) * glm::dvec2(0.64, 0.33) + a * (1 - b) * glm::dvec2(0.30, 0.60) + a * b * glm::dvec2(0.15, 0.06);
    const glm::dvec3 xyz = primaries * (white * apps::intake::mgf::color_of(xy.x, xy.y));
    const double sum = xyz.x + xyz.y + xyz.z;
    CHECK(std::abs(xyz.x / sum - xy.x) < 1e-9);
    CHECK(std::abs(xyz.y - 1.0) < 1e-9);
  }
  CHECK(close(apps::intake::mgf::color_of(1.0 / 3, 1.0 / 3), glm::dvec3(1.0)));
}

// Chromaticities of Planck's law by the tabulated observer (CIE 15): illuminant A, 2856 K, 0.4476 0.4074; 6500 K, 0.3135 0.3237. The fitted
// functions are off by 1 to 2 % of their maxima, which oscillates along the spectrum: .005 in x and y.
TEST_CASE("mgf: spectra, temperatures and mixtures have the chromaticities that are known of them") {
  const auto reflects = [](const std::string& color) {
    const apps::Model model = models::read(
        "a.mgf", square + "c red =\n cxy .5 .35\nc blue =\n cxy .25 .25\nc it =\n " + color + "\nm a =\n c it\n rd .5\nf a b c d\n");
    REQUIRE(model.materials[0].reflectance);
    return *model.materials[0].reflectance;
  };
  const auto of = [](double x, double y) { return 0.5 * apps::intake::mgf::color_of(x, y); };
  CHECK(glm::length(reflects("cspec 300 900 .3 .3 .3") - glm::dvec3(0.5)) < 1e-12);  // white is even
  CHECK(glm::length(reflects("cspec 380 780 0 .3 .9 .1") - reflects("cspec 380 780 0 3 9 1")) < 1e-12);
  CHECK(glm::length(reflects("cxy .4 0") - of(0.4, 0.004)) < 1e-12);
  // The second component of daylight (CIE 15) is negative at long wavelengths.
  CHECK(glm::length(reflects("cspec 400 700 40 30 20 10 0 -2 -1") - reflects("cspec 400 700 80 60 40 20 0 -4 -2")) < 1e-12);
  CHECK(glm::length(reflects("cspec 400 700 40 30 20 10 0 -2 -1") - reflects("cspec 400 700 40 30 20 10 0 0 0")) > 0.01);
  for (const auto& [kelvin, x, y] : {std::array{2856.0, 0.4476, 0.4074}, {6500.0, 0.3135, 0.3237}}) {
    const glm::dvec3 xyz = apps::intake::mgf::xyz_of_temperature(kelvin);
    const double sum = xyz.x + xyz.y + xyz.z;
    CHECK(std::abs(xyz.x / sum - x) < 0.005);
    CHECK(std::abs(xyz.y / sum - y) < 0.005);
    CHECK(glm::length(reflects("cct " + std::to_string(kelvin)) - of(xyz.x / sum, xyz.y / sum)) < 1e-12);
  }
  // Weights are shares of the luminance, and colours of one luminance add.
  CHECK(glm::length(reflects("cmix 3 red 1 blue") - 0.25 * (3.0 * of(0.5, 0.35) + of(0.25, 0.25))) < 1e-12);
  CHECK(glm::length(reflects("cmix .2 red") - of(0.5, 0.35)) < 1e-12);

  for (const char* const wrong : {"cct 0", "cct", "cspec 700 400 1 1", "cspec 400 700 1", "cspec 400 700 1 -1", "cspec 400 700 0 0 0",
                                  "cspec 400 700 -1 -1 -1 2 -1 -1 -1", "cspec 100 200 1 1", "cmix", "cmix 1", "cmix 1 red 2",
                                  "cmix 1 green", "cmix 0 red", "cmix -1 red 2 blue"}) {
    INFO(wrong);
    const apps::ModelResult result = models::result("a.mgf", square + "c red =\nc blue =\nc it =\n" + wrong + "\n");
    REQUIRE_FALSE(result.errors.empty());
    CHECK(result.errors[0].place.line == 12);
  }
}

TEST_CASE("mgf: transforms act one after the other, the inner ones first, and copies are counted as by hand") {
  const apps::Model model = models::read("a.mgf", square +
                                                      "xf -rz 90 -t 10 0 0\nxf -s 2 -t 1 0 0\nf a b c\nxf\nxf\n"
                                                      "xf -t 0 0 5 -a 3 -t 1 0 0 -a 2 -t 0 2 0\nf a b c\nxf\n"
                                                      "xf -i 3 -t 1 0 0\nf a b c\nxf\nxf -a 0\nf a b c\nxf -t 1 1 1\nf a b c\nxf\nxf\n"
                                                      "xf -mx\nf a b c\nxf\nf a b c\n");
  REQUIRE(model.polygons() == 1 + 6 + 1 + 1 + 1);
  CHECK(close(models::corner(model, 0, 1), {10, 3, 0}));  // b: 2 0 0, 3 0 0; 0 3 0, 10 3 0
  CHECK(close(models::corner(model, 0, 2), {8, 3, 0}));   // c: 2 2 0, 3 2 0; -2 3 0, 8 3 0
  std::vector<glm::dvec3> first;
  for (std::size_t f = 1; f < 7; ++f) { first.push_back(models::corner(model, f, 0)); }
  for (int i = 0; i < 6; ++i) {
    CHECK(std::count_if(first.begin(), first.end(), [&](const auto& p) { return close(p, {i % 3, 2 * (i / 3), 5}); }) == 1);
  }
  CHECK(close(models::corner(model, 7, 0), {3, 0, 0}));
  const auto turn = [&](std::size_t f) {
    const glm::dvec3 p = models::corner(model, f, 0);
    return glm::cross(models::corner(model, f, 1) - p, models::corner(model, f, 2) - p).z;
  };
  CHECK(turn(8) == 1.0);  // a mirror turns no surface over
  CHECK(turn(9) == 1.0);
}

TEST_CASE("mgf: solids look outwards and have their areas and volumes, wherever they lie") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto number = [&](double lo, double hi) { return std::to_string(std::uniform_real_distribution(lo, hi)(random)); };
    const std::string turn =
        "xf -rx " + number(0, 360) + " -ry " + number(0, 360) + (seed == 2 ? " -mx" : "") + " -t " + number(-5, 5) + " 1 2\n";
    const apps::Model box = models::read("a.mgf", square + turn + "prism a d c b 3\nxf\n");
    CHECK(std::abs(area(box) - 14.0) < 1e-9);
    CHECK(std::abs(volume(box) - 3.0) < 1e-9);  // seen from below, it grows up
    CHECK(std::abs(volume(models::read("a.mgf", square + turn + "prism a d c b -3\nxf\n")) + 3.0) < 1e-9);
    // A cylinder or cone of 32 sides, closed by rings, is a prism or a frustum: corners weld, the volume is that of its polygons.
    const std::string ends = "v p =\n p 0 0 0\n n 0 0 -1\nv q =\n p 0 0 2\n n 0 0 1\n";
    const double polygon = 16.0 * std::sin(2.0 * std::numbers::pi / 32.0);  // area of that of radius 1
    const apps::Model can = models::read("a.mgf", ends + turn + "cyl p 1 q\nring p 0 1\nring q 0 1\nxf\n");
    CHECK(std::abs(volume(can) - 2.0 * polygon) < 1e-9);
    const apps::Model cone = models::read("a.mgf", ends + turn + "cone p 1 q 0\nring p 0.5 1\nring p 0 0.5\nxf\n");
    CHECK(std::abs(volume(cone) - 2.0 / 3.0 * polygon) < 1e-9);
    const apps::SceneFile taken =
        models::scene("a.mgf", "m w =\n rd .5\n ed 1\n" + ends + turn + "cyl p 1 q\nring p 0 1\nring q 0 1\nxf\n");
    REQUIRE(taken.scene.objects.size() == 1);
    CHECK(taken.scene.objects[0].shape->solid());
  }
}

// Radius 1, E = rho = a half: B = E / (1 - rho) = 1 everywhere.
TEST_CASE("mgf: a furnace is a furnace") {
  const std::string oven = "m oven =\n rd 0.5\n ed 89.5\n" + square;
  for (const std::string shape : {"sph a -1\n", "prism a b c d -1\n"}) {
    const apps::SceneFile file = models::scene("a.mgf", oven + shape);
    const radiosity::Options options{.epsilon = 0.1, .audit_points = 0, .threads = 1};
    const radiosity::Outcome outcome = radiosity::solve(file.scene, options);
    REQUIRE(outcome.solution);
    for (const radiosity::SurfaceMean& surface : outcome.solution->audit.surfaces) { CHECK(std::abs(surface.radiosity.x - 1.0) < 1e-3); }
  }
}

TEST_CASE("mgf: included files are placed, know what is defined, and are told when they are missing or wrong") {
  const models::Files files{{"part.mgf", "f a b c\nm inner =\n rd .3\n"}, {"loop.mgf", "i loop.mgf -t 1 0 0\n"}, {"bad.mgf", "\n p x\n"}};
  const apps::Model model =
      models::read("a.mgf", square + "xf -t 0 0 1\ni part.mgf -t 1 0 0 -a 2 -t 0 1 0\nxf\nm inner\nf a b c\ni nothing.mgf\n", files);
  REQUIRE(model.polygons() == 3);
  CHECK(close(models::corner(model, 1, 0), {1, 1, 1}));
  CHECK(model.materials[model.material[2]].name == "inner");
  CHECK(models::noted(model.notes, "'nothing.mgf' is not there: left out"));
  // A wrong file is told once, however often it is included, by itself among others.
  CHECK(models::result("a.mgf", "i twice.mgf\ni twice.mgf\n", {{"twice.mgf", "i twice.mgf\ni twice.mgf\np x\n"}}).errors.size() == 1);
  CHECK(models::error("a.mgf", "i loop.mgf\n", files).find("nested deeper than 32") != std::string::npos);
  CHECK(models::error("a.mgf", "o x\ni bad.mgf\n", files) == ":2:3: error: in bad.mgf:2:4: error: expected a number, found 'x'");
}

// The area of a face with holes is that of its outline without theirs, whichever way round they are given.
TEST_CASE("mgf: faces have holes") {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
    const auto vertex = [](const std::string& name, double x, double y) {
      return "v " + name + " =\n p " + std::to_string(x) + " 0 " + std::to_string(y) + "\n";
    };
    std::string text = "sides 1\n" + vertex("a", 0, 0) + vertex("b", 9, 0) + vertex("c", 9, 3) + vertex("d", 0, 3), face = "fh a b c d";
    double left = 27.0;
    const int holes = 1 + static_cast<int>(seed);
    for (int k = 0; k < holes; ++k) {  // rectangles beside each other
      const double x = 0.2 + 9.0 * k / holes, y = number(0.1, 1.0), width = number(0.2, 9.0 / holes - 0.4), height = number(0.3, 1.8);
      const std::string n = std::to_string(k);
      const auto exact = [](double v) { return std::stod(std::to_string(v)); };
      text +=
          vertex("e" + n, x, y) + vertex("f" + n, x, y + height) + vertex("g" + n, x + width, y + height) + vertex("h" + n, x + width, y);
      face += random() % 2 == 0 ? " - e" + n + " f" + n + " g" + n + " h" + n : " - h" + n + " g" + n + " f" + n + " e" + n;
      left -= (exact(x + width) - exact(x)) * (exact(y + height) - exact(y));
    }
    const apps::SceneFile file = models::scene("a.mgf", text + face + "\n");
    std::vector<radiosity::SceneObject> faces;  // without the studio around them
    std::copy_if(file.scene.objects.begin(), file.scene.objects.end(), std::back_inserter(faces),
                 [](const radiosity::SceneObject& object) { return object.name.starts_with("mgf"); });
    CHECK(soup::measure(faces).area == Approx(left).epsilon(1e-9));
  }
}

TEST_CASE("mgf: what is wrong is told with its place, what is not read is told") {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"v a =\n p 0 0\n", ":2:7: error: expected a number, found the end of the line"},
      {square + "f a b\n", ":9:6: error: a face has at least three vertices"},
      {square + "fh a b c - d\n", ":9:13: error: a face, and each of its holes, has at least three vertices"},
      {square + "fh a b c d -\n", ":9:13: error: a face, and each of its holes, has at least three vertices"},
      {square + "fh a b c - a b e\n", ":9:16: error: there is no vertex 'e'"},
      {square + "f a b e\n", ":9:7: error: there is no vertex 'e'"},
      {"m x = y\n", ":1:7: error: there is no material 'y'"},
      {"xf -t 1 1 1\n", ":1:1: error: this xf is not ended by one without arguments"},
      {"xf\n", ":1:1: error: this xf ends nothing"},
      {"xf -q\nxf\n", ":1:4: error: expected -t, -rx, -ry, -rz, -s, -mx, -my, -mz, -i or -a, found '-q'"},
      {"xf -a 1e9\nxf\n", ":1:7: error: expected a number from 0 to 100000, found '1e9'"},
      {"cxy 0.5 0.7\n", ":1:5: error: expected a chromaticity, x and y from 0 on with a sum of at most 1"},
      {"rd -1\n", ":1:4: error: expected a number from 0 on, found '-1'"},
      {"xf -a 100000 -t 1 0 0\nxf -a 100 -t 0 1 0\n# nothing\no\nxf\nxf\n", "copies make more than"}};
  for (const auto& [text, sentence] : wrong) {
    INFO(text);
    CHECK(models::error("a.mgf", text).find(sentence) != std::string::npos);
  }
  const apps::Model model = models::read("a.mgf", square + "ies lamp.ies\nrd .2\nrs .3 .1\nf a b \\\n c d\nring a 1 1\n");
  CHECK(model.polygons() == 1);
  for (const std::string note : {"'ies' is not read", "mirrors", "without size"}) { CHECK(models::noted(model.notes, note)); }
}
