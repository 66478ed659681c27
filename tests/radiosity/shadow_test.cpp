// SPDX-License-Identifier: MIT
// The exact form factor to a target behind blockers, at points where rounding decides on which side of a plane a corner lies.

#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/visibility/shadow.hpp>

#include "catch.hpp"
#include "seed.hpp"

using test::Approx;

namespace {

using Contour = std::vector<glm::dvec3>;

// A room from 0 to size with a window in the wall x = size.x, in faces that share corners: its walls, then the four around the window.
std::vector<Contour> room_with_window(const glm::dvec3& size, const glm::dvec3& lo, const glm::dvec3& hi) {
  const auto [x, y, z] = std::array{size.x, size.y, size.z};
  const Contour outer{{x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0}},
      inner{{x, lo.y, lo.z}, {x, lo.y, hi.z}, {x, hi.y, hi.z}, {x, hi.y, lo.z}};
  std::vector<Contour> faces{{{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}},
                             {{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}},
                             {{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}},
                             {{x, y, 0}, {x, y, z}, {0, y, z}, {0, y, 0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    faces.push_back({outer[i], outer[j], inner[j], inner[i]});
  }
  return faces;
}

}  // namespace

TEST_CASE("a point on a wall sees through a window what points a hair's breadth off the wall see, on whichever side rounding puts it") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 engine(seed);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution(from, to)(engine); };
  std::size_t lit = 0;
  for (int turn = 0; turn < 300; ++turn) {
    const glm::dvec3 size{uniform(0.2, 1), uniform(0.2, 1), uniform(0.2, 1)}, shift{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    std::vector<Contour> faces = room_with_window(size, {0, uniform(0.1, 0.4) * size.y, uniform(0.1, 0.4) * size.z},
                                                  {0, uniform(0.6, 0.9) * size.y, uniform(0.6, 0.9) * size.z});
    const double away = size.x + uniform(0.01, 0.5);
    Contour sky{{away, -2, -2}, {away, -2, 2}, {away, 2, 2}, {away, 2, -2}};
    for (Contour& face : faces) {
      for (glm::dvec3& p : face) { p += shift; }
    }
    for (glm::dvec3& p : sky) { p += shift; }
    std::vector<radiosity::Blocker> blockers;
    for (const Contour& face : faces) { blockers.push_back({face, glm::normalize(glm::cross(face[1] - face[0], face[2] - face[1]))}); }
    radiosity::ShadowedTarget target{sky, {-1, 0, 0}, blockers, 1e-9};
    for (int i = 0; i < 30; ++i) {
      const std::size_t w = engine() % 4;
      const glm::dvec3 &a = faces[w][0], &b = faces[w][1], &c = faces[w][3], n = blockers[w].normal;
      const glm::dvec3 x = a + uniform(0, 1) * (b - a) + uniform(0, 1) * (c - a);
      // No edge of the window is nearer than .02, so F changes by at most some 1 / .02 a unit: 1e-8 off the wall by less than 1e-6.
      const double off = target.form_factor(x + 1e-8 * n, n);
      for (const int ulps : {-2, -1, 0, 1, 2}) {
        CAPTURE(turn, i, w, ulps);
        REQUIRE(target.form_factor(x + ulps * 0x1p-54 * n, n) == Approx(off).epsilon(0).margin(1e-6));
      }
      lit += off > 1e-3;
    }
  }
  CHECK(lit > 1000);
}
