// SPDX-License-Identifier: MIT
#include <radiosity/refinement/bf_choice.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/bf_generation.hpp>
#include <radiosity/refinement/bf_goal.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/refinement/link_error.hpp>
#include <radiosity/support/memory.hpp>

namespace radiosity {

namespace detail {

// The least error of a link or leaf to be refined: the errors below it sum up to `keep`, within a factor of sqrt 2.
HALFLIGHT_INLINE double refinement_threshold(const std::vector<float>& links, const std::vector<float>& leaves, double keep) {
  constexpr int half_octaves = 512;
  std::array<double, half_octaves> held{};
  const auto bin = [](double error) {
    return std::clamp(static_cast<int>(std::floor(2.0 * std::log2(error))) + half_octaves / 2, 0, half_octaves - 1);
  };
  const auto count = [&](float error) {
    if (error > 0.0f) { held[static_cast<std::size_t>(bin(error))] += error; }
  };
  for (const float e : links) { count(e); }
  for (const float e : leaves) { count(e); }
  double sum = 0.0;
  int b = 0;
  while (b < half_octaves && (sum += held[static_cast<std::size_t>(b)]) <= keep) { ++b; }
  return std::exp2((b - half_octaves / 2) / 2.0);
}

// The error of the link with this rank, counted from the largest; 0 beyond the last.
HALFLIGHT_INLINE double error_of_rank(const std::vector<LinkError>& errors, std::size_t rank) {
  if (rank >= errors.size()) { return 0.0; }
  std::vector<float> sums;
  sums.reserve(errors.size());
  for (const LinkError& e : errors) { sums.push_back(e.sum()); }
  std::nth_element(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(rank), sums.end(), std::greater<>{});
  return sums[rank];
}

// The errors that splits may still reduce. `stays`: sum of errors above the threshold that cannot be split; these are removed from the
// lists.
struct OpenErrors {
  std::vector<float> of_links, of_leaves;
  double stays = 0.0;
};

// The oracle's question about a link between these nodes, or about a leaf (p == q). BF-refinement has no epsilon; errors decide.
HALFLIGHT_INLINE Question question_of(const BfState& state, std::uint32_t p, std::uint32_t q, const LinkError& error) {
  Question question{state.scene.hierarchy, p, q, state.scene.shown, 1.0, state.min_area, &state.stuck};
  question.error = &error;
  return question;
}

// Asks the oracle about each link whose error is at least the threshold.
HALFLIGHT_INLINE void choose_links(const BfState& state, const AnyOracle& oracle, const std::vector<LinkError>& errors, double threshold,
                                   OpenErrors& open, SplitChoice& choice) {
  for (std::size_t i = 0; i < state.links.size(); ++i) {
    if (!(open.of_links[i] >= threshold && open.of_links[i] > 0.0f)) { continue; }
    const Link& link = state.links[i].link;
    const Decision decision = oracle(question_of(state, link.p, link.q, errors[i]));
    if (decision == Decision::split_p || decision == Decision::split_q) {
      choice.ends[i] = decision;
      choice.asked[decision == Decision::split_p ? link.p : link.q] = true;
      ++choice.count;
    } else {
      open.stays += open.of_links[i];
      open.of_links[i] = 0.0f;
    }
  }
}

// Asks about leaves whose constant radiosity is too coarse, while the links of their ancestors suffice.
HALFLIGHT_INLINE void choose_leaves(const BfState& state, const AnyOracle& oracle, double threshold, OpenErrors& open,
                                    SplitChoice& choice) {
  for (std::uint32_t i = 0; i < state.scene.hierarchy.size(); ++i) {
    if (!(open.of_leaves[i] >= threshold && open.of_leaves[i] > 0.0f)) { continue; }
    const Decision decision = oracle(question_of(state, i, i, {open.of_leaves[i], 0.0f}));
    if (decision == Decision::split_p || decision == Decision::split_q) {
      choice.asked[i] = true;
      ++choice.count;
    } else {
      open.stays += open.of_leaves[i];
      open.of_leaves[i] = 0.0f;
    }
  }
}

// Chooses the largest errors first; if none of these can be split, those after them. Nothing if the rest is allowed or cannot be split.
// Errors below `least` are not split. `squeeze` > 1: fewer splits, those with the largest errors.
HALFLIGHT_INLINE std::optional<SplitChoice> choose_largest(const BfState& state, const AnyOracle& oracle, const BfErrors& errors,
                                                           double allowed, double least, double squeeze) {
  OpenErrors open;
  for (const LinkError& e : errors.links.links) { open.of_links.push_back(e.sum()); }
  open.of_leaves = errors.leaves;
  SplitChoice choice;
  choice.ends.assign(open.of_links.size(), Decision::link);
  choice.asked.assign(state.scene.hierarchy.size(), false);
  for (double left = errors.sum; choice.count == 0; left -= open.stays) {
    if (!(left > allowed)) { return std::nullopt; }
    const double keep = left - std::min(0.8 * left, 1.1 * (left - allowed));
    const double threshold = squeeze * std::max(least, refinement_threshold(open.of_links, open.of_leaves, keep));
    open.stays = 0.0;
    choose_links(state, oracle, errors.links.links, threshold, open, choice);
    choose_leaves(state, oracle, threshold, open, choice);
    if (choice.count == 0 && !(open.stays > 0.0)) { return std::nullopt; }
  }
  return choice;
}

// The counts after the choice has been carried out.
HALFLIGHT_INLINE MemoryBudget::Counts counts_after(const BfState& state, const SplitChoice& choice) {
  const Hierarchy& hierarchy = state.scene.hierarchy;
  const MeasuredLinks& links = state.links;
  const auto parts = [&](std::uint32_t i) { return hierarchy[i].leaf() ? hierarchy[i].corners : hierarchy[i].child_count; };
  const auto split_links =
      static_cast<std::size_t>(std::count_if(choice.ends.begin(), choice.ends.end(), [](Decision end) { return end != Decision::link; }));
  MemoryBudget::Counts counts{hierarchy.size(), links.size() - split_links, 0, state.result.refined.occluders.bytes()};
  for (std::uint32_t i = 0; i < hierarchy.size(); ++i) { counts.nodes += choice.asked[i] && hierarchy[i].leaf() ? parts(i) : 0; }
  for (std::size_t i = 0; i < links.size(); ++i) {
    counts.pairs += choice.ends[i] == Decision::link ? 0 : parts(choice.ends[i] == Decision::split_p ? links[i].link.p : links[i].link.q);
  }
  counts.links += counts.pairs;
  return counts;
}

HALFLIGHT_INLINE double allowed_error(const BfErrors& errors, const BfGoal& goal) {
  return goal.deadline.limited() ? 0.0 : goal.target * goal.target * errors.links.norm;
}

HALFLIGHT_INLINE bool is_last(const BfState& state, const BfErrors& errors, const BfGoal& goal) {
  const BfResult& result = state.result;
  // If no light has reached anything yet, go on for some generations: it may still be found.
  const bool dark = !(errors.links.norm > 0.0) && errors.sum > 0.0 && result.generations < 4;
  const bool good = !goal.deadline.limited() && result.estimate <= goal.target && !dark;
  return good || state.links.size() > link_limit;
}

HALFLIGHT_INLINE std::optional<SplitChoice> choose_splits(BfState& state, const BfErrors& errors, const BfGoal& goal) {
  const std::size_t links = state.links.size();
  const MemoryBudget& budget = state.scene.budget;
  double least = error_of_rank(errors.links.links, (link_limit - links) / 8);  // a split cluster has up to eight children
  if (goal.deadline.limited()) {
    const std::size_t most = goal.deadline.links_left(state.result.evaluations) / 4;  // a refined link becomes four
    if (50 * most < links) { return std::nullopt; }
    least = std::max(least, error_of_rank(errors.links.links, most));
  }
  for (double squeeze = 1.0;; squeeze *= 2.0) {  // until the memory suffices
    std::optional<SplitChoice> choice = choose_largest(state, goal.oracle, errors, allowed_error(errors, goal), least, squeeze);
    if (!choice || (squeeze > 1.0 && 50 * choice->count < links)) { return std::nullopt; }
    if (!budget.limited()) { return choice; }
    const MemoryBudget::Counts counts = counts_after(state, *choice);
    if (budget.allows(counts)) { return choice; }
    if (state.result.too_large == 0) { state.result.too_large = budget.peak(counts); }
  }
}

}  // namespace detail

}  // namespace radiosity
