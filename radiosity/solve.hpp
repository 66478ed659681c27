// SPDX-License-Identifier: MIT
#pragma once

// Solves B = E + rho H(B) on the leaves, each channel on its own.
//
//   conjugate_gradients  on the symmetric system (A / rho - M) B = A E / rho, which is positive definite when
//                        rho times the row sum is below 1; leaves with rho = 0 are known (B = E) and move to the
//                        right-hand side. The constant mode, which a closed scene of rho near 1 hardly damps, is solved
//                        for directly and kept out of the search (deflation, Nicolaides 1987): the number of iterations
//                        does not depend on rho.
//   jacobi               the textbook iteration B <- E + rho H(B); its error shrinks by rho each time.
//   gauss_seidel         the same, one input face after the other, with what the others have by now: about twice as fast.
//   southwell            shooting (progressive refinement, Cohen et al. 1988; Southwell relaxation, Gortler et al. 1994): the input face
//                        with the most unshot power shoots it. An iteration is as many shots as there are input faces.
//
// Residual: || E + rho H(B) - B || / || E + rho H(0) ||, area-weighted over all leaves. The iterate with the least
// residual is kept; an iteration that diverges is stopped and says so. Where rho is so near 1 that B is known to no more than the
// residual wanted, the residual ends at the rounding of B.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <radiosity/material.hpp>
#include <radiosity/options.hpp>
#include <radiosity/transport.hpp>
#include <radiosity/tree_transport.hpp>

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
  for (std::size_t i = b.size(); i-- > 0;) {
    const Node& node = (*channel.hierarchy)[i];
    if (node.leaf()) { continue; }
    double sum = 0.0;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { sum += (*channel.area)[c] * b[c]; }
    b[i] = (*channel.area)[i] > 0.0 ? sum / (*channel.area)[i] : 0.0;
  }
  return solution;
}

inline LinearSolution jacobi(const Channel& channel, double wanted, std::uint32_t max_iterations) {
  std::vector<double> b(channel.emission);
  std::vector<double> r;
  Progress progress{channel.norm(b), b};
  for (std::uint32_t iteration = 0;; ++iteration) {
    channel.residual(b, r);
    const double norm = channel.norm(r);
    progress.offer(b, norm);
    if (norm <= wanted * progress.start || progress.diverged(norm) || iteration == max_iterations) {
      return finish(channel, std::move(progress), iteration, wanted);
    }
    for (std::size_t i = 0; i < b.size(); ++i) { b[i] += r[i]; }
  }
}

inline LinearSolution gauss_seidel(const Channel& channel, double wanted, std::uint32_t max_iterations) {
  std::vector<double> b(channel.emission);
  std::vector<double> r;
  std::vector<double> arrived(b.size(), 0.0);
  TreeTransport trees{*channel.transport};
  for (std::uint32_t t = 0; t < trees.trees(); ++t) { trees.send(t, b); }
  Progress progress{channel.norm(b), b};
  for (std::uint32_t iteration = 0;; ++iteration) {
    channel.residual(b, r);
    const double norm = channel.norm(r);
    progress.offer(b, norm);
    if (norm <= wanted * progress.start || progress.diverged(norm) || iteration == max_iterations) {
      return finish(channel, std::move(progress), iteration, wanted);
    }
    for (std::uint32_t t = 0; t < trees.trees(); ++t) {
      trees.gather(t, arrived);
      for (const std::uint32_t i : trees.nodes(t)) {
        if (channel.counts(i)) { b[i] = channel.emission[i] + channel.reflectance[i] * arrived[i] / (*channel.area)[i]; }
      }
      trees.send(t, b);
    }
  }
}

