// SPDX-License-Identifier: MIT
// Each object alone: what its spans, project and factory must keep at every scale and place.

#include "support.hpp"

#include <limits>
#include <string>

using namespace raycast;
using namespace test;

namespace {

// Distance of p from the boundary of the solid box, cylinder, sphere, positive outside.
double sphere_distance(const Sphere& s, const dvec3& p) { return glm::length(p - s.centre()) - s.radius(); }
double box_distance(const Box& b, const dvec3& p) {
  double d = -infinity;
  for (int k = 0; k < 3; ++k) { d = std::max({d, b.lo[k] - p[k], p[k] - b.hi[k]}); }
  return d;
}
double cylinder_distance(const dvec3& base, const dvec3& axis, double r, const dvec3& p) {
  const double h = glm::length(axis), z = glm::dot(p - base, axis / h);
  return std::max({-z, z - h, glm::length(glm::cross(p - base, axis / h)) - r});
}

template <class Distance>
void crossings_lie_on(const Object& object, const Segment& line, double bound, Distance&& distance) {
  Spans found;
  object.spans(line, found);
  for (const Span& s : found) {
    CHECK(s.in.t <= s.out.t);
    CHECK(std::abs(distance(line.at(s.in.t))) <= bound);
    CHECK(std::abs(distance(line.at(s.out.t))) <= bound);
    CHECK(distance(line.at(0.5 * (s.in.t + s.out.t))) <= bound);
    const SurfacePoint in = object.project(s.in.sheet, line.at(s.in.t)), out = object.project(s.out.sheet, line.at(s.out.t));
    CHECK(glm::length(in.position - line.at(s.in.t)) <= bound);  // the sheet is the right one
    CHECK(glm::dot(in.normal, line.direction) <= 1e-6 * glm::length(line.direction));
    CHECK(glm::dot(out.normal, line.direction) >= -1e-6 * glm::length(line.direction));
  }
}

}  // namespace

TEST_CASE("crossings lie on the surface, over scales and distances of 10^+-8") {
  SEEDED(random);
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = random.magnitude(8), far = size * std::pow(10.0, random.uniform(0, 4));
    const dvec3 centre = random.in_cube(size * std::pow(10.0, random.uniform(-2, 2)));
    const dvec3 target = centre + random.in_cube(0.8 * size), origin = target + far * random.direction();
    const Segment line{origin, random.uniform(0.5, 2.0) * (target - origin)};
    // Positions have an error of u times the coordinates; the crossing 32 u D (sphere.hpp), and the oracle as much again.
    // Rays that graze within 1e-3 of the rim amplify it to about 340 u D.
    const double bound = 400 * u * (far + size + glm::length(centre));
    const auto sphere = Sphere::make(centre, size);
    REQUIRE(sphere);
    crossings_lie_on(*sphere, line, bound, [&](const dvec3& p) { return sphere_distance(*sphere, p); });
    const auto box = BoxObject::make(centre - size * dvec3(1, 0.5, 0.25), centre + size * dvec3(1, 0.5, 0.25));
    crossings_lie_on(*box, line, bound, [&](const dvec3& p) { return box_distance(box->bounds(), p); });
    const dvec3 axis = size * random.uniform(0.1, 10) * random.direction();
    const auto cylinder = Cylinder::make(centre, axis, size);
    crossings_lie_on(*cylinder, line, bound + 400 * u * glm::length(axis),
                     [&](const dvec3& p) { return cylinder_distance(centre, axis, size, p); });
    met += static_cast<int>(spans(placed(sphere), line).size());
  }
  CHECK(met > 10000);
}

TEST_CASE("a crossing lies within the bounds, and a line that misses the bounds has none") {
  SEEDED(random);
  for (int i = 0; i < 3000; ++i) {
    const Placement placement{random.rotation() * glm::dmat3(random.uniform(0.1, 3), 0.2, 0, 0, random.uniform(0.1, 3), 0, 0.1, 0, 1),
                              random.in_cube(5), false};
    const PlacedObject objects[] = {placed(Sphere::make(random.in_cube(), 0.7), placement),
                                    placed(BoxObject::make({0, 0, 0}, {1, 2, 3}), placement),
                                    placed(Cylinder::make({1, 0, 0}, random.direction(), 0.3), placement), placed(l_block(), placement)};
    for (const PlacedObject& object : objects) {
      const Segment line{random.in_cube(8), random.direction()};
      double entry = 0.0;
      const Spans found = spans(object, line);
      for (const Span& s : found) {
        CHECK(object.bounds().contains(line.at(s.in.t), 1e-13));
        CHECK(object.bounds().contains(line.at(s.out.t), 1e-13));
      }
      if (!SlabTest(line)(object.bounds(), -infinity, infinity, entry)) { CHECK(found.empty()); }
    }
  }
}

