// SPDX-License-Identifier: MIT
#pragma once

// Directions from which light may reach a point, for the path tracer: the emitters, as shapes in a binary tree. A shape is chosen on the
// way down the tree, at each node by power over squared distance (Conty Estevez and Kulla 2018), then a direction towards it.
//
//   flat emitters     the triangles of their faces; a point uniformly distributed over the area of a triangle
//   curved emitters   spheres around pieces of their faces, large enough for the true surface; a direction uniformly distributed over the
//                     solid angle of the sphere. A compact object gets a single sphere, because a larger piece fills its sphere better.
//   bodies of faces   many flat faces of one object with the same exitance are handled like a curved emitter: a bulb of thousands of
//                     triangles is one sphere.
//
// In a house most lamps are behind walls, however powerful. So most choices first pick an emitter by the photons of all emitters that
// landed around x (photon_grid.hpp) and descend from its node; the others start at the root, because photons may miss an emitter that
// shines past an edge.
//
// The shapes only propose directions: the light from a direction is found by a ray. So a shape may be larger than what it stands for,
// overlap others or be hidden. Every direction has a density() that can be computed, which the balance heuristic needs (Veach and Guibas
// 1995).
//
// If no surface is more than 1.5 times as bright as the mean of all surfaces, as in a furnace, no direction is better than another. No
// shapes are made then, because every ray would be tested against thousands of them. A distant sun may have nearly all of the scene's
// area and cover next to nothing of the sky, so the rule applies only if nothing but walls of rooms emits, or if every surface emits at
// least half as much as the brightest.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/handles.hpp>

#include <raycast/transform.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity {

class Emitters {
 public:
  Emitters() = default;
  // `surfaces` are boundaries in the frame, refined or not; `emission`: radiant exitance of each input surface.
  Emitters(const std::vector<Surface>& surfaces, const std::vector<Color>& emission);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }

  // From now on emitters are also chosen by these photons, whose sources are emitting input surfaces. `diameter`: of the scene, m.
  void guide(std::vector<PhotonGrid::Photon> photons, double diameter);

  struct Sample {
    glm::dvec3 direction{0.0};  // unit
    double density = 0.0;       // per solid angle, of all shapes together
  };
  // Draws a direction from the point x into the hemisphere of the unit normal n; nothing if the chosen shape cannot be seen from there.
  template <class Numbers>
  [[nodiscard]] std::optional<Sample> sample(const glm::dvec3& x, const glm::dvec3& n, Numbers& random) const;

  // The density per solid angle with which sample() draws the unit direction w. Its integral may be less than 1, because some samples
  // give no direction.
  [[nodiscard]] double density(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& w) const {
    return density(x, n, w, brep::invalid_index);
  }

  // Approximate cost of density() beyond its cost with a single lamp, in microseconds of a core of 2024.
  [[nodiscard]] double work(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& w) const;

 private:
  static constexpr std::size_t most_single_faces = 64;  // an object with more faces of the same exitance becomes a body

  // Does about the same light come from all sides? See the top of this file.
  [[nodiscard]] static bool even(const std::vector<Surface>& surfaces, const std::vector<Color>& emission);

  struct Shape {
    std::array<glm::dvec3, 3> corner{glm::dvec3{0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}};  // of a triangle
    glm::dvec3 normal{0.0};                                                               // of a triangle, unit; 0: a sphere
    std::array<glm::dvec3, 3> inwards{};                                                  // unit inward normals of its edges, in its plane
    glm::dvec3 centre{0.0};
    double radius = 0.0;  // of the sphere, or of one around the triangle
    double area = 0.0;    // of the triangle, or of the piece that the sphere stands for
    double power = 0.0;
    std::uint32_t surface = 0;
    [[nodiscard]] bool flat() const { return normal != glm::dvec3{0.0}; }
  };
  struct Node {
    glm::dvec3 centre{0.0};  // of a sphere around all shapes below
    double radius = 0.0;
    double power = 0.0;
    glm::dvec3 normal{0.0};   // of all shapes below, when they lie in one plane; else 0
    double offset = 0.0;      // of that plane
    std::uint32_t first = 0;  // leaf: index of its shape; otherwise index of the first of its two children
    bool leaf = true;
    bool several = false;                         // are there several surfaces below?
    std::uint32_t surface = brep::invalid_index;  // surface of all shapes below, set only at the top node of that surface
  };

  void add_flat(std::uint32_t surface, const Polygon& polygon, double exitance);
  void add_curved(std::uint32_t surface, const std::vector<Polygon>& faces, const raycast::PlacedObject& object, std::uint32_t sheet,
                  double exitance);
  void add_spheres(std::uint32_t surface, std::span<std::array<glm::dvec3, 3>> pieces, double bulge, double exitance);
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t last, bool several_above);
  [[nodiscard]] double importance(const Node& node, const glm::dvec3& x, const glm::dvec3& n) const;
  [[nodiscard]] double first_share(const Node& node, const glm::dvec3& x, const glm::dvec3& n) const;
  // Does the ray from x in the direction w meet the bounding sphere of this node's shapes?
  [[nodiscard]] static bool meets(const Node& node, const glm::dvec3& x, const glm::dvec3& w);
  [[nodiscard]] static double density_of(const Shape& shape, const glm::dvec3& x, const glm::dvec3& w, bool meets);
  // As above, but the direction is taken to meet the shape of the leaf `sampled` regardless of rounding. 0 if that leaf cannot be seen
  // from x, which can happen because photons around x may choose it all the same. `opened`: counts the nodes whose children are visited.
  [[nodiscard]] double density(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& w, std::uint32_t sampled,
                               std::size_t* opened = nullptr) const;

  std::vector<Shape> shapes_;
  std::vector<Node> nodes_;  // the root first
  // By input surface: the surface under which its shapes are stored (all surfaces of a body share one); invalid: its own.
  std::vector<std::uint32_t> kept_as_;
  std::vector<std::uint32_t> node_of_;  // by input surface: top node of its shapes, or invalid
  PhotonGrid photons_;
};

