// SPDX-License-Identifier: MIT

// Form factors against values that were found without this code (tests/data/README.md): behind a blocker, in rooms with things in the
// way, on curved surfaces, and against View3D where its figures are at hand; with a table of errors and times.

#include <ctime>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factors.hpp>
#include <radiosity/factors/total_exchange.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/scene/scene.hpp>
#include <raycast/objects/mesh.hpp>

#include "catch.hpp"
#include "factors_of.hpp"
#include "json.hpp"
#include "reference_data.hpp"
#include "reference_factors.hpp"
#include "scenes.hpp"

using radiosity::Factors;
using radiosity::Scene;
using reference::position;
using reference::positions;
using reference::read;
using scenes::factors_of;
using scenes::grey;

namespace {

double cpu_since(std::clock_t start) { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; }

double stated(const Factors& f) {
  double error = 0.0;
  for (const radiosity::Estimate& e : f.factor) { error = std::max(error, e.error); }
  return error;
}

// One line of the table.
void line(const std::string& name, double error, double stated_error, double seconds) {
  WARN(name << ": error " << error << ", stated " << stated_error << ", " << seconds << " s CPU");
}

}  // namespace

TEST_CASE("reference: form factors behind a blocker within 1e-6") {
  const json::Value data = read("rooms.json");
  for (const json::Value& c : data["blockers"].array()) {
    Scene scene = grey();
    scene.objects = {scenes::object("P", scenes::polygon(positions(c["P"]))), scenes::object("Q", scenes::polygon(positions(c["Q"])))};
    for (const json::Value& o : c["occluders"].array()) {
      scene.objects.push_back(scenes::object("blocker", scenes::polygon(positions(o))));
    }
    const std::clock_t start = std::clock();
    const Factors f = factors_of(scene);
    const double error = std::abs(f(0, 1).value - c["F_PQ"].number());
    line(c["name"].string(), error, f(0, 1).error, cpu_since(start));
    CHECK(error <= 1e-6);
    CHECK(error <= f(0, 1).error);
    CHECK(f(1, 0).value == test::Approx(c["F_QP"].number()).margin(1e-6));
  }
}

namespace {

// Polygons that are one row of a matrix: an open mesh.
radiosity::SceneObject row_of(const std::string& name, const std::vector<std::vector<glm::dvec3>>& polygons) {
  std::vector<glm::dvec3> corners;
  std::vector<std::vector<std::uint32_t>> faces;
  for (const std::vector<glm::dvec3>& polygon : polygons) {
    faces.emplace_back();
    for (const glm::dvec3& p : polygon) {
      faces.back().push_back(static_cast<std::uint32_t>(corners.size()));
      corners.push_back(p);
    }
  }
  return scenes::object(name, raycast::Mesh::make(corners, faces).object);
}

Scene view3d_room(const json::Value& c) {
  Scene scene = grey();
  for (const json::Value& r : c["rows"].array()) {
    std::vector<std::vector<glm::dvec3>> polygons;
    std::string name;
    for (const json::Value& s : c["surfaces"].array()) {
      if (s["combined_into"].number() != r.number()) { continue; }
      if (name.empty()) { name = s["name"].string(); }
      polygons.push_back(positions(s["vertices"]));
    }
    scene.objects.push_back(row_of(name, polygons));
  }
  return scene;
}

// Greatest difference between value(i, j) and a matrix of the file.
template <class ValueOf>
double difference(const json::Value& matrix, const ValueOf& value) {
  double worst = 0.0;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix.size(); ++j) { worst = std::max(worst, std::abs(value(i, j) - matrix[i][j].number())); }
  }
  return worst;
}

// Eleven digits in the file, sums of ten of them.
constexpr double last_digit = 1e-10;

}  // namespace

TEST_CASE("reference: rooms with things in the way: form factors and script F within 1e-6 and within what is stated") {
  const json::Value data = read("rooms.json");
  CHECK(data["rooms"].size() == 3);
  for (const json::Value& c : data["rooms"].array()) {
    Scene scene = grey();
    std::vector<double> emissivity;
    for (const json::Value& s : c["surfaces"].array()) {
      std::vector<std::vector<glm::dvec3>> polygons;
      for (const json::Value& p : s["polygons"].array()) { polygons.push_back(positions(p)); }
      scene.objects.push_back(row_of(s["name"].string(), polygons));
      emissivity.push_back(s["emissivity"].number());
    }
    CAPTURE(c["name"].string());
    const std::clock_t start = std::clock();
    const Factors f = factors_of(scene);
    const radiosity::TotalExchangeResult script = radiosity::total_exchange(f, emissivity);
    const double seconds = cpu_since(start);
    REQUIRE(script.exchange);
    const std::size_t n = f.surfaces.size();
    REQUIRE(n == c["surfaces"].size());
    CHECK(f.rays == 0);
    for (std::size_t i = 0; i < n; ++i) {
      CHECK(f.surfaces[i].area.value == test::Approx(c["surfaces"][i]["area"].number()).epsilon(1e-9));
      CHECK(std::abs(f.surfaces[i].row_sum.value - 1.0) <= 1e-6);
      CHECK(std::abs(script.exchange->row_sum[i].value - emissivity[i]) <= 1e-6);
      for (std::size_t j = 0; j < n; ++j) {
        CAPTURE(f.surfaces[i].name, f.surfaces[j].name);
        CHECK(std::abs(f(i, j).value - c["F"][i][j].number()) <= f(i, j).error + last_digit);
        const radiosity::Estimate& exchange = script.exchange->factor[i * n + j];
        CHECK(std::abs(exchange.value - c["script_F"][i][j].number()) <= exchange.error + last_digit);
      }
    }
    const double factors = difference(c["F"], [&](std::size_t i, std::size_t j) { return f(i, j).value; });
    const double scripts =
        difference(c["script_F"], [&](std::size_t i, std::size_t j) { return script.exchange->factor[i * n + j].value; });
    line("room " + c["name"].string(), factors, stated(f), seconds);
    WARN("its script F: error " << scripts);
    CHECK(factors <= 1e-6);
    CHECK(scripts <= 1e-6);
  }
}

