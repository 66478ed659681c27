// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/run/uniform.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/study/measure.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

using radiosity::Control;
using radiosity::Options;
using radiosity::Outcome;
using radiosity::Scene;
using radiosity::Solution;

std::string text(const char* name, double value) { return std::string(name) + " " + apps::shortest(value); }

Options common(const MethodOptions& study) {
  return {.compare = 0, .audit_points = 0, .threads = study.threads, .memory = study.memory, .seed = study.seed};
}

// The same run, with a dense solution on its leaves.
Outcome run_dense(const Scene& scene, Options options, const Control& control) {
  options.compare = std::numeric_limits<std::uint32_t>::max();
  return radiosity::solve(scene, options, control);
}

Outcome run_without_shortcuts(const Scene& scene, Options options, const Control& control) {
  options.shortcuts = false;
  options.compare.reset();
  return radiosity::solve(scene, options, control);
}

// A hierarchical method whose settings are values of a single option.
MethodPlan hierarchical(std::string name, std::string summary, const char* option, const std::vector<double>& values, const Options& base,
                        void (*set)(Options&, double)) {
  MethodPlan method{std::move(name), std::move(summary), {}};
  for (const double value : values) {
    Options options = base;
    set(options, value);
    method.settings.push_back(
        {text(option, value), [options](const Scene& scene, const Control& control) { return radiosity::solve(scene, options, control); },
         [options](const Scene& scene, const Solution&, const Control& control) { return run_dense(scene, options, control); },
         [options](const Scene& scene, const Control& control) { return run_without_shortcuts(scene, options, control); }});
  }
  return method;
}

// The smallest patch shrinks with epsilon, so that shadows become finer too.
void set_epsilon(Options& options, double epsilon) {
  options.epsilon = epsilon;
  options.min_area = 2.4 * epsilon * epsilon;
}

void set_target(Options& options, double target) {
  options.refinement = radiosity::Refinement::a_posteriori;
  options.target = target;
}

// The rounds and their audits belong to the cost of this method.
Outcome run_to_error(const Scene& scene, const Options& options, const Control& control) {
  Outcome outcome = radiosity::solve(scene, options, control);
  if (!outcome.solution) { return outcome; }
  radiosity::Audit& audit = outcome.solution->audit;
  for (const radiosity::StageTime& stage : audit.stages) { audit.cpu_seconds += stage.name == "audit" ? stage.cpu_seconds : 0.0; }
  return outcome;
}

MethodPlan accuracy_target(std::string name, std::string summary, const Options& base) {
  MethodPlan method{std::move(name), std::move(summary), {}};
  for (const double error : {0.32, 0.16, 0.112, 0.08, 0.056, 0.04, 0.028}) {
    Options options = base;
    options.refinement = radiosity::Refinement::a_posteriori;
    options.audit_points = 1000;
    options.error = error;
    Options last = options;  // of the last round
    last.error.reset();
    last.audit_points = 0;
    method.settings.push_back({text("error", error),
                               [options](const Scene& scene, const Control& control) { return run_to_error(scene, options, control); },
                               [last](const Scene& scene, const Solution& found, const Control& control) {
                                 Options round = last;
                                 round.target = found.audit.target;
                                 return run_dense(scene, round, control);
                               },
                               {}});
  }
  return method;
}

radiosity::UniformOptions uniform_options(const MethodOptions& study, radiosity::UniformSolver solver, int leaves) {
  radiosity::UniformOptions options;
  options.solver = solver;
  options.max_area = 1.0 / leaves;
  options.compare = 0;
  options.threads = study.threads;
  options.seed = study.seed;
  options.memory = study.memory;
  return options;
}

// The second run has the dense solution of the same mesh, from which the parts of the error are computed.
Setting uniform_setting(std::string name, const radiosity::UniformOptions& options) {
  radiosity::UniformOptions matrix = options;
  matrix.solver = radiosity::UniformSolver::gauss_seidel;
  return {
      std::move(name),
      [options](const Scene& scene, const Control& control) { return radiosity::solve_uniform(scene, options, control); },
      [matrix](const Scene& scene, const Solution&, const Control& control) { return radiosity::solve_uniform(scene, matrix, control); },
      {}};
}

