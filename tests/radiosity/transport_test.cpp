// SPDX-License-Identifier: MIT

// Laws of the transport operator: symmetry, slopes, levels, the order of the trees, and what closing a scene does.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/solver/tree_transport.hpp>
#include <radiosity/visibility/exposure.hpp>

#include "catch.hpp"
#include "radiosity/linear_problem.hpp"
#include "seed.hpp"

using radiosity::Hierarchy;
using radiosity::Links;
using radiosity::Node;
using radiosity::Solver;
using radiosity::Transport;

namespace {

// x . M y = y . M x
void check_symmetric(Transport& transport, std::size_t roots, std::size_t nodes) {
  std::mt19937 engine{17};
  INFO("seed 17");
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> x(nodes, 0.0);
    std::vector<double> y(x);
    std::vector<double> mx;
    std::vector<double> my;
    for (std::size_t i = roots; i < x.size(); ++i) {
      x[i] = normal(engine);
      y[i] = normal(engine);
    }
    transport.apply(x, mx);
    transport.apply(y, my);
    double left = 0.0;
    double right = 0.0;
    double size = 0.0;
    for (std::size_t i = roots; i < x.size(); ++i) {
      left += x[i] * my[i];
      right += y[i] * mx[i];
      size += std::abs(x[i] * my[i]);
    }
    CHECK(std::abs(left - right) <= 1e-14 * size);
  }
}

}  // namespace

TEST_CASE("transport is symmetric: x . M y = y . M x") {
  LinearProblem problem{6, 0.9, 3};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  check_symmetric(transport, 6, problem.hierarchy.size());
}

TEST_CASE("a leaf that receives more than there is gets a row sum of 1, its neighbours receive less from it, reciprocity stays") {
  LinearProblem problem{6, 0.4, 3};
  constexpr std::uint32_t sliver = 9, other = 28;
  std::vector<double>& area = problem.exposure.area;
  area[0] += 0.01 - area[sliver];
  area[sliver] = 0.01;
  problem.links.push_back({sliver, other, 0.02f});
  const auto ends_there = [](const radiosity::Link& link) { return link.p == sliver || link.q == sliver; };
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const std::vector<double> before = transport.row_sums();
  REQUIRE(before[sliver] > 2.0);
  transport.limit_row_sums(before, 1.1);
  const std::vector<double> after = transport.row_sums();
  for (std::uint32_t i = 6; i < before.size(); ++i) {
    CAPTURE(i, before[i], after[i]);
    const bool is_linked = std::any_of(problem.links.begin(), problem.links.end(),
                                       [&](const radiosity::Link& link) { return ends_there(link) && (link.p == i || link.q == i); });
    if (i == sliver) {
      CHECK(after[i] == test::Approx(1.0).epsilon(1e-12));
    } else if (is_linked) {
      CHECK(after[i] < before[i]);
    } else {
      CHECK(before[i] <= 1.1);
      CHECK(after[i] <= before[i]);
    }
  }
  check_symmetric(transport, 6, problem.hierarchy.size());
}

// Two small lamps of a cluster that face each other across a gap narrower than they are. As one leaf, the cluster receives no more than
// there is; but of what the two send to and fro, more arrives each time than was sent.
TEST_CASE("lamps of a cluster that are limited as one may have no steady state, but limited each on its own they have one") {
  LinearProblem problem{6, 0.4, 3};
  constexpr std::uint32_t one = 6, other = 7;
  problem.hierarchy[0].cluster = 0;
  std::erase_if(problem.links, [](const radiosity::Link& link) { return link.p == 0 || link.q == 0; });
  std::vector<double>& area = problem.exposure.area;
  for (const std::uint32_t small : {one, other}) {
    area[0] += 0.001 - area[small];
    area[small] = 0.001;
  }
  std::erase_if(problem.links, [](const radiosity::Link& link) { return link.p == one || link.p == other; });
  problem.links.push_back({one, other, 0.002f});
  radiosity::ClosedNodes lamps;
  lamps.lamps.assign(problem.hierarchy.size(), false);
  for (const std::uint32_t lamp : {0u, 6u, 7u, 8u, 9u}) { lamps.lamps[lamp] = true; }
  Transport transport{problem.hierarchy, problem.links, problem.exposure, 1, lamps};
  transport.limit_row_sums(transport.row_sums(), 1.1);
  CHECK(transport.row_sums()[one] > 1.9);
  CHECK_FALSE(problem.solve(transport, 0.9, Solver::conjugate_gradients).converged);
  transport.limit_row_sums(transport.row_sums(), 1.1, true);
  for (const double row : transport.row_sums()) { CHECK(row <= 1.1); }
  CHECK(problem.solve(transport, 0.9, Solver::conjugate_gradients).converged);
}

