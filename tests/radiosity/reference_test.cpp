// SPDX-License-Identifier: MIT

// Against independent Monte-Carlo radiosities with standard errors, and form factors to 25 digits. Skipped where the reference data are
// not at hand.

#include "catch.hpp"

#include <fstream>

#include "reference_scene.hpp"

namespace {

const std::string data_folder = HALFLIGHT_REFERENCE_DATA;

bool present(const std::string& file) {
  if (std::ifstream{data_folder + "/" + file}) { return true; }
  WARN("skipped: no reference data at " << data_folder << "/" << file);
  return false;
}

void compare_scene(const std::string& name) {
  const std::string file = "scenes/" + name + ".json";
  if (!present(file)) { return; }
  const json::Value data = json::parse_file(data_folder + "/" + file);
  for (const std::size_t channel : {std::size_t{0}, std::size_t{3}}) {
    const reference::ReferenceScene scene = reference::read_scene(data, channel);
    radiosity::Options options;
    options.audit_points = 0;
    const radiosity::Outcome outcome = radiosity::solve(scene.scene, options);
    REQUIRE(outcome.solution);
    for (const bool leaf : {true, false}) {
      const reference::Comparison result = reference::compare(data, channel, scene, *outcome.solution, leaf);
      WARN(name << ", channels " << channel << "-" << channel + 2 << (leaf ? ", leaves:  " : ", picture: ") << "relative L2 "
                << 100.0 * result.relative_l2 << " %, worst patch " << 100.0 * result.worst_to_max << " % of the brightest ("
                << 100.0 * result.worst << " % of its own: " << result.worst_patch << "), reference noise "
                << 100.0 * result.reference_noise << " %, " << outcome.solution->audit.cpu_seconds << " s CPU");
      CHECK(result.relative_l2 <= 0.02);
      CHECK(result.worst_to_max <= 0.06);
    }
  }
}

}  // namespace

TEST_CASE("reference: Cornell box, empty", "[slow]") { compare_scene("cornell_empty"); }
TEST_CASE("reference: Cornell box with the short block", "[slow]") { compare_scene("cornell_short"); }
TEST_CASE("reference: closed room with sphere and cylinder", "[slow]") { compare_scene("room_sphere_cylinder_A"); }

TEST_CASE("reference: form factors of all polygon pairs within 1e-4 relative") {
  const std::string file = "formfactors/ff_unoccluded.json";
  if (!present(file)) { return; }
  const json::Value data = json::parse_file(data_folder + "/" + file);
  int pairs = 0;
  for (const json::Value& pair : data.array()) {
    std::vector<glm::dvec3> p = reference::points(pair["P"]);
    std::vector<glm::dvec3> q = reference::points(pair["Q"]);
    const std::string name = pair["family"].string() + " " + pair["name"].string();
    if (name == "published_narayanaswamy Ex4") {  // both polygons are given with their backs to each other
      std::reverse(p.begin(), p.end());
      std::reverse(q.begin(), q.end());
    }
    const radiosity::Patch patch_p = radiosity::make_patch(p);
    const radiosity::Patch patch_q = radiosity::make_patch(q);
    const double exchange = radiosity::exchange(patch_p, patch_q);
    CAPTURE(name);
    CHECK(exchange / patch_p.area == test::Approx(pair["F_PQ"].number()).epsilon(1e-6));
    CHECK(exchange / patch_q.area == test::Approx(pair["F_QP"].number()).epsilon(1e-6));
    ++pairs;
  }
  CHECK(pairs == 38);
}
