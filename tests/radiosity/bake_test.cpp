// SPDX-License-Identifier: MIT
// Baking: the light comes back on the caller's own triangles, whatever the intake made of them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include <radiosity/bake/bake.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"

using soup::Soup;

namespace {

radiosity::BakeOptions quick() {
  radiosity::BakeOptions options;
  options.solve.epsilon = 0.02;
  options.solve.min_area = 1e-3;
  options.solve.audit_points = 0;
  options.solve.threads = 1;
  return options;
}

// A room with a lamp under its ceiling, and a box on its floor.
Soup room() {
  Soup soup;
  soup::add_box(soup, {0, 0, 0}, {4, 3, 2.5}, 2, true);
  soup::add_box(soup, {1, 1, 0}, {2, 2, 1}, 1);
  soup.polygon({{1.5, 1, 2.4}, {1.5, 2, 2.4}, {2.5, 2, 2.4}, {2.5, 1, 2.4}}, 1);
  return soup;
}

}  // namespace

// Of every polygon that was not left out: a part on each of its corners; its sheet faces the same way, unless it says that it is the back.
TEST_CASE("intake: every polygon knows the sheets that it became, whatever was done to it") {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    Soup whole = room(), damaged;
    soup::add_torus(whole, 12, 8);  // not planar where split
    damaged.materials = whole.materials;
    damaged.two_sided = {0, 1};
    std::vector<std::size_t> order(whole.count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t f : order) {
      std::vector<glm::dvec3> p = whole.outline(f);
      if (random() % 8 == 0) { std::reverse(p.begin(), p.end()); }
      damaged.polygon(p, whole.material[f]);
      if (random() % 8 == 0) { damaged.polygon(p, whole.material[f]); }
    }
    const std::size_t flat = damaged.count();
    damaged.polygon({{9, 9, 9}, {9, 9, 9}, {8, 8, 8}});
    const radiosity::Intake intake = damaged.take_in();
    REQUIRE(intake.parts.first.size() == damaged.count() + 1);
    CHECK(intake.parts.of(flat).empty());
    for (std::size_t p = 0; p < flat; ++p) {
      const auto parts = intake.parts.of(p);
      INFO("polygon " << p);
      REQUIRE_FALSE(parts.empty());
      const std::vector<glm::dvec3> outline = damaged.outline(p);
      const glm::dvec3 front = glm::normalize(brep::vector_area(outline));
      bool lamp_back = false;
      for (const radiosity::PolygonPart& part : parts) {
        REQUIRE(part.object < intake.objects.size());
        const raycast::PlacedObject object(intake.objects[part.object].shape, intake.objects[part.object].placement);
        const raycast::SurfacePoint at = object.project(part.sheet, outline[0]);
        // A corner lies in the plane of its sheets to within the intake's tolerance, 1e-6 of some 10 m, but that of a quadrilateral that
        // was split into triangles lies in one of their planes alone.
        const double along = glm::dot(at.normal, front);
        CHECK((part.back ? -along : along) > 0.9);
        lamp_back = lamp_back || part.back;
      }
      if (damaged.material[p] == 1) { CHECK(lamp_back); }
      double nearest = 1e9;
      for (const radiosity::PolygonPart& part : parts) {
        const raycast::PlacedObject object(intake.objects[part.object].shape, intake.objects[part.object].placement);
        nearest = std::min(nearest, glm::length(object.project(part.sheet, outline[0]).position - outline[0]));
      }
      CHECK(nearest < 2e-5);
    }
  }
}

// In a closed furnace every surface has B = E / (1 - rho), so every corner has, however the triangles came.
TEST_CASE("bake: in a furnace every corner and vertex has B = E / (1 - rho)") {
  for (const unsigned seed : {1U, 2U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::vector<float> xyz;
    std::vector<std::uint32_t> indices;
    Soup soup;
    soup::add_box(soup, {0, 0, 0}, {2, 1, 1}, 3, true);
    soup::add_box(soup, {0.5, 0.25, 0.25}, {1, 0.5, 0.5}, 1);
    for (std::size_t f = 0; f < soup.count(); ++f) {
      std::vector<glm::dvec3> p = soup.outline(f);
      std::rotate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(random() % 3), p.end());
      for (const glm::dvec3& v : p) {
        indices.push_back(static_cast<std::uint32_t>(xyz.size() / 4));
        for (int k = 0; k < 3; ++k) { xyz.push_back(static_cast<float>(v[k])); }
        xyz.push_back(-1.0F);  // another attribute between them
      }
    }
    const std::vector<radiosity::Material> materials{{"oven", {0.2, 0.5, 0.8}, {1.0, 2.0, 3.0}}};
    radiosity::MeshView mesh{xyz, indices, materials};
    mesh.stride = 4;
    const radiosity::BakeOutcome outcome = radiosity::bake(mesh, quick());
    REQUIRE(outcome.baked);
    CHECK(outcome.baked->colors.corner.size() == indices.size());
    CHECK(outcome.baked->colors.vertex.size() == xyz.size() / 4);
    CHECK(outcome.baked->colors.without == 0);
    // The scene is proven closed, so row sums are 1 and the error is that of the solver: residual 1e-8, amplified by 1 / (1 - 0.8).
    for (const auto* const list : {&outcome.baked->colors.corner, &outcome.baked->colors.vertex}) {
      for (const radiosity::Color& b : *list) {
        CHECK(b.x == Approx(1.0 / 0.8).epsilon(1e-6));
        CHECK(b.y == Approx(2.0 / 0.5).epsilon(1e-6));
        CHECK(b.z == Approx(3.0 / 0.2).epsilon(1e-6));
      }
    }
  }
}

