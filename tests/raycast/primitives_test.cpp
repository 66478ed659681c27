// SPDX-License-Identifier: MIT
// Every primitive against its implicit function in long double: crossings, hit or miss, what lies between; over 16 decades of size.

#include "primitives.hpp"

using namespace raycast;
using namespace test;

namespace {

// A primitive somewhere, and its oracle along lines of the world.
struct Subject {
  const Primitive& primitive;
  dvec3 centre;
  double size;
  Made<Object> object;

  Subject(const Primitive& p, const dvec3& at, double scale) : primitive(p), centre(at), size(scale), object(p.make(at, scale)) {
    INFO(p.name << ": " << object.refusal);
    REQUIRE(object);
  }
  [[nodiscard]] Real implicit(const Segment& line, Real t) const { return primitive.implicit(point_at(line, t, centre, size)); }
  [[nodiscard]] Spans spans(const Segment& line) const {
    Spans result;
    object->spans(line, result);
    return result;
  }
};

}  // namespace

TEST_CASE("every primitive: crossings lie on the surface and on their sheet, over sizes 10^+-8 and distances to 10^8 sizes") {
  SEEDED(random);
  for (const Primitive& primitive : primitives()) {
    int met = 0;
    for (int i = 0; i < 4000; ++i) {
      const double size = random.magnitude(8), far = size * std::pow(10.0, random.uniform(0, i % 4 ? 4 : 8));
      const Subject subject(primitive, random.in_cube(size * std::pow(10.0, random.uniform(-2, 2))), size);
      dvec3 target = subject.centre + random.in_cube(0.6 * size);
      if (i % 2) { target = subject.object->project(random.below(subject.object->sheet_count()), target).position; }
      const dvec3 origin = target + far * random.direction();
      const Segment line{origin, random.uniform(0.5, 2.0) * (target - origin)};
      const double length = glm::length(line.direction);
      // Positions are known to u times the coordinates, the crossing to 32 u (D + size) across the surface; the oracle's distance is
      // right up to `steepness`. Along the line this grows by 1 / cosine.
      const double bound = 64 * u * (far + size + glm::length(subject.centre));
      INFO(primitive.name << " size " << size << " far " << far << " line " << i);
      Spans found = subject.spans(line);
      for (const Span& span : found) {
        CHECK(span.in.t <= span.out.t);
        for (const Crossing& at : {span.in, span.out}) {
          REQUIRE(at.sheet < subject.object->sheet_count());
          const SurfacePoint on = subject.object->project(at.sheet, line.at(at.t));
          CHECK(glm::length(on.normal) == test::Approx(1.0).epsilon(1e-12));
          if (!primitive.pinched) {
            CHECK(std::abs(static_cast<double>(subject.implicit(line, at.t))) * size <= primitive.steepness * bound);
            CHECK(glm::length(on.position - line.at(at.t)) <= primitive.steepness * bound);
          } else {
            // Blades and needles are as thin as they like, so the distance says nothing: the sign changes nearby, or it is a blade.
            const Real step = 4 * bound / length;
            const Point p = point_at(line, at.t, subject.centre, size);
            Real lowest = 1, highest = -1, thinnest = primitive.blade(p);
            for (int k = -20; k <= 20; ++k) {
              const Real value = subject.implicit(line, at.t + step * k);
              lowest = std::min(lowest, value);
              highest = std::max(highest, value);
            }
            CHECK(((lowest <= 0 && highest >= 0) || thinnest * size <= 16 * bound));
          }
        }
        if (!primitive.creased) {
          CHECK(glm::dot(subject.object->project(span.in.sheet, line.at(span.in.t)).normal, line.direction) <= 1e-5 * length);
          CHECK(glm::dot(subject.object->project(span.out.sheet, line.at(span.out.t)).normal, line.direction) >= -1e-5 * length);
        }
      }
      met += !found.empty();
    }
    INFO(primitive.name);
    CHECK(met > (primitive.pinched ? 10 : 100));
  }
}

