// SPDX-License-Identifier: MIT
// Rooms that are not convex, as meshes: what their faces in the fast lanes say is what the spans of the whole room say.

#include "world.hpp"

#include <raycast/compile.hpp>

#include <memory>
#include <numbers>
#include <utility>

using namespace raycast;
using namespace test;

namespace {

using Faces = std::vector<std::vector<std::uint32_t>>;

// The same object, of which the fast lanes know nothing.
class ByLaw final : public Object {
 public:
  explicit ByLaw(std::shared_ptr<const Object> object) : object_(std::move(object)) {}
  [[nodiscard]] Box bounds() const override { return object_->bounds(); }
  void spans(const Segment& line, Spans& out) const override { object_->spans(line, out); }
  void approximate(double tolerance, brep::Builder& out) const override { object_->approximate(tolerance, out); }
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const dvec3& p) const override { return object_->project(sheet, p); }
  [[nodiscard]] bool flat() const override { return object_->flat(); }
  [[nodiscard]] bool solid() const override { return object_->solid(); }
  [[nodiscard]] std::uint32_t sheet_count() const override { return object_->sheet_count(); }
  [[nodiscard]] double slack() const override { return object_->slack(); }

 private:
  std::shared_ptr<const Object> object_;
};

// A prism over an outline of n corners around the origin that goes in and out, z from -h to h.
void add_prism(Random& random, Corners& positions, Faces& faces, double size, double h, bool hole) {
  const std::uint32_t n = 4 + random.below(9), first = static_cast<std::uint32_t>(positions.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n, r = size * random.uniform(0.3, 1.0);
    positions.push_back({r * std::cos(angle), r * std::sin(angle), -h});
  }
  for (std::uint32_t i = 0; i < n; ++i) { positions.push_back(positions[first + i] + dvec3{0, 0, 2 * h}); }
  Faces added(2);
  for (std::uint32_t i = 0; i < n; ++i) {
    added[0].push_back(first + n - 1 - i);
    added[1].push_back(first + n + i);
    added.push_back({first + i, first + (i + 1) % n, first + n + (i + 1) % n, first + n + i});
  }
  for (auto& face : added) {
    if (hole) { std::reverse(face.begin(), face.end()); }
    faces.push_back(face);
  }
}

// A face of n corners around the axis z in two, each with notches into which the other one reaches: their hulls overlap.
void split_by_comb(Corners& positions, Faces& faces, std::size_t f) {
  const std::vector<std::uint32_t> face = faces[f];
  const std::size_t half = face.size() / 2;
  const dvec3 along = glm::normalize(positions[face[0]] * dvec3{1, 1, 0}), across{-along.y, along.x, 0};
  std::vector<std::uint32_t> comb;  // from corner 0 to the one opposite
  for (const auto& [s, w] : {std::pair{0.17, 0.08}, {0.13, -0.08}, {0.09, 0.08}, {0.05, -0.08}}) {
    comb.push_back(static_cast<std::uint32_t>(positions.size()));
    positions.push_back(s * along + w * across + dvec3{0, 0, positions[face[0]].z});
  }
  const auto middle = face.begin() + static_cast<std::ptrdiff_t>(half);
  faces[f].assign(face.begin(), middle + 1);
  faces[f].insert(faces[f].end(), comb.rbegin(), comb.rend());
  faces.emplace_back(middle, face.end());
  faces.back().push_back(face[0]);
  faces.back().insert(faces.back().end(), comb.begin(), comb.end());
}

// A ball whose corners are moved out and in.
void add_cave(Random& random, Corners& positions, Faces& faces) {
  brep::Builder ball;
  Sphere::make({0, 0, 0}, 1.0)->approximate(std::pow(10.0, random.uniform(-2.5, -1)), ball);
  for (std::uint32_t v = 0; v < ball.vertex_count(); ++v) { positions.push_back(ball.position(v) * random.uniform(0.6, 1.0)); }
  for (std::uint32_t f = 0; f < ball.face_count(); ++f) {
    const auto corners = ball.corners(f);
    for (std::size_t i = 2; i < corners.size(); ++i) { faces.push_back({corners[0], corners[i - 1], corners[i]}); }
  }
}

void add_box(const dvec3& lo, const dvec3& hi, Corners& positions, Faces& faces) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  for (std::uint32_t i = 0; i < 8; ++i) { positions.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z}); }
  for (const auto& face : Faces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    faces.push_back(face);
    for (std::uint32_t& v : faces.back()) { v += first; }
  }
}

