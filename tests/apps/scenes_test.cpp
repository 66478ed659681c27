// SPDX-License-Identifier: MIT
// The scenes that come with the project: they parse, every BRep stays valid while it is refined, and the solved
// radiosities agree with our own path tracing.
#include "catch.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>

#include "example_scenes.hpp"
#include "generations.hpp"
#include "program.hpp"

namespace {

void solve_with_checks(const std::string& name, double epsilon, double min_area) {
  CAPTURE(name);
  const radiosity::Options options{.epsilon = epsilon, .min_area = min_area, .audit_points = 0};
  int generations = 0;
  const radiosity::Control control = watch_generations(generations);
  const auto outcome = radiosity::solve(example_scene(name), options, control);
  REQUIRE(outcome.solution);
  CHECK(generations > 0);
  CHECK(outcome.solution->audit.converged);
  CHECK(outcome.solution->audit.energy_balance < 1e-5);
}

}  // namespace

TEST_CASE("every scene: valid BReps after every generation, v - e + f = 2 (s - h), converged, energy conserved") {
  REQUIRE(example_scenes().size() >= 11);
  for (const std::string& name : example_scenes()) {
    if (name != "primitives.scene") { solve_with_checks(name, 0.02, 1e-4); }
  }
}

TEST_CASE(
    "scenes with parameters: the files are what make_scenes.sh writes, begin with their difficulty, and other parameters parse, too") {
  const program::Place place;
  const auto made = [&](const std::string& arguments) {
    const std::string out = (place.path() / "made.scene").string();
    REQUIRE(std::system(("sh '" HALFLIGHT_SCENES "/make_scenes.sh' " + arguments + " >'" + out + "' 2>&1").c_str()) == 0);
    return program::content(out);
  };
  for (const std::string name : {"perpendicular_plates", "penumbra", "corridor", "nested_rooms", "boxes", "sphere", "cylinder"}) {
    CAPTURE(name);
    const std::string text = made(name);
    CHECK(text == program::content(std::string(HALFLIGHT_SCENES) + "/" + name + ".scene"));
    CHECK(text.substr(0, 2) == "# ");
  }
  for (const char* arguments : {"perpendicular_plates 150", "penumbra 1.9", "corridor 40 0.99", "nested_rooms 0.1 4", "boxes 1 3",
                                "boxes 300 2", "sphere 3", "cylinder 0.01"}) {
    const apps::SceneResult result = apps::parse_scene(made(arguments));
    INFO(apps::to_text(result, arguments));
    CHECK(result.file);
  }
}

TEST_CASE("the scene of all primitives keeps the same laws", "[slow]") { solve_with_checks("primitives.scene", 0.15, 1e-3); }

TEST_CASE("Cornell box and room agree with path tracing surface by surface", "[slow]") {
  // Mean radiosities by our own path tracer (as traced() in tests/radiosity/audit_test.cpp), 400 000 paths a surface; standard errors
  // below 0.5 %, 0.75 % on the darkest (short_block.f2). Tolerance: 2 % and two standard errors.
  const std::map<std::string, std::vector<std::pair<std::string, radiosity::Color>>> traced{
      {"cornell.scene",
       {
           {"floor", {0.13449, 0.089464, 0.024262}},
           {"ceiling", {0.10111, 0.060164, 0.01417}},
           {"back_wall", {0.16725, 0.10994, 0.029689}},
           {"right_wall", {0.035007, 0.075859, 0.0045729}},
           {"left_wall.f0", {0.11917, 0.0073371, 0.0016848}},
           {"left_wall.f1", {0.16029, 0.011276, 0.0026004}},
           {"short_block.f0", {0.31418, 0.22016, 0.064717}},
           {"short_block.f1", {0.10632, 0.053466, 0.015275}},
           {"short_block.f2", {0.013413, 0.0058692, 0.0015818}},
           {"short_block.f3", {0.017806, 0.031614, 0.0025491}},
           {"short_block.f4", {0.097342, 0.082451, 0.017448}},
           {"tall_block.f0", {0.721, 0.47693, 0.14862}},
           {"tall_block.f1", {0.083864, 0.0081358, 0.0020059}},
           {"tall_block.f2", {0.097986, 0.047297, 0.012376}},
           {"tall_block.f3", {0.091454, 0.081654, 0.016276}},
           {"tall_block.f4", {0.078521, 0.048831, 0.013119}},
       }},
      {"room.scene",
       {
           {"room.x0", {0.15081, 0.016771, 0.010812}},
           {"room.x1", {0.024884, 0.081294, 0.021522}},
           {"room.y0", {0.15124, 0.086117, 0.044894}},
           {"room.y1", {0.153, 0.084871, 0.045701}},
           {"room.z0", {0.19227, 0.1123, 0.062437}},
           {"room.z1", {0.10249, 0.049107, 0.021937}},
           {"ball", {0.21126, 0.064706, 0.021204}},
           {"post.side", {0.05196, 0.036747, 0.053906}},
           {"post.top", {0.16741, 0.13116, 0.2464}},
       }},
  };
  for (const auto& [name, means] : traced) {
    const radiosity::Options options{.audit_points = 0};
    const auto outcome = radiosity::solve(example_scene(name), options);
    REQUIRE(outcome.solution);
    std::map<std::string, radiosity::Color> solved;
    for (const auto& mean : outcome.solution->audit.surfaces) { solved[mean.name] = mean.radiosity; }
    for (const auto& [surface, expected] : means) {
      for (int c = 0; c < 3; ++c) {
        CAPTURE(name, surface, c);
        CHECK(solved.at(surface)[c] == test::Approx(expected[c]).epsilon(0.03));
      }
    }
  }
}

TEST_CASE("audit: of 16 examples at the default audit, 14 know their error to within itself, or say below what it is", "[slow]") {
  int known = 0;
  for (const std::string name :
       {"paper_figure", "paper_figure_small", "penumbra", "perpendicular_plates", "sphere", "cylinder", "two_plates", "three_plates"}) {
    for (const std::uint64_t seed : {1, 2}) {
      const radiosity::Options options{.seed = seed};
      const auto outcome = radiosity::solve(example_scene(name + ".scene"), options);
      REQUIRE(outcome.solution);
      const radiosity::Audit& audit = outcome.solution->audit;
      REQUIRE(audit.leaf_error);
      REQUIRE(audit.surface_error);
      const auto narrow = [](const radiosity::ErrorEstimate& error) {
        return error.low == 0.0 || error.high - error.low <= error.relative_l2;
      };
      CAPTURE(name, seed, audit.surface_error->low, audit.surface_error->high, audit.leaf_error->low, audit.leaf_error->high);
      CHECK(audit.leaf_error->high < 0.1);
      CHECK(audit.surface_error->high < 0.1);
      known += narrow(*audit.leaf_error) && narrow(*audit.surface_error) ? 1 : 0;
    }
  }
  CHECK(known >= 14);
}
