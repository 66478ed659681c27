// SPDX-License-Identifier: MIT
// A small path tracer whose paths end at their second surface: there it takes the light that was baked. What the eye sees at once, the
// first surface with its direct light and shadows, is traced; what is seen by way of another surface is looked up.
// `example_second_bounce FILE.ppm` writes the picture; without a file it compares with paths that go on until they die.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/bake/bake.hpp>

namespace {

using glm::dvec3;
using radiosity::Color;

struct World {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices, material;
  std::vector<radiosity::Material> materials{{"white", Color(0.75), Color(0.0)},
                                             {"red", {0.7, 0.15, 0.1}, Color(0.0)},
                                             {"blue", {0.15, 0.2, 0.7}, Color(0.0)},
                                             {"lamp", Color(0.0), Color(40.0)}};

  void quad(const std::array<dvec3, 4>& p, std::uint32_t m) {
    const auto first = static_cast<std::uint32_t>(positions.size() / 3);
    for (const dvec3& v : p) {
      for (int k = 0; k < 3; ++k) { positions.push_back(static_cast<float>(v[k])); }
    }
    for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) { indices.push_back(first + k); }
    material.insert(material.end(), 2, m);
  }
  void box(const dvec3& a, const dvec3& b, bool inside, const std::array<std::uint32_t, 6>& m) {
    const auto at = [&](int i) { return dvec3((i & 1) != 0 ? b.x : a.x, (i & 2) != 0 ? b.y : a.y, (i & 4) != 0 ? b.z : a.z); };
    constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (std::size_t s = 0; s < 6; ++s) {
      std::array<dvec3, 4> p{at(sides[s][0]), at(sides[s][1]), at(sides[s][2]), at(sides[s][3])};
      if (inside) { std::swap(p[1], p[3]); }
      quad(p, m[s]);
    }
  }
  [[nodiscard]] dvec3 corner(std::size_t t, std::size_t k) const {
    const float* const p = &positions[3 * std::size_t{indices[3 * t + k]}];
    return {p[0], p[1], p[2]};
  }

  struct Hit {
    std::size_t triangle = 0;
    dvec3 point{0.0}, normal{0.0};
  };
  // Moeller and Trumbore 1997, front sides alone, one triangle after the other: the smallest renderer there is.
  [[nodiscard]] std::optional<Hit> trace(const dvec3& from, const dvec3& along) const {
    std::optional<Hit> hit;
    double nearest = 1e9;
    for (std::size_t t = 0; t < material.size(); ++t) {
      const dvec3 a = corner(t, 0), u = corner(t, 1) - a, v = corner(t, 2) - a;
      const dvec3 p = glm::cross(along, v);
      const double det = glm::dot(u, p);
      if (det < 1e-12) { continue; }
      const dvec3 s = from - a, q = glm::cross(s, u);
      const double x = glm::dot(s, p) / det, y = glm::dot(along, q) / det, d = glm::dot(v, q) / det;
      if (x < 0.0 || y < 0.0 || x + y > 1.0 || d < 1e-6 || d > nearest) { continue; }
      nearest = d;
      hit = Hit{t, from + d * along, glm::normalize(glm::cross(u, v))};
    }
    return hit;
  }
};

class Tracer {
 public:
  Tracer(const World& world, const radiosity::BakedLight* baked) : world_(world), baked_(baked) {}

  // The radiance that comes from there.
  [[nodiscard]] Color radiance(const dvec3& from, const dvec3& along) {
    std::optional<World::Hit> hit = world_.trace(from, along);
    Color sum{0.0}, throughput{1.0};
    for (int bounce = 0; hit && bounce < 200; ++bounce) {
      ++surfaces;
      const radiosity::Material& material = world_.materials[world_.material[hit->triangle]];
      if (bounce == 1 && baked_ != nullptr) {  // all that leaves it, but what its lamp gave to the first surface already
        const Color b = baked_->radiosity(hit->triangle, hit->point).value_or(Color(0.0));
        return sum + throughput * (b - material.emission) / std::numbers::pi;
      }
      if (bounce == 0) { sum += material.emission / std::numbers::pi; }
      throughput *= material.reflectance;
      sum += throughput * direct(*hit);
      const double survival = std::max({material.reflectance.x, material.reflectance.y, material.reflectance.z});
      if (survival == 0.0 || (bounce > 0 && random() > survival)) { break; }
      if (bounce > 0) { throughput /= survival; }
      hit = world_.trace(hit->point, cosine(hit->normal));
    }
    return sum;
  }
  std::size_t surfaces = 0;  // met so far

