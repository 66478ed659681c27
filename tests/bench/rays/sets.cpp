// SPDX-License-Identifier: MIT
#include "sets.hpp"

#include <raycast/object.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/ray.hpp>
#include <raycast/transform.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>

namespace bench {
namespace {

using glm::dvec3;
using raycast::Segment;

constexpr int ray_count = 65536;

class Random {
 public:
  double uniform(double a = 0.0, double b = 1.0) { return a + (b - a) * std::ldexp(static_cast<double>(engine_() >> 11), -53); }
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(engine_() % n); }

 private:
  std::mt19937_64 engine_{7};
};

template <class T>
raycast::PlacedObject place(const raycast::Made<T>& made) {
  if (!made) { std::fprintf(stderr, "%s\n", made.refusal.c_str()), std::abort(); }
  return raycast::PlacedObject(made.object);
}

struct Quad {  // a parallelogram: patches are cut out of it
  dvec3 origin, a, b;
  std::uint32_t owner;
  [[nodiscard]] dvec3 normal() const { return glm::normalize(glm::cross(a, b)); }
};

void add(World& world, std::vector<Quad>& quads, const dvec3& origin, const dvec3& a, const dvec3& b) {
  quads.push_back({origin, a, b, static_cast<std::uint32_t>(world.objects.size())});
  world.triangles.push_back({origin, origin + a, origin + a + b});
  world.triangles.push_back({origin, origin + a + b, origin + b});
  world.objects.push_back(place(raycast::Polygon::make({origin, origin + a, origin + a + b, origin + b})));
}
// The inner walls of a cube [-h,h]^3.
void add_room(World& world, std::vector<Quad>& quads, double h, bool open_front) {
  for (int k = 0; k < 3; ++k) {
    for (int end = 0; end < 2; ++end) {
      if (open_front && k == 2 && end == 1) { continue; }
      dvec3 a{0.0}, b{0.0}, origin{-h, -h, -h};
      a[(k + 1) % 3] = 2 * h, b[(k + 2) % 3] = 2 * h, origin[k] = end ? h : -h;
      end ? add(world, quads, origin, b, a) : add(world, quads, origin, a, b);
    }
  }
}

Patch square_on(const Quad& q, double size, Random& random) {
  const double s = std::min(1.0, size / glm::length(q.a)), t = std::min(1.0, size / glm::length(q.b));
  const dvec3 a = s * q.a, b = t * q.b, o = q.origin + random.uniform(0, 1 - s) * q.a + random.uniform(0, 1 - t) * q.b;
  return {{o, o + a, o + a + b, o + b}, q.normal(), q.owner, 0.0};
}
dvec3 point_on(const Patch& p, double u, double v) {
  const auto& c = p.contour;
  return (1 - u) * ((1 - v) * c[0] + v * c[3]) + u * ((1 - v) * c[1] + v * c[2]);
}
// Stratified segments between two patches; false when not all ends face each other. `lift` brings a point to the true surface.
template <class Lift>
bool bundle(const Patch& p, const Patch& q, Random& random, Lift&& lift, std::vector<Ray>& rays) {
  for (const dvec3& x : p.contour) {
    for (const dvec3& y : q.contour) {
      if (!(glm::dot(p.normal, y - x) > 1e-3) || !(glm::dot(q.normal, x - y) > 1e-3)) { return false; }
    }
  }
  const std::uint32_t shift = random.below(16);
  for (std::uint32_t i = 0; i < 16; ++i) {
    const std::uint32_t j = (i * 5 ^ shift) & 15u;
    const dvec3 x = lift(p, point_on(p, (i % 4 + random.uniform()) / 4, (i / 4 + random.uniform()) / 4));
    const dvec3 y = lift(q, point_on(q, (j % 4 + random.uniform()) / 4, (j / 4 + random.uniform()) / 4));
    rays.push_back({raycast::between(x, y), p.owner, q.owner});
  }
  return true;
}
std::array<Patch, 4> quarters(const Patch& p) {
  std::array<Patch, 4> result;
  for (std::size_t k = 0; k < 4; ++k) {
    const double u = 0.5 * static_cast<double>(k % 2), v = 0.5 * static_cast<double>(k / 2);
    result[k] = {
        {point_on(p, u, v), point_on(p, u + 0.5, v), point_on(p, u + 0.5, v + 0.5), point_on(p, u, v + 0.5)}, p.normal, p.owner, p.bulge};
  }
  return result;
}

void wall_sets(World& world, const std::vector<Quad>& quads, Random& random, double size) {
  const auto stay = [](const Patch&, const dvec3& x) { return x; };
  const auto any = [&]() -> const Quad& { return quads[random.below(quads.size())]; };
  Set bundles{"bundle wall-wall", {}, {}, {}}, incoherent{"incoherent", {}, {}, {}}, hier{"hier", {}, {}, {}};
  while (bundles.rays.size() < ray_count) {
    std::pair<Patch, Patch> pair{square_on(any(), size, random), square_on(any(), size, random)};
    if (bundle(pair.first, pair.second, random, stay, bundles.rays)) { bundles.pairs.push_back(std::move(pair)); }
  }
  while (incoherent.rays.size() < ray_count) {
    std::vector<Ray> sixteen;
    if (bundle(square_on(any(), size, random), square_on(any(), size, random), random, stay, sixteen)) {
      incoherent.rays.push_back(sixteen[random.below(16)]);
    }
  }
  while (hier.rays.size() < ray_count) {
    std::pair<Patch, Patch> parent{square_on(any(), 2 * size, random), square_on(any(), 2 * size, random)};
    std::vector<Ray> rays;
    std::vector<std::pair<Patch, Patch>> pairs;
    for (const Patch& p : quarters(parent.first)) {
      for (const Patch& q : quarters(parent.second)) {
        if (bundle(p, q, random, stay, rays)) { pairs.push_back({p, q}); }
      }
    }
    if (pairs.size() < 16) { continue; }
    hier.rays.insert(hier.rays.end(), rays.begin(), rays.end());
    hier.pairs.insert(hier.pairs.end(), pairs.begin(), pairs.end());
    hier.parents.push_back(std::move(parent));
  }
  Set closest = bundles, closest_incoherent = incoherent;
  closest.name = "closest bundle", closest_incoherent.name = "closest incoherent";
  closest.closest = closest_incoherent.closest = true;
  for (Set* set : {&bundles, &incoherent, &hier, &closest, &closest_incoherent}) { world.sets.push_back(std::move(*set)); }
}

}  // namespace