// At the corners of the solution's own mesh the light between corners is the solution's.
TEST_CASE("bake: between corners the light is that of the solution, on the side that is asked for") {
  Soup soup = room();
  soup.two_sided = {0, 1};
  const radiosity::BakeOptions options = quick();
  const radiosity::BakeOutcome outcome = radiosity::bake(soup.view(), soup.materials, options);
  REQUIRE(outcome.baked);
  const radiosity::Intake intake = soup.take_in(options.intake);
  const radiosity::Outcome solved = radiosity::solve({soup.materials, intake.objects}, options.solve);
  REQUIRE(solved.solution);
  const auto inputs = radiosity::surfaces({soup.materials, intake.objects});
  const radiosity::Mesh& mesh = solved.solution->mesh;
  std::size_t compared = 0;
  for (std::size_t p = 0; p < soup.count(); ++p) {
    for (const radiosity::PolygonPart& part : intake.parts.of(p)) {
      for (const radiosity::MeshFace& face : mesh.faces) {
        const radiosity::InputSurface& input = inputs[face.surface];
        if (input.object != part.object || input.sheet != part.sheet || solved.solution->area[face.node] == 0.0) { continue; }
        for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
          const auto seen = outcome.baked->light.radiosity(p, mesh.positions[mesh.corners[c].vertex],
                                                           part.back ? radiosity::FaceSide::back : radiosity::FaceSide::front);
          REQUIRE(seen);
          CHECK(seen->x == Approx(mesh.corners[c].radiosity.x).epsilon(1e-9));
          ++compared;
        }
      }
    }
  }
  CHECK(compared > 1000);
  // The lamp shines on both sides, but the ceiling, close behind it, sends more back than the room.
  const std::size_t lamp = soup.count() - 1;
  const glm::dvec3 middle{2.0, 1.5, 2.4};
  const auto front = outcome.baked->light.radiosity(lamp, middle),
             back = outcome.baked->light.radiosity(lamp, middle, radiosity::FaceSide::back);
  REQUIRE(front);
  REQUIRE(back);
  CHECK(front->x == 10.0);  // it reflects nothing
  CHECK(back->x == 10.0);
}

TEST_CASE("bake: what cannot be solved is refused with a sentence; polygons that are left out take the light beside them") {
  const std::vector<radiosity::Material> materials{{"grey", glm::dvec3(0.5), glm::dvec3(1.0)}};
  const std::vector<float> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5};
  const auto sentences = [&](const radiosity::MeshView& mesh) {
    const radiosity::BakeOutcome outcome = radiosity::bake(mesh, quick());
    CHECK_FALSE(outcome.baked);
    CHECK(outcome.failure.kind == radiosity::Failure::Kind::invalid_scene);
    return outcome.failure.sentences;
  };
  const std::vector<std::uint32_t> two{0, 1}, beyond{0, 1, 9}, line{0, 1, 1}, good{0, 1, 2}, with_line{0, 1, 2, 0, 2, 2}, one{0};
  CHECK(sentences({xyz, two, materials})[0] == "there are 2 indices; a triangle has three");
  CHECK(sentences({xyz, good, materials, {}, 2})[0] == "the stride of the positions is 2; a vertex has three numbers");
  CHECK(sentences({xyz, with_line, materials, one})[0] == "there are 2 triangles, and materials of 1");
  CHECK(sentences({xyz, line, materials})[0] == "there is no polygon with an area");
  CHECK(sentences({xyz, beyond, materials}).size() == 2);
  CHECK(sentences({xyz, good, {}})[0] == "there is no polygon with an area");
  const std::vector<radiosity::Material> impossible{{"mirror", glm::dvec3(1.5), glm::dvec3(0.0)}};
  CHECK(sentences({xyz, good, impossible}).size() == 1);

  const radiosity::BakeOutcome outcome = radiosity::bake({xyz, with_line, materials}, quick());
  REQUIRE(outcome.baked);
  CHECK(outcome.baked->colors.without == 3);
  for (const radiosity::Color& b : outcome.baked->colors.corner) { CHECK(b.x == 1.0); }  // alone in the world
  CHECK(outcome.baked->colors.vertex[0].x == 1.0);
  CHECK(outcome.baked->colors.vertex[3].x == 0.0);  // without a triangle
}
