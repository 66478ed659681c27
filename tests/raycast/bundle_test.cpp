// SPDX-License-Identifier: MIT
// The fast searches against the law they stand for: occluded_by() of every object, in double precision.

#include "world.hpp"

#include <thread>

using namespace raycast;
using namespace test;

bool same(const std::optional<Hit>& a, const std::optional<Hit>& b) {
  if (!a || !b) { return a.has_value() == b.has_value(); }
  return a->t == b->t && a->object == b->object && a->sheet == b->sheet && a->front == b->front;
}
std::optional<Hit> lane_of(const Hits16& hits, unsigned lane) {
  if (!(hits.met >> lane & 1u)) { return std::nullopt; }
  return hits.hit[lane];
}

TEST_CASE("bundle = single = the law for every object, on every instruction set, over 16 decades") {
  SEEDED(random);
  std::size_t blocked = 0, all = 0;
  for (int turn = 0; turn < 60; ++turn) {
    const double scale = random.magnitude(8);
    const dvec3 shift = turn % 3 == 0 ? scale * random.magnitude(5) * random.in_cube() : scale * random.in_cube();
    const World w = world(random, turn % 4 == 0 ? 4 : turn % 4 == 1 ? 30 : 150, scale, shift, turn % 2);
    std::vector<Scene> scenes;
    for (const Isa isa : instruction_sets()) { scenes.emplace_back(w.objects, isa); }
    std::uint32_t hint = no_shape;
    for (int i = 0; i < 60; ++i) {
      Segments16 segments;
      const Place a = place(random, w, scale, shift), b = place(random, w, scale, shift);
      const double spread = i % 3 == 0 ? 0.0 : 0.05 * scale;  // a coherent bundle, or sixteen different segments
      for (unsigned lane = 0; lane < 16; ++lane) {
        if (i % 7 == 0 && random.below(3) == 0) { continue; }
        Place p = a, q = b;
        if (i % 3 == 0) { p = place(random, w, scale, shift), q = place(random, w, scale, shift); }
        if (i % 2 == 0 && spread > 0.0) {
          p.at += spread * random.in_cube(), q.at += spread * random.in_cube();
          p.sheet = q.sheet = unknown_sheet;
        }
        Segment s = between(p.at, q.at);
        if (random.below(10) == 0) {  // it ends elsewhere
          if (random.below(2) == 0) { s.direction[static_cast<int>(random.below(3))] = random.below(2) ? 0.0 : -0.0; }
          if (random.below(5) == 0) { s.direction = dvec3(0.0); }
          if (random.below(5) == 0) { s.direction *= 1e7; }
          if (random.below(5) == 0) { s.direction *= 1e-12; }
          q.sheet = unknown_sheet;
        }
        segments.set(lane, s, p.owner, q.owner, p.sheet, q.sheet);
      }
      const std::uint32_t expected = by_law(scenes[0], segments);
      for (std::size_t k = 0; k < scenes.size(); ++k) {
        INFO("turn " << turn << " bundle " << i << " set " << k);
        require_blocked(scenes[k], segments, expected);
        REQUIRE(scenes[k].occluded16(segments, hint) == expected);
      }
      blocked += static_cast<std::size_t>(std::popcount(expected));
      all += static_cast<std::size_t>(std::popcount(segments.lanes));
    }
  }
  CHECK(blocked > all / 10);
  CHECK(blocked < all - all / 10);
}

