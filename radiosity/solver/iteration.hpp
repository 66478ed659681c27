// SPDX-License-Identifier: MIT
#pragma once

// Common parts of the solvers of solve.hpp: one channel of the linear system, its residual, the best iterate, and the stopping rule.
//
// Residuals are reported relative to that of B = 0, which is E. An iteration stops relative to the residual of B = E, the light that is
// reflected first: if a sun lights only a small area, or surfaces are nearly black, that is a millionth of E but all that there is to find.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

struct LinearSolution {
  std::vector<double> radiosity;  // by node: solved at leaves, area averages at inner nodes
  double residual = 0.0;          // relative residual of the returned radiosity
  std::uint32_t iterations = 0;
  bool converged = false;
  std::vector<double> history;  // relative residual at the start and after each iteration
};

namespace detail {

// One channel of the problem, on the leaves with exposed area.
struct Channel {
  const Hierarchy* hierarchy = nullptr;
  Transport* transport = nullptr;
  const std::vector<double>* area = nullptr;
  std::vector<double> reflectance, emission;  // by node; only leaves count

  [[nodiscard]] bool counts(std::size_t i) const { return (*hierarchy)[i].leaf() && (*area)[i] > 0.0; }

  // r = E + rho H(B) - B.
  void residual(const std::vector<double>& b, std::vector<double>& r) const {
    transport->apply(b, r);
    for (std::size_t i = 0; i < r.size(); ++i) { r[i] = counts(i) ? emission[i] + reflectance[i] * r[i] / (*area)[i] - b[i] : 0.0; }
  }

  [[nodiscard]] double norm(const std::vector<double>& r) const;
  // Norm below which a residual of B = b is only rounding: B and H(B) are sums of some ten terms per level, each with an error of half an
  // epsilon. Surfaces that reflect nothing have no residual.
  [[nodiscard]] double rounding(const std::vector<double>& b) const;
};

// Keeps the best iterate and decides when to stop.
struct Progress {
  explicit Progress(const Channel& channel);

  double start = 0.0;      // norm of E
  double reflected = 0.0;  // norm of the residual of B = E
  std::vector<double> best;
  double best_norm = std::numeric_limits<double>::infinity();

  std::vector<double> history;

  void offer(const std::vector<double>& b, double norm);
  [[nodiscard]] bool diverged(double norm) const { return !(norm <= 1e3 * best_norm); }
};

LinearSolution finish(const Channel& channel, Progress progress, std::uint32_t iterations, double wanted);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/solver/iteration.cpp>
#endif
