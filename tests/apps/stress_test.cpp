// SPDX-License-Identifier: MIT

// The stress command as its user meets it. What the cases say is their own business: here every one must hold.

#include <set>

#include "catch.hpp"
#include "json.hpp"
#include "program.hpp"

using program::Place;
using program::Run;

TEST_CASE("stress: every case holds, and the JSON says what the table says", "[slow]") {
  const Place place;
  const Run run = place.run("stress --json stress.json");
  INFO(run.out << run.err);
  CHECK(run.code == 0);
  CHECK(run.out.find("FAILED") == std::string::npos);
  const auto document = json::parse(place.read("stress.json"));
  std::set<std::string> names;
  std::size_t figures = 0;
  for (const auto& which : document.array()) {
    CHECK(names.insert(which["case"].string()).second);
    CHECK(which["holds"].boolean());
    CHECK_FALSE(which["why"].string().empty());
    CHECK(run.out.find(which["why"].string()) != std::string::npos);
    figures += which["figures"].array().size();
    for (const auto& figure : which["figures"].array()) { CHECK(figure["holds"].boolean()); }
  }
  CHECK(run.out.find(std::to_string(names.size()) + " cases, " + std::to_string(figures) + " figures: all hold") != std::string::npos);
}

TEST_CASE("stress: chosen cases run alone, in their own order, each once, and print the same every time") {
  const Place place;
  const Run run = place.run("stress materials dark materials");
  CHECK(run.code == 0);
  CHECK(run.out.find("materials") < run.out.find("\ndark"));
  CHECK(run.out.find("2 cases, ") != std::string::npos);
  CHECK(place.run("stress dark materials").out == run.out);
}

TEST_CASE("stress: what cannot be run is refused before any work") {
  const Place place;
  const Run unknown = place.run("stress dark drak");
  CHECK(unknown.code == 2);
  CHECK(unknown.out.empty());
  CHECK(unknown.err.find("no case 'drak'") != std::string::npos);
  CHECK(unknown.err.find("stiff, ") != std::string::npos);  // the names that there are
  CHECK(place.run("stress ''").code == 2);
  CHECK(place.run("stress --jsn x").code == 2);
  CHECK(place.run("stress dark --json none/a.json").code == 1);
  CHECK(place.run("stress dark --json .").code == 1);
  const Run list = place.run("stress --list");
  CHECK(list.code == 0);
  CHECK(list.out.find("stiff ") == 0);
  CHECK(place.entries() == 0);
}
