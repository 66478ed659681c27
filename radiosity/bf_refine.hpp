// SPDX-License-Identifier: MIT
#pragma once

// BF-refinement (paper 4.4): start with a very coarse mesh, solve, refine by what the links carry, repeat.
//
// The error of a link is estimated from what it cannot express (LinkShape) times the radiosity that it carries. For p receiving from q,
// with the irradiance H = G B_q / A_p and the deviation S = G s_q / A_p, s_q the standard deviation of B over q's leaves:
//
//     e_p^2 = A_p rho^2 H^2 (rest_p^2 + shadow_p^2 + [p is a leaf] (leaf_linear linear_p)^2)     mends: splitting p
//           + A_p rho^2 S^2 (rest_q^2 + shadow_q^2)                                             mends: splitting q
//
// summed over the channels, and the same for q receiving from p. An inner node passes the linear part of the light on to its children;
// a leaf does not, but the picture interpolates between leaves. The estimate of the whole is sqrt(sum of all e^2) over the norm of the
// reflected radiosity: errors of different links count as independent. In each generation the links with the largest errors are
// replaced by those of the children of the end that contributes most, until the estimate meets its target.
//
// Invariants: those of refine.hpp. Deterministic: links are evaluated in parallel, everything else goes in the order of the links.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <radiosity/evaluate.hpp>
#include <radiosity/exposure.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/options.hpp>
#include <radiosity/oracle.hpp>
#include <radiosity/refine.hpp>
#include <radiosity/scene.hpp>
#include <radiosity/solve.hpp>
#include <radiosity/surface.hpp>
#include <radiosity/transport.hpp>

namespace radiosity {

namespace detail {

// What the split of each end of a link would mend, squared.
struct LinkError {
  float p = 0.0f, q = 0.0f;
  [[nodiscard]] float sum() const { return p + q; }
};

// The part of the linear variation over a leaf that the picture, which interpolates between leaves, still misses.
inline constexpr double leaf_linear = 0.35;

struct NodeLight {
  Color mean{0.0};
  Color variance{0.0};  // over the leaves of the node
};

// `radiosity`: of every node, inner nodes area averages.
inline std::vector<NodeLight> light_of_nodes(const Hierarchy& hierarchy, const std::vector<double>& area,
                                             const std::vector<Color>& radiosity) {
  std::vector<NodeLight> light(hierarchy.size());
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    light[i].mean = radiosity[i];
    const Node& node = hierarchy[i];
    if (node.leaf() || !(area[i] > 0.0)) { continue; }
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      const Color off = radiosity[c] - radiosity[i];
      light[i].variance += area[c] / area[i] * (light[c].variance + off * off);
    }
  }
  return light;
}

// The errors of all links, and the norm of the reflected radiosity, squared.
struct ErrorEstimation {
  std::vector<LinkError> links;
  double sum = 0.0;
  double norm = 0.0;

  [[nodiscard]] double relative() const { return norm > 0.0 ? std::sqrt(sum / norm) : 0.0; }
};

