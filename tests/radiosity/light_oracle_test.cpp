// SPDX-License-Identifier: MIT

// What the light of a lamp does: the light oracle keeps its variation over a leaf small, and the path tracer tells it from the rest.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/sphere.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

// A square lamp about the point (x, y, z) of unit emission, seen from above or from below.
radiosity::Polygon lamp_square(const glm::dvec3& centre, double side, bool up) {
  const double h = 0.5 * side;
  radiosity::Polygon corners;
  for (const glm::dvec2 c : {glm::dvec2{-h, -h}, glm::dvec2{h, -h}, glm::dvec2{h, h}, glm::dvec2{-h, h}}) {
    corners.push_back(centre + glm::dvec3{c, 0.0});
  }
  if (!up) { std::reverse(corners.begin(), corners.end()); }
  return corners;
}

}  // namespace

TEST_CASE("light oracle: over a leaf of a sphere the light of a lamp varies by no more than its share of the error") {
  const radiosity::Polygon lamp = lamp_square({0, 0, 3}, 0.2, false);
  radiosity::Scene scene;
  scene.materials = {{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
  scene.objects = {scenes::object("ball", raycast::Sphere::make({0, 0, 0}, 0.5).object, 0),
                   scenes::object("lamp", scenes::polygon(lamp), 1)};
  radiosity::Options options{.epsilon = 0.5, .audit_points = 0};
  options.min_area = 1e-4;  // the lamp is far: nothing but its light splits anything
  options.light_epsilon = 0.0003;
  const radiosity::Solution solution = scenes::solved(scene, options);
  double scene_area = 0.0;
  double power = 0.0;
  for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) {
    const radiosity::Node& node = solution.hierarchy[i];
    if (!radiosity::is_input_face(solution.hierarchy, i)) { continue; }
    scene_area += node.area;
    power += node.surface == 1 ? node.area : 0.0;
  }
  std::size_t leaves = 0;
  for (const radiosity::MeshFace& face : solution.mesh.faces) {
    if (face.surface != 0) { continue; }
    double low = 1.0;
    double high = 0.0;
    for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
      const glm::dvec3& x = solution.mesh.positions[solution.mesh.corners[c].vertex];
      const double f = radiosity::point_to_polygon(x, glm::normalize(x), lamp);
      low = std::min(low, f);
      high = std::max(high, f);
    }
    const double weight = scene_area / power * std::sqrt(solution.hierarchy[face.node].area / scene_area);
    // Linear between extremes; the disk of the oracle's estimate errs by (.1 / 2.5)^2, the lamp's half side over the least distance.
    CHECK(weight * (high - low) <= std::sqrt(12.0) * *options.light_epsilon * (1.0 + 2.0 * 0.0016));
    ++leaves;
  }
  CHECK(leaves > 200);
}

