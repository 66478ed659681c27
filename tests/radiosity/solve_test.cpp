// SPDX-License-Identifier: MIT

// Laws of the linear system: symmetry of the transport, the limits of both solvers, what closing a scene does.

#include <atomic>
#include <cmath>
#include <random>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/iteration.hpp>
#include <radiosity/solver/solve.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/solver/tree_transport.hpp>
#include <radiosity/visibility/exposure.hpp>

#include "catch.hpp"

using radiosity::Hierarchy;
using radiosity::Links;
using radiosity::Node;
using radiosity::Solver;
using radiosity::Transport;

namespace {

// A made-up problem: `roots` roots with four leaves each; random links at both levels; row sums of about `row`.
struct Problem {
  Hierarchy hierarchy;
  Links links;
  radiosity::Exposure exposure;  // areas; all centroids at the origin, so slopes play no part

  Problem(std::uint32_t roots, double row, unsigned seed) {
    std::mt19937 engine{seed};
    std::uniform_real_distribution<double> uniform{0.5, 1.5};
    for (std::uint32_t r = 0; r < roots; ++r) {
      Node node;
      node.first_child = roots + 4 * r;
      node.child_count = 4;
      node.surface = r;
      hierarchy.push_back(node);
    }
    std::vector<double>& area = exposure.area;
    area.assign(roots, 0.0);
    for (std::uint32_t i = 0; i < 4 * roots; ++i) {
      Node node;
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

  [[nodiscard]] radiosity::LinearSolution solve(Transport& transport, double rho, Solver solver, double residual = 1e-12) const {
    std::vector<double> reflectance(hierarchy.size(), rho);
    std::vector<double> emission(hierarchy.size(), 0.0);
    reflectance[1] = 0.0;  // a black surface among them
    emission[0] = 1.0;
    emission[1] = 0.25;
    return radiosity::solve_channel(hierarchy, transport, exposure.area, reflectance, emission, solver, residual, 100000);
  }
};

}  // namespace

TEST_CASE("transport is symmetric: x . M y = y . M x") {
  Problem problem{6, 0.9, 3};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  std::mt19937 engine{17};
  INFO("seed 17");
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> x(problem.hierarchy.size(), 0.0);
    std::vector<double> y(x);
    std::vector<double> mx;
    std::vector<double> my;
    for (std::size_t i = 6; i < x.size(); ++i) {
      x[i] = normal(engine);
      y[i] = normal(engine);
    }
    transport.apply(x, mx);
    transport.apply(y, my);
    double left = 0.0;
    double right = 0.0;
    double size = 0.0;
    for (std::size_t i = 6; i < x.size(); ++i) {
      left += x[i] * my[i];
      right += y[i] * mx[i];
      size += std::abs(x[i] * my[i]);
    }
    CHECK(std::abs(left - right) <= 1e-14 * size);
  }
}

TEST_CASE("a link with slopes carries what links between its leaves carry whose kernel is linear") {
  Problem coarse{2, 0.5, 5};
  for (std::uint32_t i = 2; i < 10; ++i) { coarse.exposure.centroid[i] = {0.1 * (i % 4), 0.2 * (i % 3), 0.3 * (i % 2)}; }
  for (std::uint32_t r = 0; r < 2; ++r) {
    for (std::uint32_t i = 2 + 4 * r; i < 6 + 4 * r; ++i) {
      coarse.exposure.centroid[r] += coarse.exposure.area[i] / coarse.exposure.area[r] * coarse.exposure.centroid[i];
    }
  }
  const glm::vec3 slope_p{0.5f, -0.25f, 0.125f};
  const glm::vec3 slope_q{-0.5f, 0.75f, 0.25f};
  coarse.links = {{0, 1, 0.3f, slope_p, slope_q}};
  Problem fine = coarse;
  fine.links.clear();
  for (std::uint32_t a = 2; a < 6; ++a) {
    for (std::uint32_t b = 6; b < 10; ++b) {
      const double kernel = 1.0 + glm::dot(glm::dvec3{slope_p}, coarse.exposure.centroid[a] - coarse.exposure.centroid[0]) +
                            glm::dot(glm::dvec3{slope_q}, coarse.exposure.centroid[b] - coarse.exposure.centroid[1]);
      const double share = coarse.exposure.area[a] / coarse.exposure.area[0] * coarse.exposure.area[b] / coarse.exposure.area[1];
      fine.links.push_back({a, b, static_cast<float>(0.3 * kernel * share)});
    }
  }
  std::vector<double> x(10, 0.0);
  for (std::size_t i = 2; i < 10; ++i) { x[i] = 1.0 + 0.1 * static_cast<double>(i * i); }
  std::vector<double> by_slopes;
  std::vector<double> by_leaves;
  Transport{coarse.hierarchy, coarse.links, coarse.exposure}.apply(x, by_slopes);
  Transport{fine.hierarchy, fine.links, fine.exposure}.apply(x, by_leaves);
  for (std::size_t i = 2; i < 10; ++i) { CHECK(by_slopes[i] == test::Approx(by_leaves[i]).epsilon(1e-6)); }  // exchanges are floats
}

TEST_CASE("a link between roots carries the same as its sixteen leaf links in proportion to area") {
  Problem coarse{2, 0.5, 5};
  coarse.links = {{0, 1, 0.3f}};
  Problem fine = coarse;
  fine.links.clear();
  for (std::uint32_t a = 2; a < 6; ++a) {
    for (std::uint32_t b = 6; b < 10; ++b) {
      fine.links.push_back({a, b,
                            static_cast<float>(0.3 * coarse.exposure.area[a] / coarse.exposure.area[0] * coarse.exposure.area[b] /
                                               coarse.exposure.area[1])});
    }
  }
  const std::vector<double> rows = Transport{coarse.hierarchy, coarse.links, coarse.exposure}.row_sums();
  const std::vector<double> same = Transport{fine.hierarchy, fine.links, fine.exposure}.row_sums();
  for (std::size_t i = 2; i < rows.size(); ++i) { CHECK(rows[i] == test::Approx(same[i]).epsilon(1e-6)); }  // links are floats
}

TEST_CASE("all solvers find the same solution, and leave B = E on a black surface") {
  Problem problem{8, 0.8, 11};
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

TEST_CASE("the residual history falls by rho times the row sum with Jacobi, and by its square with Gauss-Seidel") {
  // Two surfaces that see only each other, F = 0.8 both ways: Jacobi has the spectral radius rho F, Gauss-Seidel its square.
  Problem problem{2, 0.0, 5};
  problem.exposure.area = {4.0, 4.0, 1, 1, 1, 1, 1, 1, 1, 1};
  problem.links = {{0, 1, 0.8f * 4.0f}};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const std::vector<double> reflectance{0.5, 0.5};
  const std::vector<double> emission{1.0, 0.0};
  for (const auto& [solver, factor] : {std::pair{Solver::jacobi, 0.4}, std::pair{Solver::gauss_seidel, 0.16}}) {
    const auto solved =
        radiosity::solve_channel(problem.hierarchy, transport, problem.exposure.area, reflectance, emission, solver, 1e-10, 1000);
    REQUIRE(solved.history.size() == solved.iterations + 1);
    REQUIRE(solved.history.size() > 5);
    CHECK(solved.history.back() == solved.residual);
    // From the second step on; exchanges are floats.
    for (std::size_t k = 2; k < solved.history.size(); ++k) {
      CHECK(solved.history[k] == test::Approx(factor * solved.history[k - 1]).epsilon(1e-5));
    }
  }
}

TEST_CASE("light that goes tree by tree is the light of the whole operator") {
  Problem problem{7, 0.9, 41};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  radiosity::TreeTransport trees{transport};
  REQUIRE(trees.trees() == 7);
  std::vector<double> x(problem.hierarchy.size(), 0.0);
  for (std::size_t i = 7; i < x.size(); ++i) { x[i] = 1.0 + 0.1 * static_cast<double>(i % 5); }
  std::vector<double> whole;
  transport.apply(x, whole);
  std::vector<double> gathered(x.size(), 0.0);
  std::vector<double> shot(x.size(), 0.0);
  std::vector<double> arrived(x.size(), 0.0);
  std::size_t carried = 0;
  std::vector<double> brought(7, 0.0), received(7, 0.0);
  for (std::uint32_t t = 0; t < 7; ++t) {
    trees.send(t, x);
    trees.shoot(t, [&](std::uint32_t to, double power) {
      ++carried;
      brought[to] += power;
    });
    for (std::uint32_t u = 0; u < 7; u += 2) {  // now or later: what is shot waits for those who receive it
      trees.receive(u, arrived);
      for (const std::uint32_t i : trees.nodes(u)) { shot[i] += arrived[i]; }
    }
  }
  CHECK(carried == 2 * problem.links.size());  // both ways, once
  for (std::uint32_t u = 0; u < 7; ++u) {
    trees.receive(u, arrived);
    for (const std::uint32_t i : trees.nodes(u)) { received[u] += shot[i] += arrived[i]; }
    CHECK(brought[u] == test::Approx(received[u]).epsilon(1e-14));
    trees.receive(u, arrived);
    for (const std::uint32_t i : trees.nodes(u)) { CHECK(arrived[i] == 0.0); }
  }
  for (std::uint32_t t = 0; t < 7; ++t) { trees.gather(t, gathered); }
  for (std::size_t i = 7; i < x.size(); ++i) {  // sums of some ten terms in another order
    CHECK(gathered[i] == test::Approx(whole[i]).epsilon(1e-14));
    CHECK(shot[i] == test::Approx(whole[i]).epsilon(1e-14));
  }
}

TEST_CASE("a closed scene has row sums of exactly 1, and a furnace glows evenly at any reflectance") {
  Problem problem{8, 1.0, 23};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const auto correction = transport.close(10.0);
  REQUIRE(correction);
  const std::vector<double> rows = transport.row_sums();
  for (std::size_t i = 8; i < rows.size(); ++i) { CHECK(std::abs(rows[i] - 1.0) < 2e-12); }
  for (const double rho : {0.5, 0.99, 0.999999}) {
    const std::vector<double> reflectance(8, rho);
    const std::vector<double> emission(8, 1.0 - rho);
    const auto solved = radiosity::solve_channel(problem.hierarchy, transport, problem.exposure.area, reflectance, emission,
                                                 Solver::conjugate_gradients, 1e-13, 100);
    CHECK(solved.iterations <= 20);
    // The residual bounds the error by residual * |E| / (1 - rho) = residual.
    for (const double b : solved.radiosity) { CHECK(std::abs(b - 1.0) < 1e-6); }
  }
}

TEST_CASE("conjugate gradients: at most 20 iterations for any reflectance below 1, and what is emitted is absorbed") {
  Problem problem{12, 1.0, 43};
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
      const auto solved = radiosity::solve_channel(problem.hierarchy, transport, problem.exposure.area, reflectance, emission,
                                                   Solver::conjugate_gradients, 1e-10, 100);
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
  Problem problem{12, 1.0, 47};
  std::erase_if(problem.links, [&](const radiosity::Link& link) {
    return (problem.hierarchy[link.p].surface < 6) != (problem.hierarchy[link.q].surface < 6);
  });
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  REQUIRE(transport.close(10.0));
  for (const double loss : {1e-3, 1e-6, 1e-9}) {
    std::vector<double> emission(12, 0.0);
    emission[2] = 1.0;
    emission[9] = 7.0;
    const auto solved = radiosity::solve_channel(problem.hierarchy, transport, problem.exposure.area, std::vector<double>(12, 1.0 - loss),
                                                 emission, Solver::conjugate_gradients, 1e-8, 100);
    CAPTURE(loss, solved.residual);
    CHECK(solved.converged);
    CHECK(solved.iterations <= 20);
  }
}

TEST_CASE("a solver that is stopped too early says so and keeps its best iterate") {
  Problem problem{8, 0.95, 53};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  for (const Solver solver : {Solver::conjugate_gradients, Solver::jacobi, Solver::gauss_seidel, Solver::southwell}) {
    const auto solved = radiosity::solve_channel(problem.hierarchy, transport, problem.exposure.area, std::vector<double>(8, 0.99),
                                                 {1, 0, 0, 0, 0, 0, 0, 0}, solver, 1e-12, 2);
    INFO(name(solver));
    CHECK_FALSE(solved.converged);
    CHECK(solved.residual == *std::min_element(solved.history.begin(), solved.history.end()));
  }
}

TEST_CASE("a solver that is cancelled ends within an iteration, but conjugate gradients, which are soon done, end with the solution") {
  Problem problem{8, 0.95, 53};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const std::atomic<bool> cancel{true};
  radiosity::Control control;
  control.cancel = &cancel;
  const std::vector<radiosity::Color> reflectance(8, radiosity::Color{0.9}), emission(8, radiosity::Color{1.0});
  for (const Solver solver : {Solver::conjugate_gradients, Solver::jacobi, Solver::gauss_seidel, Solver::southwell}) {
    INFO(name(solver));
    const auto solved = radiosity::solve_channel(problem.hierarchy, transport, problem.exposure.area, std::vector<double>(8, 0.9),
                                                 std::vector<double>(8, 1.0), solver, 1e-9, 1000, control);
    const auto all = radiosity::solve_channels(problem.hierarchy, transport, problem.exposure.area, reflectance, emission, 3, solver, 1e-9,
                                               1000, control);
    CHECK(solved.converged == (solver == Solver::conjugate_gradients));
    CHECK((solved.converged || solved.iterations == 0));
    CHECK(all.cancelled == !solved.converged);
  }
}

TEST_CASE("Southwell: an iteration costs what one of Gauss-Seidel does, though the surface that shoots most holds all links") {
  // Two walls that see each other, F = 0.8, and black things, each linked with the first wall.
  constexpr std::uint32_t things = 400;
  Problem problem{things + 2, 0.0, 61};
  std::vector<double>& area = problem.exposure.area;
  area[1] = area[0] = 4.0;
  for (std::uint32_t leaf = things + 2; leaf < things + 10; ++leaf) { area[leaf] = 1.0; }
  problem.links = {{0, 1, 0.8f * 4.0f}};
  for (std::uint32_t t = 2; t < things + 2; ++t) { problem.links.push_back({0, t, 1e-4f}); }
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  std::vector<double> reflectance(things + 2, 0.0), emission(things + 2, 0.0);
  reflectance[0] = reflectance[1] = 1.0;
  emission[0] = 1.0;
  const auto solved = radiosity::solve_channel(problem.hierarchy, transport, area, reflectance, emission, Solver::southwell, 1e-12, 1);
  REQUIRE(solved.history.size() == 2);
  // Gauss-Seidel goes through 5 nodes a surface and each link twice: 7 things + 12; a shot of each wall takes things + 12. So there are at
  // most 7 pairs of shots and a last one, and each shot leaves 0.8 of the light unshot; as many shots as surfaces would leave 1e-39 of it.
  CHECK(solved.history.back() >= 0.99 * std::pow(0.8, 16));
  CHECK(solved.history.back() <= 1.01 * std::pow(0.8, 2));  // and no less work than that of Gauss-Seidel
}

TEST_CASE("an iteration that diverges is stopped: rho times the row sums above 1") {
  Problem problem{8, 4.0, 59};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  for (std::size_t i = 8; i < problem.hierarchy.size(); ++i) { REQUIRE(transport.row_sums()[i] > 1.2); }
  for (const Solver solver : {Solver::conjugate_gradients, Solver::jacobi, Solver::gauss_seidel}) {
    const auto solved = radiosity::solve_channel(problem.hierarchy, transport, problem.exposure.area, std::vector<double>(8, 1.0),
                                                 {1, 0, 0, 0, 0, 0, 0, 0}, solver, 1e-8, 10000);
    INFO(name(solver));
    CHECK_FALSE(solved.converged);
    CHECK(solved.iterations < 1000);
    for (const double b : solved.radiosity) { CHECK(std::isfinite(b)); }
  }
}

TEST_CASE("a correction beyond its limit is refused and changes nothing") {
  Problem problem{4, 0.2, 29};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const std::vector<double> before = transport.row_sums();
  CHECK_FALSE(transport.close(0.1));
  CHECK(transport.row_sums() == before);
}

TEST_CASE("a scene without steady state is not reported as solved") {
  Problem problem{6, 1.0, 31};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  REQUIRE(transport.close(10.0));
  const std::vector<double> reflectance(6, 1.0);  // closed, rho = 1, light inside: B grows without end
  const std::vector<double> emission(6, 1.0);
  for (const Solver solver : {Solver::conjugate_gradients, Solver::jacobi}) {
    const auto solved =
        radiosity::solve_channel(problem.hierarchy, transport, problem.exposure.area, reflectance, emission, solver, 1e-8, 500);
    CHECK_FALSE(solved.converged);
    CHECK(solved.residual > 1e-8);
    for (const double b : solved.radiosity) { CHECK(std::isfinite(b)); }
  }
}

TEST_CASE("no light, no radiosity, no iteration") {
  Problem problem{4, 0.9, 37};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const auto solved = radiosity::solve_channel(problem.hierarchy, transport, problem.exposure.area, std::vector<double>(4, 0.5),
                                               std::vector<double>(4, 0.0), Solver::conjugate_gradients, 1e-8, 100);
  CHECK(solved.converged);
  CHECK(solved.iterations == 0);
  for (const double b : solved.radiosity) { CHECK(b == 0.0); }
}
