// SPDX-License-Identifier: MIT
// What makes the stepper readable: names that do not cover one another, a caption at every step, walks, and a terminal that helps.
#include "catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <regex>
#include <string>

#include <brep/euler_script_parse.hpp>

#include "apps/euler/interactive.hpp"
#include "apps/euler/layout.hpp"
#include "apps/euler/outputs.hpp"
#include "apps/euler/story.hpp"
#include "browser.hpp"
#include "program.hpp"
#include "seed.hpp"

namespace {

using namespace apps::euler;

Story told_story(const std::string& script) {
  const brep::ScriptResult parsed = brep::parse_script(script);
  REQUIRE(parsed.script);
  return tell(*parsed.script, "test");
}

// Pairs of names, tips and vertices of which one covers the other.
int covered(const Panel& panel) {
  std::vector<NameBox> boxes;
  for (const VertexMark& v : panel.vertices) { boxes.push_back(vertex_box(panel, v)); }
  const std::size_t fixed = boxes.size();
  for (const Strand& s : panel.strands) {
    for (const std::uint32_t k : {0U, 1U}) { boxes.push_back(name_box(s.names[k], std::to_string(s.halfedge ^ k).size() + 1, s.sizes[k])); }
  }
  for (const FaceLabel& l : panel.labels) { boxes.push_back(name_box(l.at, std::to_string(l.face).size() + 1, l.size)); }
  int pairs = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = std::max(i + 1, fixed); j < boxes.size(); ++j) { pairs += cover(boxes[i], boxes[j]) ? 1 : 0; }
  }
  return pairs;
}

int covered(const Story& story) {
  int pairs = 0;
  for (const Layout& layout : lay_out(story, 0.026)) {
    for (const Panel& panel : layout.panels) { pairs += covered(panel); }
  }
  return pairs;
}

void type(LineEditor& editor, const std::string& keys) {
  for (const char key : keys) { static_cast<void>(editor.take(key)); }
}

}  // namespace

TEST_CASE("stepper: no name covers another, in any step of any lesson") {
  for (const auto& entry : std::filesystem::directory_iterator(HALFLIGHT_LESSONS)) {
    if (entry.path().extension() != ".euler") { continue; }
    INFO(entry.path().filename().string());
    std::string text = program::content(entry.path());
    static_cast<void>(take_coordinates(text));
    const Story story = told_story(text);
    CHECK(covered(story) == 0);
    for (const Layout& layout : lay_out(story, 0.026)) {  // none is left out for want of room
      for (const Panel& panel : layout.panels) {
        for (const Strand& s : panel.strands) { CHECK(std::min(s.sizes[0], s.sizes[1]) > 0.0); }
        for (const FaceLabel& l : panel.labels) { CHECK(l.size > 0.0); }
      }
    }
  }
}

TEST_CASE("stepper: no name covers another in random solids of up to 24 edges") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int k = 0; k < 10; ++k) {
    std::string script = "make_segment\n";
    Solid solid;
    (void)brep::make_segment(solid);
    while (solid.edge_count() < 24) {
      const brep::HalfedgeId a{static_cast<std::uint32_t>(random() % solid.halfedge_end())};
      brep::HalfedgeId b = a;
      for (auto steps = random() % 5; steps > 0; --steps) { b = random() % 2 == 0 ? solid.next(b) : solid.prev(b); }
      const std::string names = to_string(a) + " " + to_string(b) + "\n";
      if (random() % 2 == 0 && brep::split_face(solid, a, b)) {
        script += "split_face " + names;
      } else if (brep::split_vertex(solid, a, a)) {
        script += "split_vertex " + to_string(a) + " " + to_string(a) + "\n";
      }
    }
    INFO(script);
    const Story story = told_story(script);
    const std::vector<Layout> layouts = lay_out(story, 0.026);
    int pairs = 0;
    for (const Panel& panel : layouts.back().panels) { pairs += covered(panel); }
    CHECK(pairs == 0);
  }
}