// A room of five walls, a lamp under the ceiling and five turned blocks whose bottoms are left out: 31 parallelograms, 62 triangles.
World cornell() {
  World world;
  world.name = "cornell: 62 triangles = 31 polygons";
  std::vector<Quad> quads;
  const double h = 2.775;
  add_room(world, quads, h, true);
  add(world, quads, {-0.65, 0.99 * h, -0.5}, {1.3, 0, 0}, {0, 0, 1.05});
  const double blocks[5][6] = {{-0.9, -0.9, 0.8, 0.8, 3.3, 0.3},  // x z half-width half-depth height turn
                               {0.95, 0.6, 0.8, 0.8, 1.65, -0.28},
                               {-1.9, 1.3, 0.4, 0.4, 1.0, 0.6},
                               {1.8, -1.8, 0.45, 0.35, 2.2, 1.1},
                               {-0.2, 1.9, 0.35, 0.5, 0.7, -0.8}};
  for (const auto& b : blocks) {
    const dvec3 c{b[0], -h, b[1]}, x = b[2] * dvec3(std::cos(b[5]), 0, std::sin(b[5])),
                                   z = b[3] * dvec3(-std::sin(b[5]), 0, std::cos(b[5])), y{0, b[4], 0};
    add(world, quads, c - x - z + y, 2.0 * z, 2.0 * x);
    add(world, quads, c + x - z, y, 2.0 * z);
    add(world, quads, c - x - z, 2.0 * z, y);
    add(world, quads, c - x + z, 2.0 * x, y);
    add(world, quads, c - x - z, y, 2.0 * x);
  }
  Random random;
  wall_sets(world, quads, random, 0.3);
  return world;
}

