// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <brep/circulators.hpp>
#include <brep/dual.hpp>
#include <brep/euler_script_parse.hpp>
#include <brep/isomorphism.hpp>
#include <brep/validate.hpp>

#include "apps/euler/story.hpp"
#include "apps/exercise/exercises.hpp"
#include "embedded/examples.hpp"

namespace apps::exercise {
namespace {

using Fault = std::optional<std::string>;
using euler::Solid;

struct Moment {
  long v = 0, e = 0, f = 0, shells = 0, handles = 0;
  std::multiset<std::size_t> degrees;  // number of edges of each face; empty if records are damaged
  std::set<int> broken;                // rules of the validator
};

struct Played {
  brep::Script script;
  Solid solid;
  std::vector<Moment> moments;  // after each statement that is not an `expect`
};

std::string at(const brep::Place& place) { return "line " + std::to_string(place.line) + ": "; }

Fault play(const std::string& text, Played& played) {
  brep::ScriptResult parsed = brep::parse_script(text);
  if (!parsed.script) {
    const brep::ScriptError& e = parsed.errors.front();
    return at(e.place) + e.sentence + euler::meant_in(text, e.place.line);
  }
  played.script = std::move(*parsed.script);
  euler::Teller teller(played.solid, false);
  for (const brep::Statement& statement : played.script.statements) {
    teller.tell(statement);
    if (!teller.story().errors.empty()) { return at(statement.place) + teller.story().errors.front().sentence; }
    if (statement.command == brep::Command::expect) { continue; }
    const euler::Frame& frame = teller.story().frames.back();
    Moment moment{frame.drawn.v, frame.drawn.e, frame.drawn.f, frame.shells, frame.handles, {}, {}};
    for (const brep::Fault& fault : brep::validate(played.solid)) { moment.broken.insert(fault.rule); }
    if (moment.broken.empty()) {
      for (const brep::FaceId f : brep::faces(played.solid)) { moment.degrees.insert(brep::degree(played.solid, f)); }
    }
    played.moments.push_back(std::move(moment));
  }
  if (played.moments.empty()) { return "there is no step yet"; }
  return std::nullopt;
}

Fault one_shell(const Played& played) {
  const Moment& end = played.moments.back();
  if (!end.broken.empty()) { return "at the end the records are damaged"; }
  if (end.shells != 1) { return "at the end there are " + std::to_string(end.shells) + " shells, not one"; }
  return std::nullopt;
}

// The script must begin with the steps of the initial file.
Fault kept(const Played& played, std::size_t number) {
  const brep::Script start = *brep::parse_script(beginning(all()[number - 1])).script;
  for (std::size_t i = 0; i < start.statements.size(); ++i) {
    const bool same = i < played.script.statements.size() && played.script.statements[i].text == start.statements[i].text;
    if (!same) { return "step " + std::to_string(i + 1) + " is not that of the beginning, `" + start.statements[i].text + "`"; }
  }
  return std::nullopt;
}

Fault no_undo(const Played& played) {
  for (const brep::Statement& s : played.script.statements) {
    const bool undoes = s.command == brep::Command::undo || s.command == brep::Command::redo;
    if (undoes) { return at(s.place) + "undo and redo are not allowed here"; }
  }
  return std::nullopt;
}

constexpr std::array<Exercise, 12> exercises{{
    {"01_tetrahedron.euler", "a tetrahedron from nothing", tetrahedron},
    {"02_torus.euler", "the torus of least edges", torus},
    {"03_holes.euler", "a pothole, then a hole through the cube", holes},
    {"04_dual.euler", "the dual of a prism", dual_of_prism},
    {"05_inverse.euler", "undo by inverse operators", inverse},
    {"06_break.euler", "break records and mend them", break_and_mend},
    {"07_split_edge.hpp", "split_edge written with split_vertex", nullptr},
    {"08_oracle.hpp", "an oracle of your own", nullptr},
    {"09_split_object.hpp", "a split object of your own", nullptr},
    {"10_form_factors.txt", "form factors of two plates by hand", form_factors},
    {"11_push_pull.txt", "push and pull by hand on three patches", push_pull},
    {"12_t_vertex.txt", "why a T-vertex shows", t_vertex},
}};

struct Rules {
  std::size_t kept = 0;  // the script must begin with the steps of this exercise; 0: of none
  bool undo = true;      // is it allowed?
  bool one_shell = true;
};

// Reports the first fault: in the script, against the rules, or found by `rest`.
template <class Rest>
Fault judge(const std::string& text, const Rules& rules, const Rest& rest) {
  Played played;
  Fault fault = play(text, played);
  if (!fault && rules.kept > 0) { fault = kept(played, rules.kept); }
  if (!fault && !rules.undo) { fault = no_undo(played); }
  if (!fault && rules.one_shell) { fault = one_shell(played); }
  return fault ? fault : rest(played);
}

}  // namespace

std::span<const Exercise> all() { return exercises; }

std::string beginning(const Exercise& exercise) { return embedded::example(std::string("exercises/") + exercise.file); }

Fault tetrahedron(const std::string& text) {
  return judge(text, {}, [](const Played& played) -> Fault {
    for (const brep::FaceId f : brep::faces(played.solid)) {
      const std::size_t edges = brep::degree(played.solid, f);
      if (edges != 3) { return to_string(f) + " is no triangle: it has " + std::to_string(edges) + " edges"; }
    }
    for (const brep::VertexId v : brep::vertices(played.solid)) {
      const std::size_t edges = brep::degree(played.solid, v);
      if (edges != 3) { return std::to_string(edges) + " edges meet in " + to_string(v); }
    }
    const bool sphere = played.moments.back().handles == 0 && played.solid.vertex_count() == 4;
    return sphere ? Fault() : Fault("triangles alone, but not those of a tetrahedron");
  });
}

Fault torus(const std::string& text) {
  return judge(text, {}, [](const Played& played) -> Fault {
    const Moment& end = played.moments.back();
    if (end.handles != 1) { return "it has " + std::to_string(end.handles) + " handles; a torus has one"; }
    if (end.v > 1 || end.f > 1) { return std::to_string(end.e) + " edges: a torus can do with fewer"; }
    return std::nullopt;
  });
}

Fault holes(const std::string& text) {
  return judge(text, {.kept = 3}, [](const Played& played) -> Fault {
    const auto pothole = [](const Moment& m) {  // floor; five faces of the cube and three walls; lid, tie and rim
      return m.shells == 1 && m.handles == 0 && m.degrees == std::multiset<std::size_t>{3, 4, 4, 4, 4, 4, 4, 4, 4, 9};
    };
    if (std::none_of(played.moments.begin(), played.moments.end(), pothole)) {
      return "no step shows the pothole: a rim of three edges tied to a corner of the lid, three walls and a floor";
    }
    const long handles = played.moments.back().handles;
    if (handles != 1) { return "at the end there are " + std::to_string(handles) + " handles: nothing leads through the cube once"; }
    std::size_t large = 0;
    for (const brep::FaceId f : brep::faces(played.solid)) { large += brep::degree(played.solid, f) > 4 ? 1 : 0; }
    if (large > 1) { return std::to_string(large) + " faces have more than four edges"; }
    for (const brep::VertexId v : brep::vertices(played.solid)) {
      if (brep::degree(played.solid, v) < 3) { return "fewer than three edges meet in " + to_string(v); }
    }
    return std::nullopt;
  });
}

Fault dual_of_prism(const std::string& text) {
  constexpr const char* prism =
      "h0 = make_segment\nh2 = split_vertex h1 h1\nh4 = split_face h3 h0\nh6 = split_vertex h1 h1\nh8 = split_vertex h3 h3\n"
      "h10 = split_vertex h5 h5\nh12 = split_face h7 h11\nh14 = split_face h11 h9\nh16 = split_face h9 h12\n";
  return judge(text, {}, [](const Played& played) -> Fault {
    Played of;
    static_cast<void>(play(prism, of));
    if (brep::find_isomorphism(of.solid, played.solid)) { return "this is the prism itself"; }
    const auto dual = brep::dual(of.solid);
    const auto same = [&](brep::Orientation way) { return brep::find_isomorphism(dual.brep, played.solid, way).has_value(); };
    if (same(brep::Orientation::kept) || same(brep::Orientation::reversed)) { return std::nullopt; }
    return "this is not the dual of the prism: count the faces of the prism, and the edges that meet in each of its vertices";
  });
}

Fault inverse(const std::string& text) {
  return judge(text, {.kept = 5, .undo = false}, [](const Played& played) -> Fault {
    const brep::Script start = *brep::parse_script(beginning(all()[4])).script;
    Solid triangle;
    brep::ScriptRunner<Solid> runner(triangle);
    for (std::size_t i = 0; i < 3; ++i) { static_cast<void>(runner.run(start.statements[i])); }
    const std::string difference = brep::difference(played.solid, triangle);
    if (difference.empty()) { return std::nullopt; }
    return "this is not the triangle: " + difference.substr(0, difference.find('\n'));
  });
}

Fault break_and_mend(const std::string& text) {
  return judge(text, {.kept = 6, .undo = false, .one_shell = false}, [](const Played& played) -> Fault {
    std::size_t most = 0;
    for (const Moment& moment : played.moments) { most = std::max(most, moment.broken.size()); }
    if (most < 3) { return "at most " + std::to_string(most) + " different rules were broken at one moment"; }
    const std::set<int>& broken = played.moments.back().broken;
    if (!broken.empty()) { return "at the end R" + std::to_string(*broken.begin()) + " is still broken"; }
    const bool asked = played.script.statements.back().command == brep::Command::expect;
    return asked ? Fault() : Fault("the script does not ask the validator at the end (`expect valid`)");
  });
}

}  // namespace apps::exercise
