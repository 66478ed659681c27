// SPDX-License-Identifier: MIT
// The reading path leads to files that are there, past all programs, and these are short; the map of the paper names what is there.
#include "catch.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path examples = fs::path(HALFLIGHT_SOURCE) / "examples";

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) { found.push_back((*at)[1]); }
  return found;
}

}  // namespace

TEST_CASE("reading path: all that it names is there, and it leads past every program") {
  const std::string text = program::content(examples / "README.md");
  for (const std::string& link : matches(text, R"(\]\(([^)]*)\))")) {
    INFO(link);
    CHECK(fs::exists(examples / link));
  }
  for (const std::string& file : matches(text, R"(\b((euler|scenes)/\w+\.\w+))")) {
    INFO(file);
    CHECK(fs::exists(examples / file));
  }
  std::size_t programs = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(examples)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".cpp") { continue; }
    ++programs;
    INFO(name);
    CHECK(text.find("](" + name + ")") != text.npos);
    const std::string code = program::content(entry.path());
    CHECK(std::count(code.begin(), code.end(), '\n') < 80);
    CHECK((code.find("TEST_CASE") != code.npos || fs::exists(fs::path(entry.path()).replace_extension(".expected"))));
  }
  CHECK(programs >= 13);
}

TEST_CASE("map of the paper: every section is there, and every name that it gives, a name that is gone is told") {
  const std::string map = program::content(examples / "paper.md");
  for (const char* section : {"1 ", "2.1 ", "2.2 ", "3 ", "4.1 ", "4.2 ", "4.3 ", "4.4 ", "4.5 ", "5 "}) {
    INFO(section);
    CHECK(map.find(std::string("\n## ") + section) != map.npos);
  }
  const program::Place place;
  const auto run = [&](const std::string& page) {
    place.write("page.md", page);
    const std::string command = "sh '" + (examples / "paper.sh").string() + "' '" + (place.path() / "page.md").string() + "' >'" +
                                (place.path() / "out").string() + "' 2>&1";
    return std::system(command.c_str());
  };
  CHECK(run(map) == 0);
  INFO(place.read("out"));
  CHECK(matches(place.read("out"), R"((brep/euler\.hpp:\d+: split_face))").size() == 1);
  for (const auto& [file, name] : {std::pair{"radiosity/solver/iteration.hpp", "residual"}, std::pair{"brep/csg/booleans.hpp", "unite"}}) {
    // The function, not a member or a name of an enumeration above it.
    const std::vector<std::string> at = matches(place.read("out"), std::string(file) + ":(\\d+): " + name + "\n");
    REQUIRE(at.size() == 1);
    std::istringstream lines(program::content(fs::path(HALFLIGHT_SOURCE) / file));
    std::string line;
    for (int k = std::stoi(at[0]); k > 0; --k) { std::getline(lines, line); }
    CHECK(line.find(std::string(" ") + name + "(") != std::string::npos);
  }
  CHECK(run(map + "[`split_faces_in_three`](../brep/euler.hpp)\n") != 0);
  CHECK(place.read("out").find("split_faces_in_three is not in brep/euler.hpp") != std::string::npos);
  CHECK(run(map + "[`split_face`](../brep/gone.hpp)\n") != 0);
  CHECK(run(map + "[`Inverse`](../brep/euler.hpp)\n") != 0);  // a word of a comment
}
