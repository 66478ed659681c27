// SPDX-License-Identifier: MIT

// Rooms of separate polygons: proven closed when they are, however they are cut into pieces, ordered and turned, and never when light could
// leave them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <raycast/object.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>
#include <raycast/transform.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

using Corners = std::vector<glm::dvec3>;

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_{seed} {}

  double uniform(double a, double b) { return std::uniform_real_distribution<>{a, b}(random_); }
  std::size_t below(std::size_t n) { return random_() % n; }

  // The walls of a prism about the origin whose base has 3 to 7 corners, between z = 0 and z = height; their fronts face inside. It holds
  // the upright cylinder of radius .3.
  std::vector<Corners> prism(double height) {
    const std::size_t n = 3 + below(5);
    Corners base;
    for (std::size_t i = 0; i < n; ++i) {
      // Angles less than 2.8 apart; chords between points at the distance r pass the centre at r cos(1.4) or more.
      const double angle = (static_cast<double>(i) + uniform(-0.16, 0.16)) * 2.0 * std::numbers::pi / static_cast<double>(n);
      base.emplace_back(2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.0);
    }
    const auto above = [&](const glm::dvec3& p) { return p + glm::dvec3{0.0, 0.0, height}; };
    std::vector<Corners> walls{base, {}};
    for (std::size_t i = n; i-- > 0;) { walls[1].push_back(above(base[i])); }
    for (std::size_t i = 0; i < n; ++i) {
      const glm::dvec3 &a = base[i], &b = base[(i + 1) % n];
      walls.push_back({b, a, above(a), above(b)});
    }
    return walls;
  }

  // Cuts convex polygons from border to border at random: most cuts end within an edge of a neighbour.
  std::vector<Corners> in_pieces(std::vector<Corners> walls, int cuts) {
    for (int cut = 0; cut < cuts; ++cut) {
      const std::size_t at = below(walls.size());
      const Corners whole = walls[at];
      const std::size_t n = whole.size();
      const std::size_t i = below(n);
      const std::size_t j = (i + 1 + below(n - 1)) % n;  // another edge
      const auto on_edge = [&](std::size_t k) { return glm::mix(whole[k], whole[(k + 1) % n], uniform(0.2, 0.8)); };
      const glm::dvec3 p = on_edge(i), q = on_edge(j);
      Corners one{p}, other{q};
      for (std::size_t k = i; k != j; k = (k + 1) % n) { one.push_back(whole[(k + 1) % n]); }
      for (std::size_t k = j; k != i; k = (k + 1) % n) { other.push_back(whole[(k + 1) % n]); }
      one.push_back(q);
      other.push_back(p);
      walls[at] = one;
      walls.push_back(other);
    }
    return walls;
  }

  // Objects in random order, each polygon from a random corner on, the whole turned and moved.
  radiosity::Scene scene_of(std::vector<Corners> walls, std::vector<std::shared_ptr<const raycast::Object>> solids = {}) {
    radiosity::Scene scene{{scenes::furnace_material(0.5)}, {}};
    for (Corners& wall : walls) {
      std::rotate(wall.begin(), wall.begin() + static_cast<std::ptrdiff_t>(below(wall.size())), wall.end());
      scene.objects.push_back(scenes::plate("wall", wall));
    }
    for (auto& solid : solids) { scene.objects.push_back(scenes::object("solid", std::move(solid))); }
    std::shuffle(scene.objects.begin(), scene.objects.end(), random_);
    const glm::dvec3 axis = glm::normalize(glm::dvec3{uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1)});
    const double angle = uniform(0.0, 6.0);
    for (radiosity::SceneObject& object : scene.objects) {
      for (int k = 0; k < 3; ++k) {  // Rodrigues
        glm::dvec3 unit{0.0};
        unit[k] = 1.0;
        object.placement.linear[k] =
            std::cos(angle) * unit + std::sin(angle) * glm::cross(axis, unit) + (1.0 - std::cos(angle)) * glm::dot(axis, unit) * axis;
      }
      object.placement.translation = {1.0, -2.0, 3.0};
    }
    return scene;
  }

 private:
  std::mt19937_64 random_;
};

bool closed(const radiosity::Scene& scene) {
  const radiosity::PrepareResult made = radiosity::prepare(scene);
  REQUIRE(made.prepared);
  return made.prepared->plan.closed;
}

