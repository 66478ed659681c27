// SPDX-License-Identifier: MIT
// The program's JSON writer and the tests' reader, each tried with the other.
#include "catch.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/material.hpp>

#include "apps/json.hpp"
#include "apps/report.hpp"
#include "json.hpp"

TEST_CASE("what the writer writes the reader reads") {
  apps::JsonWriter writer;
  writer.open_object();
  writer.key("text").string("a \"quoted\" \\ line\nwith \x01 and \xc3\xbc");
  writer.key("third").number(1.0 / 3.0).key("tiny").number(5e-324).key("huge").number(-1.7976931348623157e308);
  writer.key("none").number(std::nan("")).key("endless").number(std::numeric_limits<double>::infinity());
  writer.key("count").count(18446744073709551615ULL).key("yes").boolean(true).key("no").boolean(false);
  writer.key("empty list").open_array().close().key("empty object").open_object().close();
  writer.key("list").open_array().number(1).string("two").open_object().key("three").count(3).close().close();
  writer.close();
  const json::Value value = json::parse(writer.text());
  CHECK(value["text"].string() == "a \"quoted\" \\ line\nwith \x01 and \xc3\xbc");
  CHECK(value["third"].number() == 1.0 / 3.0);  // the shortest form reads back to the same bits
  CHECK(value["tiny"].number() == 5e-324);
  CHECK(value["huge"].number() == -1.7976931348623157e308);
  CHECK(value["none"].is_null());
  CHECK(value["endless"].is_null());
  CHECK(value["count"].number() == 18446744073709551615.0);
  CHECK(value["yes"].boolean());
  CHECK_FALSE(value["no"].boolean());
  CHECK(value["empty list"].size() == 0);
  CHECK(value["empty object"].size() == 0);
  CHECK(value["list"][2]["three"].number() == 3.0);
}

TEST_CASE("the reader knows escapes and numbers in quotes, and says what is missing") {
  const json::Value value = json::parse(R"({"a": "\u00e4\ud83d\ude00\n\/", "pi": "3.14159265358979323846", "list": [1, -0.5e+2]})");
  CHECK(value["a"].string() == "\xc3\xa4\xf0\x9f\x98\x80\n/");
  CHECK(value["pi"].number() == 3.14159265358979323846);
  CHECK(value["list"].numbers() == std::vector<double>{1.0, -50.0});
  CHECK(value.contains("pi"));
  CHECK_FALSE(value.contains("tau"));
  CHECK_THROWS_WITH(value["tau"], "JSON: no key \"tau\"; the object has: a, pi, list");
  CHECK_THROWS_WITH(value["list"][2], "JSON: no element 2 in an array of 2");
  CHECK_THROWS_WITH(value["a"].array(), "JSON: expected an array, found a string");
}

TEST_CASE("the reader is strict") {
  for (const char* const text :
       {"",         "{",     "[1,]",  "{\"a\":1,}",        "[01]",        "[1.]",    "[.5]", "[+1]", "[nan]", "[1e]", "\"\\x\"",
        "\"a\nb\"", "[1] 2", "{a:1}", "{\"a\":1,\"a\":2}", "\"\\ud800\"", "[1e999]", "tru",  "'a'",  "[1 2]"}) {
    INFO(text);
    CHECK_THROWS(json::parse(text));
  }
  CHECK_THROWS(json::parse(std::string(100'000, '[')));
  CHECK_THROWS_WITH(json::parse("[1,\n  x]", "data.json"), "data.json:2:3: expected a value, found 'x'");
}

TEST_CASE("the report has its documented keys") {
  apps::Report report;
  report.scene = "a \"scene\"";
  radiosity::Audit& audit = report.audit;
  audit.stages = {{"refine", 1.0, 2.0}, {"solve", 0.25, 0.5}, {"refine", 1.0, 2.0}};
  audit.wall_seconds = 2.25;
  audit.cpu_seconds = 4.5;
  audit.nodes = 12;
  audit.row_sum.mean = 0.5;
  audit.surface_error = radiosity::ErrorEstimate{0.02, 0.001, 0.018, 0.022};
  audit.leaf_error = radiosity::ErrorEstimate{0.04, 0.02, 0.0, 0.08};
  audit.left_out = {{"channels", "all is grey", "two thirds"}};
  audit.surfaces = {{"floor", 4.0, radiosity::Color(1.0, 2.0, 3.0)}};
  report.picture_time = radiosity::StageTime{"picture", 0.1, 0.1};
  const json::Value value = json::parse(apps::to_json(report));
  CHECK(value["scene"].string() == "a \"scene\"");
  CHECK(value["error"]["relative_l2"].number() == 0.02);
  CHECK(value["error"]["standard_error"].number() == 0.001);
  CHECK(value["error"]["leaf"]["relative_l2"].number() == 0.04);
  CHECK_FALSE(value["error"]["wide"].boolean());
  CHECK(value["error"]["leaf"]["wide"].boolean());
  CHECK(value["cpu_seconds"]["refine"].number() == 4.0);
  CHECK(value["cpu_seconds"]["total"].number() == 4.5);
  CHECK(value["cpu_seconds"]["picture"].number() == 0.1);
  CHECK(value["wall_seconds"]["solve"].number() == 0.25);
  for (const char* const key :
       {"polygons", "nodes", "leaves", "links", "rays", "bytes", "energy_balance", "escaped", "residual", "iterations", "exposure"}) {
    CHECK(value[key].is_number());
  }
  CHECK(value["row_sum"]["mean"].number() == 0.5);
  CHECK(value["row_sum"].contains("min"));
  CHECK(value["row_sum"].contains("max"));
  CHECK(value["left_out"][0]["why"].string() == "all is grey");
  CHECK(value["surfaces"][0]["radiosity"].numbers() == std::vector<double>{1.0, 2.0, 3.0});
  CHECK(value["closure"].is_null());
  CHECK(value["converged"].boolean());
  audit.surface_error.reset();
  audit.leaf_error.reset();
  CHECK(json::parse(apps::to_json(report))["error"].is_null());
  CHECK(apps::to_text(report).find("not measured") != std::string::npos);
}

TEST_CASE("an error is told with its interval, or as below its upper end where it is not known to within its own size") {
  const auto leaves = [](const radiosity::ErrorEstimate& error) {
    apps::Report report;
    report.audit.leaf_error = error;
    const std::string text = apps::to_text(report);
    const std::size_t at = text.find("leaf constants") + std::string_view("leaf constants").size();
    const std::string row = text.substr(at, text.find('\n', at) - at);
    return row.substr(row.find_first_not_of(' '));
  };
  CHECK(leaves({0.02, 0.001, 0.018, 0.022}) == "2 %  (1.8 % to 2.2 %)");
  CHECK(leaves({0.002, 0.0001, 0.0018, 0.0022}) == "0.2 %  (0.18 % to 0.22 %)");
  CHECK(leaves({0.002, 0.0006, 0.0008, 0.0032}) == "below 0.32 %");
  CHECK(leaves({0.02, 0.004, 0.012, 0.028}) == "2 %  (1.2 % to 2.8 %)");
  CHECK(leaves({0.02, 0.006, 0.008, 0.032}) == "below 3.2 %");
  CHECK(leaves({0.02, 0.02, 0.0, 0.04}) == "below 4 %");
  CHECK(leaves({0.0, 0.0, 0.0, 0.0}) == "none");
}
