// SPDX-License-Identifier: MIT
// Scenes that are a few solids of many faces, as files bring them: what single precision decides about them is what the law says.

#include "world.hpp"

#include <raycast/air_cells.hpp>

using namespace raycast;
using namespace test;

namespace {

// A box with walls of the given thickness around a hollow, in [-1, 1]^3.
Made<Mesh> thick_box(double wall) {
  Corners positions;
  std::vector<std::vector<std::uint32_t>> faces;
  const double inner = 1.0 - wall;
  for (const auto& face : faces_of({-1, -1, -1}, {1, 1, 1})) {
    faces.push_back({});
    for (const dvec3& p : face) { faces.back().push_back(static_cast<std::uint32_t>(positions.size())), positions.push_back(p); }
  }
  for (auto face : faces_of({-inner, -inner, -inner}, {inner, inner, inner})) {
    std::reverse(face.begin(), face.end());
    faces.push_back({});
    for (const dvec3& p : face) { faces.back().push_back(static_cast<std::uint32_t>(positions.size())), positions.push_back(p); }
  }
  std::vector<std::vector<std::uint32_t>> shared = faces;  // equal positions are one vertex
  for (auto& face : shared) {
    for (std::uint32_t& v : face) {
      v = static_cast<std::uint32_t>(std::find(positions.begin(), positions.end(), positions[v]) - positions.begin());
    }
  }
  return Mesh::make(positions, shared);
}

// An L-shaped block whose corners are off the planes of its faces by up to `off`.
Made<Mesh> warped_block(Random& random, double off) {
  const double profile[6][2] = {{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};  // x, z
  Corners positions;
  for (int y = 0; y < 2; ++y) {
    for (const auto& p : profile) { positions.push_back(dvec3{p[0], y, p[1]} + off * random.in_cube()); }
  }
  std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2, 3, 4, 5}, {11, 10, 9, 8, 7, 6}};
  for (std::uint32_t i = 0; i < 6; ++i) { faces.push_back({(i + 1) % 6, i, i + 6, (i + 1) % 6 + 6}); }
  return Mesh::make(positions, faces);
}

// A wavy sheet over [-1, 1]^2 of triangles, open: a surface.
Made<Mesh> wavy_sheet(Random& random, std::uint32_t n, double height) {
  Corners positions;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) { positions.push_back({2.0 * i / n - 1.0, 2.0 * j / n - 1.0, random.uniform(-height, height)}); }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      faces.push_back({a, b, a + 1});
      faces.push_back({a + 1, b, b + 1});
    }
  }
  return Mesh::make(positions, faces);
}

// Adds an object, and its faces as places of ends, up to a deviation from the true surface.
void add_to(World& w, const PlacedObject& object, double deviation) {
  brep::Builder mesh;
  object.approximate(deviation, mesh);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.sheet(f) == brep::no_sheet) { continue; }
    Corners corners;
    for (const std::uint32_t v : mesh.corners(f)) { corners.push_back(mesh.position(v)); }
    w.faces.push_back({static_cast<std::uint32_t>(w.objects.size()), corners, mesh.sheet(f)});
  }
  w.objects.push_back(object);
}

// A few large solids and surfaces that stand in each other's bounds.
World few_large(Random& random, double scale, const dvec3& shift) {
  World w;
  const auto add = [&](const auto& made, double size) {
    add_to(w, placed(made, {random.rotation() * (size * scale), shift + 0.4 * scale * random.in_cube(), false}), 0.05 * scale);
  };
  add(thick_box(random.uniform(0.02, 0.3)), 1.0);
  for (int i = 0; i < 3; ++i) { add(warped_block(random, random.below(3) ? std::pow(10.0, random.uniform(-15, -7)) : 0.0), 0.3); }
  add(mesh_of(*Sphere::make({0, 0, 0}, 0.8), 0.02), 0.4);
  add(wavy_sheet(random, 1 + random.below(12), std::pow(10.0, random.uniform(-6, -0.5))), 0.5);
  const double off = 1e-7 * random.uniform();
  add(Polygon::make({{0, 0, off}, {1, 0, -off}, {1, 1, off}, {0, 1, -off}}), 0.5);
  return w;
}

// Curved solids, as bulbs are, in a hollow and before, on and in the walls of a niche and of a wavy shade.
World bulbs(Random& random, double scale, const dvec3& shift) {
  World w;
  const glm::dmat3 turned = random.rotation() * (0.5 * scale);
  const auto add = [&](const auto& made) { add_to(w, placed(made, {turned, shift, false}), 0.02 * scale); };
  add(thick_box(random.uniform(0.02, 0.3)));
  add(warped_block(random, 0.0));
  add(wavy_sheet(random, 1 + random.below(6), 0.5));
  for (int i = 0; i < 4; ++i) {
    const double size = std::pow(10.0, random.uniform(-4, -0.3));
    dvec3 at = dvec3{1.0} + 0.9 * random.in_cube();
    // On a wall of the niche, or sunk into it.
    if (random.below(2)) { at[static_cast<int>(random.below(3))] = 1.0 + (random.below(2) ? 1.0 : 0.99) * size; }
    if (random.below(2)) {
      add(Sphere::make(at, size));
    } else {
      add(Cylinder::make(at, size * random.direction(), 0.3 * size));
    }
  }
  return w;
}

