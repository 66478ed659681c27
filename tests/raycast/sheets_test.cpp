// SPDX-License-Identifier: MIT
// Open meshes as sheets with two sides.

#include "support.hpp"

#include <algorithm>
#include <array>
#include <cmath>

using namespace raycast;
using namespace test;

// An open mesh may be a sheet with two sides, each cut in its own way: m x m tiles that look along its normal, n x n that look against it.
TEST_CASE("of faces of one open mesh that lie back to back a ray meets the one that shows its front") {
  SEEDED(random);
  for (int turn = 0; turn < 60; ++turn) {
    const double scale = random.magnitude(4);
    const glm::dmat3 axes = random.rotation() * scale;
    const dvec3 origin = 10.0 * scale * random.in_cube();
    const std::uint32_t m = 1 + random.below(4), n = 1 + random.below(4);
    Corners positions;
    std::vector<std::vector<std::uint32_t>> faces;
    const auto tiles = [&](std::uint32_t count, bool back) {
      const auto first = static_cast<std::uint32_t>(positions.size()), row = count + 1;
      for (std::uint32_t k = 0; k < row * row; ++k) {
        positions.push_back(origin + axes * dvec3(k % row / double(count), k / row / double(count), 0.0));
      }
      for (std::uint32_t k = 0; k < count * count; ++k) {
        const std::uint32_t a = first + k / count * row + k % count;
        faces.push_back({a, a + 1, a + row + 1, a + row});
        if (back) { std::reverse(faces.back().begin(), faces.back().end()); }
      }
    };
    tiles(m, false);
    tiles(n, true);
    std::vector<PlacedObject> objects{placed(Mesh::make(positions, faces, 1e-14))};
    for (int extra = 0; extra < (turn % 2 ? 0 : 80); ++extra) {  // makes the tree
      objects.push_back(placed(Sphere::make(origin + axes * dvec3(3.0 + extra, 0, 0), 0.2 * scale)));
    }
    const Scene scene(objects);
    Segments16 rays;
    for (unsigned i = 0; i < 16; ++i) {
      const dvec3 target = origin + axes * dvec3(random.uniform(0.001, 0.999), random.uniform(0.001, 0.999), 0.0);
      const double height = (i % 2 ? 1 : -1) * random.uniform(0.05, 1.0);
      const Segment ray{target + axes * dvec3(random.uniform(-1, 1), random.uniform(-1, 1), height), dvec3(0.0)};
      rays.set(i, {ray.origin, target - ray.origin}, no_object, no_object);
    }
    const Hits16 hits = scene.closest16(rays);
    CHECK(hits.met == 0xffff);
    for (unsigned i = 0; i < 16; ++i) {
      const auto one = scene.closest(rays.at(i));
      REQUIRE(one);
      CHECK(one->front);
      CHECK((one->sheet < m * m) == (i % 2 == 1));
      CHECK(hits.hit[i].front);
      CHECK(hits.hit[i].sheet == one->sheet);
    }
  }
}

// The two sides of a sheet may be two meshes. The fast search is less accurate the smaller the sheet is in the scene, and asks for the
// exact hits of a mesh again and again; these took the place of those of the other mesh.
TEST_CASE("of two sheets that lie back to back a ray meets the one that shows its front, however small they are in the scene") {
  SEEDED(random);
  for (int turn = 0; turn < 40; ++turn) {
    const double far = random.magnitude(6);  // where the rest of the scene stands, in sizes of the sheet
    const glm::dmat3 axes = random.rotation();
    constexpr std::uint32_t count = 24, row = count + 1;
    Corners positions;
    std::vector<std::vector<std::uint32_t>> faces[2];
    for (std::uint32_t k = 0; k < row * row; ++k) {
      const double u = k % row / double(count), v = k / row / double(count);
      positions.push_back(axes * dvec3(u, v, 0.02 * std::sin(9.0 * u) * std::cos(7.0 * v) + random.uniform(0.0, 0.004)));
    }
    for (std::uint32_t k = 0; k < count * count; ++k) {
      const std::uint32_t a = k / count * row + k % count;
      for (const std::array<std::uint32_t, 3>& t : {std::array{a, a + 1, a + row + 1}, std::array{a, a + row + 1, a + row}}) {
        faces[0].push_back({t[0], t[1], t[2]});
        faces[1].push_back({t[2], t[1], t[0]});
      }
    }
    std::vector<PlacedObject> objects;
    for (const std::uint32_t side : {turn % 2, 1 - turn % 2}) { objects.push_back(placed(Mesh::make(positions, faces[side], 1e-14))); }
    objects.push_back(placed(Sphere::make(axes * dvec3(0.5, 0.5, 2.0 + far), 0.1 * (1.0 + far))));
    const Scene scene(objects);
    Segments16 rays;
    for (unsigned i = 0; i < 16; ++i) {
      const dvec3 target = axes * dvec3(random.uniform(0.05, 0.95), random.uniform(0.05, 0.95), 0.0);
      const dvec3 origin = target + axes * dvec3(random.uniform(-1, 1), random.uniform(-1, 1), (i % 2 ? 1 : -1) * random.uniform(0.2, 1.0));
      rays.set(i, {origin, (target - origin) * (1.0 + far)}, no_object, no_object);
    }
    const Hits16 hits = scene.closest16(rays);
    for (unsigned i = 0; i < 16; ++i) {
      if ((hits.met >> i & 1u) == 0) { continue; }  // at a slant, past the border
      const auto one = scene.closest(rays.at(i));
      REQUIRE(one);
      CAPTURE(far, i);
      CHECK(one->front);
      CHECK(hits.hit[i].front);
      CHECK(hits.hit[i].object == one->object);
    }
  }
}