// A strip whose middle is far from most of what it lights; half of them nearly touch that with an edge.
TEST_CASE("light oracle: beside a long lamp, too, the light varies over no leaf by more than its share of the error") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    radiosity::Random random{seed, 0x7374726970ull};
    const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    const double h = seed % 2 == 0 ? 0.001 : between(0.02, 0.2), width = between(0.01, 0.05), turn = between(0.0, 1.5),
                 tilt = between(0.1, 0.5);
    const glm::dvec3 along{0.5 * std::cos(turn), 0.5 * std::sin(turn), 0.0};
    const glm::dvec3 across{-width * std::sin(turn) * std::cos(tilt), width * std::cos(turn) * std::cos(tilt), width * std::sin(tilt)};
    const double x = between(0.4, 1.6);
    const glm::dvec3 middle{x, between(0.4, 1.6), h + across.z};
    const radiosity::Polygon lamp{middle - along - across, middle - along + across, middle + along + across, middle + along - across};
    radiosity::Scene scene;
    scene.materials = {{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
    scene.objects = {scenes::object("wall", scenes::polygon({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}), 0),
                     scenes::object("lamp", scenes::polygon(lamp), 1)};
    radiosity::Options options{.audit_points = 0};
    options.epsilon = 1.0;    // nothing but the light splits anything,
    options.min_area = 0.05;  // and the lamp is not cut
    options.light_epsilon = 0.01;
    options.reconstruction = radiosity::Reconstruction::constant;  // a face a leaf
    const radiosity::Solution solution = scenes::solved(scene, options);
    const double power = 2.0 * width, scene_area = 4.0 + power;
    // A quarter of min_area by the square of what this is finer than a quarter of epsilon (Options::light_epsilon); smaller leaves may vary
    // more.
    const double least_area = 0.25 * options.min_area * std::pow(*options.light_epsilon / (0.25 * options.epsilon), 2.0) * scene_area;
    double worst = 0.0;
    std::size_t leaves = 0;
    for (const radiosity::MeshFace& face : solution.mesh.faces) {
      const double area = solution.hierarchy[face.node].area;
      if (face.surface != 0 || !(area > least_area)) { continue; }
      ++leaves;
      glm::dvec3 lo{2.0}, hi{0.0};  // a square
      for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
        lo = glm::min(lo, solution.mesh.positions[solution.mesh.corners[c].vertex]);
        hi = glm::max(hi, solution.mesh.positions[solution.mesh.corners[c].vertex]);
      }
      double sum = 0.0, square = 0.0;
      constexpr int points = 64;
      for (int k = 0; k < points; ++k) {
        const double u = random.uniform();
        const glm::dvec3 at{lo.x + u * (hi.x - lo.x), lo.y + random.uniform() * (hi.y - lo.y), 0.0};
        const bool in_front = glm::dot(glm::cross(across, along), at - middle) > 0.0;
        const double f = in_front ? radiosity::point_to_polygon(at, {0, 0, 1}, lamp) : 0.0;
        sum += f / points;
        square += f * f / points;
      }
      worst = std::max(worst, scene_area / power * std::sqrt(area / scene_area) * std::sqrt(std::max(0.0, square - sum * sum)));
    }
    CAPTURE(seed, h, width, turn, tilt, leaves);
    CHECK(leaves > 100);
    CHECK(worst <= *options.light_epsilon);
  }
}

// Luminaires as they are drawn: tubes of long faces that touch what reflects them.
TEST_CASE("tubes that touch a ceiling light it as they are long, and the room with what they leave", "[accuracy]") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    radiosity::Random random{seed, 0x74756265ull};
    const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    radiosity::Scene scene;
    scene.materials = {{"wall", radiosity::Color{0.7}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.1}, radiosity::Color{40.0}}};
    const glm::dvec3 size{between(3.0, 5.0), between(3.0, 4.0), 2.5};
    scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, size), 0, true)};
    for (int k = 0; k < 2; ++k) {
      const double r = between(0.015, 0.03), length = between(0.6, 1.4), x = 0.8 + 1.2 * k, y = between(0.5, 1.2);
      const int n = 8 * static_cast<int>(between(1.0, 3.0));
      std::vector<glm::dvec3> corners;
      std::vector<std::vector<std::uint32_t>> faces(2);
      for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * std::acos(-1.0) * i / n;
        for (const double end : {0.0, length}) { corners.push_back({x + r * std::cos(angle), y + end, size.z - r + r * std::sin(angle)}); }
        const auto a = static_cast<std::uint32_t>(2 * i), b = static_cast<std::uint32_t>(2 * ((i + 1) % n));
        faces.push_back({a, a + 1, b + 1, b});
        faces[0].push_back(a);
        faces[1].insert(faces[1].begin(), a + 1);
      }
      scene.objects.push_back(scenes::object("tube", raycast::Mesh::make(corners, faces).object, 1));
    }
    const radiosity::Options options{.epsilon = 0.01, .min_area = 2e-4, .audit_points = 1000};
    const radiosity::Audit audit = scenes::solved(scene, options).audit;
    REQUIRE(audit.leaf_error);
    CAPTURE(seed, audit.leaf_error->relative_l2, audit.leaf_error->low, audit.leaf_error->high, audit.leaves, audit.escaped);
    CHECK(audit.leaf_error->low < 0.15);  // lit as by disks, they erred by .5 to .6
    CHECK(std::abs(audit.escaped) < 0.02);
  }
}

