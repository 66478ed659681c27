// SPDX-License-Identifier: MIT
// halflight check as its user meets it: exit codes, what is told, what is written.
#include "catch.hpp"

#include <string>

#include "program.hpp"

namespace {

const std::string cube_text =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

std::string edited(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// The program in a folder with one mesh in it.
class Check : public program::Place {
 public:
  program::Run last;

  explicit Check(const std::string& mesh) { write("m.obj", mesh); }
  Check& run(const std::string& arguments) {
    last = Place::run("check " + arguments);
    return *this;
  }
  [[nodiscard]] bool says(const std::string& text) const { return last.out.find(text) != std::string::npos; }
};

}  // namespace

TEST_CASE("check: a sound mesh is exit code 0 with its counts, genus and volume") {
  Check check(cube_text);
  CHECK(check.run("m.obj").last.code == 0);
  CHECK(check.says("8 vertices, 12 edges, 6 faces: 6 quadrilaterals"));
  CHECK(check.says("sound: 1 closed oriented shell"));
  CHECK(check.last.err.empty());
}

TEST_CASE("check: every fault is told with its place, exit code 3") {
  Check check(edited(cube_text, "f 1 2 6 5", "f 1 5 6 2") + "v 7 7 7\nf 5 6 8 7\n");
  CHECK(check.run("m.obj").last.code == 3);
  CHECK(check.says("NOT SOUND: 3 faults"));
  CHECK(check.says("m.obj:11: f2 is flipped"));
  CHECK(check.says("f6 is f1 entered again"));
  CHECK(check.says("m.obj:15: v8 is not a corner of any face"));
}

TEST_CASE("check --repair: says what it did, writes the result, and the result is sound") {
  Check check(edited(edited(cube_text, "f 1 2 6 5", "f 1 5 6 2"), "f 2 4 8 6\n", "") + "v 7 7 7\n");
  for (const std::string name : {"r.obj", "r.ply", "r.off"}) {
    CHECK(check.run("m.obj --repair -o " + name).last.code == 0);
    CHECK(check.says("--- repaired: 3 steps"));
    CHECK(check.says("f2 was flipped"));
    CHECK(check.says("a hole of 4 edges was closed with the new face f5"));
    CHECK(check.says("v8 was dropped"));
    CHECK(check.says("written: " + name));
    CHECK(check.run(name).last.code == 0);
    CHECK(check.says("8 vertices, 12 edges, 6 faces"));
  }
}

TEST_CASE("check --repair: what remains is exit code 3, and is written all the same") {
  Check check(cube_text + "v 0 -1 0\nf 1 2 9\n");
  CHECK(check.run("m.obj --repair -o r.ply").last.code == 3);
  CHECK(check.says("--- repaired: nothing"));
  CHECK(check.says("m.obj:9: the edge between v0 and v1 has 3 faces: f0 f2 f6"));
  CHECK(check.run("r.ply").last.code == 3);
}

TEST_CASE("check --repair: a mesh of which nothing is left is not called sound") {
  Check check("v 0 0 0\nv 1 0 0\nf 1 2\nf 1\n");
  CHECK(check.run("m.obj --repair").last.code == 3);
  CHECK(check.says("f1 was dropped"));
  CHECK(check.says("NOT SOUND: nothing is left"));
  CHECK(check.run("m.obj").says("f1 has 1 corner, a face needs three"));
}

TEST_CASE("check: the border of a Moebius strip is not counted by its chains") {
  Check check("v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 0 1\nv 0 1 0\nv 0 1 1\nf 1 3 4 2\nf 3 5 6 4\nf 5 2 1 6\n");
  CHECK(check.run("m.obj").last.code == 3);
  CHECK(check.says("       0         -       -   - (one-sided)"));
}

TEST_CASE("check: long lists are cut and the number of the rest is told, --all shows them") {
  std::string many = cube_text;
  for (int i = 0; i < 25; ++i) { many += "v 9 9 " + std::to_string(i) + "\n"; }
  Check check(many);
  CHECK(check.run("m.obj").last.code == 3);
  CHECK(check.says("... and 15 more"));
  CHECK_FALSE(check.says("v32 is not"));
  CHECK(check.run("m.obj --all").says("v32 is not"));
}

TEST_CASE("check: a file that cannot be understood is exit code 3 with its place, one that cannot be opened 1, wrong usage 2") {
  Check check("v 0 0 0\nf 1 2 3\n");
  CHECK(check.run("m.obj").last.code == 3);
  CHECK(check.last.err.find("m.obj:2:5: error: there is no vertex 2, the file has 1\n") == 0);
  CHECK(check.last.out.empty());
  CHECK(check.run("none.obj").last.code == 1);
  CHECK(check.run("none.stl").last.code == 2);
  CHECK(check.run("").last.code == 2);
  CHECK(check.run("m.obj -o r.obj").last.code == 2);  // only a repaired mesh is written
  CHECK(check.run("m.obj --repair -o r.stl").last.code == 2);
  CHECK(check.run("m.obj --repair -o ./m.obj").last.code == 2);
  CHECK(check.run("m.obj --repair -o none/r.obj").last.code == 1);
  CHECK_FALSE(check.has("r.obj"));
}
