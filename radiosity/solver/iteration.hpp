// SPDX-License-Identifier: MIT
#pragma once

// What the iterations of solve.hpp share: one channel of the linear system, its residual, the best iterate and when to stop.
//
// Residuals are told relative to that of B = 0, which is E. An iteration ends by that of B = E, the light that is reflected first: where
// a sun shines on little, or surfaces are nearly black, it is a millionth of E, and all that is to be found.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/solver/transport.hpp>

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

  [[nodiscard]] double norm(const std::vector<double>& r) const;
  // Below this the norm of a residual of B = b is rounding: B and H(B) are sums of some ten terms a level, each known to half an epsilon.
  // What reflects nothing has no residual.
  [[nodiscard]] double rounding(const std::vector<double>& b) const;
};

// Keeps the best iterate and tells when to stop.
struct Progress {
  explicit Progress(const Channel& channel);

  double start = 0.0;      // norm of E
  double reflected = 0.0;  // of the residual of B = E
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
