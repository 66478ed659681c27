// SPDX-License-Identifier: MIT
#include <brep/euler.hpp>

// At the vertex where h ends, its twin alone goes to the new vertex. A spur is the exception: there split_vertex grows the next edge.
template <class B>
brep::HalfedgeId split_edge_of_mine(B& solid, brep::HalfedgeId h) {
  (void)brep::split_vertex(solid, brep::twin(h), solid.next(h));
  return solid.next(h);
}
