// SPDX-License-Identifier: MIT
// A ray caster of the user's in a bake: its answers are the visibility, and one that knows the same triangles gives the same light.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/bake/bake.hpp>
#include <radiosity/bake/own_rays.hpp>
#include <radiosity/radiosity.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"

namespace {

// Asks every triangle in turn (Möller and Trumbore 1997), in the given number type; it counts what it is asked.
template <class Number>
struct EveryTriangle {
  using V = glm::tvec3<Number>;
  std::vector<std::array<V, 3>> triangles;
  bool blind = false;
  mutable std::atomic<std::size_t> segments{0}, rays{0};

  explicit EveryTriangle(const soup::Soup& soup) {
    for (std::size_t f = 0; f < soup.count(); ++f) {
      const auto p = soup.outline(f);
      triangles.push_back({V(p[0]), V(p[1]), V(p[2])});
    }
  }

  std::optional<Number> meets(const std::array<V, 3>& p, const radiosity::CasterRay& ray) const {
    const V d(ray.direction), u = p[1] - p[0], v = p[2] - p[0], across = glm::cross(d, v), from = V(ray.origin) - p[0];
    const Number det = glm::dot(u, across), a = glm::dot(from, across) / det;
    const V q = glm::cross(from, u);
    const Number b = glm::dot(d, q) / det, t = glm::dot(v, q) / det;
    if (!(a >= 0 && b >= 0 && a + b <= 1 && t > Number(ray.near) && t < Number(ray.far))) { return std::nullopt; }
    return t;
  }
  std::uint32_t blocked16(const radiosity::RayPacket& packet) const {
    std::uint32_t result = 0;
    for (unsigned i = 0; i < 16; ++i) {
      if ((packet.lanes >> i & 1U) == 0) { continue; }
      ++segments;
      const radiosity::CasterRay ray = packet.at(i);
      const auto met = [&](const auto& p) { return meets(p, ray).has_value(); };
      result |= static_cast<std::uint32_t>(!blind && std::any_of(triangles.begin(), triangles.end(), met)) << i;
    }
    return result;
  }
  std::optional<radiosity::TriangleHit> closest(radiosity::CasterRay ray) const {
    ++rays;
    std::optional<radiosity::TriangleHit> best;
    for (std::size_t f = 0; f < triangles.size() && !blind; ++f) {
      if (const auto t = meets(triangles[f], ray)) {
        best = {static_cast<double>(*t), static_cast<std::uint32_t>(f)};
        ray.far = best->t;
      }
    }
    return best;
  }
};
static_assert(radiosity::RayCaster<EveryTriangle<float>>);

// A room with boxes at random, some upon others, a sheet with two sides, and a lamp that lies on the ceiling; some triangles twice. In
// feet, far from the origin.
soup::Soup furnished(unsigned seed, double far = 0.0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  soup::Soup soup;
  soup.materials = {
      {"grey", glm::dvec3(0.6), glm::dvec3(0.0)}, {"lamp", glm::dvec3(0.2), glm::dvec3(10.0)}, {"cloth", {0.7, 0.3, 0.1}, {}}};
  soup.two_sided = {0, 0, 1};
  soup::add_box(soup, {0, 0, 0}, {4, 3, 2.5}, 2, true);
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 lo{0.2 + 3.0 * unit(random), 0.2 + 2.0 * unit(random), i % 2 == 0 ? 0.0 : 0.2 + unit(random)};
    soup::add_box(soup, lo, lo + glm::dvec3(0.2 + 0.4 * unit(random), 0.2 + 0.4 * unit(random), 0.2 + unit(random)), 1);
  }
  soup.polygon({{3, 0.5, 0.5}, {3.5, 2.5, 0.5}, {3.2, 2.5, 1.5}}, 2);
  soup.polygon({{1.5, 1, 2.5}, {1.5, 2, 2.5}, {2.5, 2, 2.5}}, 1);
  soup.polygon({{1.5, 1, 2.5}, {2.5, 2, 2.5}, {2.5, 1, 2.5}}, 1);
  const std::size_t count = soup.count();
  for (std::size_t f = 0; f < count; f += 5) { soup.polygon(soup.outline(f), soup.material[f]); }
  for (glm::dvec3& p : soup.positions) { p = 3.28 * p + far; }
  return soup;
}

