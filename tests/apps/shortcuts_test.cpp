// SPDX-License-Identifier: MIT
// What a scene does not need is left out (radiosity/visibility/plan.hpp): with everything done all the same, each result has the same bits.
#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/left_out.hpp>
#include <radiosity/visibility/plan.hpp>

#include "example_scenes.hpp"

namespace {

radiosity::Solution solution_of(const radiosity::Scene& scene, radiosity::Options options, bool shortcuts) {
  options.shortcuts = shortcuts;
  options.audit_points = 0;
  auto outcome = radiosity::solve(scene, options);
  REQUIRE(outcome.solution);
  return std::move(*outcome.solution);
}

// The solution with shortcuts, once it is found equal to that without, bit for bit.
radiosity::Audit same_without(const radiosity::Scene& scene, const radiosity::Options& options) {
  const radiosity::Solution with = solution_of(scene, options, true);
  const radiosity::Solution without = solution_of(scene, options, false);
  CHECK(without.audit.rays_avoided == 0);
  CHECK(without.audit.rays >= with.audit.rays);
  CHECK(without.audit.channels == 3);
  REQUIRE(with.radiosity.size() == without.radiosity.size());
  const bool equal = with.radiosity == without.radiosity;  // false, too, for what is not a number
  CHECK(equal);
  REQUIRE(with.mesh.corners.size() == without.mesh.corners.size());
  bool same = true;
  for (std::size_t i = 0; i < with.mesh.corners.size(); ++i) {
    same = same && with.mesh.corners[i].radiosity == without.mesh.corners[i].radiosity;
  }
  CHECK(same);
  return with.audit;
}

radiosity::Options coarse(radiosity::Refinement refinement) {
  return {.refinement = refinement, .target = 0.2, .epsilon = 0.1, .min_area = 1e-3};
}

bool leaves_out(const radiosity::Audit& audit, const std::string& what) {
  return std::any_of(audit.left_out.begin(), audit.left_out.end(),
                     [&](const radiosity::LeftOut& item) { return item.what.find(what) != std::string::npos; });
}

}  // namespace

TEST_CASE("shortcuts: every scene has the same radiosities, bit for bit, when nothing is left out") {
  for (const std::string& name : example_scenes()) {
    CAPTURE(name);
    if (name == "primitives.scene") { continue; }
    for (const auto refinement : {radiosity::Refinement::a_priori, radiosity::Refinement::a_posteriori}) {
      const radiosity::Audit audit = same_without(example_scene(name), coarse(refinement));
      CHECK_FALSE(audit.left_out.empty());
    }
  }
}

TEST_CASE("shortcuts: the scene of all primitives, too", "[slow]") {
  (void)same_without(example_scene("primitives.scene"), coarse(radiosity::Refinement::a_priori));
}

TEST_CASE("shortcuts: what is proven of a scene is left out of it, told, and changes no bit") {
  // A lamp over a floor, alone, with a box between them, or beside two black sheets that face each other.
  const std::string lamp = "polygon lamp material lamp { vertex 0 0 2 vertex 0 1 2 vertex 1 1 2 vertex 1 0 2 }\n";
  const std::string floor = "polygon floor material white { vertex -1 -1 0 vertex 2 -1 0 vertex 2 2 0 vertex -1 2 0 }\n";
  const std::string blocker = "box blocker from 0.2 0.2 0.9 to 0.8 0.8 1 material white\n";
  const std::string materials = "material lamp reflectance 0 emission 1\nmaterial white reflectance .5\nmaterial black reflectance 0\n";
  struct Case {
    std::string text, what;
  };
  const std::string coal =
      "polygon coal material black { vertex 3 0 0 vertex 4 0 0 vertex 4 1 0 vertex 3 1 0 }\n"
      "polygon soot material black { vertex 3 0 1 vertex 3 1 1 vertex 4 1 1 vertex 4 0 1 }\n";
  for (const Case& c : {Case{materials + lamp + floor, "visibility"}, Case{materials + lamp + floor + blocker, "visibility of"},
                        Case{materials + lamp + floor + blocker, "owner rule"}, Case{materials + lamp + floor, "two colour channels"},
                        Case{materials + lamp + floor + coal, "pairs of input faces"}}) {
    CAPTURE(c.what);
    CHECK(leaves_out(same_without(parsed_scene(c.text), coarse(radiosity::Refinement::a_priori)), c.what));
  }
}

TEST_CASE("shortcuts: without light, or without reflection, a whole solve finds what is told without one: B = E") {
  const std::string plates =
      "polygon a material m { vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 vertex 0 1 0 }\n"
      "polygon b material m { vertex 0 0 1 vertex 0 1 1 vertex 1 1 1 vertex 1 0 1 }\n";
  for (const std::string material : {"material m reflectance .5\n", "material m reflectance 0 emission 2\n"}) {
    const radiosity::Scene scene = parsed_scene(material + plates);
    for (const bool shortcuts : {true, false}) {
      const radiosity::Solution solution = solution_of(scene, coarse(radiosity::Refinement::a_priori), shortcuts);
      CHECK((solution.links.empty() == shortcuts));
      for (const radiosity::Color& b : solution.radiosity) { CHECK(b == scene.materials[0].emission); }
    }
  }
}
