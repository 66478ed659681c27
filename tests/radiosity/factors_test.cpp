// SPDX-License-Identifier: MIT

// The matrix of form factors: laws (reciprocity, row sums, covered ground, faces against rays) and the reference values, with a table of
// errors and times. Reference data are skipped where they are not at hand.

#include <ctime>

#include <radiosity/total_exchange.hpp>
#include <raycast/objects/mesh.hpp>

#include "catch.hpp"
#include "json.hpp"
#include "reference_data.hpp"
#include "reference_factors.hpp"
#include "scenes.hpp"

using radiosity::Factors;
using radiosity::Scene;
using reference::position;
using reference::positions;
using reference::read;

namespace {

Factors factors_of(const Scene& scene, double error = 1e-3, unsigned threads = 1) {
  radiosity::FactorOptions options;
  options.error = error;
  options.threads = threads;
  radiosity::FactorsResult result = radiosity::factors(scene, options);
  REQUIRE(result.factors);
  return std::move(*result.factors);
}

std::size_t row(const Factors& f, const std::string& name) {
  for (std::size_t i = 0; i < f.surfaces.size(); ++i) {
    if (f.surfaces[i].name == name) { return i; }
  }
  FAIL("no surface " << name);
  return 0;
}

Scene grey() { return {{{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}}, {}}; }

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

TEST_CASE("Sobol points: any 16 of a sequence that begin at a multiple of 16 fill the 16 strips of each coordinate") {
  const radiosity::Sobol4 sequence{7, 3};
  for (const std::uint32_t first : {0u, 16u, 4096u}) {
    std::uint32_t seen[4] = {0, 0, 0, 0};
    for (std::uint32_t i = first; i < first + 16; ++i) {
      const auto u = sequence(i);
      for (std::size_t d = 0; d < 4; ++d) { seen[d] |= 1u << static_cast<unsigned>(u[d] * 16.0); }
    }
    for (const std::uint32_t s : seen) { CHECK(s == 0xffffu); }
  }
}

TEST_CASE("a point sees nothing of a square behind a larger one, and all of it beside") {
  const radiosity::Polygon target{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const radiosity::Polygon plate{{-1, -1, 0.5}, {2, -1, 0.5}, {2, 2, 0.5}, {-1, 2, 0.5}};
  const radiosity::Polygon half{{-1, -1, 0.5}, {0.5, -1, 0.5}, {0.5, 2, 0.5}, {-1, 2, 0.5}};
  const radiosity::Polygon beside{{2, 0, 0.5}, {3, 0, 0.5}, {3, 1, 0.5}, {2, 1, 0.5}};
  const glm::dvec3 up{0, 0, 1};
  const glm::dvec3 x{0.5, 0.5, 0};
  const double free = radiosity::point_to_polygon(x, up, target);
  const auto seen = [&](const radiosity::Polygon& blocker) {
    const radiosity::Blocker one{blocker, up};
    return radiosity::ShadowedTarget{target, -up, {&one, 1}, 1e-9}.form_factor(x, up);
  };
  CHECK(seen(plate) == 0.0);
  CHECK(seen(beside) == test::Approx(free).epsilon(1e-14));
  CHECK(seen(half) == test::Approx(0.5 * free).epsilon(1e-14));  // by symmetry
}

TEST_CASE("factors: reciprocity is exact, and a closed room with a lamp and a box on its floor has row sums of 1") {
  const Factors f = factors_of(scenes::room_with_box());
  CHECK(f.rays == 0);
  for (std::size_t i = 0; i < f.surfaces.size(); ++i) {
    const double area = f.surfaces[i].area.value;
    for (std::size_t j = 0; j < f.surfaces.size(); ++j) {
      CHECK(area * f(i, j).value == test::Approx(f.surfaces[j].area.value * f(j, i).value).epsilon(1e-14).margin(1e-18));
    }
    if (area > 0.0) { CHECK(std::abs(f.surfaces[i].row_sum.value - 1.0) <= 1e-5); }  // ten factors, 1e-6 each
  }
  // Ground under the box and behind the lamp is left out; the bottom of the box sees nothing.
  CHECK(f.surfaces[row(f, "room.z0")].area.value == test::Approx(1.0 - 0.09).epsilon(1e-12));
  CHECK(f.surfaces[row(f, "room.z1")].area.value == test::Approx(1.0 - 0.09).epsilon(1e-12));
  CHECK(f.surfaces[row(f, "box.z0")].area.value == 0.0);
  CHECK(f.surfaces[row(f, "box.z0")].row_sum.value == 0.0);
}

TEST_CASE("factors: what faces say and what rays say of the same room agree within the errors of the rays") {
  const Scene scene = scenes::room_with_box();
  const Factors f = factors_of(scene);
  const auto prepared = radiosity::prepare(scene);
  REQUIRE(prepared.prepared);
  radiosity::FactorRows rows = radiosity::name_rows(scene);
  radiosity::expose(rows, prepared.prepared->objects, radiosity::flat_faces(prepared.prepared->surfaces), 1e-9);
  const auto n = static_cast<std::uint32_t>(rows.rows.size());
  int compared = 0;
  double chi = 0.0;
  for (const std::string name : {"room.x0", "room.z1", "box.z1", "lamp"}) {
    const auto i = static_cast<std::uint32_t>(row(f, name));
    const radiosity::RaySource source{rows.rows[i].object, false, rows.rows[i].facets, i, rows.row_of[rows.rows[i].object]};
    radiosity::RayCounter counter{prepared.prepared->objects, rows.row_of, source, i, 1, n, 1};
    counter.extend(2048, 1);
    for (std::uint32_t j = 0; j < n; ++j) {
      const radiosity::RayCounter::Mean rays = counter.factor(i, j);
      const double z = (rays.value - f(i, j).value) / rays.error;
      CAPTURE(name, f.surfaces[j].name, rays.value, rays.error, f(i, j).value);
      CHECK(std::abs(z) < 5.0);  // of Student's distribution with 15 degrees of freedom: one in 6000
      chi += z * z;
      ++compared;
    }
    CHECK(counter.sum(i).value == 1.0);  // every ray arrives
  }
  CHECK(chi / compared < 2.0);
}

TEST_CASE("factors: lines through a sphere, a cylinder and a disk count their areas") {
  Scene scene = grey();
  scene.objects = {scenes::object("ball", raycast::Sphere::make({0, 0, 0}, 1.0).object),
                   scenes::object("can", raycast::Cylinder::make({3, 0, 0}, {0, 1, 1}, 0.5).object),
                   scenes::object("spot", raycast::Disk::make({0, 3, 0}, {0, -1, 0}, 1.0).object)};
  const auto prepared = radiosity::prepare(scene);
  REQUIRE(prepared.prepared);
  const radiosity::FactorRows rows = radiosity::name_rows(scene);
  const double unit = prepared.prepared->frame.to_scene_area(1.0);
  const double pi = std::numbers::pi;
  const double areas[5] = {4.0 * pi, 2.0 * pi * 0.5 * std::sqrt(2.0), pi * 0.25, pi * 0.25, pi};
  for (const auto& [object, first, count] : {std::tuple{0u, 0u, 1u}, std::tuple{1u, 1u, 3u}, std::tuple{2u, 4u, 1u}}) {
    radiosity::RayCounter counter{
        prepared.prepared->objects, rows.row_of, {object, false, {}, first, rows.row_of[object]}, first, count, 5, 1};
    counter.extend(1024, 1);
    for (std::uint32_t i = first; i < first + count; ++i) {
      const auto area = counter.area(i);
      CAPTURE(rows.rows[i].name, area.value * unit, area.error * unit);
      CHECK(std::abs(area.value * unit - areas[i]) <= 5.0 * area.error * unit);
      CHECK(area.error <= 0.02 * area.value);
    }
  }
}

TEST_CASE("factors: a closed room with round things in it: row sums of 1 within the errors, the same bits with any number of threads") {
  const Scene scene = scenes::furnace_with_things(0.5);
  const Factors f = factors_of(scene, 4e-3);
  CHECK(f.rays > 0);
  for (const Factors::Surface& s : f.surfaces) {
    CAPTURE(s.name, s.area.value, s.row_sum.value, s.row_sum.error);
    if (s.area.value > 0.0) { CHECK(std::abs(s.row_sum.value - 1.0) <= 4.0 * s.row_sum.error); }
  }
  const Factors again = factors_of(scene, 4e-3, 3);
  for (std::size_t k = 0; k < f.factor.size(); ++k) { CHECK(f.factor[k].value == again.factor[k].value); }
}

TEST_CASE("factors: surfaces are named sheets; the faces of a mesh are one surface for each material") {
  Scene scene = grey();
  scene.materials.push_back({"red", radiosity::Color{0.5, 0.1, 0.1}, radiosity::Color{0.0}});
  const std::vector<glm::dvec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  scene.objects = {scenes::object("wedge", raycast::Mesh::make(corners, faces).object, 0, true),
                   scenes::object("two", raycast::Mesh::make({{5, 5, 5}, {6, 5, 5}, {5, 6, 5}, {5, 5, 6}}, faces).object, 0, true)};
  scene.objects[1].material = {0, 1, 0, 0};
  const radiosity::FactorRows rows = radiosity::name_rows(scene);
  REQUIRE(rows.rows.size() == 3);
  CHECK(rows.rows[0].name == "wedge");
  CHECK(rows.rows[1].name == "two.grey");
  CHECK(rows.rows[2].name == "two.red");
  CHECK(rows.row_of[1] == std::vector<std::uint32_t>{1, 2, 1, 1});
  scene.objects.resize(1);
  CHECK(factors_of(scene)(0, 0).value == test::Approx(1.0).epsilon(1e-7));  // a closed room sees itself alone
}

TEST_CASE("factors: scaling by a power of two gives the same bits, moving by 1e5 changes them by less than 1e-6") {
  const Factors f = factors_of(scenes::room_with_box());
  const Factors large = factors_of(scenes::moved(scenes::room_with_box(), 0x1p20, glm::dvec3{0.0}));
  const Factors far = factors_of(scenes::moved(scenes::room_with_box(), 1.0, {1e5, -1e5, 1e5}));
  for (std::size_t k = 0; k < f.factor.size(); ++k) {
    CHECK(f.factor[k].value == large.factor[k].value);
    // Coordinates of 1e5 are known to 1.5e-11; the quadrature may part its elements otherwise.
    CHECK(std::abs(f.factor[k].value - far.factor[k].value) <= 1e-6);
  }
}

TEST_CASE("factors: what a solid keeps of its parts is a row, what is cut away is none, and what is buried has area 0") {
  Scene scene = grey();
  const raycast::CsgNode block{scenes::box({0, 0, 0}, {1, 1, 1}), "block", {}, {}, {}};
  const raycast::CsgNode slot{scenes::box({0.25, -1, 0.5}, {0.75, 2, 2}), "slot", {}, {}, {}};
  scene.objects = {scenes::object("room", scenes::box({-1, -1, 0}, {2, 2, 3}), 0, true),
                   scenes::object("solid", raycast::Csg::make({{}, {}, raycast::CsgOperation::subtract, {block, slot}, {}}).object)};
  const Factors f = factors_of(scene);
  std::vector<std::string> names;
  for (const Factors::Surface& s : f.surfaces) { names.push_back(s.name); }
  const std::vector<std::string> wanted{"room.x0",        "room.x1",        "room.y0",        "room.y1",        "room.z0",
                                        "room.z1",        "solid.block.x0", "solid.block.x1", "solid.block.y0", "solid.block.y1",
                                        "solid.block.z0", "solid.block.z1", "solid.slot.x0",  "solid.slot.x1",  "solid.slot.z0"};
  CHECK(names == wanted);
  CHECK(f.surfaces[row(f, "solid.block.z0")].area.value == 0.0);
  CHECK(f.surfaces[row(f, "room.z0")].area.value == test::Approx(8.0).epsilon(1e-6));
  for (const Factors::Surface& s : f.surfaces) {
    if (s.area.value > 0.0) { CHECK(std::abs(s.row_sum.value - 1.0) <= 2e-5); }  // fifteen factors, 1e-6 each
  }
}

TEST_CASE("factors: the wanted error is reached where areas come from rays, too: two balls that are one, in the open") {
  Scene scene = grey();
  const raycast::CsgNode left{raycast::Sphere::make({0, 0, 0}, 1.0).object, "left", {}, {}, {}};
  const raycast::CsgNode right{raycast::Sphere::make({1, 0, 0}, 1.0).object, "right", {}, {}, {}};
  scene.objects = {scenes::object("twins", raycast::Csg::make({{}, {}, raycast::CsgOperation::unite, {left, right}, {}}).object)};
  const Factors f = factors_of(scene, 2e-3);
  CHECK(f.converged);
  REQUIRE(f.surfaces.size() == 2);
  for (const Factors::Surface& s : f.surfaces) {  // each lacks a cap of height 1/2
    CHECK(std::abs(s.area.value - 3.0 * std::numbers::pi) <= 4.0 * s.area.error);
    CHECK(s.area.error <= 0.02 * s.area.value);
  }
  CHECK(f(0, 0).value == 0.0);
  CHECK(std::abs(f(0, 1).value - f(1, 0).value) <= 4.0 * (f(0, 1).error + f(1, 0).error));  // by symmetry
  CHECK(f(0, 1).value > 4.0 * f(0, 1).error);
}

TEST_CASE("total exchange: black surfaces exchange by their form factors, and reciprocity is exact") {
  const Factors f = factors_of(scenes::room_with_box());
  const std::size_t n = f.surfaces.size();
  const auto black = radiosity::total_exchange(f, std::vector<double>(n, 1.0));
  std::vector<double> emissivity;
  for (std::size_t i = 0; i < n; ++i) { emissivity.push_back(static_cast<double>(i % 4) / 3.0); }  // 0 and 1 among them
  const auto mixed = radiosity::total_exchange(f, emissivity);
  REQUIRE(black.exchange);
  REQUIRE(mixed.exchange);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      CHECK(black.exchange->factor[i * n + j].value == test::Approx(f(i, j).value).epsilon(1e-14).margin(1e-18));
      CHECK(black.exchange->factor[i * n + j].error >= f(i, j).error * (1.0 - 1e-12));
      CHECK(f.surfaces[i].area.value * mixed.exchange->factor[i * n + j].value ==
            test::Approx(f.surfaces[j].area.value * mixed.exchange->factor[j * n + i].value).epsilon(1e-13).margin(1e-18));
    }
    // The room is closed: what a surface absorbs when all have one temperature is what it emits. Row sums of F are 1 within 1e-5, and
    // in six bounces or so, a third of the surfaces being nearly black, that grows no more than tenfold.
    if (f.surfaces[i].area.value > 0.0) { CHECK(std::abs(mixed.exchange->row_sum[i].value - emissivity[i]) <= 1e-4); }
  }
}

