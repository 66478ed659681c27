// SPDX-License-Identifier: MIT
#pragma once

// Form factors of curved objects that see each other freely: the exchanges of three meshes of each, extrapolated to the smooth surface.
//
// The error of a mesh is h^2, h its chord length, so what a finer mesh changes tells what the finest would change (Richardson 1911):
// F = F_2 + (F_2 - F_1) / (r - 1), r the ratio of the chord errors. Each end of a pair has its own ratio and its own correction, and what
// both together change beyond that is taken, too. The stated error is the sum of
//   - what the extrapolation from the two coarser meshes says otherwise; whatever the order of the error, that of the finer is smaller;
//   - what the ends change together;
//   - half of the correction, where a curved object is seen from outside: its outline falls between the edges of each mesh otherwise.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <raycast/transform.hpp>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/hierarchy/patch.hpp>

namespace radiosity {

// Three meshes of a row, the finest one last; of a flat row with straight borders that one alone, which is exact.
struct RowMeshes {
  std::vector<Patch> level[3];
  double ratio[2] = {1.0, 1.0};  // of the chord errors of level 0 and 1, 1 and 2; 1: there is only level 2
  bool outline = false;          // curved and seen from outside
  double reach = 0.0;            // distance of the surface from the finest mesh
  Estimate area;

  [[nodiscard]] bool curved() const { return ratio[1] > 1.0; }
};

namespace detail {

// What is to be added to the finer value for that at h = 0.
[[nodiscard]] inline double correction(double coarse, double fine, double ratio) {
  return ratio > 1.0 ? (fine - coarse) / (ratio - 1.0) : 0.0;
}
// The correction to the finest of three values, and by how much that to the middle one leads elsewhere.
[[nodiscard]] inline Estimate extrapolated(double coarsest, double coarse, double fine, const double (&ratio)[2]) {
  const double last = correction(coarse, fine, ratio[1]);
  return {last, std::abs(fine + last - coarse - correction(coarsest, coarse, ratio[0]))};
}

struct ObjectMesh {
  std::vector<std::vector<Patch>> patches;  // by sheet
  std::vector<double> reach;                // by sheet: greatest distance of the middle of a face from the surface
  double chord_error = 0.0;                 // mean over the vertices' faces of the distance of their middles from the surface
  std::size_t faces = 0, most_corners = 0;
};

[[nodiscard]] ObjectMesh mesh_of(const raycast::PlacedObject& object, double tolerance);

}  // namespace detail

// The meshes of the rows of one curved object: the middle one of some hundred faces, the others of four times fewer and more.
void make_meshes(const raycast::PlacedObject& object, std::span<const std::uint32_t> row_of_sheet, std::vector<RowMeshes>& rows);

// The exchange of two rows between which nothing stands. Of rows of one object both meshes are refined together.
[[nodiscard]] Estimate free_exchange(const RowMeshes& p, const RowMeshes& q, bool same_object);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factor_meshes.cpp>
#endif