inline ErrorEstimation estimate_errors(const Hierarchy& hierarchy, const Exposure& exposure, const Links& links,
                                       const std::vector<LinkShape>& shapes, const std::vector<Color>& reflectance,
                                       const std::vector<Color>& emission, const std::vector<Color>& radiosity) {
  ErrorEstimation result;
  const std::vector<double>& area = exposure.area;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    if (!hierarchy[i].leaf()) { continue; }
    const Color reflected = radiosity[i] - emission[hierarchy[i].surface];
    result.norm += area[i] * glm::dot(reflected, reflected);
  }
  const std::vector<NodeLight> light = light_of_nodes(hierarchy, area, radiosity);
  std::vector<Color> of_clusters;  // mean reflectance
  const auto rho = [&](const Node& node) { return node.is_cluster() ? of_clusters[node.cluster] : reflectance[node.surface]; };
  for (std::size_t i = hierarchy.size(); i-- > 0;) {
    const Node& node = hierarchy[i];
    if (!node.is_cluster()) { continue; }
    if (of_clusters.size() <= node.cluster) { of_clusters.resize(node.cluster + 1, Color{0.0}); }
    Color sum{0.0};
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) { sum += area[c] * rho(hierarchy[c]); }
    of_clusters[node.cluster] = area[i] > 0.0 ? sum / area[i] : sum;
  }
  const auto square = [](double x) { return x * x; };
  const auto unmended = [&](const LinkShape::End& shape, bool leaf) {  // of the light received
    return (leaf ? square(leaf_linear * shape.linear) : 0.0) + square(shape.rest) + square(shape.shadow);
  };
  result.links.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    const Node& p = hierarchy[link.p];
    const Node& q = hierarchy[link.q];
    const Color rho_p = rho(p);
    const Color rho_q = rho(q);
    const double g2 = square(link.exchange);
    const Color to_p = g2 / area[link.p] * rho_p * rho_p;
    const Color to_q = g2 / area[link.q] * rho_q * rho_q;
    const NodeLight& from_p = light[link.p];
    const NodeLight& from_q = light[link.q];
    const double sent_p = square(shapes[i].p.rest) + square(shapes[i].p.shadow);
    const double sent_q = square(shapes[i].q.rest) + square(shapes[i].q.shadow);
    const double mend_p =
        glm::dot(to_p, from_q.mean * from_q.mean) * unmended(shapes[i].p, p.leaf()) + glm::dot(to_q, from_p.variance) * sent_p;
    const double mend_q =
        glm::dot(to_q, from_p.mean * from_p.mean) * unmended(shapes[i].q, q.leaf()) + glm::dot(to_p, from_q.variance) * sent_q;
    result.links[i] = {static_cast<float>(mend_p), static_cast<float>(mend_q)};
    result.sum += mend_p + mend_q;
  }
  return result;
}

// The estimate for links that were not made by BF-refinement: the squared relative error of the links of lights, and of the others.
struct SampledEstimate {
  double light = 0.0, other = 0.0;

  [[nodiscard]] double relative() const { return std::sqrt(light + other); }
};

// From at most 1024 links of lights and 3072 others, spread evenly; their shapes are found now.
inline SampledEstimate sampled_estimate(const LinkEvaluator& evaluator, const Hierarchy& hierarchy, const Exposure& exposure,
                                        const Links& links, const std::vector<Color>& reflectance, const std::vector<Color>& emission,
                                        const std::vector<Color>& radiosity, unsigned threads) {
  const auto emits = [&](std::uint32_t i) { return !hierarchy[i].is_cluster() && !is_black(emission[hierarchy[i].surface]); };
  std::vector<std::uint32_t> of_lights, others;
  for (std::uint32_t i = 0; i < links.size(); ++i) { (emits(links[i].p) || emits(links[i].q) ? of_lights : others).push_back(i); }
  const auto squared = [&](const std::vector<std::uint32_t>& from, std::size_t most) {
    const std::size_t count = std::min(from.size(), most);
    Links sample(count);
    std::vector<LinkShape> shapes(count);
    parallel_for(count, threads, [&](std::size_t i) {
      sample[i] = links[from[i * from.size() / count]];
      const float closed = sample[i].exchange;
      (void)evaluator(sample[i], {}, &shapes[i]);
      sample[i].exchange = closed;
    });
    const ErrorEstimation errors = estimate_errors(hierarchy, exposure, sample, shapes, reflectance, emission, radiosity);
    const double relative = errors.relative();
    return count > 0 ? relative * relative * static_cast<double>(from.size()) / static_cast<double>(count) : 0.0;
  };
  return {squared(of_lights, 1024), squared(others, 3072)};
}

// The least error of a link that is to be refined: the links above it hold all of the sum but `keep`, within a factor of sqrt 2.
inline double refinement_threshold(const std::vector<LinkError>& errors, double keep) {
  constexpr int half_octaves = 512;
  std::array<double, half_octaves> held{};
  const auto bin = [](double error) {
    return std::clamp(static_cast<int>(std::floor(2.0 * std::log2(error))) + half_octaves / 2, 0, half_octaves - 1);
  };
  for (const LinkError& e : errors) {
    if (e.sum() > 0.0f) { held[static_cast<std::size_t>(bin(e.sum()))] += e.sum(); }
  }
  double sum = 0.0;
  int b = 0;
  while (b < half_octaves && (sum += held[static_cast<std::size_t>(b)]) <= keep) { ++b; }
  return std::exp2((b - half_octaves / 2) / 2.0);
}

