// SPDX-License-Identifier: MIT
// Scripts of Euler operators: what is read, what is refused and where, running, and logs written as scripts.

#include <brep/euler_script_parse.hpp>
#include <brep/euler_script_run.hpp>
#include <brep/euler_script_text.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "shapes.hpp"

using namespace brep;

namespace {

using Solid = BRep<NoData, NoData, NoData, EulerLog>;
namespace fs = std::filesystem;

Script parse(const std::string& text) {
  ScriptResult result = parse_script(text);
  for (const ScriptError& e : result.errors) { UNSCOPED_INFO(e.place.line << ":" << e.place.column << ": " << e.sentence); }
  REQUIRE(result.script.has_value());
  return std::move(*result.script);
}

// "line:column: sentence" of each error.
std::string errors_of(const std::string& text) {
  std::string all;
  for (const ScriptError& e : parse_script(text).errors) {
    all += std::to_string(e.place.line) + ":" + std::to_string(e.place.column) + ": " + e.sentence + "\n";
  }
  return all;
}

// Where and why the script stops; empty when it runs to its end.
std::string run(const std::string& text, Solid& solid) {
  const auto error = run_script(parse(text), solid);
  return error ? std::to_string(error->place.line) + ": " + error->sentence : "";
}

const std::string cube_script =
    "h0 = make_segment\nh2 = split_vertex h1 h1\nh4 = split_vertex h3 h3\nh6 = split_face h5 h0\nh8 = split_vertex h1 h1\n"
    "h10 = split_vertex h3 h3\nh12 = split_vertex h5 h5\nh14 = split_vertex h7 h7\nh16 = split_face h9 h15\nh18 = split_face h15 h13\n"
    "h20 = split_face h13 h11\nh22 = split_face h11 h16\n";

std::vector<fs::path> lessons() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(HALFLIGHT_LESSONS)) {
    if (entry.path().extension() == ".euler") { paths.push_back(entry.path()); }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}
std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("a script of twelve lines is a cube") {
  Solid solid;
  CHECK(run(cube_script + "expect v 8 e 12 f 6 s 1 h 0\nexpect valid\n", solid) == "");
  CHECK(shapes::faults(solid) == "");
  for (FaceId f : faces(solid)) { CHECK(degree(solid, f) == 4); }
  for (VertexId v : vertices(solid)) { CHECK(degree(solid, v) == 3); }
}

TEST_CASE("names and functions stand for handles") {
  Solid a, b;
  CHECK(run("first = make_segment\nspur = split_vertex twin(first) next(first)\n"
            "f = split_face prev(next(twin(spur))) anchor(vertex(first))\nset_anchor next(anchor(face(spur)))\n",
            a) == "");
  CHECK(run("h0 = make_segment\nh2 = split_vertex h1 h1\nh4 = split_face h3 h0\nset_anchor h2\n", b) == "");
  CHECK(shapes::records(a) == shapes::records(b));
}

TEST_CASE("comments are captions, one at the head with an empty line behind it is the title") {
  const Script script = parse("# Title\n# more\n\n# one\n# two\n\n# three\nh0 = make_segment # four\r\n\r# end\n");
  CHECK(script.title == "Title");
  CHECK(script.introduction == "more");
  REQUIRE(script.statements.size() == 1);
  CHECK(script.statements[0].caption == "one\ntwo\n\nthree\nfour");
  CHECK(script.statements[0].text == "h0 = make_segment");
  CHECK(script.statements[0].place.line == 8);
  CHECK(script.closing == "end");
  CHECK(parse("").statements.empty());
  CHECK(parse("# only\n").closing == "only");
}