enum class Shape { prism, combs, pillar, cave, two_rooms, crossing };
Made<Mesh> any_room(Random& random, Shape shape) {
  Corners positions;
  Faces faces;
  switch (shape) {
    case Shape::prism:
      add_prism(random, positions, faces, 1.0, random.uniform(0.1, 1.0), false);
      break;
    case Shape::combs:
      add_prism(random, positions, faces, 1.0, random.uniform(0.1, 1.0), false);
      split_by_comb(positions, faces, 0);
      split_by_comb(positions, faces, 1);
      break;
    case Shape::pillar:  // in the room; its faces look into the air around it
      add_prism(random, positions, faces, 1.0, 0.5, false);
      add_prism(random, positions, faces, 0.2, 0.4, true);
      break;
    case Shape::cave:
      add_cave(random, positions, faces);
      break;
    case Shape::two_rooms:
      add_box({-1, -1, -1}, {-0.1, 1, 1}, positions, faces);
      add_box({0.1, -1, -1}, {1, 1, 1}, positions, faces);
      break;
    case Shape::crossing:  // two that overlap: a wall of the one within the other is none
      add_box({-1, -1, -1}, {0.2, 1, 1}, positions, faces);
      add_box({-0.2, -0.7, -0.8}, {1, 0.9, 0.6}, positions, faces);
      break;
  }
  return Mesh::make(positions, faces);
}

bool kept_as_faces(const PlacedObject& room) {
  Compiled compiled;
  Compiler compiler(compiled, room.bounds(), 1e-12 * room.bounds().diameter());
  compiler.add(0, room, {}, dvec3{0.0});
  compiler.finish(64);
  return compiled.face_rooms.size() == 1;
}

// Things around the origin, and a room as the last object: in the second scene it is unknown to the fast lanes.
struct Furnished {
  World world;
  std::vector<PlacedObject> by_law;
  double scale;
  dvec3 shift;
};
Furnished furnished(Random& random, Shape shape) {
  const double scale = random.magnitude(6);
  Furnished result{{}, {}, scale, scale * random.magnitude(1) * random.in_cube()};
  glm::dmat3 linear = random.rotation() * scale;
  if (random.below(3) == 0) { linear = linear * glm::dmat3(1, 0.2, 0, 0, 1.5, 0, 0.1, 0, -0.7); }  // mirrored, too
  const Placement place{linear, result.shift, true};
  const auto mesh = any_room(random, shape);
  const PlacedObject room = placed(mesh, place);
  CHECK(kept_as_faces(room) == (shape != Shape::crossing && !room.convex()));
  result.world = world(random, static_cast<int>(random.below(7)), 0.6 * scale, result.shift, false);
  const auto owner = static_cast<std::uint32_t>(result.world.objects.size());
  brep::Builder walls;
  room.approximate(0.0, walls);
  for (std::uint32_t f = 0; f < walls.face_count(); ++f) {
    Corners corners;
    for (const std::uint32_t v : walls.corners(f)) { corners.push_back(walls.position(v)); }
    result.world.faces.push_back({owner, corners, walls.sheet(f)});
  }
  result.by_law = result.world.objects;
  result.by_law.push_back(placed(Made<ByLaw>(std::make_shared<const ByLaw>(mesh.object)), place));
  result.world.objects.push_back(room);
  return result;
}
Shape any_shape(Random& random) { return static_cast<Shape>(random.below(6)); }

// On a surface, near one and owned by nothing, or anywhere; in a room that is not convex it is not known on which sheet a corner lies.
Place end(Random& random, const Furnished& f) {
  Place p = place(random, f.world, f.scale, f.shift);
  for (const Facet& face : f.world.faces) {
    if (std::find(face.corners.begin(), face.corners.end(), p.at) != face.corners.end()) { p.sheet = unknown_sheet; }
  }
  if (random.below(3)) { return p; }
  return Place{p.at + f.scale * std::pow(10.0, random.uniform(-7, 0)) * random.in_cube()};
}

}  // namespace

TEST_CASE("a room of faces blocks what the spans of the whole room block: bundle = single = the law") {
  SEEDED(random);
  std::size_t blocked = 0, all = 0;
  for (int turn = 0; turn < 60; ++turn) {
    const Furnished f = furnished(random, any_shape(random));
    std::vector<Scene> scenes;
    for (const Isa isa : instruction_sets()) { scenes.emplace_back(f.world.objects, isa); }
    for (int i = 0; i < 30; ++i) {
      Segments16 segments;
      for (unsigned lane = 0; lane < 16; ++lane) {
        const Place p = end(random, f), q = end(random, f);
        segments.set(lane, between(p.at, q.at), p.owner, q.owner, p.sheet, q.sheet);
      }
      const std::uint32_t expected = by_law(scenes[0], segments);
      for (const Scene& scene : scenes) {
        INFO("turn " << turn << " bundle " << i);
        require_blocked(scene, segments, expected);
      }
      blocked += static_cast<std::size_t>(std::popcount(expected));
      all += 16;
    }
  }
  CHECK(blocked > all / 10);
  CHECK(blocked < all - all / 10);
}

