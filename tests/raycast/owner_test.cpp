// SPDX-License-Identifier: MIT
// The owner rule and covered(): what the ends of a visibility segment may touch, and what lies flush on what.

#include "support.hpp"

#include <brep/builder_input.hpp>

using namespace raycast;
using namespace test;

TEST_CASE("a ray that leaves a convex solid never meets it again") {
  SEEDED(random);
  for (int i = 0; i < 20000; ++i) {
    const double scale = random.magnitude(8);
    const Placement placement{random.rotation() * scale, scale * std::pow(10.0, random.uniform(-2, 3)) * random.in_cube(), false};
    const Made<Object> shapes[] = {Sphere::make({0, 0, 0}, 1.0), BoxObject::make({-1, -1, -1}, {1, 2, 1}),
                                   Cylinder::make({0, 0, 0}, {0, 0, 1}, 0.7), mesh_of(*BoxObject::make({-1, -1, -1}, {1, 1, 1}), 0.0)};
    const auto& shape = shapes[i % 4];
    const PlacedObject object = placed(shape, placement);
    const Scene alone({object});
    // A point of the surface, as rounding leaves it.
    const dvec3 outside = 3.0 * random.direction();
    const Segment through = between(outside, 0.3 * random.in_cube());
    Spans found;
    shape->spans(through, found);
    if (found.empty()) { continue; }
    const dvec3 p = placement.linear * through.at(found[0].in.t) + placement.translation;
    const SurfacePoint at = object.project(found[0].in.sheet, p);
    if (shape->flat() && !object.bounds().contains(at.position)) { continue; }
    for (int k = 0; k < 10; ++k) {
      dvec3 d = scale * std::pow(10.0, random.uniform(-3, 3)) * random.direction();
      if (glm::dot(d, at.normal) < 0.0) { d = -d; }
      // Directions nearer to the tangent plane than the rounding of the position are not leaving.
      if (glm::dot(d, at.normal) < 1e-9 * glm::length(d)) { continue; }
      CHECK_FALSE(alone.occluded(Segment{at.position, d}, 0));
      CHECK_FALSE(alone.occluded(Segment{at.position + d, -d}, no_object, 0));
      const auto hit = alone.closest(Segment{at.position, d}, 0);
      CHECK_FALSE(hit);
    }
  }
}

TEST_CASE("a concave owner drops the span at the end and keeps the later ones") {
  for (const bool mirrored : {false, true}) {
    Placement placement;
    if (mirrored) { placement.linear = glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, 1); }
    const double y = mirrored ? -0.5 : 0.5;
    const Scene scene({placed(l_block(), placement)});
    const dvec3 step{0.5, y, 1}, riser{1, y, 1.5}, top{1.5, y, 2};
    CHECK_FALSE(scene.occluded(between(step, riser), 0, 0));
    CHECK_FALSE(scene.occluded(between(riser, step), 0, 0));
    CHECK(scene.occluded(between(step, {2, y, 1.9}), 0, no_object));
    CHECK(scene.occluded(between(step, {3, y, 1.5}), 0));  // leaves the step, is stopped by the riser
    CHECK(scene.occluded(between({3, y, 1.5}, step), no_object, 0));
    CHECK_FALSE(scene.occluded(between(step, {-3, y, 1.5}), 0));
    CHECK_FALSE(scene.occluded(between(top, {-3, y, 2.5}), 0));
    CHECK(scene.occluded(between({-1, y, 0.2}, riser), no_object, 0));  // through the step block first
    CHECK(scene.occluded(between(riser, {-1, y, 0.2}), 0));
    const auto hit = scene.closest(between(step, riser), 0);
    REQUIRE(hit);
    CHECK(hit->t == test::Approx(1.0));
    CHECK(hit->front);
  }
}

