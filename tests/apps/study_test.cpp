// SPDX-License-Identifier: MIT

// The measuring half of `halflight study`: the reference and its cache, the norms, and the command as its user meets it.

#include "apps/study/reference.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/scene_file.hpp"
#include "json.hpp"
#include "program.hpp"

namespace {

using radiosity::Color;
using study::TrueRadiosity;
using test::Approx;

const std::string plates = program::content(HALFLIGHT_SCENES "/two_plates.scene");

// The same with a picture of a sixteenth of the pixels: a study draws it anew for each of its eighty runs.
std::string plates_in_small() {
  const std::string usual = "fov 45";
  std::string text = plates;
  const auto at = text.find(usual);
  REQUIRE(at != std::string::npos);
  return text.insert(at + usual.size(), " size 200 150");
}

radiosity::Scene scene_of(const std::string& text) {
  const auto result = apps::parse_scene(text);
  REQUIRE(result.file);
  return result.file->scene;
}

// The reference points of two plates with made-up values.
TrueRadiosity made_up_values() {
  std::string fault;
  study::ReferenceOptions options;
  options.cells = 8;
  auto truth = study::reference_points(scene_of(plates), options, fault);
  REQUIRE(truth);
  REQUIRE(truth->points.size() >= 16);
  for (std::size_t i = 0; i < truth->points.size(); ++i) {
    const double x = 1.0 + static_cast<double>(i) / 3.0;
    truth->points[i].radiosity = {x, 0.1 * x, 1e-9 * x};
    truth->points[i].standard_error = {0.01, 1e-3 / x, 0.0};
  }
  truth->paths = 64;
  return *truth;
}

std::vector<Color> values(const TrueRadiosity& truth) {
  std::vector<Color> result;
  for (const auto& point : truth.points) { result.push_back(point.radiosity); }
  return result;
}

}  // namespace

TEST_CASE("a kept reference is read back bit for bit") {
  const TrueRadiosity truth = made_up_values();
  const std::string file = study::to_cache(truth, "0123456789abcdef");
  CHECK_NOTHROW(json::parse(file));
  TrueRadiosity read = truth;
  for (auto& point : read.points) { point.radiosity = point.standard_error = Color{0.0}; }
  REQUIRE(study::from_cache(file, "0123456789abcdef", 64, read));
  CHECK(read.cached);
  CHECK(read.paths == 64);
  for (std::size_t i = 0; i < truth.points.size(); ++i) {
    CHECK(read.points[i].radiosity == truth.points[i].radiosity);
    CHECK(read.points[i].standard_error == truth.points[i].standard_error);
  }
}

TEST_CASE("a kept reference that is damaged, of another scene or too coarse is not believed") {
  const TrueRadiosity truth = made_up_values();
  const std::string key = "0123456789abcdef";
  const std::string file = study::to_cache(truth, key);
  TrueRadiosity read = truth;
  CHECK_FALSE(study::from_cache(file, "0123456789abcdee", 64, read));
  CHECK_FALSE(study::from_cache(file, key, 65, read));
  TrueRadiosity fewer = truth;
  fewer.points.pop_back();
  CHECK_FALSE(study::from_cache(file, key, 64, fewer));
  for (std::size_t length = 0; length < file.size(); length += 3) {
    CAPTURE(length);
    REQUIRE_FALSE(study::from_cache(file.substr(0, length), key, 1, read));
  }
  for (std::size_t at = 0; at < file.size(); ++at) {
    CAPTURE(at, file[at]);
    std::string damaged = file;
    damaged[at] = damaged[at] == '7' ? '8' : '7';
    REQUIRE_FALSE(study::from_cache(damaged, key, 1, read));
  }
  CHECK_FALSE(read.cached);
  CHECK(values(read) == values(truth));
}

TEST_CASE("norms of a known offset") {
  const TrueRadiosity truth = made_up_values();
  const std::vector<Color> exact = values(truth);
  std::vector<Color> brighter = exact;
  for (Color& c : brighter) { c *= 1.01; }
  std::vector<double> cells;
  const study::Errors errors = study::errors_of(truth, brighter, &cells);
  for (const double e : {errors.cells.l1, errors.cells.l2, errors.cells.worst, errors.points.l1, errors.points.l2, errors.points.worst}) {
    CHECK(e == Approx(0.01).epsilon(1e-9));
  }
  CHECK(study::distance(truth, exact, brighter) == Approx(0.01).epsilon(1e-9));
  REQUIRE(cells.size() == truth.cells.size());
  for (const double e : cells) {
    CHECK(e > 0.0);
    CHECK(e < 0.01 + 1e-12);
  }
  CHECK(study::errors_of(truth, exact).points.l1 == 0.0);

  // Errors that cancel within each cell: none of the mean, some at the points.
  std::vector<Color> ragged = exact;
  for (const auto& cell : truth.cells) {
    REQUIRE(cell.points == 4);
    for (std::uint32_t i = 0; i < 4; ++i) { ragged[cell.first_point + i].x += i % 2 == 0 ? 0.1 : -0.1; }
  }
  CHECK(study::errors_of(truth, ragged).cells.l2 < 1e-12);
  CHECK(study::errors_of(truth, ragged).points.l2 > 1e-3);
}

