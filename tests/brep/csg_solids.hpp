// SPDX-License-Identifier: MIT
#pragma once

// What the tests of CSG share: leaves, all operations at once, counts of a result, and the invariants of boundary.hpp asked slowly, pair
// by pair.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vector_relational.hpp>

#include <brep/builder.hpp>
#include <brep/csg/csg.hpp>
#include <brep/shells.hpp>
#include <brep/validate.hpp>

#include "box.hpp"

namespace solids {

struct Vertex {
  glm::dvec3 position{0.0};
};
struct Face {
  std::uint32_t sheet = 0;
};
using Mesh = brep::BRep<Vertex, brep::NoData, Face>;
using Solid = brep::csg::Solid<std::uint32_t>;
using brep::csg::Grid;

using shapes::box;
// A prism over a simple polygon in the plane z = 0, counter-clockwise seen from above.
inline brep::Builder prism(const std::vector<glm::dvec2>& outline, double z0, double z1) {
  brep::Builder b;
  const auto n = static_cast<std::uint32_t>(outline.size());
  std::vector<std::uint32_t> bottom, top;
  for (const glm::dvec2& p : outline) { bottom.insert(bottom.begin(), b.vertex({p, z0})); }
  for (const glm::dvec2& p : outline) { top.push_back(b.vertex({p, z1})); }
  b.face(bottom, 0);
  b.face(top, 1);
  for (std::uint32_t i = 0; i < n; ++i) { b.face({i, (i + 1) % n, n + (i + 1) % n, n + i}, 2 + i); }
  return b;
}
inline brep::Builder regular_prism(std::uint32_t n, double radius, double z0, double z1, double turn = 0.0) {
  std::vector<glm::dvec2> outline;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = turn + 6.283185307179586 * i / n;
    outline.push_back(radius * glm::dvec2{std::cos(angle), std::sin(angle)});
  }
  return prism(outline, z0, z1);
}
// The corners in an order that makes the volume positive.
inline brep::Builder tetrahedron(const std::array<glm::dvec3, 4>& p) {
  brep::Builder b;
  const bool turned = glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) < 0.0;
  for (const glm::dvec3& x : p) { b.vertex(x); }
  const std::uint32_t i = turned ? 2 : 1, j = turned ? 1 : 2;
  b.face({0, j, i}, 0);
  b.face({0, i, 3}, 1);
  b.face({i, j, 3}, 2);
  b.face({j, 0, 3}, 3);
  return b;
}
// The edges of an octahedron split f times, on a sphere: 8 f^2 triangles.
inline brep::Builder octasphere(int f, const glm::dvec3& centre, double radius = 1.0) {
  brep::Builder b;
  std::map<std::array<int, 3>, std::uint32_t> number;
  const auto vertex = [&](const std::array<int, 3>& key) {
    const auto [entry, fresh] = number.emplace(key, 0);
    const glm::dvec3 p{key[0], key[1], key[2]};
    if (fresh) { entry->second = b.vertex(radius * glm::normalize(p) + centre); }
    return entry->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = (octant & 1) != 0 ? -1 : 1, sy = (octant & 2) != 0 ? -1 : 1, sz = (octant & 4) != 0 ? -1 : 1;
    const auto at = [&](int i, int j) { return vertex({sx * i, sy * j, sz * (f - i - j)}); };
    const auto triangle = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      sx* sy* sz < 0 ? b.face({x, z, y}, 0) : b.face({x, y, z}, 0);
    };
    for (int i = 0; i < f; ++i) {
      for (int j = 0; i + j < f; ++j) {
        triangle(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j < f - 1) { triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)); }
      }
    }
  }
  return b;
}

// The same moved: p -> turn p + shift.
inline brep::Builder moved(const brep::Builder& b, const glm::dmat3& turn, const glm::dvec3& shift) {
  brep::Builder result;
  for (std::uint32_t v = 0; v < b.vertex_count(); ++v) { result.vertex(turn * b.position(v) + shift); }
  for (std::uint32_t f = 0; f < b.face_count(); ++f) { result.face(b.corners(f), b.sheet(f)); }
  return result;
}
inline glm::dmat3 rotation(const glm::dvec3& axis, double angle) {
  const glm::dvec3 a = glm::normalize(axis);
  const double c = std::cos(angle), s = std::sin(angle);
  glm::dmat3 m(1.0);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 e{0.0};
    e[i] = 1.0;
    m[i] = c * e + s * glm::cross(a, e) + (1.0 - c) * glm::dot(a, e) * a;
  }
  return m;
}

inline Mesh mesh(const brep::Builder& b) {
  auto result = brep::close<Mesh>(b);
  return result.brep ? std::move(*result.brep) : Mesh{};
}
inline brep::Result<Solid> leaf(const brep::Builder& b, const Grid& grid) { return brep::csg::make_solid(mesh(b), grid); }

