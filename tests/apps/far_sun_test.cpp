// SPDX-License-Identifier: MIT
// A sun that is a sphere far away: its distance tells nothing, as long as it looks the same.
#include "catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/camera/gather_picture.hpp>
#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/direct/direct_light.hpp>
#include <radiosity/direct/lit_region.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/scene_file.hpp"
#include "seed.hpp"

namespace {

// A block on the ground, lit by a sun that is a quarter of a degree wide.
std::string block_under_sun(const glm::dvec3& block, const glm::dvec3& to_sun, double distance, double reflectance) {
  const glm::dvec3 sun = distance * to_sun;
  std::ostringstream out;
  out.precision(17);
  out << "material ground reflectance 0.5 0.4 0.3\nmaterial white reflectance 0.7\n"
      << "material sun reflectance " << reflectance << " emission 6e7\n"
      << "polygon ground material ground vertex -20 -20 0 vertex 20 -20 0 vertex 20 20 0 vertex -20 20 0\n"
      << "box block material white from 0 0 0 to " << block.x << ' ' << block.y << ' ' << block.z << '\n'
      << "sphere sun material sun center " << sun.x << ' ' << sun.y << ' ' << sun.z << " radius " << 0.0022 * distance << '\n'
      << "camera c eye -9 -12 7 target 1 1 1 fov 60\n";
  return out.str();
}

struct Shown {
  radiosity::Picture picture;
  double top = 0.0;  // direct light on the middle of the top of the block, W/m2, first channel
  std::vector<radiosity::SurfaceMean> means;
};

Shown shown(const std::string& text, const glm::dvec3& block) {
  apps::SceneResult parsed = apps::parse_scene(text);
  REQUIRE(parsed.file);
  const radiosity::Options options{.epsilon = 0.01, .min_area = 2e-4, .audit_points = 0};
  radiosity::Outcome outcome = radiosity::solve(parsed.file->scene, options);
  REQUIRE(outcome.solution);
  const radiosity::FinalGather light{parsed.file->scene, outcome.solution->mesh, outcome.solution->frame};
  const radiosity::View view = radiosity::make_view(parsed.file->cameras.front(), {60, 45});
  const glm::dvec3 up{0, 0, 1},
      top = (glm::dvec3{0.5 * block.x, 0.5 * block.y, block.z} - outcome.solution->frame.centre) * outcome.solution->frame.scale;
  const std::array<glm::dvec3, 4> contour{top, top, top, top};
  radiosity::LitRegion region{light.direct(), {contour, 1, 0.0}, up};  // of object 1
  return {radiosity::draw(light, view, 1.0).value(), region.irradiance(top, up).x, outcome.solution->audit.surfaces};
}

}  // namespace

TEST_CASE("under a sun that looks the same the picture and all radiosities are the same, however far it is") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>{a, b}(random); };
  for (int round = 0; round < 4; ++round) {
    const glm::dvec3 block{between(1.0, 4.0), between(1.0, 4.0), between(0.5, 4.0)};
    const double height = between(0.3, 1.3), azimuth = between(0.0, 2.0 * std::numbers::pi);
    const glm::dvec3 to_sun{std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth), std::sin(height)};
    const double distance = std::pow(10.0, between(5.0, 9.0)), reflectance = round % 2 == 0 ? 0.0 : 0.8;
    CAPTURE(round, distance, reflectance, block.x, block.y, block.z, height, azimuth);
    // From the nearer one rays diverge by a thousandth over the ground.
    const Shown near = shown(block_under_sun(block, to_sun, 3e4, reflectance), block);
    const Shown far = shown(block_under_sun(block, to_sun, distance, reflectance), block);
    const double exact = 6e7 * 0.0022 * 0.0022 * to_sun.z;  // on the top of the block, which sees a disk under the half angle asin .0022
    CHECK(far.top == Approx(exact).epsilon(0.002));         // the tolerance of a body that counts as a sphere (light_vector.cpp)
    double off = 0.0, all = 0.0;
    for (std::size_t i = 0; i < near.picture.radiosity.size(); ++i) {
      const glm::dvec3 a{near.picture.radiosity[i]}, b{far.picture.radiosity[i]};
      off += glm::dot(a - b, a - b);
      all += glm::dot(a, a);
    }
    CHECK(std::sqrt(off / all) < 0.01);
    REQUIRE(near.means.size() == far.means.size());
    for (std::size_t k = 0; k < near.means.size(); ++k) {
      CAPTURE(k);
      if (near.means[k].name == "sun") { continue; }
      const glm::dvec3 a{near.means[k].radiosity}, b{far.means[k].radiosity};
      CHECK(glm::length(a - b) <= 0.05 * glm::length(a));
      // Links go to the mesh of the sun, which has 24 chords around it. By these an outline loses up to (2 pi / 24)^2 / 6 = 1.1 % of its
      // area; half of that, about the mean, is put back with the area of the sun, so what is seen from any side is right within .6 %.
      if (near.means[k].name == "block.z1") { CHECK(b.x == Approx(0.7 * exact).epsilon(0.006)); }
    }
  }
}

