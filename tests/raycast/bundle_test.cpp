// SPDX-License-Identifier: MIT
// The fast searches against the law they stand for: occluded_by() of every object, in double precision.

#include "support.hpp"

using namespace raycast;
using namespace test;

namespace {

std::vector<Isa> instruction_sets() {
  std::vector<Isa> sets{Isa::portable};
  if (best_isa() >= Isa::avx2) sets.push_back(Isa::avx2);
  if (best_isa() >= Isa::avx512) sets.push_back(Isa::avx512);
  return sets;
}
bool by_law(const Scene& scene, const Segment& s, std::uint32_t source, std::uint32_t target) {
  for (std::uint32_t i = 0; i < scene.size(); ++i)
    if (scene.occluded_by(i, s, source, target)) return true;
  return false;
}

// A place on some object's surface (the vertex or the middle of a face of its mesh), or a free point.
struct Place {
  dvec3 at{0.0};
  std::uint32_t owner = no_object;
};

struct World {
  std::vector<PlacedObject> objects;
  std::vector<std::pair<std::uint32_t, Corners>> faces;  // owner, corners
};

// A room with objects of every kind, some of them touching, at any scale and any place.
World world(Random& random, int count, double scale, const dvec3& shift, bool with_room) {
  World w;
  const auto add = [&](const PlacedObject& object) {
    brep::Builder mesh;
    object.approximate(0.05 * scale, mesh);
    for (std::uint32_t f = 0; f < mesh.face_count(); f += 1 + mesh.face_count() / 40) {
      if (mesh.sheet(f) == brep::no_sheet) continue;
      Corners corners;
      for (const std::uint32_t v : mesh.corners(f)) corners.push_back(mesh.position(v));
      w.faces.push_back({static_cast<std::uint32_t>(w.objects.size()), corners});
    }
    w.objects.push_back(object);
  };
  if (with_room) add(placed(BoxObject::make(shift - 1.05 * scale, shift + 1.05 * scale), room()));
  const auto gutter = Mesh::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {1, 4, 5, 2}});
  const auto ball = mesh_of(*Sphere::make({0, 0, 0}, 0.8), 0.02);
  const auto star = Polygon::make({{0, 0, 0}, {1, -1, 0}, {0.5, 0, 0}, {1, 1, 0}, {-1, 0.2, 0}});
  for (int i = 0; i < count; ++i) {
    const double size = 0.6 * scale / std::cbrt(static_cast<double>(count));
    dvec3 at = 0.9 * random.in_cube();
    if (i % 3 == 0) at[static_cast<int>(random.below(3))] = random.below(2) ? 0.9 : -0.9;
    Placement p{random.rotation() * (size * random.uniform(0.3, 1)), shift + scale * at, false};
    if (i % 5 == 0) p.linear = p.linear * glm::dmat3(1, 0.2, 0, 0, 1.5, 0, 0.1, 0, -0.7);
    switch (random.below(9)) {
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
      default:
        add(placed(l_block(), p));
        break;
    }
  }
  return w;
}
Place place(Random& random, const World& w, double scale, const dvec3& shift) {
  if (random.below(6) == 0) return {shift + scale * random.in_cube(random.below(8) ? 1.0 : 20.0)};
  const auto& [owner, corners] = w.faces[random.below(static_cast<std::uint32_t>(w.faces.size()))];
  if (random.below(12) == 0) return {corners[0], owner};
  double sum = 0.0;
  dvec3 p{0.0};
  for (const dvec3& c : corners) {
    const double weight = random.uniform();
    p += weight * c, sum += weight;
  }
  return {p / sum, owner};
}

}  // namespace

TEST_CASE("bundle = single = the law for every object, on every instruction set, over 16 decades") {
  SEEDED(random);
  std::size_t blocked = 0, all = 0;
  for (int turn = 0; turn < 60; ++turn) {
    const double scale = random.magnitude(8);
    const dvec3 shift = turn % 3 == 0 ? scale * random.magnitude(5) * random.in_cube() : scale * random.in_cube();
    const World w = world(random, turn % 4 == 0 ? 4 : turn % 4 == 1 ? 30 : 150, scale, shift, turn % 2);
    std::vector<Scene> scenes;
    for (const Isa isa : instruction_sets()) scenes.emplace_back(w.objects, isa);
    std::uint32_t hint = no_shape;
    for (int i = 0; i < 60; ++i) {
      Segments16 segments;
      const Place a = place(random, w, scale, shift), b = place(random, w, scale, shift);
      const double spread = i % 3 == 0 ? 0.0 : 0.05 * scale;  // a coherent bundle, or sixteen different segments
      for (unsigned lane = 0; lane < 16; ++lane) {
        if (i % 7 == 0 && random.below(3) == 0) continue;
        Place p = a, q = b;
        if (i % 3 == 0) p = place(random, w, scale, shift), q = place(random, w, scale, shift);
        Segment s = between(p.at + spread * random.in_cube() * (i % 2 ? 0.0 : 1.0), q.at + spread * random.in_cube() * (i % 2 ? 0.0 : 1.0));
        if (random.below(20) == 0) s.direction[static_cast<int>(random.below(3))] = random.below(2) ? 0.0 : -0.0;
        if (random.below(50) == 0) s.direction = dvec3(0.0);
        if (random.below(50) == 0) s.direction *= 1e7;
        if (random.below(50) == 0) s.direction *= 1e-12;
        segments.set(lane, s, p.owner, q.owner);
      }
      std::uint32_t expected = 0;
      for (unsigned lane = 0; lane < 16; ++lane)
        if (segments.lanes >> lane & 1u)
          expected |= static_cast<std::uint32_t>(by_law(scenes[0], segments.at(lane), segments.source[lane], segments.target[lane]))
                      << lane;
      for (std::size_t k = 0; k < scenes.size(); ++k) {
        INFO("turn " << turn << " bundle " << i << " set " << k);
        REQUIRE(scenes[k].occluded16(segments) == expected);
        REQUIRE(scenes[k].occluded16(segments, hint) == expected);
        for (unsigned lane = 0; lane < 16; ++lane)
          if (segments.lanes >> lane & 1u)
            REQUIRE(scenes[k].occluded(segments.at(lane), segments.source[lane], segments.target[lane]) == ((expected >> lane & 1u) != 0));
      }
      blocked += static_cast<std::size_t>(std::popcount(expected));
      all += static_cast<std::size_t>(std::popcount(segments.lanes));
    }
  }
  CHECK(blocked > all / 10);
  CHECK(blocked < all - all / 10);
}