TEST_CASE("a concave room hides what lies around its corner") {
  const Scene scene({placed(l_block(), room())});  // the air is the L: z in [0,1], and up to 2 where x > 1
  const dvec3 high{0, 0.5, 0.9}, low{0, 0.5, 0.1}, ceiling{1.2, 0.5, 2}, wall{2, 0.5, 1.5};
  CHECK(scene.occluded(between(high, ceiling), 0, 0));
  CHECK(scene.occluded(between(ceiling, high), 0, 0));
  CHECK_FALSE(scene.occluded(between(low, wall), 0, 0));
  CHECK_FALSE(scene.occluded(between(wall, low), 0, 0));
  const auto hit = scene.closest(between(low, wall), 0);
  REQUIRE(hit);
  CHECK(hit->t == test::Approx(1.0));
  CHECK(scene.closest(between(high, ceiling), 0)->t < 0.5);
}

TEST_CASE("chord points inside a convex solid see what their surface sees") {
  SEEDED(random);
  const auto cylinder = Cylinder::make({0, 0, 0}, {0, 0, 2}, 0.5);
  const auto sphere = Sphere::make({3, 0, 1}, 0.5);
  const Scene scene({placed(cylinder), placed(sphere), placed(BoxObject::make({-5, -5, 0}, {8, 5, 4}), room())});
  brep::Builder chords;
  cylinder->approximate(0.05, chords);
  const std::uint32_t cylinder_faces = chords.face_count();
  sphere->approximate(0.05, chords);
  int free = 0, blocked = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t f = random.below(cylinder_faces), g = cylinder_faces + random.below(chords.face_count() - cylinder_faces);
    if (chords.sheet(f) == 1) continue;  // it stands on the floor
    const auto middle = [&](std::uint32_t face, dvec3& p, dvec3& n) {
      Corners corners;
      for (const std::uint32_t v : chords.corners(face)) { corners.push_back(chords.position(v)); }
      p = brep::centroid(corners);
      n = brep::normal(corners);
    };
    dvec3 p{0}, np{0}, q{0}, nq{0};
    middle(f, p, np);
    middle(g, q, nq);
    const bool faces = glm::dot(np, q - p) > 0.0 && glm::dot(nq, p - q) > 0.0;
    if (faces) {
      CHECK_FALSE(scene.occluded(between(p, q), 0, 1));
      ++free;
    }
    // Through the cylinder from behind: the far side's chord patch must not see the sphere.
    if (glm::dot(np, q - p) < -0.8 * glm::length(q - p) && chords.sheet(f) == 0) {
      const dvec3 behind = p + 0.2 * np;
      CHECK(scene.occluded(between(behind, q), no_object, 1));
      ++blocked;
    }
    CHECK_FALSE(scene.occluded(between(p, {p.x + 2 * np.x, p.y + 2 * np.y, 4}), 0, 2));  // to the ceiling
  }
  CHECK(free > 500);
  CHECK(blocked > 500);
}

TEST_CASE("a convex room never hides its walls from each other, nor a lamp that lies on them") {
  SEEDED(random);
  const Corners lamp_corners = rectangle({-0.2, -0.2, 1}, {0, 0.4, 0}, {0.4, 0, 0});  // faces down, coplanar with the ceiling
  for (int turn = 0; turn < 20; ++turn) {
    const double scale = random.magnitude(8);
    const Placement at{turn ? random.rotation() * scale : glm::dmat3(scale), turn % 2 ? scale * 1e5 * random.in_cube() : dvec3(0), false};
    Placement inside = at;
    inside.inside = true;
    const Scene scene({placed(BoxObject::make({-1, -1, -1}, {1, 1, 1}), inside), placed(Polygon::make(lamp_corners), at)});
    const auto world = [&](const dvec3& p) { return at.linear * p + at.translation; };
    const auto on_wall = [&] {
      dvec3 p = random.in_cube();
      p[static_cast<int>(random.below(3))] = random.below(2) ? 1.0 : -1.0;
      return p;
    };
    for (int i = 0; i < 3000; ++i) {
      const dvec3 a = on_wall(), b = on_wall();
      CHECK_FALSE(scene.occluded(between(world(a), world(b)), 0, 0));
      const dvec3 lamp{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 1};
      if (a.z == 1.0) { continue; }
      CHECK_FALSE(scene.occluded(between(world(lamp), world(a)), 1, 0));
      CHECK_FALSE(scene.occluded(between(world(a), world(lamp)), 0, 1));
      CHECK_FALSE(scene.occluded(between(world(lamp), world(0.5 * (a + lamp))), 1));
      // A path from the floor that ends on the lamp meets the lamp, not the ceiling behind it.
      const auto hit = scene.closest(between(world(0.3 * a), world({0.5 * lamp.x, 0.5 * lamp.y, 1})));
      REQUIRE(hit);
      CHECK(hit->object == 1);
      CHECK(hit->front);
      CHECK(scene.closest(between(world(lamp), world(a)), 1)->object == 0);
    }
  }
}

