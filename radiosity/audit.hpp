// SPDX-License-Identifier: MIT
#pragma once

// What every run says about itself: how wrong it is, how long it took, what it left out.
//
// The error is measured, not guessed. At N random surface points two independent path-traced estimates b1, b2 of the true
// radiosity are made; the mean of (b1 - B)(b2 - B) is an unbiased estimate of the mean squared error of B, because
// the noise of b1 and b2 is independent. It is given relative to the RMS of the reflected radiosity B - E (a lamp is exact
// by definition and must not flatter the figure), estimated without bias in the same way.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <radiosity/mesh.hpp>
#include <radiosity/options.hpp>
#include <radiosity/parallel.hpp>
#include <radiosity/plan.hpp>
#include <radiosity/reference.hpp>
#include <radiosity/sobol.hpp>
#include <radiosity/visibility.hpp>
#include <radiosity/warnings.hpp>

namespace radiosity {

struct StageTime {
  std::string name;
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;  // of all threads
};

struct ErrorEstimate {
  double relative_l2 = 0.0;     // RMS error / RMS reflected radiosity; area-weighted, all channels together
  double standard_error = 0.0;  // of relative_l2
};

struct SurfaceMean {
  std::string name;
  double area = 0.0;     // exposed, in the scene's squared unit
  Color radiosity{0.0};  // area-weighted mean, W/m2
};

struct Audit {
  // time
  std::vector<StageTime> stages;
  double wall_seconds = 0.0, cpu_seconds = 0.0;  // of all stages but the audit
  // size
  std::uint64_t polygons = 0;  // input faces: the roots of the hierarchy, whatever their number of corners and holes
  std::uint64_t nodes = 0, leaves = 0, links = 0, rays = 0;
  std::uint64_t clusters = 0, cluster_links = 0;    // among the nodes; among the links, with one at an end
  std::uint64_t rays_avoided = 0;                   // at least; by the two proofs:
  std::uint64_t pairs_clear = 0, pairs_hidden = 0;  // links that nothing can block; pairs, with all below, that one object hides
  std::uint64_t audit_rays = 0;
  std::uint64_t bytes = 0;  // held by the result: BReps, hierarchy, links, compiled objects
  // the linear system
  struct Range {
    double min = 0.0, mean = 0.0, max = 0.0;
  };
  Range proportion;               // of the leaves: inscribed over circumscribed circle, relative to that of a regular polygon
  Range row_sum;                  // of the form factors of a leaf, area-weighted mean; of the system that was solved
  Range computed_row_sum;         // the same before a closed scene was corrected
  std::optional<double> closure;  // RMS correction that made all row sums of a closed scene 1
  double closure_limit = 0.0;     // what quadrature and sampling explain of one (doubt.hpp); beyond, it is refused
  double energy_balance = 0.0;    // |emitted - absorbed - escaped| / emitted
  double escaped = 0.0;           // fraction of the emitted power that leaves an open scene
  double residual = 0.0;
  std::uint32_t iterations = 0;
  std::vector<std::vector<double>> histories;  // of each channel: the relative residual at the start and after each iteration
  bool converged = true;                       // solver below its residual and, when asked for, error below its target
  bool interrupted = false;                    // the best that the run had when it was told to stop; its error may not be measured
  // error
  // Relative L2, by what links and leaves cannot express (link_error.hpp): of what was asked for, a picture or the leaves; of the leaves.
  std::optional<double> estimated_error, estimated_leaf_error;
  std::string estimate_doubt;             // why the estimate is no bound of the error; empty where it may be taken for one
  bool target_missed = false;             // of BF-refinement: by the estimate, or by the audit beyond twice its standard error
  std::uint32_t generations = 0;          // of BF-refinement
  std::uint64_t audit_points = 0;
  std::optional<ErrorEstimate> leaf_error;     // of the constant on each leaf
  std::optional<ErrorEstimate> picture_error;  // of the reconstructed radiosity that the picture shows
  std::optional<double> direct_share;          // of its square: what is wrong in the light that was reflected once (--error alone)
  // what was done
  std::vector<LeftOut> left_out;
  std::vector<std::string> warnings;  // what in the scene may not be what was meant (warnings.hpp)
  std::optional<StrayRays> stray;     // of a scene that is not proven closed
  std::vector<SurfaceMean> surfaces;
  double epsilon = 0.0, min_area = 0.0, light_epsilon = 0.0;  // as used
  double target = 0.0;                                        // of BF-refinement; 0 when the time was the limit
  unsigned threads = 1, channels = 3;
  std::uint64_t seed = 0;
};

// Sums over the points of the audit.
struct ErrorSums {
  std::vector<double> square, reference;  // one entry a point: (b1 - B)(b2 - B) and (b1 - E)(b2 - E)

  // Variance of `square` from point to point.
  [[nodiscard]] double variance() const {
    const auto n = static_cast<double>(square.size());
    const double mean = std::accumulate(square.begin(), square.end(), 0.0) / n;
    double sum = 0.0;
    for (const double s : square) { sum += (s - mean) * (s - mean); }
    return sum / (n - 1.0);
  }

