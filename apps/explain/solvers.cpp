// SPDX-License-Identifier: MIT
#include "apps/explain/recording.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <radiosity/scene/options.hpp>
#include <radiosity/solver/iteration.hpp>
#include <radiosity/solver/solve.hpp>
#include <radiosity/solver/tree_transport.hpp>

#include "apps/text.hpp"

namespace apps::explain {
namespace {

// Shooting in which a face sends `factor` times its unshot light (over-relaxation of Southwell's method, Gortler et al. 1994): it sends
// later light in advance, and any excess remains as negative unshot light. The system is symmetric and positive definite, so it converges
// for any factor below 2.
Method overshoot(const System& system, const radiosity::detail::Channel& channel, double factor) {
  radiosity::TreeTransport trees{system.transport};
  Method method{"over-shooting by " + formatted("%g", factor), {}, {}};
  const std::size_t size = system.area.size();
  std::vector<double> b(size, 0.0), unshot(channel.emission), shot(size, 0.0), arrived(size, 0.0), r, gain(trees.trees(), 0.0);
  std::size_t pass = 0;
  for (std::uint32_t t = 0; t < trees.trees(); ++t) { pass += trees.work(t); }
  const auto each_leaf = [&](std::uint32_t t, const auto& visit) {
    for (const std::uint32_t i : trees.nodes(t)) {
      if (channel.counts(i)) { visit(i); }
    }
  };
  const auto receive = [&](std::uint32_t t) {
    trees.receive(t, arrived);
    gain[t] = 0.0;
    each_leaf(t, [&](std::uint32_t i) {
      unshot[i] += channel.reflectance[i] * arrived[i] / system.area[i];
      gain[t] += system.area[i] * std::abs(unshot[i]) / static_cast<double>(trees.work(t));
    });
  };
  for (unsigned n = 0; n <= most_passes; ++n) {
    for (std::uint32_t t = 0; t < trees.trees(); ++t) { receive(t); }
    channel.residual(b, r);
    method.residual.push_back(channel.norm(r) / channel.norm(channel.emission));
    method.radiosity.push_back(b);
    for (std::size_t work = 0; work < pass;) {
      const auto best = static_cast<std::uint32_t>(std::max_element(gain.begin(), gain.end()) - gain.begin());
      each_leaf(best, [&](std::uint32_t i) {
        shot[i] = factor * unshot[i];
        b[i] += shot[i];
        unshot[i] -= shot[i];
      });
      trees.send(best, shot);
      trees.shoot(best, [](std::uint32_t, double) {});
      for (std::uint32_t t = 0; t < trees.trees(); ++t) { receive(t); }
      work += trees.work(best);
    }
  }
  return method;
}

}  // namespace

Comparison compare_solvers(const System& system, bool keep) {
  using radiosity::Solver;
  Comparison comparison;
  for (const double rho : system.reflectance) { comparison.reflectance = std::max(comparison.reflectance, rho); }
  const auto solve = [&](Solver solver, unsigned passes, double residual) {
    return radiosity::solve_channel(system.transport, system.area, system.reflectance, system.emission, {solver, residual, passes});
  };
  comparison.solution = solve(Solver::conjugate_gradients, 1000, 1e-10).radiosity;
  for (const auto& [solver, label] : {std::pair{Solver::jacobi, "Jacobi"},
                                      {Solver::gauss_seidel, "Gauss-Seidel"},
                                      {Solver::southwell, "Southwell (shooting)"},
                                      {Solver::conjugate_gradients, "conjugate gradients"}}) {
    Method method{label, solve(solver, most_passes, 1e-10).history, {}};
    for (unsigned n = 0; keep && n < method.residual.size(); ++n) { method.radiosity.push_back(solve(solver, n, 1e-10).radiosity); }
    comparison.methods.push_back(std::move(method));
  }
  const radiosity::Hierarchy& nodes = system.transport.hierarchy();
  radiosity::detail::Channel channel{&nodes, &system.transport, &system.area, {}, {}};
  channel.reflectance.resize(nodes.size(), 0.0);
  channel.emission.resize(nodes.size(), 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!channel.counts(i)) { continue; }
    channel.reflectance[i] = system.reflectance[nodes[i].surface];
    channel.emission[i] = system.emission[nodes[i].surface];
  }
  for (const double factor : {1.4, 1.8}) {
    comparison.methods.push_back(overshoot(system, channel, factor));
    if (!keep) { comparison.methods.back().radiosity.clear(); }
  }
  return comparison;
}

}  // namespace apps::explain