 private:
  double random() { return std::uniform_real_distribution(0.0, 1.0)(engine_); }
  // The irradiance from the lamp, over pi: one point of it, if it can be seen.
  Color direct(const World::Hit& at) {
    const std::size_t lamp = world_.material.size() - 2;
    const dvec3 o = world_.corner(lamp, 0), u = world_.corner(lamp, 1) - o, v = world_.corner(lamp + 1, 2) - o;
    const dvec3 n = glm::cross(u, v), way = o + random() * u + random() * v - at.point;
    const double squared = glm::dot(way, way);
    const dvec3 along = way / std::sqrt(squared);
    const double cosines = glm::dot(at.normal, along) * glm::dot(n, -along);  // the second one times the lamp's area
    if (glm::dot(at.normal, along) <= 0.0 || cosines <= 0.0) { return Color(0.0); }
    const auto blocker = world_.trace(at.point, along);
    if (!blocker || world_.material[blocker->triangle] != 3) { return Color(0.0); }
    return world_.materials[3].emission / std::numbers::pi * cosines / squared / std::numbers::pi;
  }
  dvec3 cosine(const dvec3& normal) {
    const double z = 2.0 * random() - 1.0, phi = 2.0 * std::numbers::pi * random(), r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return glm::normalize(normal + dvec3(r * std::cos(phi), r * std::sin(phi), z));
  }

  const World& world_;
  const radiosity::BakedLight* baked_;
  std::mt19937 engine_{1};
};

}  // namespace

int main(int count, char** arguments) {
  World world;
  world.box({0, 0, 0}, {2, 2, 2}, true, {1, 2, 0, 0, 0, 0});
  world.box({0.4, 1.0, 0}, {0.9, 1.5, 1.2}, false, {0, 0, 0, 0, 0, 0});
  world.box({1.1, 0.5, 0}, {1.6, 1.0, 0.5}, false, {0, 0, 0, 0, 0, 0});
  world.quad({dvec3(0.7, 0.7, 1.999), {0.7, 1.3, 1.999}, {1.3, 1.3, 1.999}, {1.3, 0.7, 1.999}}, 3);

  const radiosity::BakeOutcome outcome = radiosity::bake({world.positions, world.indices, world.materials, world.material});
  if (!outcome.baked) { return 1; }
  Tracer with(world, &outcome.baked->light), without(world, nullptr);
  const dvec3 eye{1.0, 0.05, 1.0};
  const auto look = [&](double x, double y) { return glm::normalize(dvec3(1.5 * (x - 0.5), 1.0, 1.5 * (0.5 - y))); };

  if (count > 1) {
    constexpr int side = 200, samples = 32;
    std::FILE* const file = std::fopen(arguments[1], "wb");
    if (file == nullptr) { return 1; }
    std::fprintf(file, "P6 %d %d 255\n", side, side);
    for (int i = 0; i < side * side; ++i) {
      Color sum{0.0};
      for (int s = 0; s < samples; ++s) {
        sum += with.radiance(eye, look((i % side + (s % 4 + 0.5) / 4) / side, (i / side + (s / 4 + 0.5) / 8) / side)) / double{samples};
      }
      for (int k = 0; k < 3; ++k) { std::fputc(static_cast<int>(255.0 * std::pow(std::min(sum[k], 1.0), 1.0 / 2.2)), file); }
    }
    return std::fclose(file);
  }

  // The mean over the picture by both.
  constexpr int side = 60;
  Color shorter{0.0}, full{0.0};
  for (int i = 0; i < side * side; ++i) {
    const dvec3 along = look((i % side + 0.5) / side, (i / side + 0.5) / side);
    for (int s = 0; s < 4; ++s) {
      shorter += with.radiance(eye, along) / (4.0 * side * side);
      full += without.radiance(eye, along) / (4.0 * side * side);
    }
  }
  std::printf("error of the baked light, relative to the reflected: %.1f %%\n", 100.0 * outcome.baked->audit.surface_error->relative_l2);
  std::printf("mean radiance of the picture, W/(m2 sr)\n");
  std::printf("  two surfaces and baked light   %.3f %.3f %.3f   %.1f surfaces a path\n", shorter.x, shorter.y, shorter.z,
              static_cast<double>(with.surfaces) / (4.0 * side * side));
  std::printf("  whole paths                    %.3f %.3f %.3f   %.1f surfaces a path\n", full.x, full.y, full.z,
              static_cast<double>(without.surfaces) / (4.0 * side * side));
}
