// SPDX-License-Identifier: MIT
// The exercises: solutions in tests/exercises pass, beginnings do not, and no sentence gives an answer away.
#include "catch.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "apps/exercise/exercises.hpp"
#include "program.hpp"

namespace {

using apps::exercise::Exercise;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) { lines.push_back(line); }
  return lines;
}

std::string solution(const Exercise& e) { return program::content(std::string(HALFLIGHT_SOURCE "/tests/exercises/") + e.file); }

bool is_script(const Exercise& e) { return std::string(e.file).ends_with(".euler"); }

}  // namespace

TEST_CASE("exercises: twelve, each with a beginning that is not solved and a solution that is") {
  CHECK(apps::exercise::all().size() == 12);
  for (const Exercise& e : apps::exercise::all()) {
    INFO(e.file);
    CHECK(apps::exercise::beginning(e) == program::content(std::string(HALFLIGHT_SOURCE "/examples/exercises/") + e.file));
    REQUIRE_FALSE(solution(e).empty());
    if (e.fault == nullptr) { continue; }  // programs: tests of their own
    const auto open = e.fault(apps::exercise::beginning(e));
    REQUIRE(open);
    CHECK(open->find('\n') == std::string::npos);
    CHECK(e.fault(solution(e)).value_or("") == "");
  }
}

TEST_CASE("exercises: no lesson solves one, so that each has to be worked out") {
  for (const Exercise& e : apps::exercise::all()) {
    if (!is_script(e)) { continue; }
    for (const auto& lesson : std::filesystem::directory_iterator(HALFLIGHT_LESSONS)) {
      if (lesson.path().extension() != ".euler") { continue; }
      INFO(e.file << " and " << lesson.path().filename().string());
      CHECK(e.fault(program::content(lesson.path())));
    }
  }
}

TEST_CASE("exercises: a script without one of its operators is told as wrong") {
  for (const Exercise& e : apps::exercise::all()) {
    if (!is_script(e)) { continue; }
    const std::vector<std::string> lines = lines_of(solution(e));
    for (std::size_t left_out = 0; left_out < lines.size(); ++left_out) {
      if (lines[left_out].empty() || lines[left_out][0] == '#' || lines[left_out].starts_with("expect v")) { continue; }
      if (lines[left_out] == "expect R2 R3 R6") { continue; }  // asks only
      std::string text;
      for (std::size_t i = 0; i < lines.size(); ++i) { text += i == left_out ? "\n" : lines[i] + "\n"; }
      INFO(e.file << " without " << lines[left_out]);
      const auto fault = e.fault(text);
      REQUIRE(fault);
      CHECK_FALSE(fault->empty());
    }
  }
}

TEST_CASE("exercises: a number that is 2 % off is told as wrong, which it is but not by how much") {
  for (const Exercise& e : apps::exercise::all()) {
    if (!std::string(e.file).ends_with(".txt")) { continue; }
    const std::vector<std::string> lines = lines_of(solution(e));
    for (std::size_t changed = 0; changed < lines.size(); ++changed) {
      const std::size_t equals = lines[changed].find(" = ");
      const std::string name = lines[changed].substr(0, equals), value = lines[changed].substr(equals + 3);
      for (const double factor : {0.98, 1.02}) {
        std::string text;
        for (std::size_t i = 0; i < lines.size(); ++i) {
          text += i == changed ? name + " = " + std::to_string(std::stod(value) * factor + (factor - 1.0)) + "\n" : lines[i] + "\n";
        }
        const auto fault = e.fault(text);
        INFO(e.file << " " << name);
        REQUIRE(fault);
        CHECK(fault->starts_with(name + " is too " + (factor < 1.0 ? "small" : "large")));
        CHECK(fault->find(value) == std::string::npos);
      }
    }
    CHECK(e.fault("x = 1\n")->find("nobody asked for 'x'") != std::string::npos);
    CHECK(e.fault(lines[0] + "0x\n")->find("is no number") != std::string::npos);
  }
}

TEST_CASE("exercises: what the rules forbid is named with its line") {
  const auto faults = [](std::size_t n, const std::string& text) { return apps::exercise::all()[n - 1].fault(text).value_or(""); };
  const std::string five = apps::exercise::beginning(apps::exercise::all()[4]);
  CHECK(faults(5, five + "undo\nundo\nundo\nundo\nundo\n").find("undo and redo are not allowed here") != std::string::npos);
  CHECK(faults(5, "h0 = make_segment\nh2 = split_vertex h1 h1\nh4 = split_face h3 h0\n").find("step 4 is not that of the beginning") == 0);
  CHECK(faults(1, "h0 = make_segment\nsplit_fase h0 h0\n").find("line 2: found 'split_fase'") == 0);
  CHECK(faults(1, "h0 = make_segment\njoin_faces h0\n").find("line 2: join_faces: both sides") == 0);
  CHECK(faults(4,
               "h0 = make_segment\nh2 = split_vertex h1 h1\nh4 = split_face h3 h0\nh6 = split_vertex h1 h1\nh8 = split_vertex h3 h3\n"
               "h10 = split_vertex h5 h5\nh12 = split_face h7 h11\nh14 = split_face h11 h9\nh16 = split_face h9 h12\n") ==
        "this is the prism itself");
}

TEST_CASE("exercise in the terminal: the list, the text, the verdict by exit code") {
  program::Place place;
  CHECK(place.run("exercise").out.find("12  why a T-vertex shows   (12_t_vertex.txt)\n") != std::string::npos);
  CHECK(place.run("exercise 2 -o mine.euler").code == 0);
  const program::Run open = place.run("exercise 2 mine.euler");
  CHECK(open.code == 3);
  CHECK(open.out == "not yet: it has 0 handles; a torus has one\n");
  place.write("mine.euler", solution(apps::exercise::all()[1]));
  const program::Run done = place.run("exercise 2 mine.euler");
  CHECK(done.code == 0);
  CHECK(done.out == "exercise 2: solved\n");
  const program::Run again = place.run("exercise 2 -o mine.euler");  // takes no solution away
  CHECK(again.code == 1);
  CHECK(again.err == "halflight: mine.euler is there already, and may hold your solution; name another file, or remove it\n");
  CHECK(place.run("exercise 2 mine.euler").code == 0);
  CHECK(place.run("exercise 7 mine.euler").err.find("sh examples/exercises/check.sh 7 mine.euler") != std::string::npos);
  CHECK(place.run("exercise 13").code == 2);
}
