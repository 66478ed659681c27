// SPDX-License-Identifier: MIT
// Occluder lists: nothing that blocks a segment between the patches is ever missing, for their descendants either.

#include "world.hpp"

using namespace raycast;
using namespace test;

namespace {

struct TestPatch {
  Corners contour;
  std::uint32_t owner = no_object;
  double bulge = 0.0;
  std::uint32_t sheet = unknown_sheet;
  [[nodiscard]] PatchShape shape() const { return {contour, owner, bulge, sheet}; }
};

dvec3 inside(Random& random, const Corners& contour) {
  double sum = 0.0;
  dvec3 p{0.0};
  for (const dvec3& c : contour) {
    const double weight = random.uniform() * random.uniform();
    p += weight * c, sum += weight;
  }
  return p / sum;
}
// A smaller patch within the hull of this one.
TestPatch child(Random& random, const TestPatch& patch) {
  TestPatch result = patch;
  const dvec3 towards = inside(random, patch.contour);
  for (dvec3& p : result.contour) { p = 0.5 * (p + towards); }
  return result;
}

void check_pair(Random& random, const Scene& scene, const TestPatch& p, const TestPatch& q, const OccluderList& list,
                const std::function<dvec3(const TestPatch&, const dvec3&)>& lift) {
  Segments16 segments;
  for (unsigned lane = 0; lane < 16; ++lane) {
    segments.set(lane, between(lift(p, inside(random, p.contour)), lift(q, inside(random, q.contour))), p.owner, q.owner, p.sheet, q.sheet);
  }
  const std::uint32_t expected = by_law(scene, segments);
  std::uint32_t hint = no_shape;
  if (list.clear()) { REQUIRE(expected == 0); }
  if (list.blocked()) { REQUIRE(expected == 0xffff); }
  REQUIRE(scene.occluded16(segments, list, hint) == expected);
  REQUIRE(scene.occluded16(segments, list, hint) == expected);
}

}  // namespace

TEST_CASE("a list of occluders gives the answers of the law, at every level and every scale") {
  SEEDED(random);
  std::size_t clear = 0, blocked = 0, unknown = 0, all = 0;
  for (int turn = 0; turn < 40; ++turn) {
    const double scale = random.magnitude(8);
    const dvec3 shift = turn % 3 == 0 ? scale * random.magnitude(4) * random.in_cube() : scale * random.in_cube();
    const World w = world(random, turn % 4 == 0 ? 5 : turn % 4 == 1 ? 25 : 120, scale, shift, turn % 2);
    const auto sets = instruction_sets();
    const Scene scene(w.objects, sets[static_cast<std::size_t>(turn) % sets.size()]);
    const auto any = [&] {
      const auto& [owner, corners, sheet] = w.faces[random.below(static_cast<std::uint32_t>(w.faces.size()))];
      return TestPatch{corners, owner, 0.0, random.below(3) ? sheet : unknown_sheet};
    };
    const auto stay = [](const TestPatch&, const dvec3& x) { return x; };
    for (int i = 0; i < 60; ++i) {
      TestPatch p = any(), q = any();
      OccluderList list = scene.occluders(p.shape(), q.shape());
      for (int level = 0; level < 5; ++level) {
        INFO("turn " << turn << " pair " << i << " level " << level);
        check_pair(random, scene, p, q, list, stay);
        clear += list.clear();
        blocked += list.blocked();
        unknown += !list.known();
        ++all;
        if (level % 2 == 0) { p = child(random, p); }
        if (level != 1) { q = child(random, q); }
        const OccluderList narrowed = scene.filter(list, p.shape(), q.shape());
        if (list.known()) {
          for (const std::uint32_t shape : narrowed.shapes()) {
            REQUIRE(std::find(list.shapes().begin(), list.shapes().end(), shape) != list.shapes().end());
          }
        }
        list = narrowed;
      }
    }
  }
  CHECK(clear > all / 50);
  CHECK(blocked > all / 100);
  CHECK(unknown < all / 2);
}

TEST_CASE("lists of curved patches hold for points that move out to the true surface") {
  SEEDED(random);
  std::size_t clear = 0, blocked = 0;
  for (int turn = 0; turn < 30; ++turn) {
    const double scale = random.magnitude(6);
    std::vector<PlacedObject> objects;
    std::vector<std::pair<dvec3, double>> balls;
    for (int i = 0; i < 60; ++i) {
      balls.push_back({scale * random.in_cube(), scale * random.uniform(0.02, 0.25)});
      objects.push_back(placed(Sphere::make(balls.back().first, balls.back().second)));
    }
    const Scene scene(objects);
    const auto lift = [&](const TestPatch& p, const dvec3& x) {
      const auto& [centre, radius] = balls[p.owner];
      return random.below(2) ? x : centre + radius * glm::normalize(x - centre);
    };
    const auto cap = [&](std::uint32_t i, double width) {
      const auto& [centre, radius] = balls[i];
      const glm::dmat3 turned = random.rotation();
      TestPatch patch{{}, i, 0.0, unknown_sheet};
      for (int k = 0; k < 4; ++k) {
        patch.contour.push_back(centre +
                                radius * glm::normalize(turned * dvec3(k == 1 || k == 2 ? width : -width, k >= 2 ? width : -width, 1)));
      }
      // All points of the cap lie between the plane of the contour and the tangent plane, and as near to the hull at its rim.
      patch.bulge = radius - glm::length(0.5 * (patch.contour[0] + patch.contour[2]) - centre);
      return patch;
    };
    for (int i = 0; i < 300; ++i) {
      const TestPatch p = cap(random.below(60), random.uniform(0.05, 0.7)), q = cap(random.below(60), random.uniform(0.05, 0.7));
      const OccluderList list = scene.occluders(p.shape(), q.shape());
      check_pair(random, scene, p, q, list, lift);
      clear += list.clear();
      blocked += list.blocked();
    }
  }
  CHECK(clear > 100);
  CHECK(blocked > 100);
}