// A room of six walls with 10 000 spheres.
World spheres() {
  World world;
  world.name = "spheres: 10 000 spheres, 12 triangles";
  std::vector<Quad> quads;
  add_room(world, quads, 5.0, false);
  Random random;
  for (int i = 0; i < 10000; ++i) {
    const dvec3 c{random.uniform(-4.7, 4.7), random.uniform(-4.7, 4.7), random.uniform(-4.7, 4.7)};
    world.balls.push_back({c, random.uniform(0.03, 0.07)});
    world.objects.push_back(place(raycast::Sphere::make(c, world.balls.back().radius)));
  }
  wall_sets(world, quads, random, 0.3);
  // Between patches on the spheres themselves, a few diameters apart as where light is exchanged.
  Set set{"bundle sphere-sphere", {}, {}, {}};
  const auto cap = [&](std::uint32_t ball, const dvec3& towards) {
    const auto& [c, r] = world.balls[ball];
    const dvec3 n = glm::normalize(towards - c), u = glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0))),
                v = glm::cross(n, u);
    Patch patch{{}, n, ball + 6, 0.0};
    for (int k = 0; k < 4; ++k) {
      patch.contour.push_back(c + r * glm::normalize(n + 0.3 * (k == 1 || k == 2 ? 1.0 : -1.0) * u + 0.3 * (k >= 2 ? 1.0 : -1.0) * v));
    }
    patch.bulge = r - glm::dot(patch.contour[0] - c, n);
    return patch;
  };
  const auto lift = [&](const Patch& p, const dvec3& x) {
    const auto& [c, r] = world.balls[p.owner - 6];
    return c + r * glm::normalize(x - c);
  };
  while (set.rays.size() < ray_count) {
    const std::uint32_t i = random.below(world.balls.size()), j = random.below(world.balls.size());
    const double apart = glm::length(world.balls[i].centre - world.balls[j].centre);
    if (i == j || apart > 3.0 || apart < 0.6) { continue; }
    std::pair<Patch, Patch> pair{cap(i, world.balls[j].centre), cap(j, world.balls[i].centre)};
    if (bundle(pair.first, pair.second, random, lift, set.rays)) { set.pairs.push_back(std::move(pair)); }
  }
  world.sets.push_back(std::move(set));
  return world;
}

// A ball with waves on its surface, about 100 000 triangles, in a room of six walls.
World bumpy() {
  World world;
  world.name = "bumpy: 99 856 triangles in a room";
  std::vector<Quad> quads;
  add_room(world, quads, 5.0, false);
  const std::uint32_t rows = 158, columns = 317;  // 2 columns (rows - 1) triangles; the poles are fans
  std::vector<dvec3> positions;
  const auto at = [&](double theta, double phi) {
    const double r = 2.6 + 0.35 * std::sin(9 * theta) * std::cos(12 * phi) * std::sin(theta);
    return dvec3(r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta));
  };
  const double pi = 3.14159265358979323846;
  positions.push_back(at(0, 0));
  for (std::uint32_t i = 1; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) { positions.push_back(at(pi * i / rows, 2 * pi * j / columns)); }
  }
  positions.push_back(at(pi, 0));
  const auto v = [&](std::uint32_t i, std::uint32_t j) { return i == 0 ? 0 : 1 + (i - 1) * columns + j % columns; };
  const auto south = static_cast<std::uint32_t>(positions.size() - 1);
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t j = 0; j < columns; ++j) {
    faces.push_back({0, v(1, j), v(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < rows; ++i) {
      faces.push_back({v(i, j), v(i + 1, j), v(i + 1, j + 1)});
      faces.push_back({v(i, j), v(i + 1, j + 1), v(i, j + 1)});
    }
    faces.push_back({v(rows - 1, j), south, v(rows - 1, j + 1)});
  }
  for (const auto& f : faces) { world.triangles.push_back({positions[f[0]], positions[f[1]], positions[f[2]]}); }
  world.objects.push_back(place(raycast::Mesh::make(positions, faces)));
  Random random;
  wall_sets(world, quads, random, 0.3);
  return world;
}

}  // namespace bench
