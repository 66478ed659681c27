// SPDX-License-Identifier: MIT
#pragma once

// Form factors between curved objects with nothing in between: the exchanges of three meshes of each object, extrapolated to the smooth
// surface.
//
// The error of a mesh is proportional to h^2, h its chord length, so the change from one mesh to a finer one predicts the remaining error
// (Richardson 1911): F = F_2 + (F_2 - F_1) / (r - 1), r the ratio of the chord errors. Each end of a pair has its own ratio and correction;
// what refining both ends changes beyond the sum of the two is corrected, too. The stated error is the sum of
//   - the difference to the extrapolation from the two coarser meshes, which is larger than the error of the finer one;
//   - the correction for both ends together;
//   - half of the correction if a curved object is seen from outside, because its outline lies differently between the edges of each mesh.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <raycast/transform.hpp>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/hierarchy/patch.hpp>

namespace radiosity {

// Three meshes of a row, the finest one last. A flat row with straight borders has only that one, which is exact.
struct RowMeshes {
  std::vector<Patch> level[3];
  double ratio[2] = {1.0, 1.0};  // chord errors of level 0 to 1 and of 1 to 2; 1: there is only level 2
  bool outline = false;          // is it curved and seen from outside?
  double reach = 0.0;            // largest distance of the surface from the finest mesh
  Estimate area;

  [[nodiscard]] bool curved() const { return ratio[1] > 1.0; }
};

namespace detail {

// The amount to add to the finer value to extrapolate to h = 0.
[[nodiscard]] inline double correction(double coarse, double fine, double ratio) {
  return ratio > 1.0 ? (fine - coarse) / (ratio - 1.0) : 0.0;
}
// The correction of the finest of three values; its error is the difference to the extrapolation of the middle one.
[[nodiscard]] inline Estimate extrapolated(double coarsest, double coarse, double fine, const double (&ratio)[2]) {
  const double last = correction(coarse, fine, ratio[1]);
  return {last, std::abs(fine + last - coarse - correction(coarsest, coarse, ratio[0]))};
}

struct ObjectMesh {
  std::vector<std::vector<Patch>> patches;  // by sheet
  std::vector<double> reach;                // by sheet: largest distance of a face's centre from the surface
  double chord_error = 0.0;                 // mean distance of the face centres from the surface
  std::size_t faces = 0, most_corners = 0;
};

[[nodiscard]] ObjectMesh mesh_of(const raycast::PlacedObject& object, double tolerance);

}  // namespace detail

// The meshes of the rows of one curved object: the middle one has some hundred faces, the others about four times fewer and more.
void make_meshes(const raycast::PlacedObject& object, std::span<const std::uint32_t> row_of_sheet, std::vector<RowMeshes>& rows);

// The exchange of two rows with nothing in between. For rows of one object both meshes are refined together.
[[nodiscard]] Estimate free_exchange(const RowMeshes& p, const RowMeshes& q, bool same_object);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factor_meshes.cpp>
#endif
