// SPDX-License-Identifier: MIT
// Facts: the JSON has every one under its path; the text shows those that it names, and is left out where one is not known.
#include <random>
#include <string>
#include <vector>

#include "apps/facts.hpp"
#include "catch.hpp"
#include "json.hpp"

TEST_CASE("facts: every value stands in the JSON under its path, however objects are nested and follow each other") {
  std::mt19937 random(23);
  INFO("seed 23");
  for (int run = 0; run < 200; ++run) {
    apps::Facts facts;
    std::vector<std::vector<std::string>> paths;
    std::vector<std::string> open;  // the objects around the next fact
    int name = 0;                   // every key is new, so no object is opened twice
    for (int i = 0; i < 20; ++i) {
      open.resize(open.size() - std::min<std::size_t>(open.size(), random() % 3));
      while (random() % 3 == 0) { open.push_back(std::string("o").append(std::to_string(name++))); }
      std::vector<std::string> path = open;
      path.push_back("k" + std::to_string(name++));
      std::string dotted = path[0];
      for (std::size_t k = 1; k < path.size(); ++k) { dotted += "." + path[k]; }
      facts.add(dotted, static_cast<std::uint64_t>(i));
      paths.push_back(path);
    }
    const json::Value root = json::parse(facts.json());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const json::Value* value = &root;
      for (const std::string& key : paths[i]) { value = &(*value)[key]; }
      CHECK(value->number() == static_cast<double>(i));
    }
  }
}

TEST_CASE("facts: a sentence shows each fact in its unit, and nothing when one of them is not known") {
  apps::Facts facts;
  facts.add("share", 0.0123, "%");
  facts.add("size", 12'345'678U, "B");
  facts.add("rays", 1'234'567U);
  facts.add("seed", 1'234'567U, "1");
  facts.add("sum.mean", 1.0, "%.3f");
  facts.add("camera", std::string("front"));
  facts.add("unknown", std::optional<double>());
  CHECK(facts.text("{share} of {size}") == "1.23 % of 12.3 MB");
  CHECK(facts.text("{rays} rays, seed {seed}, mean {sum.mean}, {camera}") == "1 234 567 rays, seed 1234567, mean 1.000, front");
  CHECK(facts.text("no fact") == "no fact");
  CHECK_FALSE(facts.text("{rays} and {unknown}"));
  CHECK_FALSE(facts.text("{nowhere}"));
  CHECK(json::parse(facts.json())["unknown"].is_null());
}
