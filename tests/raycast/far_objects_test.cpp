// SPDX-License-Identifier: MIT
// Suns: objects far away from all others change nothing among these, neither answers nor their accuracy, and are seen and hidden by the
// law.

#include "world.hpp"

#include <raycast/far_objects.hpp>

using namespace raycast;
using namespace test;

namespace {

struct Sunny {
  World with, without;
  std::uint32_t first_sun = 0;
};

// A world of some objects, and the same world with one to three suns of every kind, 40 to 1e5 times as far away as the world is large.
Sunny sunny(Random& random, int count, double scale, const dvec3& shift) {
  Sunny result;
  result.without = world(random, count, scale, shift, false);
  result.with = result.without;
  result.first_sun = static_cast<std::uint32_t>(result.with.objects.size());
  const std::uint32_t suns = 1 + random.below(3);
  for (std::uint32_t i = 0; i < suns; ++i) {
    const double distance = scale * 40 * std::pow(2500.0, random.uniform()), size = distance * random.uniform(0.005, 0.2);
    const dvec3 up = random.direction(), at = shift + distance * up;
    const std::uint32_t sun = result.first_sun + i;
    const auto add = [&](const PlacedObject& object) {
      brep::Builder mesh;
      object.approximate(0.1 * size, mesh);
      for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.sheet(f) == brep::no_sheet) { continue; }
        Corners corners;
        for (const std::uint32_t v : mesh.corners(f)) { corners.push_back(mesh.position(v)); }
        result.with.faces.push_back({sun, corners, mesh.sheet(f)});
      }
      result.with.objects.push_back(object);
    };
    switch (random.below(4)) {
      case 0:
        add(placed(Sphere::make(at, size)));
        break;
      case 1:
        add(placed(BoxObject::make({-1, -1, -1}, {1, 1, 1}), {random.rotation() * size, at, false}));
        break;
      case 2:
        add(placed(Polygon::make(rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})), {random.rotation() * size, at, false}));
        break;
      default:
        add(placed(Disk::make(at, -up, size)));
    }
  }
  return result;
}
// A place among all others, or on a sun.
Place some_place(Random& random, const Sunny& s, double scale, const dvec3& shift) {
  if (random.below(3) != 0) { return place(random, s.without, scale, shift); }
  for (;;) {
    const Place p = place(random, s.with, scale, shift);
    if (p.owner != no_object && p.owner >= s.first_sun) { return p; }
  }
}

bool begins_within(const std::vector<PlacedObject>& objects, const Segment& ray) {
  return std::any_of(objects.begin(), objects.end(), [&](const PlacedObject& object) {
    const auto all = spans(object, ray);
    return object.solid() && std::any_of(all.begin(), all.end(), [](const Span& span) { return span.in.t <= 0.0 && span.out.t >= 0.0; });
  });
}

}  // namespace

TEST_CASE("suns are far objects, and nothing else in their world is") {
  SEEDED(random);
  for (int turn = 0; turn < 50; ++turn) {
    const double scale = random.magnitude(8);
    const Sunny s = sunny(random, 80, scale, scale * random.in_cube());
    std::vector<std::uint32_t> suns;
    for (std::uint32_t i = s.first_sun; i < s.with.objects.size(); ++i) { suns.push_back(i); }
    CHECK(far_objects(s.with.objects) == suns);
    CHECK(far_objects(s.without.objects).empty());
  }
}

TEST_CASE("with suns all searches give the answers of the law") {
  SEEDED(random);
  int of_suns = 0, compared = 0;
  for (int turn = 0; turn < 24; ++turn) {
    const double scale = random.magnitude(6);
    const dvec3 shift = scale * random.in_cube();
    const Sunny s = sunny(random, turn % 2 == 0 ? 25 : 120, scale, shift);
    const auto sets = instruction_sets();
    const Scene scene(s.with.objects, sets[static_cast<std::size_t>(turn) % sets.size()]);
    for (int i = 0; i < 120; ++i) {
      INFO("turn " << turn << " bundle " << i);
      Segments16 segments, rays;
      for (unsigned lane = 0; lane < 16; ++lane) {
        const Place p = some_place(random, s, scale, shift), q = some_place(random, s, scale, shift);
        segments.set(lane, between(p.at, q.at), p.owner, q.owner, p.sheet, q.sheet);
        Segment ray = between(p.at, q.at);
        ray.direction += 1e-3 * glm::length(ray.direction) * random.in_cube();  // not exactly at a corner, where rounding decides
        rays.set(lane, ray, p.owner, no_object, p.sheet);
      }
      require_blocked(scene, segments, by_law(scene, segments));
      const Hits16 hits = scene.closest16(rays);
      for (unsigned lane = 0; lane < 16; ++lane) {
        const Segment ray = rays.at(lane);
        const auto hit = scene.closest(ray, rays.source[lane], rays.source_sheet[lane]);
        REQUIRE(hit.has_value() == ((hits.met >> lane & 1u) != 0));
        if (!begins_within(s.with.objects, ray)) {  // then nothing stands on the ray up to the hit, or nowhere
          REQUIRE_FALSE(by_law(scene, {ray.origin, 0.999 * (hit ? hit->t : 1e3) * ray.direction}, rays.source[lane], no_object));
          ++compared;
        }
        if (!hit) { continue; }
        REQUIRE(hit->t == hits.hit[lane].t);
        REQUIRE(hit->object == hits.hit[lane].object);
        of_suns += hit->object >= s.first_sun;
      }
    }
  }
  CHECK(of_suns > 1000);
  CHECK(compared > 10000);
}

