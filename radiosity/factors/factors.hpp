// SPDX-License-Identifier: MIT
#pragma once

// The matrix of form factors between the surfaces of a scene (factor_rows.hpp), occlusion included: F_ij is the fraction of the light that
// leaves i, diffuse and even, that reaches j directly.
//
//   flat faces with flat faces in between, or nothing     exact visibility, adaptive quadrature (factor_faces.hpp)
//   convex objects or a convex room, nothing in between   two meshes, extrapolated (factor_meshes.hpp)
//   anything else                                         rays on the true surfaces (factor_rays.hpp)
//
// Every factor has an error: 95 of 100 factors lie within twice that of the true value. By faces in the open and by meshes it is an
// estimate from above; behind blockers and by rays it also holds what no point and no ray has met (rule of three), so it is 0 only where
// nothing can arrive. One exchange A_i F_ij = A_j F_ji is kept for each pair; what the rays of both ends say is weighted by its variance.
// So reciprocity is exact, and how far the row sums of a closed scene are from 1 is an independent check. Areas are the exposed ones: what
// is buried under another object has no part in it. A sheet of which a union, intersection or difference leaves nothing is no surface.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factor_run.hpp>
#include <radiosity/scene/scene.hpp>

namespace radiosity {

enum class FactorMethod : std::uint8_t { faces, meshes, rays };

struct Factors {
  struct Surface {
    std::string name;
    Estimate area;  // exposed, in the squared unit of the scene
    Estimate row_sum;
    std::uint32_t material = 0;
  };
  std::vector<Surface> surfaces;
  std::vector<Estimate> factor;  // [from * surfaces.size() + to]
  std::vector<FactorMethod> method;
  std::uint64_t points = 0;  // at which faces were looked at behind others
  std::uint64_t rays = 0;
  bool converged = true;  // every error is below the wanted one

  [[nodiscard]] const Estimate& operator()(std::size_t from, std::size_t to) const { return factor[from * surfaces.size() + to]; }
};

struct FactorsResult {
  std::optional<Factors> factors;
  std::vector<std::string> faults;  // every reason why there are none
};

// The form factors of a sound scene. Refused: an unsound scene, options out of range, more than `most_surfaces` surfaces.
[[nodiscard]] FactorsResult factors(const Scene& scene, const FactorOptions& options = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factors.cpp>
#endif
