// SPDX-License-Identifier: MIT
// Laws that tie primitives to each other, to their bounds and placements, and to rays of the awkward kind.

#include "primitives.hpp"

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/polygon.hpp>

#include <limits>

using namespace raycast;
using namespace test;

namespace {

Spans spans_of(const Made<Object>& object, const Segment& line) { return spans(placed(object), line); }

// Equal spans, but for those that one object has alone because the line grazes it: no longer than `margin`.
bool alike(const Spans& a, const Spans& b, double margin) {
  std::size_t i = 0, j = 0;
  const auto same = [&](double x, double y) { return x == y || std::abs(x - y) <= margin; };
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && same(a[i].in.t, b[j].in.t) && same(a[i].out.t, b[j].out.t)) {
      ++i, ++j;
    } else if (i < a.size() && a[i].out.t - a[i].in.t <= margin) {
      ++i;
    } else if (j < b.size() && b[j].out.t - b[j].in.t <= margin) {
      ++j;
    } else {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("kin: special cases of one primitive are another one") {
  SEEDED(random);
  const dvec3 z{0, 0, 1}, origin{0.0};
  const std::pair<Made<Object>, Made<Object>> pairs[] = {
      {Superquadric::make(origin, dvec3(1.0), 1, 1), Sphere::make(origin, 1)},
      {Superquadric::make(origin, {0.25, 0.25, 0.25}, 1, 1, 3), Torus::make(origin, z, 0.75, 0.25)},
      {Superquadric::make(origin, {1, 0.5, 0.25}, 0.001, 0.001), BoxObject::make({-1, -0.5, -0.25}, {1, 0.5, 0.25})},
      {Superquadric::make(origin, {1, 1, 0.5}, 0.001, 1), Cylinder::make({0, 0, -0.5}, z, 1)},
      {Cone::make(origin, z, 0.5, 0.5), Cylinder::make(origin, z, 0.5)},
      {Cone::make(origin, z, 0.5, 0.25), Instance::make(Cone::make(z, -z, 0.25, 0.5).object, {})},
      {Instance::make(Sphere::make({1, 2, 3}, 1).object, {glm::dmat3(0.5), {1, 1, 1}, false}), Sphere::make({1.5, 2, 2.5}, 0.5)}};
  for (std::size_t k = 0; k < std::size(pairs); ++k) {
    const auto& [a, b] = pairs[k];
    int met = 0;
    for (int i = 0; i < 5000; ++i) {
      const Segment line = between(2.0 * random.direction(), b->bounds().centre() + random.in_cube());
      const Spans of_a = spans_of(a, line), of_b = spans_of(b, line);
      INFO("pair " << k << " line " << i);
      // Exponents of 0.001 round edges by 0.001 ln 2 of the radius; elsewhere a grazing chord takes the root of rounding.
      CHECK(alike(of_a, of_b, k == 2 || k == 3 ? 0.1 : 1e-6));
      met += !of_b.empty();
    }
    CHECK(met > 500);
  }
}

TEST_CASE("growing a convex primitive, or a torus' tube, never turns a hit into a miss") {
  SEEDED(random);
  for (int i = 0; i < 20000; ++i) {
    const Segment line = between(3.0 * random.direction(), random.in_cube(1.2));
    const double grown = 1.0 + std::pow(10.0, random.uniform(-9, 0)), e = random.uniform(0.05, 2), n = random.uniform(0.05, 2);
    const std::pair<Made<Object>, Made<Object>> pairs[] = {
        {Superquadric::make(dvec3(0.0), {1, 0.5, 0.7}, n, e), Superquadric::make(dvec3(0.0), grown * dvec3(1, 0.5, 0.7), n, e)},
        {Torus::make(dvec3(0.0), {1, 2, 3}, 1, 0.25), Torus::make(dvec3(0.0), {1, 2, 3}, 1, 0.25 * std::min(grown, 3.9))},
        {Cone::make(dvec3(0.0), {0, 0, 1}, 0.5), Cone::make(dvec3(0.0), {0, 0, grown}, 0.5 * grown)}};
    for (const auto& [small, large] : pairs) {
      if (!spans_of(small, line).empty()) { CHECK_FALSE(spans_of(large, line).empty()); }
    }
  }
}

TEST_CASE("every primitive under uneven scales up to 10^4: a placement changes no parameter") {
  SEEDED(random);
  for (const Primitive& primitive : primitives()) {
    if (primitive.pinched) continue;  // a blade may be met or missed by rounding
    const auto object = primitive.make({0, 0, 0}, 1.0);
    for (int i = 0; i < 400; ++i) {
      const double size = random.magnitude(8);
      dvec3 s{1.0};
      for (int k = 0; k < 3; ++k) { s[k] = std::pow(10.0, random.uniform(-4, 0)); }
      glm::dmat3 linear = random.rotation() * glm::dmat3(s.x, 0, 0, 0, s.y, 0, 0, 0, s.z) * random.rotation() * size;
      if (i % 2) { linear[0] = -linear[0]; }
      const Placement placement{linear, size * random.in_cube(), false};
      REQUIRE_FALSE(check(*object, placement));
      const Segment line = between(3.0 * random.direction(), 0.8 * random.in_cube());
      const Segment image{linear * line.origin + placement.translation, linear * line.direction};
      INFO(primitive.name << " " << i);
      // The condition number is at most 1e4, and the origin 3 sizes away: 1e-11 across the surface, its root where the line grazes.
      CHECK(alike(spans_of(object, line), spans(placed(object, placement), image), 1e-4));
    }
  }
}

TEST_CASE("every primitive: its crossings lie within the bounds, and a line that misses those has none") {
  SEEDED(random);
  for (const Primitive& primitive : primitives()) {
    const auto object = primitive.make({0.5, 1, -2}, 1.0);
    const Placement placement{random.rotation() * glm::dmat3(random.uniform(0.1, 3), 0.2, 0, 0, random.uniform(0.1, 3), 0, 0.1, 0, 1),
                              random.in_cube(5), false};
    const PlacedObject subject = placed(object, placement);
    for (int i = 0; i < 1000; ++i) {
      const Segment line = between(subject.bounds().centre() + 6.0 * random.direction(), subject.bounds().centre() + random.in_cube(2));
      const Spans found = spans(subject, line);
      INFO(primitive.name);
      for (const Span& s : found) {
        CHECK(subject.bounds().contains(line.at(s.in.t), 1e-13 * subject.bounds().magnitude()));
        CHECK(subject.bounds().contains(line.at(s.out.t), 1e-13 * subject.bounds().magnitude()));
      }
      double entry = 0.0;
      if (!SlabTest(line)(subject.bounds(), -infinity, infinity, entry)) { CHECK(found.empty()); }
    }
  }
}

TEST_CASE("every primitive: project is idempotent, and the way to the point runs along the normal") {
  SEEDED(random);
  for (const Primitive& primitive : primitives()) {
    for (int i = 0; i < 200; ++i) {
      const double size = random.magnitude(6);
      const auto object = primitive.make(size * random.in_cube(), size);
      for (std::uint32_t sheet = 0; sheet < object->sheet_count(); ++sheet) {
        const dvec3 away = object->bounds().centre() + size * random.in_cube(1.5);
        const SurfacePoint first = object->project(sheet, away), again = object->project(sheet, first.position);
        INFO(primitive.name << " " << i);
        // Between two blades of a pinched tube the nearest point moves by more than rounding does.
        CHECK(glm::length(again.position - first.position) <= (primitive.pinched ? 1e-9 : 1e-14) * (size + object->bounds().magnitude()));
        CHECK(glm::length(first.normal) == test::Approx(1.0).epsilon(1e-14));
        if (primitive.creased) continue;  // edges have no one normal
        // From just outside, nearer than any radius of curvature but those of sharp boxes.
        if (primitive.name == "sharp box" || primitive.name.find("con") == 0 || primitive.name == "cup") { continue; }
        const dvec3 near = first.position + 1e-3 * size * random.direction();
        const SurfacePoint onto = object->project(sheet, near);
        CHECK(glm::length(glm::cross(near - onto.position, onto.normal)) <= 1e-5 * size);  // the pillow's rim bends sharply
        CHECK(glm::length(near - onto.position) <= 1e-3 * size * (1 + 1e-9));
      }
    }
  }
}

TEST_CASE("every primitive: axis-parallel lines, zeros of both signs and denormal components") {
  const double zeros[] = {0.0, -0.0, 1e-310, -1e-310, std::numeric_limits<double>::denorm_min()};
  for (const Primitive& primitive : primitives()) {
    const PlacedObject subject = placed(primitive.make({0, 0, 0}, 1.0));
    for (int axis = 0; axis < 3; ++axis) {
      for (const double off : {0.0, -0.0, 0.1, 0.3, 1.0, -1.0, 2.0}) {
        for (const double sign : {1.0, -1.0}) {
          dvec3 o{0.0}, d{0.0};
          d[axis] = sign;
          o[axis] = -3 * sign;
          o[(axis + 1) % 3] = off;
          o[(axis + 2) % 3] = 0.125;
          const Spans reference = spans(subject, Segment{o, d});
          const bool tangent =
              std::abs(off - subject.bounds().lo[(axis + 1) % 3]) < 1e-12 || std::abs(off) == 1.0;  // the line lies in a plane that touches
          for (const Span& s : reference) { CHECK((s.in.t > 1.9 && s.in.t <= s.out.t && s.out.t < 4.1)); }
          if (off == 2.0) { CHECK(reference.empty()); }
          for (const double a : zeros) {
            for (const double b : zeros) {
              d[(axis + 1) % 3] = a;
              d[(axis + 2) % 3] = b;
              INFO(primitive.name << " axis " << axis << " off " << off << " zeros " << a << " " << b);
              const Spans found = spans(subject, Segment{o, d});
              if (!tangent) { CHECK(alike(found, reference, 1e-12)); }
            }
          }
        }
      }
    }
    for (const dvec3& d : {dvec3(0.0), dvec3(-0.0), dvec3(1e-320, 0, 0)}) {
      const Scene scene({subject});
      CHECK_FALSE(scene.occluded(Segment{{0, 0, 0}, d}));
      CHECK_FALSE(scene.closest(Segment{{0, 0, 0}, d}));
    }
  }
}

TEST_CASE("every convex primitive: a ray that leaves it never meets it again") {
  SEEDED(random);
  for (const Primitive& primitive : primitives()) {
    const auto shape = primitive.make({0, 0, 0}, 1.0);
    if (!shape->convex()) { continue; }
    for (int i = 0; i < 500; ++i) {
      const double scale = random.magnitude(8);
      const Placement placement{random.rotation() * scale, scale * std::pow(10.0, random.uniform(-2, 3)) * random.in_cube(), false};
      const PlacedObject object = placed(shape, placement);
      const Scene alone({object});
      Spans found;
      const Segment through = between(3.0 * random.direction(), 0.3 * random.in_cube());
      shape->spans(through, found);
      if (found.empty()) { continue; }
      const dvec3 p = placement.linear * through.at(found[0].in.t) + placement.translation;
      const SurfacePoint at = object.project(found[0].in.sheet, p);
      for (int k = 0; k < 10; ++k) {
        dvec3 d = scale * std::pow(10.0, random.uniform(-3, 3)) * random.direction();
        if (glm::dot(d, at.normal) < 0.0) { d = -d; }
        if (glm::dot(d, at.normal) < 1e-9 * glm::length(d)) continue;  // nearer to the tangent plane than the rounding of the position
        INFO(primitive.name);
        CHECK_FALSE(alone.occluded(Segment{at.position, d}, 0));
        CHECK_FALSE(alone.occluded(Segment{at.position + d, -d}, no_object, 0));
        CHECK_FALSE(alone.closest(Segment{at.position, d}, 0));
      }
    }
  }
}

TEST_CASE("no ray escapes from a room of any primitive") {
  SEEDED(random);
  int rays = 0, escaped = 0;
  for (const Primitive& primitive : primitives()) {
    const auto body = primitive.make({0, 0, 0}, 1.0);
    const Placement turned = room(random.rotation() * 2.0, {0.3, 0.2, 0.1});
    const Scene scene({placed(body, turned)});
    for (int i = 0; i < 20000; ++i) {
      const dvec3 from = 0.9 * random.in_cube();
      if (primitive.implicit(real(from)) > -1e-9L) continue;  // not in the air of the room
      const dvec3 origin = turned.linear * from + turned.translation, d = random.direction();
      ++rays;
      const auto hit = scene.closest(Segment{origin, d});
      escaped += !hit || !(hit->t > 0.0);
      escaped += !scene.occluded(Segment{origin, 20.0 * d});
    }
  }
  CHECK(rays > 50000);
  CHECK(escaped == 0);
}

TEST_CASE("a mesh made from a BRep is the mesh made from its list, closed or open") {
  SEEDED(random);
  struct Position {
    dvec3 position{0.0};
  };
  struct Sheet {
    std::uint32_t sheet = 0;
  };
  using SheetBRep = brep::BRep<Position, brep::NoData, Sheet>;
  const Corners gutter{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}};
  const Made<Mesh> lists[] = {l_block(), Mesh::make(gutter, {{0, 1, 2, 3}, {1, 4, 5, 2}})};
  for (const auto& list : lists) {
    brep::Builder builder;
    list->approximate(0.0, builder);
    const auto closed = brep::close<SheetBRep>(builder);
    REQUIRE(closed.brep);
    const auto copy = Mesh::make(*closed.brep);
    INFO(copy.refusal);
    REQUIRE(copy);
    CHECK(copy->solid() == list->solid());
    CHECK(copy->sheet_count() == list->sheet_count());
    for (int i = 0; i < 2000; ++i) {
      const Segment line = between(3.0 * random.direction(), random.in_cube());
      Spans a, b;
      list->spans(line, a);
      copy->spans(line, b);
      REQUIRE(a.size() == b.size());
      for (std::size_t k = 0; k < a.size(); ++k) { CHECK((a[k].in.t == b[k].in.t && a[k].out.sheet == b[k].out.sheet)); }
    }
  }
}

TEST_CASE("instances of instances share one object and answer as the composed placement does") {
  SEEDED(random);
  const auto torus = Torus::make({0, 0, 0}, {0, 0, 1}, 1, 0.3);
  for (int i = 0; i < 300; ++i) {
    const Placement inner{random.rotation() * random.uniform(0.5, 2), random.in_cube(), false};
    const Placement outer{random.rotation() * glm::dmat3(1, 0, 0, 0, 2, 0, 0, 0, 0.5), random.in_cube(), false};
    const auto nested = Instance::make(Instance::make(torus.object, inner).object, outer);
    const PlacedObject direct = placed(torus, compose(outer, inner));
    const Segment line = between(4.0 * random.direction(), direct.bounds().centre() + random.in_cube());
    // The maps' condition is at most 16; a grazing chord takes the root of rounding.
    CHECK(alike(spans_of(nested, line), spans(direct, line), 1e-6));
    const dvec3 p = random.in_cube(3);
    CHECK(glm::length(nested->project(0, p).position - direct.project(0, p).position) <= 1e-12);
  }
  CHECK(torus.object.use_count() == 1);
}

TEST_CASE("disks: met within the radius, at any size and distance, their mesh has their area") {
  SEEDED(random);
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = random.magnitude(8), far = size * std::pow(10.0, random.uniform(0, 8));
    const dvec3 centre = random.in_cube(size * std::pow(10.0, random.uniform(-2, 2)));
    const glm::dmat3 frame = random.rotation();
    const auto disk = Disk::make(centre, 3.0 * frame[2], size);
    const double r = random.below(2) ? random.uniform(0, 1.5) : 1 + std::pow(10.0, random.uniform(-6, -1)) * (random.below(2) ? 1 : -1);
    const double angle = random.uniform(0, 6.28);
    const dvec3 target = centre + size * r * (std::cos(angle) * frame[0] + std::sin(angle) * frame[1]);
    const dvec3 d = random.direction();
    const double cosine = std::abs(glm::dot(d, frame[2])), bound = 16 * unit_roundoff * (far + size + glm::length(centre)) / cosine;
    if (std::abs(r - 1) * size <= bound) { continue; }
    const Spans found = spans_of(disk, between(target - far * d, target));
    REQUIRE(found.size() == (r < 1 ? 1u : 0u));
    if (r < 1) { CHECK(std::abs(found[0].in.t - 1.0) * far <= bound); }
    met += r < 1;
  }
  CHECK(met > 5000);
  brep::Builder builder;
  Disk::make({1, 2, 3}, {1, 1, 1}, 2)->approximate(0.1, builder);
  Corners corners;
  for (const std::uint32_t v : builder.corners(0)) { corners.push_back(builder.position(v)); }
  CHECK(glm::length(brep::vector_area(brep::Polygon(corners))) == test::Approx(4 * 3.14159265358979).epsilon(1e-13));
}
