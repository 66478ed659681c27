// SPDX-License-Identifier: MIT
#pragma once

// Solves B = E + rho H(B) on the leaves, each channel separately.
//
//   conjugate_gradients  on the symmetric system (A / rho - M) B = A E / rho, which is positive definite if rho times the row sum is
//                        below 1; leaves with rho = 0 are known (B = E) and move to the right-hand side. The constant mode of each room,
//                        which hardly decays if rho is near 1, is solved directly and removed from the search (deflation, Nicolaides
//                        1987), so the number of iterations does not depend on rho.
//   jacobi               the textbook iteration B <- E + rho H(B); its error shrinks by rho each time.
//   gauss_seidel         one input face after the other, using the updated values of the others: about twice as fast.
//   southwell            shooting (progressive refinement, Cohen et al. 1988; Southwell relaxation, Gortler et al. 1994): the input face
//                        with the largest unshot power relative to the cost of its shot shoots it. By power alone, where numbers of
//                        links differ much, the costly faces would do all the work. One iteration costs as much as one of Gauss-Seidel.
//
// Residual: || E + rho H(B) - B || / || E ||, area-weighted over all leaves. Stops when it is `wanted` times that of B = E, the light
// that is reflected first. The iterate with the smallest residual is kept; divergence is detected and reported. If rho is so near 1 that
// rounding of B exceeds the wanted residual, the iteration stops at that rounding.

#include <cstdint>
#include <vector>

#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/solver/iteration.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

namespace detail {

LinearSolution jacobi(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control);

LinearSolution gauss_seidel(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control);

// b + unshot converges to the solution; r = unshot, once all trees have received what was shot at them, is the residual of b, up to
// rounding. Between two iterations only a bound of a tree's power is known: its previous power plus what has been shot at it since.
// `gain`: that bound divided by the number of nodes and links of its shot.
LinearSolution southwell(const Channel& channel, double wanted, std::uint32_t max_iterations, const Control& control);

}  // namespace detail

// The solver and its stopping criteria.
struct SolveBy {
  Solver solver = Solver::conjugate_gradients;
  double residual = 1e-8;  // wanted residual, relative to that of B = E
  std::uint32_t max_iterations = 1000;
};

// `area`: exposed, by node. `reflectance` and `emission`: by input surface. Computes in a unit of light of its own, a power of two,
// because the squares of a channel that is faint beside the others would underflow. `control` interrupts all solvers except conjugate
// gradients, which need few iterations; the result is then the best iterate, not converged.
[[nodiscard]] LinearSolution solve_channel(Transport& transport, const std::vector<double>& area, const std::vector<double>& reflectance,
                                           const std::vector<double>& emission, const SolveBy& by, const Control& control = {});

// All channels of a scene.
struct ColorSolution {
  std::vector<Color> radiosity;                // by node
  double residual = 0.0;                       // largest of the channels
  std::uint32_t iterations = 0;                // largest of the channels
  bool converged = true;                       // did all channels converge?
  bool cancelled = false;                      // cancelled before convergence: not a solution
  std::vector<std::vector<double>> histories;  // by channel
};

// What the input surfaces do with light. With channels == 1 the scene is grey and the other channels are copies.
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
