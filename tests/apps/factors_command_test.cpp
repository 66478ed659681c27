// SPDX-License-Identifier: MIT

// The command that prints form factors.

#include "catch.hpp"

#include <string>

#include "json.hpp"
#include "program.hpp"

using program::Place;
using program::Run;
using program::scene;

TEST_CASE("factors prints the matrix and writes it as CSV and JSON") {
  const Place place;
  const Run run = place.run("factors " + scene("two_plates") + " --csv f.csv --json f.json");
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.out.find("0.1998249") != std::string::npos);
  CHECK(place.read("f.csv").starts_with(
      "surface,area,area error,row sum,row sum error,lower,upper,lower error,upper error\nlower,1,0,0.19982"));
  const json::Value report = json::parse(place.read("f.json"));
  CHECK(report["factors"][0][1].number() == test::Approx(0.19982489569838738).epsilon(1e-7));
  CHECK(report["methods"][0][1].string() == "faces");
  CHECK(report["surfaces"][1]["name"].string() == "upper");
  CHECK(report["converged"].boolean());
}

TEST_CASE("factors --total-exchange writes script F, one matrix of grey surfaces, three of coloured ones") {
  const Place place;
  const Run run = place.run("factors " + scene("two_plates") + " --total-exchange t.csv --json f.json");
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.out.find("script F, grey") != std::string::npos);
  CHECK(place.read("t.csv").starts_with(
      "channel,surface,area,emissivity,row sum,row sum error,lower,upper,lower error,upper error\ngrey,lower,1,1,"));
  const json::Value matrix = json::parse(place.read("f.json"))["total_exchange"][0]["factors"];
  // The lower plate is black: the upper one absorbs half of what arrives and sends back half, of which F arrives.
  constexpr double f = 0.19982489569838738;
  CHECK(matrix[0][1].number() == test::Approx(0.5 * f).epsilon(1e-7));
  CHECK(matrix[0][0].number() == test::Approx(0.5 * f * f).epsilon(1e-7));
  CHECK(matrix[1][1].number() == 0.0);
  const Run red = place.run("factors " + scene("cornell") + " --total-exchange t.csv --error 1e-2");
  INFO(red.err);
  CHECK(place.read("t.csv").find("\nblue,") != std::string::npos);
}

TEST_CASE("factors: exit code 2 for an error that makes no sense, 3 for a bad scene, 4 when the error is not reached") {
  const Place place;
  CHECK(place.run("factors " + scene("two_plates") + " --error 0").code == 2);
  place.write("bad.scene", "box b from 0 0 0 to 1 1\n");
  CHECK(place.run("factors bad.scene").code == 3);
  const Run run = place.run("factors " + scene("two_plates") + " --error 1e-12");
  CHECK(run.code == 4);
  CHECK(run.out.find("NOT REACHED") != std::string::npos);
}
