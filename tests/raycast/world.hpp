// SPDX-License-Identifier: MIT
#pragma once

// Random worlds with objects of every kind, places on their surfaces, and the law that all fast searches must repeat.

#include "support.hpp"

#include <raycast/objects/cone.hpp>
#include <raycast/objects/disk.hpp>
#include <raycast/objects/superquadric.hpp>
#include <raycast/objects/torus.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

using namespace raycast;

namespace test {

inline std::vector<Isa> instruction_sets() {
  std::vector<Isa> sets{Isa::portable};
  if (best_isa() >= Isa::avx2) { sets.push_back(Isa::avx2); }
  if (best_isa() >= Isa::avx512) { sets.push_back(Isa::avx512); }
  return sets;
}
inline bool by_law(const Scene& scene, const Segment& s, std::uint32_t source, std::uint32_t target) {
  for (std::uint32_t i = 0; i < scene.size(); ++i) {
    if (scene.occluded_by(i, s, source, target)) { return true; }
  }
  return false;
}
// Of the lanes that are set, those that are blocked.
inline std::uint32_t by_law(const Scene& scene, const Segments16& segments) {
  std::uint32_t blocked = 0;
  for (unsigned lane = 0; lane < 16; ++lane) {
    if ((segments.lanes >> lane & 1u) == 0) { continue; }
    blocked |= static_cast<std::uint32_t>(by_law(scene, segments.at(lane), segments.source[lane], segments.target[lane])) << lane;
  }
  return blocked;
}
inline void require_blocked(const Scene& scene, const Segments16& segments, std::uint32_t expected) {  // by sixteen and one by one
  REQUIRE(scene.occluded16(segments) == expected);
  for (unsigned lane = 0; lane < 16; ++lane) {
    if ((segments.lanes >> lane & 1u) == 0) { continue; }
    REQUIRE(scene.occluded(segments.at(lane), segments.source[lane], segments.target[lane]) == ((expected >> lane & 1u) != 0));
  }
}

// A place on some object's surface (the vertex or the middle of a face of its mesh), or a free point.
struct Place {
  dvec3 at{0.0};
  std::uint32_t owner = no_object, sheet = unknown_sheet;
};

struct Facet {
  std::uint32_t owner;
  Corners corners;
  std::uint32_t sheet;
};

struct World {
  std::vector<PlacedObject> objects;
  std::vector<Facet> faces;
};

// A convex room around most of the cube [-1, 1]^3, mapped by scale and shift.
inline PlacedObject convex_room(Random& random, double scale, const dvec3& shift) {
  Placement p{random.rotation() * scale, shift, true};
  switch (random.below(6)) {
    case 0:
      return placed(Sphere::make({0, 0, 0}, 1.5), p);
    case 1:
      return placed(Cylinder::make({0, 0, -1.2}, {0, 0, 2.4}, 1.3), p);
    case 2:
      return placed(Cone::make({0, 0, -1.2}, {0, 0, 3}, 1.8, random.below(2) ? 0.0 : 1.0), p);
    case 3:
      p.linear = p.linear * glm::dmat3(1, 0.2, 0, 0, 1.5, 0, 0.1, 0, -0.9);
      return placed(random.below(2) ? Made<Object>(Sphere::make({0, 0, 0}, 1.5))
                                    : Made<Object>(Superquadric::make({0, 0, 0}, {1.3, 1.2, 1.5}, 0.5, 0.5)),
                    p);
    default:
      return placed(BoxObject::make(shift - 1.05 * scale, shift + 1.05 * scale), room());
  }
}

// A room with objects of every kind, some of them touching, at any scale and any place.
inline World world(Random& random, int count, double scale, const dvec3& shift, bool with_room) {
  World w;
  const auto add = [&](const PlacedObject& object) {
    brep::Builder mesh;
    object.approximate(0.05 * scale, mesh);
    for (std::uint32_t f = 0; f < mesh.face_count(); f += 1 + mesh.face_count() / 40) {
      if (mesh.sheet(f) == brep::no_sheet) { continue; }
      Corners corners;
      for (const std::uint32_t v : mesh.corners(f)) { corners.push_back(mesh.position(v)); }
      w.faces.push_back({static_cast<std::uint32_t>(w.objects.size()), corners, mesh.sheet(f)});
    }
    w.objects.push_back(object);
  };
  if (with_room) { add(convex_room(random, scale, shift)); }
  const auto gutter = Mesh::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {1, 4, 5, 2}});
  const auto ball = mesh_of(*Sphere::make({0, 0, 0}, 0.8), 0.02);
  const auto star = Polygon::make({{0, 0, 0}, {1, -1, 0}, {0.5, 0, 0}, {1, 1, 0}, {-1, 0.2, 0}});
  const auto box_to_octahedron = [&] { return 0.001 * std::pow(2000.0, random.uniform(0, 1)); };  // exponents: powers of 2 000 to 1
  for (int i = 0; i < count; ++i) {
    const double size = 0.6 * scale / std::cbrt(static_cast<double>(count));
    dvec3 at = 0.9 * random.in_cube();
    if (i % 3 == 0) { at[static_cast<int>(random.below(3))] = random.below(2) ? 0.9 : -0.9; }
    Placement p{random.rotation() * (size * random.uniform(0.3, 1)), shift + scale * at, false};
    if (i % 5 == 0) { p.linear = p.linear * glm::dmat3(1, 0.2, 0, 0, 1.5, 0, 0.1, 0, -0.7); }
    switch (random.below(16)) {
      case 0:
        add(placed(Sphere::make(p.translation, size)));
        break;
      case 1:
        add(placed(Sphere::make({0, 0, 0}, 1), p));
        break;
      case 2:
        add(placed(BoxObject::make({-1, -0.5, -0.1}, {1, 0.5, 0.1}), p));
        break;
      case 3:
        add(placed(Cylinder::make({0, 0, 0}, {0, 0, 1}, 0.5), p));
        break;
      case 4:
        add(placed(Polygon::make(rectangle({-1, -1, 0}, {2, 0, 0}, {0, 1, 0})), p));
        break;
      case 5:
        add(placed(star, p));
        break;
      case 6:
        add(placed(gutter, p));
        break;
      case 7:
        add(placed(ball, p));
        break;
      case 8:
        add(placed(Disk::make({0.1, 0, 0}, random.direction(), 0.8), p));
        break;
      case 9:
        add(placed(Cone::make({0, 0, -0.5}, {0.1, 0, 1}, random.uniform(0.1, 0.6), random.below(2) ? 0.0 : random.uniform(0.1, 0.6)), p));
        break;
      case 10:
        add(placed(Torus::make({0, 0, 0}, random.direction(), 0.7, random.uniform(0.03, 0.6)), p));
        break;
      case 11:  // convex
        add(placed(Superquadric::make({0, 0, 0}, {1, 0.5, 0.7}, box_to_octahedron(), box_to_octahedron()), p));
        break;
      case 12:  // pinched
        add(placed(Superquadric::make({0, 0, 0}, {0.8, 1, 0.7}, random.uniform(0.3, 4), random.uniform(2, 6)), p));
        break;
      case 13:
        add(placed(Superquadric::make({0, 0, 0}, {0.8, 1, 0.7}, random.uniform(2, 4), 1), p));
        break;
      case 14:
        add(placed(Superquadric::make({0, 0, 0}, {0.3, 0.4, 0.3}, random.uniform(0.3, 3), random.uniform(0.3, 3), 2.2), p));
        break;
      default:
        add(placed(l_block(), p));
        break;
    }
  }
  return w;
}
inline Place place(Random& random, const World& w, double scale, const dvec3& shift) {
  if (random.below(6) == 0) { return {shift + scale * random.in_cube(random.below(8) ? 1.0 : 20.0)}; }
  const auto& [owner, corners, of_face] = w.faces[random.below(static_cast<std::uint32_t>(w.faces.size()))];
  const std::uint32_t sheet = random.below(3) ? of_face : unknown_sheet;
  if (random.below(12) == 0) { return {corners[0], owner, sheet}; }
  double sum = 0.0;
  dvec3 p{0.0};
  for (const dvec3& c : corners) {
    const double weight = random.uniform();
    p += weight * c, sum += weight;
  }
  return {p / sum, owner, sheet};
}

}  // namespace test