TEST_CASE("what a sun lights is told apart by the law's answers, for a pair of patches and its children") {
  SEEDED(random);
  std::size_t clear = 0, blocked = 0, all = 0;
  for (int turn = 0; turn < 30; ++turn) {
    const double scale = random.magnitude(6);
    const dvec3 shift = scale * random.in_cube();
    const Sunny s = sunny(random, turn % 2 == 0 ? 8 : 60, scale, shift);
    const auto sets = instruction_sets();
    const Scene scene(s.with.objects, sets[static_cast<std::size_t>(turn) % sets.size()]);
    const std::size_t suns = s.with.faces.size() - s.without.faces.size();
    for (int i = 0; i < 80; ++i) {
      const Facet& lit = s.without.faces[random.below(static_cast<std::uint32_t>(s.without.faces.size()))];
      const Facet& sun = s.with.faces[s.without.faces.size() + random.below(static_cast<std::uint32_t>(suns))];
      const bool swapped = random.below(2) != 0;
      const Facet &a = swapped ? sun : lit, &b = swapped ? lit : sun;
      Corners p = a.corners, q = b.corners;
      OccluderList list = scene.occluders({p, a.owner, 0.0, a.sheet}, {q, b.owner, 0.0, b.sheet});
      for (int level = 0; level < 3; ++level) {
        Segments16 segments;
        const auto within = [&](const Corners& corners) {
          dvec3 sum{0.0};
          double weights = 0.0;
          for (const dvec3& c : corners) {
            const double weight = random.uniform();
            sum += weight * c, weights += weight;
          }
          return sum / weights;
        };
        for (unsigned lane = 0; lane < 16; ++lane) {
          segments.set(lane, between(within(p), within(q)), a.owner, b.owner, a.sheet, b.sheet);
        }
        const std::uint32_t expected = by_law(scene, segments);
        std::uint32_t hint = no_shape;
        if (list.clear()) { REQUIRE(expected == 0); }
        if (list.blocked()) { REQUIRE(expected == 0xffff); }
        REQUIRE(scene.occluded16(segments, list, hint) == expected);
        clear += list.clear(), blocked += list.blocked(), ++all;
        for (Corners* const contour : {&p, &q}) {
          const dvec3 towards = within(*contour);
          for (dvec3& c : *contour) { c = 0.5 * (c + towards); }
        }
        list = scene.filter(list, {p, a.owner, 0.0, a.sheet}, {q, b.owner, 0.0, b.sheet});
      }
    }
  }
  CHECK(clear > all / 50);
  CHECK(blocked > all / 400);
}

// The lists that single precision gives are longer if its error bound grows with the distance of the sun.
TEST_CASE("among the others, lists of occluders are hardly longer with suns than without") {
  SEEDED(random);
  std::size_t with = 0, without = 0;
  for (int turn = 0; turn < 30; ++turn) {
    const double scale = random.magnitude(6);
    const Sunny s = sunny(random, 60, scale, scale * random.in_cube());
    const Scene sunny_scene(s.with.objects), scene(s.without.objects);
    const auto any = [&]() -> const Facet& { return s.without.faces[random.below(static_cast<std::uint32_t>(s.without.faces.size()))]; };
    for (int i = 0; i < 200; ++i) {
      const Facet &p = any(), &q = any();
      const PatchShape a{p.corners, p.owner, 0.0, p.sheet}, b{q.corners, q.owner, 0.0, q.sheet};
      with += sunny_scene.occluders(a, b).shapes().size();
      without += scene.occluders(a, b).shapes().size();
    }
  }
  CHECK(std::abs(static_cast<double>(with) / static_cast<double>(without) - 1.0) < 0.02);
}
