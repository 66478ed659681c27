// SPDX-License-Identifier: MIT
#pragma once

// The facade: a scene goes in, a mesh with radiosities and the audit of the run come out.
//
//   objects -> one BRep an object -> roots -> refine (oracle) -> expose -> evaluate links -> solve -> reconstruct -> audit
//
// Data flows one way; the objects stay untouched. The library prints nothing, opens no file and throws nothing.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include <radiosity/audit.hpp>
#include <radiosity/evaluate.hpp>
#include <radiosity/exposure.hpp>
#include <radiosity/frame.hpp>
#include <radiosity/mesh.hpp>
#include <radiosity/options.hpp>
#include <radiosity/plan.hpp>
#include <radiosity/reconstruct.hpp>
#include <radiosity/refine.hpp>
#include <radiosity/scene.hpp>
#include <radiosity/solve.hpp>
#include <radiosity/transport.hpp>

namespace radiosity {

struct Solution {
  Mesh mesh;  // positions in the scene's own coordinates
  Audit audit;

  // What stands behind the mesh, in the coordinates of the frame.
  Frame frame;
  Hierarchy hierarchy;
  Links links;
  std::vector<double> area;      // exposed, one a node
  std::vector<double> row_sum;   // of the system that was solved, one a node; 0 at inner nodes
  std::vector<Color> radiosity;  // W/m2, one a node
};

struct Failure {
  enum class Kind { invalid_scene, cancelled };
  Kind kind = Kind::invalid_scene;
  std::vector<std::string> sentences;
};

struct Outcome {
  std::optional<Solution> solution;
  Failure failure;  // when there is no solution
};

namespace detail {

// Measures the wall and CPU time of stages that follow one another.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageTime>& stages) : stages_{&stages} {}

  // Ends the stage that began with the last call (or the construction).
  void lap(std::string name) {
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    stages_->push_back(
        {std::move(name), std::chrono::duration<double>(wall - wall_).count(), static_cast<double>(cpu - cpu_) / CLOCKS_PER_SEC});
    wall_ = wall;
    cpu_ = cpu;
  }

 private:
  std::vector<StageTime>* stages_;
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

inline Outcome failed(Failure::Kind kind, std::vector<std::string> sentences) { return {std::nullopt, {kind, std::move(sentences)}}; }

// Emitted = absorbed + escaped, summed over the channels (notes: closed and open scenes alike).
inline void balance_energy(Audit& audit, const Scene& scene, const std::vector<InputSurface>& inputs, const Hierarchy& hierarchy,
                           const Transport& transport, const std::vector<double>& area, const std::vector<Color>& radiosity) {
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
      const Material& material = scene.materials[inputs[hierarchy[i].surface].material];
      emitted += area[i] * material.emission[c];
      absorbed += (1.0 - material.reflectance[c]) * arrived[i];
      escaped += area[i] * radiosity[i][c] * (1.0 - rows[i]);
    }
  }
  if (emitted > 0.0) {
    audit.energy_balance = std::abs(emitted - absorbed - escaped) / emitted;
    audit.escaped = escaped / emitted;
  }
}

inline Audit::Range summarise_rows(const Hierarchy& hierarchy, const std::vector<double>& area, const std::vector<double>& rows) {
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

inline void summarise_surfaces(Audit& audit, const std::vector<InputSurface>& inputs, const Frame& frame, const Hierarchy& hierarchy,
                               const std::vector<double>& area, const std::vector<Color>& radiosity) {
  for (const InputSurface& input : inputs) { audit.surfaces.push_back({input.name, 0.0, Color{0.0}}); }
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf()) { continue; }
    SurfaceMean& mean = audit.surfaces[hierarchy[i].surface];
    mean.area += area[i];
    mean.radiosity += area[i] * radiosity[i];
  }
  for (SurfaceMean& mean : audit.surfaces) {
    if (mean.area > 0.0) { mean.radiosity /= mean.area; }
    mean.area = frame.to_scene_area(mean.area);
  }
}