TEST_CASE("blocks on a grid, with faces in one plane: the law, whether the sheets of the ends are known or not") {
  SEEDED(random);
  const auto steps = l_block();
  std::size_t blocked = 0, all = 0;
  for (int turn = 0; turn < 60; ++turn) {
    World w;
    const auto add = [&](const PlacedObject& object) {
      brep::Builder mesh;
      object.approximate(0.1, mesh);
      for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        Corners corners;
        for (const std::uint32_t v : mesh.corners(f)) { corners.push_back(mesh.position(v)); }
        w.faces.push_back({static_cast<std::uint32_t>(w.objects.size()), corners, mesh.sheet(f)});
      }
      w.objects.push_back(object);
    };
    if (turn % 2) { add(placed(BoxObject::make({-4, -4, -4}, {6, 6, 6}), room())); }
    for (int i = 0; i < 6; ++i) {
      const dvec3 at{random.below(5) - 2.0, random.below(5) - 2.0, random.below(5) - 2.0};
      const auto axis = static_cast<int>(random.below(3));
      glm::dmat3 turned{0.0};  // a cyclic exchange of axes
      for (int k = 0; k < 3; ++k) { turned[k][(k + axis) % 3] = 1.0; }
      add(random.below(3) ? placed(steps, {turned, at, false}) : placed(BoxObject::make(at, at + 1.0)));
    }
    std::vector<Scene> scenes;
    for (const Isa isa : instruction_sets()) { scenes.emplace_back(w.objects, isa); }
    const auto on_grid = [&](const Facet& face) {
      for (;;) {  // the mean of four corners, until it lies on the face
        dvec3 p{0.0};
        for (int k = 0; k < 4; ++k) { p += 0.25 * face.corners[random.below(static_cast<std::uint32_t>(face.corners.size()))]; }
        const dvec3 n = 0.01 * w.objects[face.owner].project(face.sheet, p).normal;
        for (const Span& span : spans(w.objects[face.owner], {p - n, 2.0 * n})) {
          if (std::abs(span.in.t - 0.5) < 1e-9 || std::abs(span.out.t - 0.5) < 1e-9) { return p; }
        }
      }
    };
    for (int i = 0; i < 60; ++i) {
      Segments16 segments, unknown;
      for (unsigned lane = 0; lane < 16; ++lane) {
        const Facet& p = w.faces[random.below(static_cast<std::uint32_t>(w.faces.size()))];
        const Facet& q = w.faces[random.below(static_cast<std::uint32_t>(w.faces.size()))];
        const Segment s = between(on_grid(p), on_grid(q));
        // Before a sheet, on a reentrant edge, may be within the solid.
        const auto sheet = [&](const Facet& face, const Segment& from_it) {
          if (glm::dot(w.objects[face.owner].project(face.sheet, from_it.origin).normal, from_it.direction) < 0.0) { return face.sheet; }
          for (const Span& span : spans(w.objects[face.owner], from_it)) {
            if (span.in.t < 1e-9 && span.out.t > 1e-9) { return unknown_sheet; }
          }
          return face.sheet;
        };
        segments.set(lane, s, p.owner, q.owner, sheet(p, s), sheet(q, {s.at(1.0), -s.direction}));
        unknown.set(lane, s, p.owner, q.owner);
      }
      const std::uint32_t expected = by_law(scenes[0], segments);
      for (const Scene& scene : scenes) {
        INFO("turn " << turn << " bundle " << i);
        REQUIRE(scene.occluded16(segments) == expected);
        REQUIRE(scene.occluded16(unknown) == expected);
        const Hits16 hits = scene.closest16(segments), again = scene.closest16(unknown);
        for (unsigned lane = 0; lane < 16; ++lane) { REQUIRE(same(lane_of(hits, lane), lane_of(again, lane))); }
      }
      blocked += static_cast<std::size_t>(std::popcount(expected));
      all += 16;
    }
  }
  CHECK(blocked > all / 10);
  CHECK(blocked < all - all / 10);
}

TEST_CASE("the first hit is the same alone and among sixteen, on every instruction set, and no object is met before it") {
  SEEDED(random);
  std::size_t met = 0;
  for (int turn = 0; turn < 40; ++turn) {
    const double scale = random.magnitude(8);
    const dvec3 shift = turn % 3 == 0 ? scale * random.magnitude(4) * random.in_cube() : scale * random.in_cube();
    const World w = world(random, turn % 4 == 0 ? 4 : turn % 4 == 1 ? 30 : 150, scale, shift, turn % 2);
    std::vector<Scene> scenes;
    for (const Isa isa : instruction_sets()) { scenes.emplace_back(w.objects, isa); }
    for (unsigned i = 0; i < 25; ++i) {
      Segments16 rays;
      Place a = place(random, w, scale, shift), b = place(random, w, scale, shift);
      for (unsigned lane = 0; lane < 16; ++lane) {
        if (lane == 13 && i % 3 == 0) continue;  // not all lanes are set
        if (i % 2 == 0)                          // all over the scene, or close together as through a pixel
          a = place(random, w, scale, shift), b = place(random, w, scale, shift);
        else { b.at += 0.02 * scale * random.in_cube(); }
        Segment ray = between(a.at, b.at);
        if ((lane + i) % 9 == 0) { ray.direction[static_cast<int>(random.below(3))] = 0.0; }
        if ((lane + i) % 5 == 0) { ray.direction *= random.magnitude(6); }
        std::uint32_t sheet = a.sheet;
        if ((lane + i) % 41 == 0) { ray.origin -= 1e8 * ray.direction, sheet = unknown_sheet; }
        if ((lane + i) % 43 == 0) { ray.direction = dvec3(lane % 2 ? 0.0 : std::nan("")); }
        rays.set(lane, ray, a.owner, no_object, sheet);
      }
      std::vector<Hits16> bundles;
      for (const Scene& scene : scenes) { bundles.push_back(scene.closest16(rays)); }
      for (std::uint32_t rest = rays.lanes; rest; rest &= rest - 1) {
        const auto lane = static_cast<unsigned>(std::countr_zero(rest));
        const Segment ray = rays.at(lane);
        const std::optional<Hit> hit = scenes[0].closest(ray, rays.source[lane]);  // without the sheet
        INFO("turn " << turn << " bundle " << i << " lane " << lane);
        met += hit.has_value();
        if (hit) { REQUIRE((hit->t > 0.0 && hit->t < infinity)); }
        for (std::size_t k = 0; k < scenes.size(); ++k) {
          REQUIRE(same(hit, scenes[k].closest(ray, rays.source[lane], rays.source_sheet[lane])));
          REQUIRE(same(hit, lane_of(bundles[k], lane)));
        }
        if (!hit || rays.source[lane] != no_object) { continue; }
        // From the air far from any surface: the nearest entry of all spans; polygons, which the scene places with other roundings, may
        // be met before it.
        double nearest = infinity;
        bool touching = false;
        for (const PlacedObject& object : w.objects) {
          touching = touching || object.bounds().contains(ray.origin, 1e-3 * scale);
          if (!object.object().outline().empty()) { continue; }
          for (const Span& span : spans(object, ray)) {
            if (span.in.t > 0.0) { nearest = std::min(nearest, span.in.t); }
          }
        }
        if (touching) { continue; }
        REQUIRE(hit->t <= nearest * (1.0 + 1e-9));
        if (w.objects[hit->object].object().outline().empty()) { REQUIRE(hit->t == test::Approx(nearest).epsilon(1e-9)); }
      }
      for (const Hits16& hits : bundles) { REQUIRE((hits.met & ~rays.lanes) == 0); }
    }
  }
  CHECK(met > 5000);
}

