// SPDX-License-Identifier: MIT
// Rooms with lamps and boxes flush with their walls: written meshes have no two faces at one depth, and no holes around lamps.

#include "catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/support/random.hpp>

#include "apps/export/export_mesh.hpp"
#include "apps/models.hpp"
#include "apps/scene_file.hpp"
#include "seed.hpp"

namespace {

using Flat = std::vector<glm::dvec2>;  // a convex polygon, counter-clockwise

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double flat_area(const Flat& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) { sum += 0.5 * cross(p[i], p[(i + 1) % p.size()]); }
  return sum;
}

// What of a convex polygon lies in another (Sutherland and Hodgman 1974).
Flat common(Flat p, const Flat& within) {
  for (std::size_t i = 0; i < within.size() && !p.empty(); ++i) {
    const glm::dvec2 &a = within[i], &b = within[(i + 1) % within.size()];
    const auto side = [&](const glm::dvec2& q) { return cross(b - a, q - a); };
    Flat kept;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const glm::dvec2 &q = p[k], &r = p[(k + 1) % p.size()];
      const double s = side(q), t = side(r);
      if (s >= 0.0) { kept.push_back(q); }
      if ((s >= 0.0) != (t >= 0.0)) { kept.push_back(q + s / (s - t) * (r - q)); }
    }
    p = std::move(kept);
  }
  return p;
}

Flat turned_ccw(Flat p) {
  if (flat_area(p) < 0.0) { std::reverse(p.begin(), p.end()); }
  return p;
}

struct FlushRoom {
  std::string text;
  std::vector<std::vector<Flat>> lamps;  // in the ceiling, as convex parts
};

// A room of 4 x 5 x 3 with two lamps in its ceiling, one in each half: round, square at any angle, a triangle, or an L, whose box is not
// full. `boxes`: one stands in a corner, one hangs from a wall, one stands on the floor and carries a smaller one.
FlushRoom flush_room(std::mt19937& random, bool boxes) {
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  FlushRoom room;
  std::ostringstream text;
  text.precision(17);
  text << "material wall reflectance 0.6\nmaterial lamp reflectance 0 emission 10\nbox room from 0 0 0 to 4 5 3 inside material wall\n";
  for (int half = 0; half < 2; ++half) {
    const double r = number(0.15, 0.8), x = number(1.0, 3.0), y = 2.5 * half + number(0.9, 1.6), turn = number(0.0, 6.0);
    const int kind = std::uniform_int_distribution<int>(0, 3)(random);
    const auto at = [&](double u, double v) {
      return glm::dvec2{x + r * (u * std::cos(turn) - v * std::sin(turn)), y + r * (u * std::sin(turn) + v * std::cos(turn))};
    };
    Flat outline;
    if (kind == 0) {
      for (int k = 0; k < 720; ++k) {
        outline.push_back(at(std::cos(k * std::numbers::pi / 360.0), std::sin(k * std::numbers::pi / 360.0)));
      }
      text << "disk lamp" << half << " center " << x << ' ' << y << " 3 normal 0 0 -1 radius " << r << " material lamp\n";
      room.lamps.push_back({outline});
      continue;
    }
    if (kind == 1) { outline = {at(-0.7, -0.7), at(0.7, -0.7), at(0.7, 0.7), at(-0.7, 0.7)}; }
    if (kind == 2) { outline = {at(1, 0), at(-0.5, 0.8), at(-0.6, -0.7)}; }
    room.lamps.push_back({outline});
    if (kind == 3) {
      outline = {at(-0.7, -0.7), at(0.7, -0.7), at(0.7, -0.2), at(-0.2, -0.2), at(-0.2, 0.7), at(-0.7, 0.7)};
      room.lamps.back() = {{outline[0], outline[1], outline[2], at(-0.7, -0.2)}, {at(-0.7, -0.2), outline[3], outline[4], outline[5]}};
    }
    text << "polygon lamp" << half << " material lamp";
    for (auto p = outline.rbegin(); p != outline.rend(); ++p) { text << " vertex " << p->x << ' ' << p->y << " 3"; }
    text << '\n';
  }
  if (boxes) {
    const auto box = [&](const char* name, double x0, double y0, double z0, double x1, double y1, double z1) {
      text << "box " << name << " from " << x0 << ' ' << y0 << ' ' << z0 << " to " << x1 << ' ' << y1 << ' ' << z1 << " material wall\n";
    };
    const double top = number(0.4, 1.5);
    box("corner", 0, 0, 0, number(0.3, 1.2), number(0.3, 1.2), number(0.3, 2.0));
    box("shelf", 3.4, number(1.0, 2.0), number(0.8, 1.2), 4, number(2.5, 4.0), number(1.4, 1.8));
    box("block", 1.3, 2.6, 0, 2.6, 3.9, top);
    box("small", number(1.0, 1.6), number(2.4, 3.0), top, number(1.7, 2.8), number(3.1, 4.1), top + 0.4);
  }
  room.text = text.str();
  return room;
}

apps::SceneFile scene_of(const FlushRoom& room) {
  const apps::SceneResult result = apps::parse_scene(room.text);
  INFO(apps::to_text(result, "room"));
  REQUIRE(result.file);
  return *result.file;
}

radiosity::Solution light_of(const apps::SceneFile& file) {
  const radiosity::Options options{.epsilon = 0.05, .min_area = 5e-4, .audit_points = 0, .threads = 1};
  radiosity::Outcome outcome = radiosity::solve(file.scene, options);
  REQUIRE(outcome.solution);
  return std::move(*outcome.solution);
}

