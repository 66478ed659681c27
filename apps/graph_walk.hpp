// SPDX-License-Identifier: MIT
#pragma once

// A scene graph is walked. Its nodes stand under a root, and one node may stand in many places, so that what is used often exists once.
// The walk is depth first, in the order of the children, with a state that is handed on: what a node changes holds for all that comes
// behind it, until a node around it that keeps the changes of its children to itself is left.
//
// The groups and uses of a .scene file (scene_file/groups.cpp) and the nodes of VRML (vrml/traverse.cpp) are such graphs. What a node
// means is said by
//     bool enter(node, state)             changes the state, or does what there is to do; false: the walk is given up
//     children(node)                      a list of nodes
//     void leave(node, before, state)     takes changes back; `before` is the state before the node was entered

#include <cstddef>

namespace apps {

struct GraphLimits {
  std::size_t deepest = 200;            // nodes on the way from the root to a leaf
  std::size_t most_visits = 2'000'000;  // uses of uses multiply
};

template <class Meaning, class State>
class GraphWalk {
 public:
  GraphWalk(Meaning& meaning, GraphLimits limits) : meaning_(meaning), limits_(limits) {}

  // False: it was given up, by enter() or at a limit.
  template <class Node>
  bool visit(const Node& node, State& state, std::size_t depth = 0) {
    if (++visits_ > limits_.most_visits || depth > limits_.deepest) { return false; }
    const State before = state;
    if (!meaning_.enter(node, state)) { return false; }
    for (const Node& child : meaning_.children(node)) {
      if (!visit(child, state, depth + 1)) { return false; }
    }
    meaning_.leave(node, before, state);
    return true;
  }

 private:
  Meaning& meaning_;
  GraphLimits limits_;
  std::size_t visits_ = 0;
};

}  // namespace apps
