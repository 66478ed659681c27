// SPDX-License-Identifier: MIT
// What the stepper tells of a script, and its page and strip as text.
#include "apps/euler/story.hpp"

#include <brep/euler_script.hpp>
#include <brep/euler_script_parse.hpp>
#include <brep/euler_script_run.hpp>

#include "apps/euler/outputs.hpp"
#include "catch.hpp"

namespace {

using namespace apps::euler;

Story story_of(const std::string& text) {
  const brep::ScriptResult parsed = brep::parse_script(text);
  REQUIRE(parsed.script.has_value());
  return tell(*parsed.script, "name");
}
std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) { ++n; }
  return n;
}

}  // namespace

TEST_CASE("each operator is a frame, expectations belong to the frame before them") {
  const Story story = story_of("# T\n\n# first\nh0 = make_segment\nx = split_edge h0\nexpect v 3 # good\nexpect v 4\nsplit_face h0 h99\n");
  CHECK(story.title == "T");
  REQUIRE(story.frames.size() == 4);
  CHECK(story.frames[1].caption == "first");
  CHECK(headline(story.frames[1]) == "h0 = make_segment");
  CHECK(headline(story.frames[2]) == "x = split_edge h0   (h3)");
  CHECK(counts(story.frames[2]) == "v 3   e 2   f 1   s 1   h 0");
  CHECK(equation(story.frames[2]) == "3 \xe2\x88\x92 2 + 1 = 2 = 2(1 \xe2\x88\x92 0)");
  CHECK(story.frames[2].caption == "good");
  REQUIRE(story.frames[2].checks.size() == 2);
  CHECK(story.frames[2].checks[0].met);
  CHECK(story.frames[2].checks[1].sentence == "v is 3, not 4");
  CHECK(story.frames[3].outcome.kind == brep::Outcome::Kind::refused);
  CHECK(story.errors.size() == 2);
  CHECK(story_of("make_segment").title == "name");
}

TEST_CASE("a negative v - e + f is told with its sign") {
  const Story story =
      story_of("make_segment\nsplit_face h0 h1\nsplit_face h2 h1\nsplit_face h4 h1\nsplit_face h6 h1\nbridge h0 h2\nbridge h4 h6\n");
  CHECK(story.errors.empty());
  CHECK(equation(story.frames.back()) ==
        "2 \xe2\x88\x92 7 + 3 = \xe2\x88\x92"
        "2 = 2(1 \xe2\x88\x92 2)");
}

TEST_CASE("damaged records are shown as they are, the picture as it was") {
  const Story story = story_of("h0 = make_segment\nraw next h0 h0\n");
  REQUIRE(story.frames.size() == 3);
  CHECK(story.frames[2].damaged);
  CHECK(story.frames[2].records.halfedges[0].next == 0);
  CHECK(story.frames[2].drawn.halfedges[0].next == 1);
  CHECK_FALSE(story.frames[2].outcome.faults.empty());
  CHECK(strip(story).find("R3: ") != std::string::npos);
}

TEST_CASE("strip and page hold every step, and text cannot break out of them") {
  const Story story =
      story_of("# <b>&\"' </script>\n\n# </script><script>alert(1)</script>\nh0 = make_segment\nh3 = split_edge h0\nrefused cut h0\n");
  const std::string svg = strip(story), html = page(story);
  CHECK(count(svg, "class='drawing'") == 3);
  CHECK(svg.find("refused: cut: ") != std::string::npos);
  CHECK(svg.find("&lt;b&gt;&amp;") != std::string::npos);
  CHECK(svg.find("<b>") == std::string::npos);
  CHECK(count(html, "\"statement\"") == 4);
  CHECK(count(html, "</script>") == 1);
  CHECK(html.find("alert(1)") != std::string::npos);
  for (const char* outside : {"http:", "https:", "src=", "href=", "@import", "url("}) {
    std::string rest = html;
    INFO(outside);
    CHECK(rest.find(outside) == std::string::npos);
  }
  CHECK(strip(story_of("")).find("</svg>") != std::string::npos);
  CHECK(page(story_of("")).find("</html>") != std::string::npos);
}