TEST_CASE("a furnace has an analytic reference: B = E / (1 - rho), whatever stands in it") {
  std::string fault;
  const std::string text =
      "material a reflectance 0.5 0.25 0 emission 1 1.5 2\nmaterial b reflectance 0.75 0 0.5 emission 0.5 2 1\n"
      "box room from 0 0 0 to 1 1 1 inside material a\nsphere ball center 0.5 0.5 0.5 radius 0.2 material b\n";
  study::ReferenceOptions options;
  options.cells = 10;
  const auto truth = study::make_reference(scene_of(text), text, {}, options, {}, fault);
  REQUIRE(truth);
  CHECK(truth->analytic);
  for (const auto& point : truth->points) { CHECK(glm::length(point.radiosity - Color{2.0}) < 1e-12); }
  CHECK(study::describe(*truth).noise == 0.0);
  CHECK(study::describe(*truth).kind == "analytic");
}

TEST_CASE("path-traced values lie within their standard errors of the truth") {
  // A furnace but for 1e-9 of the emission of one wall is path-traced; B = 1 all the same, to 1e-9.
  std::string text = "material wall reflectance 0.5 emission 0.5\nmaterial other reflectance 0.5 emission 0.500000001\n";
  const char* const corners[6] = {"0 0 0|1 0 0|1 1 0|0 1 0", "0 0 1|0 1 1|1 1 1|1 0 1", "0 0 0|0 1 0|0 1 1|0 0 1",
                                  "1 0 0|1 0 1|1 1 1|1 1 0", "0 0 0|0 0 1|1 0 1|1 0 0", "0 1 0|1 1 0|1 1 1|0 1 1"};
  for (int k = 0; k < 6; ++k) {
    text += "polygon wall" + std::to_string(k) + " material " + (k > 0 ? "wall" : "other") + " {\n vertex ";
    for (const char* c = corners[k]; *c != '\0'; ++c) { text += *c == '|' ? std::string("\n vertex ") : std::string(1, *c); }
    text += "\n}\n";
  }
  study::ReferenceOptions options;
  options.cells = 30;
  options.paths = 256;
  std::string fault;
  const auto truth = study::make_reference(scene_of(text), text, {}, options, {}, fault);
  INFO(fault);
  REQUIRE(truth);
  REQUIRE_FALSE(truth->analytic);
  double sum = 0.0;
  for (const auto& point : truth->points) { sum += std::pow((point.radiosity.x - 1.0) / point.standard_error.x, 2); }
  const auto n = static_cast<double>(truth->points.size());
  REQUIRE(n >= 200.0);
  // The square of Student's t with 7 degrees of freedom: mean 7/5, variance 2 * 49 * 6 / (25 * 3) = 7.8. Five standard errors.
  CHECK(std::abs(sum / n - 1.4) < 5.0 * std::sqrt(7.8 / n));
}

TEST_CASE("the reference is kept beside the scene, and made anew when it does not fit") {
  const program::Place place;
  const std::string path = (place.path() / "plates.reference.json").string();
  study::ReferenceOptions options;
  options.cells = 8;
  options.paths = 16;
  std::string fault;
  const auto make = [&](const std::string& text) {
    const auto truth = study::make_reference(scene_of(text), text, {path, (place.path() / "second.json").string()}, options, {}, fault);
    INFO(fault);
    REQUIRE(truth);
    return *truth;
  };
  const TrueRadiosity first = make(plates);
  CHECK_FALSE(first.cached);
  CHECK(place.has("plates.reference.json"));
  CHECK_FALSE(place.has("second.json"));
  const TrueRadiosity again = make(plates);
  CHECK(again.cached);
  CHECK(values(again) == values(first));

  const std::string kept = place.read("plates.reference.json");
  place.write("plates.reference.json", kept.substr(0, kept.size() / 2));
  const TrueRadiosity remade = make(plates);
  CHECK_FALSE(remade.cached);
  CHECK(values(remade) == values(first));
  CHECK(place.read("plates.reference.json") == kept);

  CHECK_FALSE(make(plates + "\n# a comment more\n").cached);
}

