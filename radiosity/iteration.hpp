// SPDX-License-Identifier: MIT
#pragma once

// What the iterations of solve.hpp share: one channel of the linear system, its residual, the best iterate and when to stop.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <radiosity/hierarchy.hpp>
#include <radiosity/transport.hpp>

namespace radiosity {

struct LinearSolution {
  std::vector<double> radiosity;  // of every node: leaves solved, inner nodes area averages
  double residual = 0.0;          // relative, of the radiosity returned
  std::uint32_t iterations = 0;
  bool converged = false;
  std::vector<double> history;  // the relative residual after each iteration, that of the start first
};

namespace detail {

// One channel of the problem: leaves with exposed area only.
struct Channel {
  const Hierarchy* hierarchy = nullptr;
  Transport* transport = nullptr;
  const std::vector<double>* area = nullptr;
  std::vector<double> reflectance, emission;  // one a node; leaves count

  [[nodiscard]] bool counts(std::size_t i) const { return (*hierarchy)[i].leaf() && (*area)[i] > 0.0; }

  // r = E + rho H(B) - B.
  void residual(const std::vector<double>& b, std::vector<double>& r) const {
    transport->apply(b, r);
    for (std::size_t i = 0; i < r.size(); ++i) { r[i] = counts(i) ? emission[i] + reflectance[i] * r[i] / (*area)[i] - b[i] : 0.0; }
  }

  [[nodiscard]] double norm(const std::vector<double>& r) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      if (counts(i)) { sum += (*area)[i] * r[i] * r[i]; }
    }
    return std::sqrt(sum);
  }
};

// Keeps the best iterate and tells when to stop.
struct Progress {
  Progress(double start_norm, const std::vector<double>& b) : start{start_norm}, best{b} {}

  double start = 0.0;  // norm of E
  std::vector<double> best;
  double best_norm = std::numeric_limits<double>::infinity();

  std::vector<double> history;

  void offer(const std::vector<double>& b, double norm) {
    history.push_back(start > 0.0 ? norm / start : 0.0);
    if (norm < best_norm) {
      best = b;
      best_norm = norm;
    }
  }
  [[nodiscard]] bool diverged(double norm) const { return !(norm <= 1e3 * best_norm); }
  // Below this a residual is rounding: B and H(B) are sums of some ten terms a level, each known to half an epsilon.
  [[nodiscard]] static double rounding(double norm_of_b) { return 16.0 * std::numeric_limits<double>::epsilon() * norm_of_b; }
};

inline LinearSolution finish(const Channel& channel, Progress progress, std::uint32_t iterations, double wanted) {
  LinearSolution solution;
  solution.radiosity = std::move(progress.best);
  solution.residual = progress.start > 0.0 ? progress.best_norm / progress.start : 0.0;
  solution.iterations = iterations;
  solution.converged = progress.best_norm <= std::max(wanted * progress.start, Progress::rounding(channel.norm(solution.radiosity)));
  solution.history = std::move(progress.history);
  std::vector<double>& b = solution.radiosity;
  // Where hardly any light comes an iterate may lie below 0, within its residual; no radiosity does, so 0 is nearer to the truth.
  for (double& x : b) { x = std::max(x, 0.0); }
  for (std::size_t i = b.size(); i-- > 0;) {
    const Node& node = (*channel.hierarchy)[i];
    if (node.leaf()) { continue; }
    double sum = 0.0;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { sum += (*channel.area)[c] * b[c]; }
    b[i] = (*channel.area)[i] > 0.0 ? sum / (*channel.area)[i] : 0.0;
  }
  return solution;
}

}  // namespace detail

}  // namespace radiosity