  [[nodiscard]] std::optional<ErrorEstimate> estimate() const {
    const auto n = static_cast<double>(square.size());
    if (square.size() < 2) { return std::nullopt; }
    double error = 0.0;
    double signal = 0.0;
    for (std::size_t i = 0; i < square.size(); ++i) {
      error += square[i] / n;
      signal += reference[i] / n;
    }
    if (!(signal > 0.0)) { return std::nullopt; }    // too few points see light
    const double noise = std::sqrt(variance() / n);  // standard error of the mean squared error
    const double root = std::sqrt(std::max(0.0, error));
    // d sqrt(x) = dx / (2 sqrt(x)); where the error is lost in the noise, the noise itself bounds it.
    const double root_noise = error > noise ? 0.5 * noise / root : std::sqrt(noise);
    return ErrorEstimate{root / std::sqrt(signal), root_noise / std::sqrt(signal)};
  }
};

struct MeasuredError {
  ErrorSums leaf, picture;
  std::uint64_t rays = 0;
  std::uint64_t keys = 0;            // of the random numbers that were used
  std::uint32_t paths = 0;           // of each estimate at a point; 0: to be chosen
  double noise = 0.0;                // what the noise of the paths adds to the variance of `square`, summed over the points
  double direct = 0.0, other = 0.0;  // squared errors of the light that was reflected once, and of the rest, summed over the points

  [[nodiscard]] std::uint64_t points() const { return leaf.square.size(); }
};

// Compares the mesh (in the frame) with `points` more path-traced points, spread evenly over its area. `direct`, if given: the same mesh, but
// with the light that was reflected once.
inline void measure_error(const Scene& scene, const raycast::Scene& objects, const std::vector<Surface>& surfaces, const Exposure& exposure,
                          const Mesh& mesh, const Mesh* direct, std::uint64_t points, unsigned threads, std::uint64_t seed,
                          MeasuredError& measured, const Control& control = {}) {
  struct Triangle {
    std::uint32_t face, first, second;  // corners face.first, first, second
    double cumulative_area;
  };
  std::vector<Triangle> triangles;
  double total = 0.0;
  const auto corner = [&](std::uint32_t c) -> const glm::dvec3& { return mesh.positions[mesh.corners[c].vertex]; };
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const MeshFace& face = mesh.faces[f];
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      const std::uint32_t a = face.first_corner;
      total += 0.5 * glm::length(glm::cross(corner(a + k) - corner(a), corner(a + k + 1) - corner(a)));
      triangles.push_back({f, a + k, a + k + 1, total});
    }
  }
  if (points == 0 || !(total > 0.0)) { return; }

  const std::vector<InputSurface> inputs = radiosity::surfaces(scene);
  const PathTracer tracer{scene, objects, surfaces};
  // Averaged in each of the two estimates, each an even sequence of its own; fewer where paths are long.
  if (measured.paths == 0) {
    measured.paths = std::bit_floor(static_cast<std::uint32_t>(std::clamp(1024.0 * (1.0 - tracer.brightest()), 2.0, 256.0)));
  }
  const std::uint32_t paths = measured.paths;
  struct Sample {
    double leaf = 0.0, picture = 0.0, reference = 0.0, noise = 0.0, direct = 0.0, other = 0.0;
    std::uint64_t rays = 0;
    bool valid = false;
  };
  std::vector<Sample> samples(points);
  const std::uint64_t first_key = measured.keys;
  measured.keys += points;
  const auto measure = [&](std::size_t i) {
    if (control.cancelled()) { return; }
    const std::uint64_t key = first_key + i;
    Random random{seed, key, 0x6175646974ull};
    const double at = (static_cast<double>(i) + random.uniform()) / static_cast<double>(points) * total;
    auto triangle =
        std::upper_bound(triangles.begin(), triangles.end(), at, [](double a, const Triangle& t) { return a < t.cumulative_area; });
    if (triangle == triangles.end()) { --triangle; }
    const MeshFace& face = mesh.faces[triangle->face];
    const double root = std::sqrt(random.uniform());
    const double v = random.uniform();
    const double w0 = 1.0 - root;
    const double w1 = root * (1.0 - v);
    const double w2 = root * v;
    const std::uint32_t a = face.first_corner;
    const glm::dvec3 chord = w0 * corner(a) + w1 * corner(triangle->first) + w2 * corner(triangle->second);
    const auto shown_by = [&](const Mesh& of) {
      return w0 * of.corners[a].radiosity + w1 * of.corners[triangle->first].radiosity + w2 * of.corners[triangle->second].radiosity;
    };
    const Color shown = shown_by(mesh);
    const InputSurface& input = inputs[face.surface];
    if (!(exposure.area[face.node] > 0.0)) { return; }
    if (exposure.partly_buried[face.node] && buried(objects, input.object, input.sheet, chord)) { return; }
    const raycast::SurfacePoint point = objects.object(input.object).project(input.sheet, chord);

    Sample& sample = samples[i];
    Color mean[2] = {Color{0.0}, Color{0.0}};
    Color mean_direct[2] = {Color{0.0}, Color{0.0}};
    for (std::uint64_t half = 0; half < 2; ++half) {
      const Sobol4 first{seed, 4 * key + 2 * half};
      const Sobol4 second{seed, 4 * key + 2 * half + 1};
      for (std::uint32_t k = 0; k < paths; ++k) {
        PathNumbers numbers{first, second, k, Random{seed, key, half << 32 | k}};
        const PathTracer::Light light = tracer.radiosity(point.position, point.normal, input.object, input.sheet, numbers, sample.rays);
        mean[half] += light.all / static_cast<double>(paths);
        mean_direct[half] += light.direct / static_cast<double>(paths);
      }
    }
    const Color& emission = scene.materials[input.material].emission;
    sample.leaf = glm::dot(mean[0] - face.radiosity, mean[1] - face.radiosity);
    sample.picture = glm::dot(mean[0] - shown, mean[1] - shown);
    sample.reference = glm::dot(mean[0] - emission, mean[1] - emission);
    if (direct != nullptr) {
      const Color once = shown_by(*direct);
      sample.direct = glm::dot(mean_direct[0] - once, mean_direct[1] - once);
      sample.other = glm::dot(mean[0] - mean_direct[0] - (shown - once), mean[1] - mean_direct[1] - (shown - once));
    }
    // The product of two errors of variance v has the variance v^2; so has a third of the square of half their squared difference.
    const double half_square = 0.5 * glm::dot(mean[0] - mean[1], mean[0] - mean[1]);
    sample.noise = half_square * half_square / 3.0;
    sample.valid = true;
  };
  constexpr std::size_t batch = 512;  // between two looks at the cancel flag
  for (std::size_t first = 0; first < points && !control.cancelled(); first += batch) {
    parallel_for(std::min<std::size_t>(batch, points - first), threads, [&](std::size_t offset) { measure(first + offset); });
    control.report("audit", static_cast<double>(std::min<std::size_t>(first + batch, points)) / static_cast<double>(points));
  }

  for (const Sample& sample : samples) {
    measured.rays += sample.rays;
    if (!sample.valid) { continue; }
    measured.leaf.square.push_back(sample.leaf);
    measured.leaf.reference.push_back(sample.reference);
    measured.picture.square.push_back(sample.picture);
    measured.picture.reference.push_back(sample.reference);
    measured.noise += sample.noise;
    measured.direct += sample.direct;
    measured.other += sample.other;
  }
}