radiosity::BakeOptions coarse_bake(radiosity::Indirect indirect) {
  radiosity::BakeOptions options;
  options.solve.epsilon = 0.05;
  options.solve.min_area = 2e-3;
  options.solve.audit_points = 100;
  options.solve.threads = 1;
  options.solve.indirect = indirect;
  return options;
}

// Relative L2 of the corner colours.
double apart(const radiosity::BakeOutcome& a, const radiosity::BakeOutcome& b) {
  double sum = 0.0, all = 0.0;
  for (std::size_t c = 0; c < a.baked->colors.corner.size(); ++c) {
    const glm::dvec3 d = a.baked->colors.corner[c] - b.baked->colors.corner[c];
    sum += glm::dot(d, d);
    all += glm::dot(a.baked->colors.corner[c], a.baked->colors.corner[c]);
  }
  return std::sqrt(sum / all);
}

}  // namespace

// Answers differ for rays that pass within a skin of an edge. A skin is 1e-5 of the room at most, rays pass some tens of edges: at most one
// in a thousand differs, in either direction. Of N rays to a corner's light each weighs 1/N: off by 1e-3, and less for the means over many.
TEST_CASE("own rays: a caster of the same triangles gives the same light and the same audit") {
  for (const unsigned seed : {1U, 2U}) {
    for (const auto indirect : {radiosity::Indirect::links, radiosity::Indirect::rays}) {
      INFO("seed " << seed << ", " << name(indirect));
      const soup::Soup soup = furnished(seed, seed == 1 ? 0.0 : 30.0);
      radiosity::BakeOptions options = coarse_bake(indirect);
      const radiosity::BakeOutcome ours = radiosity::bake(soup.view(), soup.materials, options);
      const EveryTriangle<float> caster{soup};
      options.rays = caster;
      const radiosity::BakeOutcome own = radiosity::bake(soup.view(), soup.materials, options);
      REQUIRE(ours.baked);
      REQUIRE(own.baked);
      CHECK(caster.segments > 1000);
      CHECK(caster.rays > 1000);  // of the audit, at least
      CHECK(own.baked->audit.leaves == ours.baked->audit.leaves);
      CHECK(apart(ours, own) < 1e-3);
      CHECK(own.baked->audit.surface_error->relative_l2 == test::Approx(ours.baked->audit.surface_error->relative_l2).margin(1e-3));
    }
  }
}

TEST_CASE("own rays: what the caster says is the visibility", "[accuracy]") {
  for (const auto indirect : {radiosity::Indirect::links, radiosity::Indirect::rays}) {
    double sum = 0.0;
    constexpr unsigned rooms = 6;
    for (unsigned seed = 1; seed <= rooms; ++seed) {
      const soup::Soup soup = furnished(seed);
      radiosity::BakeOptions options = coarse_bake(indirect);
      const radiosity::BakeOutcome ours = radiosity::bake(soup.view(), soup.materials, options);
      EveryTriangle<double> caster{soup};
      caster.blind = true;
      options.rays = caster;
      const radiosity::BakeOutcome blind = radiosity::bake(soup.view(), soup.materials, options);
      REQUIRE(ours.baked);
      REQUIRE(blind.baked);
      sum += apart(ours, blind);
      CHECK(apart(ours, blind) > 0.01);  // in each room; the same triangles asked by another caster give less than a tenth of that
      CHECK(blind.baked->audit.leaves < 4 * ours.baked->audit.leaves);  // light that no ray finds is no reason to look for it without end
    }
    CHECK(sum / rooms > 0.02);
  }
}

TEST_CASE("own rays: results do not depend on the number of threads") {
  const soup::Soup soup = furnished(4);
  const EveryTriangle<float> caster{soup};
  radiosity::BakeOptions options = coarse_bake(radiosity::Indirect::rays);
  options.rays = caster;
  const radiosity::BakeOutcome one = radiosity::bake(soup.view(), soup.materials, options);
  options.solve.threads = 3;
  const radiosity::BakeOutcome three = radiosity::bake(soup.view(), soup.materials, options);
  REQUIRE(one.baked);
  REQUIRE(three.baked);
  CHECK(one.baked->colors.corner == three.baked->colors.corner);
}
