// SPDX-License-Identifier: MIT
// Meshes that list a sheet and its back: from either side a front is seen, and nothing is refused.

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <radiosity/visibility/prepare.hpp>

#include "models.hpp"

namespace {

using Faces = std::vector<std::vector<std::size_t>>;

// The polygon whole, or as triangles around one of its corners.
void add_polygon(Faces& faces, const std::vector<std::size_t>& corners, bool cut, std::size_t middle) {
  if (!cut) { return faces.push_back(corners); }
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const auto at = [&](std::size_t k) { return corners[(middle + k) % corners.size()]; };
    faces.push_back({at(0), at(i), at(i + 1)});
  }
}

}  // namespace

TEST_CASE("a mesh of a sheet and its back on the same vertices shows a front on either side") {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto chance = [&] { return random() % 2 == 0; };
    // A strip of rectangles, bent at the edges between them or flat, or one polygon with more corners.
    const bool strip = chance(), flat = chance();
    const std::size_t pieces = 1 + random() % 4, n = 3 + random() % 6;
    std::vector<glm::dvec3> positions;
    Faces polygons, faces;
    if (strip) {
      for (std::size_t i = 0; i <= pieces; ++i) {
        const double x = static_cast<double>(i), z = flat ? 0.0 : 0.3 * static_cast<double>(random() % 100) / 100.0;
        positions.insert(positions.end(), {{x, 0, z}, {x, 2, z}});
        if (i > 0) { polygons.push_back({2 * i - 2, 2 * i, 2 * i + 1, 2 * i - 1}); }
      }
    } else {
      polygons.emplace_back();
      for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
        positions.push_back({std::cos(angle), std::sin(angle), 0});
        polygons.back().push_back(i);
      }
    }
    for (const std::vector<std::size_t>& polygon : polygons) { add_polygon(faces, polygon, chance(), random() % polygon.size()); }
    for (const std::vector<std::size_t>& polygon : polygons) {
      add_polygon(faces, {polygon.rbegin(), polygon.rend()}, chance(), random() % polygon.size());
    }
    std::string text = "material m reflectance 0.5\nmesh s material m {\n";
    for (const glm::dvec3& p : positions) {
      char line[100];
      static_cast<void>(std::snprintf(line, sizeof line, "vertex %.17g %.17g %.17g\n", p.x, p.y, p.z));
      text += line;
    }
    for (const std::vector<std::size_t>& face : faces) {
      text += "face";
      for (const std::size_t v : face) { text += " " + std::to_string(v); }
      text += "\n";
    }
    CAPTURE(text);
    const auto parsed = apps::parse_scene(text + "}\n", {});
    REQUIRE(parsed.file);
    const radiosity::PrepareResult made = radiosity::prepare(parsed.file->scene);
    REQUIRE(made.prepared);
    const raycast::Scene& objects = made.prepared->objects;
    CHECK(made.prepared->surfaces.size() == 1);
    const glm::dvec3 middle = objects.object(0).bounds().centre();
    const double far = objects.diameter();
    for (const double side : {1.0, -1.0}) {
      const auto hit = objects.closest({middle + glm::dvec3{0.013, 0.017, side * far}, {0, 0, -2.0 * side * far}});
      REQUIRE(hit);
      CHECK(hit->front);
    }
  }
}

TEST_CASE("a closed mesh that is inside out is refused, and so is one that is no manifold by itself") {
  const std::string text = "material m reflectance 0.5\nmesh s material m {\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\n";
  const auto inside_out = apps::parse_scene(text + "face 0 1 2\nface 0 3 1\nface 0 2 3\nface 1 3 2\n}\n", {});
  CHECK(apps::to_text(inside_out, "").find("inside out") != std::string::npos);
  const auto fan = apps::parse_scene(text + "face 0 1 2\nface 1 0 3\nvertex 0 0 -1\nface 1 0 4\n}\n", {});
  CHECK(apps::to_text(fan, "").find("not a manifold") != std::string::npos);
}