TEST_CASE("a sphere is met exactly when the line passes nearer than its radius: oracle in long double") {
  SEEDED(random);
  int undecided = 0;
  for (int i = 0; i < 200000; ++i) {
    const double distance = std::pow(10.0, random.uniform(0.1, 6));
    const dvec3 toward = random.direction(), across = glm::normalize(glm::cross(toward, random.direction()));
    const double impact = 1.0 + std::pow(10.0, random.uniform(-12, -1)) * (random.below(2) ? 1 : -1);  // grazing
    const dvec3 origin = -distance * toward;
    const Segment line{origin, impact * across - origin};
    using Long = long double;
    Long o[3], d[3], dd = 0, od = 0, perpendicular = 0;
    for (int k = 0; k < 3; ++k) { o[k] = origin[k], d[k] = line.direction[k]; }
    for (int k = 0; k < 3; ++k) { dd += d[k] * d[k], od += o[k] * d[k]; }
    for (int k = 0; k < 3; ++k) {
      const Long l = o[k] - od / dd * d[k];
      perpendicular += l * l;
    }
    const Long gap = 1 - std::sqrt(perpendicular);
    if (std::abs(gap) < static_cast<Long>(8 * u * distance)) {
      ++undecided;
      continue;
    }
    const Spans found = spans(placed(Sphere::make(dvec3(0), 1.0)), line);
    REQUIRE((gap > 0) == !found.empty());
    if (gap <= 0) { continue; }
    const Long half = std::sqrt((1 - perpendicular) / dd), in = -od / dd - half;
    // |dt| |d| <= 32 u D r / sqrt(disc): the rim amplifies.
    const Long bound = 32 * static_cast<Long>(u * distance) / std::sqrt(1 - perpendicular) + 8 * u * distance;
    CHECK(std::abs(found[0].in.t - in) * std::sqrt(dd) <= bound);
  }
  CHECK(undecided < 60000);
}

TEST_CASE("a box is met where its six polygons are") {
  SEEDED(random);
  const dvec3 lo{-1, -2, 0.5}, hi{2, 0.25, 1.5};
  const PlacedObject box = placed(BoxObject::make(lo, hi));
  std::vector<PlacedObject> faces;
  for (const Corners& face : faces_of(lo, hi)) { faces.push_back(placed(Polygon::make(face))); }
  const auto mesh = mesh_of(box.object(), 0.0);
  REQUIRE(mesh->solid());
  REQUIRE(mesh->convex());
  for (int i = 0; i < 50000; ++i) {
    const Segment line{random.in_cube(4), random.direction()};
    const Spans of_box = spans(box, line), of_mesh = spans(placed(mesh), line);
    std::vector<std::pair<double, std::uint32_t>> crossings;
    for (std::uint32_t f = 0; f < 6; ++f) {
      for (const Span& s : spans(faces[f], line)) { crossings.push_back({s.in.t, f}); }
    }
    std::sort(crossings.begin(), crossings.end());
    REQUIRE(crossings.size() == 2 * of_box.size());
    REQUIRE(of_mesh.size() == of_box.size());
    if (of_box.empty()) { continue; }
    // t is at most 10, positions at most 4; dividing by the cosine of the steepest accepted angle is inside the margin.
    CHECK(of_box[0].in.t == test::Approx(crossings[0].first).margin(1e-11));
    CHECK(of_box[0].out.t == test::Approx(crossings[1].first).margin(1e-11));
    CHECK(of_mesh[0].in.t == test::Approx(crossings[0].first).margin(1e-11));
    CHECK(of_box[0].in.sheet == crossings[0].second);
    CHECK(of_box[0].out.sheet == crossings[1].second);
  }
}