std::vector<Corners> together(std::vector<Corners> a, const std::vector<Corners>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Of a box, facing outwards.
std::vector<Corners> box_of_polygons(const glm::dvec3& lo, const glm::dvec3& hi) {
  const auto at = [&](int x, int y, int z) { return glm::dvec3{x != 0 ? hi.x : lo.x, y != 0 ? hi.y : lo.y, z != 0 ? hi.z : lo.z}; };
  return {{at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)}, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)},
          {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, {at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)},
          {at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)}, {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}};
}

// All surfaces reflect rho and emit 1 - rho.
radiosity::Solution furnace(radiosity::Scene scene, double rho, double epsilon = 0.05) {
  scene.materials = {scenes::furnace_material(rho)};
  const radiosity::Options options{.epsilon = epsilon, .min_area = 1e-3, .audit_points = 0};
  return scenes::solved(scene, options);
}

// Closed rows leave the residual of the solver, which grows by 1 / (1 - rho), and floats: 1e-8 and 2^-24 times 100 at rho .99.
void check_glow(const radiosity::Solution& solution) {
  REQUIRE(solution.audit.closure);
  for (const auto& face : solution.mesh.faces) { CHECK(std::abs(face.radiosity.x - 1.0) < 1e-4); }
}

// With walls whose second sides look out. Returns the number of surfaces that look into the room: they come first.
std::size_t add_outsides(radiosity::Scene& scene, const std::vector<Corners>& walls) {
  const std::size_t within = radiosity::surfaces(scene).size();
  for (const Corners& wall : walls) {
    scene.objects.push_back(scenes::plate("outside", {wall.rbegin(), wall.rend()}));
    scene.objects.back().placement = scene.objects.front().placement;
  }
  return within;
}

}  // namespace

TEST_CASE("a room of polygons is closed however it is cut and turned, and open when one is missing, turned around or moved away") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Maker make{seed};
  for (int round = 0; round < 40; ++round) {
    INFO("round " << round);
    const std::vector<Corners> walls = make.in_pieces(make.prism(make.uniform(0.5, 3.0)), static_cast<int>(make.below(12)));
    CHECK(closed(make.scene_of(walls)));

    std::vector<Corners> missing = walls;
    missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(make.below(missing.size())));
    CHECK_FALSE(closed(make.scene_of(missing)));

    std::vector<Corners> turned = walls;
    Corners& around = turned[make.below(turned.size())];
    std::reverse(around.begin(), around.end());
    CHECK_FALSE(closed(make.scene_of(turned)));

    std::vector<Corners> apart = walls;
    const glm::dvec3 step = glm::normalize(glm::dvec3{make.uniform(-1, 1), make.uniform(-1, 1), make.uniform(-1, 1)}) * 1e-5;
    for (glm::dvec3& corner : apart[make.below(apart.size())]) { corner += step; }
    CHECK_FALSE(closed(make.scene_of(apart)));

    std::vector<Corners> inside_out = walls;
    for (Corners& wall : inside_out) { std::reverse(wall.begin(), wall.end()); }
    CHECK_FALSE(closed(make.scene_of(inside_out)));
  }
}