TEST_CASE("a pair that a wall separates is blocked, and one in an empty room is clear, without a ray") {
  const auto square = [](double z, bool up) {
    return up ? rectangle({-1, -1, z}, {2, 0, 0}, {0, 2, 0}) : rectangle({-1, -1, z}, {0, 2, 0}, {2, 0, 0});
  };
  const TestPatch low{square(0, true), 0, 0.0}, high{square(2, false), 1, 0.0};
  const std::vector<PlacedObject> ends{placed(Polygon::make(low.contour)), placed(Polygon::make(high.contour))};
  const auto with = [&](const PlacedObject& third) {
    std::vector<PlacedObject> objects = ends;
    objects.push_back(third);
    const Scene scene(objects);
    return scene.occluders(low.shape(), high.shape());
  };
  CHECK(with(placed(BoxObject::make({-1, -1, 0}, {1, 1, 2}), room())).clear());
  CHECK(with(placed(Polygon::make(rectangle({-2, -2, 1}, {4, 0, 0}, {0, 4, 0})))).blocked());
  CHECK(with(placed(BoxObject::make({-2, -2, 0.9}, {2, 2, 1.1}))).blocked());
  CHECK(with(placed(Sphere::make({0, 0, 1}, 1.7))).known());
  CHECK(with(placed(Sphere::make({0, 0, 1}, 0.9))).shapes().size() == 1);
  const OccluderList half = with(placed(Polygon::make(rectangle({0, -2, 1}, {4, 0, 0}, {0, 4, 0}))));
  CHECK(half.known());
  CHECK_FALSE(half.clear());
  CHECK_FALSE(half.blocked());
}

TEST_CASE("patches in the planes of open surfaces: lists give the answers of the law, and these planes block nothing") {
  SEEDED(random);
  std::size_t blocked = 0, open = 0;
  for (int turn = 0; turn < 40; ++turn) {
    const Placement at{random.magnitude(4) * random.rotation(), random.magnitude(2) * random.in_cube()};
    const auto moved = [&](const dvec3& x) { return at.linear * x + at.translation; };
    std::vector<PlacedObject> objects;
    std::vector<TestPatch> patches;
    // One open mesh of rectangles with corners of their own.
    const auto take = [&](const std::vector<Corners>& rectangles) {
      std::vector<dvec3> positions;
      std::vector<std::vector<std::uint32_t>> faces;
      for (const Corners& r : rectangles) {
        TestPatch patch{{}, static_cast<std::uint32_t>(objects.size()), 0.0, static_cast<std::uint32_t>(faces.size())};
        faces.emplace_back();
        for (const dvec3& x : r) {
          faces.back().push_back(static_cast<std::uint32_t>(positions.size()));
          positions.push_back(moved(x));
          patch.contour.push_back(positions.back());
        }
        patches.push_back(patch);
      }
      objects.push_back(placed(Mesh::make(positions, faces)));
    };
    const auto lying = [&](double z, bool up) {
      const dvec3 from{random.uniform(-1, 0.6), random.uniform(-1, 0.6), z}, x{random.uniform(0.1, 0.4), 0, 0},
          y{0, random.uniform(0.1, 0.4), 0};
      return up ? rectangle(from, x, y) : rectangle(from, y, x);
    };
    take({rectangle({-1, -1, 0}, {1, 0, 0}, {0, 2, 0}), rectangle({0, -1, 0}, {1, 0, 0}, {0, 2, 0})});  // a floor
    take({lying(0, true), lying(0, false), lying(0, true)});                                            // decals on it
    take({rectangle({-0.3, -0.3, 2}, {0, 0.6, 0}, {0.6, 0, 0})});
    const Scene bare(objects);
    for (std::size_t decal = 2; decal < 5; ++decal) { REQUIRE(bare.occluders(patches[decal].shape(), patches[5].shape()).clear()); }
    for (int i = 0; i < 6; ++i) {  // boxes without bottom, some with a wall in common
      const dvec3 from{random.uniform(-1, 0.4), random.uniform(-1, 0.6), 0};
      for (double x = from.x; x < from.x + 0.5; x += 0.25) {
        std::vector<Corners> walls = faces_of({x, from.y, 0}, {x + 0.25, from.y + random.uniform(0.1, 0.4), random.uniform(0.1, 1.5)});
        std::erase_if(walls,
                      [](const Corners& wall) { return std::all_of(wall.begin(), wall.end(), [](const dvec3& p) { return p.z == 0.0; }); });
        take(walls);
      }
    }
    const auto sets = instruction_sets();
    const Scene scene(objects, sets[static_cast<std::size_t>(turn) % sets.size()]);
    const auto any = [&] { return patches[random.below(static_cast<std::uint32_t>(patches.size()))]; };
    for (int i = 0; i < 200; ++i) {
      TestPatch p = any(), q = any();
      OccluderList list = scene.occluders(p.shape(), q.shape());
      for (int level = 0; level < 3; ++level) {
        INFO("turn " << turn << " pair " << i << " level " << level);
        check_pair(random, scene, p, q, list, [](const TestPatch&, const dvec3& x) { return x; });
        (list.clear() ? open : blocked) += list.clear() || list.blocked();
        p = child(random, p), q = child(random, q);
        list = scene.filter(list, p.shape(), q.shape());
      }
    }
  }
  CHECK(open > 300);
  CHECK(blocked > 100);
}