namespace {

// A room with furniture and a window, through which a disk shines that is half a degree wide.
std::string room_in_the_sun(const glm::dvec2& window, const glm::dvec3& to_sun, double distance) {
  const glm::dvec3 sun = glm::dvec3{2.0, 2.0, 1.5} + distance * to_sun;
  std::ostringstream out;
  out.precision(17);
  out << "material wall reflectance 0.7\nmaterial sun reflectance 0 emission 1e7\n"
      << "difference house material wall {\n box block from -0.2 -0.2 -0.2 to 4.2 4.2 3.2\n box room from 0 0 0 to 4 4 3\n"
      << " box window from " << window.x << " -1 " << window.y << " to " << window.x + 1.5 << " 0.5 " << window.y + 1.2 << "\n}\n"
      << "box chest material wall from 0.5 3 0 to 1.5 3.6 0.8\nbox table material wall from 2 2.2 0.6 to 3.5 3 0.7\n"
      << "disk sun material sun center " << sun.x << ' ' << sun.y << ' ' << sun.z << " radius " << 0.00436 * distance << " normal "
      << -to_sun.x << ' ' << -to_sun.y << ' ' << -to_sun.z << '\n';
  return out.str();
}

}  // namespace

// Errors are relative to the light on what is lit. If they were relative to the area of all, a sun would take the rays away: its area grows
// with the square of its distance.
TEST_CASE("under a sun that looks the same as many rays are stored, on leaves as fine, however far it is") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>{a, b}(random); };
  for (int round = 0; round < 6; ++round) {
    const glm::dvec2 window{between(0.3, 2.0), between(0.8, 1.5)};
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3{between(-0.5, 0.5), -1.0, between(0.3, 1.0)});
    const auto audit = [&](double distance) {
      const apps::SceneResult parsed = apps::parse_scene(room_in_the_sun(window, to_sun, distance));
      REQUIRE(parsed.file);
      const radiosity::Outcome outcome = radiosity::solve(
          parsed.file->scene, {.epsilon = 0.01, .min_area = 2e-4, .indirect = radiosity::Indirect::rays, .audit_points = 0});
      REQUIRE(outcome.solution);
      return outcome.solution->audit;
    };
    const double distance = std::pow(10.0, between(4.5, 7.0));
    const radiosity::Audit near = audit(1e3), far = audit(distance);  // from the nearer one rays diverge by a third of a degree
    CAPTURE(round, window.x, window.y, to_sun.x, to_sun.z, distance, near.leaves, far.leaves);
    const auto alike = [](std::uint64_t a, std::uint64_t b) {
      return static_cast<double>(std::max(a, b)) <= 1.3 * static_cast<double>(std::min(a, b));
    };
    CHECK(alike(near.stored_rays, far.stored_rays));
    CHECK(alike(near.leaves, far.leaves));
  }
}