template <class Numbers>
std::optional<Emitters::Sample> Emitters::sample(const glm::dvec3& x, const glm::dvec3& n, Numbers& random) const {
  if (nodes_.empty()) { return std::nullopt; }
  double choice = random.uniform();
  const double u = random.uniform();
  const double v = random.uniform();
  std::uint32_t index = 0;
  if (const PhotonGrid::Around around = photons_.around(x, n); choice < around.trust) {
    choice /= around.trust;
    index = node_of_[around.choose(choice)];
  } else {
    choice = (choice - around.trust) / (1.0 - around.trust);
  }
  while (!nodes_[index].leaf) {
    const Node& node = nodes_[index];
    const double share = first_share(node, x, n);
    if (!(share >= 0.0)) { return std::nullopt; }
    if (choice < share) {
      choice = std::min(choice / share, 1.0 - 0x1p-53);
      index = node.first;
    } else {
      choice = std::min((choice - share) / (1.0 - share), 1.0 - 0x1p-53);
      index = node.first + 1;
    }
  }
  const Shape& shape = shapes_[nodes_[index].first];
  glm::dvec3 w{0.0};
  if (shape.flat()) {
    const auto& [a, b, c] = shape.corner;
    w = triangle_point(triangle_weights(u, v), a - x, b - x, c - x);
  } else {
    const glm::dvec3 d = shape.centre - x;
    const double r2 = glm::dot(d, d);
    const double sine2 = shape.radius * shape.radius / r2;
    const double angle = 2.0 * std::numbers::pi * v;
    const bool within = !(sine2 < 1.0);
    const double below = within ? 2.0 * u : u * sine2 / (1.0 + std::sqrt(1.0 - sine2));  // 1 - cosine, from the axis
    const glm::dvec3 axis = r2 > 0.0 ? d / std::sqrt(r2) : n;
    const double sine = std::sqrt(std::max(0.0, below * (2.0 - below)));
    const auto [s, t] = orthonormal(axis);
    w = sine * std::cos(angle) * s + sine * std::sin(angle) * t + (1.0 - below) * axis;
  }
  const double length = glm::length(w);
  if (!(length > 0.0)) { return std::nullopt; }
  w /= length;
  if (!(glm::dot(n, w) > 0.0)) { return std::nullopt; }
  const double found = density(x, n, w, index);
  if (!(found > 0.0)) { return std::nullopt; }
  return Sample{w, found};
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/audit/emitters.cpp>
#endif
