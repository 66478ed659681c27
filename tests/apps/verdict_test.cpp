// SPDX-License-Identifier: MIT

// What the report says of a run's success: its status, its exit code, and of the error of a picture only what is known.

#include <string>
#include <utility>

#include <radiosity/result/error_estimate.hpp>

#include "apps/report.hpp"
#include "apps/text.hpp"
#include "catch.hpp"
#include "json.hpp"
#include "program.hpp"
#include "random_numbers.hpp"

using program::Place;
using program::Run;
using program::scene;

namespace {

// A superquadric that is almost a cylinder: the links do not see how it bends at its edge, path tracing does.
constexpr const char* sharp =
    "material wall reflectance 0.6\nmaterial grey reflectance 0.7\nmaterial lamp reflectance 0 emission 20\n"
    "box room from -2 -2 -2 to 2 2 2 inside material wall\n"
    "superquadric thing center 0 0 0 radii 1 1 1 exponents .001 1 material grey\n"
    "polygon lamp material lamp { vertex -0.5 -0.5 1.99 vertex -0.5 0.5 1.99 vertex 0.5 0.5 1.99 vertex 0.5 -0.5 1.99 }\n";

// The laws of a report of a run without and with a target: the exit code follows from the status, which the audit does not contradict.
void check_agrees(const Run& run, const json::Value& report, double target) {
  const std::string status = report["status"].string();
  INFO(status << ", exit code " << run.code << "\n" << run.out << run.err);
  CHECK(report["converged"].boolean() == (status == "converged"));
  const bool solved = status == "converged" || status == "estimate refuted" || status == "far off" || status == "error unknown";
  CHECK(run.code == (solved ? 0 : 4));
  if (target > 0.0) { CHECK(status != "estimate refuted"); }
  const json::Value& error = report["error"];
  if (status == "converged") {
    CHECK(error["low"].number() <= (target > 0.0 ? target : 3.0 * report["estimated_error"].number()));
    CHECK(run.out.find("status                  converged") != std::string::npos);
  }
  if (status == "estimate refuted") {
    const auto times = [&](const json::Value& found, const char* estimate) {
      return found["relative_l2"].number() / report[estimate].number();
    };
    CHECK((times(error, "estimated_error") > 3.0 || times(error["leaf"], "estimated_leaf_error") > 3.0));
    CHECK(run.out.find("ESTIMATE REFUTED") != std::string::npos);
  }
}

}  // namespace

TEST_CASE("no run says that it has converged where its audit contradicts that, and only a target that was asked for is a failure") {
  const Place place;
  place.write("sharp.scene", sharp);
  int refuted = 0, missed = 0;
  for (const std::string& what : {std::string("sharp.scene"), scene("two_plates"), scene("penumbra")}) {
    for (const double target : {0.0, 0.3, 0.03}) {
      const std::string asked = target > 0.0 ? " --target " + std::to_string(target) : " --epsilon 0.02 --min-area 5e-4";
      const Run run = place.run("render " + what + " -o a.ply --json a.json --quiet" + asked);
      INFO(what << asked);
      const json::Value report = json::parse(place.read("a.json"));
      check_agrees(run, report, target);
      refuted += report["status"].string() == "estimate refuted" ? 1 : 0;
      missed += report["status"].string() == "target missed" ? 1 : 0;
    }
  }
  CAPTURE(missed);
  CHECK(refuted > 0);
}

// The sun shines through a hole of 4 cm, which few of its rays find, and fewer paths.
TEST_CASE("a run whose light neither links nor path tracing find for sure has not converged") {
  const Place place;
  place.write("a.scene",
              "material coal reflectance .001\nmaterial chalk reflectance .9\nmaterial sun reflectance 0 emission 1e6\n"
              "camera v eye .3 .3 1 target 2 2 1 fov 70 size 80 60\n"
              "difference dark material coal {\n box out from -.1 -.1 -.1 to 3.1 4 3\n box in from 0 0 0 to 3 3 2 material chalk\n"
              " box hole from 2 1.48 .98 to 5 1.52 1.02\n}\n"
              "disk sun center 40 1.5 1 normal -1 0 0 radius 2 material sun\nbox block from .5 .5 0 to 1 1 .7 material coal\n");
  const Run run = place.run("render a.scene -o a.png --json a.json --quiet");
  INFO(run.out << run.err);
  const json::Value report = json::parse(place.read("a.json"));
  const json::Value& picture = report["error"]["picture"];
  CHECK((report["status"].string() == "far off" || report["status"].string() == "error unknown"));
  CHECK_FALSE(report["converged"].boolean());
  const bool known = picture.is_object() && picture["worst_tile"].is_object();
  if (known) { CHECK(picture["worst_tile"]["high"].number() >= picture["low"].number()); }
  CHECK(run.code == 0);
}