TEST_CASE("total exchange: concentric spheres, 1 / (1 / e1 + (A1 / A2) (1 / e2 - 1)), and the errors of the form factors carried on") {
  const double pi = std::numbers::pi;
  const auto spheres = [&](double inner, double self) {  // F of the inner sphere to the outer one, and of the outer one to itself
    Factors f;
    f.surfaces = {{"inner", {4.0 * pi, 0.0}, {1.0, 0.0}}, {"outer", {16.0 * pi, 0.0}, {1.0, 0.0}}};
    f.factor = {{0.0, 0.0}, {inner, 1e-4}, {0.25 * inner, 0.25e-4}, {self, 0.0}};
    return f;
  };
  const std::vector<double> emissivity{0.3, 0.05};
  const auto result = radiosity::total_exchange(spheres(1.0, 0.75), emissivity);
  REQUIRE(result.exchange);
  const auto& script = result.exchange->factor;
  CHECK(script[1].value == test::Approx(1.0 / (1.0 / 0.3 + 0.25 * (1.0 / 0.05 - 1.0))).epsilon(1e-13));
  CHECK(result.exchange->row_sum[0].value == test::Approx(0.3).epsilon(1e-13));
  CHECK(result.exchange->row_sum[1].value == test::Approx(0.05).epsilon(1e-13));
  // One exchange is off by its error: what that changes is within what is stated, and at most twice below it. (A_1 script-F_12 depends on the
  // exchange through two terms of one sign, which are added in quadrature times the root of 2.)
  const auto moved = radiosity::total_exchange(spheres(1.0 - 1e-4, 0.75), emissivity);
  REQUIRE(moved.exchange);
  for (std::size_t k = 0; k < 4; ++k) {
    const double change = std::abs(moved.exchange->factor[k].value - script[k].value);
    CHECK(change <= 1.01 * script[k].error);
    CHECK(change >= 0.49 * script[k].error);
  }
}