TEST_CASE("polygon owners are left out, and their backs stop light") {
  const auto square = Polygon::make(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));  // faces +z
  const Scene scene({placed(square), placed(Polygon::make(rectangle({0, 0, 1}, {0, 1, 0}, {1, 0, 0})))});
  const dvec3 low{0.5, 0.5, 0}, high{0.5, 0.4, 1};
  CHECK_FALSE(scene.occluded(between(low, high), 0, 1));
  CHECK(scene.occluded(between({0.5, 0.5, -1}, {0.5, 0.5, 0.5})));
  CHECK(scene.occluded(between({0.5, 0.5, 0.5}, {0.5, 0.5, -1})));
  const auto back = scene.closest(between({0.5, 0.5, -1}, {0.5, 0.5, 0.5}));
  REQUIRE(back);
  CHECK(back->object == 0);
  CHECK_FALSE(back->front);
  CHECK(scene.closest(between({0.5, 0.5, 0.5}, {0.5, 0.5, -1}))->front);
  CHECK(scene.closest(Segment{low, {0, 0, 1e-3}}, 0)->t == test::Approx(1000.0));
  CHECK_FALSE(scene.closest(Segment{low, {0, 0, -1}}, 0));
}

TEST_CASE("an open mesh is a surface: its own face is left out at the ends, its other faces shade") {
  // A gutter: floor z = 0 and wall x = 1, both seen from the corner x < 1, z > 0.
  const auto gutter = Mesh::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {1, 4, 5, 2}});
  const auto opaque = placed(gutter);
  REQUIRE_FALSE(opaque.solid());
  const Scene scene({opaque});
  CHECK_FALSE(scene.occluded(between({0.5, 0.5, 0}, {1, 0.5, 0.5}), 0, 0));
  CHECK_FALSE(scene.occluded(between({0.5, 0.5, 0}, {-1, 0.5, 1}), 0));
  CHECK(scene.occluded(between({0.5, 0.5, 0}, {2, 0.5, 0.5}), 0));
  CHECK(scene.occluded(between({0.5, 0.5, 1}, {0.5, 0.5, -1})));
  CHECK(scene.closest(between({0.5, 0.5, 1}, {0.5, 0.5, -1}))->front);
  CHECK_FALSE(scene.closest(between({0.5, 0.5, -1}, {0.5, 0.5, 1}))->front);
  CHECK(scene.closest(between({0.5, 0.5, 0}, {1, 0.5, 0.5}), 0)->sheet == 1);
}