TEST_CASE("stepper: every step is told in words, with the textbook's name") {
  const Story story = told_story("h0 = make_segment\nmev h1 h1\nmef h3 h0\nrefused split_face h0 h1\nundo\nredo\nkef h4\n");
  const std::vector<std::string> expected = {
      "make_segment, in textbooks mvfs, then mev: v + 2, e + 1 and f + 1. New: the edge h0/h1, v0, v1 and f0.",
      "split_vertex, in textbooks mev: v + 1 and e + 1. New: the edge h2/h3 and v2.",
      "split_face, in textbooks mef: e + 1 and f + 1. New: the edge h4/h5 and f1.",
      "",
      "The last step is taken back.",
      "The step that was taken back is done again.",
      "join_faces, in textbooks kef: e \xe2\x88\x92 1 and f \xe2\x88\x92 1. Gone: the edge h4/h5 and f1."};
  REQUIRE(story.frames.size() == expected.size() + 1);
  for (std::size_t i = 0; i < expected.size(); ++i) { CHECK(story.frames[i + 1].told == expected[i]); }
  for (const auto& entry : std::filesystem::directory_iterator(HALFLIGHT_LESSONS)) {
    if (entry.path().extension() != ".euler") { continue; }
    std::string text = program::content(entry.path());
    static_cast<void>(take_coordinates(text));
    for (const Frame& frame : told_story(text).frames) {
      INFO(entry.path().filename().string() << ": " << frame.statement);
      CHECK((frame.statement.empty() || !frame.caption.empty() || !frame.told.empty() || !frame.outcome.sentence.empty()));
    }
  }
}

TEST_CASE("stepper: the walk around a face and a vertex") {
  const Story story = told_story("h0 = make_segment\nh2 = split_vertex h1 h1\nh4 = split_face h3 h0\n");
  const Records& r = story.frames.back().records;
  CHECK(walk(r, brep::Element(brep::FaceId{0})) == "f0: h0 (from v0) h2 (from v1) h4 (from v2); 3 edges");
  CHECK(walk(r, brep::Element(brep::VertexId{1})) == "v1: h1 (in f1) h2 (in f0); 2 edges leave");
  CHECK(walk(r, brep::Element(brep::FaceId{7})) == "f7 does not exist");
  const Story damaged = told_story("h0 = make_segment\nh2 = split_vertex h1 h1\nh4 = split_face h3 h0\nraw next h0 h2\nraw next h4 h2\n");
  CHECK(walk(damaged.frames.back().records, brep::Element(brep::FaceId{0})).find("does not come back") != std::string::npos);
}

TEST_CASE("stepper: coordinates of a script are read, keep the places of lines, and are no captions") {
  std::string text = "h0 = make_segment\n#@ v0 0 0 0  v1 1 0 0.5\n#@ v2 x\nsplit_fase h0\n";
  const Coordinates coordinates = take_coordinates(text);
  CHECK(coordinates.size() == 2);
  CHECK(coordinates.at(1) == glm::dvec3(1.0, 0.0, 0.5));
  const brep::ScriptResult parsed = brep::parse_script(text);
  REQUIRE(parsed.errors.size() == 1);
  CHECK(parsed.errors[0].place.line == 4);
  const Story story = told_story("make_segment\n");
  CHECK(solid_view(story.frames[1], coordinates, 100.0).find("data-of='h0 h1'") != std::string::npos);
  CHECK(solid_view(story.frames[1], {}, 100.0).empty());
}

TEST_CASE("stepper: no vertex covers another in the view of the solid, and its name stays within its disk") {
  const std::regex mark("translate\\(([-.0-9]+) ([-.0-9]+)\\)'><circle r='([.0-9]+)'/><text font-size='([.0-9]+)' y='.35em'>(v[0-9]+)<");
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HALFLIGHT_LESSONS)) {
    if (entry.path().extension() != ".euler") { continue; }
    std::string text = program::content(entry.path());
    const Coordinates coordinates = take_coordinates(text);
    const std::string view = solid_view(told_story(text).frames.back(), coordinates, 240.0);
    std::vector<std::array<double, 3>> disks;
    for (std::sregex_iterator m(view.begin(), view.end(), mark), end; m != end; ++m) {
      INFO(entry.path().filename().string() << ": " << m->str(5));
      const std::array<double, 3> disk{std::stod(m->str(1)), std::stod(m->str(2)), std::stod(m->str(3))};
      // DejaVu Sans: letters are .64 of the size wide and .73 high.
      const double size = std::stod(m->str(4)), letters = static_cast<double>(m->str(5).size());
      CHECK(std::hypot(0.32 * size * letters, 0.365 * size) <= disk[2]);
      for (const auto& other : disks) { CHECK(std::hypot(disk[0] - other[0], disk[1] - other[1]) >= disk[2] + other[2]); }
      disks.push_back(disk);
      ++seen;
    }
  }
  CHECK(seen == 8 + 16 + 16);  // lessons 010, 030 and 040
}

