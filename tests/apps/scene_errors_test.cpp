// SPDX-License-Identifier: MIT
// Every error names its line and column, what was found and what was expected, and does not stop at the first.
#include "catch.hpp"

#include <string>
#include <vector>

#include "apps/scene_file.hpp"
#include "scene_texts.hpp"

namespace {

struct Case {
  std::string text;
  unsigned line;
  unsigned column;
  std::string part;  // of the sentence
};

using scene_texts::ball;
using scene_texts::grey;

std::vector<Case> cases() {
  const std::string g = grey;
  return {
      // materials
      {"material a reflectance 1.5\n", 1, 24, "outside 0 to 1"},
      {"material a reflectance 0.5 -0.1 0\n", 1, 28, "outside 0 to 1"},
      {"material a emission 1 -2 3\n", 1, 23, "negative"},
      {"material a reflectance 0.5 0.5\n", 1, 31, "one number or three"},
      {"material a reflectance\n", 1, 23, "found the end of the line"},
      {"material a reflectance 0 0 0 0\n", 1, 30, "found one more: '0'"},
      {"material a reflectence 0.5\n", 1, 12, "did you mean 'reflectance'?"},
      {"material a reflectance nan\n", 1, 24, "found 'nan'"},
      {"material a emission inf\n", 1, 21, "found 'inf'"},
      {"material a emission -inf\n", 1, 21, "not a finite number"},
      {"material a emission 1e999\n", 1, 21, "beyond what a number can hold"},
      {"material a emission 1e310\n", 1, 21, "beyond what a number can hold"},
      {g + "sphere s center 0 0 1e31 radius 1 material grey\n", 2, 21, "too large"},
      {"material a emission 1,2,3\n", 1, 21, "separated by spaces"},
      {"material a emission 0x10\n", 1, 21, "not a number"},
      {"material\n", 1, 9, "expected the name of a material"},
      {"material 5 reflectance 0\n", 1, 10, "a name begins with a letter"},
      {"material a.b reflectance 0\n", 1, 10, "not a name"},
      {"material a reflectance 0 reflectance 0\n", 1, 26, "given twice; the first one stands at 1:12"},
      {g + g + ball, 2, 10, "given twice; the first one stands at 1:10"},
      // statements and braces
      {g + "bocks b from 0 0 0 to 1 1 1 material grey\n" + ball, 2, 1, "unknown word 'bocks'; expected material"},
      {g + "shpere b center 0 0 0 radius 1\n" + ball, 2, 1, "did you mean 'sphere'?"},
      {g + "12 b\n" + ball, 2, 1, "expected a statement"},
      {g + "}\n" + ball, 2, 1, "without an open block"},
      {g + "{\n radius\n}\n" + ball, 2, 1, "opens on the line of its statement"},
      {g + "sphere s {\n center 0 0 0\n radius 1\n material grey\n", 6, 1, "to close the block that begins at 2:10"},
      {g + "sphere s {\n center 0 0 0\n radius 1\n material grey\n" + ball, 6, 1, "expected '}' before 'sphere'"},
      {g + "sphere s { center 0 0 0 { radius 1 } material grey }\n", 2, 25, "inside the block that begins at 2:10"},
      {g + "sphere s { center 0 0 0 radius 1 material grey } inside\n", 2, 50, "expected the end of the line, found 'inside'"},
      {g + "sphere s center 0 0 0 radius 1 material grey }\n", 2, 46, "without an open block"},
      // unions, intersections, differences
      {g + "union u material grey\n" + ball, 2, 7, "union 'u' has no operands"},
      {g + "difference d material grey {\n}\n", 2, 12, "expected solids between '{' and '}'"},
      {g + "union u material grey box b from 0 0 0 to 1 1 1\n", 2, 23, "operands stand in a block; expected '{' before 'box'"},
      {g + "union u {\n box b from 0 0 0 to 1 1 1\n}\n", 3, 6, "'b' has no material, and nothing around it has one"},
      {g + "union u material grey {\n polygon p {\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n }\n}\n", 3, 10, "has no inside"},
      {g + "union u material grey {\n box b from 0 0 0 to 1 1 1 inside\n}\n", 3, 28, "'inside' cannot stand at an operand"},
      {g + "union u material grey {\n sphere b center 0 0 0 radius 1\n box b from 0 0 0 to 1 1 1\n}\n", 4, 6, "'b' is taken"},
      {g + "union u material grey {\n sphere b center 0 0 0\n}\n", 3, 9, "sphere 'b' has no 'radius'"},
      {g + "union u material grey {\n sphere b center 0 0 0 radius 1 material gray\n}\n", 3, 42, "did you mean 'grey'?"},
      {g + "union u {\n use ball as b\n}\ndefine bal {\n" + ball + "}\n", 3, 6, "there is no group 'ball'; did you mean 'bal'?"},
      {g + "define a {\n union u {\n use a as b\n }\n}\nuse a as c\n", 4, 6, "cyclic use: 'a' takes part in itself"},
      {g + "define a {\n" + ball + "}\nunion u {\n use a b\n}\n", 6, 8, "expected 'as' and a name"},
      {g + "define a {\n" + ball + "}\nunion u {\n use a as b radius 1\n}\n", 6, 13, "unknown word 'radius' in this use"},
      {g + "define a {\n disk d center 0 0 0 normal 0 0 1 radius 1 material grey\n}\nunion u {\n use a as b\n use a as c\n}\n", 3, 7,
       "'d' has no inside"},
      {g + "define a {\n box d from 0 0 0 to 1 1 1 inside material grey\n}\nunion u {\n use a as b\n}\n", 3, 28, "'inside' cannot stand"},
      {g + "union u material grey {\n sphere b center 0 0 0 radius 1\n define a {\n}\n", 4, 2, "expected '}' before 'define'"},
      {g + "union u material grey {\n shpere b center 0 0 0 radius 1\n}\n", 3, 2, "did you mean 'sphere'?"},
      {g + "union u material grey {\n sphere b center 0 0 0 radius 1\n", 4, 1, "to close the block that begins at 2:23"},
      {g + "intersection i material grey {\n box a from 0 0 0 to 1 1 1\n box b from 2 0 0 to 3 1 1\n}\n", 2, 14, "nothing is left"},
      {g + "difference d material grey {\n box a from 0 0 0 to 1 1 1\n box b from 0 0 0 to 1 1 1\n}\n", 2, 12, "nothing is left"},
      // objects
      {g + "sphere s center 0 0 radius 1 material grey\n", 2, 21, "'center' takes 3 numbers; expected number 3, found 'radius'"},
      {g + "sphere s center 0 0 0 0 radius 1 material grey\n", 2, 23, "found one more"},
      {g + "sphere s center 0 0 0 radius 0 material grey\n", 2, 30, "a radius above 0"},
      {g + "sphere s center 0 0 0 radius -1 material grey\n", 2, 30, "a radius above 0"},
      {g + "sphere s radius 1 material grey\n", 2, 8, "has no 'center'"},
      {g + "sphere s center 0 0 0 radius 1\n", 2, 8, "has no 'material'"},
      {g + "sphere s center 0 0 0 radius 1 material gray\n", 2, 41, "no material 'gray'; did you mean 'grey'?"},
      {g + "sphere s center 0 0 0 radius 1 material grey from 0 0 0\n", 2, 46, "unknown word 'from' in this sphere"},
      {g + ball + "box ball from 0 0 0 to 1 1 1 material grey\n", 3, 5, "the name 'ball' is taken"},
      {g + "box b from 0 0 0 to 1 0 1 material grey\n", 2, 18, "no size along y"},
      {g + "cylinder c base 0 0 0 axis 0 0 0 radius 1 material grey\n", 2, 23, "no length"},
      {g + "disk d center 0 0 0 normal 0 0 0 radius 1 material grey\n", 2, 21, "no direction"},
      {g + "disk d center 0 0 0 radius 1 material grey\n", 2, 6, "has no 'normal'"},
      {g + "disk d center 0 0 0 normal 0 0 1 radius 1 material grey inside\n", 2, 57, "unknown word 'inside'"},
      {g + "cone c base 0 0 0 axis 0 0 0 radius 1 material grey\n", 2, 19, "no length"},
      {g + "cone c base 0 0 0 axis 0 0 1 radius 1 top -1 material grey\n", 2, 43, "a top above 0"},
      {g + "cone c base 0 0 0 axis 0 0 1 radius 1 material grey sheet top material grey\n", 2, 59, "expected side or bottom"},
      {g + "torus t center 0 0 0 axis 0 0 0 radius 1 tube 0.5 material grey\n", 2, 22, "through the hole"},
      {g + "torus t center 0 0 0 axis 0 0 1 radius 1 tube 1.5 material grey\n", 2, 47, "passes through itself"},
      {g + "torus t center 0 0 0 axis 0 0 1 radius 1 material grey\n", 2, 7, "has no 'tube'"},
      {g + "superquadric s center 0 0 0 radii 1 1 1 exponents 0 1 material grey\n", 2, 51, "between 0.001"},
      {g + "superquadric s center 0 0 0 radii 1 1 1 exponents 1 material grey\n", 2, 53, "'exponents' takes 2 numbers"},
      {g + "superquadric s center 0 0 0 radii 1 1 1 exponents 1 1 ring 0.5 material grey\n", 2, 60, "between 1 and 10000"},
      {g + "superquadric s center 0 0 0 exponents 1 1 material grey\n", 2, 14, "has no 'radii'"},
      {g + "box b from 0 0 0 to 1 1 1 material grey sheet x7 material grey\n", 2, 47, "no sheet 'x7'; expected x0, x1"},
      {g + "box b from 0 0 0 to 1 1 1 sheet x0 material grey\n", 2, 5, "no material for its sheet 'x1'"},
      {g + "box b from 0 0 0 to 1 1 1 material grey sheet x0 grey\n", 2, 50, "expected 'material'"},
      {g + "box b from 0 0 0 to 1 1 1 material grey { sheet x0 material grey\n sheet 0 material grey }\n", 3, 8, "given twice"},
      {g + "polygon p material grey { vertex 0 0 0\n vertex 1 0 0 }\n", 2, 9, "polygon 'p'"},
      {g + "polygon p material grey {\n vertex 0 0 0\n vertex 1 0 0\n vertex 1 1 0.5\n vertex 0 1 0\n vertex -1 1 0\n vertex -1 0 0\n}\n",
       5, 2, "polygon 'p'"},
      {g + "polygon p material grey { vertex 0 0 0\n vertex 1 1 0\n vertex 1 0 0\n vertex 0 1 0 }\n", 2, 9, "polygon 'p'"},
      {g + "polygon p inside material grey { vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0 }\n", 2, 11, "unknown word 'inside'"},
      {g + "mesh m material grey {\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n face 0 1 3\n}\n", 6, 2,
       "no vertex 3; vertices are numbered 0 to 2"},
      {g + "mesh m material grey {\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n face 0 1\n}\n", 6, 10, "at least 3"},
      {g + "mesh m material grey {\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n face 0 1 1.5\n}\n", 6, 11, "whole number"},
      {g + "mesh m material grey {\n vertex 0 0 0\n vertex 1 0 0\n vertex 2 0 0\n face 0 1 2\n}\n", 6, 2, "mesh 'm'"},
      {g + "mesh m material grey inside {\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n face 0 1 2\n}\n", 2, 22, "needs a closed solid"},
      {g + "sphere s center 0 0 0 radius 1 material grey scale 0\n", 2, 52, "leaves nothing"},
      {g + "sphere s center 0 0 0 radius 1 material grey scale 1 2\n", 2, 55, "one number or three"},
      {g + "sphere s center 0 0 0 radius 1 material grey rotate 0 0 0 90\n", 2, 53, "an axis that is not 0 0 0"},
      {g + "sphere s center 0 0 0 radius 1 material grey rotate 0 0 1\n", 2, 58, "takes 4 numbers"},
      {g + "sphere s center 0 0 0 radius 1 material grey scale 1e20 scale 1e20\n", 2, 8, "reaches beyond 1e30"},
      // cameras
      {g + ball + "camera c look 0 0 1\n", 3, 8, "has no 'eye'"},
      {g + ball + "camera c eye 0 0 1\n", 3, 8, "needs 'target' or 'look'"},
      {g + ball + "camera c eye 0 0 1 target 0 0 1\n", 3, 8, "looks nowhere"},
      {g + ball + "camera c eye 0 0 1 look 0 0 1 target 0 0 0\n", 3, 20, "not both"},
      {g + ball + "camera c eye 0 0 1 look 0 0 1 up 0 0 2\n", 3, 8, "along the view"},
      {g + ball + "camera c eye 0 0 1 look 0 0 1 fov 180\n", 3, 35, "0.001 to 179"},
      {g + ball + "camera c eye 0 0 1 look 0 0 1 size 640\n", 3, 39, "expected a number for 'size'"},
      {g + ball + "camera c eye 0 0 1 look 0 0 1 size 0 5\n", 3, 36, "at least 1 pixel"},
      {g + ball + "camera c eye 0 0 1 look 0 0 1\ncamera c eye 0 0 1 look 0 0 1\n", 4, 8, "its name is taken"},
      // groups
      {g + "define a {\n use a as b\n}\nuse a as c\n", 3, 6, "cyclic use: 'a' uses 'a'"},
      {g + "define a {\n use b as x\n}\ndefine b {\n use a as y\n}\n" + ball, 6, 6, "cyclic use: 'a' uses 'b' uses 'a'"},
      {g + "define a {\n}\n" + ball, 2, 8, "is empty"},
      {g + "use chair as c\n", 2, 5, "no group 'chair'"},
      {g + "define chair { " + ball + "}\nuse chiar as c\n", 4, 5, "did you mean 'chair'?"},
      {g + "define a { " + ball + "}\ndefine a { " + ball + "}\nuse a as b\n", 4, 8, "defined twice"},
      {g + "define a { " + ball + "}\nuse a b\n", 4, 7, "expected 'as'"},
      {g + "define a { " + ball + "\n", 4, 1, "to close the block that begins at 2:10"},
      {g + "define a {\n" + ball + "define b {\n" + ball + "}\n", 4, 1, "cannot stand inside a group"},
      {g + "define a\n" + ball, 2, 9, "expected '{'"},
      // files
      {"", 1, 1, "the scene is empty"},
      {"# nothing\n" + grey, 1, 1, "the scene is empty"},
      {grey + "sphere \x01 center", 2, 8, "byte 0x01"},
      {std::string("sph\0ere", 7), 1, 4, "byte 0x00"},
      {"sphere \xff\xfe", 1, 8, "byte 0xff"},
      {"material \xc3\xbc \xc3\xa4 reflectance 0\n", 1, 12, "unknown word"},  // columns are characters
  };
}

}  // namespace

