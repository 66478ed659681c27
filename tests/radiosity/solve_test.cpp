// SPDX-License-Identifier: MIT

// Laws of the solvers: the same solution from all, their rates, their limits.

#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/iteration.hpp>
#include <radiosity/solver/solve.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/solver/tree_transport.hpp>
#include <radiosity/visibility/exposure.hpp>

#include "catch.hpp"
#include "radiosity/linear_problem.hpp"

using radiosity::Hierarchy;
using radiosity::Node;
using radiosity::Solver;
using radiosity::Transport;

TEST_CASE("all solvers find the same solution, and leave B = E on a black surface") {
  LinearProblem problem{8, 0.8, 11};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  for (const double rho : {0.1, 0.5, 0.9}) {
    const auto cg = problem.solve(transport, rho, Solver::conjugate_gradients);
    REQUIRE(cg.converged);
    for (const Solver solver : {Solver::jacobi, Solver::gauss_seidel, Solver::southwell}) {
      INFO(name(solver));
      const auto other = problem.solve(transport, rho, solver);
      REQUIRE(other.converged);
      CHECK(cg.iterations <= other.iterations);
      for (std::size_t i = 0; i < cg.radiosity.size(); ++i) {
        CHECK(cg.radiosity[i] == test::Approx(other.radiosity[i]).epsilon(1e-9).margin(1e-12));
      }
      CHECK(other.radiosity[1] == 0.25);
    }
  }
}

TEST_CASE("reflected light is solved to the same digits, however little of the emission it is") {
  LinearProblem problem{8, 0.8, 12};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  std::vector<double> emission(8, 0.0), arrived;
  emission[3] = 1.0;
  std::vector<double> sent(problem.hierarchy.size(), 0.0);
  for (std::size_t i = 0; i < sent.size(); ++i) { sent[i] = problem.hierarchy[i].leaf() ? emission[problem.hierarchy[i].surface] : 0.0; }
  transport.apply(sent, arrived);
  for (const double rho : {1e-4, 1e-8, 1e-12, 1e-16, 1e-30}) {
    std::vector<double> reflectance(8, rho);
    reflectance[3] = 0.0;  // or its own emission would round what it reflects
    for (const Solver solver : {Solver::conjugate_gradients, Solver::jacobi, Solver::gauss_seidel, Solver::southwell}) {
      CAPTURE(rho, name(solver));
      const auto solved = radiosity::solve_channel(transport, problem.exposure.area, reflectance, emission, {solver, 1e-10, 100});
      CHECK(solved.converged);
      CHECK(solved.iterations <= 4);
      for (std::size_t i = 8; i < sent.size(); ++i) {
        if (problem.hierarchy[i].surface == 3) { continue; }
        // The second reflection is rho times the first, or less.
        CHECK(solved.radiosity[i] == test::Approx(rho * arrived[i] / problem.exposure.area[i]).epsilon(2.0 * rho + 1e-9));
      }
    }
  }
}

TEST_CASE("the residual history falls by rho times the row sum with Jacobi, and by its square with Gauss-Seidel") {
  // Two surfaces that see only each other, F = 0.8 both ways: Jacobi has the spectral radius rho F, Gauss-Seidel its square.
  LinearProblem problem{2, 0.0, 5};
  problem.exposure.area = {4.0, 4.0, 1, 1, 1, 1, 1, 1, 1, 1};
  problem.links = {{0, 1, 0.8f * 4.0f}};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const std::vector<double> reflectance{0.5, 0.5};
  const std::vector<double> emission{1.0, 0.0};
  for (const auto& [solver, factor] : {std::pair{Solver::jacobi, 0.4}, std::pair{Solver::gauss_seidel, 0.16}}) {
    const auto solved = radiosity::solve_channel(transport, problem.exposure.area, reflectance, emission, {solver, 1e-10, 1000});
    REQUIRE(solved.history.size() == solved.iterations + 1);
    REQUIRE(solved.history.size() > 5);
    CHECK(solved.history.back() == solved.residual);
    // From the second step on; exchanges are floats.
    for (std::size_t k = 2; k < solved.history.size(); ++k) {
      CHECK(solved.history[k] == test::Approx(factor * solved.history[k - 1]).epsilon(1e-5));
    }
  }
}