struct FlatFace {
  std::vector<glm::dvec3> corners;
  glm::dvec3 normal{0.0}, lo{0.0}, hi{0.0};
};

std::vector<FlatFace> faces_of(const apps::Model& model) {
  std::vector<FlatFace> faces;
  for (std::size_t f = 0; f < model.polygons(); ++f) {
    const std::size_t count = model.first_corner[f + 1] - model.first_corner[f];
    for (std::size_t k = 2; k < count; ++k) {
      FlatFace face;
      for (const std::size_t c : {std::size_t{0}, k - 1, k}) { face.corners.push_back(models::corner(model, f, c)); }
      const glm::dvec3 area = glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
      if (!(glm::length(area) > 1e-9)) { continue; }
      face.normal = glm::normalize(area);
      face.lo = glm::min(face.corners[0], glm::min(face.corners[1], face.corners[2]));
      face.hi = glm::max(face.corners[0], glm::max(face.corners[1], face.corners[2]));
      faces.push_back(std::move(face));
    }
  }
  return faces;
}

// The area on which two faces that show the same side overlap in one plane: floats of coordinates up to 5 are off by up to 3e-7, and faces
// in depth order lie 7e-4 apart. (Where faces of solids lie against each other, nobody sees either.)
double overlap(const FlatFace& a, const FlatFace& b) {
  constexpr double near = 5e-6;
  if (glm::dot(a.normal, b.normal) < 0.0) { return 0.0; }
  for (int k = 0; k < 3; ++k) {
    if (a.lo[k] > b.hi[k] + near || b.lo[k] > a.hi[k] + near) { return 0.0; }
  }
  for (const glm::dvec3& p : b.corners) {
    if (std::abs(glm::dot(p - a.corners[0], a.normal)) > near) { return 0.0; }
  }
  const auto [s, t] = radiosity::orthonormal(a.normal);
  const auto flat = [&, s = s, t = t](const FlatFace& face) {
    Flat outline;
    for (const glm::dvec3& p : face.corners) { outline.emplace_back(glm::dot(p - a.corners[0], s), glm::dot(p - a.corners[0], t)); }
    return turned_ccw(outline);
  };
  return flat_area(common(flat(a), flat(b)));
}

}  // namespace

// Two faces that touch along an edge overlap by rounding: 3e-7 times the length of the edge. A real overlap is a part of a leaf.
TEST_CASE("export: no two faces of a written mesh overlap in one plane, in any format") {
  const unsigned first = test::seed();
  for (unsigned seed = first; seed < first + 3; ++seed) {
    std::mt19937 random(seed);
    const FlushRoom room = flush_room(random, true);
    INFO("seed " << seed << "\n" << room.text);
    const apps::SceneFile file = scene_of(room);
    const radiosity::Solution solution = light_of(file);
    const apps::ExportMesh mesh = apps::solution_mesh(file, solution, solution.mesh);
    const std::string ply = apps::to_ply(apps::in_depth_order(file, solution, solution.mesh), radiosity::surfaces(file.scene), 1.0);
    for (const std::string name : {"a.ply", "a.obj", "a.glb"}) {
      INFO(name);
      const std::vector<FlatFace> faces = faces_of(models::read(name, name == "a.ply" ? ply : apps::export_format(name)->write(mesh, 1.0)));
      CHECK(faces.size() > 100);
      double most = 0.0;
      for (std::size_t i = 0; i < faces.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) { most = std::max(most, overlap(faces[i], faces[k])); }
      }
      CHECK(most < 1e-5);
    }
  }
}

// The circle is a polygon of 720 corners here, whose area is 1.3e-5 of the disk's less.
TEST_CASE("export: what lamps leave of a ceiling is in the mesh, all of it") {
  // First rooms where a leaf's corners and places between them lie on an L, but its inner corner within the leaf.
  std::vector<unsigned> seeds{1102, 2221, 3275, 4118621202};
  for (int i = 0; i < 6; ++i) { seeds.push_back(test::seed()); }
  for (const unsigned seed : seeds) {
    std::mt19937 random(seed);
    const FlushRoom room = flush_room(random, false);
    INFO("seed " << seed << "\n" << room.text);
    const apps::SceneFile file = scene_of(room);
    const radiosity::Solution solution = light_of(file);
    const radiosity::Mesh& mesh = solution.mesh;
    double left = 4.0 * 5.0, seen = 0.0;
    for (const std::vector<Flat>& lamp : room.lamps) {
      for (const Flat& part : lamp) { left -= flat_area(part); }
    }
    for (const radiosity::MeshFace& face : mesh.faces) {
      Flat outline;
      double lowest = 3.0;
      for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
        const glm::dvec3& p = mesh.positions[mesh.corners[c].vertex];
        outline.emplace_back(p);
        lowest = std::min(lowest, p.z);
      }
      if (lowest < 3.0 - 1e-9 || radiosity::surfaces(file.scene)[face.surface].object != 0) { continue; }
      outline = turned_ccw(outline);
      seen += flat_area(outline);
      for (const std::vector<Flat>& lamp : room.lamps) {
        for (const Flat& part : lamp) { seen -= flat_area(common(outline, part)); }
      }
    }
    CHECK(seen == Approx(left).margin(1e-4));
  }
}