TEST_CASE("every error is reported at its line and column with its sentence") {
  for (const Case& c : cases()) {
    const apps::SceneResult result = apps::parse_scene(c.text);
    INFO(c.text << "\nexpected " << c.line << ":" << c.column << " " << c.part << "\ngot\n" << apps::to_text(result, "test"));
    CHECK_FALSE(result.file);
    bool found = false;
    for (const apps::InputError& error : result.errors) {
      found = found || (error.place.line == c.line && error.place.column == c.column && error.sentence.find(c.part) != std::string::npos);
    }
    CHECK(found);
  }
}

TEST_CASE("one fault makes one error: what follows from it is not reported") {
  for (const std::string& text :
       {grey + "sphere s center 0 0 0 radius x material grey\n", std::string("material grey reflectance 7\n") + ball,
        grey + "sphere s { center 0 0 0\n radios 1\n material grey }\n" + ball,
        grey + "define a {\n sphere s center 0 0 0 radius 0 material grey\n}\nuse a as b\nuse a as c\n",
        grey + "sphere s center 0 0 0 radius 1 material grey {\n" + "foo {\n bar {\n }\n }\n}\n"}) {
    const apps::SceneResult result = apps::parse_scene(text);
    INFO(apps::to_text(result, "test"));
    // The last text has two: an unknown word, and a block inside a block.
    CHECK(result.errors.size() == (text.find("foo") == std::string::npos ? 1 : 2));
  }
}