TEST_CASE("a link with gradients carries what links between its leaves carry whose kernel is linear") {
  LinearProblem coarse{2, 0.5, 5};
  for (std::uint32_t i = 2; i < 10; ++i) { coarse.exposure.centroid[i] = {0.1 * (i % 4), 0.2 * (i % 3), 0.3 * (i % 2)}; }
  for (std::uint32_t r = 0; r < 2; ++r) {
    for (std::uint32_t i = 2 + 4 * r; i < 6 + 4 * r; ++i) {
      coarse.exposure.centroid[r] += coarse.exposure.area[i] / coarse.exposure.area[r] * coarse.exposure.centroid[i];
    }
  }
  const glm::vec3 gradient_p{0.5f, -0.25f, 0.125f};
  const glm::vec3 gradient_q{-0.5f, 0.75f, 0.25f};
  coarse.links = {{0, 1, 0.3f, radiosity::EndShape::of_patch(gradient_p), radiosity::EndShape::of_patch(gradient_q)}};
  LinearProblem fine = coarse;
  fine.links.clear();
  for (std::uint32_t a = 2; a < 6; ++a) {
    for (std::uint32_t b = 6; b < 10; ++b) {
      const double kernel = 1.0 + glm::dot(glm::dvec3{gradient_p}, coarse.exposure.centroid[a] - coarse.exposure.centroid[0]) +
                            glm::dot(glm::dvec3{gradient_q}, coarse.exposure.centroid[b] - coarse.exposure.centroid[1]);
      const double share = coarse.exposure.area[a] / coarse.exposure.area[0] * coarse.exposure.area[b] / coarse.exposure.area[1];
      fine.links.push_back({a, b, static_cast<float>(0.3 * kernel * share)});
    }
  }
  std::vector<double> x(10, 0.0);
  for (std::size_t i = 2; i < 10; ++i) { x[i] = 1.0 + 0.1 * static_cast<double>(i * i); }
  std::vector<double> by_gradients;
  std::vector<double> by_leaves;
  Transport{coarse.hierarchy, coarse.links, coarse.exposure}.apply(x, by_gradients);
  Transport{fine.hierarchy, fine.links, fine.exposure}.apply(x, by_leaves);
  for (std::size_t i = 2; i < 10; ++i) { CHECK(by_gradients[i] == test::Approx(by_leaves[i]).epsilon(1e-6)); }  // exchanges are floats
}

TEST_CASE("a link between roots carries the same as its sixteen leaf links in proportion to area") {
  LinearProblem coarse{2, 0.5, 5};
  coarse.links = {{0, 1, 0.3f}};
  LinearProblem fine = coarse;
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

TEST_CASE("light that goes tree by tree is the light of the whole operator") {
  LinearProblem problem{7, 0.9, 41};
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
  LinearProblem problem{8, 1.0, 23};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const auto correction = transport.close(10.0);
  REQUIRE(correction);
  const std::vector<double> rows = transport.row_sums();
  for (std::size_t i = 8; i < rows.size(); ++i) { CHECK(std::abs(rows[i] - 1.0) < 2e-12); }
  for (const double rho : {0.5, 0.99, 0.999999}) {
    const std::vector<double> reflectance(8, rho);
    const std::vector<double> emission(8, 1.0 - rho);
    const auto solved =
        radiosity::solve_channel(transport, problem.exposure.area, reflectance, emission, {Solver::conjugate_gradients, 1e-13, 100});
    CHECK(solved.iterations <= 20);
    // The residual bounds the error by residual * |E| / (1 - rho) = residual.
    for (const double b : solved.radiosity) { CHECK(std::abs(b - 1.0) < 1e-6); }
  }
}

TEST_CASE("a correction beyond its limit is refused and changes nothing") {
  LinearProblem problem{4, 0.2, 29};
  Transport transport{problem.hierarchy, problem.links, problem.exposure};
  const std::vector<double> before = transport.row_sums();
  CHECK_FALSE(transport.close(0.1));
  CHECK(transport.row_sums() == before);
}

// Patch i and its partner see little but each other. What one row lacks and the other has too much of no scale can move but by factors far
// from 1: rows that are off by 2 % take scales that are off by more than they are.
TEST_CASE("closing is judged by what row sums were off, not by the scales that this takes") {
  const unsigned seed = test::seed();
  std::mt19937 engine{seed};
  INFO("seed " << seed);
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  for (int trial = 0; trial < 20; ++trial) {
    const std::uint32_t pairs = 4 + engine() % 8;
    const double others = 0.02 + 0.02 * std::abs(uniform(engine));  // what a patch sees beside its partner
    Hierarchy hierarchy(2 * pairs);
    radiosity::Exposure exposure;
    exposure.area.assign(hierarchy.size(), 1.0);
    exposure.centroid.assign(hierarchy.size(), glm::dvec3{0.0});
    std::vector<double> scale(hierarchy.size());  // that makes the rows wrong
    for (std::uint32_t i = 0; i < scale.size(); ++i) { scale[i] = std::exp((i % 2 == 0 ? 1.0 : -1.0) * (0.2 + 0.1 * uniform(engine))); }
    Links links;
    for (std::uint32_t p = 0; p < hierarchy.size(); ++p) {
      hierarchy[p].surface = p;
      for (std::uint32_t q = p + 1; q < hierarchy.size(); ++q) {
        const double share = p / 2 == q / 2 ? 1.0 - others : others / (2.0 * (pairs - 1));
        links.push_back({p, q, static_cast<float>(share * scale[p] * scale[q])});
      }
    }
    Transport transport{hierarchy, links, exposure};
    double square = 0.0;
    for (const double row : transport.row_sums()) { square += (row - 1.0) * (row - 1.0) / static_cast<double>(hierarchy.size()); }
    const double off = std::sqrt(square);
    CAPTURE(trial, pairs, others, off);
    CHECK(off < 0.15);
    CHECK_FALSE(transport.close(0.999 * off));
    const std::optional<double> told = transport.close(1.001 * off);
    REQUIRE(told);
    CHECK(*told == test::Approx(off));
    for (const double row : transport.row_sums()) { CHECK(std::abs(row - 1.0) < 1e-9); }
  }
}
