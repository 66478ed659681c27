// SPDX-License-Identifier: MIT
#pragma once

// The matrix of form factors between the surfaces of a scene (factor_rows.hpp), occlusion included: F_ij is the fraction of the light
// leaving i (diffuse, constant over i) that reaches j directly.
//
//   flat faces, with flat faces or nothing in between     exact visibility, adaptive quadrature (factor_faces.hpp)
//   convex objects or a convex room, nothing in between   meshes, extrapolated (factor_meshes.hpp)
//   anything else                                         rays on the true surfaces (factor_rays.hpp)
//
// Every factor has an error: 95 of 100 factors lie within twice that of the true value. By unoccluded faces and by meshes it is an upper
// estimate. Behind blockers and by rays it also includes what no point and no ray has met (rule of three), so it is 0 only if nothing can
// arrive. One exchange A_i F_ij = A_j F_ji is kept for each pair; the rays of both ends are combined, weighted by their variances. So
// reciprocity is exact, and the deviation of the row sums of a closed scene from 1 is an independent check. Areas are exposed areas:
// parts buried under another object do not count. A sheet of which a union, intersection or difference leaves nothing has no row.

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
    Estimate area;  // exposed area, in squared units of the scene
    Estimate row_sum;
    std::uint32_t material = 0;
  };
  std::vector<Surface> surfaces;
  std::vector<Estimate> factor;  // [from * surfaces.size() + to]
  std::vector<FactorMethod> method;
  std::uint64_t points = 0;  // number of points at which faces with blockers were evaluated
  std::uint64_t rays = 0;
  bool converged = true;  // is every error at most the wanted one?

  [[nodiscard]] const Estimate& operator()(std::size_t from, std::size_t to) const { return factor[from * surfaces.size() + to]; }
};

struct FactorsResult {
  std::optional<Factors> factors;
  std::vector<std::string> faults;  // the reasons, if `factors` is empty
};

// The form factors of a valid scene. Refused: an invalid scene, options out of range, more than `most_surfaces` surfaces.
[[nodiscard]] FactorsResult factors(const Scene& scene, const FactorOptions& options = {});

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factors.cpp>
#endif