TEST_CASE("every primitive: a point of a line is inside exactly when a span covers it") {
  SEEDED(random);
  for (const Primitive& primitive : primitives()) {
    const Subject subject(primitive, random.in_cube(3), 1.0);
    std::size_t several = 0, samples = 0;
    for (int i = 0; i < 500; ++i) {
      Segment line{subject.centre + 2.0 * random.direction(), {}};
      dvec3 target = subject.centre + random.in_cube(0.9);
      if (i % 4 == 0) target[static_cast<int>(random.below(3))] = 0.0;  // through a plane of symmetry, or along it
      if (i % 3 == 0) { target = subject.object->project(random.below(subject.object->sheet_count()), target).position; }
      line.direction = target - line.origin;
      if (i % 7 == 0) { line.direction[static_cast<int>(random.below(3))] = 0.0; }
      if (i % 11 == 0) { line.origin = subject.centre + 2.0 * random.direction(), line.direction = subject.centre - line.origin; }
      const Spans found = subject.spans(line);
      several += found.size() > 1;
      INFO(primitive.name << " line " << i << " spans " << found.size());
      double before = -infinity;
      for (const Span& span : found) {
        CHECK(span.in.t > before);
        before = span.out.t;
      }
      for (int k = 0; k < 200; ++k) {
        const double t = 3.0 * (k + random.uniform()) / 200;
        bool covered = false, near = false;
        for (const Span& span : found) {
          covered = covered || (span.in.t <= t && t <= span.out.t);
          near = near || std::abs(span.in.t - t) < 1e-9 || std::abs(span.out.t - t) < 1e-9;
        }
        const Real value = subject.implicit(line, t);
        if (near || std::abs(value) < 1e-12L) continue;  // positions are known to 1e-15; blades steepen it by their exponent
        ++samples;
        if (covered != (value < 0)) {
          // A needle or blade thinner than rounding: outside again within 1e-13 across.
          CHECK((primitive.pinched && primitive.blade(point_at(line, t, subject.centre, 1.0)) < 1e-13L));
        }
      }
    }
    INFO(primitive.name);
    CHECK(samples > 30000);
    if (primitive.name == "torus" || primitive.name.find("ring") != std::string::npos) { CHECK(several > 5); }
  }
}

TEST_CASE("every primitive: a grazing line meets it exactly when the implicit function says so") {
  SEEDED(random);
  for (const Primitive& primitive : primitives()) {
    if (primitive.pinched) continue;  // no tangent planes at their blades
    int hits = 0, misses = 0;
    for (int i = 0; i < 300; ++i) {
      const Subject subject(primitive, dvec3(0.0), 1.0);
      // A line along the surface, offset from it by 10^-13 .. 0.1, from up to 10^6 away.
      const dvec3 aim = subject.object->project(random.below(subject.object->sheet_count()), 0.7 * random.in_cube()).position;
      const Segment through = between(2.0 * random.direction(), aim);
      const Spans entry = subject.spans(through);
      if (entry.empty()) { continue; }
      const SurfacePoint at = subject.object->project(entry[0].in.sheet, through.at(entry[0].in.t));
      const dvec3 tangent = glm::normalize(glm::cross(at.normal, random.direction()));
      const double offset = std::pow(10.0, random.uniform(-13, -1)) * (random.below(2) ? 1 : -1);
      const double far = std::pow(10.0, random.uniform(0.5, 6));
      const dvec3 touch = at.position + offset * at.normal, origin = touch - far * tangent;
      const Segment line = between(origin, touch + tangent);
      // The least value of the implicit function along the line: the best of samples, refined by golden section.
      const Real from = (far - 2.5L) / (far + 1), to = (far + 2.5L) / (far + 1);
      constexpr int samples = 200;
      std::array<Real, samples> values{};
      for (int k = 0; k < samples; ++k) {
        values[static_cast<std::size_t>(k)] = subject.implicit(line, from + (to - from) * k / (samples - 1));
      }
      Real least = 1;
      for (std::size_t k = 1; k + 1 < samples; ++k) {
        if (values[k] > values[k - 1] || values[k] > values[k + 1]) { continue; }
        Real a = from + (to - from) * static_cast<Real>(k - 1) / (samples - 1),
             b = from + (to - from) * static_cast<Real>(k + 1) / (samples - 1);
        constexpr Real golden = 0.61803398874989484820L;
        Real c = b - golden * (b - a), d = a + golden * (b - a), fc = subject.implicit(line, c), fd = subject.implicit(line, d);
        for (int round = 0; round < 60; ++round) {
          if (fc < fd) {
            b = d, d = c, fd = fc, c = b - golden * (b - a), fc = subject.implicit(line, c);
          } else {
            a = c, c = d, fc = fd, d = a + golden * (b - a), fd = subject.implicit(line, d);
          }
        }
        least = std::min({least, fc, fd});
      }
      const double bound = primitive.steepness * 32 * u * (far + 1);
      if (std::abs(least) <= static_cast<Real>(bound)) { continue; }
      INFO(primitive.name << " line " << i << " offset " << offset << " far " << far << " least " << static_cast<double>(least));
      CHECK(subject.spans(line).empty() == (least > 0));
      ++(least > 0 ? misses : hits);
    }
    INFO(primitive.name);
    CHECK(hits > 20);
    if (primitive.name.find("ring") == std::string::npos) { CHECK(misses > 10); }
  }
}
