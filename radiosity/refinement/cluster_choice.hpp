// SPDX-License-Identifier: MIT
#pragma once

// Decides which runs build clusters above their input faces, and words the failure of a run that would need too many links.

#include <cstddef>
#include <cstdint>
#include <string>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/scene/options.hpp>

namespace radiosity {

struct ClusterChoice {
  bool build = false;
  std::string reason;  // why no clusters are built; empty when they are
};

[[nodiscard]] inline ClusterChoice choose_clusters(std::size_t input_faces, const Options& options) {
  if (options.solver == Solver::gauss_seidel || options.solver == Solver::southwell) {
    return {false, "Gauss-Seidel and Southwell go through the scene input face by input face"};
  }
  if (input_faces < 2 || input_faces < options.cluster_from) {
    return {false,
            "they pay from some " + std::to_string(options.cluster_from) + " input faces on, there are " + std::to_string(input_faces)};
  }
  return {true, {}};
}

// `links`: lower bound of the number that would be needed.
[[nodiscard]] inline std::string too_many_links(std::uint64_t links, const ClusterChoice& clusters) {
  std::string sentence = "the run would need at least " + std::to_string(links / 1'000'000) + " million links, " +
                         std::to_string(links * sizeof(Link) / 1'000'000'000) + " GB; the limit is " +
                         std::to_string(link_limit / 1'000'000) + " million";
  sentence +=
      clusters.build ? "; a larger epsilon or min_area, or an error target, needs fewer" : "; no clusters were built: " + clusters.reason;
  return sentence;
}

}  // namespace radiosity