TEST_CASE("in a room of faces a ray meets first what it meets where the spans of the room are asked, and the same is covered") {
  SEEDED(random);
  int walls = 0, things = 0, none = 0;
  for (int turn = 0; turn < 60; ++turn) {
    const Furnished f = furnished(random, any_shape(random));
    const Scene plain(f.by_law);
    std::vector<Scene> scenes;
    for (const Isa isa : instruction_sets()) { scenes.emplace_back(f.world.objects, isa); }
    const auto room = static_cast<std::uint32_t>(f.by_law.size() - 1);
    for (int i = 0; i < 30; ++i) {
      Segments16 rays;
      for (unsigned lane = 0; lane < 16; ++lane) {
        const Place p = end(random, f), q = end(random, f);
        rays.set(lane, between(p.at, q.at), p.owner, no_object, p.sheet);
      }
      for (const Scene& scene : scenes) {
        const Hits16 hits = scene.closest16(rays);
        for (unsigned lane = 0; lane < 16; ++lane) {
          INFO("turn " << turn << " bundle " << i << " lane " << lane);
          const Segment ray = rays.at(lane);
          const std::optional<Hit> expected = plain.closest(ray, rays.source[lane], rays.source_sheet[lane]);
          const std::optional<Hit> alone = scene.closest(ray, rays.source[lane], rays.source_sheet[lane]);
          REQUIRE(alone.has_value() == expected.has_value());
          REQUIRE((hits.met >> lane & 1u) == static_cast<std::uint32_t>(expected.has_value()));
          if (!expected) {
            ++none;
            continue;
          }
          for (const Hit& hit : {*alone, hits.hit[lane]}) {
            REQUIRE(hit.t == expected->t);
            REQUIRE(hit.object == expected->object);
            REQUIRE(hit.sheet == expected->sheet);
            REQUIRE(hit.front == expected->front);
          }
          (expected->object == room ? walls : things) += 1;
        }
      }
      const Place p = end(random, f);
      const dvec3 n = random.direction();
      REQUIRE(scenes[0].covered(p.at, n, p.owner) == plain.covered(p.at, n, p.owner));
    }
  }
  CHECK(walls > 1000);
  CHECK(things > 1000);
  CHECK(none > 100);
}

TEST_CASE("patches that see each other in a room of faces: their pair is clear without a ray, and no list has less than the law") {
  SEEDED(random);
  std::size_t clear = 0, free = 0;
  for (int turn = 0; turn < 60; ++turn) {
    const Shape shape = any_shape(random);
    const Furnished f = furnished(random, shape);
    const Scene scene(f.world.objects);
    for (int i = 0; i < 60; ++i) {
      const Facet &a = f.world.faces[random.below(static_cast<std::uint32_t>(f.world.faces.size()))],
                  &b = f.world.faces[random.below(static_cast<std::uint32_t>(f.world.faces.size()))];
      const auto part = [&](const Facet& face) {  // a small triangle of the face
        const dvec3 &p = face.corners[0], &q = face.corners[1], &r = face.corners[2];
        return Corners{p + 0.2 * (q - p) + 0.2 * (r - p), p + 0.4 * (q - p) + 0.2 * (r - p), p + 0.2 * (q - p) + 0.4 * (r - p)};
      };
      if (a.corners.size() > 4 || b.corners.size() > 4) { continue; }  // an outline with notches: these may lie beside it
      const Corners p = part(a), q = part(b);
      const OccluderList list = scene.occluders({p, a.owner, 0.0, a.sheet}, {q, b.owner, 0.0, b.sheet});
      Segments16 segments;
      std::uint32_t hint = no_shape;
      for (unsigned lane = 0; lane < 16; ++lane) {
        const auto within = [&](const Corners& c) {
          const double s = random.uniform(), t = random.uniform() * (1 - s);
          return c[0] + s * (c[1] - c[0]) + t * (c[2] - c[0]);
        };
        segments.set(lane, between(within(p), within(q)), a.owner, b.owner, a.sheet, b.sheet);
      }
      const std::uint32_t expected = by_law(scene, segments);
      if (list.clear()) { REQUIRE(expected == 0); }
      REQUIRE(scene.occluded16(segments, list, hint) == expected);
      if (shape == Shape::crossing) { continue; }  // not kept as faces: double precision decides
      clear += list.clear();
      free += expected == 0;
    }
  }
  CHECK(4 * clear > free);
}