TEST_CASE("total exchange: a mirror room has no steady state, and impossible emissivities are refused") {
  const Factors f = factors_of(scenes::furnace_cube(0.5));
  CHECK(!radiosity::total_exchange(f, std::vector<double>(6, 0.0)).refusal.empty());
  CHECK(!radiosity::total_exchange(f, std::vector<double>(5, 0.5)).refusal.empty());
  CHECK(!radiosity::total_exchange(f, std::vector<double>(6, 1.5)).refusal.empty());
  const auto nearly = radiosity::total_exchange(f, std::vector<double>(6, 1e-3));
  REQUIRE(nearly.exchange);
  // Each wall exchanges with all six alike but for what the first bounces say.
  for (const radiosity::Estimate& sum : nearly.exchange->row_sum) { CHECK(std::abs(sum.value - 1e-3) <= 4.0 * sum.error); }
}

TEST_CASE("factors: faulty scenes and options are refused with a sentence") {
  CHECK(radiosity::factors(grey()).faults.size() == 1);
  radiosity::FactorOptions options;
  options.error = 0.0;
  CHECK(radiosity::factors(scenes::two_plates(0.5), options).faults.size() == 1);
}

TEST_CASE("reference: form factors behind a blocker within 1e-6") {
  const json::Value data = read("formfactors/ff_occluded.json");
  if (data.is_null()) { return; }
  for (const json::Value& c : data.array()) {
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

// A room of View3D: the polygons that it combines into one row are one open mesh.
Scene view3d_room(const json::Value& c, double reflectance) {
  Scene scene{{{"grey", radiosity::Color{reflectance}, radiosity::Color{0.0}}}, {}};
  for (const json::Value& r : c["rows"].array()) {
    std::vector<glm::dvec3> corners;
    std::vector<std::vector<std::uint32_t>> faces;
    std::string name;
    for (const json::Value& s : c["surfaces"].array()) {
      if (s["combined_into"].number() != r.number()) { continue; }
      if (name.empty()) { name = s["name"].string(); }
      faces.emplace_back();
      for (const glm::dvec3& p : positions(s["vertices"])) {
        faces.back().push_back(static_cast<std::uint32_t>(corners.size()));
        corners.push_back(p);
      }
    }
    scene.objects.push_back(scenes::object(name, raycast::Mesh::make(corners, faces).object));
  }
  return scene;
}

}  // namespace

TEST_CASE("reference: the rooms of View3D, form factors and script F; row sums of the closed ones within 1e-5 of 1 and of the emissivity") {
  const json::Value data = read("view3d/view3d.json");
  if (data.is_null()) { return; }
  std::optional<Factors> gunter;
  int scripts = 0;
  for (const json::Value& c : data.array()) {
    const std::string name = c["name"].string();
    const auto differences = [&](const auto& value, const char* table) {
      double error = 0.0;
      for (std::size_t i = 0; i < c["rows"].array().size(); ++i) {
        for (std::size_t j = 0; j < c["rows"].array().size(); ++j) {
          error = std::max(error, std::abs(value(i, j) - c[table][i][j].number()));
        }
      }
      return error;
    };
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
      line("View3D " + name, differences(value, "scriptF_from_mc"), sums, cpu_since(start));
      CHECK(sums <= 1e-5);
      CHECK(differences(value, "scriptF_from_mc") <= 1e-3);
      CHECK(differences(value, "scriptF_eps1e6") <= 1e-3);
      CHECK(differences(value, "scriptF_published") <= 6e-3);  // at 1e-4, by which View3D's own factors are off by up to .0055
      ++scripts;
      continue;
    }
    const Factors f = factors_of(view3d_room(c, 0.1));
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
    const double error = differences([&](std::size_t i, std::size_t j) { return f(i, j).value; }, "view3d_eps1e6");
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

TEST_CASE("reference: form factors of curved surfaces") {
  const json::Value data = read("formfactors/ff_curved.json");
  if (data.is_null()) { return; }
  int cases = 0;
  for (const json::Value& c : data.array()) {
    const std::string family = c["family"].string();
    const json::Value& shape = c["shape"];
    if (family == "element_to_polygon") {
      std::vector<glm::dvec3> polygon = positions(shape["polygon"]);
      const glm::dvec3 x = position(shape["point"]);
      // Some triangles of the file turn their back to the point.
      if (glm::dot(radiosity::vector_area(polygon), x - polygon[0]) < 0.0) { std::reverse(polygon.begin(), polygon.end()); }
      const double value = radiosity::point_to_polygon(x, position(shape["normal"]), polygon);
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
