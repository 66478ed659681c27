// SPDX-License-Identifier: MIT

// Against radiosities and form factors that were found without this code (tests/data/README.md).

#include "catch.hpp"

#include <raycast/objects/sphere.hpp>

#include <radiosity/exchange/exchange.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "reference_data.hpp"
#include "reference_scene.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

using reference::read;

void compare_scene(const std::string& name) {
  const json::Value data = read(name + ".json");
  for (const std::size_t channel : {std::size_t{0}, std::size_t{3}}) {
    const reference::ReferenceScene scene = reference::read_scene(data, channel);
    const radiosity::Options options{.audit_points = 0};
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
TEST_CASE("reference: closed room with sphere and cylinder", "[slow]") { compare_scene("room_sphere_cylinder"); }

TEST_CASE("reference: form factors of all polygon pairs within 1e-6 relative") {
  const json::Value data = read("form_factors.json");
  int pairs = 0;
  for (const json::Value& pair : data["polygons"].array()) {
    const radiosity::Patch patch_p = radiosity::make_patch(reference::points(pair["P"]));
    const radiosity::Patch patch_q = radiosity::make_patch(reference::points(pair["Q"]));
    const double exchange = radiosity::exchange(patch_p, patch_q);
    CAPTURE(pair["name"].string());
    CHECK(exchange / patch_p.area == test::Approx(pair["F_PQ"].number()).epsilon(1e-6));
    CHECK(exchange / patch_q.area == test::Approx(pair["F_QP"].number()).epsilon(1e-6));
    ++pairs;
  }
  CHECK(pairs == 38);
}

namespace {

radiosity::Solution solved(const radiosity::Scene& scene, double epsilon, double min_area) {
  const radiosity::Options options{.epsilon = epsilon, .min_area = min_area, .audit_points = 0};
  return scenes::solved(scene, options);
}

// A room of the file: one material for each wall.
radiosity::Scene box_room(const json::Value& c) {
  radiosity::Scene scene;
  scene.objects = {
      scenes::object("room", scenes::box({0, 0, 0}, {c["box"][0].number(), c["box"][1].number(), c["box"][2].number()}), 0, true)};
  scene.objects[0].material.clear();
  for (std::size_t i = 0; i < 6; ++i) {
    scene.materials.push_back({c["faces"][i].string(), radiosity::Color{c["rho"][i].number()}, radiosity::Color{c["E"][i].number()}});
    scene.objects[0].material.push_back(static_cast<std::uint32_t>(i));
  }
  return scene;
}

const json::Value& case_of(const json::Value& list, const std::string& name) {
  for (const json::Value& c : list.array()) {
    if (c["name"].string() == name) { return c; }
  }
  throw std::runtime_error("no case " + name);
}

}  // namespace

TEST_CASE("reference: furnaces of the file within 1e-3, empty and with things in them") {
  const json::Value data = read("radiosity.json");
  int furnaces = 0;
  for (const json::Value& c : data["exact"].array()) {
    if (c["name"].string().find("furnace") == std::string::npos) { continue; }
    const double expected = c["B"].number();
    const double rho = 1.0 - 1.0 / expected;  // B = 1 / (1 - rho)
    std::vector<radiosity::Scene> rooms{scenes::furnace_cube(rho)};
    if (rho > 0.99) { rooms.push_back(scenes::furnace_with_things(rho)); }
    for (radiosity::Scene& scene : rooms) {
      scene.materials[0].emission = radiosity::Color{1.0};
      const radiosity::Solution solution = solved(scene, 0.1, 1e-3);
      for (const radiosity::MeshFace& face : solution.mesh.faces) { REQUIRE(face.radiosity.x == test::Approx(expected).epsilon(1e-3)); }
    }
    ++furnaces;
  }
  CHECK(furnaces == 3);
}

TEST_CASE("reference: plates close together within 1e-3, and concentric spheres, within 1e-3") {
  const json::Value data = read("radiosity.json");
  const json::Value& plates = case_of(data["exact"], "two infinite parallel plates");
  radiosity::Scene scene = scenes::two_plates(plates["rho"][0].number());
  for (radiosity::SceneObject& o : scene.objects) { o.placement.linear[2][2] = 1e-4; }  // 2e-4 of the light escapes at the rim
  const radiosity::Solution near = solved(scene, 0.5, 0.1);
  CHECK(near.audit.surfaces[0].radiosity.x == test::Approx(plates["B"][0].number()).epsilon(1e-3));
  CHECK(near.audit.surfaces[1].radiosity.x == test::Approx(plates["B"][1].number()).epsilon(1e-3));

  const json::Value& spheres = case_of(data["exact"], "concentric spheres");
  scene = {{{"inner", radiosity::Color{spheres["rho"][0].number()}, radiosity::Color{spheres["E"][0].number()}},
            {"outer", radiosity::Color{spheres["rho"][1].number()}, radiosity::Color{spheres["E"][1].number()}}},
           {scenes::object("inner", raycast::Sphere::make({0, 0, 0}, spheres["radii"][0].number()).object, 0),
            scenes::object("outer", raycast::Sphere::make({0, 0, 0}, spheres["radii"][1].number()).object, 1, true)}};
  const radiosity::Solution solution = solved(scene, 0.02, 1e-5);
  for (std::size_t i = 0; i < 2; ++i) {
    const double error = solution.audit.surfaces[i].radiosity.x / spheres["B"][i].number() - 1.0;
    WARN("concentric spheres, " << solution.audit.surfaces[i].name << ": relative error " << error << ", " << solution.audit.cpu_seconds
                                << " s CPU");
    CHECK(std::abs(error) < 1e-3);
  }
}

TEST_CASE("reference: one patch a wall: the radiosities of the file within 1e-6") {
  const json::Value data = read("radiosity.json");
  for (const json::Value& c : data["per_face"].array()) {
    const radiosity::Solution solution = solved(box_room(c), 1.0, 1.0);
    REQUIRE(solution.audit.leaves == 6);
    CAPTURE(c["name"].string());
    // Exchanges are floats, and the room is closed exactly.
    for (std::size_t i = 0; i < 6; ++i) { CHECK(solution.audit.surfaces[i].radiosity.x == test::Approx(c["B"][i].number()).epsilon(1e-6)); }
  }
}

TEST_CASE("reference: cubes by finite elements: wall means within 1e-3", "[accuracy]") {
  const json::Value data = read("radiosity.json");
  for (const json::Value& c : data["finite_element"].array()) {
    const radiosity::Scene scene = box_room(c);
    const radiosity::Solution solution = solved(scene, 0.01, 1e-5);
    const radiosity::Lookup lookup{scene, solution.mesh, solution.frame};
    double worst = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {
      const double expected = c["face_mean"][c["faces"][i].string()]["value"].number();
      worst = std::max(worst, std::abs(solution.audit.surfaces[i].radiosity.x / expected - 1.0));
    }
    // The picture at points of the walls: u and v of the file are the other two coordinates.
    double at_points = 0.0;
    for (const json::Value& p : c["points"].array()) {
      const std::string face = p["face"].string();
      const int axis = face[0] - 'x';
      glm::dvec3 x{0.0};
      x[axis] = face[1] == '1' ? 1.0 : 0.0;
      x[axis == 0 ? 1 : 0] = p["uv"][0].number();
      x[axis == 2 ? 1 : 2] = p["uv"][1].number();
      const auto shown =
          lookup.at(0, static_cast<std::uint32_t>(2 * axis + (face[1] - '0')), (x - solution.frame.centre) * solution.frame.scale);
      REQUIRE(shown);
      at_points = std::max(at_points, std::abs(shown->x / p["B"].number() - 1.0));
    }
    WARN(c["name"].string() << ": wall means within " << worst << ", picture at the points of the file within " << at_points << ", "
                            << solution.audit.cpu_seconds << " s CPU");
    CHECK(worst <= 1e-3);
  }
}
