// SPDX-License-Identifier: MIT
// The compiled scene: the laws that tie occluded, closest and brute force together, and watertight rooms.

#include "primitives.hpp"

#include <brep/builder_input.hpp>

using namespace raycast;
using namespace test;

namespace {

// Objects of every kind strewn through [-1,1]^3 times scale; enough of them to make the tree.
std::vector<PlacedObject> clutter(Random& random, int count, double scale) {
  std::vector<PlacedObject> objects;
  for (int i = 0; i < count; ++i) {
    const dvec3 at = scale * random.in_cube();
    const double size = 0.15 * scale;
    const Placement placement{random.rotation() * (size * random.uniform(0.5, 1)), at, false};
    switch (random.below(9)) {
      case 0:
        objects.push_back(placed(Sphere::make(at, size)));
        break;
      case 1:
        objects.push_back(placed(BoxObject::make({-1, -0.5, -0.1}, {1, 0.5, 0.1}), placement));
        break;
      case 2:
        objects.push_back(placed(Cylinder::make({0, 0, 0}, {0, 0, 1}, 0.5), placement));
        break;
      case 3:
        objects.push_back(placed(Polygon::make(rectangle({-1, -1, 0}, {2, 0, 0}, {0, 1, 0})), placement));
        break;
      case 4:
        objects.push_back(placed(Disk::make({0.1, 0, 0}, random.direction(), 0.7), placement));
        break;
      case 5:
        objects.push_back(placed(Cone::make({0, 0, -0.5}, {0.1, 0, 1}, 0.5, random.below(2) ? 0.0 : 0.25), placement));
        break;
      case 6:
        objects.push_back(placed(Torus::make({0, 0, 0}, random.direction(), 0.7, 0.3), placement));
        break;
      case 7:
        objects.push_back(placed(Superquadric::make({0, 0, 0}, {1, 0.5, 0.7}, random.uniform(0.1, 3), random.uniform(0.1, 3)), placement));
        break;
      default:
        objects.push_back(placed(Instance::make(l_block().object, {random.rotation() * 0.5, random.in_cube(0.2), false}), placement));
        break;
    }
  }
  return objects;
}
// Does any span of any object overlap the open segment?
bool brute_force(const std::vector<PlacedObject>& objects, const Segment& s) {
  for (const PlacedObject& object : objects) {
    for (const Span& span : spans(object, s)) {
      if (span.out.t > 0.0 && span.in.t < 1.0) { return true; }
    }
  }
  return false;
}

}  // namespace

TEST_CASE("occluded = brute force = occluded backwards, and = closest < 1 where the source is in the air") {
  SEEDED(random);
  for (const int count : {1, 5, 30, 300}) {
    for (const double scale : {1e-8, 1.0, 1e8}) {
      const std::vector<PlacedObject> objects = clutter(random, count, scale);
      const Scene scene(objects);
      int blocked = 0;
      for (int i = 0; i < 4000; ++i) {
        const dvec3 a = 1.2 * scale * random.in_cube(), b = 1.2 * scale * random.in_cube();
        const Segment s = between(a, b);
        const bool answer = scene.occluded(s);
        blocked += answer;
        REQUIRE(answer == brute_force(objects, s));
        REQUIRE(answer == scene.occluded(between(b, a)));
        bool buried = false;
        for (const PlacedObject& object : objects) {
          for (const Span& span : spans(object, s)) { buried = buried || (span.in.t <= 0.0 && span.out.t >= 0.0); }
        }
        if (buried) { continue; }
        const auto hit = scene.closest(s);
        REQUIRE(answer == (hit && hit->t < 1.0));
        // Splitting: a segment is free exactly when both its parts are.
        const double t = random.uniform();
        REQUIRE(answer == (scene.occluded(between(a, s.at(t))) || scene.occluded(between(s.at(t), b))));
        if (hit) {
          for (const PlacedObject& object : objects) {
            for (const Span& span : spans(object, s)) {
              if (span.in.t > 0.0) REQUIRE(hit->t <= span.in.t + 1e-12);  // the scene keeps polygons in world coordinates: other roundings
            }
          }
          const dvec3 normal = scene.object(hit->object).project(hit->sheet, s.at(hit->t)).normal;
          REQUIRE(hit->front == (glm::dot(normal, s.direction) < 0.0));
        }
      }
      if (count >= 30) { CHECK(blocked > 100); }
    }
  }
}