// The error of the link of this rank, largest first; 0 beyond the last.
inline double error_of_rank(const std::vector<LinkError>& errors, std::size_t rank) {
  if (rank >= errors.size()) { return 0.0; }
  std::vector<float> sums;
  sums.reserve(errors.size());
  for (const LinkError& e : errors) { sums.push_back(e.sum()); }
  std::nth_element(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(rank), sums.end(), std::greater<>{});
  return sums[rank];
}

}  // namespace detail

struct BfResult {
  RefineResult refined;
  EvaluateResult evaluated;
  std::uint64_t evaluations = 0;  // of links
  std::uint32_t generations = 0;
  double estimate = 0.0;  // relative L2 error
  bool interrupted = false;
};

// Seconds that refinement may take, from some beginning.
class Deadline {
 public:
  explicit Deadline(std::optional<double> seconds) : seconds_{seconds} {}

  // How many links can be evaluated in what is left, when `links` were until now; the last solution takes its part.
  [[nodiscard]] std::size_t links_left(std::uint64_t links) const {
    if (!seconds_) { return std::numeric_limits<std::size_t>::max(); }
    constexpr double for_solution = 0.2;
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double left = (1.0 - for_solution) * *seconds_ - spent;
    return left > 0.0 ? static_cast<std::size_t>(left / spent * static_cast<double>(links)) : 0;
  }
  [[nodiscard]] bool limited() const { return seconds_.has_value(); }

