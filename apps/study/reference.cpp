// SPDX-License-Identifier: MIT
#include "apps/study/reference.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include <raycast/object.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/polygons.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/batches.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <radiosity/visibility/visibility.hpp>

#include "apps/bytes.hpp"

namespace study {
namespace {

using radiosity::Color;

// The uniform radiosity B of a furnace, i.e. a closed scene with E = B (1 - rho) on every surface; nothing for other scenes.
std::optional<Color> furnace_radiosity(const radiosity::Scene& scene, const radiosity::Plan& plan) {
  if (!plan.closed) { return std::nullopt; }
  Color b{0.0};
  const auto inputs = radiosity::surfaces(scene);
  for (int c = 0; c < 3; ++c) {
    for (const auto& input : inputs) {
      const radiosity::Material& m = scene.materials[input.material];
      if (m.reflectance[c] < 1.0) { b[c] = std::max(b[c], m.emission[c] / (1.0 - m.reflectance[c])); }
    }
    for (const auto& input : inputs) {
      const radiosity::Material& m = scene.materials[input.material];
      if (std::abs(m.emission[c] - b[c] * (1.0 - m.reflectance[c])) > 1e-12 * b[c]) { return std::nullopt; }
    }
  }
  return b;
}

// Adds a cell for the leaf, with up to four exposed points, one per quarter, unless there is none.
void add_cell(TrueRadiosity& truth, const radiosity::Prepared& prepared, const radiosity::Node& leaf, std::uint64_t seed) {
  const radiosity::Surface& surface = prepared.surfaces[leaf.object];
  const std::uint32_t sheet = leaf.surface - surface.first_surface;
  const radiosity::Patch patch = radiosity::make_patch(radiosity::corner_polygon(surface.brep, leaf.face));
  if (!(patch.area > 0.0)) { return; }
  const auto cell = static_cast<std::uint32_t>(truth.cells.size());
  const auto first = static_cast<std::uint32_t>(truth.points.size());
  constexpr int tries = 16;  // per quarter
  int exposed = 0;
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
    radiosity::Random random{seed, cell, quarter};
    bool found = false;
    for (int k = 0; k < tries; ++k) {
      const double u = (quarter % 2 + random.uniform()) / 2.0;
      const glm::dvec3 chord = radiosity::sample(patch, u, (quarter / 2 + random.uniform()) / 2.0);
      const raycast::ScenePoint point{prepared.objects.object(leaf.object).project(sheet, chord), leaf.object, sheet};
      if (prepared.objects.covered(point)) { continue; }
      ++exposed;
      if (!found) { truth.points.push_back({point, Color{0.0}, Color{0.0}}); }
      found = true;
    }
  }
  const auto count = static_cast<std::uint32_t>(truth.points.size()) - first;
  if (count == 0) { return; }
  std::vector<glm::dvec3> corners;
  for (const glm::dvec3& p : patch.contour) { corners.push_back(prepared.frame.to_scene(p)); }
  truth.cells.push_back({std::move(corners), prepared.frame.to_scene_area(patch.area) * exposed / (4.0 * tries), first, count});
}

std::optional<TrueRadiosity> points_of(const radiosity::Scene& scene, radiosity::Prepared& prepared, const ReferenceOptions& options,
                                       std::string& fault) {
  const auto refuse = [&fault](const char* sentence) {
    fault = sentence;
    return std::nullopt;
  };
  TrueRadiosity truth;
  truth.left_out = prepared.plan.left_out;
  if (!prepared.plan.lit) { return refuse("nothing emits light: every method finds B = 0"); }
  if (!prepared.plan.reflects) { return refuse("nothing reflects: every method finds B = E"); }
  if (prepared.plan.lossless) { return refuse("the scene is closed and absorbs nothing: it has no solution"); }
  const std::optional<Color> furnace = furnace_radiosity(scene, prepared.plan);
  truth.analytic = furnace.has_value();
  if (!truth.analytic && !prepared.plan.traceable) {
    return refuse("closed and nearly lossless: paths would need thousands of bounces, and no exact answer is known");
  }
  radiosity::Hierarchy hierarchy = radiosity::make_roots(prepared.surfaces);
  radiosity::split_evenly(prepared.surfaces, hierarchy, radiosity::root_area(hierarchy) / options.cells);
  const auto inputs = radiosity::surfaces(scene);
  const auto emits = [&](std::uint32_t s) { return !radiosity::is_black(scene.materials[inputs[s].material].emission); };
  bool all_emit = true;
  for (std::uint32_t s = 0; s < inputs.size(); ++s) { all_emit = all_emit && emits(s); }
  for (const radiosity::Node& node : hierarchy) {
    if (node.leaf() && (all_emit || !emits(node.surface))) { add_cell(truth, prepared, node, options.seed); }
  }
  if (furnace) {
    for (ReferencePoint& p : truth.points) { p.radiosity = *furnace; }
  }
  if (truth.points.empty()) { return refuse("no surface that does not emit can be seen"); }
  return truth;
}

// Computes the values of the points: each is the mean of several independent sequences, whose spread gives the standard error.
void trace(const radiosity::Scene& scene, const radiosity::Prepared& prepared, const ReferenceOptions& options,
           const radiosity::Control& control, TrueRadiosity& truth) {
  const radiosity::PathTracer tracer{scene, prepared.objects, prepared.surfaces};
  constexpr std::uint32_t sequences = 8;
  const auto length = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, options.paths / sequences));
  truth.paths = std::uint64_t{sequences} * length;
  const auto measure = [&](std::size_t i) {
    if (control.cancelled()) { return; }
    ReferencePoint& point = truth.points[i];
    Color mean{0.0};
    Color square{0.0};
    std::uint64_t rays = 0;
    for (std::uint32_t s = 0; s < sequences; ++s) {
      const radiosity::Sobol4 first{options.seed, 2 * (i * sequences + s)};
      const radiosity::Sobol4 second{options.seed, 2 * (i * sequences + s) + 1};
      Color sum{0.0};
      for (std::uint32_t k = 0; k < length; ++k) {
        radiosity::PathNumbers numbers{first, second, k, radiosity::Random{options.seed, i, std::uint64_t{s} << 32 | k}};
        sum += tracer.radiosity(point.at, numbers, rays).all;
      }
      sum /= static_cast<double>(length);
      mean += sum / static_cast<double>(sequences);
      square += sum * sum / static_cast<double>(sequences);
    }
    point.radiosity = mean;
    for (int c = 0; c < 3; ++c) { point.standard_error[c] = std::sqrt(std::max(0.0, square[c] - mean[c] * mean[c]) / (sequences - 1.0)); }
  };
  const std::size_t count = truth.points.size();
  radiosity::parallel_in_batches(control, radiosity::thread_count(options.threads), count, {128, 8}, measure, [&](std::size_t done) {
    control.report("reference", static_cast<double>(done) / static_cast<double>(count));
  });
}

