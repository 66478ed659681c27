// SPDX-License-Identifier: MIT
// Owners of segments that are concave, share a place, or stand on each other: what counts as a shadow is what an oracle finds by sampling.

#include "primitives.hpp"

#include <brep/builder_input.hpp>

using namespace raycast;
using namespace test;

namespace {

// The least implicit value strictly between two surface points, by samples: the ends themselves lie on the surface.
Real least_between(const Primitive& primitive, const dvec3& a, const dvec3& b, int samples = 250) {
  Real least = 1;
  for (int k = 1; k < samples; ++k) {
    const Real t = static_cast<Real>(k) / samples;
    least = std::min(least, primitive.implicit((1 - t) * real(a) + t * real(b)));
  }
  return least;
}
Real greatest_between(const Primitive& primitive, const dvec3& a, const dvec3& b, int samples = 250) {
  Primitive negative = primitive;
  negative.implicit = [&](const Point& p) { return -primitive.implicit(p); };
  return -least_between(negative, a, b, samples);
}

// Calls visit(point, sheet) for the middles of the faces of an approximation.
template <class Visit>
void for_each_chord(const Object& object, double tolerance, Visit&& visit) {
  brep::Builder builder;
  object.approximate(tolerance, builder);
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    Corners corners;
    for (const std::uint32_t v : builder.corners(f)) { corners.push_back(builder.position(v)); }
    visit(brep::centroid(corners), brep::normal(corners), builder.sheet(f));
  }
}
struct Chord {
  dvec3 point{0.0}, normal{0.0};
  std::uint32_t sheet = 0;
};
std::vector<Chord> chords(const Object& object, double tolerance) {
  std::vector<Chord> result;
  for_each_chord(object, tolerance, [&](const dvec3& p, const dvec3& n, std::uint32_t sheet) { result.push_back({p, n, sheet}); });
  return result;
}

}  // namespace

TEST_CASE("a concave object lit by itself: occluded exactly when the segment passes through the solid") {
  SEEDED(random);
  for (const Primitive& primitive : primitives()) {
    const auto object = primitive.make({0, 0, 0}, 1.0);
    REQUIRE(object);
    if (object->convex()) { continue; }
    for (const bool inside : {false, true}) {
      const Scene scene({placed(object, inside ? room() : Placement{})});
      int free = 0, blocked = 0, facing = 0;
      for (int i = 0; i < 4000 && facing < 150; ++i) {
        const SurfacePoint a = object->project(0, random.in_cube(1.2)), b = object->project(0, random.in_cube(1.2));
        const double side = inside ? -1.0 : 1.0;
        const dvec3 d = b.position - a.position;
        if (side * glm::dot(a.normal, d) <= 1e-3 || side * glm::dot(b.normal, -d) <= 1e-3) { continue; }
        // At a cusp the normal is only the mean of two: the first thousandth of the way must really be air at both ends.
        const auto solid_at = [&](Real t) { return side * primitive.implicit((1 - t) * real(a.position) + t * real(b.position)) < 0; };
        if (solid_at(0.001L) || solid_at(0.999L)) { continue; }
        ++facing;
        const bool occluded = scene.occluded(between(a.position, b.position), 0, 0);
        REQUIRE(occluded == scene.occluded(between(b.position, a.position), 0, 0));
        const auto depth = [&](int samples) {
          return inside ? -greatest_between(primitive, a.position, b.position, samples)
                        : least_between(primitive, a.position, b.position, samples);
        };
        const Real deepest = depth(250);
        INFO(primitive.name << (inside ? " room" : "") << " deepest " << static_cast<double>(deepest));
        if (deepest < -1e-9L) {
          CHECK(occluded);
          ++blocked;
        } else if (!occluded) {
          ++free;
        } else if (!primitive.pinched) {  // blades are finer than any sampling
          CHECK(depth(20000) < 1e-7L);
        }
      }
      INFO(primitive.name << (inside ? " room" : ""));
      CHECK(free + blocked > 0);
    }
  }
}

TEST_CASE("chord patches of a torus see each other as the true surface does, the better the finer they are") {
  SEEDED(random);
  const Primitive torus = primitives()[6];
  REQUIRE(torus.name == "torus");
  const auto object = torus.make({0, 0, 0}, 1.0);
  for (const bool inside : {false, true}) {
    const Scene scene({placed(object, inside ? room() : Placement{})});
    double before = 1.0;
    for (const double tolerance : {0.02, 0.002}) {
      const std::vector<Chord> patches = chords(*object, tolerance);
      int facing = 0, wrong = 0;
      for (int i = 0; i < 200000 && facing < 3000; ++i) {
        const Chord &p = patches[random.below(static_cast<std::uint32_t>(patches.size()))],
                    &q = patches[random.below(static_cast<std::uint32_t>(patches.size()))];
        const double side = inside ? -1.0 : 1.0;
        const dvec3 d = q.point - p.point;
        if (side * glm::dot(p.normal, d) <= 0.1 * glm::length(d) || side * glm::dot(q.normal, -d) <= 0.1 * glm::length(d)) { continue; }
        ++facing;
        const dvec3 a = object->project(0, p.point).position, b = object->project(0, q.point).position;
        const bool hidden = inside ? greatest_between(torus, a, b) > 1e-6L : least_between(torus, a, b) < -1e-6L;
        wrong += hidden != scene.occluded(between(p.point, q.point), 0, 0);
      }
      REQUIRE(facing == 3000);
      const double share = static_cast<double>(wrong) / facing;
      INFO("tolerance " << tolerance << " inside " << inside << " wrong " << share);
      CHECK(share < 0.5 * before);  // it falls with the chord error
      before = std::max(share, 0.01);
    }
    CHECK(before <= 0.02);
  }
}