TEST_CASE("reference: the rooms of View3D, form factors and script F, row sums of the closed ones within 1e-5 of 1 and of the emissivity") {
  const std::string file = reference::of_others("view3d/view3d.json");
  if (file.empty()) { SKIP_TEST("no figures of View3D in " HALFLIGHT_REFERENCE_DATA); }
  const json::Value data = json::parse_file(file);
  std::optional<Factors> gunter;
  int scripts = 0;
  for (const json::Value& c : data.array()) {
    const std::string name = c["name"].string();
    const std::clock_t start = std::clock();
    if (name.find("scriptF") != std::string::npos) {
      REQUIRE(gunter);
      const std::size_t n = gunter->surfaces.size();
      const std::vector<double> emissivity(n, 0.9);
      const radiosity::TotalExchangeResult result = radiosity::total_exchange(*gunter, emissivity);
      REQUIRE(result.exchange);
      const auto value = [&](std::size_t i, std::size_t j) { return result.exchange->factor[i * n + j].value; };
      double sums = 0.0;
      for (const radiosity::Estimate& sum : result.exchange->row_sum) { sums = std::max(sums, std::abs(sum.value - 0.9)); }
      line("View3D " + name, difference(c["scriptF_from_mc"], value), sums, cpu_since(start));
      CHECK(sums <= 1e-5);
      CHECK(difference(c["scriptF_from_mc"], value) <= 1e-3);
      CHECK(difference(c["scriptF_eps1e6"], value) <= 1e-3);
      CHECK(difference(c["scriptF_published"], value) <= 6e-3);  // at 1e-4, by which View3D's own factors are off by up to .0055
      ++scripts;
      continue;
    }
    const Factors f = factors_of(view3d_room(c));
    const double seconds = cpu_since(start);
    CHECK(f.rays == 0);
    REQUIRE(f.surfaces.size() == c["rows"].array().size());
    double z = 0.0;
    double sums = 0.0;
    for (std::size_t i = 0; i < f.surfaces.size(); ++i) {
      sums = std::max(sums, std::abs(f.surfaces[i].row_sum.value - 1.0));
      for (std::size_t j = 0; j < f.surfaces.size(); ++j) {
        z = std::max(z, std::abs(f(i, j).value - c["mc_F"][i][j].number()) / (c["mc_se"][i][j].number() + 1e-6));
      }
    }
    const double error = difference(c["view3d_eps1e6"], [&](std::size_t i, std::size_t j) { return f(i, j).value; });
    line("View3D " + name, error, stated(f), seconds);
    if (name != "square-obstruction") { CHECK(sums <= 1e-5); }  // that one is open
    CHECK(error <= 1e-3);
    // View3D changes by .0055 in gunter1 between its own tolerances, and prints six digits.
    if (name != "gunter1") { CHECK(error <= 1e-5); }
    CHECK(z < 4.5);  // of some 300 factors by 4e5 rays each
    if (name == "gunter1") { gunter = f; }
  }
  CHECK(scripts == 1);
}

TEST_CASE("reference: form factors of curved surfaces", "[accuracy]") {
  const json::Value data = read("form_factors.json");
  int cases = 0;
  for (const json::Value& c : data["curved"].array()) {
    const std::string family = c["family"].string();
    const json::Value& shape = c["shape"];
    if (family == "element_to_polygon") {
      const double value = radiosity::point_to_polygon(position(shape["point"]), position(shape["normal"]), positions(shape["polygon"]));
      CHECK(std::abs(value - c["F"]["F"].number()) <= 1e-14);
      ++cases;
      continue;
    }
    const auto [scene, wanted] = reference::curved_case(c);
    REQUIRE(!wanted.empty());
    const std::clock_t start = std::clock();
    const Factors f = factors_of(scene, 1e-3);
    const double seconds = cpu_since(start);
    double error = 0.0;
    for (const reference::WantedFactor& w : wanted) {
      const double own = std::abs(f(w.from, w.to).value - c["F"][w.key].number());
      CAPTURE(family, c["name"].string(), w.key);
      CHECK(own <= 4.0 * f(w.from, w.to).error + 1e-12);
      error = std::max(error, own);
    }
    line(family + " " + c["name"].string(), error, stated(f), seconds);
    CHECK(error <= 1e-3);
    // Of the concentric spheres the outer one sees itself past the inner one: rays.
    if (family != "concentric_spheres") { CHECK(error <= 2e-5); }
    ++cases;
  }
  CHECK(cases == 21);
}