TEST_CASE("what stands in a room of polygons leaves it closed, what stands outside or passes through a wall does not") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Maker make{seed};
  for (int round = 0; round < 20; ++round) {
    INFO("round " << round);
    const std::vector<Corners> walls = make.in_pieces(make.prism(2.0), 6);
    const glm::dvec3 half{make.uniform(0.05, 0.2), make.uniform(0.05, 0.2), make.uniform(0.05, 0.4)};
    const glm::dvec3 centre{0.0, 0.0, make.uniform(0.5, 1.5)};
    const auto at = [&](const glm::dvec3& move) { return box_of_polygons(centre - half + move, centre + half + move); };
    const glm::dvec3 within{0.05, 0.05, 0.0}, into_floor{0.0, 0.0, -centre.z}, outside{10.0, 0.0, 0.0};
    CHECK(closed(make.scene_of(together(walls, at(within)))));
    CHECK_FALSE(closed(make.scene_of(together(walls, at(into_floor)))));
    CHECK_FALSE(closed(make.scene_of(together(walls, at(outside)))));
    std::vector<Corners> hollow = at(within);  // it shows its backs
    for (Corners& wall : hollow) { std::reverse(wall.begin(), wall.end()); }
    CHECK_FALSE(closed(make.scene_of(together(walls, hollow))));

    const auto solid_box = [&](const glm::dvec3& move) { return scenes::box(centre - half + move, centre + half + move); };
    const auto ball = [&](const glm::dvec3& move) { return raycast::Sphere::make(centre + move, 0.1).object; };  // its box is in the room
    const glm::dvec3 onto_floor{0.0, 0.0, half.z - centre.z};
    CHECK(closed(make.scene_of(walls, {solid_box(within)})));
    CHECK(closed(make.scene_of(walls, {solid_box(onto_floor)})));
    CHECK(closed(make.scene_of(walls, {ball({})})));
    CHECK(closed(make.scene_of(walls, {solid_box(onto_floor), ball({})})));
    CHECK_FALSE(closed(make.scene_of(walls, {solid_box(into_floor)})));
    CHECK_FALSE(closed(make.scene_of(walls, {solid_box(outside)})));
    CHECK_FALSE(closed(make.scene_of(walls, {ball(outside)})));
    CHECK_FALSE(closed(make.scene_of(walls, {ball(into_floor)})));
  }
}

TEST_CASE("a lamp that lies on the walls leaves a room of polygons closed, one that hangs free or faces the wall does not") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Maker make{seed};
  for (int round = 0; round < 20; ++round) {
    INFO("round " << round);
    const std::vector<Corners> walls = make.in_pieces(make.prism(2.0), 8);
    const double r = make.uniform(0.05, 0.2);
    const auto lamp_at = [&](double z) { return Corners{{-r, -r, z}, {-r, r, z}, {r, r, z}, {r, -r, z}}; };  // faces down
    CHECK(closed(make.scene_of(together(walls, {lamp_at(2.0)}))));
    CHECK_FALSE(closed(make.scene_of(together(walls, {lamp_at(1.9)}))));
    CHECK_FALSE(closed(make.scene_of(together(walls, {lamp_at(0.0)}))));
  }
}

TEST_CASE("furnaces of things that cross: rooms that are not proven closed, but lose no ray, glow evenly at any reflectance",
          "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Maker make{seed};
  for (int round = 0; round < 8; ++round) {
    const double rho = round % 2 == 0 ? 0.8 : 0.97;
    CAPTURE(round, rho);
    std::vector<Corners> polygons = make.in_pieces(make.prism(make.uniform(1.0, 3.0)), 3);
    const double half = make.uniform(0.1, 0.2), bottom = make.uniform(0.2, 0.4);
    // A sheet of two sides through the box, turned at random.
    const double turn = make.uniform(0.0, 3.0), width = make.uniform(0.25, 0.28);
    const glm::dvec3 along{width * std::cos(turn), width * std::sin(turn), 0.0}, up{0.0, 0.0, make.uniform(0.6, 0.9)};
    const Corners sheet{-along + glm::dvec3{0.0, 0.0, 0.1}, along + glm::dvec3{0.0, 0.0, 0.1}, along + up, -along + up};
    polygons = together(polygons, {sheet, Corners{sheet.rbegin(), sheet.rend()}});
    radiosity::Scene scene = make.scene_of(polygons, {scenes::box({-half, -half, bottom}, {half, half, make.uniform(0.5, 0.7)})});
    REQUIRE_FALSE(closed(scene));
    check_glow(furnace(std::move(scene), rho));
  }
}

