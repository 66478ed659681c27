// SPDX-License-Identifier: MIT

// The error of leaves by the gradients of their light, from all links or from a sample of them.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/refinement/leaf_error.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "roots.hpp"
#include "scenes.hpp"
#include "seed.hpp"

TEST_CASE("the error of leaves from a sample of the links is, on average over the samples, that from all of them") {
  const auto seed = test::seed();
  CAPTURE(seed);
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> unit;
  radiosity::Scene scene;
  scene.materials = {{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}};
  scene.objects = {scenes::square("floor", {0, 0, 0}, 1.0, true), scenes::square("ceiling", {0, 0, 1}, 1.0, false)};
  const auto discrete = roots::roots_of(scene);
  discrete->expose();
  const std::vector<radiosity::Color> light(2, radiosity::Color{1.0});
  for (int run = 0; run < 4; ++run) {
    // Forty links of one pair, as of the parts of a lamp; each with the probability of being in a sample.
    radiosity::Links all;
    std::vector<double> chance;
    for (int k = 0; k < 40; ++k) {
      const glm::vec3 gradient{glm::dvec3{unit(random) - 0.3, unit(random) - 0.5, 0.0}};
      radiosity::Link link{};
      link.p = 0, link.q = 1;
      link.exchange = static_cast<float>(0.01 * unit(random));
      link.shape_p = radiosity::EndShape::of_patch(gradient);
      link.shape_q = radiosity::EndShape::of_patch(-0.5f * gradient);
      all.push_back(link);
      chance.push_back(0.1 + 0.9 * unit(random));
    }
    const double exact = radiosity::detail::estimate_leaf_errors(*discrete, all, light).sum;
    constexpr int samples = 20000;
    double sum = 0.0, square = 0.0;
    for (int s = 0; s < samples; ++s) {
      radiosity::Links links;
      std::vector<double> each;
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (!(unit(random) < chance[k])) { continue; }
        links.push_back(all[k]);
        each.push_back(1.0 / chance[k]);
      }
      const double error = radiosity::detail::estimate_leaf_errors(*discrete, links, light, each).sum;
      sum += error / samples;
      square += error * error / samples;
    }
    CAPTURE(run, exact, sum);
    CHECK(std::abs(sum - exact) < 4.5 * std::sqrt((square - sum * sum) / samples));
  }
}