TEST_CASE("entries and exits of a concave mesh alternate, and the line is inside between them") {
  SEEDED(random);
  const PlacedObject block = placed(l_block());
  REQUIRE(block.solid());
  REQUIRE_FALSE(block.convex());
  const auto inside = [](const dvec3& p) { return p.y > 0 && p.y < 1 && p.x > 0 && p.x < 2 && p.z > 0 && p.z < (p.x < 1 ? 1 : 2); };
  int twice = 0;
  for (int i = 0; i < 50000; ++i) {
    const Segment line{random.in_cube(3) + dvec3(1, 0.5, 1), random.direction()};
    const Spans found = spans(block, line);
    double before = -infinity;
    for (const Span& s : found) {
      CHECK(s.in.t > before);
      CHECK(s.out.t > s.in.t);
      if (s.out.t - s.in.t > 1e-9) { CHECK(inside(line.at(0.5 * (s.in.t + s.out.t)))); }
      if (std::isfinite(before) && s.in.t - before > 1e-9) { CHECK_FALSE(inside(line.at(0.5 * (before + s.in.t)))); }
      before = s.out.t;
    }
    twice += found.size() == 2;
  }
  CHECK(twice > 100);
}

TEST_CASE("spans of a placed object: an affine map changes no parameter") {
  SEEDED(random);
  for (int i = 0; i < 20000; ++i) {
    glm::dmat3 linear = random.rotation() *
                        glm::dmat3(random.uniform(0.1, 4), 0, 0, 0, random.uniform(0.1, 4), 0, 0, 0, random.uniform(0.1, 4)) *
                        random.rotation();
    if (i % 2) linear[0] = -linear[0];  // a mirror
    const Placement placement{linear, random.in_cube(10), i % 3 == 0};
    const Made<Object> shapes[] = {Sphere::make(random.in_cube(), 0.5), BoxObject::make({0, 0, 0}, {1, 1, 1}),
                                   Cylinder::make({0, 0, 0}, {0, 1, 2}, 0.5), l_block()};
    for (const auto& shape : shapes) {
      const Segment line{random.in_cube(3), 4.0 * random.direction()};
      const Segment image{linear * line.origin + placement.translation, linear * line.direction};
      Placement plain;
      plain.inside = placement.inside;
      const Spans a = spans(placed(shape, plain), line), b = spans(placed(shape, placement), image);
      // The condition number of the map is at most 40: rounding of 1e-15 grows to 1e-12, the rim of curved shapes takes its root.
      if (a.size() != b.size()) {
        CHECK((a.size() && b.size() ? 0.0 : (a.empty() ? b[0].out.t - b[0].in.t : a[0].out.t - a[0].in.t)) < 1e-5);
        continue;
      }
      for (std::size_t k = 0; k < a.size(); ++k) {
        if (std::isfinite(a[k].in.t)) { CHECK(a[k].in.t == test::Approx(b[k].in.t).margin(1e-9)); }
        if (std::isfinite(a[k].out.t)) { CHECK(a[k].out.t == test::Approx(b[k].out.t).margin(1e-9)); }
      }
    }
  }
}

TEST_CASE("project is idempotent, its normal a unit vector, and nearest") {
  SEEDED(random);
  for (int i = 0; i < 3000; ++i) {
    const double size = random.magnitude(6);
    const bool inside = i % 2;
    const Placement placement{random.rotation() * size, size * random.in_cube(3), inside};
    const Made<Object> shapes[] = {Sphere::make(random.in_cube(), 0.5), BoxObject::make({0, 0, 0}, {1, 1, 1}),
                                   Cylinder::make({0, 0, 0}, {0, 1, 2}, 0.5), l_block()};
    for (const auto& shape : shapes) {
      const PlacedObject object = placed(shape, placement);
      for (std::uint32_t sheet = 0; sheet < object.sheet_count(); ++sheet) {
        const dvec3 p = placement.linear * random.in_cube(2) + placement.translation;
        const SurfacePoint once = object.project(sheet, p), twice = object.project(sheet, once.position);
        CHECK(glm::length(once.normal) == test::Approx(1.0).epsilon(1e-14));
        CHECK(glm::length(twice.position - once.position) <= 1e-13 * size);
        CHECK(glm::length(twice.normal - once.normal) <= 1e-12);
        // That of the object alone, mapped.
        const dvec3 local = glm::inverse(placement.linear) * (p - placement.translation);
        const dvec3 mapped = glm::normalize(glm::transpose(glm::inverse(placement.linear)) * shape->project(sheet, local).normal);
        CHECK(glm::length(once.normal - (inside ? -mapped : mapped)) <= 1e-12);
        CHECK(glm::length(object.normal(sheet, p) - (inside ? -mapped : mapped)) <= 1e-12);
        // Nearest: the way to the point runs along the normal.
        CHECK(glm::length(glm::cross(p - once.position, once.normal)) <= 1e-12 * size);
      }
    }
  }
}

