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
// nothing can arrive. One exchange A_i F_ij = A_j F_ji is
// kept for each pair; what the rays of both ends say is weighted by its variance. So reciprocity is exact, and how far the row sums of a
// closed scene are from 1 is an independent check. Areas are the exposed ones: what is buried under another object has no part in it. A sheet
// of which a union, intersection or difference leaves nothing is no surface.

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <radiosity/factor_run.hpp>
#include <radiosity/prepare.hpp>

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

// More surfaces than this are refused: the matrix would need hundreds of megabytes.
inline constexpr std::size_t most_surfaces = 2000;

// The form factors of a sound scene. Refused: an unsound scene, options out of range, more than `most_surfaces` surfaces.
[[nodiscard]] inline FactorsResult factors(const Scene& scene, const FactorOptions& options = {}) {
  if (!(options.error > 0.0)) { return {std::nullopt, {"error is " + std::to_string(options.error) + "; it must be above 0"}}; }
  PrepareResult preparation = prepare(scene);
  if (!preparation.prepared) { return {std::nullopt, std::move(preparation.faults)}; }
  const Prepared& prepared = *preparation.prepared;
  detail::FactorRun run{prepared, options, name_rows(scene), flat_faces(prepared.surfaces), {}, 0.0, {}, {}, 0};
  const auto n = static_cast<std::uint32_t>(run.rows.rows.size());
  if (n > most_surfaces) {
    return {std::nullopt, {"the scene has " + std::to_string(n) + " surfaces; the matrix is limited to " + std::to_string(most_surfaces)}};
  }
  run.slack = 1e-9;  // of a scene of size 1 to 2
  for (const FlatFace& face : run.faces) { run.blockers.push_back({face.contour, face.normal}); }
  expose(run.rows, prepared.objects, run.faces, run.slack);
  run.area.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (const Facet& facet : run.rows.rows[i].facets) { run.area[i].value += facet.area; }
  }
  run.by_faces();
  run.by_meshes();
  const std::vector<std::shared_ptr<RayCounter>> counters = run.by_rays();

  // A sheet of which nothing is left is no surface; one that is buried has area 0.
  std::vector<bool> exists(n, false);
  for (std::uint32_t o = 0; o < prepared.surfaces.size(); ++o) {
    const SurfaceBRep& brep = prepared.surfaces[o].brep;
    for (const brep::FaceId f : brep::faces(brep)) {
      if (brep.data(f).sheet != brep::no_sheet) { exists[run.rows.row_of[o][brep.data(f).sheet]] = true; }
    }
  }
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (exists[i] || run.area[i].value > 0.0) { kept.push_back(i); }
  }

  const std::size_t m = kept.size();
  Factors result;
  result.points = run.points;
  result.factor.resize(m * m);
  result.method.resize(m * m, FactorMethod::rays);
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t l = k; l < m; ++l) {
      const std::uint32_t i = kept[k];
      const std::uint32_t j = kept[l];
      const bool faces = run.known(i, j);
      const Estimate exchange = faces ? *run.exchange[std::size_t{i} * n + j] : detail::weighted(counters, run.area, i, j);
      const bool flat = run.rows.rows[i].exact && run.rows.rows[j].exact;
      for (const auto& [at, area] : {std::pair{k * m + l, run.area[i]}, std::pair{l * m + k, run.area[j]}}) {
        Estimate& factor = result.factor[at];
        if (area.value > 0.0) {
          factor.value = exchange.value / area.value;
          factor.error = std::hypot(exchange.error / area.value, factor.value * area.error / area.value);
        }
        result.converged = result.converged && factor.error <= options.error;
        if (faces) { result.method[at] = flat ? FactorMethod::faces : FactorMethod::meshes; }
      }
    }
  }
  const double unit = prepared.frame.to_scene_area(1.0);
  for (std::size_t k = 0; k < m; ++k) {
    const std::uint32_t i = kept[k];
    const FactorRow& row = run.rows.rows[i];
    Factors::Surface surface{row.name, {run.area[i].value * unit, run.area[i].error * unit}, {}, row.material};
    double square = 0.0;
    for (std::size_t l = 0; l < m; ++l) {
      const Estimate& factor = result.factor[k * m + l];
      surface.row_sum.value += factor.value;
      square += factor.error * factor.error;
    }
    surface.row_sum.error = std::sqrt(square);
    if (counters[i] != nullptr) { result.rays += counters[i]->rays(i); }
    result.surfaces.push_back(std::move(surface));
  }
  return {std::move(result), {}};
}

}  // namespace radiosity