TEST_CASE("conjugate gradients: at most 20 iterations for any reflectance below 1, and what is emitted is absorbed") {
  LinearProblem problem{12, 1.0, 43};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  REQUIRE(transport.close(10.0));
  for (const double loss : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9}) {
    for (const bool even : {true, false}) {
      CAPTURE(loss, even);
      std::vector<double> reflectance(12, 1.0 - loss);
      if (!even) {  // a dark surface and a black one among bright ones
        reflectance[3] = 0.3;
        reflectance[7] = 0.0;
      }
      std::vector<double> emission(12, 0.0);
      emission[2] = 5.0;
      const auto solved =
          radiosity::solve_channel(transport, problem.exposure.area, reflectance, emission, {Solver::conjugate_gradients, 1e-10, 100});
      CHECK(solved.converged);
      CHECK(solved.iterations <= 20);
      double emitted = 0.0;
      double absorbed = 0.0;
      double largest = 0.0;
      for (std::size_t i = 12; i < problem.hierarchy.size(); ++i) {
        const std::uint32_t s = problem.hierarchy[i].surface;
        const double area = problem.exposure.area[i];
        emitted += area * emission[s];
        // Absorbed is (1 - rho) H; of a surface of rho > 0, H = (B - E) / rho.
        if (reflectance[s] > 0.0) { absorbed += area * (1.0 - reflectance[s]) * (solved.radiosity[i] - emission[s]) / reflectance[s]; }
        largest = std::max(largest, solved.radiosity[i]);
      }
      if (even) {
        // The residual bounds the error of B by 1e-10 E / loss, rounding by some 1e-15 B / loss; the balance multiplies by the loss.
        CHECK(absorbed == test::Approx(emitted).epsilon(1e-8 + 1e-14 * largest));
      }
    }
  }
}

TEST_CASE("conjugate gradients: two closed rooms that do not see each other have two stiff modes and still take few iterations") {
  LinearProblem problem{12, 1.0, 47};
  std::erase_if(problem.links, [&](const radiosity::Link& link) {
    return (problem.hierarchy[link.p].surface < 6) != (problem.hierarchy[link.q].surface < 6);
  });
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  REQUIRE(transport.close(10.0));
  for (const double loss : {1e-3, 1e-6, 1e-9}) {
    std::vector<double> emission(12, 0.0);
    emission[2] = 1.0;
    emission[9] = 7.0;
    const auto solved = radiosity::solve_channel(transport, problem.exposure.area, std::vector<double>(12, 1.0 - loss), emission,
                                                 {Solver::conjugate_gradients, 1e-8, 100});
    CAPTURE(loss, solved.residual);
    CHECK(solved.converged);
    CHECK(solved.iterations <= 20);
  }
}

TEST_CASE("a solver that is stopped too early says so and keeps its best iterate") {
  LinearProblem problem{8, 0.95, 53};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  for (const Solver solver : {Solver::conjugate_gradients, Solver::jacobi, Solver::gauss_seidel, Solver::southwell}) {
    const auto solved = radiosity::solve_channel(transport, problem.exposure.area, std::vector<double>(8, 0.99), {1, 0, 0, 0, 0, 0, 0, 0},
                                                 {solver, 1e-12, 2});
    INFO(name(solver));
    CHECK_FALSE(solved.converged);
    CHECK(solved.residual == *std::min_element(solved.history.begin(), solved.history.end()));
  }
}

TEST_CASE("a solver that is cancelled ends within an iteration, but conjugate gradients, which are soon done, end with the solution") {
  LinearProblem problem{8, 0.95, 53};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const std::atomic<bool> cancel{true};
  radiosity::Control control;
  control.cancel = &cancel;
  const std::vector<radiosity::Color> reflectance(8, radiosity::Color{0.9}), emission(8, radiosity::Color{1.0});
  for (const Solver solver : {Solver::conjugate_gradients, Solver::jacobi, Solver::gauss_seidel, Solver::southwell}) {
    INFO(name(solver));
    const auto solved = radiosity::solve_channel(transport, problem.exposure.area, std::vector<double>(8, 0.9), std::vector<double>(8, 1.0),
                                                 {solver, 1e-9, 1000}, control);
    const auto all = radiosity::solve_channels(transport, problem.exposure.area, {reflectance, emission, 3}, {solver, 1e-9, 1000}, control);
    CHECK(solved.converged == (solver == Solver::conjugate_gradients));
    CHECK((solved.converged || solved.iterations == 0));
    CHECK(all.cancelled == !solved.converged);
  }
}

