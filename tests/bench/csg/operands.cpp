// SPDX-License-Identifier: MIT
// The operands: spheres, Menger's sponge by bars, a grid of cubes, a chain of spheres.
#include <cmath>
#include <map>

#include "bench.hpp"

namespace bench {
namespace {

// Sponge of side 3^level: the bars of every level along every axis, those that lie in a larger bar left out. Bars end at the cube's faces,
// or stick out by one.
Case menger(int level, bool flush, std::optional<double> manifold, std::optional<double> cgal) {
  const int side = static_cast<int>(std::lround(std::pow(3, level)));
  Case c{"Menger level " + std::to_string(level) + (flush ? ", flush" : ", out"),
         Operation::subtract,
         {},
         std::pow(20.0, level),
         manifold,
         cgal,
         std::nullopt};
  const double n = side, out = flush ? 0.0 : 1.0;
  c.operands.push_back(box({0, 0, 0}, {n, n, n}));
  for (int width = side / 3; width >= 1; width /= 3) {
    const auto in_larger_bar = [&](int i, int j) {
      for (int w = 3 * width; w <= side / 3; w *= 3) {
        if (i / w % 3 == 1 && j / w % 3 == 1) { return true; }
      }
      return false;
    };
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = width; i < side; i += 3 * width) {
        for (int j = width; j < side; j += 3 * width) {
          if (in_larger_bar(i, j)) { continue; }
          std::array<double, 3> lo{}, hi{};
          const auto a = static_cast<std::size_t>(axis);
          lo[a] = -out, hi[a] = n + out;
          lo[(a + 1) % 3] = i, hi[(a + 1) % 3] = i + width;
          lo[(a + 2) % 3] = j, hi[(a + 2) % 3] = j + width;
          c.operands.push_back(box(lo, hi));
        }
      }
    }
  }
  return c;
}

Case grid(int n) {
  Case c{std::to_string(n) + "^3 cubes", Operation::unite, {}, std::pow(n, 3.0), std::nullopt, std::nullopt, std::nullopt};
  if (n == 6) { c.manifold = 88, c.cgal_exact = 146, c.cgal_inexact = 162; }
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      for (int z = 0; z < n; ++z) {
        const double a = x, b = y, d = z;
        c.operands.push_back(box({a, b, d}, {a + 1, b + 1, d + 1}));
      }
    }
  }
  return c;
}

Case chain() {
  Case c{"chain of 20 spheres", Operation::unite, {}, 49.2296123902, 140, 245, 247};
  for (int i = 0; i < 20; ++i) { c.operands.push_back(moved(octasphere(11), 0.8 * i, 0.05 * (i % 3), 0.03 * (i % 5))); }
  return c;
}

}  // namespace

Polygons octasphere(std::uint32_t splits) {
  Polygons result;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> number;
  const auto vertex = [&](std::array<std::int64_t, 3> p) {
    const auto [entry, is_new] = number.emplace(p, static_cast<std::uint32_t>(result.positions.size()));
    if (is_new) {
      const double x = static_cast<double>(p[0]), y = static_cast<double>(p[1]), z = static_cast<double>(p[2]);
      const double length = std::sqrt(x * x + y * y + z * z);
      result.positions.push_back({x / length, y / length, z / length});
    }
    return entry->second;
  };
  const auto n = static_cast<std::int64_t>(splits);
  for (int octant = 0; octant < 8; ++octant) {
    const std::int64_t sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, sz = octant & 4 ? -1 : 1;
    const bool mirrored = sx * sy * sz < 0;
    const auto at = [&](std::int64_t i, std::int64_t j) { return vertex({sx * i, sy * j, sz * (n - i - j)}); };
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      result.faces.push_back(mirrored ? std::vector<std::uint32_t>{a, c, b} : std::vector<std::uint32_t>{a, b, c});
    };
    for (std::int64_t i = 0; i < n; ++i) {
      for (std::int64_t j = 0; i + j < n; ++j) {
        triangle(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) { triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)); }
      }
    }
  }
  return result;
}

Polygons box(const std::array<double, 3>& lo, const std::array<double, 3>& hi) {
  Polygons result;
  for (unsigned i = 0; i < 8; ++i) { result.positions.push_back({i & 1U ? hi[0] : lo[0], i & 2U ? hi[1] : lo[1], i & 4U ? hi[2] : lo[2]}); }
  result.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return result;
}

Polygons moved(Polygons polygons, double x, double y, double z) {
  for (auto& p : polygons.positions) { p[0] += x, p[1] += y, p[2] += z; }
  return polygons;
}

std::vector<Case> cases(bool all) {
  struct Row {
    std::uint32_t splits;
    double volume[3], manifold[3], exact[3], inexact[3];
  };
  // Volumes by four engines, which agree to 12 digits.
  const Row rows[] = {
      {11, {6.01261766382, 2.26061728631, 1.87600018875}, {1.8, 1.4, 1.6}, {5.7, 5.1, 5.2}, {3.4, 3.1, 3.4}},
      {35, {6.07474501414, 2.2924300873, 1.89115746342}, {10.8, 8.8, 9.8}, {40.9, 34.0, 36.3}, {24.3, 22.0, 22.5}},
      {112, {6.08095496488, 2.29560833901, 1.89267331293}, {127, 79, 101}, {402, 306, 352}, {289, 313, 314}},
  };
  std::vector<Case> result;
  for (const Row& row : rows) {
    if (!all && row.splits > 11) { break; }
    const Polygons sphere = octasphere(row.splits);
    for (std::size_t k = 0; k < 3; ++k) {
      const char* const sign[] = {"union", "intersection", "difference"};
      result.push_back({"2 spheres of " + std::to_string(sphere.faces.size()) + ", " + sign[k],
                        static_cast<Operation>(k),
                        {sphere, moved(sphere, .503, .307, .201)},
                        row.volume[k],
                        row.manifold[k],
                        row.exact[k],
                        row.inexact[k]});
    }
  }
  result.push_back(menger(1, false, 1.3, 4.6));
  result.push_back(menger(1, true, 0.9, 2.5));
  result.push_back(grid(3));
  if (!all) { return result; }
  result.push_back(menger(2, false, 29.9, 168));
  result.push_back(menger(2, true, 29.5, 107));
  result.push_back(grid(6));
  result.push_back(chain());
  result.push_back(menger(3, false, 1842, std::nullopt));
  return result;
}

}  // namespace bench
