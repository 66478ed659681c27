// SPDX-License-Identifier: MIT
#include <radiosity/solver/iteration.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE double Channel::norm(const std::vector<double>& r) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (counts(i)) { sum += (*area)[i] * r[i] * r[i]; }
  }
  return std::sqrt(sum);
}

HALFLIGHT_INLINE double Channel::rounding(const std::vector<double>& b) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (counts(i) && reflectance[i] > 0.0) { sum += (*area)[i] * b[i] * b[i]; }
  }
  return 16.0 * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

HALFLIGHT_INLINE Progress::Progress(const Channel& channel) : start{channel.norm(channel.emission)}, best{channel.emission} {
  std::vector<double> r;
  channel.residual(channel.emission, r);
  reflected = channel.norm(r);
}

HALFLIGHT_INLINE void Progress::offer(const std::vector<double>& b, double norm) {
  history.push_back(start > 0.0 ? norm / start : 0.0);
  if (norm < best_norm) {
    best = b;
    best_norm = norm;
  }
}

HALFLIGHT_INLINE LinearSolution finish(const Channel& channel, Progress progress, std::uint32_t iterations, double wanted) {
  LinearSolution solution;
  solution.radiosity = std::move(progress.best);
  solution.residual = progress.start > 0.0 ? progress.best_norm / progress.start : 0.0;
  solution.iterations = iterations;
  solution.converged = progress.best_norm <= std::max(wanted * progress.reflected, channel.rounding(solution.radiosity));
  solution.history = std::move(progress.history);
  std::vector<double>& b = solution.radiosity;
  // If hardly any light arrives an iterate may be slightly negative, within its residual. A radiosity cannot be, so 0 is closer to the
  // truth.
  for (double& x : b) { x = std::max(x, 0.0); }
  for (std::size_t i = b.size(); i-- > 0;) {
    const Node& node = (*channel.hierarchy)[i];
    if (node.leaf()) { continue; }
    double sum = 0.0;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { sum += (*channel.area)[c] * b[c]; }
    b[i] = (*channel.area)[i] > 0.0 ? sum / (*channel.area)[i] : 0.0;
  }
  return solution;
}

}  // namespace detail

}  // namespace radiosity
