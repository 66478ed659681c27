// SPDX-License-Identifier: MIT
// Lamp panels: with backs of their own, two polygons at one place, often in two groups of the file; or single, close under a ceiling.

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/polygon.hpp>

#include <radiosity/intake/intake.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"

using soup::Soup;

namespace {

constexpr std::uint32_t lamp = 1, back = 2;

// The sum of the vector areas of all faces of this material.
glm::dvec3 vector_area(const radiosity::Intake& intake, std::uint32_t material) {
  glm::dvec3 sum(0.0);
  for (const radiosity::SceneObject& object : intake.objects) {
    brep::Builder builder;
    object.shape->approximate(1.0, builder);
    for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
      const std::uint32_t sheet = builder.sheet(f);
      if (sheet == brep::no_sheet || object.material[sheet] != material) { continue; }
      std::vector<glm::dvec3> outline;
      for (const std::uint32_t v : builder.corners(f)) { outline.push_back(builder.position(v)); }
      sum += brep::vector_area(outline);
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("intake: lamp panels with backs of another group shine downwards alone, whatever frames meet their edges", "[accuracy]") {
  const unsigned seed = 20261129;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int round = 0; round < 60; ++round) {
    Soup soup;
    soup.materials.push_back({"back", glm::dvec3(round % 3 == 0 ? 0.0 : 0.4), glm::dvec3(0.0)});
    soup.materials[0].reflectance = glm::dvec3(round % 2 == 0 ? 0.01 : 0.8);  // a gap above the panels is dark, or not
    const glm::dvec3 room{between(4, 12), between(4, 12), between(2.5, 4)};
    const double height = room.z - between(0.1, 0.4), x_size = between(0.2, 1.0), y_size = between(0.2, 1.0);
    const int n = 1 + round % 3;
    double area = 0.0;
    Soup lamps, backs, frames;
    for (int i = 0; i < n * n; ++i) {
      const glm::dvec3 lo{(i % n + 0.3) * room.x / n, (i / n + 0.3) * room.y / n, height}, hi = lo + glm::dvec3(x_size, y_size, 0.0);
      std::vector<glm::dvec3> outline{{lo.x, lo.y, lo.z}, {lo.x, hi.y, lo.z}, {hi.x, hi.y, lo.z}, {hi.x, lo.y, lo.z}};  // looks down
      area += x_size * y_size;
      lamps.polygon(outline, lamp);
      std::reverse(outline.begin(), outline.end());
      std::rotate(outline.begin(), outline.begin() + i % 4, outline.end());
      backs.polygon(outline, back);
      const double t = 0.03, down = round % 5 == 4 ? 0.0 : between(0.05, 0.3);
      if (down == 0.0) { continue; }  // panels without frames
      soup::add_box(frames, {lo.x - t, lo.y - t, lo.z - down}, {lo.x, hi.y + t, lo.z});
      soup::add_box(frames, {hi.x, lo.y - t, lo.z - down}, {hi.x + t, hi.y + t, lo.z});
      soup::add_box(frames, {lo.x, lo.y - t, lo.z - down}, {hi.x, lo.y, lo.z});
      soup::add_box(frames, {lo.x, hi.y, lo.z - down}, {hi.x, hi.y + t, lo.z});
    }
    Soup walls;
    soup::add_box(walls, glm::dvec3(0.0), room, 1, true);
    std::vector<const Soup*> groups{&walls, &lamps, &backs, &frames};
    std::shuffle(groups.begin(), groups.end(), random);
    soup.names.clear();
    for (const Soup* group : groups) {
      soup.names.push_back(group == &walls ? "walls" : group == &lamps ? "lamp" : group == &backs ? "back" : "frame");
      for (std::size_t f = 0; f < group->count(); ++f) { soup.polygon(group->outline(f), group->material[f]); }
    }
    INFO("round " << round);
    const radiosity::Intake intake = soup.take_in();
    soup::check_sound(soup, intake);
    const glm::dvec3 shining = vector_area(intake, lamp), behind = vector_area(intake, back);
    CHECK(shining.z == Approx(-area).epsilon(1e-9));
    CHECK(behind.z == Approx(area).epsilon(1e-9));
    CHECK(soup::count_of(intake, radiosity::ChangeKind::lamp_turned) == 0);
  }
}

// Many programs let a polygon shine on both sides, so that the order of its corners was never looked at.
TEST_CASE("intake: a lamp of unknown side in a gap of a tenth of its size shines out of it, in rooms with an open side, too") {
  const unsigned seed = 20261130;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int round = 0; round < 80; ++round) {
    INFO("round " << round);
    const bool outwards = round % 2 == 1, up = round % 4 >= 2, open = round % 8 >= 4;
    const double scale = std::exp(between(-4.0, 4.0)), side = between(0.2, 1.2), gap = between(0.003, 0.09) * side;
    const glm::dvec3 room = scale * glm::dvec3{between(3, 6), between(3, 6), between(2.5, 4)};
    Soup walls, soup;
    soup::add_box(walls, glm::dvec3(0.0), room, 1, !outwards);
    for (std::size_t f = open ? 2 : 0; f < walls.count(); ++f) { soup.polygon(walls.outline(f)); }  // the first two are one side
    soup.names.push_back("lamp");
    const double x = between(0.1, 0.9) * (room.x - scale * side), y = between(0.1, 0.9) * (room.y - scale * side), z = room.z - scale * gap;
    const double to_x = x + scale * side, to_y = y + scale * side;
    std::vector<glm::dvec3> outline{{x, y, z}, {x, to_y, z}, {to_x, to_y, z}, {to_x, y, z}};  // looks down
    if (up) { std::reverse(outline.begin(), outline.end()); }
    soup.polygon(outline, lamp);
    const radiosity::Intake guess = soup.take_in({.open_sides_unknown = true});
    soup::check_sound(soup, guess);
    const double area = scale * scale * side * side;
    CHECK(vector_area(guess, lamp).z == Approx(-area).epsilon(1e-9));
    CHECK(soup::count_of(guess, radiosity::ChangeKind::lamp_turned) == (up ? 1 : 0));
    // Where the file says which side shines, only a gap from which next to nothing comes is taken for a mistake.
    if (gap < 0.025 * side) { continue; }
    CHECK(vector_area(soup.take_in(), lamp).z == Approx(up ? area : -area).epsilon(1e-9));
  }
}