TEST_CASE("interrupted while light is gathered for the picture, the program writes all outputs, the picture of the mesh") {
  const Place place;
  int of_mesh = 0;
  for (const char* after : {"0.5", "1", "2", "4", "8"}) {
    const Run run = place.run("render " + scene("cornell") + " -o a.png --json a.json --quiet --threads 1",
                              std::string("timeout -k 60 -s INT ") + after + " ");
    INFO("after " << after << " s\n" << run.out << run.err);
    CHECK(run.code != 137);  // it did not have to be killed
    if (!place.has("a.json")) {
      CHECK(run.err.find("nothing was written") != std::string::npos);
      CHECK_FALSE(place.has("a.png"));
      continue;
    }
    CHECK(place.has("a.png"));
    const json::Value report = json::parse(place.read("a.json"));
    const bool interrupted = report["interrupted"].boolean(), mesh = report["picture"]["method"].string() == "mesh";
    CHECK((report["status"].string() == "interrupted") == interrupted);
    CHECK(report["converged"].boolean() == !interrupted);
    CHECK((!mesh || interrupted));
    CHECK((run.err.find("interrupted: the outputs show the best solution so far") != std::string::npos) == interrupted);
    CHECK((run.err.find("pictures its mesh") != std::string::npos) == mesh);
    CHECK((run.out.find("the run was interrupted") != std::string::npos) == interrupted);
    of_mesh += mesh ? 1 : 0;
  }
  CHECK(of_mesh > 0);
}

TEST_CASE("of the pixels that are off the report says what is known, and nothing where that is next to nothing") {
  RandomNumbers random(31);
  INFO("seed 31");
  for (int k = 0; k < 300; ++k) {
    radiosity::PictureError error;
    const auto bounds = [&] {
      double a = k % 3 == 0 ? 0.0 : random.number(0.0, 1.0), b = k % 5 == 0 ? 1.0 : random.number(0.0, 1.0);
      if (a > b) { std::swap(a, b); }
      return k % 7 == 0 ? radiosity::ShareBounds{a, a} : radiosity::ShareBounds{a, b};
    };
    error.over2 = bounds();
    error.over8 = bounds();
    const std::string text = apps::picture_error_text(error, "front");
    const std::string label = "off by 2, 8 of 255";
    const std::size_t begin = text.find(label);
    REQUIRE(begin != std::string::npos);
    const std::string line = text.substr(begin + label.size(), text.find('\n', begin) - begin - label.size());
    INFO(error.over2.least << " " << error.over2.most << ", " << error.over8.least << " " << error.over8.most << ": " << line);
    const auto wide = [](const radiosity::ShareBounds& of) { return of.most - of.least > 0.9; };
    const std::size_t comma = line.find(',');
    if (wide(error.over2) && wide(error.over8)) {
      CHECK(line.find('%') == std::string::npos);
      CHECK(line.find("unknown") != std::string::npos);
      continue;
    }
    REQUIRE(comma != std::string::npos);
    const std::string parts[2] = {line.substr(0, comma), line.substr(comma)};
    const radiosity::ShareBounds* of[2] = {&error.over2, &error.over8};
    for (int i = 0; i < 2; ++i) {
      const bool unknown = parts[i].find("unknown") != std::string::npos;
      CHECK(unknown == wide(*of[i]));
      if (unknown) { continue; }
      // Each bound that says anything is printed.
      if (of[i]->least > 0.0) { CHECK(parts[i].find(apps::percent(of[i]->least)) != std::string::npos); }
      if (of[i]->most < 1.0) { CHECK(parts[i].find(apps::percent(of[i]->most)) != std::string::npos); }
    }
  }
}
