// SPDX-License-Identifier: MIT

// A user's oracle: one that repeats the rule of ours gives the same bits, from any number of threads, and one that never agrees still ends.

#include <algorithm>
#include <atomic>
#include <cstddef>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/bf_oracle.hpp>
#include <radiosity/oracle/cluster_oracle.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

using radiosity::Decision;
using radiosity::Options;
using radiosity::Question;
using radiosity::Solution;

namespace {

void check_same(const Solution& one, const Solution& other) {
  CHECK((one.radiosity == other.radiosity));  // not to be printed
  REQUIRE(one.links.size() == other.links.size());
  for (std::size_t i = 0; i < one.links.size(); ++i) {
    if (one.links[i].p != other.links[i].p || one.links[i].q != other.links[i].q || one.links[i].exchange != other.links[i].exchange) {
      FAIL("link " << i << " differs");
    }
  }
}

Options oracle_options() { return {.epsilon = 0.05, .min_area = 2e-3, .audit_points = 0}; }

// The rule of the F-oracle, written down again: input faces of many parts are split; patches are linked when the estimate is at most
// epsilon or both are small; else the larger one is split.
Decision by_the_paper(const Question& question) {
  const radiosity::Node &p = question.node_p(), &q = question.node_q();
  if (p.is_cluster() || q.is_cluster()) { return radiosity::ClusterOracle{}(question); }
  if (p.in_parts() && p.child_count > radiosity::most_linked_parts) { return Decision::split_p; }
  if (q.in_parts() && q.child_count > radiosity::most_linked_parts) { return Decision::split_q; }
  const bool small = p.area <= question.min_area && q.area <= question.min_area;
  if (small || radiosity::f_rule(p, q, question.epsilon, 0.0) == Decision::link) { return Decision::link; }
  return q.area > p.area * (1.0 + 0x1p-20) ? Decision::split_q : Decision::split_p;
}

}  // namespace

TEST_CASE("a user's oracle that repeats the rule of F-refinement gives the same bits, from any number of threads") {
  for (const radiosity::Scene& scene : {scenes::room_with_box(), scenes::furnace_with_things(0.5)}) {
    Options options = oracle_options();
    const Solution ours = scenes::solved(scene, options);
    std::atomic<std::size_t> asked{0};
    options.oracle = [&](const Question& question) {
      ++asked;
      return by_the_paper(question);
    };
    for (const unsigned threads : {1u, 2u}) {
      options.threads = threads;
      asked = 0;
      INFO(threads << " threads");
      check_same(ours, scenes::solved(scene, options));
      CHECK(asked > 100);
    }
    options.cluster_from = 2;  // pairs of clusters are asked about as well
    options.oracle = nullptr;
    const Solution clustered = scenes::solved(scene, options);
    options.oracle = radiosity::FOracle{};
    check_same(clustered, scenes::solved(scene, options));
  }
}

TEST_CASE("a user's oracle that repeats the rule of BF-refinement gives the same bits") {
  Options options{.refinement = radiosity::Refinement::a_posteriori, .target = 0.05, .audit_points = 0};
  const radiosity::Scene scene = scenes::room_with_box();
  const Solution ours = scenes::solved(scene, options);
  std::size_t of_links = 0, of_leaves = 0, of_others = 0;
  options.oracle = [&](const Question& question) {
    const bool errs = question.error != nullptr && question.error->sum() > 0.0f;
    ++(!errs ? of_others : question.p == question.q ? of_leaves : of_links);
    return radiosity::BfOracle{}(question);
  };
  check_same(ours, scenes::solved(scene, options));
  CHECK(of_links > 0);
  CHECK(of_leaves > 0);
  CHECK(of_others == 0);
}

TEST_CASE("an oracle that always asks for a split ends at min_area, one that always links leaves the input faces as they are") {
  const radiosity::Scene scene = scenes::two_plates(0.5);
  Options options = oracle_options();
  options.light_epsilon = 1e9;
  options.oracle = [](const Question& question) {
    return question.node_p().area >= question.node_q().area ? Decision::split_p : Decision::split_q;
  };
  const Solution fine = scenes::solved(scene, options);
  double total = 0.0, largest = 0.0;
  for (const radiosity::Node& node : fine.hierarchy) {
    if (node.parent == radiosity::no_node) { total += node.area; }
    if (node.leaf()) { largest = std::max(largest, node.area); }
  }
  CHECK(largest <= 4.0 * options.min_area * total * (1.0 + 1e-12));  // quarters would be smaller than min_area
  options.oracle = [](const Question&) { return Decision::link; };
  const Solution whole = scenes::solved(scene, options);
  CHECK(whole.links.size() == 1);
  CHECK(whole.hierarchy.size() == 2);
}