TEST_CASE("scaling the scene by powers of two leaves every t bit-identical") {
  SEEDED(random);
  const auto build = [](std::uint64_t seed, double factor) {
    std::mt19937_64 engine(seed);
    const auto next = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -52) - 1.0; };
    std::vector<PlacedObject> objects;
    for (int i = 0; i < 60; ++i) {
      const dvec3 at{next(), next(), next()}, a{0.2 * next(), 0.2 * next(), 0.2 * next()}, b{0.2 * next(), 0.2 * next(), 0.2 * next()};
      if (i % 4 == 0) { objects.push_back(placed(Sphere::make(factor * at, factor * 0.1))); }
      if (i % 4 == 1) { objects.push_back(placed(BoxObject::make(factor * at, factor * (at + 0.1)))); }
      if (i % 4 == 2) { objects.push_back(placed(Cylinder::make(factor * at, factor * a, factor * 0.1))); }
      if (i % 4 == 3) { objects.push_back(placed(Polygon::make({factor * at, factor * (at + a), factor * (at + b)}))); }
    }
    Placement inside = room(glm::dmat3(factor));  // through the placement's map
    objects.push_back(placed(mesh_of(*BoxObject::make({-2, -2, -2}, {2, 2, 2}), 0.0), inside));
    return Scene(objects);
  };
  const Scene one = build(random.seed(), 1.0), small = build(random.seed(), 0x1p-20), big = build(random.seed(), 0x1p20);
  for (int i = 0; i < 5000; ++i) {
    const Segment s{random.in_cube(), random.direction()};
    for (const auto& [scene, factor] : {std::pair(&small, 0x1p-20), std::pair(&big, 0x1p20)}) {
      const Segment scaled{factor * s.origin, factor * s.direction};
      const auto a = one.closest(s), b = scene->closest(scaled);
      REQUIRE(a);
      REQUIRE(b);
      REQUIRE(a->t == b->t);
      REQUIRE(a->object == b->object);
      REQUIRE(a->sheet == b->sheet);
      REQUIRE(one.occluded(s) == scene->occluded(scaled));
    }
  }
}

namespace {

// Casts `rays` rays, a third of them aimed at edges and vertices, from inside closed rooms.
void no_ray_escapes(Random& random, int many) {
  const auto ball = mesh_of(*Sphere::make({0.1, 0.2, 0.3}, 1.0), 0.03);  // triangles
  const auto cube = mesh_of(*BoxObject::make({-1, -1, -1}, {1, 1, 1}), 0.0);
  brep::Builder corners;
  ball->approximate(0.0, corners);
  std::vector<PlacedObject> walls;  // six polygons that look inwards, sharing edges and vertices
  for (Corners face : faces_of({-1, -1, -1}, {1, 1, 1})) {
    std::reverse(face.begin(), face.end());
    walls.push_back(placed(Polygon::make(face)));
  }
  const Placement turned = room(random.rotation() * 2.0, {0.3, 0.2, 0.1});
  const std::vector<Scene> rooms{Scene({placed(BoxObject::make({-1, -1, -1}, {1, 1, 1}), room())}),
                                 Scene({placed(cube, room())}),
                                 Scene(walls),
                                 Scene({placed(ball, room())}),
                                 Scene({placed(ball, turned)}),
                                 Scene({placed(BoxObject::make({-1, -1, -1}, {1, 1, 1}), turned)})};
  for (std::size_t which = 0; which < rooms.size(); ++which) {
    const Scene& scene = rooms[which];
    const int rays = which < 3 ? many / 5 : 2 * many / 15;
    int escaped = 0;
    for (int i = 0; i < rays; ++i) {
      const dvec3 from = 0.3 * random.in_cube() + dvec3(0.1, 0.2, 0.3);
      dvec3 d = random.direction();
      if (i % 2 && which < 3) {  // at an edge or a vertex, exactly or within rounding
        dvec3 at{random.uniform(-1, 1), 1, -1};
        if (i % 4 == 1) { at.x = random.below(2) ? 1.0 : -1.0; }
        if (i % 3 == 0) { std::swap(at.x, at.y); }
        d = (at - from) * (i % 8 < 4 ? 1.0 : random.uniform(0.01, 100));
      } else if (i % 2 && which == 3) {
        const dvec3 a = corners.position(random.below(corners.vertex_count()));
        const std::uint32_t f = random.below(corners.face_count());
        const dvec3 b = corners.position(corners.corners(f)[0]), c = corners.position(corners.corners(f)[1]);
        d = (i % 4 == 1 ? a : b + random.uniform() * (c - b)) - from;
      }
      escaped += !scene.closest(Segment{from, d}).has_value();
      escaped += !scene.occluded(Segment{from, 20.0 * d / glm::length(d)});
    }
    INFO("room " << which);
    CHECK(escaped == 0);
  }
}

}  // namespace