TEST_CASE("terminal: keys edit a line, arrows bring back earlier ones, Tab completes") {
  LineEditor editor([] { return std::vector<std::string>{"split_face", "split_vertex", "undo"}; });
  type(editor, "spl\t");
  CHECK(editor.line() == "split_");
  CHECK(editor.choices() == std::vector<std::string>{"split_face", "split_vertex"});
  type(editor, "f\t");
  CHECK(editor.line() == "split_face ");
  CHECK(editor.choices().empty());
  type(editor, "h0 h1\x7f\x7fh2");
  CHECK(editor.line() == "split_face h0 h2");
  CHECK(editor.take('\n') == LineEditor::State::done);
  editor.next();
  type(editor, "undo");
  editor.next();
  type(editor, "\033[A\033[A");
  CHECK(editor.line() == "split_face h0 h2");
  type(editor, "\033[D\033[D\033[3~x\033[H\033[Cy");
  CHECK(editor.line() == "syplit_face h0 x2");
  type(editor, "\033[B");
  CHECK(editor.line() == "undo");
  type(editor, "\033[B");
  CHECK(editor.line().empty());
  CHECK(editor.take(4) == LineEditor::State::end);
}

TEST_CASE("terminal: an unknown operator gets the nearest that is known, face and vertex walk") {
  program::Place place;
  place.write("input", "mvsf\nmvfs\nface f0\nvertex v1\nvertex\nface v1\n");
  const program::Run run = place.run("euler --interactive < input");
  INFO(run.out);
  CHECK(run.out.find("did you mean 'mvfs'?") != std::string::npos);
  CHECK(run.out.find("f0: h0 (from v0) h1 (from v1); 2 edges") != std::string::npos);
  CHECK(run.out.find("v1: h1 (in f0); 1 edge leaves") != std::string::npos);
  CHECK(run.out.find("\nvertex: expected a vertex, such as v1\nface: expected a face, such as f1\n") != std::string::npos);

  place.write("input.euler", "# a script\nh0 = make_segment\nh2 = split_vertx h1 h1\nh9 h9\n");
  const program::Run script = place.run("euler input.euler");
  INFO(script.err);
  CHECK(script.code == 3);
  CHECK(script.err.find("input.euler:3:6: error: found 'split_vertx'") != std::string::npos);
  CHECK(script.err.find("; did you mean 'split_vertex'?\n") != std::string::npos);
}

TEST_CASE("stepper: every step of the page, and the walk of all that it shows, work in a browser") {
  if (!browser::found()) { SKIP_TEST("there is no chromium"); }
  program::Place place;
  REQUIRE(place.run("euler '" HALFLIGHT_LESSONS "/040_through_hole.euler' -o page.html").code == 0);
  const std::string dom = browser::elements(place, place.read("page.html"), R"(
    let walks = 0, seen = 0;
    for (let i = 0; i < frames.length; ++i) {
      show(i);
      for (const e of document.querySelectorAll('#picture [data-k]')) { mark(pointed({target: e})); walks += document.querySelectorAll('.walked').length > 0; }
      // What changed is in view, and so is the caption above it.
      const changed = document.querySelector('#tables .fresh, #tables .moved'), box = document.querySelector('aside').getBoundingClientRect();
      const inside = e => { const at = e.getBoundingClientRect(); return at.top >= box.top && at.bottom <= box.bottom + 1; };
      seen += (!changed || inside(changed)) && inside($('caption'));
    }
    document.documentElement.dataset.walks = walks > 1000;
    document.documentElement.dataset.seen = seen === frames.length;
    document.documentElement.dataset.solid = document.querySelectorAll('#solid .vertex').length;
  )",
                                            "1280,860");
  INFO(dom.substr(0, 300));
  CHECK(dom.find("data-error") == std::string::npos);
  CHECK(dom.find("data-walks=\"true\"") != std::string::npos);
  CHECK(dom.find("data-seen=\"true\"") != std::string::npos);
  CHECK(dom.find("data-solid=\"16\"") != std::string::npos);
}
