// SPDX-License-Identifier: MIT
// halflight euler as its user meets it: exit codes, streams, files.
#include "catch.hpp"

#include <filesystem>
#include <string>

#include "program.hpp"

namespace {

struct EulerFolder : program::Place {
  program::Run last;

  int run(const std::string& arguments) {
    last = Place::run("euler " + arguments);
    return last.code;
  }
};

}  // namespace

TEST_CASE("euler draws every lesson as strip and page, exit code 0") {
  EulerFolder folder;
  std::size_t lessons = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HALFLIGHT_LESSONS)) {
    if (entry.path().extension() != ".euler") { continue; }
    ++lessons;
    CHECK(folder.run("'" + entry.path().string() + "' -o a.svg -o a.html") == 0);
    INFO(entry.path().filename().string() << "\n" << folder.last.err);
    CHECK(folder.last.err.empty());
    CHECK(folder.last.out.find("written: a.svg\nwritten: a.html\n") != std::string::npos);
    CHECK(folder.read("a.svg").find("</svg>") != std::string::npos);
    CHECK(folder.read("a.html").find("</html>") != std::string::npos);
  }
  CHECK(lessons >= 7);
}

TEST_CASE("euler: errors in a script are exit code 3 with file, line and column") {
  EulerFolder folder;
  folder.write("words.euler", "make_segment\nsplit_fase h0 h1\n");
  CHECK(folder.run("words.euler -o a.svg") == 3);
  CHECK(folder.last.err.find("words.euler:2:1: error: found 'split_fase'") == 0);
  CHECK_FALSE(folder.has("a.svg"));
  folder.write("refusal.euler", "h0 = make_segment\njoin_faces h0\nexpect v 3\n");
  CHECK(folder.run("refusal.euler -o a.svg") == 3);
  CHECK(folder.last.err.find("refusal.euler:2:1: error: join_faces: both sides of h0 are the face f0") == 0);
  CHECK(folder.last.err.find("\nrefusal.euler:3:1: error: v is 2, not 3") != std::string::npos);
  CHECK(folder.read("a.svg").find("refused: join_faces") != std::string::npos);  // the picture shows where it went wrong
  CHECK(folder.run("none.euler") == 1);
}

TEST_CASE("euler: a script too long to be drawn is played all the same, and drawing it is refused at once") {
  EulerFolder folder;
  std::string script = "make_segment\n";
  for (int i = 1; i < 700; ++i) { script += "split_edge h0\n"; }
  folder.write("long.euler", script + "expect v 701 e 700 f 1 s 1 h 0\n");
  CHECK(folder.run("long.euler") == 0);
  CHECK(folder.last.out.find("steps: 700\nv 701   e 700   f 1   s 1   h 0\n") != std::string::npos);
  CHECK(folder.run("long.euler -o a.html") == 1);
  // 1 + 2 + ... + 700 edges.
  CHECK(folder.last.err.find("long.euler is too long to draw: its 701 pictures would show 245350 edges together") != std::string::npos);
  CHECK_FALSE(folder.has("a.html"));
}

TEST_CASE("euler: wrong usage is exit code 2, a target that cannot be written 1") {
  EulerFolder folder;
  folder.write("a.euler", "make_segment\n");
  CHECK(folder.run("") == 2);
  CHECK(folder.run("a.euler -o a.png") == 2);
  CHECK(folder.run("a.euler -o a.svg -o a.svg") == 2);
  CHECK(folder.run("a.euler --interactive") == 2);
  CHECK(folder.run("a.euler -o none/a.svg") == 1);
  CHECK(folder.run("a.euler") == 0);
}

TEST_CASE("euler --interactive answers every line and saves what was done as a script") {
  EulerFolder folder;
  folder.write(
      "input",
      "help\n# a comment\n\ntop = make_segment\nsplit_face top twin(top)\ncut top\nfoo\nsplit_edge h0\nundo\nexpect e 2\nexpect e 3\nshow\n"
      "save saved.euler\nsave\nquit\nmake_segment\n");
  CHECK(folder.run("--interactive -o now.svg -o all.html < input") == 0);
  INFO(folder.last.out);
  for (const char* part :
       {"operators ", "top = make_segment   (h0)\nv 2   e 1   f 1   s 1   h 0", "split_face top twin(top)   -> h2\n",
        "refused: cut: the sides of h0 are different faces", "column 1: found 'foo'", "as expected\n", "e is 2, not 3\n",
        "half-edge   next  prev  vertex  face\nh0 ", "anchors of vertices: v0-h0 v1-h1\n", "written: saved.euler\n", "save FILE: "}) {
    INFO(part);
    CHECK(folder.last.out.find(part) != std::string::npos);
  }
  CHECK(folder.read("saved.euler") == "h0 = make_segment\nh2 = split_face h0 h1\n");
  CHECK(folder.read("now.svg").find("</svg>") != std::string::npos);
  CHECK(folder.read("all.html").find("</html>") != std::string::npos);
  CHECK(folder.run("saved.euler") == 0);
}