// Is what single precision decides about bundles and single segments in random worlds of this kind what the law says?
template <class Make>
void check_against_law(Random& random, const Make& make) {
  std::size_t blocked = 0, all = 0;
  for (int turn = 0; turn < 40; ++turn) {
    const double scale = random.magnitude(8);
    const dvec3 shift = scale * random.magnitude(2) * random.in_cube();
    const World w = make(random, scale, shift);
    std::vector<Scene> scenes;
    for (const Isa isa : instruction_sets()) { scenes.emplace_back(w.objects, isa); }
    for (int i = 0; i < 100; ++i) {
      Segments16 segments;
      for (unsigned lane = 0; lane < 16; ++lane) {
        const auto end = [&] {  // on a surface, just before or behind one and owned by nothing, or anywhere
          Place p = place(random, w, scale, shift);
          for (const Facet& face : w.faces)  // before a sheet, on a reentrant edge, may be within the solid (bundle.hpp)
            if (std::find(face.corners.begin(), face.corners.end(), p.at) != face.corners.end()) { p.sheet = unknown_sheet; }
          if (random.below(2)) { return p; }
          return Place{p.at + scale * std::pow(10.0, random.uniform(-7, 0)) * random.in_cube()};
        };
        const Place p = end(), q = end();
        segments.set(lane, between(p.at, q.at), p.owner, q.owner, p.sheet, q.sheet);
      }
      const std::uint32_t expected = by_law(scenes[0], segments);
      for (const Scene& scene : scenes) {
        INFO("turn " << turn << " bundle " << i);
        require_blocked(scene, segments, expected);
      }
      blocked += static_cast<std::size_t>(std::popcount(expected));
      all += 16;
    }
  }
  CHECK(blocked > all / 10);
  CHECK(blocked < all - all / 10);
}

}  // namespace

TEST_CASE("few large solids and surfaces, with faces that are not quite planar: bundle = single = the law") {
  SEEDED(random);
  check_against_law(random, few_large);
}

TEST_CASE("bulbs in hollows, in niches and under shades: bundle = single = the law") {
  SEEDED(random);
  check_against_law(random, bulbs);
}

TEST_CASE("a cell of air holds no point of the solid, and a fourth of the air in the bounds is in such cells") {
  SEEDED(random);
  std::size_t found = 0, air = 0;
  for (int turn = 0; turn < 40; ++turn) {
    const auto made = turn % 3 == 0 ? thick_box(random.uniform(0.01, 0.5)) : turn % 3 == 1 ? l_block() : warped_block(random, 1e-7);
    const double scale = random.magnitude(8);
    const PlacedObject solid = placed(made, {random.rotation() * scale, scale * random.in_cube(), false});
    Compiled compiled;
    Compiler compiler(compiled, solid.bounds(), 1e-12 * scale);
    compiler.add(0, solid, {}, dvec3{0.0});
    compiler.finish(64);
    REQUIRE_FALSE(compiled.guards.empty());
    for (int i = 0; i < 2000; ++i) {
      const dvec3 size = solid.bounds().size();
      const dvec3 p = solid.bounds().lo + size * (0.5 + 0.5 * random.in_cube());
      const glm::vec3 local(compiled.local(p));
      bool within = false;
      for (const Span& span : spans(solid, {p, size})) { within = within || (span.in.t <= 0.0 && span.out.t >= 0.0); }
      const bool known = compiled.guards[0].air.contains(local.x, local.y, local.z);
      if (known) { CHECK_FALSE(within); }
      found += known;
      air += !within;
    }
  }
  CHECK(4 * found > air);
}

TEST_CASE("in the hollow of a thick wall a pair is clear, without a ray, within the wall it is not") {
  const std::vector<PlacedObject> objects{placed(thick_box(0.2))};
  const Scene scene(objects);
  const auto pair = [&](double low, double high) {
    const auto square = [](double z) { return rectangle({-0.2, -0.2, z}, {0.4, 0, 0}, {0, 0.4, 0}); };
    const Corners a = square(low), b = square(high);
    return scene.occluders({a}, {b});
  };
  CHECK(pair(-0.5, 0.5).clear());
  CHECK(pair(-0.7, 0.7).clear());
  CHECK_FALSE(pair(0.85, 0.95).clear());
  CHECK_FALSE(pair(0.0, 0.9).clear());
}

TEST_CASE("the first hit of an open surface is the first crossing of the whole line, bit for bit, at edges and corners, too") {
  SEEDED(random);
  std::size_t met = 0;
  for (int turn = 0; turn < 30; ++turn) {
    const auto n = 1 + random.below(30);
    const PlacedObject sheet = placed(wavy_sheet(random, n, std::pow(10.0, random.uniform(-4, -0.5))));
    std::vector<Scene> scenes;
    for (const Isa isa : instruction_sets()) { scenes.emplace_back(std::vector<PlacedObject>{sheet}, isa); }
    for (int i = 0; i < 300; ++i) {
      dvec3 at = random.in_cube();
      if (random.below(2)) at = glm::round(0.5 * n * (at + 1.0)) / (0.5 * n) - 1.0;  // over an edge
      const dvec3 eye{0.9 * random.in_cube().x, 0.9 * random.in_cube().y, random.below(2) ? 0.9 : -0.9};
      const Segment ray = between(eye, {at.x, at.y, 0.0});
      std::optional<Crossing> first;
      for (const Span& span : spans(sheet, ray)) {
        if (!first && span.in.t > 0.0) { first = span.in; }
      }
      for (const Scene& scene : scenes) {
        const std::optional<Hit> hit = scene.closest(ray);
        REQUIRE(hit.has_value() == first.has_value());
        if (hit) { REQUIRE((hit->t == first->t && hit->sheet == first->sheet)); }
      }
      met += first.has_value();
    }
  }
  CHECK(met > 1000);
}