TEST_CASE("no ray escapes from a closed room: through faces, edges and vertices") {
  SEEDED(random);
  no_ray_escapes(random, 1'000'000);
}

TEST_CASE("no ray of ten million escapes from a closed room", "[slow]") {
  SEEDED(random);
  no_ray_escapes(random, 10'000'000);
}

TEST_CASE("zero-length and non-finite rays meet nothing, an empty scene is empty") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Scene scene({placed(Sphere::make({0, 0, 0}, 1)), placed(BoxObject::make({-3, -3, -3}, {3, 3, 3}), room())});
  for (const dvec3& d : {dvec3(0), dvec3(-0.0), dvec3(1e-320, 0, 0), dvec3(nan, 0, 1), dvec3(infinity, 0, 0)}) {
    CHECK_FALSE(scene.occluded(Segment{{0.5, 0, 0}, d}));
    CHECK_FALSE(scene.closest(Segment{{0.5, 0, 0}, d}));
  }
  // An origin that is no place: no answer is right, but there is one, and it is the same alone and among sixteen.
  for (const dvec3& o : {dvec3(nan, 0, 0), dvec3(0, infinity, 0), dvec3(-infinity, nan, 0), dvec3(1e300, 0, 0)}) {
    for (const dvec3& d : {dvec3(1, 0.5, 0.25), dvec3(nan, 0, 1), dvec3(1e300, 0, 0)}) {
      Segments16 segments;
      segments.set(3, {o, d}, no_object, no_object);
      CHECK(scene.occluded(Segment{o, d}) == (scene.occluded16(segments) != 0));
      CHECK(scene.closest(Segment{o, d}).has_value() == (scene.closest16(segments).met != 0));
    }
  }
  const Scene nothing({});
  CHECK(nothing.closest16(Segments16{}).met == 0);
  CHECK_FALSE(nothing.occluded(between({0, 0, 0}, {1, 1, 1})));
  CHECK_FALSE(nothing.closest(between({0, 0, 0}, {1, 1, 1})));
  CHECK_FALSE(nothing.covered({0, 0, 0}, {0, 0, 1}, no_object));
  CHECK(nothing.diameter() == 0.0);
}

TEST_CASE("far away: a scene moved by 1e5 sizes answers as at home") {
  SEEDED(random);
  const dvec3 shift{1e5, -2e5, 1.5e5};
  const auto build = [&](const dvec3& offset) {
    return Scene({placed(BoxObject::make(offset, offset + dvec3(1, 1, 1)), room()),
                  placed(BoxObject::make(offset + dvec3(0.25, 0.25, 0), offset + dvec3(0.5, 0.5, 0.5))),
                  placed(Sphere::make(offset + dvec3(0.7, 0.7, 0.25), 0.25)),
                  placed(Polygon::make(rectangle(offset + dvec3(0.4, 0.4, 1), {0, 0.2, 0}, {0.2, 0, 0})))});
  };
  const Scene home = build(dvec3(0)), away = build(shift);
  int differ = 0;
  for (int i = 0; i < 20000; ++i) {
    dvec3 a = 0.5 * random.in_cube() + 0.5, b = 0.5 * random.in_cube() + 0.5;
    a.z = 0, b.z = i % 2 ? 1 : b.z;
    const bool to_room = i % 2;
    differ += home.occluded(between(a, b), 0, to_room ? 0 : no_object) !=
              away.occluded(between(a + shift, b + shift), 0, to_room ? 0 : no_object);
  }
  CHECK(differ == 0);
}

