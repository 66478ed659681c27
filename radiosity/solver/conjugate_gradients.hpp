// SPDX-License-Identifier: MIT
#pragma once

// Conjugate gradients on the symmetric system (A / rho - M) B = A E / rho, positive definite when rho times the row sum is below 1.
//
// All eigenvalues of the preconditioned system are near 1, except those of the constant modes, one for each room: light that is constant
// over a closed room decays only by 1 - rho per bounce. These modes are solved directly and removed from the search (deflation,
// Nicolaides 1987). Rooms do not see each other, so their constants are conjugate, and one scalar per room suffices.

#include <cstdint>

#include <radiosity/solver/iteration.hpp>

namespace radiosity {

namespace detail {

// Preconditioned by the diagonal A / rho. With the residual r of iteration.hpp, the residual of the symmetric system is
// (A / rho) r, so the preconditioned residual is r itself.
LinearSolution conjugate_gradients(const Channel& channel, double wanted, std::uint32_t max_iterations);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/solver/conjugate_gradients.cpp>
#endif
