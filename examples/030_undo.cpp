// SPDX-License-Identifier: MIT
//
// Euler operators refuse what cannot be done and say why; a BRep with a log can take everything back.

#include <cstdio>

#include <brep/brep.hpp>
#include <brep/euler_log.hpp>
#include <brep/euler_script_text.hpp>
#include <brep/handles.hpp>
#include <brep/shells.hpp>

namespace {

struct Vertex {  // the attributes are the user's own types
  double x = 0.0, y = 0.0;
};

using Solid = brep::BRep<Vertex, brep::NoData, brep::NoData, brep::EulerLog>;

void print(const Solid& solid) {
  std::printf("v %zu e %zu f %zu s %zu\n", solid.vertex_count(), solid.edge_count(), solid.face_count(), brep::shells(solid).size());
}

}  // namespace

int main() {
  Solid solid;
  const brep::HalfedgeId h = *brep::make_segment(solid);
  const auto refused = brep::join_faces(solid, h);  // nothing changes
  std::puts(refused.refusal().sentence().c_str());

  const std::size_t segment = brep::mark(solid);
  const brep::HalfedgeId n = *brep::split_edge(solid, h);
  const auto triangle = brep::split_face(solid, brep::twin(n), h);
  print(solid);
  if (!triangle) { return 1; }

  brep::undo_to(solid, segment);  // every record as it was
  print(solid);
  while (brep::redo(solid)) {}
  print(solid);
  std::fputs(brep::to_text(brep::steps(solid)).c_str(), stdout);  // the log is a script: halflight euler draws it
}
