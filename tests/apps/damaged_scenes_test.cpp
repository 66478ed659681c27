// SPDX-License-Identifier: MIT
// Damaged scene files: never a crash, never a hang, always a place and a reason.
#include "catch.hpp"

#include <chrono>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene_file.hpp"
#include "scene_texts.hpp"

namespace {

using Named = std::pair<std::string, std::string>;

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  text.reserve(part.size() * times);
  for (std::size_t i = 0; i < times; ++i) { text += part; }
  return text;
}

std::string example(const std::string& name) {
  std::string fault;
  return apps::read_text(std::string(HALFLIGHT_SCENES) + "/" + name + ".scene", fault).value();
}

using scene_texts::ball;
using scene_texts::grey;

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// Group k uses group k + 1 `times` times; the last one holds a ball.
std::string tower(std::size_t height, std::size_t times) {
  std::string text = grey;
  for (std::size_t k = 0; k < height; ++k) {
    text += "define g" + std::to_string(k) + " {\n";
    for (std::size_t i = 0; i < times; ++i) { text += "use g" + std::to_string(k + 1) + " as u" + std::to_string(i) + "\n"; }
    text += "}\n";
  }
  return text + "define g" + std::to_string(height) + " {\n" + ball + "}\nuse g0 as all\n";
}

std::string ring(std::size_t length) {
  std::string text = grey;
  for (std::size_t k = 0; k < length; ++k) {
    text += "define g" + std::to_string(k) + " {\nuse g" + std::to_string((k + 1) % length) + " as u\n}\n";
  }
  return text + "use g0 as all\n";
}