// Solves each channel; a grey scene has one. Fills the radiosity of every node.
inline std::vector<Color> solve_channels(Audit& audit, const Scene& scene, const std::vector<InputSurface>& inputs, const Plan& plan,
                                         const Hierarchy& hierarchy, const Transport& transport, const std::vector<double>& area,
                                         const Options& options) {
  std::vector<Color> radiosity(hierarchy.size(), Color{0.0});
  for (int c = 0; c < static_cast<int>(plan.channels); ++c) {
    std::vector<double> reflectance;
    std::vector<double> emission;
    for (const InputSurface& input : inputs) {
      reflectance.push_back(scene.materials[input.material].reflectance[c]);
      emission.push_back(scene.materials[input.material].emission[c]);
    }
    const LinearSolution solved =
        solve_channel(hierarchy, transport, area, reflectance, emission, options.solver, options.residual, options.max_iterations);
    audit.residual = std::max(audit.residual, solved.residual);
    audit.iterations = std::max(audit.iterations, solved.iterations);
    audit.converged = audit.converged && solved.converged;
    for (std::size_t i = 0; i < radiosity.size(); ++i) {
      for (int to = c; to < (plan.channels == 1 ? 3 : c + 1); ++to) { radiosity[i][to] = solved.radiosity[i]; }
    }
  }
  return radiosity;
}

// What the run left out, beyond what the plan had proven before it.
inline void report_left_out(Audit& audit, const Plan& plan, const RefineResult& refined, const EvaluateResult& evaluated,
                            const Exposure& exposure, const Options& options) {
  audit.left_out = plan.left_out;
  const auto add = [&](std::string what, std::string why, std::string saved) {
    audit.left_out.push_back({std::move(what), std::move(why), std::move(saved)});
  };
  if (!plan.lit) {
    add("refinement, links and solver", "nothing emits light: B = 0", "the whole solve");
    return;
  }
  if (!plan.reflects) {
    add("links and solver", "nothing reflects: B = E", "the whole solve");
    return;
  }
  if (evaluated.proven_clear > 0) {
    add("visibility of " + std::to_string(evaluated.proven_clear) + " links", "no object can stand between the patches",
        "at least " + std::to_string(evaluated.proven_clear * segments_per_round) + " rays");
  }
  if (refined.pairs_convex > 0) {
    add(std::to_string(refined.pairs_convex) + " pairs of input faces", "faces of one plane or of one convex solid do not see each other",
        std::to_string(refined.pairs_convex) + " questions to the oracle");
  }
  if (refined.pairs_dropped > 0) {
    add(std::to_string(refined.pairs_dropped) + " pairs of patches", "proven to face away from each other",
        std::to_string(refined.pairs_dropped) + " links");
  }
  if (exposure.buried_leaves > 0) { add(std::to_string(exposure.buried_leaves) + " leaves", "buried under another object", "their links"); }
  if (options.audit_points == 0) { add("the error estimate", "not asked for (audit of 0 points)", "the time of the audit"); }
}

