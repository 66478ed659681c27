// SPDX-License-Identifier: MIT
#include <radiosity/factors/factors.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factor_rays.hpp>
#include <radiosity/factors/factor_rows.hpp>
#include <radiosity/factors/factor_run.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/prepare.hpp>

namespace radiosity {

// More surfaces than this are refused: the matrix would need hundreds of megabytes.
inline constexpr std::size_t most_surfaces = 2000;

namespace detail {

// The rows of the result. A sheet of which nothing is left after cutting has no row; a buried sheet has a row with area 0.
HALFLIGHT_INLINE std::vector<std::uint32_t> kept_rows(const FactorRun& run) {
  std::vector<bool> exists(run.area.size(), false);
  for (std::uint32_t o = 0; o < run.prepared.surfaces.size(); ++o) {
    const SurfaceBRep& brep = run.prepared.surfaces[o].brep;
    for (const brep::FaceId f : brep::faces(brep)) {
      if (brep.data(f).sheet != brep::no_sheet) { exists[run.rows.row_of[o][brep.data(f).sheet]] = true; }
    }
  }
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < run.area.size(); ++i) {
    if (exists[i] || run.area[i].value > 0.0) { kept.push_back(i); }
  }
  return kept;
}

// Writes both factors of each pair of kept rows from their common exchange.
HALFLIGHT_INLINE void write_factors(const FactorRun& run, const std::vector<std::shared_ptr<RayCounter>>& counters,
                                    const std::vector<std::uint32_t>& kept, Factors& result) {
  const std::size_t m = kept.size();
  result.factor.resize(m * m);
  result.method.resize(m * m, FactorMethod::rays);
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t l = k; l < m; ++l) {
      const std::uint32_t i = kept[k];
      const std::uint32_t j = kept[l];
      const bool faces = run.known(i, j);
      const Estimate exchange = faces ? *run.exchange[i * run.area.size() + j] : weighted(counters, run.area, i, j);
      const bool flat = run.rows.rows[i].exact && run.rows.rows[j].exact;
      for (const auto& [at, area] : {std::pair{k * m + l, run.area[i]}, std::pair{l * m + k, run.area[j]}}) {
        Estimate& factor = result.factor[at];
        if (area.value > 0.0) {
          factor.value = exchange.value / area.value;
          factor.error = std::hypot(exchange.error / area.value, factor.value * area.error / area.value);
        }
        result.converged = result.converged && factor.error <= run.options.error;
        if (faces) { result.method[at] = flat ? FactorMethod::faces : FactorMethod::meshes; }
      }
    }
  }
}

// Writes names, areas and row sums of the kept rows; the factors must be known.
HALFLIGHT_INLINE void write_surfaces(const FactorRun& run, const std::vector<std::uint32_t>& kept, Factors& result) {
  const double unit = run.prepared.frame.to_scene_area(1.0);
  const std::size_t m = kept.size();
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
    result.surfaces.push_back(std::move(surface));
  }
}

}  // namespace detail

HALFLIGHT_INLINE FactorsResult factors(const Scene& scene, const FactorOptions& options) {
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

  const std::vector<std::uint32_t> kept = detail::kept_rows(run);
  Factors result;
  result.points = run.points;
  for (const std::uint32_t i : kept) {
    if (counters[i] != nullptr) { result.rays += counters[i]->rays(i); }
  }
  detail::write_factors(run, counters, kept, result);
  detail::write_surfaces(run, kept, result);
  return {std::move(result), {}};
}

}  // namespace radiosity
