// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/iteration.hpp>
#include <radiosity/solver/solve.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/visibility/exposure.hpp>

// A made-up problem: `roots` roots with four leaves each; random links at both levels; row sums of about `row`.
struct LinearProblem {
  radiosity::Hierarchy hierarchy;
  radiosity::Links links;
  radiosity::Exposure exposure;  // areas; all centroids at the origin, so slopes play no part

  LinearProblem(std::uint32_t roots, double row, unsigned seed) {
    std::mt19937 engine{seed};
    std::uniform_real_distribution<double> uniform{0.5, 1.5};
    for (std::uint32_t r = 0; r < roots; ++r) {
      radiosity::Node node;
      node.first_child = roots + 4 * r;
      node.child_count = 4;
      node.surface = r;
      hierarchy.push_back(node);
    }
    std::vector<double>& area = exposure.area;
    area.assign(roots, 0.0);
    for (std::uint32_t i = 0; i < 4 * roots; ++i) {
      radiosity::Node node;
      node.parent = i / 4;
      node.surface = i / 4;
      hierarchy.push_back(node);
      area.push_back(uniform(engine));
      area[i / 4] += area.back();
    }
    exposure.centroid.assign(area.size(), glm::dvec3{0.0});
    const double share = row / (2.0 * roots);
    for (std::uint32_t p = 0; p < roots; ++p) {
      for (std::uint32_t q = p + 1; q < roots; ++q) {
        links.push_back({p, q, static_cast<float>(share * uniform(engine) * std::min(area[p], area[q]))});
        const std::uint32_t a = roots + 4 * p + (q % 4);
        const std::uint32_t b = roots + 4 * q + (p % 4);
        links.push_back({a, b, static_cast<float>(share * uniform(engine) * std::min(area[a], area[b]))});
      }
    }
  }

  [[nodiscard]] radiosity::LinearSolution solve(radiosity::Transport& transport, double rho, radiosity::Solver solver,
                                                double residual = 1e-12) const {
    std::vector<double> reflectance(hierarchy.size(), rho);
    std::vector<double> emission(hierarchy.size(), 0.0);
    reflectance[1] = 0.0;  // a black surface among them
    emission[0] = 1.0;
    emission[1] = 0.25;
    return radiosity::solve_channel(transport, exposure.area, reflectance, emission, {solver, residual, 100000});
  }
};
