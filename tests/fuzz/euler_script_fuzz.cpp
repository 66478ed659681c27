// SPDX-License-Identifier: MIT
// libFuzzer target: any text as a script of Euler operators (brep/euler_script.hpp).
//
// After every statement the records are valid and v - e + f = 2(s - h) with h >= 0, unless a raw edit stands. In the end undo leads
// back to nothing, redo to the same records, and the log, written as a script, makes the same records in another BRep. Grown
// solids are left alone beyond max_edges, so that a run takes well under a millisecond.

#include <brep/brep.hpp>
#include <brep/circulators.hpp>
#include <brep/euler_log.hpp>
#include <brep/euler_script.hpp>
#include <brep/euler_script_parse.hpp>
#include <brep/euler_script_run.hpp>
#include <brep/euler_script_text.hpp>
#include <brep/handles.hpp>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using Solid = brep::BRep<brep::NoData, brep::NoData, brep::NoData, brep::EulerLog>;
constexpr std::size_t max_edges = 64, max_statements = 200;

void demand(bool law, const char* sentence) {
  if (law) { return; }
  std::fprintf(stderr, "broken: %s\n", sentence);
  std::abort();
}

void check(const Solid& solid) {
  const auto faults = brep::validate(solid);
  demand(faults.empty(), faults.empty() ? "" : faults.front().sentence.c_str());
  const long euler =
      static_cast<long>(solid.vertex_count()) - static_cast<long>(solid.edge_count()) + static_cast<long>(solid.face_count());
  const long h = brep::genus(solid);
  demand(h >= 0 && euler == 2 * (static_cast<long>(brep::shell_count(solid)) - h), "v - e + f = 2(s - h)");
}

std::vector<std::uint32_t> records(const Solid& solid) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < solid.halfedge_end(); ++i) {
    const brep::HalfedgeId h{i};
    if (!solid.alive(h)) { continue; }
    all.insert(all.end(), {i, solid.next(h).index, solid.prev(h).index, solid.vertex(h).index, solid.face(h).index});
  }
  for (brep::VertexId v : brep::vertices(solid)) { all.insert(all.end(), {v.index, solid.halfedge(v).index}); }
  for (brep::FaceId f : brep::faces(solid)) { all.insert(all.end(), {f.index, solid.halfedge(f).index}); }
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const brep::ScriptResult parsed = brep::parse_script({reinterpret_cast<const char*>(data), size});
  demand(parsed.script.has_value() != !parsed.errors.empty(), "a script or errors");
  if (!parsed.script) { return 0; }
  Solid solid;
  brep::ScriptRunner<Solid> runner(solid);
  std::size_t done = 0;
  for (const brep::Statement& s : parsed.script->statements) {
    if (++done > max_statements || solid.edge_count() >= max_edges) { break; }
    const brep::Outcome outcome = runner.run(s);
    demand(outcome.kind == brep::Outcome::Kind::done || !outcome.sentence.empty(), "a refusal has a sentence");
    if (!runner.damaged()) { check(solid); }
  }
  brep::Statement repair;
  repair.command = brep::Command::undo;
  while (runner.damaged()) { static_cast<void>(runner.run(repair)); }
  check(solid);

  const auto end = records(solid);
  const std::string text = brep::to_text(brep::steps(solid));
  Solid again;
  const brep::ScriptResult log = brep::parse_script(text);
  demand(log.script && !brep::run_script(*log.script, again) && records(again) == end, "a log replays to the same records");
  const std::size_t mark = brep::mark(solid);
  while (brep::undo(solid)) { check(solid); }
  demand(solid.vertex_count() + solid.edge_count() + solid.face_count() == 0, "undo of all is nothing");
  demand(brep::undo_to(solid, mark) && records(solid) == end, "redo of all is the same");
  return 0;
}