// All of these are wrong.
std::vector<Named> damaged() {
  const std::string cornell = example("cornell");
  const std::string room = example("room");
  std::vector<Named> files;
  const auto add = [&](const std::string& name, std::string text) { files.emplace_back(name, std::move(text)); };
  // truncated inside a block or a statement
  for (const char* const word : {"polygon floor", "material white {", "vertex 0      0 0\n", "mesh short_block", "face 4 5 6",
                                 "camera front  eye 0.278", "reflectance 0.725", "reflectance 0  emission 17 12"}) {
    const std::size_t at = cornell.find(word);
    REQUIRE(at != std::string::npos);
    add(std::string("truncated after ") + word, cornell.substr(0, at + std::string(word).size()));
  }
  // braces
  add("last brace missing", cornell.substr(0, cornell.rfind('}')));
  add("first closing brace missing", with_replaced(cornell, "}\n", "\n"));
  add("first opening brace missing", with_replaced(cornell, "material white {", "material white"));
  add("brace too many", with_replaced(cornell, "}\n", "}}\n"));
  add("a million open braces", grey + repeated("{", 1'000'000));
  add("a million closing braces", grey + repeated("}", 1'000'000));
  add("a million nested groups", grey + repeated("define a {\n", 1'000'000));
  add("a million open braces in an object", grey + "sphere s " + repeated("{ ", 1'000'000));
  add("braces only", repeated("{}\n", 1000));
  // binary
  add("zeros", std::string(100'000, '\0'));
  add("an ELF header", std::string("\x7f"
                                   "ELF\x02\x01\x01\0\0\0\0\0",
                                   12));
  add("a PNG header", "\x89PNG\r\n\x1a\n");
  add("UTF-16", std::string("m\0a\0t\0e\0r\0", 10));
  add("a zero in the middle", with_replaced(cornell, "polygon", std::string("pol\0gon", 7)));
  add("high bytes", repeated("\xff", 1000));
  // numbers
  add("huge coordinate", with_replaced(cornell, "vertex 0.5528 0 0", "vertex 1e308 0 0"));
  add("overflowing number", with_replaced(cornell, "0.5528", "1e999999999"));
  add("a number of a million digits", with_replaced(cornell, "0.5528", repeated("9", 1'000'000)));
  add("nan", with_replaced(cornell, "0.5528", "nan"));
  add("infinity", with_replaced(room, "radius 0.6", "radius inf"));
  add("huge face index", with_replaced(cornell, "face 0 1 2", "face 0 1 99999999999"));
  add("negative face index", with_replaced(cornell, "face 0 1 2", "face 0 1 -1"));
  add("scaled to nothing", with_replaced(room, "inside", "inside scale 1e-300"));
  add("scaled beyond everything", grey + ball.substr(0, ball.size() - 1) + repeated(" scale 1e30", 50) + "\n");
  // names
  add("unknown material", with_replaced(room, "material ball\n", "material bull\n"));
  add("unknown word", with_replaced(room, "center", "centre"));
  add("unknown sheet", with_replaced(room, "sheet x0", "sheet x9"));
  add("no material", with_replaced(room, "material wall  refl", "material wand  refl"));
  add("same name twice", room + "sphere ball center 9 9 9 radius 1 material ball\n");
  // groups
  add("use of itself", grey + "define a {\n" + ball + "use a as b\n}\nuse a as c\n");
  add("a ring of 3 groups", ring(3));
  add("a ring of 100 000 groups", ring(100'000));
  add("a tower of 100 000 groups", tower(100'000, 1));
  add("2^60 balls", tower(60, 2));
  add("10^9 balls", tower(9, 10));
  // long and empty
  add("a line of 10 million letters", repeated("x", 10'000'000));
  add("a line of a million words", repeated("word ", 1'000'000));
  add("a name of a million letters", "material " + repeated("n", 1'000'000) + " reflectance 0.5\n");
  add("a polygon of 100 000 corners", grey + "polygon p material grey {\n" + repeated("vertex 0 0 0\n", 100'000) + "}\n");
  add("empty", "");
  add("comments only", repeated("# nothing\n", 1000));
  add("not a scene", "<html><body>404 not found</body></html>\n");
  // geometry
  add("polygon that is not planar", with_replaced(cornell, "vertex 0.5496 0 0.5592", "vertex 0.5496 0.1 0.5592"));
  add("polygon that crosses itself", grey + "polygon p material grey { vertex 0 0 0 vertex 1 1 0 vertex 1 0 0 vertex 0 1 0 }\n");
  add("mesh inside out",
      grey + "mesh m material grey { vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 vertex 0 0 1 face 0 1 2 face 0 3 1 face 0 2 3 face 1 3 2 }\n");
  return files;
}

}  // namespace

TEST_CASE("damaged scene files are refused with a place and a reason, quickly") {
  const std::vector<Named> files = damaged();
  CHECK(files.size() >= 40);
  for (const auto& [name, text] : files) {
    const auto begin = std::chrono::steady_clock::now();
    const apps::SceneResult result = apps::parse_scene(text);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    INFO(name);
    CHECK_FALSE(result.file);
    CHECK(seconds.count() < 20.0);  // a guard against a hang, not a measurement: all are far below a second
    REQUIRE_FALSE(result.errors.empty());
    CHECK(result.errors.size() <= apps::max_errors);
    for (const apps::InputError& error : result.errors) {
      CHECK(error.place.line >= 1);
      CHECK(error.place.column >= 1);
      CHECK(error.sentence.size() > 10);
      CHECK(error.sentence.size() < 700);
    }
  }
}

TEST_CASE("a scene that is cut off anywhere is read or refused with a place") {
  const std::string text = example("room");
  for (std::size_t length = 0; length < text.size(); ++length) {
    const apps::SceneResult result = apps::parse_scene(std::string_view(text).substr(0, length));
    CHECK(result.file.has_value() == result.errors.empty());
  }
}

TEST_CASE("random damage to a scene is survived") {
  constexpr unsigned seed = 20260101;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const std::string cornell = example("cornell");
  const std::string alphabet = "{}#\n\r\t .-+eE0129axyz\"\\\xc3\xbc\x7f";
  for (int run = 0; run < 2000; ++run) {
    std::string text = cornell;
    for (unsigned edits = 1 + random() % 8; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = alphabet[random() % alphabet.size()];
          break;
        case 1:
          text.erase(at, 1 + random() % 40);
          break;
        default:
          text.insert(at, 1, alphabet[random() % alphabet.size()]);
          break;
      }
    }
    const apps::SceneResult result = apps::parse_scene(text);
    CHECK(result.file.has_value() == result.errors.empty());
  }
}

TEST_CASE("files that cannot be read are refused with a reason") {
  std::string fault;
  CHECK_FALSE(apps::read_text("no/such/file.scene", fault));
  CHECK(fault.find("cannot be opened") == 0);
  CHECK_FALSE(apps::read_text(HALFLIGHT_SCENES, fault));
  CHECK(fault.find("folder") != std::string::npos);
}
