// SPDX-License-Identifier: MIT

// The cost of searching the first hit of a ray (Scene::ray_work, walk_work).

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/compiled.hpp>
#include <raycast/line_query.hpp>
#include <raycast/ray.hpp>
#include <raycast/scene.hpp>
#include <raycast/transform.hpp>
#include <raycast/walk.hpp>

namespace raycast {

HALFLIGHT_INLINE double Scene::ray_work() const {
  const auto surface = [](const Box& box) {
    const glm::dvec3 d = box.hi - box.lo;
    return d.x * d.y + d.y * d.z + d.z * d.x;
  };
  const auto key = [](const PlacedObject& object) {
    const Box box = object.bounds();
    return std::array<double, 6>{box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z};
  };
  std::map<std::array<double, 6>, std::uint32_t> at_place;
  for (std::uint32_t i = 0; i < size(); ++i) {
    if (!left_out_[i]) { ++at_place[key(objects_[i])]; }
  }
  const double whole = surface(near_);
  double work = 1.0;
  for (std::uint32_t i = 0; i < size(); ++i) {
    const PlacedObject& object = objects_[i];
    if (left_out_[i] || is_far(i)) { continue; }
    // Faces that the fast search decides by itself cost next to nothing. Coincident faces, as of duplicates, need double precision.
    if (object.flat() && (!object.inside() || compiled_.is_face_room(i)) && at_place[key(object)] == 1) { continue; }
    work += object.object().work() * (whole > 0.0 && !object.inside() ? std::min(1.0, surface(object.bounds()) / whole) : 1.0);
  }
  return work;
}

HALFLIGHT_INLINE double Scene::walk_work() const {
  // Measured on six scenes with 2 to 22 nodes per ray: a path's ray takes 0.3 to 1 us among few polygons, plus 0.13 us per node.
  constexpr double few = 4.0, nodes_a_ray = 8.0;
  return std::max(0.0, compiled_.walk_work() - few) / nodes_a_ray;
}

HALFLIGHT_INLINE double Scene::ray_work(const Segment& ray) const {
  // Microseconds, fitted to paths in fifteen scenes with 0.23 to 2.1 us per ray; accurate to a factor of 2. `law`: of one unit of
  // Object::work(). A body whose bounds are met is clipped by its planes, and mostly the law is evaluated, too.
  constexpr double setup = 0.1, node = 0.03, faces = 0.04, bounds = 0.03, planes = 0.25, law = 0.4;
  double work = setup;
  for (const std::uint32_t room : compiled_.rooms) { work += law * objects_[room].object().work(); }
  if (compiled_.nodes.empty() || !has_line(ray)) { return work; }
  struct Open {
    std::uint32_t child;
  };
  const SlabTest slabs(Segment{compiled_.local(ray.origin), ray.direction * compiled_.scale});
  const auto leaf = [&](const Open& at) {
    const Kind kind = leaf_kind(at.child);
    if (kind == Kind::triangle || kind == Kind::quad) {
      work += faces;
      return false;
    }
    for (std::uint32_t j = 0; kind != Kind::guard && j < leaf_count(at.child); ++j) {
      const std::uint32_t object = compiled_.object_of(shape_id(kind, leaf_first(at.child) + j));
      const FloatBox& box = compiled_.bounds[object];
      work += bounds;
      double entry = 0.0;
      if (slabs({{box.lo[0], box.lo[1], box.lo[2]}, {box.hi[0], box.hi[1], box.hi[2]}}, 0.0, 1.0, entry)) {
        work += kind == Kind::body ? planes : law * objects_[object].object().work();
      }
    }
    return false;
  };
  const auto inner = [&](const Open& at, auto& put_off) {
    const Node& children = compiled_.nodes[at.child];
    work += node;
    for (std::size_t i = 0; i < Compiled::fan_out; ++i) {
      const Box box{{children.bound[0][i], children.bound[1][i], children.bound[2][i]},
                    {children.bound[3][i], children.bound[4][i], children.bound[5][i]}};
      double entry = 0.0;
      if (!box.empty() && slabs(box, 0.0, 1.0, entry)) { put_off.push(Open{children.child[i]}); }
    }
    return false;
  };
  static_cast<void>(portable::walk(compiled_, Open{0}, everything, leaf, inner));
  return work;
}

}  // namespace raycast
