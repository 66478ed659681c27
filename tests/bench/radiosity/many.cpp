// SPDX-License-Identifier: MIT

// How links and time grow with the number k of input polygons: random boxes, single polygons, or one mesh, in a room. Error by the audit.
// F-refinement, or, with a target, BF-refinement.
//
// On several threads the audit is left out, and the CPU time of the calling thread stands in place of the error: on a loaded machine, where
// the clock on the wall says little, T(1 thread) over that is how much faster the run would be.
//
//     bench_many [boxes|polygons|mesh [epsilon [threads [least k [most k [cluster from [target]]]]]]]

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "radiosity/many_scene.hpp"

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

int main(int argc, char** argv) {
  const auto number = [&](int i, double otherwise) { return argc > i ? std::atof(argv[i]) : otherwise; };
  const std::string kind = argc > 1 ? argv[1] : "boxes";
  const scenes::Things things = kind == "polygons" ? scenes::Things::polygons
                                : kind == "mesh"   ? scenes::Things::mesh
                                                   : scenes::Things::boxes;
  radiosity::Options options;
  options.epsilon = number(2, 0.02);
  options.min_area = 0.01 * options.epsilon;
  options.threads = static_cast<unsigned>(number(3, 1));
  if (options.threads > 1) { options.audit_points = 0; }
  if (argc > 7) {
    options.refinement = radiosity::Refinement::a_posteriori;
    options.target = number(7, options.target);
  }
  const auto own_seconds = [] {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  options.indirect = radiosity::Indirect::links;  // clusters are for these
  options.cluster_from = static_cast<std::uint32_t>(number(6, options.cluster_from));
  std::printf("%8s %8s %9s %9s %9s %9s %8s %7s %7s   %-14s  slope of links, time\n", "polygons", "clusters", "leaves", "links", "of clust.",
              "rays", "MB", "CPU s", "wall s", "L2 of leaves");
  double before_k = 0.0, before_links = 0.0, before_time = 0.0;
  for (const std::uint32_t k : {13u, 31u, 103u, 307u, 1003u, 3001u, 10003u, 30001u, 100003u}) {
    if (k < number(4, 0) || k > number(5, 1e9)) { continue; }
    const radiosity::Scene scene = scenes::many(k, things);
    const double start = own_seconds();
    const radiosity::Outcome outcome = radiosity::solve(scene, options);
    const double own = own_seconds() - start;
    if (!outcome.solution) {
      std::printf("%8u  %s\n", k, outcome.failure.sentences.front().c_str());
      continue;
    }
    const radiosity::Audit& audit = outcome.solution->audit;
    const radiosity::ErrorEstimate error = audit.leaf_error.value_or(radiosity::ErrorEstimate{});
    const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::printf("%8u %8llu %9llu %9llu %9llu %9llu %8.1f %7.2f %7.2f   %5.2f %% +- %4.2f ", k, count(audit.clusters), count(audit.leaves),
                count(audit.links), count(audit.cluster_links), count(audit.rays), static_cast<double>(audit.bytes) * 1e-6,
                audit.cpu_seconds, audit.wall_seconds, 100.0 * error.relative_l2, 100.0 * error.standard_error);
    for (const radiosity::StageTime& stage : audit.stages) {
      if (stage.cpu_seconds > 0.02 * audit.cpu_seconds && stage.name != "audit") {
        std::printf(" %s %.2f", stage.name.c_str(), stage.cpu_seconds);
      }
    }
    if (options.threads > 1) { std::printf("  own %6.2f s", own); }
    const auto links = static_cast<double>(audit.links);
    if (before_k > 0.0) {
      const double octaves = std::log(k / before_k);
      std::printf("  %5.2f %5.2f", std::log(links / before_links) / octaves, std::log(audit.cpu_seconds / before_time) / octaves);
    }
    std::printf("\n");
    std::fflush(stdout);
    before_k = k;
    before_links = links;
    before_time = audit.cpu_seconds;
  }
}