TEST_CASE("of two equal objects in one place, and of two that nearly coincide, the exposed chord patches see out") {
  SEEDED(random);
  for (const Primitive& primitive : primitives()) {
    const auto object = primitive.make({0, 0, 0}, 1.0);
    if (!object->convex()) { continue; }
    for (const double gap : {0.0, 1e-3}) {
      const Scene scene({placed(object), placed(object, {glm::dmat3(1.0), {0, 0, gap}, false}), placed(Sphere::make({0, 0, 4}, 0.5))});
      int seen = 0;
      for (const Chord& chord : chords(*object, 0.02)) {
        const SurfacePoint surface = scene.object(1).project(chord.sheet, chord.point + dvec3(0, 0, gap));
        if (scene.covered(surface.position, surface.normal, 1)) { continue; }
        for (int i = 0; i < 16; ++i) {
          const dvec3 p = chord.point + dvec3(0, 0, gap), q = dvec3(0, 0, 4) + 0.5 * random.direction();
          if (glm::dot(chord.normal, q - p) <= 0.1 * glm::length(q - p) || glm::dot(q - dvec3(0, 0, 4), p - q) <= 0.0) { continue; }
          INFO(primitive.name << " gap " << gap);
          CHECK_FALSE(scene.occluded(between(p, q), 1, 2));
          CHECK_FALSE(scene.occluded(between(q, p), 2, 1));
          ++seen;
        }
      }
      INFO(primitive.name);
      CHECK(seen > 0);
    }
  }
}

TEST_CASE("an object sunk into the owner of an end hides nothing, what stands out of it does") {
  const Scene scene({placed(Sphere::make({0, 0, 0}, 1.0)), placed(Sphere::make({0, 0, 0.5}, 0.45)),
                     placed(BoxObject::make({0.3, -0.2, 0.5}, {0.5, 0.2, 1.5}))});
  const dvec3 chord{0.0, 0.0, 0.9};  // of the big sphere, inside both spheres
  CHECK_FALSE(scene.occluded(between(chord, {0, 0, 3}), 0));
  CHECK_FALSE(scene.occluded(between({0, 0, 3}, chord), no_object, 0));
  CHECK(scene.occluded(between(chord, {2, 0, 1.4}), 0));  // the box stands out
  CHECK(scene.occluded(between({2, 0, 1.4}, chord), no_object, 0));
  CHECK(scene.occluded(between(chord, {0, 0, 3}), 2));  // for another owner they are in the way
}

TEST_CASE("the paper's figure: a superquadric on a cylinder shadows itself and the top it stands on") {
  SEEDED(random);
  // A pinched superquadric whose four blades stand on the cylinder's top.
  const Primitive figure = superquadric("figure", {1, 1, 1}, 1, 3);
  const auto solid = figure.make({0, 0, 1}, 1.0);
  REQUIRE(solid);
  const Scene scene({placed(Cylinder::make({0, 0, -2}, {0, 0, 2}, 1.5)), placed(solid)});
  const auto hidden = [&](const dvec3& a, const dvec3& b) { return least_between(figure, a - dvec3(0, 0, 1), b - dvec3(0, 0, 1)); };
  // Where a ray from the middle comes out: most points of a cube are nearest to the edge of a blade.
  const auto on_surface = [&] {
    Spans spans;
    const Segment ray{{0, 0, 1}, random.direction()};
    solid->spans(ray, spans);
    return solid->project(0, ray.at(spans[spans.size() - 1].out.t));
  };
  int self = 0, onto_top = 0, free = 0;
  for (int i = 0; i < 4000; ++i) {
    const SurfacePoint a = on_surface();
    if (i % 2) {  // with a lamp above: valleys do not see each other, but a blade stands between them and the lamp
      const dvec3 lamp{random.uniform(-3, 3), random.uniform(-3, 3), 3.0};
      if (glm::dot(a.normal, lamp - a.position) <= 1e-2) { continue; }
      const bool occluded = scene.occluded(between(a.position, lamp), 1);
      REQUIRE(occluded == scene.occluded(between(lamp, a.position), no_object, 1));
      if (hidden(a.position, lamp) < -1e-9L) {
        CHECK(occluded);
        ++self;
      }
      if (!occluded) {
        CHECK(hidden(a.position, lamp) >= -1e-9L);
        ++free;
      }
    } else {  // with the top of the cylinder
      const dvec3 b{random.uniform(-1, 1), random.uniform(-1, 1), 0.0};
      if (glm::dot(a.normal, b - a.position) <= 1e-2) { continue; }
      const bool occluded = scene.occluded(between(a.position, b), 1, 0);
      if (hidden(a.position, b) < -1e-9L) {
        CHECK(occluded);
        ++onto_top;
      }
      if (!occluded) {
        CHECK(hidden(a.position, b) >= -1e-9L);
        ++free;
      }
    }
  }
  CHECK(self > 30);
  CHECK(onto_top > 10);
  CHECK(free > 500);
}