namespace {

// A room of walls, of which the one at y = 0 has a window, and a lamp outside. Reflectance .7; material 1 shines.
radiosity::Scene room_with_window(radiosity::Random& random, radiosity::Color emission) {
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  radiosity::Scene scene;
  scene.materials = {{"white", radiosity::Color{0.7}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, emission}};
  const double w = between(4.0, 7.0), d = between(3.0, 6.0), h = between(2.4, 3.5);
  const double x0 = between(0.5, 1.5), x1 = x0 + between(0.8, 2.0), z0 = between(0.4, 1.0), z1 = between(1.6, 2.2);
  const auto wall = [&](std::string name, std::vector<glm::dvec3> corners) {
    scene.objects.push_back(scenes::object(std::move(name), scenes::polygon(std::move(corners)), 0));
  };
  wall("floor", {{0, 0, 0}, {w, 0, 0}, {w, d, 0}, {0, d, 0}});
  wall("ceiling", {{0, 0, h}, {0, d, h}, {w, d, h}, {w, 0, h}});
  wall("back", {{0, d, 0}, {w, d, 0}, {w, d, h}, {0, d, h}});
  wall("left", {{0, 0, 0}, {0, d, 0}, {0, d, h}, {0, 0, h}});
  wall("right", {{w, d, 0}, {w, 0, 0}, {w, 0, h}, {w, d, h}});
  wall("beside 1", {{0, 0, 0}, {0, 0, h}, {x0, 0, h}, {x0, 0, 0}});
  wall("beside 2", {{x1, 0, 0}, {x1, 0, h}, {w, 0, h}, {w, 0, 0}});
  wall("below", {{x0, 0, 0}, {x0, 0, z0}, {x1, 0, z0}, {x1, 0, 0}});
  wall("above", {{x0, 0, z1}, {x0, 0, h}, {x1, 0, h}, {x1, 0, z1}});
  return scene;
}

}  // namespace

TEST_CASE("a lamp behind a window: what the lamp sends elsewhere makes no error larger", "[accuracy]") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    radiosity::Random random{seed, 0x73756eull};
    radiosity::Scene scene = room_with_window(random, radiosity::Color{100.0});
    // A sun whose light comes in by a thousandth or less, as a sphere or as a mesh of few faces.
    const glm::dvec3 centre{1.0 + 3.0 * random.uniform(), -8.0 - 8.0 * random.uniform(), 4.0 + 6.0 * random.uniform()};
    const double radius = 0.5 + 1.5 * random.uniform();
    scene.objects.push_back(seed % 2 == 0 ? scenes::object("sun", raycast::Sphere::make(centre, radius).object, 1)
                                          : scenes::object("sun", scenes::box(centre - radius, centre + radius), 1));
    const radiosity::Options options{.epsilon = 0.02, .min_area = 2e-4, .audit_points = 1000};
    const radiosity::Audit audit = scenes::solved(scene, options).audit;
    REQUIRE(audit.leaf_error);
    CAPTURE(seed, *audit.reflected_share, audit.leaf_error->relative_l2, audit.leaf_error->low, audit.leaf_error->high);
    CHECK(*audit.reflected_share < 0.05);
    CHECK(audit.leaf_error->low < 0.08);
  }
}

TEST_CASE("a lamp behind a window is resolved alike, however much light goes elsewhere", "[accuracy]") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    double leaves[2] = {};
    double shares[2] = {};
    for (const bool also_away : {false, true}) {
      radiosity::Random random{seed, 0x61776179ull};
      radiosity::Scene scene = room_with_window(random, radiosity::Color{100.0});
      scene.objects.push_back(scenes::object("lamp", scenes::polygon({{1, -15, 5}, {1, -12, 9}, {3, -12, 9}, {3, -15, 5}}), 1));
      // The other way, behind the room: a lamp that sends a hundred times as much away, or nothing.
      scene.materials.push_back({"black", radiosity::Color{0.0}, radiosity::Color{0.0}});
      scene.objects.push_back(
          scenes::object("away", scenes::polygon({{-9, 20, 0}, {-9, 20, 5}, {-3, 20, 5}, {-3, 20, 0}}), also_away ? 1 : 2));
      radiosity::Options options;
      options.epsilon = 0.1;  // the light of the lamp alone splits
      options.min_area = 1e-4;
      options.light_epsilon = 0.005;
      options.audit_points = 0;
      for (options.seed = 1; options.seed <= 3; ++options.seed) {
        const radiosity::Audit audit = scenes::solved(scene, options).audit;
        leaves[also_away ? 1 : 0] += static_cast<double>(audit.leaves) / 3.0;
        shares[also_away ? 1 : 0] += *audit.reflected_share / 3.0;
      }
    }
    CAPTURE(seed, leaves[0], leaves[1], shares[0], shares[1]);
    CHECK(leaves[0] > 100);
    // The mean emission is four times as large, and so is what the errors are measured by, to the tenth or so to which rays find it. Leaves
    // along the edges of shadows grow as its square.
    CHECK(shares[0] / shares[1] == test::Approx(4.0).epsilon(0.25));
    CHECK(leaves[1] < 2.2 * leaves[0]);
    CHECK(leaves[1] > leaves[0] / 2.2);
  }
}