TEST_CASE("every error of a script is told with line, column and a sentence") {
  CHECK(errors_of("h0 = make_segment\nsplit_fase h0 h1\nh0 = make_segment x\nsplit_face h0\n") ==
        "2:1: found 'split_fase'; expected an operator such as split_face, or undo, redo, raw, expect, refused\n"
        "3:19: found 'x'; expected the end of the line: make_segment has no arguments\n"
        "4:14: found the end of the line; expected a half-edge: a handle, or a name that is defined above\n");
  const auto one = [](const std::string& line, const std::string& message) {
    INFO(line);
    CHECK(errors_of(line) == "1:" + message + "\n");
  };
  one("split_edge e3", "12: found 'e3'; expected a half-edge: a handle, or a name that is defined above");
  one("split_edge f3", "12: 'f3' is a face; expected a half-edge");
  one("split_edge top", "12: found 'top'; expected a half-edge: a handle, or a name that is defined above");
  one("split_edge next h0", "17: found 'h0'; expected '(' after next");
  one("split_edge next(h0", "19: found the end of the line; expected ')'");
  one("split_edge next(f0)", "17: 'f0' is a face; expected a half-edge");
  one("split_edge face(h0)", "12: face gives a face; expected a half-edge");
  one("split_edge anchor(h0)", "19: 'h0' is a half-edge; expected a face or a vertex");
  one("split_edge h99999999999", "12: found 'h99999999999'; expected a half-edge: a handle, or a name that is defined above");
  one("f0 = split_edge h0", "1: found 'f0'; expected a half-edge, the result of split_edge");
  one("next = split_edge h0", "1: found 'next'; expected a handle such as h0, or a name that is no other word of scripts");
  one("h0 = kill_segment h0", "1: kill_segment has no result; leave out 'h0' =");
  one("refused x = split_edge h0", "9: a refused operator has no result; leave out 'x' =");
  one("refused undo", "9: undo cannot be refused; expected an operator");
  one("split_face h0 h0 h0", "18: found 'h0'; expected the end of the line: split_face has two arguments");
  one("raw nxt h0 h1", "5: found 'nxt'; expected a field: next, prev, vertex, face or anchor");
  one("raw face h0 h1", "13: 'h1' is a half-edge; expected a face");
  one("raw anchor h0 h1", "12: 'h0' is a half-edge; expected a face or a vertex");
  one("expect", "7: found the end of the line; expected counts (v 8 e 12 f 6 s 1 h 0), rules (R1 to R8), or valid");
  one("expect v", "9: found the end of the line; expected a count");
  one("expect v 8 v 9", "12: found 'v'; expected each count once");
  one("expect R9", "8: found 'R9'; expected counts (v 8 e 12 f 6 s 1 h 0), rules (R1 to R8), or valid");
  one("expect R2 v 3", "11: found 'v'; expected a rule, R1 to R8");
  one("+", "1: found '+'; expected an operator such as split_face, or undo, redo, raw, expect, refused");
  one("undo\x01", "5: found a byte that is not text; expected UTF-8 without control characters");
  one("# \xff", "3: found a byte that is not text; expected UTF-8 without control characters");
}

TEST_CASE("reading ends after fifty errors, and depth costs no stack") {
  std::string noise;
  for (int i = 0; i < 1000; ++i) { noise += "?\n"; }
  CHECK(parse_script(noise).errors.size() == ScriptParser::max_errors);
  std::string deep = "make_segment\nsplit_edge ";
  for (int i = 0; i < 100000; ++i) { deep += "next("; }
  deep += "h0" + std::string(100000, ')');
  Solid solid;
  CHECK(run(deep, solid) == "");
  CHECK(errors_of(deep.substr(0, deep.size() - 1)).find("expected ')'") != std::string::npos);
}

TEST_CASE("strict running stops at the first statement that is not done as written, and says why") {
  const auto stops = [](const std::string& line, const std::string& why) {
    Solid solid;
    INFO(line);
    CHECK(run(cube_script + line + "\nexpect v 0\n", solid) == "13: " + why);
    CHECK(shapes::faults(solid) == "");
  };
  stops("split_face h0 h1", "split_face: h0 and h1 lie on different faces");
  stops("split_edge h24", "h24 does not exist: it was never made or is already killed");
  stops("split_edge next(h24)", "h24 does not exist: it was never made or is already killed");
  stops("split_edge anchor(f6)", "f6 does not exist: it was never made or is already killed");
  stops("set_anchor h2147483647", "h2147483647 does not exist: it was never made or is already killed");
  stops("h24 = split_edge h0", "the result is h25, but the script says h24");
  stops("refused split_edge h0", "split_edge was done, but the script says that it is refused");
  stops("redo", "there is nothing to redo");
  stops("expect v 8 e 11 f 6 h 1", "e is 12, not 11, h is 0, not 1");
  stops("expect R2", "no rule is broken");
  stops("raw next h24 h0", "h24 does not exist: it was never made or is already killed");
  Solid solid;
  CHECK(run("undo", solid) == "1: there is nothing to undo");
}

TEST_CASE("running goes on after a statement that failed, but its name has no value") {
  const Script script = parse("x = make_segment\nx = split_face x x\ny = cut h0\nsplit_edge anchor(y)\nx = bridge h0 h1\nsplit_edge x\n");
  Solid solid;
  ScriptRunner<Solid> runner(solid);
  std::vector<Outcome> outcomes;
  for (const Statement& s : script.statements) { outcomes.push_back(runner.run(s)); }
  CHECK((outcomes[1].result == Element(HalfedgeId{2})));
  CHECK(outcomes[2].kind == Outcome::Kind::refused);
  CHECK(outcomes[2].refusal.code == Code::spur);
  CHECK(outcomes[3].sentence == "'y' has no value: the statement that defines it was not done");
  CHECK(outcomes[4].kind == Outcome::Kind::refused);
  CHECK(outcomes[5].kind == Outcome::Kind::failed);
  CHECK(shapes::faults(solid) == "");
}

TEST_CASE("undo and redo in a script walk through the log") {
  Solid solid, straight;
  CHECK(run(cube_script + "undo\nundo\nexpect e 10\nredo\nredo\nexpect e 12\nundo\nh22 = split_face h11 h16\n", solid) == "");
  CHECK(run(cube_script, straight) == "");
  CHECK(shapes::records(solid) == shapes::records(straight));
}

