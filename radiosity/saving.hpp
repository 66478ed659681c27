// SPDX-License-Identifier: MIT
#pragma once

// What a link would have cost that was left out: some links of the run are done once more as if nothing were known of them,
// and timed. Results never depend on it.

#include <algorithm>
#include <cstddef>
#include <ctime>

#include <radiosity/evaluate.hpp>
#include <radiosity/links.hpp>

namespace radiosity {

// Seconds of CPU time, averages; 0 when there is no link.
struct LinkCost {
  double form_factor = 0.0;
  double ray = 0.0;   // one segment
  double link = 0.0;  // all of it
};

// Times at most 256 links, spread evenly; a millisecond or two. To be called when no other thread works.
[[nodiscard]] inline LinkCost link_cost(const LinkEvaluator& evaluator, const Links& links) {
  const std::size_t count = std::min<std::size_t>(links.size(), 256);
  if (count == 0) { return {}; }
  const auto seconds = [](std::clock_t from) { return static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC; };
  const auto chosen = [&](std::size_t i) { return links[i * (links.size() / count)]; };
  RayCount rays;
  const std::clock_t start = std::clock();
  for (std::size_t i = 0; i < count; ++i) { rays += evaluator.segments(chosen(i)); }
  const double casting = seconds(start);
  const std::clock_t middle = std::clock();
  for (std::size_t i = 0; i < count; ++i) {
    Link link = chosen(i);
    (void)evaluator(link, {});
  }
  const double all = seconds(middle);
  const auto n = static_cast<double>(count);
  return {std::max(0.0, all - casting) / n, rays.cast > 0 ? casting / static_cast<double>(rays.cast) : 0.0, all / n};
}

}  // namespace radiosity
