// SPDX-License-Identifier: MIT
// Baking: the light comes back on the caller's own triangles, whatever the intake made of them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <radiosity/bake/bake.hpp>
#include <radiosity/bake/lightmap.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"
#include "texture.hpp"

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

TEST_CASE("bake: what cannot be solved is refused with a sentence, polygons that are left out take the light beside them") {
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
  CHECK(sentences({xyz, good, {}})[0] == "there are no materials");
  CHECK(sentences({xyz, good, materials, std::vector<std::uint32_t>{7}})[1].find("a material that does not exist") != std::string::npos);
  CHECK(sentences({std::span(xyz).first(11), good, materials})[0].find("the last vertex lacks some of its three") != std::string::npos);
  const std::vector<radiosity::Material> impossible{{"mirror", glm::dvec3(1.5), glm::dvec3(0.0)}};
  CHECK(sentences({xyz, good, impossible}).size() == 1);
  for (const double weld : {-1.0, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    radiosity::BakeOptions options = quick();
    options.intake.weld = weld;
    CHECK(radiosity::bake({xyz, good, materials}, options).failure.kind == radiosity::Failure::Kind::invalid_options);
  }

  const radiosity::BakeOutcome outcome = radiosity::bake({xyz, with_line, materials}, quick());
  REQUIRE(outcome.baked);
  CHECK(outcome.baked->colors.without == 3);
  for (const radiosity::Color& b : outcome.baked->colors.corner) { CHECK(b.x == 1.0); }  // alone in the world
  CHECK(outcome.baked->colors.vertex[0].x == 1.0);
  CHECK(outcome.baked->colors.vertex[3].x == 0.0);  // without a triangle
}

TEST_CASE("bake: corners that are left out have the light of others at their place, whatever else is no place at all") {
  const std::vector<radiosity::Material> materials{{"dim", glm::dvec3(0.0), glm::dvec3(1.0)}, {"bright", glm::dvec3(0.0), glm::dvec3(2.0)}};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  // Two triangles, and of each a corner again in one without area; the corner between them is nowhere.
  const std::vector<float> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0, 10, 0, 0, 11, 0, 0, 10, 1, 0, nan, 0, 0};
  const std::vector<std::uint32_t> indices{0, 1, 2, 3, 4, 5, 0, 6, 3, 0, 0, 3, 0, 3, 99}, material{0, 1, 0, 0, 0};
  const radiosity::BakeOutcome outcome = radiosity::bake({xyz, indices, materials, material}, quick());
  REQUIRE(outcome.baked);
  const radiosity::Baked& baked = *outcome.baked;
  CHECK(baked.colors.without == 9);
  const std::vector<double> expected{1, 1, 1, 2, 2, 2, 1, 0, 2, 1, 1, 2, 1, 2, 0};
  for (std::size_t c = 0; c < expected.size(); ++c) {
    CAPTURE(c);
    CHECK(baked.colors.corner[c].x == expected[c]);
  }
  CHECK(baked.light.front(0));
  CHECK_FALSE(baked.light.front(2));
  CHECK_FALSE(baked.light.front(5));
  CHECK_FALSE(radiosity::BakedLight{}.front(0));
}

TEST_CASE("bake: a sun in the mesh, however far, leaves the rest as it is") {
  const std::vector<radiosity::Material> materials{{"grey", glm::dvec3(0.5), glm::dvec3(0.0)}, {"sun", glm::dvec3(0.0), glm::dvec3(1.0)}};
  for (const float away : {1e2f, 1e4f, 1e7f, 1e9f}) {
    // A block of 2 cm on a square of 1 m, under a sun that is as wide as it is far.
    std::vector<float> xyz{-0.5f, -0.5f, 0,    0.5f,  -0.5f, 0,    0.5f, 0.5f, 0,    -0.5f, 0.5f,  0,
                           -away, -away, away, -away, away,  away, away, away, away, away,  -away, away};
    std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}, material{0, 0, 1, 1};
    for (int i = 0; i < 8; ++i) {
      for (int axis = 0; axis < 3; ++axis) { xyz.push_back(0.02f * static_cast<float>(i >> axis & 1) + (axis == 2 ? 0.01f : 0.0f)); }
    }
    for (const std::uint32_t i : {0u, 2u, 3u, 0u, 3u, 1u, 4u, 5u, 7u, 4u, 7u, 6u, 0u, 1u, 5u, 0u, 5u, 4u,
                                  2u, 6u, 7u, 2u, 7u, 3u, 0u, 4u, 6u, 0u, 6u, 2u, 1u, 3u, 7u, 1u, 7u, 5u}) {
      indices.push_back(8 + i);
      if (indices.size() % 3 == 0) { material.push_back(0); }
    }
    const radiosity::BakeOutcome outcome = radiosity::bake({xyz, indices, materials, material}, quick());
    CAPTURE(away);
    for (const std::string& sentence : outcome.failure.sentences) { UNSCOPED_INFO(sentence); }
    REQUIRE(outcome.baked);
    CHECK(outcome.baked->faces == 8);
    CHECK(outcome.baked->changes.size() == 1);  // coplanar triangles
    // F of a square of sides 2 a at a distance of a, over its middle: 4 / pi * atan(1 / sqrt 2) / sqrt 2.
    const auto light = outcome.baked->light.radiosity(0, {0.3, -0.3, 0.0});
    REQUIRE(light);
    CHECK(light->x == Approx(0.5 * 4.0 / 3.14159265358979 * std::atan(1.0 / std::sqrt(2.0)) / std::sqrt(2.0)).epsilon(0.01));
  }
}