TEST_CASE("a study never destroys a file that it has not written for this scene") {
  study::ReferenceOptions options;
  options.cells = 8;
  options.paths = 16;
  const auto seed = GENERATE(take(8, random(0U, 0xffff'ffffU)));
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&](unsigned below) { return static_cast<unsigned>(random() % below); };
  // What lies where a reference would be kept: bytes of any kind, something that begins like a reference, one of another scene.
  const std::string other = study::to_cache(made_up_values(), "0123456789abcdef");
  const auto foreign = [&] {
    if (number(3) == 0) { return other; }
    std::string bytes = other.substr(0, number(4) == 0 ? number(80) : 0);
    for (unsigned i = number(50); i > 0; --i) { bytes += static_cast<char>(number(256)); }
    return bytes;
  };
  const program::Place place;
  const std::vector<std::string> names{"beside.reference.json", "output.reference.json"};
  std::map<std::string, std::string> had;
  for (const std::string& name : names) {
    if (number(3) > 0) { place.write(name, had[name] = foreign()); }
  }
  std::vector<std::string> caches;
  for (const std::string& name : names) { caches.push_back((place.path() / name).string()); }
  std::string fault;
  const auto first = study::make_reference(scene_of(plates), plates, caches, options, {}, fault);
  REQUIRE(first);
  CHECK_FALSE(first->cached);
  for (const auto& [name, bytes] : had) { CHECK(place.read(name) == bytes); }
  // It is kept all the same, in one new file, and found there.
  CHECK(place.entries() == had.size() + 1);
  const auto again = study::make_reference(scene_of(plates), plates, caches, options, {}, fault);
  REQUIRE(again);
  CHECK(again->cached);
  CHECK(values(*again) == values(*first));
  CHECK(place.entries() == had.size() + 1);
  for (const auto& [name, bytes] : had) { CHECK(place.read(name) == bytes); }
}

TEST_CASE("halflight study says where the reference is kept when its place is taken") {
  const program::Place place;
  place.write("plates.scene", plates);
  place.write("plates.reference.json", "my own notes\n");
  const program::Run run = place.run("study plates.scene -o out --time-per-run 0.001 --paths 8 --dense 0");
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(place.read("plates.reference.json") == "my own notes\n");
  CHECK(place.has("out/plates.reference.json"));
  CHECK(run.err.find("plates.reference.json is left as it is") != std::string::npos);
}

TEST_CASE("halflight study: every method at six settings or more, the parts of an error, a reference that is kept") {
  const program::Place place;
  place.write("plates.scene", plates_in_small());
  const program::Run run = place.run("study plates.scene -o out --time-per-run 0.03 --paths 64 --dense 100 -q");
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(place.has("plates.reference.json"));
  CHECK(place.has("out/index.html"));
  const json::Value results = json::parse(place.read("out/results.json"));
  const json::Value& scene = results["scenes"].array().at(0);
  CHECK_FALSE(scene["reference"]["cached"].boolean());
  const double noise = scene["reference"]["point_noise"].number();
  CHECK(noise > 0.0);
  CHECK(scene["methods"].size() >= 6);
  for (const std::string name : {"hierarchical F", "F, clusters", "hierarchical BF", "BF, clusters", "BF, accuracy target",
                                 "BF, accuracy target, clusters", "F, separate polygons", "plain program"}) {
    CAPTURE(name);
    const auto& all = scene["methods"].array();
    CHECK(std::count_if(all.begin(), all.end(), [&](const json::Value& method) { return method["name"].string() == name; }) == 1);
  }
  int parts = 0;
  for (const json::Value& method : scene["methods"].array()) {
    CAPTURE(method["name"].string());
    CHECK(method["runs"].size() >= 6);
    for (const json::Value& one : method["runs"].array()) {
      if (!one["refused"].is_null() || one["parts"].is_null()) { continue; }
      CAPTURE(one["setting"].string());
      ++parts;
      const json::Value& part = one["parts"];
      // All at the same points in the same norm: the triangle inequality holds to rounding, but for errors given as the noise.
      CHECK(one["errors"]["leaves"]["points"]["l2"].number() <= part["discretisation"].number() + part["links"].number() + noise);
      CHECK(one["errors"]["weighted"]["points"]["l2"].number() <=
            one["errors"]["leaves"]["points"]["l2"].number() + part["reconstruction"].number() + noise);
      if (method["name"].string() == "uniform, matrix") { CHECK(part["links"].number() == 0.0); }
    }
  }
  CHECK(parts >= 4);
}

TEST_CASE("halflight study refuses what it cannot measure") {
  const program::Place place;
  place.write("dark.scene", "material m reflectance 0.5\nbox room from 0 0 0 to 1 1 1 inside material m\n");
  place.write("wrong.scene", "material\n");
  const program::Run dark = place.run("study dark.scene -o out");
  CHECK(dark.code == 3);
  CHECK(dark.err.find("nothing emits light") != std::string::npos);
  CHECK(place.run("study wrong.scene -o out").code == 3);
  CHECK(place.run("study missing.scene -o out").code == 1);  // cannot be read
  CHECK(place.run("study dark.scene").code == 2);
  CHECK(place.run("study dark.scene ./dark.scene -o out").code == 2);
  CHECK(place.run("study dark.scene -o out --paths 0").code == 2);
  CHECK(place.run("study dark.scene -o dark.scene").code == 1);
}
