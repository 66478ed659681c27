// SPDX-License-Identifier: MIT
#include <radiosity/solver/solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/conjugate_gradients.hpp>
#include <radiosity/solver/iteration.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/solver/tree_transport.hpp>
#include <radiosity/support/greatest.hpp>

namespace radiosity {

namespace detail {

// Calls step(b, r), which improves the solution b using its residual r, until one of the limits is reached.
template <class Step>
[[nodiscard]] LinearSolution iterate(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control,
                                     const Step& step) {
  std::vector<double> b(channel.emission);
  std::vector<double> r;
  Progress progress{channel};
  for (std::uint32_t iteration = 0;; ++iteration) {
    channel.residual(b, r);
    const double norm = channel.norm(r);
    progress.offer(b, norm);
    if (norm <= std::max(wanted * progress.reflected, channel.rounding(b)) || progress.diverged(norm) || iteration == max_iterations ||
        control.cancelled()) {
      return finish(channel, std::move(progress), iteration, wanted);
    }
    step(b, r);
  }
}

HALFLIGHT_INLINE LinearSolution jacobi(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control) {
  return iterate(channel, wanted, max_iterations, control, [](std::vector<double>& b, const std::vector<double>& r) {
    for (std::size_t i = 0; i < b.size(); ++i) { b[i] += r[i]; }
  });
}

HALFLIGHT_INLINE LinearSolution gauss_seidel(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control) {
  std::vector<double> arrived(channel.emission.size(), 0.0);
  TreeTransport trees{*channel.transport};
  for (std::uint32_t t = 0; t < trees.trees(); ++t) { trees.send(t, channel.emission); }
  return iterate(channel, wanted, max_iterations, control, [&](std::vector<double>& b, const std::vector<double>&) {
    for (std::uint32_t t = 0; t < trees.trees(); ++t) {
      trees.gather(t, arrived);
      for (const std::uint32_t i : trees.nodes(t)) {
        if (channel.counts(i)) { b[i] = channel.emission[i] + channel.reflectance[i] * arrived[i] / (*channel.area)[i]; }
      }
      trees.send(t, b);
    }
  });
}

HALFLIGHT_INLINE LinearSolution southwell(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control) {
  std::vector<double> b(channel.emission.size(), 0.0);
  std::vector<double> unshot(channel.emission);
  std::vector<double> shot(b.size(), 0.0);
  std::vector<double> arrived(b.size(), 0.0);
  TreeTransport trees{*channel.transport};
  Greatest gain{std::vector<double>(trees.trees(), 0.0)};
  std::vector<double> reflectance(trees.trees(), 0.0);
  std::size_t step = 0;  // the work of one Gauss-Seidel iteration
  for (std::uint32_t t = 0; t < trees.trees(); ++t) {
    step += trees.work(t);
    for (const std::uint32_t i : trees.nodes(t)) { reflectance[t] = std::max(reflectance[t], channel.reflectance[i]); }
  }
  const auto receive = [&](std::uint32_t t) {
    trees.receive(t, arrived);
    double sum = 0.0;
    for (const std::uint32_t i : trees.nodes(t)) {
      if (!channel.counts(i)) { continue; }
      unshot[i] += channel.reflectance[i] * arrived[i] / (*channel.area)[i];
      sum += (*channel.area)[i] * std::abs(unshot[i]);
    }
    gain.set(t, sum / static_cast<double>(trees.work(t)));
  };
  std::vector<double> more(trees.trees(), 0.0);  // power that one shot brings to each tree
  std::vector<std::uint32_t> reached;
  Progress progress{channel};
  for (std::uint32_t iteration = 0;; ++iteration) {
    for (std::uint32_t t = 0; t < trees.trees(); ++t) { receive(t); }
    const double norm = channel.norm(unshot);
    progress.offer(b, norm);
    if (norm <= std::max(wanted * progress.reflected, channel.rounding(b)) || progress.diverged(norm) || iteration == max_iterations ||
        control.cancelled()) {
      return finish(channel, std::move(progress), iteration, wanted);
    }
    for (std::size_t work = 0; work < step && !control.cancelled();) {
      const std::uint32_t t = gain.index();
      receive(t);
      for (const std::uint32_t i : trees.nodes(t)) {
        if (!channel.counts(i)) { continue; }
        b[i] += unshot[i];
        shot[i] = std::exchange(unshot[i], 0.0);
      }
      gain.set(t, 0.0);
      trees.send(t, shot);
      trees.shoot(t, [&](std::uint32_t to, double arrives) {
        const double share = reflectance[to] * std::abs(arrives);
        if (!(share > 0.0)) { return; }
        if (more[to] == 0.0) { reached.push_back(to); }
        more[to] += share;
      });
      for (const std::uint32_t to : reached) {
        gain.set(to, gain[to] + std::exchange(more[to], 0.0) / static_cast<double>(trees.work(to)));
      }
      reached.clear();
      work += trees.work(t);
    }
  }
}

}  // namespace detail

HALFLIGHT_INLINE LinearSolution solve_channel(Transport& transport, const std::vector<double>& area, const std::vector<double>& reflectance,
                                              const std::vector<double>& emission, const SolveBy& by, const Control& control) {
  const Hierarchy& hierarchy = transport.hierarchy();
  const double strongest = emission.empty() ? 0.0 : *std::max_element(emission.begin(), emission.end());
  const int unit = strongest > 0.0 ? std::ilogb(strongest) : 0;
  detail::Channel channel{&hierarchy, &transport, &area, {}, {}};
  channel.reflectance.resize(hierarchy.size(), 0.0);
  channel.emission.resize(hierarchy.size(), 0.0);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!channel.counts(i)) { continue; }
    channel.reflectance[i] = reflectance[hierarchy[i].surface];
    channel.emission[i] = std::ldexp(emission[hierarchy[i].surface], -unit);
  }
  const auto solve = [&] {
    switch (by.solver) {
      case Solver::jacobi:
        return detail::jacobi(channel, by.residual, by.max_iterations, control);
      case Solver::gauss_seidel:
        return detail::gauss_seidel(channel, by.residual, by.max_iterations, control);
      case Solver::southwell:
        return detail::southwell(channel, by.residual, by.max_iterations, control);
      case Solver::conjugate_gradients:
        break;
    }
    return detail::conjugate_gradients(channel, by.residual, by.max_iterations);
  };
  LinearSolution solution = solve();
  for (double& b : solution.radiosity) { b = std::ldexp(b, unit); }
  return solution;
}

