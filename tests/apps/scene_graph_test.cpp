// SPDX-License-Identifier: MIT
// The walk through a scene graph, whatever its nodes mean.
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "apps/graph_walk.hpp"
#include "catch.hpp"

namespace {

// Nodes are numbers; a node uses others with higher numbers. It puts its number behind the state, and every third keeps changes to itself.
struct Graph {
  std::vector<std::vector<std::size_t>> uses;
  std::vector<std::string> met;
  std::size_t stop = static_cast<std::size_t>(-1);

  bool enter(std::size_t node, std::string& state) {
    state += static_cast<char>('a' + node);
    met.push_back(state);
    return node != stop;
  }
  [[nodiscard]] const std::vector<std::size_t>& children(std::size_t node) const { return uses[node]; }
  void leave(std::size_t node, const std::string& before, std::string& state) const {
    if (node % 3 == 0) { state = before; }
  }

  // The same by its definition: the tree that results when every use is a copy.
  void expand(std::size_t node, std::string& state, std::vector<std::string>& list) const {
    const std::string before = state;
    state += static_cast<char>('a' + node);
    list.push_back(state);
    for (const std::size_t child : uses[node]) { expand(child, state, list); }
    if (node % 3 == 0) { state = before; }
  }
};

}  // namespace

TEST_CASE("scene graph: a node that is used often is met as often, each time with the state of that place") {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    Graph graph;
    graph.uses.resize(9);
    for (std::size_t node = 0; node < 9; ++node) {
      for (std::size_t k = random() % 3 + (node == 0 ? 1 : 0); k > 0 && node < 8; --k) {
        graph.uses[node].push_back(node + 1 + random() % (8 - node));
      }
    }
    std::vector<std::string> expected;
    std::string state, other;
    graph.expand(0, other, expected);
    CHECK(apps::GraphWalk<Graph, std::string>(graph, {}).visit(std::size_t{0}, state));
    CHECK(graph.met == expected);
    CHECK(state == other);
  }
}

TEST_CASE("scene graph: a walk that grows without end is given up, and so is one that a node ends") {
  Graph graph;
  for (std::size_t node = 0; node < 25; ++node) { graph.uses.push_back({node + 1, node + 1}); }  // 2^26 nodes when expanded
  graph.uses.emplace_back();
  std::string state;
  CHECK_FALSE(apps::GraphWalk<Graph, std::string>(graph, {200, 1000}).visit(std::size_t{0}, state));
  CHECK(graph.met.size() == 1000);
  graph.met.clear();
  CHECK_FALSE(apps::GraphWalk<Graph, std::string>(graph, {7, 1000}).visit(std::size_t{0}, state));
  CHECK(graph.met.size() == 8);
  graph.met.clear();
  graph.stop = 3;
  CHECK_FALSE(apps::GraphWalk<Graph, std::string>(graph, {200, 1000}).visit(std::size_t{0}, state));
  CHECK(graph.met.size() == 4);
}
