// SPDX-License-Identifier: MIT
#pragma once

// Estimates the time saved by links that were left out: a sample of the links that were made is evaluated again, without any shortcut,
// and timed. Results never depend on it.

#include <algorithm>
#include <cstddef>
#include <ctime>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

// Seconds of CPU time, means over links between patches; 0 if there are none.
struct LinkCost {
  double form_factor = 0.0;
  double ray = 0.0;   // one segment
  double link = 0.0;  // the whole link
};

// Times at most 256 evenly spaced links; takes a millisecond or two. To be called while no other thread works.
[[nodiscard]] inline LinkCost link_cost(const LinkEvaluator& evaluator, const Links& links) {
  constexpr std::size_t most = 256;
  Links chosen;
  for (std::size_t i = 0; i < links.size(); i += 1 + links.size() / most) {
    if (evaluator.between_patches(links[i])) { chosen.push_back(links[i]); }
  }
  if (chosen.empty()) { return {}; }
  const auto seconds = [](std::clock_t from) { return static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC; };
  RayCount rays;
  const std::clock_t start = std::clock();
  for (const Link& link : chosen) { rays += evaluator.segments(link).rays; }
  const double casting = seconds(start);
  const std::clock_t middle = std::clock();
  for (Link& link : chosen) { (void)evaluator(link, {}); }
  const double all = seconds(middle);
  const auto n = static_cast<double>(chosen.size());
  return {std::max(0.0, all - casting) / n, rays.cast > 0 ? casting / static_cast<double>(rays.cast) : 0.0, all / n};
}

}  // namespace radiosity