HALFLIGHT_INLINE ColorSolution solve_channels(Transport& transport, const std::vector<double>& area, const SurfaceLight& surfaces,
                                              const SolveBy& by, const Control& control) {
  ColorSolution solution;
  solution.radiosity.assign(transport.hierarchy().size(), Color{0.0});
  for (int c = 0; c < static_cast<int>(surfaces.channels); ++c) {
    std::vector<double> rho;
    std::vector<double> e;
    for (const Color& r : surfaces.reflectance) { rho.push_back(r[c]); }
    for (const Color& b : surfaces.emission) { e.push_back(b[c]); }
    LinearSolution solved = solve_channel(transport, area, rho, e, by, control);
    if (!solved.converged && by.solver != Solver::conjugate_gradients && control.cancelled()) {
      solution.cancelled = true;
      return solution;
    }
    solution.residual = std::max(solution.residual, solved.residual);
    solution.iterations = std::max(solution.iterations, solved.iterations);
    solution.converged = solution.converged && solved.converged;
    solution.histories.push_back(std::move(solved.history));
    for (std::size_t i = 0; i < transport.hierarchy().size(); ++i) {
      for (int to = c; to < (surfaces.channels == 1 ? 3 : c + 1); ++to) { solution.radiosity[i][to] = solved.radiosity[i]; }
    }
  }
  return solution;
}

}  // namespace radiosity
