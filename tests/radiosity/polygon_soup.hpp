// SPDX-License-Identifier: MIT
#pragma once

// Polygons for the tests of the intake: shapes that are sound, and what other programs make of them.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/polygon.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/scene/scene.hpp>

#include "catch.hpp"

namespace soup {

struct Soup {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> corners, first{0}, material, group;
  std::vector<std::string> names{"thing"};
  std::vector<radiosity::Material> materials{{"grey", glm::dvec3(0.5), glm::dvec3(0.0)}, {"lamp", glm::dvec3(0.0), glm::dvec3(10.0)}};
  std::vector<std::uint8_t> two_sided;

  std::uint32_t vertex(const glm::dvec3& p) {
    positions.push_back(p);
    return static_cast<std::uint32_t>(positions.size() - 1);
  }
  void face(const std::vector<std::uint32_t>& its, std::uint32_t m = 0) {
    corners.insert(corners.end(), its.begin(), its.end());
    first.push_back(static_cast<std::uint32_t>(corners.size()));
    material.push_back(m);
    group.push_back(static_cast<std::uint32_t>(names.size() - 1));
  }
  // With vertices of its own, as formats without indices have them.
  void polygon(const std::vector<glm::dvec3>& points, std::uint32_t m = 0) {
    std::vector<std::uint32_t> its;
    for (const glm::dvec3& p : points) { its.push_back(vertex(p)); }
    face(its, m);
  }
  [[nodiscard]] std::size_t count() const { return first.size() - 1; }
  [[nodiscard]] std::vector<glm::dvec3> outline(std::size_t f) const {
    std::vector<glm::dvec3> points;
    for (std::uint32_t i = first[f]; i < first[f + 1]; ++i) { points.push_back(positions[corners[i]]); }
    return points;
  }
  [[nodiscard]] double area() const {
    double sum = 0.0;
    for (std::size_t f = 0; f < count(); ++f) { sum += brep::area(outline(f)); }
    return sum;
  }
  [[nodiscard]] radiosity::PolygonView view() const { return {positions, corners, first, material, group, names, two_sided}; }
  [[nodiscard]] radiosity::Intake take_in(const radiosity::IntakeOptions& options = {}) const {
    return radiosity::take_in(view(), materials, options);
  }
};

// An axis-parallel box, each side n by n squares in two triangles each; outwards, or inwards with `turn`.
inline void add_box(Soup& out, const glm::dvec3& lo, const glm::dvec3& hi, int n = 1, bool turn = false, std::uint32_t m = 0) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto at = [&](int i, int j) {
        glm::dvec3 p = end == 1 ? hi : lo;
        p[u] = lo[u] + (hi[u] - lo[u]) * i / n;
        p[v] = lo[v] + (hi[v] - lo[v]) * j / n;
        return p;
      };
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          std::array<glm::dvec3, 4> q{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
          if ((end == 1) == turn) { std::swap(q[1], q[3]); }
          out.polygon({q[0], q[1], q[2]}, m);
          out.polygon({q[0], q[2], q[3]}, m);
        }
      }
    }
  }
}

// A closed surface that is curved everywhere: a torus of n times m quadrilaterals in two triangles each.
inline void add_torus(Soup& out, int n, int m, double radius = 1.0, double tube = 0.4) {
  const auto at = [&](int i, int j) {
    const double a = 2.0 * std::numbers::pi * i / n, b = 2.0 * std::numbers::pi * j / m;
    const double r = radius + tube * std::cos(b);
    return glm::dvec3(r * std::cos(a), r * std::sin(a), tube * std::sin(b));
  };
  const auto first = static_cast<std::uint32_t>(out.positions.size());
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) { out.vertex(at(i, j)); }
  }
  const auto number = [&](int i, int j) { return first + static_cast<std::uint32_t>((i % n) * m + j % m); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      out.face({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      out.face({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
}

// Of the objects of a scene: the area of what reflects, and the volume that the closed shells enclose.
struct Measure {
  double area = 0.0, volume = 0.0;
  std::size_t solids = 0, rooms = 0, surfaces = 0;
};
inline Measure measure(const std::vector<radiosity::SceneObject>& objects) {
  Measure result;
  for (const radiosity::SceneObject& object : objects) {
    brep::Builder builder;
    object.shape->approximate(1.0, builder);
    double volume = 0.0;
    for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
      if (builder.sheet(f) == brep::no_sheet) { continue; }
      std::vector<glm::dvec3> p;
      for (const std::uint32_t v : builder.corners(f)) { p.push_back(builder.position(v)); }
      result.area += brep::area(p);
      volume += glm::dot(p[0], brep::vector_area(p)) / 3.0;
    }
    if (!object.shape->solid()) {
      ++result.surfaces;
      continue;
    }
    result.volume += volume;
    ++(object.placement.inside ? result.rooms : result.solids);
  }
  return result;
}

inline std::size_t count_of(const radiosity::Intake& intake, radiosity::ChangeKind kind) {
  for (const radiosity::Change& change : intake.changes) {
    if (change.kind == kind) { return change.count; }
  }
  return 0;
}
inline double size_of(const radiosity::Intake& intake, radiosity::ChangeKind kind) {
  for (const radiosity::Change& change : intake.changes) {
    if (change.kind == kind) { return change.size; }
  }
  return 0.0;
}

// What take_in() promises of every input.
inline void check_sound(const Soup& soup, const radiosity::Intake& intake) {
  radiosity::Scene scene{soup.materials, intake.objects};
  if (scene.objects.empty()) { return; }
  for (const std::string& fault : radiosity::faults(scene)) { FAIL_CHECK(fault); }
}

}  // namespace soup