namespace {

glm::dvec3 sample(const radiosity::Lightmap& map, const glm::dvec2& at) { return texture::sample(map.texels, map.width, map.height, at); }

}  // namespace

// Where the light is the same everywhere on a polygon and differs from polygon to polygon, any texel of a neighbour in the atlas would
// show.
TEST_CASE("lightmap: no polygon reaches into another one, wherever it is sampled, its texels fit") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
    Soup soup;
    soup.materials.clear();
    for (std::uint32_t i = 0; i < 40; ++i) {  // black lamps far from each other: B = E
      soup.materials.push_back({"lamp", glm::dvec3(0.0), glm::dvec3(1.0 + i)});
      const glm::dvec3 a(number(-1, 1), number(-1, 1), number(-1, 1)), u(number(-1, 1), number(-1, 1), number(-1, 1));
      const glm::dvec3 v = number(0.05, 1.0) * glm::normalize(glm::cross(u, glm::dvec3(number(-1, 1), 1.0, number(-1, 1)))),
                       far(10.0 * i, 0.0, 0.0);
      if (i % 2 == 0) {
        soup.polygon({far + a, far + a + u, far + a + u + v, far + a + v}, i);
      } else {
        soup.polygon({far + a, far + a + u, far + a + 0.3 * u + v}, i);
      }
    }
    soup.polygon({{0, 0, 0}, {0, 0, 0}, {1, 1, 1}}, 0);
    const radiosity::BakeOutcome outcome = radiosity::bake(soup.view(), soup.materials, quick());
    REQUIRE(outcome.baked);
    for (const std::uint32_t most : {8192U, 128U}) {
      const radiosity::Lightmap map = radiosity::make_lightmap(outcome.baked->light, soup.view(), 0.02, most);
      CHECK((map.width <= most && map.height <= most));
      CHECK(map.texels.size() == std::size_t{map.width} * map.height);
      CHECK((most == 128) == (map.texel > 0.02));
      CHECK(map.has_texels.back() == 0);
      for (std::size_t p = 0; p + 1 < soup.count(); ++p) {
        REQUIRE(map.has_texels[p] == 1);
        for (int k = 0; k < 20; ++k) {  // anywhere on the polygon, its corners among others
          glm::dvec2 at(0.0);
          double weights = 0.0;
          for (std::uint32_t c = soup.first[p]; c < soup.first[p + 1]; ++c) {
            const double weight =
                k < 4 ? (c - soup.first[p] == static_cast<std::uint32_t>(k) % (soup.first[p + 1] - soup.first[p]) ? 1.0 : 0.0)
                      : number(0.0, 1.0);
            at += weight * glm::dvec2(map.coordinates[c]);
            weights += weight;
          }
          // Coordinates are floats: 2^-24 of the atlas, at most 8192 texels, is less than a thousandth of a texel, and the ring is one
          // wide.
          CHECK(sample(map, at / weights).x == Approx(1.0 + static_cast<double>(p)).epsilon(1e-6));
        }
      }
    }
  }
}

TEST_CASE("lightmap: with fine texels it is the light itself") {
  const Soup soup = room();
  const radiosity::BakeOutcome outcome = radiosity::bake(soup.view(), soup.materials, quick());
  REQUIRE(outcome.baked);
  const radiosity::Lightmap map = radiosity::make_lightmap(outcome.baked->light, soup.view(), 0.02);
  double square = 0.0, reference = 0.0;
  for (std::size_t p = 0; p < soup.count(); ++p) {
    if (map.has_texels[p] == 0) { continue; }
    const std::uint32_t c = soup.first[p];
    for (const auto& weights : {std::pair(0.2, 0.3), {0.5, 0.25}, {0.1, 0.1}, {0.7, 0.2}}) {
      const double a = weights.first, b = weights.second;
      const auto mix = [&](const auto& x, const auto& y, const auto& z) { return (1.0 - a - b) * x + a * y + b * z; };
      const std::vector<glm::dvec3> points = soup.outline(p);
      const auto light = outcome.baked->light.radiosity(p, mix(points[0], points[1], points[2]));
      const glm::dvec2 at = mix(glm::dvec2(map.coordinates[c]), glm::dvec2(map.coordinates[c + 1]), glm::dvec2(map.coordinates[c + 2]));
      REQUIRE(light);
      const double difference = sample(map, at).x - light->x;
      square += difference * difference;
      reference += light->x * light->x;
    }
  }
  // The light is linear on each triangle of the solution, some 0.2 wide; only at its kinks, in a tenth of the texels, the two differ.
  CHECK(std::sqrt(square / reference) < 0.005);
}
