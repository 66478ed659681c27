// SPDX-License-Identifier: MIT
#pragma once

// A room full of polygons: as many as one likes, in boxes, one by one, or as one mesh.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <raycast/objects/mesh.hpp>

#include "radiosity/scenes.hpp"

namespace scenes {

// A torus with bumps, of about `count` triangles; outer diameter 0.8, about the origin. Far from convex.
inline std::shared_ptr<const raycast::Object> bumpy_torus(std::uint32_t count) {
  const auto around = std::max(8u, static_cast<std::uint32_t>(std::sqrt(count)));
  const std::uint32_t across = std::max(4u, count / (2 * around));
  std::vector<glm::dvec3> positions;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * j / across;
      const double r = 0.12 * (1.0 + 0.2 * std::sin(5.0 * u) * std::sin(3.0 * v));
      const double out = 0.256 + r * std::cos(v);
      positions.push_back({out * std::cos(u), out * std::sin(u), r * std::sin(v)});
      const auto at = [&](std::uint32_t a, std::uint32_t b) { return (a % around) * across + b % across; };
      faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return raycast::Mesh::make(positions, faces).object;
}

// A ball of 4 n (n - 1) triangles with the area of the sphere of radius r.
inline std::shared_ptr<const raycast::Object> ball(const glm::dvec3& centre, double r, std::uint32_t n) {
  std::vector<glm::dvec3> positions{{0, 0, -1}};
  std::vector<std::vector<std::uint32_t>> faces;
  const std::uint32_t sides = 2 * n;
  for (std::uint32_t i = 1; i < n; ++i) {
    const double t = std::numbers::pi * i / n;
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double u = 2.0 * std::numbers::pi * k / sides;
      positions.push_back({std::sin(t) * std::cos(u), std::sin(t) * std::sin(u), -std::cos(t)});
    }
  }
  positions.push_back({0, 0, 1});
  const auto at = [&](std::uint32_t i, std::uint32_t k) { return 1 + (i - 1) * sides + k % sides; };
  for (std::uint32_t k = 0; k < sides; ++k) {
    faces.push_back({0, at(1, k + 1), at(1, k)});
    faces.push_back({at(n - 1, k), at(n - 1, k + 1), static_cast<std::uint32_t>(positions.size() - 1)});
    for (std::uint32_t i = 1; i + 1 < n; ++i) {
      faces.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      faces.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  }
  double area = 0.0;
  for (const auto& f : faces) {
    area += 0.5 * glm::length(glm::cross(positions[f[1]] - positions[f[0]], positions[f[2]] - positions[f[0]]));
  }
  for (glm::dvec3& p : positions) { p = centre + r * std::sqrt(4.0 * std::numbers::pi / area) * p; }
  return raycast::Mesh::make(positions, faces).object;
}

enum class Things { boxes, polygons, mesh };

// A unit room with a lamp in its ceiling and, in it, k - 7 polygons: boxes or single ones turned and placed at random, of total area 2
// whatever their number, or one mesh. With `furnace` everything is E = 1 - rho instead, and the scene closed.
inline radiosity::Scene many(std::uint32_t k, Things kind, std::optional<double> furnace = std::nullopt) {
  radiosity::Scene scene;
  scene.materials = {{"wall", radiosity::Color{0.6}, radiosity::Color{0.0}},
                     {"thing", radiosity::Color{0.5}, radiosity::Color{0.0}},
                     {"lamp", radiosity::Color{0.0}, radiosity::Color{5.0}}};
  if (furnace) { scene.materials.assign(3, furnace_material(*furnace)); }
  scene.objects = {object("room", box({0, 0, 0}, {1, 1, 1}), 0, true),
                   object("lamp", polygon({{0.25, 0.25, 1.0}, {0.25, 0.75, 1.0}, {0.75, 0.75, 1.0}, {0.75, 0.25, 1.0}}), 2)};
  if (kind == Things::mesh) {
    scene.objects.push_back(object("torus", bumpy_torus(k - 7), 1));
    scene.objects.back().placement.translation = {0.5, 0.5, 0.4};
    return scene;
  }
  const bool boxes = kind == Things::boxes;
  std::mt19937_64 engine{k};
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    const double x = normal(engine), y = normal(engine), z = normal(engine);
    return glm::dvec3{x, y, z};
  };
  const std::uint32_t things = std::max(1u, (k - 7) / (boxes ? 6 : 1));
  const double side = std::sqrt(2.0 / (boxes ? 6.0 * things : things));
  const auto unit =
      boxes ? box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}) : polygon({{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}});
  const double margin = std::min(0.499, 0.867 * side);  // half a diagonal: nothing sticks in a wall
  for (std::uint32_t i = 0; i < things; ++i) {
    radiosity::SceneObject thing = object("thing" + std::to_string(i), unit, 1);
    const glm::dvec3 x = glm::normalize(vector());
    const glm::dvec3 y = glm::normalize(glm::cross(x, vector()));
    thing.placement.linear = glm::dmat3{x, y, glm::cross(x, y)} * side;
    for (int axis = 0; axis < 3; ++axis) { thing.placement.translation[axis] = margin + (1.0 - 2.0 * margin) * uniform(engine); }
    scene.objects.push_back(std::move(thing));
  }
  return scene;
}

// Without an audit, all light by links, with clusters from so many input faces.
inline radiosity::Options clustered(double epsilon, std::uint32_t from = 2) {
  return {.epsilon = epsilon,
          .min_area = 0.02 * epsilon,
          .indirect = radiosity::Indirect::links,
          .cluster_from = from,
          .audit_points = 0,
          .threads = 1};
}

}  // namespace scenes