double magnitude(const Color& c) { return std::abs(c.x) + std::abs(c.y) + std::abs(c.z); }

// Sums for the three norms over weighted values.
struct Sums {
  double l1 = 0.0, l2 = 0.0, worst = 0.0;
  void add(double weight, const Color& c) {
    l1 += weight * magnitude(c);
    l2 += weight * glm::dot(c, c);
    worst = std::max(worst, glm::length(c));
  }
  [[nodiscard]] Norms relative_to(const Sums& whole) const { return {l1 / whole.l1, std::sqrt(l2 / whole.l2), worst / whole.worst}; }
};

double point_weight(const ReferenceCell& cell) { return cell.area / cell.points; }

// Mean of a colour over the points of a cell.
template <class Value>
Color mean(const ReferenceCell& cell, const Value& value) {
  Color sum{0.0};
  for (std::uint32_t i = 0; i < cell.points; ++i) { sum += value(cell.first_point + i); }
  return sum / static_cast<double>(cell.points);
}

struct Whole {
  Sums cells, points;
};

Whole norms_of_truth(const TrueRadiosity& truth) {
  Whole whole;
  for (const ReferenceCell& cell : truth.cells) {
    whole.cells.add(cell.area, mean(cell, [&](std::uint32_t i) { return truth.points[i].radiosity; }));
    for (std::uint32_t i = 0; i < cell.points; ++i) { whole.points.add(point_weight(cell), truth.points[cell.first_point + i].radiosity); }
  }
  return whole;
}

}  // namespace