// b + unshot -> solution; r = unshot is the residual of b at all times, up to rounding.
inline LinearSolution southwell(const Channel& channel, double wanted, std::uint32_t max_iterations) {
  std::vector<double> b(channel.emission.size(), 0.0);
  std::vector<double> unshot(channel.emission);
  std::vector<double> shot(b.size(), 0.0);
  std::vector<double> arrived(b.size(), 0.0);
  TreeTransport trees{*channel.transport};
  const auto power = [&](std::uint32_t t) {
    double sum = 0.0;
    for (const std::uint32_t i : trees.nodes(t)) { sum += channel.counts(i) ? (*channel.area)[i] * std::abs(unshot[i]) : 0.0; }
    return sum;
  };
  std::vector<double> powers;
  for (std::uint32_t t = 0; t < trees.trees(); ++t) { powers.push_back(power(t)); }
  Progress progress{channel.norm(unshot), b};
  for (std::uint32_t iteration = 0;; ++iteration) {
    const double norm = channel.norm(unshot);
    progress.offer(b, norm);
    if (norm <= wanted * progress.start || progress.diverged(norm) || iteration == max_iterations) {
      return finish(channel, std::move(progress), iteration, wanted);
    }
    for (std::uint32_t k = 0; k < trees.trees(); ++k) {
      const auto t = static_cast<std::uint32_t>(std::max_element(powers.begin(), powers.end()) - powers.begin());
      for (const std::uint32_t i : trees.nodes(t)) {
        if (!channel.counts(i)) { continue; }
        b[i] += unshot[i];
        shot[i] = std::exchange(unshot[i], 0.0);
      }
      trees.send(t, shot);
      trees.shoot(t, arrived);
      for (std::size_t i = 0; i < b.size(); ++i) {
        if (channel.counts(i)) { unshot[i] += channel.reflectance[i] * arrived[i] / (*channel.area)[i]; }
      }
      for (std::uint32_t u = 0; u < trees.trees(); ++u) { powers[u] = power(u); }
    }
  }
}

// Preconditioned by the diagonal A / rho. In terms of the residual r above, the residual of the symmetric system is
// (A / rho) r, so the preconditioned residual is r itself.
inline LinearSolution conjugate_gradients(const Channel& channel, double wanted, std::uint32_t max_iterations) {
  const std::size_t n = channel.emission.size();
  const std::vector<double>& area = *channel.area;
  std::vector<double> weight(n, 0.0);  // A / rho where unknown, 0 where B = E is known
  for (std::size_t i = 0; i < n; ++i) {
    if (channel.counts(i) && channel.reflectance[i] > 0.0) { weight[i] = area[i] / channel.reflectance[i]; }
  }
  const auto inner = [&](const std::vector<double>& x, const std::vector<double>& y) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) { sum += weight[i] * x[i] * y[i]; }
    return sum;
  };
  const std::vector<double> constant = [&] {
    std::vector<double> w(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) { w[i] = weight[i] > 0.0 ? 1.0 : 0.0; }
    return w;
  }();
  const auto apply = [&](const std::vector<double>& x, std::vector<double>& y) {  // y := x - rho H(x), the preconditioned system
    channel.transport->apply(x, y);
    for (std::size_t i = 0; i < n; ++i) { y[i] = weight[i] > 0.0 ? x[i] - y[i] / weight[i] : 0.0; }
  };
  std::vector<double> image_of_constant;
  apply(constant, image_of_constant);
  const double stiffness = inner(constant, image_of_constant);
  const bool deflated = stiffness > 1e-14 * inner(constant, constant);

  std::vector<double> b(channel.emission);
  std::vector<double> r;
  std::vector<double> step;
  std::vector<double> image;
  Progress progress{channel.norm(b), b};
  double square = 0.0;
  for (std::uint32_t iteration = 0;; ++iteration) {
    // The true residual is formed every 16 steps; rounding in the recurrence does not build up.
    if (iteration % 16 == 0) {
      channel.residual(b, r);
      if (deflated) {
        const double amount = inner(constant, r) / stiffness;
        for (std::size_t i = 0; i < n; ++i) {
          b[i] += amount * constant[i];
          r[i] -= amount * image_of_constant[i];
        }
      }
    }
    const double norm = channel.norm(r);
    progress.offer(b, norm);
    if (norm <= std::max(wanted * progress.start, Progress::rounding(channel.norm(b))) || progress.diverged(norm) ||
        iteration == max_iterations) {
      return finish(channel, std::move(progress), iteration, wanted);
    }
    const double next_square = inner(r, r);
    const double along = step.empty() ? 0.0 : next_square / square;
    const double amount = deflated ? inner(image_of_constant, r) / stiffness : 0.0;
    step.resize(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) { step[i] = r[i] - amount * constant[i] + along * step[i]; }
    square = next_square;
    apply(step, image);
    const double curvature = inner(step, image);
    if (!(curvature > 0.0)) {  // rho times a row sum is 1 or more: there is no steady state
      return finish(channel, std::move(progress), iteration, wanted);
    }
    const double length = square / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      b[i] += length * step[i];
      r[i] -= length * image[i];
    }
  }
}

}  // namespace detail