// Is the error known to be at most `wanted`, two standard errors included?
[[nodiscard]] inline bool within(const std::optional<ErrorEstimate>& error, double wanted) {
  return error && error->relative_l2 + 2.0 * error->standard_error <= wanted;
}

// Measures until it is decided whether the error is at most `wanted`, which takes `points` points at least, or until that would cost too
// much: an error that seems small enough is worth `most_rays`; for one that seems too large, more than `solution_rays`, what the solution cost,
// would be better spent on a finer one. Where the noise of the paths is most of what makes the points differ, it is measured again with more
// paths at each, if that is not too much and unless the error is too large beyond all noise; where it is next to nothing, further
// points have fewer.
// `measure` returns false when it was cancelled.
inline void decide_error(const std::function<bool(std::uint64_t points, MeasuredError&)>& measure, const ErrorSums MeasuredError::*of,
                         std::uint64_t points, double wanted, std::uint64_t solution_rays, std::uint64_t most_rays,
                         MeasuredError& measured) {
  const std::uint64_t first = std::max<std::uint64_t>(2, points / 4);
  std::uint64_t asked = 0;
  for (std::uint64_t next = first;;) {
    if (!measure(next, measured)) { return; }
    asked += next;
    const ErrorSums& sums = measured.*of;
    const std::optional<ErrorEstimate> error = sums.estimate();
    if (!error || error->relative_l2 - 4.0 * error->standard_error > wanted) { return; }
    if (asked < points && error->relative_l2 <= wanted) {
      next = points - asked;
      continue;
    }
    if (within(error, wanted)) { return; }
    const double noise = measured.noise / (sums.variance() * static_cast<double>(measured.points()));  // share of the variance
    const auto allowed = static_cast<double>(error->relative_l2 <= wanted ? most_rays : std::min(most_rays, solution_rays));
    const auto rays = static_cast<double>(measured.rays);
    if (noise > 0.5 && 4.0 * rays <= allowed) {
      MeasuredError again;
      again.keys = measured.keys;
      again.paths = 4 * measured.paths;
      measured = std::move(again);
      asked = 0;
      next = first;
      continue;
    }
    if (error->relative_l2 - 2.0 * error->standard_error > wanted) { return; }
    if (noise < 1.0 / 32.0) { measured.paths = std::max(2u, measured.paths / 4); }
    // The standard error falls with the square root of the points. What is a little above may turn out a little below.
    const double ratio = 2.0 * error->standard_error / std::max(wanted - error->relative_l2, 0.1 * wanted);
    const double more = std::clamp(1.1 * (ratio * ratio - 1.0), 0.25, 3.0);
    if (rays * (1.0 + more) > allowed) { return; }
    next = static_cast<std::uint64_t>(std::ceil(more * static_cast<double>(asked)));
  }
}

}  // namespace radiosity