// A patch is a chord of its surface. Where this runs through a curved wall, rays from what is exposed of the chord could begin outside the
// room: one of them was enough for the room to count as open.
TEST_CASE("curved things that stick out of a curved room with a sheet of two sides let no light out") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Maker make{seed};
  const Corners sheet{{-0.2, -0.2, 0.0}, {0.2, -0.2, 0.1}, {0.2, 0.2, 0.1}, {-0.2, 0.2, 0.0}};
  for (int round = 0; round < 5; ++round) {
    CAPTURE(round);
    radiosity::Scene scene = make.scene_of({sheet, Corners{sheet.rbegin(), sheet.rend()}});
    scene.objects.push_back(scenes::object("room", raycast::Sphere::make({0, 0, 0}, 1.0).object, 0, true));
    for (int k = 0; k < 2; ++k) {
      const double turn = make.uniform(0.0, 6.0), off = make.uniform(0.7, 1.0);
      const glm::dvec3 centre{off * std::cos(turn), off * std::sin(turn), make.uniform(-0.2, 0.2)};
      const glm::dvec3 axis{make.uniform(-1.0, 1.0), make.uniform(-1.0, 1.0), 1.0};
      const double size = make.uniform(0.15, 0.35);
      const auto thing = k % 2 == 0 ? raycast::Torus::make(centre, axis, size, make.uniform(0.2, 0.5) * size).object
                                    : std::shared_ptr<const raycast::Object>{raycast::Sphere::make(centre, size).object};
      scene.objects.push_back(scenes::object("thing" + std::to_string(k), thing));
    }
    const radiosity::Solution solution = furnace(std::move(scene), 0.9, 0.2);
    REQUIRE(solution.audit.stray);
    CHECK(solution.audit.stray->escaping == 0.0);
    CHECK(solution.audit.stray->to_backs == 0.0);
  }
}

TEST_CASE("furnaces within walls of two sides: the outer sides lose all their light, the rooms within glow evenly all the same") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Maker make{seed};
  for (int round = 0; round < 8; ++round) {
    const double rho = round % 2 == 0 ? 0.8 : 0.97;
    CAPTURE(round, rho);
    const std::vector<Corners> walls = make.in_pieces(make.prism(make.uniform(1.0, 3.0)), 3);
    const double half = make.uniform(0.1, 0.2);
    const auto box = scenes::box({-half, -half, round % 3 == 0 ? 0.0 : 0.2}, {half, half, make.uniform(0.5, 0.7)});
    radiosity::Scene scene = make.scene_of(walls, {box});
    const std::size_t within = add_outsides(scene, walls);
    const radiosity::Solution solution = furnace(std::move(scene), rho);
    REQUIRE(solution.audit.closure);
    double most_off = 0.0, brightest_outside = 0.0;
    for (const auto& face : solution.mesh.faces) {
      if (face.surface < within) {
        most_off = std::max(most_off, std::abs(face.radiosity.x - 1.0));
      } else {
        brightest_outside = std::max(brightest_outside, face.radiosity.x);
      }
    }
    CHECK(most_off < 1e-4);
    CHECK(brightest_outside < 0.5);
  }
}

TEST_CASE("a room with a hole in its ceiling, of a tenth of its width or more, is not taken for closed, nor one with walls of two sides") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Maker make{seed};
  for (int round = 0; round < 8; ++round) {
    const bool two_sides = round % 2 == 1;
    std::vector<Corners> walls = make.prism(make.uniform(1.0, 3.0));
    // The hole is at least a thousandth of the area: so 20 of 20 000 rays leave the room, and four or fewer with a probability of 2e-5.
    // Where the outer sides have half of the rays, 40 of 10 000 leave it.
    const double part = std::pow(10.0, make.uniform(two_sides ? -0.7 : -1.0, -0.3));
    CAPTURE(round, part);
    const Corners ceiling = walls[1];
    walls.erase(walls.begin() + 1);
    const auto inner = [&](const glm::dvec3& p) { return glm::dvec3{part * p.x, part * p.y, p.z}; };
    for (std::size_t i = 0; i < ceiling.size(); ++i) {
      const glm::dvec3 &a = ceiling[i], &b = ceiling[(i + 1) % ceiling.size()];
      walls.push_back({a, b, inner(b), inner(a)});
    }
    radiosity::Scene scene = make.scene_of(walls);
    if (two_sides) { add_outsides(scene, walls); }
    const radiosity::Solution solution = furnace(std::move(scene), 0.97);
    REQUIRE(solution.audit.stray);
    CHECK(solution.audit.stray->escaping > 0.0);
    CHECK_FALSE(solution.audit.closure);
  }
}

TEST_CASE("furnaces of polygons: B = E / (1 - rho) on every leaf, as in a solid room") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  Maker make{seed};
  for (const double rho : {0.5, 0.9, 0.99}) {
    INFO("rho " << rho);
    const std::vector<Corners> walls = make.in_pieces(make.prism(make.uniform(1.0, 3.0)), 6);
    check_glow(furnace(make.scene_of(together(walls, box_of_polygons({-0.2, -0.2, 0.3}, {0.2, 0.2, 0.6}))), rho));
  }
}