TEST_CASE("what reflects little takes few leaves, however bright a lamp shines on it", "[accuracy]") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    std::vector<std::size_t> of_screen;
    for (const double rho : {0.5, 0.01, 0.0}) {
      radiosity::Random random{seed, 0x6461726bull};
      radiosity::Scene scene = room_with_window(random, radiosity::Color{100.0});
      scene.materials.push_back({"screen", radiosity::Color{rho}, radiosity::Color{0.0}});
      scene.objects.push_back(scenes::object("lamp", scenes::polygon({{1, -3, 1}, {1, -2.6, 2}, {2, -2.6, 2}, {2, -3, 1}}), 1));
      const double z = 0.2 + 0.6 * random.uniform();  // below the lamp, which shines down on it as well as into the room
      scene.objects.push_back(scenes::object("screen", scenes::polygon({{-2, -3, z}, {5, -3, z}, {5, -1, z}, {-2, -1, z}}), 2));
      radiosity::Options options;
      options.epsilon = 0.1;  // the light of the lamp alone splits
      options.min_area = 1e-4;
      options.light_epsilon = 0.002;
      options.audit_points = 0;
      const radiosity::Solution solution = scenes::solved(scene, options);
      const auto screen = static_cast<std::size_t>(
          std::count_if(solution.mesh.faces.begin(), solution.mesh.faces.end(), [&](const auto& face) { return face.surface == 10; }));
      of_screen.push_back(screen);
    }
    CAPTURE(seed, of_screen);
    CHECK(of_screen[0] > 1000);
    CHECK(of_screen[1] < of_screen[0] / 2);
    CHECK(of_screen[2] < of_screen[0] / 20);
  }
}

TEST_CASE("path tracing: the light that was reflected once is rho E F, whether lamps are sampled or met by chance") {
  for (const double side : {0.2, 1.0}) {  // one lamp is a 25th of the wall, the other as large
    CAPTURE(side);
    const radiosity::Polygon lamp = lamp_square({0, 0, 0}, side, true);
    radiosity::Scene scene;
    scene.materials = {{"lamp", radiosity::Color{0.5}, radiosity::Color{1.0}}, {"wall", radiosity::Color{0.5}, radiosity::Color{0.0}}};
    scene.objects = {scenes::object("lamp", scenes::polygon(lamp), 0),
                     scenes::object("wall", scenes::polygon(lamp_square({0, 0, 1}, 1.0, false)), 1)};
    const radiosity::PrepareResult prepared = radiosity::prepare(scene);
    REQUIRE(prepared.prepared);
    const radiosity::PathTracer tracer{scene, prepared.prepared->objects, prepared.prepared->surfaces};
    const radiosity::Frame& frame = prepared.prepared->frame;
    const glm::dvec3 x = (glm::dvec3{0, 0, 1} - frame.centre) * frame.scale;
    const int paths = 40'000;
    double sum = 0.0;
    double square = 0.0;
    double rest = 0.0;
    std::uint64_t rays = 0;
    for (int i = 0; i < paths; ++i) {
      radiosity::Random random{11, static_cast<std::uint64_t>(i)};
      const radiosity::PathTracer::Light light = tracer.radiosity({{x, {0, 0, -1}}, 1, 0}, random, rays);
      sum += light.direct.x / paths;
      square += light.direct.x * light.direct.x / paths;
      REQUIRE(light.all.x >= light.direct.x);
      rest += light.all.x - light.direct.x;
    }
    const double expected = 0.5 * radiosity::point_to_polygon({0, 0, 1}, {0, 0, -1}, lamp);
    CHECK(std::abs(sum - expected) <= 4.0 * std::sqrt((square - sum * sum) / paths) + 1e-12);
    CHECK(rest > 0.0);
  }
}