TEST_CASE("while a raw edit stands no operator runs, the validator tells its faults, and undo repairs it") {
  Solid solid, sound;
  REQUIRE(run(cube_script, sound) == "");
  REQUIRE(run(cube_script, solid) == "");
  const Script script = parse(
      "raw next h0 h4\nexpect R2 R3\nraw vertex h3 v77\nsplit_edge h0\nset_anchor next(h3)\nexpect v 8\nexpect R7\nredo\nundo\n"
      "expect R1\nundo\nexpect valid\n");
  ScriptRunner<Solid> runner(solid);
  std::vector<Outcome> outcomes;
  for (const Statement& s : script.statements) { outcomes.push_back(runner.run(s)); }
  CHECK(outcomes[0].faults.size() > 1);
  CHECK(outcomes[1].as_written);
  CHECK(outcomes[2].faults.front().rule == 1);
  CHECK(outcomes[3].sentence == "a raw edit stands, and operators trust the records; `undo` takes it back");
  CHECK(outcomes[4].kind == Outcome::Kind::failed);
  CHECK(outcomes[5].sentence.find("the records are not valid: R1: ") == 0);
  CHECK(outcomes[6].sentence.find("the rules that are broken are R1") == 0);
  CHECK(outcomes[7].kind == Outcome::Kind::failed);
  CHECK(outcomes[9].sentence == "the rules that are broken are R2 R3");
  CHECK(outcomes[11].as_written);
  CHECK(shapes::records(solid) == shapes::records(sound));
}

TEST_CASE("a log written as a script makes the same BRep, record for record") {
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Solid solid;
    for (int i = 0; i < 200; ++i) {
      const auto all = shapes::all_halfedges(solid);
      if (all.empty() || random.below(40) == 0) {
        REQUIRE(make_segment(solid));
        continue;
      }
      const auto any = [&] { return all[random.below(all.size())]; };
      const HalfedgeId a = any();
      switch (random.below(12)) {
        case 0:
          static_cast<void>(join_faces(solid, a));
          break;
        case 1:
          static_cast<void>(join_vertices(solid, a));
          break;
        case 2:
          static_cast<void>(cut(solid, a));
          break;
        case 3:
          static_cast<void>(unweld(solid, a));
          break;
        case 4:
          static_cast<void>(kill_segment(solid, a));
          break;
        case 5:
          solid.set_anchor(solid.face(a), a);
          break;
        case 6:
          static_cast<void>(split_edge(solid, a));
          break;
        case 7:
          static_cast<void>(bridge(solid, a, any()));
          break;
        case 8:
          static_cast<void>(weld(solid, a, any()));
          break;
        case 9:
          static_cast<void>(split_vertex(solid, a, solid.next(twin(a))));
          break;
        default:
          static_cast<void>(split_face(solid, a, solid.next(solid.next(a))));
      }
    }
    const std::string text = to_text(steps(solid));
    Solid again;
    REQUIRE(run(text, again) == "");
    CHECK(shapes::records(again) == shapes::records(solid));
    CHECK(to_text(steps(again)) == text);
  }
}

TEST_CASE("every lesson runs as written, forward and back to nothing") {
  const auto paths = lessons();
  REQUIRE(paths.size() >= 7);
  for (const fs::path& path : paths) {
    INFO(path.filename().string());
    const Script script = parse(content(path));
    CHECK_FALSE(script.title.empty());
    CHECK_FALSE(script.introduction.empty());
    REQUIRE_FALSE(script.statements.empty());
    CHECK(script.statements.back().command == Command::expect);
    CHECK(script.statements.back().counts[0].has_value());
    Solid solid;
    const auto error = run_script(script, solid);
    INFO((error ? std::to_string(error->place.line) + ": " + error->sentence : ""));
    REQUIRE_FALSE(error.has_value());
    CHECK(shapes::faults(solid) == "");
    std::vector<std::vector<std::uint32_t>> states{shapes::records(solid)};
    while (undo(solid)) {
      REQUIRE(shapes::faults(solid) == "");
      states.push_back(shapes::records(solid));
    }
    CHECK((solid.vertex_count() == 0 && solid.edge_count() == 0 && solid.face_count() == 0));
    for (std::size_t i = states.size() - 1; i-- > 0;) {
      REQUIRE(redo(solid));
      CHECK(shapes::records(solid) == states[i]);
    }
  }
}

TEST_CASE("the lesson of the dual makes the dual of the cube, half-edge by half-edge") {
  Solid solid, dual;
  REQUIRE(run(cube_script, solid) == "");
  REQUIRE_FALSE(run_script(parse(content(fs::path(HALFLIGHT_LESSONS) / "020_cube_from_its_dual.euler")), dual).has_value());
  REQUIRE(solid.edge_count() == dual.edge_count());
  for (HalfedgeId h : shapes::all_halfedges(solid)) {
    CHECK(dual.vertex(h).index == solid.face(h).index);
    CHECK(dual.face(h).index == solid.vertex(h).index);
    CHECK(dual.next(h) == solid.next(twin(h)));
  }
}