// `reflectance` and `emission`: one number for each input surface.
[[nodiscard]] inline LinearSolution solve_channel(const Hierarchy& hierarchy, Transport& transport, const std::vector<double>& area,
                                                  const std::vector<double>& reflectance, const std::vector<double>& emission,
                                                  Solver solver, double residual, std::uint32_t max_iterations) {
  detail::Channel channel{&hierarchy, &transport, &area, {}, {}};
  channel.reflectance.resize(hierarchy.size(), 0.0);
  channel.emission.resize(hierarchy.size(), 0.0);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!channel.counts(i)) { continue; }
    channel.reflectance[i] = reflectance[hierarchy[i].surface];
    channel.emission[i] = emission[hierarchy[i].surface];
  }
  switch (solver) {
    case Solver::jacobi:
      return detail::jacobi(channel, residual, max_iterations);
    case Solver::gauss_seidel:
      return detail::gauss_seidel(channel, residual, max_iterations);
    case Solver::southwell:
      return detail::southwell(channel, residual, max_iterations);
    case Solver::conjugate_gradients:
      break;
  }
  return detail::conjugate_gradients(channel, residual, max_iterations);
}

// All channels of a scene.
struct ColorSolution {
  std::vector<Color> radiosity;                // of every node
  double residual = 0.0;                       // the worst channel's
  std::uint32_t iterations = 0;                // the most of any channel
  bool converged = true;                       // all of them
  std::vector<std::vector<double>> histories;  // one a channel
};

// `reflectance` and `emission`: one for each input surface. With one channel the scene is grey and the others are copies.
[[nodiscard]] inline ColorSolution solve_channels(const Hierarchy& hierarchy, Transport& transport, const std::vector<double>& area,
                                                  const std::vector<Color>& reflectance, const std::vector<Color>& emission,
                                                  unsigned channels, Solver solver, double residual, std::uint32_t max_iterations) {
  ColorSolution solution;
  solution.radiosity.assign(hierarchy.size(), Color{0.0});
  for (int c = 0; c < static_cast<int>(channels); ++c) {
    std::vector<double> rho;
    std::vector<double> e;
    for (const Color& r : reflectance) { rho.push_back(r[c]); }
    for (const Color& b : emission) { e.push_back(b[c]); }
    LinearSolution solved = solve_channel(hierarchy, transport, area, rho, e, solver, residual, max_iterations);
    solution.residual = std::max(solution.residual, solved.residual);
    solution.iterations = std::max(solution.iterations, solved.iterations);
    solution.converged = solution.converged && solved.converged;
    solution.histories.push_back(std::move(solved.history));
    for (std::size_t i = 0; i < hierarchy.size(); ++i) {
      for (int to = c; to < (channels == 1 ? 3 : c + 1); ++to) { solution.radiosity[i][to] = solved.radiosity[i]; }
    }
  }
  return solution;
}

}  // namespace radiosity