MethodPlan uniform(std::string name, std::string summary, const MethodOptions& study, radiosity::UniformSolver solver) {
  MethodPlan method{std::move(name), std::move(summary), {}};
  double unshot = 0.16;
  for (const int leaves : {32, 64, 128, 256, 512, 1024, 2048}) {
    radiosity::UniformOptions options = uniform_options(study, solver, leaves);
    options.unshot = unshot /= 2.0;
    std::string setting = "area 1/" + std::to_string(leaves);
    if (solver == radiosity::UniformSolver::progressive) { setting += text(", unshot", unshot); }
    method.settings.push_back(uniform_setting(std::move(setting), options));
  }
  return method;
}

MethodPlan plain_program(const MethodOptions& study) {
  MethodPlan method{"plain program",
                    "every face cut evenly; quasi-random direct light, and for each leaf a stored list of what its cosine-distributed rays "
                    "meet, iterated: what one would write without a hierarchy, on our ray caster",
                    {}};
  const std::array<std::uint32_t, 7> rays{32, 48, 64, 96, 128, 192, 256};  // for the largest leaf
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const int leaves = 128 << k;
    radiosity::UniformOptions options = uniform_options(study, radiosity::UniformSolver::gather_lists, leaves);
    options.max_leaves = 10'000'000;
    options.lists = {rays[k] / 2, rays[k]};
    options.residual = 1e-5;
    method.settings.push_back(uniform_setting("area 1/" + std::to_string(leaves) + ", " + std::to_string(rays[k]) + " rays", options));
  }
  return method;
}

}  // namespace

std::vector<MethodPlan> methods(const MethodOptions& study) {
  const std::vector<double> epsilons{0.16, 0.08, 0.04, 0.02, 0.01, 0.005, 0.0025};
  const std::vector<double> targets{0.16, 0.08, 0.04, 0.02, 0.01, 0.005, 0.0025};
  const std::string with_clusters = "the same with clusters above the input faces, also where they do not pay";
  std::vector<MethodPlan> all;
  Options rays = common(study);
  rays.indirect = radiosity::Indirect::rays;
  all.push_back(
      hierarchical("F, stored rays",
                   "lamps are linked as in hierarchical F; light between other surfaces goes by links that are made of stored rays, "
                   "also where these do not pay",
                   "epsilon", epsilons, rays, set_epsilon));
  Options faces = common(study);
  faces.indirect = radiosity::Indirect::links;
  faces.cluster_from = std::numeric_limits<std::uint32_t>::max();
  all.push_back(hierarchical("hierarchical F",
                             "a pair is linked where its form factor is small (paper 4.4), and split on where the light of a lamp varies "
                             "(our light oracle, not in the paper); faces are split by Euler operators",
                             "epsilon", epsilons, faces, set_epsilon));
  Options clusters = faces;
  clusters.cluster_from = 2;
  all.push_back(hierarchical("F, clusters", with_clusters, "epsilon", epsilons, clusters, set_epsilon));
  all.push_back(hierarchical("hierarchical BF", "solve, then refine the links that carry the most error (paper 4.4)", "target", targets,
                             faces, set_target));
  all.push_back(hierarchical("BF, clusters", with_clusters, "target", targets, clusters, set_target));
  all.push_back(accuracy_target("BF, accuracy target",
                                "BF-refinement until a path-traced audit witnesses the relative L2 error asked for, which is that of the "
                                "reconstructed radiosity over all surfaces; all rounds and audits count",
                                faces));
  all.push_back(accuracy_target("BF, accuracy target, clusters", with_clusters, clusters));
  Options discontinuities = faces;
  discontinuities.discontinuities = 1000;
  all.push_back(
      hierarchical("F, discontinuities",
                   "hierarchical F whose faces are cut along the edges of shadows and across their direct light, not into quarters",
                   "epsilon", epsilons, discontinuities, set_epsilon));
  Options separate = common(study);
  separate.topology = radiosity::Topology::separate;
  separate.indirect = radiosity::Indirect::links;
  separate.cluster_from = std::numeric_limits<std::uint32_t>::max();
  all.push_back(
      hierarchical("F, separate polygons",
                   "hierarchical F, its light oracle, form factors and visibility unchanged, on polygons that share no vertices and "
                   "stay flat: a quad-tree on each, as in classical hierarchical radiosity (Hanrahan 1991)",
                   "epsilon", epsilons, separate, set_epsilon));
  all.push_back(uniform("uniform, matrix", "every face cut evenly, the full matrix solved by Gauss-Seidel", study,
                        radiosity::UniformSolver::gauss_seidel));
  all.push_back(uniform("progressive", "every face cut evenly, the brightest leaf shoots (Cohen 1988); no matrix is stored", study,
                        radiosity::UniformSolver::progressive));
  all.push_back(plain_program(study));
  return all;
}

}  // namespace study