// What is wrong with a solid, in a sentence; empty: nothing. Time: the points times those that share an x with an edge.
inline std::string broken(const Solid& solid) {
  using namespace brep::csg;
  const Boundary& b = solid.boundary();
  const Predicates predicates(solid.grid().planes());
  const auto text = [](const char* what, std::size_t i) { return std::string(what) + " " + std::to_string(i); };
  for (std::size_t f = 0; f < b.faces.size(); ++f) {
    if (b.faces[f].count < 3) { return text("few half-edges: face", f); }
    for (std::uint32_t h = b.faces[f].first; h < b.faces[f].first + b.faces[f].count; ++h) {
      if (h >= b.halves.size() || b.halves[h].face != f) { return text("strange half-edge on face", f); }
    }
  }
  std::vector<int> before(b.halves.size(), 0), used(b.points.size(), 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> copies;
  for (std::uint32_t h = 0; h < b.halves.size(); ++h) {
    const Half& half = b.halves[h];
    const std::uint32_t target = b.halves[half.next].point;
    ++before[half.next];
    ++used[half.point];
    ++copies[{half.point, target}];
    if (b.halves[half.next].face != half.face) { return text("next on another face: half", h); }
    if (half.twin == h || b.halves[half.twin].twin != h) { return text("no twin: half", h); }
    if (b.halves[half.twin].point != target || b.halves[b.halves[half.twin].next].point != half.point) {
      return text("twin elsewhere: half", h);
    }
    const brep::csg::Face& face = b.faces[half.face];
    if (half.across == face.plane.number()) { return text("across is the plane of the face: half", h); }
    for (std::uint32_t p : {half.point, target}) {
      if (predicates.side(b.points[p], face.plane.number()) != 0) { return text("point off its face: half", h); }
      if (predicates.side(b.points[p], half.across) != 0) { return text("point off across: half", h); }
    }
    for (int i = 0; i < 3; ++i) {
      if (b.points[half.point].position[i] < face.box.lo[static_cast<std::size_t>(i)] ||
          b.points[half.point].position[i] > face.box.hi[static_cast<std::size_t>(i)]) {
        return text("point out of the box: half", h);
      }
    }
    const brep::csg::Face& other = b.faces[b.halves[half.twin].face];
    if (face.plane == other.plane && !b.touching && solid.attributes()[face.attribute] == solid.attributes()[other.attribute]) {
      return text("faces not merged: half", h);
    }
    if (face.plane == other.plane.flipped()) { return text("back to back: half", h); }
  }
  for (std::size_t h = 0; h < before.size(); ++h) {
    if (before[h] != 1) { return text("next is no permutation: half", h); }
  }
  for (const auto& [ends, count] : copies) {
    const auto back = copies.find({ends.second, ends.first});
    if (back == copies.end() || back->second != count) { return text("unequal copies of an edge at point", ends.first); }
  }
  const auto position = [&](std::size_t p) -> const glm::dvec3& { return b.points[p].position; };
  std::vector<std::size_t> by_x(b.points.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::sort(by_x.begin(), by_x.end(), [&](std::size_t p, std::size_t q) { return position(p).x < position(q).x; });
  constexpr double apart = 0x1p-26;  // of positions of one point: far more than their rounding
  for (std::size_t i = 0; i < by_x.size(); ++i) {
    const std::size_t p = by_x[i];
    if (used[p] == 0) { return text("unused point", p); }
    for (std::size_t k = i + 1; k < by_x.size() && position(by_x[k]).x - position(p).x <= apart; ++k) {
      if (predicates.equal(b.points[p], b.points[by_x[k]])) { return text("doubled point", p); }
    }
  }
  for (const Half& half : b.halves) {
    const std::uint32_t from = half.point, to = b.halves[half.next].point;
    if (from > to) { continue; }
    const glm::dvec3 lo = glm::min(position(from), position(to)), hi = glm::max(position(from), position(to));
    const auto first = std::lower_bound(by_x.begin(), by_x.end(), lo.x, [&](std::size_t p, double x) { return position(p).x < x; });
    for (auto at = first; at != by_x.end() && position(*at).x <= hi.x; ++at) {
      const std::size_t p = *at;
      if (p == from || p == to || glm::any(glm::lessThan(position(p), lo)) || glm::any(glm::greaterThan(position(p), hi))) { continue; }
      if (predicates.side(b.points[p], b.faces[half.face].plane.number()) == 0 && predicates.side(b.points[p], half.across) == 0) {
        return text("point inside an edge: point", p);
      }
    }
  }
  return {};
}

struct Counts {
  std::size_t vertices = 0, edges = 0, faces = 0, shells = 0;
  long genus = 0;
  double volume = 0.0, area = 0.0;

  [[nodiscard]] long chi() const { return 2 * (static_cast<long>(shells) - genus); }
  friend bool operator==(const Counts& a, const Counts& b) {
    return a.vertices == b.vertices && a.edges == b.edges && a.faces == b.faces && a.shells == b.shells && a.genus == b.genus;
  }
};
inline Counts counts(const Solid& solid) {
  const Mesh m = brep::csg::to_brep<Mesh>(solid);
  Counts c{m.vertex_count(), m.edge_count(), m.face_count(), 0, 0, brep::csg::volume(solid), brep::csg::area(solid)};
  for (const brep::Shell& shell : brep::shells(m)) {
    ++c.shells;
    c.genus += static_cast<long>(shell.genus());
  }
  return c;
}
// As broken, and the exported BRep is valid, has the faces of the solid and its volume.
inline std::string faults(const Solid& solid) {
  std::string all = broken(solid);
  if (!all.empty()) { return all; }
  const Mesh m = brep::csg::to_brep<Mesh>(solid);
  for (const brep::Fault& fault : brep::validate(m)) { all += fault.sentence + '\n'; }
  if (m.face_count() != solid.face_count()) { all += "the BRep has another number of faces"; }
  return all;
}

}  // namespace solids
