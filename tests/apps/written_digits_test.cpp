// SPDX-License-Identifier: MIT
// Coordinates are written with a number of digits. A polygon that was planar before it was written is taken, wherever it lies.
#include "catch.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "apps/scene_file.hpp"
#include "scene_texts.hpp"
#include "seed.hpp"

namespace {

std::string written(const glm::dvec3& p, const char* format) {
  std::string line = "vertex";
  for (int k = 0; k < 3; ++k) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, p[k]);
    line += " " + std::string(text.data());
  }
  return line + "\n";
}

std::string number_format(int digits, char kind) { return "%." + std::to_string(digits) + kind; }

// Corners of an ellipse in a plane of any direction: convex, planar up to rounding in double precision.
std::vector<glm::dvec3> ellipse(std::mt19937_64& random, const glm::dvec3& centre, double size) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const glm::dvec3 x = glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
  const glm::dvec3 y = glm::normalize(glm::cross(x, glm::dvec3{normal(random), normal(random), normal(random)}));
  const int corners = 4 + static_cast<int>(random() % 12);
  const double width = 0.1 + 0.9 * uniform(random), turn = uniform(random);
  std::vector<glm::dvec3> result;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * (i + turn) / corners;
    result.push_back(centre + size * (std::cos(angle) * x + width * std::sin(angle) * y));
  }
  return result;
}

std::string polygon(const std::vector<glm::dvec3>& corners, const std::string& format) {
  std::string text = "polygon p material grey {\n";
  for (const glm::dvec3& p : corners) { text += written(p, format.c_str()); }
  return text + "}\n";
}

std::string mesh(const std::vector<glm::dvec3>& corners, const std::string& format) {
  std::string text = "mesh m material grey {\n", face = "face";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    text += written(corners[i], format.c_str());
    face += " " + std::to_string(i);
  }
  return text + face + "\n}\n";
}

}  // namespace

TEST_CASE("a planar polygon is taken with the digits that it was written with, far from the origin, too") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int round = 0; round < 300; ++round) {
    const double magnitude = std::pow(10.0, 3.0 * uniform(random));
    const glm::dvec3 centre = magnitude * glm::dvec3{uniform(random), uniform(random), uniform(random)};
    const int digits = 6 + static_cast<int>(random() % 7);  // with fewer, a unit of the largest corner is too large a part of any extent
    const double unit = magnitude * std::pow(10.0, 1.0 - digits);
    // Half a unit at each corner may be 1e-4 / (2 sqrt 3) of the extent. The extent is at least 2e5 units, and a corner has no more than
    // three times the magnitude, so three times the unit: sqrt 3 times that is less than 20 of them.
    const double size = std::max(magnitude * 1e-3, 1e5 * unit) * (1.0 + std::abs(uniform(random)));
    const std::vector<glm::dvec3> corners = ellipse(random, centre, size);
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(unit))));
    for (const std::string& format : {number_format(digits, 'g'), number_format(decimals, 'f')}) {
      for (const std::string& text : {polygon(corners, format), mesh(corners, format)}) {
        INFO("round " << round << ", format " << format << '\n' << text);
        const apps::SceneResult result = apps::parse_scene(scene_texts::grey + text);
        INFO(apps::to_text(result, "test"));
        CHECK(result.file);
      }
    }
  }
}

TEST_CASE("digits excuse no fold: a corner that lies a thousandth of the extent off is refused") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 100; ++round) {
    std::vector<glm::dvec3> corners = ellipse(random, {3.0, -2.0, 7.0}, 1.0);
    const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[1]));
    corners[random() % corners.size()] += 0.01 * normal;
    const std::string format = number_format(4 + static_cast<int>(random() % 9), 'g');
    const apps::SceneResult result = apps::parse_scene(scene_texts::grey + polygon(corners, format));
    CHECK_FALSE(result.file);
  }
}