TEST_CASE("axis-parallel lines, zeros of both signs and denormal components") {
  const double zeros[] = {0.0, -0.0, 1e-310, -1e-310, std::numeric_limits<double>::denorm_min()};
  const PlacedObject objects[] = {placed(Sphere::make({0, 0, 0}, 1.0)), placed(BoxObject::make({-1, -1, -1}, {1, 1, 1})),
                                  placed(Cylinder::make({0, 0, -1}, {0, 0, 2}, 1.0)),
                                  placed(mesh_of(*BoxObject::make({-1, -1, -1}, {1, 1, 1}), 0.0))};
  for (const PlacedObject& object : objects) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        for (const double a : zeros) {
          for (const double b : zeros) {
            dvec3 d{0}, o{0};
            d[axis] = sign;
            d[(axis + 1) % 3] = a;
            d[(axis + 2) % 3] = b;
            o[axis] = -3 * sign;
            o[(axis + 1) % 3] = 0.25;
            const Spans through = spans(object, Segment{o, d});
            REQUIRE(through.size() == 1);
            CHECK(through[0].in.t < through[0].out.t);
            CHECK(through[0].in.t > 1.9);
            CHECK(through[0].out.t < 4.1);
            o[(axis + 1) % 3] = 1.5;  // beside it
            CHECK(spans(object, Segment{o, d}).empty());
            double entry = 0.0;
            for (const double on : {1.0, -1.0}) {  // in a plane of the bounds: never a false miss
              o[(axis + 1) % 3] = on;
              CHECK(SlabTest(Segment{o, d})(object.bounds(), 0.0, 10.0, entry));
            }
          }
        }
      }
    }
  }
}

TEST_CASE("polygons of every simple shape: a line meets them where the crossing number is odd") {
  SEEDED(random);
  std::vector<std::vector<std::array<double, 2>>> outlines{{{0, 0}, {1, 0}, {0, 1}},
                                                           {{0, 0}, {2, 0}, {2, 1}, {0, 1}},
                                                           {{0, 0}, {1, 0}, {2, 0}, {2, 0.5}, {2, 1}, {0, 1}},  // straight corners
                                                           {{0, 0}, {2, 0}, {2, 2}, {1, 0.5}},                  // concave
                                                           {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}};  // a U
  outlines.emplace_back();
  for (int i = 0; i < 14; ++i) {  // a star
    const double r = i % 2 ? 0.3 : 1.0, a = 3.14159265358979 * i / 7;
    outlines.back().push_back({r * std::cos(a), r * std::sin(a)});
  }
  for (const auto& outline : outlines) {
    const glm::dmat3 frame = random.rotation();
    const dvec3 origin = random.in_cube(3);
    Corners corners;
    for (const auto& p : outline) { corners.push_back(origin + p[0] * frame[0] + p[1] * frame[1]); }
    const auto polygon = Polygon::make(corners);
    INFO(polygon.refusal);
    REQUIRE(polygon);
    CHECK(glm::dot(polygon->project(0, origin).normal, frame[2]) > 0.999);
    for (int i = 0; i < 20000; ++i) {
      const double x = random.uniform(-1.2, 3.2), y = random.uniform(-1.2, 3.2);
      bool odd = false;
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const auto &a = outline[k], &b = outline[(k + 1) % outline.size()];
        if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) { odd = !odd; }
      }
      const dvec3 target = origin + x * frame[0] + y * frame[1], from = target + 5.0 * random.direction();
      const Spans found = spans(placed(polygon), between(from, target));
      REQUIRE(found.size() == (odd ? 1u : 0u));
      if (odd) {
        CHECK(found[0].in.t == found[0].out.t);
        CHECK(std::abs(found[0].in.t - 1.0) * std::abs(glm::dot(target - from, frame[2])) < 1e-14 * 20);
      }
    }
  }
}