TEST_CASE("work of a ray: boxes cost next to nothing, unless they lie at one place, where each is asked") {
  const auto work = [](int boxes, double apart) {
    std::vector<PlacedObject> objects{placed(BoxObject::make({-1, -1, -1}, {60, 2, 2}), room())};
    for (int i = 0; i < boxes; ++i) { objects.push_back(placed(BoxObject::make({i * apart, 0, 0}, {i * apart + 0.5, 1, 1}))); }
    return Scene(std::move(objects)).ray_work();
  };
  CHECK(work(50, 1.0) == work(1, 1.0));
  const double of_ten = work(10, 0.0) - work(1, 0.0);
  CHECK(of_ten > 0.0);
  CHECK(work(50, 0.0) - work(1, 0.0) == test::Approx(5.0 * of_ten));
}

TEST_CASE("copies that are left out change no answer, as sources of rays or beside them") {
  SEEDED(random);
  int hits = 0, blocked = 0;
  for (int round = 0; round < 20; ++round) {
    // Each object once, and some of them again at the end.
    const std::vector<PlacedObject> once = clutter(random, round % 2 ? 10 : 60, 1.0);
    std::vector<PlacedObject> twice = once;
    std::vector<std::uint32_t> copies, last(once.size());
    for (std::uint32_t i = 0; i < once.size(); ++i) {
      last[i] = i;
      const int more = static_cast<int>(random.below(3));
      for (int k = 0; k < more; ++k) {
        copies.push_back(last[i]);
        last[i] = static_cast<std::uint32_t>(twice.size());
        twice.push_back(once[i]);
      }
    }
    const Scene single(once);
    Scene without(twice);
    without.leave_out(copies);
    CHECK(without.ray_work() == test::Approx(single.ray_work()));
    for (int i = 0; i < 500; ++i) {
      const std::uint32_t owner = random.below(static_cast<std::uint32_t>(once.size()) + 1);
      const bool free = owner == once.size();
      dvec3 from = 1.2 * random.in_cube();
      if (!free) {  // a point of the surface: where a line from far enters
        const dvec3 inside = once[owner].bounds().centre(), away = 5.0 * random.direction();
        Spans met;
        once[owner].spans({inside + away, -away}, met);
        if (met.empty()) { continue; }
        from = inside + away - met[0].in.t * away;
      }
      const Segment ray = between(from, 1.2 * random.in_cube());
      const std::optional<Hit> hit = single.closest(ray, free ? no_object : owner);
      const std::optional<Hit> other = without.closest(ray, free ? no_object : last[owner]);
      REQUIRE(other.has_value() == hit.has_value());
      if (hit) { REQUIRE((other->t == hit->t && other->object == last[hit->object] && other->sheet == hit->sheet)); }
      REQUIRE(without.occluded(ray, free ? no_object : last[owner]) == single.occluded(ray, free ? no_object : owner));
      hits += hit ? 1 : 0;
      blocked += single.occluded(ray, free ? no_object : owner) ? 1 : 0;
    }
  }
  CHECK(hits > 1000);
  CHECK(blocked > 1000);
}

TEST_CASE("work of a ray: more where it passes more, behind its end nothing counts, the same from every instruction set") {
  SEEDED(random);
  for (int round = 0; round < 50; ++round) {
    const int boxes = 1 + static_cast<int>(random.below(100));
    std::vector<PlacedObject> row;
    for (int i = 0; i < boxes; ++i) { row.push_back(placed(BoxObject::make({2.0 * i, 0, 0}, {2.0 * i + 1, 1, 1}))); }
    const Scene scene(row), portable(row, raycast::Isa::portable);
    const Segment ray = between({-1, 0.5, 0.5}, {2.0 * boxes, 0.5, 0.5});
    const double through = scene.ray_work(ray), past = scene.ray_work(between({-1, 0.5, 5}, {2.0 * boxes, 0.5, 5}));
    const double to_first = scene.ray_work({ray.origin, ray.direction / (2.0 * boxes + 1.0)});
    CAPTURE(boxes, through, past, to_first);
    CHECK(through == portable.ray_work(ray));
    CHECK(through >= past + 0.25 * boxes);  // the bounds and the planes of each: .28 us
    CHECK((boxes == 1 || to_first < through));
  }
}
