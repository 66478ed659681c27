// SPDX-License-Identifier: MIT
#pragma once

// Total exchange factors of grey diffuse surfaces, reflections included (Hottel's script F: Hottel and Sarofim, Radiative Transfer, 1967;
// Gebhart's factor is their quotient by the emissivity of the receiver). What i absorbs of the black-body emission of j is
// A_j script-F_ji = A_i script-F_ij, so two surfaces exchange A_i script-F_ij (sigma T_i^4 - sigma T_j^4).
//
// With exchanges G_ij = A_i F_ij, emissivities e and reflectances r = 1 - e:   A script-F = e K e,  K = G + G sqrt(r) T^-1 sqrt(r) G,
// T = A - sqrt(r) G sqrt(r). T is symmetric, and positive definite if every reflection loses some light; with its Cholesky factor L,
// K = G + W' W, W = L^-1 sqrt(r) G. So reciprocity is exact and no factor is negative, as for the form factors themselves.
// Laws: e = 1 gives F; in a closed scene row i sums to e_i.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factors.hpp>

namespace radiosity {

struct TotalExchange {
  std::vector<Estimate> factor;   // [from * n + to], same surfaces as the form factors
  std::vector<Estimate> row_sum;  // in a closed scene, the emissivity
};
struct TotalExchangeResult {
  std::optional<TotalExchange> exchange;
  std::string refusal;
};

// Computed from form factors and an emissivity in [0, 1] for each surface. The errors are those of the form factors, propagated to first
// order: d(A script-F) = e P dG P' e with P = 1 + K r / A. Cost: n^3, five matrices. Refused: too few emissivities or values out of
// range; a scene in which light is never absorbed.
[[nodiscard]] TotalExchangeResult total_exchange(const Factors& factors, std::span<const double> emissivity);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/total_exchange.cpp>
#endif