std::optional<TrueRadiosity> reference_points(const radiosity::Scene& scene, const ReferenceOptions& options, std::string& fault) {
  radiosity::PrepareResult preparation = radiosity::prepare(scene);
  if (!preparation.prepared) {
    fault = preparation.faults.front();
    return std::nullopt;
  }
  return points_of(scene, *preparation.prepared, options, fault);
}

std::string reference_key(std::string_view text, const TrueRadiosity& points, const ReferenceOptions& options) {
  apps::Checksum sum;
  sum.add(text);
  sum.add(options.seed);
  sum.add(std::uint64_t{points.points.size()});
  for (const ReferencePoint& p : points.points) {
    for (const double x : {p.at.position.x, p.at.position.y, p.at.position.z}) { sum.add(x); }
    sum.add(std::uint64_t{p.at.object});
    sum.add(std::uint64_t{p.at.sheet});
  }
  return sum.text();
}

std::optional<TrueRadiosity> make_reference(const radiosity::Scene& scene, std::string_view text, const std::vector<std::string>& caches,
                                            const ReferenceOptions& options, const radiosity::Control& control, std::string& fault) {
  radiosity::PrepareResult preparation = radiosity::prepare(scene);
  if (!preparation.prepared) {
    fault = preparation.faults.front();
    return std::nullopt;
  }
  std::optional<TrueRadiosity> truth = points_of(scene, *preparation.prepared, options, fault);
  if (!truth || truth->analytic) { return truth; }
  const std::string key = reference_key(text, *truth, options);
  if (read_cache(caches, key, options.paths, *truth)) { return truth; }
  trace(scene, *preparation.prepared, options, control, *truth);
  if (control.cancelled()) {
    fault = "interrupted before the reference was done";
    return std::nullopt;
  }
  write_cache(caches, key, *truth);
  return truth;
}

Errors errors_of(const TrueRadiosity& truth, const std::vector<Color>& values, std::vector<double>* signed_cells) {
  Sums cells;
  Sums points;
  double brightest = 0.0;
  if (signed_cells != nullptr) { signed_cells->clear(); }
  for (const ReferenceCell& cell : truth.cells) {
    const Color error = mean(cell, [&](std::uint32_t i) { return values[i] - truth.points[i].radiosity; });
    cells.add(cell.area, error);
    brightest = std::max(brightest, magnitude(mean(cell, [&](std::uint32_t i) { return truth.points[i].radiosity; })));
    if (signed_cells != nullptr) { signed_cells->push_back(radiosity::sum_of_channels(error)); }
    for (std::uint32_t i = cell.first_point; i < cell.first_point + cell.points; ++i) {
      points.add(point_weight(cell), values[i] - truth.points[i].radiosity);
    }
  }
  if (signed_cells != nullptr) {
    for (double& e : *signed_cells) { e /= brightest; }
  }
  const Whole whole = norms_of_truth(truth);
  return {cells.relative_to(whole.cells), points.relative_to(whole.points)};
}

double distance(const TrueRadiosity& truth, const std::vector<Color>& a, const std::vector<Color>& b) {
  Sums points;
  for (const ReferenceCell& cell : truth.cells) {
    for (std::uint32_t i = cell.first_point; i < cell.first_point + cell.points; ++i) { points.add(point_weight(cell), a[i] - b[i]); }
  }
  return points.relative_to(norms_of_truth(truth).points).l2;
}

Reference describe(const TrueRadiosity& truth) {
  Sums cells;
  Sums points;
  for (const ReferenceCell& cell : truth.cells) {
    const Color variance = mean(cell, [&](std::uint32_t i) { return truth.points[i].standard_error * truth.points[i].standard_error; });
    cells.add(cell.area, glm::sqrt(variance / static_cast<double>(cell.points)));
    for (std::uint32_t i = cell.first_point; i < cell.first_point + cell.points; ++i) {
      points.add(point_weight(cell), truth.points[i].standard_error);
    }
  }
  const Whole whole = norms_of_truth(truth);
  Reference reference;
  reference.kind = truth.analytic ? "analytic" : "path traced";
  reference.noise = cells.relative_to(whole.cells).l2;
  reference.point_noise = points.relative_to(whole.points).l2;
  reference.cells = truth.cells.size();
  reference.points = truth.points.size();
  reference.paths = truth.paths * truth.points.size();
  reference.cached = truth.cached;
  return reference;
}

}  // namespace study