 private:
  std::optional<double> seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Links, evaluated, and leaves such that the estimated relative error is at most `target`, or, with a limit, as many as the deadline
// allows. Stops before when there is nothing left to split, at 2^-24 of the scene's area, or when there would be more than `most_links`.
[[nodiscard]] inline BfResult bf_refine(const Scene& scene, const raycast::Scene& objects, const Plan& plan,
                                        const std::vector<Color>& reflectance, const std::vector<Color>& emission,
                                        std::vector<Surface>& surfaces, Hierarchy& hierarchy, Patches& patches, Exposure& exposure,
                                        const LinkEvaluator& evaluator, double target, const Deadline& deadline, std::size_t most_links,
                                        unsigned threads, std::uint64_t seed, const Control& control = {}) {
  constexpr double first_epsilon = 0.25;
  BfResult result;
  result.refined = refine(scene, objects, plan, surfaces, hierarchy, patches, first_epsilon, 1e-3, 0.0, threads, seed, control);
  if (result.refined.cancelled || result.refined.too_many) { return result; }
  double scene_area = 0.0;
  for (const Node& node : hierarchy) { scene_area += node.parent == no_node ? node.area : 0.0; }
  const double min_area = 0x1p-24 * scene_area;
  std::vector<bool> sees_itself;
  sees_itself.resize(hierarchy.size(), false);
  for (const std::uint32_t i : result.refined.inner) { sees_itself[i] = true; }
  std::vector<bool> stuck;

  Links& links = result.refined.links;
  std::vector<std::uint32_t>& lists = result.refined.lists;
  std::vector<LinkShape> shapes;
  DoubtSum removed;  // of links that carry nothing
  std::size_t evaluated = 0;
  for (;;) {
    patches.extend(threads);
    extend(exposure, objects, surfaces, hierarchy, patches, threads, seed);
    const std::size_t new_links = links.size() - evaluated;
    // Once there is a solution, a generation is brought to its end: half evaluated it would be none.
    const EvaluateResult round = evaluate(evaluator, result.refined.occluders, links, lists, evaluated, &shapes, threads,
                                          result.generations == 0 ? control : control.unstoppable());
    result.evaluations += new_links;
    result.evaluated.rays += round.rays;
    result.evaluated.proven_clear += round.proven_clear;
    result.evaluated.blocked += round.blocked;
    removed.add(round.doubt);
    result.evaluated.doubt = removed;
    for (std::size_t i = 0; i < links.size(); ++i) { result.evaluated.doubt.add(links[i].p, links[i].q, shapes[i].doubt); }
    result.evaluated.cancelled = round.cancelled;
    if (round.cancelled) { return result; }

    Transport transport{hierarchy, links, exposure};
    if (plan.closed) { (void)transport.close(10.0, 1e-3); }
    const ColorSolution light =
        solve_channels(hierarchy, transport, exposure.area, reflectance, emission, plan.channels, Solver::conjugate_gradients, 1e-3, 40);
    const detail::ErrorEstimation errors =
        detail::estimate_errors(hierarchy, exposure, links, shapes, reflectance, emission, light.radiosity);
    result.estimate = errors.relative();
    if ((!deadline.limited() && result.estimate <= target) || links.size() > most_links) { return result; }
    if (control.cancelled()) {
      result.interrupted = true;
      return result;
    }
    const double excess = errors.sum - (deadline.limited() ? 0.0 : target * target * errors.norm);
    double threshold = detail::refinement_threshold(errors.links, errors.sum - std::min(0.8 * errors.sum, 1.1 * excess));
    if (deadline.limited()) {
      const std::size_t most = deadline.links_left(result.evaluations) / 4;  // a link that is refined becomes four
      if (50 * most < links.size()) { return result; }
      threshold = std::max(threshold, detail::error_of_rank(errors.links, most));
    }

    // Which end of which link is to be split.
    enum class Split : std::uint8_t { none, p, q };
    std::vector<Split> splits(links.size(), Split::none);
    std::vector<bool> asked(hierarchy.size(), false);
    const auto can_split = [&](std::uint32_t i) {
      return !hierarchy[i].leaf() || (hierarchy[i].area > min_area && !(i < stuck.size() && stuck[i]));
    };
    bool any = false;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const detail::LinkError& e = errors.links[i];
      if (e.sum() < threshold) { continue; }
      const bool p_first = e.p >= e.q;
      const std::uint32_t first = p_first ? links[i].p : links[i].q;
      const std::uint32_t second = p_first ? links[i].q : links[i].p;
      if (can_split(first)) {
        splits[i] = p_first ? Split::p : Split::q;
        asked[first] = true;
      } else if (can_split(second) && std::min(e.p, e.q) >= 0.25f * e.sum()) {
        splits[i] = p_first ? Split::q : Split::p;
        asked[second] = true;
      }
      any = any || splits[i] != Split::none;
    }
    if (!any) { return result; }

    const auto before = static_cast<std::uint32_t>(hierarchy.size());
    std::vector<detail::Pair> pairs;
    stuck.resize(before, false);
    for (std::uint32_t i = 0; i < before; ++i) {
      if (!asked[i] || !hierarchy[i].leaf()) { continue; }
      if (!subdivide(surfaces, hierarchy, i)) {
        stuck[i] = true;
        continue;
      }
      sees_itself.resize(hierarchy.size(), sees_itself[i]);
      if (!sees_itself[i]) { continue; }
      const std::uint32_t first = hierarchy[i].first_child, last = first + hierarchy[i].child_count;
      for (std::uint32_t a = first; a < last; ++a) {
        for (std::uint32_t b = a + 1; b < last; ++b) { pairs.push_back({a, b}); }
      }
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const std::uint32_t split = splits[i] == Split::p ? links[i].p : links[i].q;
      const std::uint32_t other = splits[i] == Split::p ? links[i].q : links[i].p;
      if (splits[i] == Split::none || hierarchy[split].leaf()) {
        shapes[kept] = shapes[i];
        lists[kept] = lists[i];
        links[kept++] = links[i];
        continue;
      }
      for (std::uint32_t k = 0; k < hierarchy[split].child_count; ++k) {
        pairs.push_back({hierarchy[split].first_child + k, other, lists[i]});
      }
    }
    links.resize(kept);
    lists.resize(kept);
    shapes.resize(kept);
    evaluated = kept;
    patches.extend(threads);
    const std::vector<Decision> decisions = detail::decide(
        pairs, objects, plan, patches, result.refined, threads,
        [&](std::uint32_t p, std::uint32_t q) { return f_oracle(hierarchy[p], hierarchy[q], 1.0, min_area); },
        [](std::size_t, const raycast::OccluderList&, Decision&) {});
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (decisions[i] < first_seeing) { continue; }
      links.push_back({pairs[i].p, pairs[i].q});
      lists.push_back(pairs[i].list);
    }
    ++result.generations;
    if (control.after_generation) { control.after_generation(surfaces); }
    control.report("refine", std::min(1.0, target / result.estimate));
  }
}

}  // namespace radiosity
