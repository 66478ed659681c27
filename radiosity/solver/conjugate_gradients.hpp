// SPDX-License-Identifier: MIT
#pragma once

// Conjugate gradients on the symmetric system (A / rho - M) B = A E / rho, positive definite when rho times the row sum is below 1.
//
// All eigenvalues of the preconditioned system lie near 1 but those of the constant modes, one for each room: light that is spread
// evenly over a closed room fades by 1 - rho a bounce. These modes are solved for directly and kept out of the search (deflation,
// Nicolaides 1987). Rooms do not see each other, so their constants are conjugate, and one number for each room does it all.

#include <cstdint>

#include <radiosity/solver/iteration.hpp>

namespace radiosity {

namespace detail {

// Preconditioned by the diagonal A / rho. In terms of the residual r above, the residual of the symmetric system is
// (A / rho) r, so the preconditioned residual is r itself.
LinearSolution conjugate_gradients(const Channel& channel, double wanted, std::uint32_t max_iterations);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/solver/conjugate_gradients.cpp>
#endif