TEST_CASE("reading goes on after an error, in the order of the file, up to a limit") {
  const apps::SceneResult three = apps::parse_scene("material a reflectance 2\nfoo\nsphere s center 0 0 0 radius 1 material b\n");
  REQUIRE(three.errors.size() == 3);
  CHECK(three.errors[0].place.line == 1);
  CHECK(three.errors[1].place.line == 2);
  CHECK(three.errors[2].place.line == 3);
  CHECK_FALSE(three.more_errors);
  CHECK(apps::to_text(three, "my.scene").find("my.scene:1:24: error: reflectance '2' lies outside") == 0);

  std::string text;
  for (int i = 0; i < 1000; ++i) { text += "foo\n"; }
  const apps::SceneResult many = apps::parse_scene(text);
  CHECK(many.errors.size() == apps::max_errors);
  CHECK(many.more_errors);
  CHECK(apps::to_text(many, "x").find("given up after 20 errors") != std::string::npos);
}

TEST_CASE("unions nested beyond the limit are refused once, however deep they are") {
  for (const int depth : {65, 100'000}) {
    std::string text = grey;
    for (int i = 0; i < depth; ++i) { text += "union u material grey {\n"; }
    text += "box b from 0 0 0 to 1 1 1\n";
    for (int i = 0; i < depth; ++i) { text += "}\n"; }
    const apps::SceneResult result = apps::parse_scene(text);
    REQUIRE(result.errors.size() == 1);
    CHECK(result.errors[0].sentence.find("nested deeper than 64") != std::string::npos);
  }
}