TEST_CASE("Southwell: an iteration costs what one of Gauss-Seidel does, though the surface that shoots most holds all links") {
  // Two walls that see each other, F = 0.8, and black things, each linked with the first wall.
  constexpr std::uint32_t things = 400;
  LinearProblem problem{things + 2, 0.0, 61};
  std::vector<double>& area = problem.exposure.area;
  area[1] = area[0] = 4.0;
  for (std::uint32_t leaf = things + 2; leaf < things + 10; ++leaf) { area[leaf] = 1.0; }
  problem.links = {{0, 1, 0.8f * 4.0f}};
  for (std::uint32_t t = 2; t < things + 2; ++t) { problem.links.push_back({0, t, 1e-4f}); }
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  std::vector<double> reflectance(things + 2, 0.0), emission(things + 2, 0.0);
  reflectance[0] = reflectance[1] = 1.0;
  emission[0] = 1.0;
  const auto solved = radiosity::solve_channel(transport, area, reflectance, emission, {Solver::southwell, 1e-12, 1});
  REQUIRE(solved.history.size() == 2);
  // Gauss-Seidel goes through 5 nodes a surface and each link twice: 7 things + 12; a shot of each wall takes things + 12. So there are at
  // most 7 pairs of shots and a last one, and each shot leaves 0.8 of the light unshot; as many shots as surfaces would leave 1e-39 of it.
  CHECK(solved.history.back() >= 0.99 * std::pow(0.8, 16));
  CHECK(solved.history.back() <= 1.01 * std::pow(0.8, 2));  // and no less work than that of Gauss-Seidel
}

TEST_CASE("an iteration that diverges is stopped: rho times the row sums above 1") {
  LinearProblem problem{8, 4.0, 59};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  for (std::size_t i = 8; i < problem.hierarchy.size(); ++i) { REQUIRE(transport.row_sums()[i] > 1.2); }
  for (const Solver solver : {Solver::conjugate_gradients, Solver::jacobi, Solver::gauss_seidel}) {
    const auto solved = radiosity::solve_channel(transport, problem.exposure.area, std::vector<double>(8, 1.0), {1, 0, 0, 0, 0, 0, 0, 0},
                                                 {solver, 1e-8, 10000});
    INFO(name(solver));
    CHECK_FALSE(solved.converged);
    CHECK(solved.iterations < 1000);
    for (const double b : solved.radiosity) { CHECK(std::isfinite(b)); }
  }
}

TEST_CASE("a scene without steady state is not reported as solved") {
  LinearProblem problem{6, 1.0, 31};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  REQUIRE(transport.close(10.0));
  const std::vector<double> reflectance(6, 1.0);  // closed, rho = 1, light inside: B grows without end
  const std::vector<double> emission(6, 1.0);
  for (const Solver solver : {Solver::conjugate_gradients, Solver::jacobi}) {
    const auto solved = radiosity::solve_channel(transport, problem.exposure.area, reflectance, emission, {solver, 1e-8, 500});
    CHECK_FALSE(solved.converged);
    CHECK(solved.residual > 1e-8);
    for (const double b : solved.radiosity) { CHECK(std::isfinite(b)); }
  }
}

TEST_CASE("no light, no radiosity, no iteration") {
  LinearProblem problem{4, 0.9, 37};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const auto solved = radiosity::solve_channel(transport, problem.exposure.area, std::vector<double>(4, 0.5), std::vector<double>(4, 0.0),
                                               {Solver::conjugate_gradients, 1e-8, 100});
  CHECK(solved.converged);
  CHECK(solved.iterations == 0);
  for (const double b : solved.radiosity) { CHECK(b == 0.0); }
}