TEST_CASE("covered: what lies flush on, in or behind other surfaces") {
  SEEDED(random);
  for (int turn = 0; turn < 12; ++turn) {
    const double scale = turn ? random.magnitude(6) : 1.0;
    const Placement at{turn ? random.rotation() * scale : glm::dmat3(1.0), turn % 2 ? 1e4 * scale * random.in_cube() : dvec3(0), false};
    Placement inside = at;
    inside.inside = true;
    const auto down = [](double x0, double y0, double z, double size) { return rectangle({x0, y0, z}, {0, size, 0}, {size, 0, 0}); };
    const auto up = [](double x0, double y0, double z, double size) { return rectangle({x0, y0, z}, {size, 0, 0}, {0, size, 0}); };
    enum : std::uint32_t { hall, block, lamp, post, floor_tile, low_lamp, wedge, panel, other_panel };
    std::vector<PlacedObject> objects{placed(BoxObject::make({0, 0, 0}, {10, 10, 3}), inside),
                                      placed(BoxObject::make({1, 1, 0}, {2, 2, 1}), at),
                                      placed(Polygon::make(down(4, 4, 3, 1)), at),
                                      placed(Cylinder::make({7, 7, -1}, {0, 0, 2}, 0.5), at),
                                      placed(Polygon::make(up(1.2, 1.2, 1, 0.5)), at),
                                      placed(Polygon::make(down(6, 2, 2.999, 1)), at),
                                      placed(l_block(), Placement{at.linear, at.linear * dvec3(3, 7, 0) + at.translation, false}),
                                      placed(Polygon::make(up(8, 1, 1, 1)), at),
                                      placed(Polygon::make(down(8, 1, 1, 1)), at)};
    for (int extra = 0; extra < (turn % 3 ? 0 : 30); ++extra) {
      objects.push_back(placed(Sphere::make({20.0 + extra, 0, 0}, 0.3), at));  // makes the tree
    }
    const Scene scene(objects);
    const auto covered = [&](const dvec3& p, const dvec3& n, std::uint32_t owner) {
      return scene.covered(at.linear * p + at.translation, glm::normalize(at.linear * n), owner);
    };
    const dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    CHECK(covered({1.5, 1.6, 0}, z, hall));            // floor under the block
    CHECK_FALSE(covered({2.5, 1.6, 0}, z, hall));      // floor beside it
    CHECK(covered({1.5, 1.6, 0}, -z, block));          // bottom of the block
    CHECK_FALSE(covered({1.5, 1.0, 0.5}, -y, block));  // side of the block
    CHECK(covered({4.5, 4.4, 3}, -z, hall));           // ceiling behind the lamp
    CHECK_FALSE(covered({5.5, 4.4, 3}, -z, hall));     // ceiling beside it
    CHECK_FALSE(covered({4.5, 4.4, 3}, -z, lamp));     // the lamp itself
    CHECK(covered({7.5, 7, -0.5}, x, post));           // the post below the floor: outside the room
    CHECK_FALSE(covered({7.5, 7, 0.5}, x, post));
    CHECK(covered({7, 7, -1}, -z, post));
    CHECK(covered({7.1, 7.2, 0}, z, hall));   // floor inside the post
    CHECK(covered({1.5, 1.5, 1}, z, block));  // top of the block under the tile, declared later
    CHECK_FALSE(covered({1.5, 1.5, 1}, z, floor_tile));
    CHECK_FALSE(covered({1.9, 1.9, 1}, z, block));
    CHECK_FALSE(covered({6.5, 2.5, 3}, -z, hall));  // 1 mm above a lamp that hangs free
    CHECK_FALSE(covered({6.5, 2.5, 2.999}, -z, low_lamp));
    CHECK_FALSE(covered({4.5, 4.5, 2.999}, -z, block));  // 1 mm under the lamp
    CHECK(covered({3.5, 7.5, 0}, z, hall));              // floor under the concave block
    CHECK_FALSE(covered({3.5, 7.5, 1}, z, wedge));       // its step
    CHECK_FALSE(covered({8.5, 1.5, 1}, z, panel));       // two panels back to back: a sheet with two sides
    CHECK_FALSE(covered({8.5, 1.5, 1}, -z, other_panel));
  }
}
