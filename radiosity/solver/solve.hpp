// SPDX-License-Identifier: MIT
#pragma once

// Solves B = E + rho H(B) on the leaves, each channel on its own.
//
//   conjugate_gradients  on the symmetric system (A / rho - M) B = A E / rho, which is positive definite when
//                        rho times the row sum is below 1; leaves with rho = 0 are known (B = E) and move to the
//                        right-hand side. The constant mode of each room, which rho near 1 hardly damps, is solved for
//                        directly and kept out of the search (deflation, Nicolaides 1987): the number of iterations
//                        does not depend on rho.
//   jacobi               the textbook iteration B <- E + rho H(B); its error shrinks by rho each time.
//   gauss_seidel         the same, one input face after the other, with what the others have by now: about twice as fast.
//   southwell            shooting (progressive refinement, Cohen et al. 1988; Southwell relaxation, Gortler et al. 1994): the input face
//                        with the most unshot power, for what its shot costs, shoots it. Where surfaces differ much in their links those
//                        with the most power alone would do all the work. An iteration costs what one of Gauss-Seidel does.
//
// Residual: || E + rho H(B) - B || / || E ||, area-weighted over all leaves. An iteration ends when it is `wanted` times that of B = E,
// which is the light that is reflected first. The iterate with the least residual is kept; an iteration that diverges is stopped and says
// so. Where rho is so near 1 that B is known to no more than the residual wanted, the residual ends at the rounding of B.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/iteration.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

namespace detail {

LinearSolution jacobi(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control);

LinearSolution gauss_seidel(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control);

// b + unshot -> solution; r = unshot, once all trees have received what was shot at them, is the residual of b, up to rounding. Between two
// iterations the power of a tree is known as a bound: what it had, and the size of all that was shot at it since. `gain` is that for each
// node and link of its shot.
LinearSolution southwell(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control);

}  // namespace detail

// How a system is solved, and how far.
struct SolveBy {
  Solver solver = Solver::conjugate_gradients;
  double residual = 1e-8;  // wanted, relative to that of B = E
  std::uint32_t max_iterations = 1000;
};

// `area`: exposed, of each node. `reflectance` and `emission`: one number for each input surface. Solved in a unit of light of its own, a
// power of two: the squares of a channel that is faint beside the others would vanish. `control` interrupts all solvers but conjugate
// gradients, which need few iterations: what is left is the best iterate, not converged.
[[nodiscard]] LinearSolution solve_channel(Transport& transport, const std::vector<double>& area, const std::vector<double>& reflectance,
                                           const std::vector<double>& emission, const SolveBy& by, const Control& control = {});

// All channels of a scene.
struct ColorSolution {
  std::vector<Color> radiosity;                // of every node
  double residual = 0.0;                       // the worst channel's
  std::uint32_t iterations = 0;                // the most of any channel
  bool converged = true;                       // all of them
  bool cancelled = false;                      // before they had: this is no solution
  std::vector<std::vector<double>> histories;  // one a channel
};

// What the input surfaces do with light. With one channel the scene is grey and the others are copies.
struct SurfaceLight {
  const std::vector<Color>& reflectance;
  const std::vector<Color>& emission;
  unsigned channels = 3;
};

[[nodiscard]] ColorSolution solve_channels(Transport& transport, const std::vector<double>& area, const SurfaceLight& surfaces,
                                           const SolveBy& by, const Control& control = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/solver/solve.cpp>
#endif
