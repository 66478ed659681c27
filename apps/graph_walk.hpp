// SPDX-License-Identifier: MIT
#pragma once

// Walks a scene graph: its nodes have a common root, and one node may have several parents, so that repeated parts exist only once. The
// walk is depth first, in the order of the children, with a state that is passed on: a change made by a node holds for all nodes after
// it, until an ancestor that confines the changes of its children is left.
//
// The groups and uses of a .scene file (scene_file/groups.cpp) and the nodes of VRML (vrml/traverse.cpp) are such graphs. The caller
// defines the meaning of nodes by
//     bool enter(node, state)             changes the state or produces output; false ends the walk
//     children(node)                      a list of nodes
//     void leave(node, before, state)     undoes changes; `before` is the state before the node was entered

#include <cstddef>

namespace apps {

struct GraphLimits {
  std::size_t deepest = 200;            // largest number of nodes on a path from the root to a leaf
  std::size_t most_visits = 2'000'000;  // nested uses multiply
};

template <class Meaning, class State>
class GraphWalk {
 public:
  GraphWalk(Meaning& meaning, GraphLimits limits) : meaning_(meaning), limits_(limits) {}

  // False: enter() or a limit has ended the walk.
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