// One run at a given fineness.
inline Outcome solve_at(const Scene& scene, const Options& options, double epsilon, double min_area, const Control& control) {
  Solution solution;
  Audit& audit = solution.audit;
  Stopwatch watch{audit.stages};
  const unsigned threads = thread_count(options.threads);
  audit.epsilon = epsilon;
  audit.min_area = min_area;
  audit.threads = threads;
  audit.seed = options.seed;
  const auto cancelled = [] { return failed(Failure::Kind::cancelled, {"the run was interrupted; nothing has been written"}); };

  const auto frame = make_frame(scene);
  if (!frame) { return failed(Failure::Kind::invalid_scene, {"the scene has no finite size"}); }
  solution.frame = *frame;
  const std::vector<InputSurface> inputs = surfaces(scene);
  const raycast::Scene objects = compile(scene, *frame);
  std::vector<Surface> boundary;
  for (std::uint32_t o = 0, first = 0; o < objects.size(); ++o) {
    SurfaceResult made = make_surface(objects.object(o), first);
    if (!made.surface) { return failed(Failure::Kind::invalid_scene, {"object '" + scene.objects[o].name + "': " + made.fault}); }
    first += objects.object(o).sheet_count();
    boundary.push_back(std::move(*made.surface));
  }
  const Plan plan = make_plan(scene, boundary);
  audit.channels = plan.channels;
  Hierarchy& hierarchy = solution.hierarchy;
  hierarchy = make_roots(boundary);
  watch.lap("build");

  // Without light, or without reflection, B = E on the input faces.
  RefineResult refined;
  if (plan.lit && plan.reflects) {
    refined = refine(scene, objects, plan, boundary, hierarchy, epsilon, min_area, threads, options.seed, control);
    if (refined.cancelled) { return cancelled(); }
  }
  solution.links = std::move(refined.links);
  watch.lap("refine");

  const Exposure exposure = measure_exposure(objects, boundary, hierarchy, threads, options.seed);
  watch.lap("expose");

  std::vector<bool> emits;
  std::vector<std::uint32_t> materials;
  for (const InputSurface& input : inputs) {
    emits.push_back(!is_black(scene.materials[input.material].emission));
    materials.push_back(input.material);
  }
  const EvaluateResult evaluated =
      evaluate(objects, plan, boundary, hierarchy, exposure, emits, solution.links, threads, options.seed, control);
  if (evaluated.cancelled) { return cancelled(); }
  watch.lap("link");

  Transport transport{hierarchy, solution.links, exposure};
  solution.row_sum = transport.row_sums();
  audit.computed_row_sum = summarise_rows(hierarchy, exposure.area, solution.row_sum);
  if (plan.closed && !solution.links.empty()) { audit.closure = transport.close(0.1); }
  solution.row_sum = transport.row_sums();
  audit.row_sum = summarise_rows(hierarchy, exposure.area, solution.row_sum);
  solution.radiosity = solve_channels(audit, scene, inputs, plan, hierarchy, transport, exposure.area, options);
  balance_energy(audit, scene, inputs, hierarchy, transport, exposure.area, solution.radiosity);
  summarise_surfaces(audit, inputs, *frame, hierarchy, exposure.area, solution.radiosity);
  watch.lap("solve");

  eliminate_t_vertices(boundary);
  reconstruct(boundary, hierarchy, exposure, solution.radiosity, materials, options.reconstruction);
  solution.mesh = make_mesh(boundary, hierarchy, exposure, solution.radiosity);
  watch.lap("reconstruct");
  for (const StageTime& stage : audit.stages) {
    audit.wall_seconds += stage.wall_seconds;
    audit.cpu_seconds += stage.cpu_seconds;
  }

  audit.nodes = hierarchy.size();
  audit.leaves = static_cast<std::uint64_t>(std::count_if(hierarchy.begin(), hierarchy.end(), [](const Node& n) { return n.leaf(); }));
  audit.links = solution.links.size();
  audit.rays = refined.rays + evaluated.rays;
  audit.bytes = hierarchy.capacity() * sizeof(Node) + solution.links.capacity() * sizeof(Link) + objects.bytes();
  for (const Surface& surface : boundary) { audit.bytes += surface.brep.bytes(); }
  report_left_out(audit, plan, refined, evaluated, exposure, options);
  if (options.audit_points > 0) {
    const MeasuredError measured =
        measure_error(scene, objects, boundary, exposure, solution.mesh, options.audit_points, threads, options.seed, control);
    if (control.cancelled()) { return cancelled(); }
    audit.leaf_error = measured.leaf;
    audit.picture_error = measured.picture;
    audit.audit_points = measured.points;
    audit.audit_rays = measured.rays;
    watch.lap("audit");
  }
  for (glm::dvec3& p : solution.mesh.positions) { p = frame->to_scene(p); }
  solution.area = exposure.area;
  return {std::move(solution), {}};
}

}  // namespace detail

// Solves the scene. With an error target, epsilon and min_area are halved until the audit of the picture meets it; a run
// whose error stays above says so by audit.converged.
[[nodiscard]] inline Outcome solve(const Scene& scene, const Options& options = {}, const Control& control = {}) {
  std::vector<std::string> sentences = faults(scene);
  if (options.error && options.audit_points == 0) {
    sentences.emplace_back("an error target needs the audit as its witness; give it some points");
  }
  if (!sentences.empty()) { return detail::failed(Failure::Kind::invalid_scene, std::move(sentences)); }
  double epsilon = options.epsilon;
  double min_area = options.min_area;
  constexpr std::uint64_t link_limit = 30'000'000;  // 360 MB of links
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;
  for (;;) {
    Outcome outcome = detail::solve_at(scene, options, epsilon, min_area, control);
    if (!outcome.solution || !options.error) { return outcome; }
    Audit& audit = outcome.solution->audit;
    wall_seconds += audit.wall_seconds;
    cpu_seconds += audit.cpu_seconds;
    const bool met = audit.picture_error && audit.picture_error->relative_l2 <= *options.error;
    if (met || 4 * audit.links > link_limit) {
      audit.converged = audit.converged && met;
      audit.wall_seconds = wall_seconds;
      audit.cpu_seconds = cpu_seconds;
      return outcome;
    }
    epsilon *= 0.5;
    min_area *= 0.5;
  }
}

}  // namespace radiosity