// Twice the same: the later one covers. For segments between surfaces see self_shadow_test.
TEST_CASE("of two equal objects in one place the later is met, and both together occlude as one does") {
  SEEDED(random);
  std::size_t met = 0, blocked = 0;
  for (int turn = 0; turn < 12; ++turn) {
    const double scale = random.magnitude(8);
    const dvec3 shift = scale * random.in_cube();
    const World w = world(random, 40, scale, shift, false);
    std::vector<PlacedObject> twice = w.objects;
    twice.insert(twice.end(), w.objects.begin(), w.objects.end());
    for (const Isa isa : instruction_sets()) {
      const Scene one(w.objects, isa), two(twice, isa);
      for (int i = 0; i < 20; ++i) {
        Segments16 segments;
        for (unsigned lane = 0; lane < 16; ++lane) {
          segments.set(lane, between(shift + scale * random.in_cube(), shift + scale * random.in_cube()), no_object, no_object);
        }
        const Hits16 first = one.closest16(segments), again = two.closest16(segments);
        const std::uint32_t occluded = one.occluded16(segments);
        INFO("turn " << turn << " bundle " << i);
        CHECK(two.occluded16(segments) == occluded);
        blocked += static_cast<std::size_t>(std::popcount(occluded));
        REQUIRE(first.met == again.met);
        for (std::uint32_t rest = first.met; rest; rest &= rest - 1) {
          const auto lane = static_cast<unsigned>(std::countr_zero(rest));
          ++met;
          CHECK(first.hit[lane].t < infinity);
          CHECK(again.hit[lane].t == first.hit[lane].t);
          CHECK(again.hit[lane].object >= w.objects.size());
        }
      }
    }
  }
  CHECK(met > 500);
  CHECK(blocked > 500);
}

TEST_CASE("a scene may be asked by many threads at once") {
  SEEDED(random);
  const World w = world(random, 100, 1.0, dvec3(0.0), true);
  const Scene scene(w.objects);
  std::vector<Segments16> bundles(400);
  for (Segments16& bundle : bundles) {
    for (unsigned lane = 0; lane < 16; ++lane) {
      const Place a = place(random, w, 1.0, dvec3(0.0)), b = place(random, w, 1.0, dvec3(0.0));
      bundle.set(lane, between(a.at, b.at), a.owner, b.owner);
    }
  }
  std::vector<std::vector<std::uint32_t>> answers(4, std::vector<std::uint32_t>(bundles.size()));
  {
    std::vector<std::jthread> threads;
    for (auto& mine : answers) {
      threads.emplace_back([&] {
        for (std::size_t i = 0; i < bundles.size(); ++i) { mine[i] = scene.occluded16(bundles[i]); }
      });
    }
  }
  for (const auto& mine : answers) { CHECK(mine == answers[0]); }
}
