// SPDX-License-Identifier: MIT

// The plain program: direct light by points on lamps, further light by lists of rays.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <radiosity/run/uniform.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

using namespace radiosity;
using scenes::solved;

namespace {

UniformOptions lists_of(double max_area, std::uint32_t rays) {
  UniformOptions options;
  options.solver = UniformSolver::gather_lists;
  options.max_area = max_area;
  options.lists = {rays, rays};
  return options;
}

struct Difference {
  double l2 = 0.0, mean = 0.0;  // relative; of the light that surfaces reflect
};

// Over the leaves of one mesh that emit nothing.
Difference difference(const Solution& a, const Solution& b) {
  REQUIRE(a.radiosity.size() == b.radiosity.size());
  double square = 0.0, norm = 0.0, sum = 0.0, all = 0.0;
  for (std::size_t i = 0; i < a.radiosity.size(); ++i) {
    if (!a.hierarchy[i].leaf() || b.radiosity[i].x > 4.0) { continue; }
    const double d = a.radiosity[i].x - b.radiosity[i].x;
    square += a.area[i] * d * d;
    norm += a.area[i] * b.radiosity[i].x * b.radiosity[i].x;
    sum += a.area[i] * d;
    all += a.area[i] * b.radiosity[i].x;
  }
  return {std::sqrt(square / norm), sum / all};
}

}  // namespace

TEST_CASE("furnace: where everything shines, lists of rays give B = 1 on flat and curved things") {
  for (const auto& scene : {scenes::furnace_cube(0.9), scenes::furnace_with_things(0.5)}) {
    const Solution solution = solved(solve_uniform(scene, lists_of(0.01, 16)));
    CHECK(solution.audit.converged);
    // Every ray meets a front, so B = E + rho is B = 1 for any lists: to the residual, 1e-8, over 1 - rho.
    for (const MeshFace& face : solution.mesh.faces) { CHECK(std::abs(face.radiosity.x - 1.0) < 1e-6); }
  }
}

TEST_CASE("lists of rays are those of any number of threads, and of another seed others") {
  UniformOptions options = lists_of(0.01, 32);
  options.threads = 1;
  const Scene scene = scenes::room_with_box();
  const Solution one = solved(solve_uniform(scene, options));
  options.threads = 3;
  CHECK(solved(solve_uniform(scene, options)).radiosity == one.radiosity);
  options.seed = 2;
  CHECK(solved(solve_uniform(scene, options)).radiosity != one.radiosity);
}

TEST_CASE("lists of rays converge to the solution of the full matrix", "[accuracy]") {
  const Scene scene = scenes::room_with_box();
  UniformOptions matrix;
  matrix.max_area = 0.004;
  const Solution dense = solved(solve_uniform(scene, matrix));
  for (const std::uint32_t rays : {16u, 256u, 4096u}) {
    CAPTURE(rays);
    const Difference d = difference(solved(solve_uniform(scene, lists_of(matrix.max_area, rays))), dense);
    CAPTURE(d.l2, d.mean);
    // One ray brings light whose standard deviation is about its mean: many err by 1 / sqrt(rays) at most, even ones by less, and 600
    // leaves independently of each other. The visibility of the matrix is noisy itself, by half a per cent.
    CHECK(d.l2 < 1.0 / std::sqrt(rays) + 0.005);
    CHECK(std::abs(d.mean) < (1.0 / std::sqrt(rays) + 0.005) / 5.0);
  }
}
