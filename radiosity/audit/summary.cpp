// SPDX-License-Identifier: MIT
#include <radiosity/audit/summary.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <brep/inline.hpp>
#include <brep/proportion.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/links/saving.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/plan.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

HALFLIGHT_INLINE void balance_energy(Audit& audit, const DiscreteScene& scene, Transport& transport, const std::vector<Color>& radiosity) {
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = transport.area();
  const std::vector<double> rows = transport.row_sums();
  double emitted = 0.0;
  double absorbed = 0.0;
  double escaped = 0.0;
  for (int c = 0; c < 3; ++c) {
    std::vector<double> channel;
    std::vector<double> arrived;
    for (const Color& b : radiosity) { channel.push_back(b[c]); }
    transport.apply(channel, arrived);
    for (std::size_t i = 0; i < hierarchy.size(); ++i) {
      if (!hierarchy[i].leaf() || !(area[i] > 0.0)) { continue; }
      emitted += area[i] * scene.emission[hierarchy[i].surface][c];
      absorbed += (1.0 - scene.reflectance[hierarchy[i].surface][c]) * arrived[i];
      escaped += area[i] * radiosity[i][c] * (1.0 - rows[i]);
    }
  }
  if (emitted > 0.0) {
    audit.energy_balance = std::abs(emitted - absorbed - escaped) / emitted;
    audit.escaped = escaped / emitted;
  }
}

HALFLIGHT_INLINE Audit::Range summarise_rows(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<double>& rows) {
  Audit::Range range{std::numeric_limits<double>::infinity(), 0.0, 0.0};
  double total = 0.0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf() || !(area[i] > 0.0)) { continue; }
    range.min = std::min(range.min, rows[i]);
    range.max = std::max(range.max, rows[i]);
    range.mean += area[i] * rows[i];
    total += area[i];
  }
  return total > 0.0 ? Audit::Range{range.min, range.mean / total, range.max} : Audit::Range{};
}

HALFLIGHT_INLINE double overfull_share(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<double>& rows) {
  double total = 0.0, overfull = 0.0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf()) { continue; }
    total += area[i];
    overfull += rows[i] > most_row_sum ? area[i] : 0.0;
  }
  return total > 0.0 ? overfull / total : 0.0;
}

HALFLIGHT_INLINE Audit::Range summarise_proportions(const Hierarchy& hierarchy, const Patches& patches) {
  Audit::Range range{1.0, 0.0, 0.0};
  double count = 0.0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf()) { continue; }
    const Polygon& contour = patches[i].contour;
    const double best = std::cos(std::numbers::pi / static_cast<double>(contour.size()));  // of the regular polygon
    const double proportion = brep::proportion(contour) / best;
    range.min = std::min(range.min, proportion);
    range.max = std::max(range.max, proportion);
    range.mean += proportion;
    count += 1.0;
  }
  range.mean = count > 0.0 ? range.mean / count : 0.0;
  return range;
}

HALFLIGHT_INLINE void summarise_surfaces(Audit& audit, const DiscreteScene& scene, const std::vector<Color>& radiosity) {
  const std::vector<InputSurface>& inputs = scene.inputs;
  const Hierarchy& hierarchy = scene.hierarchy;
  const std::vector<double>& area = scene.exposure.area;
  for (const InputSurface& input : inputs) { audit.surfaces.push_back({input.name, 0.0, Color{0.0}}); }
  std::vector<bool> exists(inputs.size(), false);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf()) { continue; }
    exists[hierarchy[i].surface] = true;
    SurfaceMean& mean = audit.surfaces[hierarchy[i].surface];
    mean.area += area[i];
    mean.radiosity += area[i] * radiosity[i];
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (exists[i]) { std::swap(audit.surfaces[kept++], audit.surfaces[i]); }
  }
  audit.surfaces.resize(kept, SurfaceMean{});
  for (SurfaceMean& mean : audit.surfaces) {
    if (mean.area > 0.0) { mean.radiosity /= mean.area; }
    mean.area = scene.frame.to_scene_area(mean.area);
  }
}

HALFLIGHT_INLINE void report_left_out(Audit& audit, const DiscreteScene& scene, const RefineResult& refined,
                                      const EvaluateResult& evaluated, const Options& options, const LinkCost& cost) {
  const Plan& plan = scene.plan;
  const Exposure& exposure = scene.exposure;
  audit.left_out = plan.left_out;
  const auto add = [&](std::string what, std::string why, std::string saved, double seconds = 0.0) {
    audit.left_out.push_back({std::move(what), std::move(why), std::move(saved), seconds});
  };
  const auto times = [](std::uint64_t count, double each) { return static_cast<double>(count) * each; };
  if (!plan.lit || !plan.reflects) { return; }
  if (evaluated.proven_clear > 0) {
    add("visibility of " + std::to_string(evaluated.proven_clear) + " links", "no object can stand between the patches",
        std::to_string(evaluated.rays.avoided) + " rays", times(evaluated.rays.avoided, cost.ray));
  }
  if (refined.pairs_convex > 0) {
    add(std::to_string(refined.pairs_convex) + " pairs of input faces", "faces of one plane or of one convex solid do not see each other",
        std::to_string(refined.pairs_convex) + " questions to the oracle", times(refined.pairs_convex, cost.form_factor));
  }
  if (refined.pairs_dropped > 0) {
    add(std::to_string(refined.pairs_dropped) + " pairs of patches", "proven to face away from each other",
        std::to_string(refined.pairs_dropped) + " links", times(refined.pairs_dropped, cost.form_factor));
  }
  if (refined.pairs_dark > 0) {
    add(std::to_string(refined.pairs_dark) + " pairs of input faces", "no light leaves either: black, or reached by none",
        "their patches and links", times(refined.pairs_dark, cost.link));
  }
  if (refined.pairs_hidden > 0) {
    add(std::to_string(refined.pairs_hidden) + " pairs of patches", "proven to be hidden from each other by one convex object",
        "their links and rays", times(refined.pairs_hidden, cost.link));
  }
  if (exposure.buried_leaves > 0) { add(std::to_string(exposure.buried_leaves) + " leaves", "buried under another object", "their links"); }
  if (options.reconstruction >= Reconstruction::constant) {
    const bool picture = options.reconstruction == Reconstruction::constant;
    add("T-vertex elimination and interpolation", picture ? "one colour a leaf is asked for" : "no picture is asked for", "their time");
  }
  if (options.audit_points == 0) { add("the error estimate", "not asked for (audit of 0 points)", "the time of the audit"); }
}

}  // namespace radiosity
