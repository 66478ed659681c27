// SPDX-License-Identifier: MIT

// Radiosity is linear in the emission, at every size that a double holds (light_unit.hpp).

#include <cmath>
#include <limits>
#include <random>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/run/uniform.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

using radiosity::Color;
using radiosity::Scene;
using radiosity::Solution;
using scenes::solved;

namespace {

radiosity::Options few_links() { return {.epsilon = 0.1, .audit_points = 40, .threads = 1}; }

// The emission of a light room is 5; a power of two away it stays a normal number, and so does all that it lights.
Scene times(Scene scene, int exponent) {
  for (radiosity::Material& m : scene.materials) {
    for (int c = 0; c < 3; ++c) { m.emission[c] = std::ldexp(m.emission[c], exponent); }
  }
  return scene;
}

// Nodes, corners and means that are not exactly 2^exponent times those of `one`, and figures of the audit that differ at all.
std::size_t other_bits(const Solution& scaled, const Solution& one, int exponent) {
  REQUIRE(scaled.radiosity.size() == one.radiosity.size());
  REQUIRE(scaled.mesh.corners.size() == one.mesh.corners.size());
  REQUIRE(scaled.audit.surfaces.size() == one.audit.surfaces.size());
  std::size_t count = 0;
  const auto compare = [&](const Color& a, const Color& b) {
    for (int c = 0; c < 3; ++c) { count += a[c] == std::ldexp(b[c], exponent) ? 0 : 1; }
  };
  for (std::size_t i = 0; i < one.radiosity.size(); ++i) { compare(scaled.radiosity[i], one.radiosity[i]); }
  for (std::size_t i = 0; i < one.mesh.corners.size(); ++i) { compare(scaled.mesh.corners[i].radiosity, one.mesh.corners[i].radiosity); }
  for (std::size_t i = 0; i < one.mesh.faces.size(); ++i) { compare(scaled.mesh.faces[i].radiosity, one.mesh.faces[i].radiosity); }
  for (std::size_t i = 0; i < one.audit.surfaces.size(); ++i) {
    compare(scaled.audit.surfaces[i].radiosity, one.audit.surfaces[i].radiosity);
  }
  count += scaled.audit.residual == one.audit.residual ? 0 : 1;
  count += scaled.audit.iterations == one.audit.iterations ? 0 : 1;
  count += scaled.audit.energy_balance == one.audit.energy_balance ? 0 : 1;
  count += scaled.audit.estimated_error == one.audit.estimated_error ? 0 : 1;
  count += scaled.audit.leaf_error.has_value() == one.audit.leaf_error.has_value() ? 0 : 1;
  if (scaled.audit.leaf_error && one.audit.leaf_error) {
    count += scaled.audit.leaf_error->relative_l2 == one.audit.leaf_error->relative_l2 ? 0 : 1;
  }
  return count;
}

}  // namespace

TEST_CASE("emission times 2^k, k from -1000 to 1000: the same bits times 2^k, and the same figures") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> exponents(-1000, 1000);
  const Scene scene = scenes::room_with_box();
  radiosity::Options bf = few_links();
  bf.refinement = radiosity::Refinement::a_posteriori;
  bf.target = 0.2;
  for (const radiosity::Options& options : {few_links(), bf}) {
    const Solution one = solved(scene, options);
    REQUIRE(one.audit.leaf_error);
    for (const int k : {-1000, exponents(random), -531, exponents(random), 1000}) {
      INFO("2^" << k);
      CHECK(other_bits(solved(times(scene, k), options), one, k) == 0);
    }
  }
  radiosity::UniformOptions uniform;
  uniform.solver = radiosity::UniformSolver::gauss_seidel;
  uniform.max_area = 0.02;
  const Solution one = solved(radiosity::solve_uniform(scene, uniform));
  for (const int k : {-1000, exponents(random), 1000}) {
    INFO("2^" << k << ", full matrix");
    CHECK(other_bits(solved(radiosity::solve_uniform(times(scene, k), uniform)), one, k) == 0);
  }
}

TEST_CASE("a channel that is faint beside the others has the same relative bits, with every solver") {
  Scene scene = scenes::room_with_box();
  Scene faint = scene;
  const int k = -700;  // its squares vanish
  for (radiosity::Material& m : faint.materials) { m.emission.z = std::ldexp(m.emission.z, k); }
  for (const auto solver :
       {radiosity::Solver::conjugate_gradients, radiosity::Solver::jacobi, radiosity::Solver::gauss_seidel, radiosity::Solver::southwell}) {
    radiosity::Options options = few_links();
    options.audit_points = 0;
    options.solver = solver;
    const Solution grey = solved(scene, options);
    const Solution coloured = solved(faint, options);
    REQUIRE(grey.radiosity.size() == coloured.radiosity.size());
    std::size_t other = 0;
    for (std::size_t i = 0; i < grey.radiosity.size(); ++i) {
      other += coloured.radiosity[i].x == grey.radiosity[i].x ? 0 : 1;
      other += coloured.radiosity[i].z == std::ldexp(grey.radiosity[i].z, k) ? 0 : 1;
    }
    INFO("solver " << name(solver));
    CHECK(other == 0);
  }
}

TEST_CASE("light beyond the largest number is refused, not infinite, the largest emission without it is solved") {
  Scene scene = scenes::room_with_box();
  for (radiosity::Material& m : scene.materials) { m.emission *= 3e307; }
  const Solution strong = solved(scene, few_links());
  for (const Color& b : strong.radiosity) { CHECK((std::isfinite(b.x) && b.x >= 0.0)); }
  const double most = std::numeric_limits<double>::max();
  for (radiosity::Material& m : scene.materials) { m = {m.name, Color{0.9}, m.emission.x > 0.0 ? Color{most} : Color{0.0}}; }
  const radiosity::Outcome refused = radiosity::solve(scene, few_links());
  REQUIRE_FALSE(refused.solution);
  CHECK(refused.failure.sentences.at(0).find("stronger than a number can hold") != std::string::npos);
}
