// SPDX-License-Identifier: MIT
#pragma once

// Random solids on few grid points, where almost everything touches or coincides, and the laws that all operations on them obey. Used by
// the tests, where numbers come from a seed, and by the fuzz target, where they come from its input.

#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "csg_solids.hpp"

namespace solids {

using Below = std::function<int(int)>;  // a number of 0 ... n - 1

inline brep::Builder random_leaf(const Below& below, int size) {
  const auto point = [&] {
    const int x = below(size + 1), y = below(size + 1), z = below(size + 1);
    return glm::dvec3(x, y, z);
  };
  const int kind = below(4);
  if (kind == 0) {  // L
    const double a = below(size), z = below(size), h = 1 + below(2);
    return prism({{a, a}, {a + 2, a}, {a + 2, a + 1}, {a + 1, a + 1}, {a + 1, a + 2}, {a, a + 2}}, z, z + h);
  }
  if (kind == 1) {
    const glm::dvec3 centre = point();
    return octasphere(1, centre, 1 + below(2));
  }
  const glm::dvec3 p = point(), q = point(), r = point(), s = point();
  if (kind == 2 && glm::dot(glm::cross(q - p, r - p), s - p) != 0.0) { return tetrahedron({p, q, r, s}); }
  glm::dvec3 hi = glm::max(p, q);
  for (int i = 0; i < 3; ++i) { hi[i] += p[i] == q[i] ? 1.0 : 0.0; }
  return box(glm::min(p, q), hi);
}

// Solid angle of a triangle seen from x (van Oosterom and Strackee 1983).
inline double solid_angle(glm::dvec3 u, glm::dvec3 v, glm::dvec3 w, const glm::dvec3& x) {
  u -= x, v -= x, w -= x;
  const double lu = glm::length(u), lv = glm::length(v), lw = glm::length(w);
  return 2.0 * std::atan2(glm::dot(u, glm::cross(v, w)), lu * lv * lw + glm::dot(u, v) * lw + glm::dot(u, w) * lv + glm::dot(v, w) * lu);
}
// Is the point inside? `margin` sinks to its distance from the planes of the triangles.
inline bool holds(const brep::Builder& b, const glm::dvec3& x, double& margin) {
  double sum = 0.0;
  for (std::uint32_t f = 0; f < b.face_count(); ++f) {
    const auto c = b.corners(f);
    for (std::size_t k = 2; k < c.size(); ++k) {
      const glm::dvec3 &u = b.position(c[0]), &v = b.position(c[k - 1]), &w = b.position(c[k]);
      margin = std::min(margin, std::abs(glm::dot(glm::normalize(glm::cross(v - u, w - u)), x - u)));
      sum += solid_angle(u, v, w, x);
    }
  }
  return sum > 6.28;
}
inline bool holds(const Solid& s, const glm::dvec3& x) {
  const brep::csg::Boundary& b = s.faces();
  const auto at = [&](std::uint32_t h) { return s.grid().from_grid(b.points[b.halves[h].point].position); };
  double sum = 0.0;
  for (const brep::csg::Face& f : b.faces) {
    for (std::uint32_t h = f.first; h < f.first + f.count; ++h) { sum += solid_angle(at(f.first), at(h), at(b.halves[h].next), x); }
  }
  return sum > 6.28;
}

// Combines random leaves `depth` times and asks everything that must hold. What is wrong, in a sentence; empty: nothing.
inline std::string random_laws(const Below& below, int size, int depth) {
  using namespace brep::csg;
  struct Part {
    Solid solid;
    std::function<bool(const glm::dvec3&, double&)> holds;
  };
  const Grid grid(glm::dvec3(-8.0), glm::dvec3(8.0));
  std::string wrong;
  const auto expect = [&](bool law, const char* sentence) {
    if (!law && wrong.empty()) { wrong = sentence; }
  };
  const auto make = [&]() -> Part {
    const brep::Builder b = random_leaf(below, size);
    const auto solid = leaf(b, grid);
    if (!solid) { expect(false, "a leaf is refused"); }
    return {solid ? *solid : Solid(), [b](const glm::dvec3& x, double& margin) { return solids::holds(b, x, margin); }};
  };
  const auto valid = [&](const brep::Result<Solid>& result) {
    if (!result) {
      expect(false, "an operation is refused");
      return Solid();
    }
    if (wrong.empty()) { wrong = faults(*result); }
    return *result;
  };
  const auto near = [](double x, double y) { return std::abs(x - y) < 1e-6; };  // coordinates below 8, with errors of 2^-47
  Part a = make();
  for (int d = 0; d < depth && wrong.empty(); ++d) {
    const Part b = make();
    if (!wrong.empty()) { break; }
    const Solid u = valid(unite(a.solid, b.solid)), i = valid(intersect(a.solid, b.solid));
    const Solid ab = valid(subtract(a.solid, b.solid)), ba = valid(subtract(b.solid, a.solid));
    if (!wrong.empty()) { break; }
    const double va = volume(a.solid), vb = volume(b.solid);
    expect(near(volume(u) + volume(i), va + vb), "vol(u) + vol(i) = vol(A) + vol(B)");
    expect(near(volume(ab) + volume(i), va), "vol(A - B) + vol(i) = vol(A)");
    expect(near(volume(ba) + volume(i), vb), "vol(B - A) + vol(i) = vol(B)");
    const Solid u2 = valid(unite(b.solid, a.solid)), i2 = valid(intersect(b.solid, a.solid));
    expect(counts(u).chi() == counts(u2).chi() && near(area(u), area(u2)), "A u B = B u A");
    expect(counts(i).chi() == counts(i2).chi() && near(area(i), area(i2)), "A n B = B n A");
    expect(valid(subtract(valid(subtract(u, b.solid)), ab)).empty(), "(A u B) - B lies within A - B");
    expect(counts(valid(unite(u, u))) == counts(u), "S u S = S");
    expect(valid(subtract(u, u)).empty(), "S - S = 0");
    expect(near(volume(valid(unite(ab, i))), va), "(A - B) u (A n B) = A");
    const auto in_a = a.holds, in_b = b.holds;
    const int operation = below(4);
    const bool use_i = operation == 1 && !i.empty(), use_ba = operation == 2 && !ba.empty();
    const bool use_u = operation == 0 || (!use_i && !use_ba && ab.empty());
    a = {use_u    ? u
         : use_i  ? i
         : use_ba ? ba
                  : ab,
         [=](const glm::dvec3& x, double& margin) {
           const bool p = in_a(x, margin), q = in_b(x, margin);
           return use_u ? p || q : use_i ? p && q : use_ba ? q && !p : p && !q;
         }};
    for (int n = 0; n < 30; ++n) {
      glm::dvec3 x(0.0);
      for (int k = 0; k < 3; ++k) { x[k] = 8e-4 * below(10000) - 2.0; }
      double margin = 1.0;
      const bool inside = a.holds(x, margin);
      expect(margin < 1e-4 || inside == solids::holds(a.solid, x), "a point is inside when the tree says so");
    }
  }
  return wrong;
}
inline std::string random_tree(std::uint32_t seed, int size, int depth) {
  std::mt19937 random(seed);
  return random_laws([&](int n) { return static_cast<int>(random() % static_cast<std::uint32_t>(n)); }, size, depth);
}

}  // namespace solids
