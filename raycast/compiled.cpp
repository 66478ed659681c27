// SPDX-License-Identifier: MIT
#include <raycast/compiled.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include <brep/inline.hpp>

#include <raycast/bundle.hpp>
#include <raycast/object.hpp>

namespace raycast {

HALFLIGHT_INLINE std::uint32_t Compiled::object_of(std::uint32_t shape) const {
  const std::uint32_t i = index_of(shape);
  switch (kind_of(shape)) {
    case Kind::triangle:
      return triangles[i / 8].object[i % 8];
    case Kind::quad:
      return quads[i / 8].object[i % 8];
    case Kind::sphere:
      return spheres[i / 8].object[i % 8];
    case Kind::body:
      return bodies[i].object;
    case Kind::cylinder:
      return cylinders[i].object;
    case Kind::guard:
      return guards[i].object;
    case Kind::form:
      return forms[i].object;
    default:
      return others[i];
  }
}

HALFLIGHT_INLINE std::size_t Compiled::bytes() const {
  const auto cells = [](std::size_t sum, const Guard& guard) { return sum + guard.air.bytes(); };
  return nodes.capacity() * sizeof(Node) + triangles.capacity() * sizeof(FaceBlock<3>) + quads.capacity() * sizeof(FaceBlock<4>) +
         spheres.capacity() * sizeof(SphereBlock) + bodies.capacity() * sizeof(Body) + planes.capacity() * 16 +
         cylinders.capacity() * sizeof(CylinderShape) + forms.capacity() * sizeof(Form) +
         std::accumulate(guards.begin(), guards.end(), guards.capacity() * sizeof(Guard), cells) +
         std::accumulate(face_rooms.begin(), face_rooms.end(), face_rooms.capacity() * sizeof(Guard), cells) +
         (others.capacity() + leaves.capacity() + rooms.capacity() + room_bodies.capacity()) * sizeof(std::uint32_t) +
         (first_sheet.capacity() + 4 * sheets.capacity()) * sizeof(std::uint32_t) + roles.capacity() + bounds.capacity() * sizeof(FloatBox);
}

HALFLIGHT_INLINE double Compiled::walk_work() const {
  const auto leaf_work = [&](std::uint32_t leaf) {
    const std::uint32_t first = leaf_first(leaf), count = leaf_count(leaf);
    switch (leaf_kind(leaf)) {
      case Kind::body: {
        double planes_there = 0.0;
        for (std::uint32_t j = first; j < first + count; ++j) { planes_there += bodies[j].count; }
        return planes_there / 4.0;  // the planes are processed one by one, for entry and exit
      }
      case Kind::guard:
        return 0.0;
      case Kind::cylinder:
      case Kind::form:
      case Kind::other:
        return 2.0 * count;
      default:
        return 1.0;
    }
  };
  FloatBox whole;
  double sum = 0.0;
  for (const Node& node : nodes) {
    for (std::size_t c = 0; c < fan_out; ++c) {
      FloatBox box;
      for (std::size_t k = 0; k < 3; ++k) { box.lo[k] = node.bound[k][c], box.hi[k] = node.bound[k + 3][c]; }
      if (&node == &nodes.front()) { whole.extend(box); }
      const auto area = static_cast<double>(box.half_area());
      if (area > 0.0 && std::isfinite(area)) { sum += area * (raycast::is_leaf(node.child[c]) ? leaf_work(node.child[c]) : 1.0); }
    }
  }
  const auto all = static_cast<double>(whole.half_area());
  return all > 0.0 && std::isfinite(all) ? sum / all : 0.0;
}

HALFLIGHT_INLINE bool leaves_at_once(const Compiled& scene, std::uint32_t owner, std::uint32_t sheet, const float (&to)[3], float length) {
  if (sheet == unknown_sheet || scene.first_sheet[owner] == no_shape) { return false; }
  const std::array<float, 4>& plane = scene.sheets[scene.first_sheet[owner] + sheet];
  const float height = plane[0] * to[0] + plane[1] * to[1] + plane[2] * to[2] + plane[3];
  // A skin is at most (margin - eps_height) / 4, and the path through it is at most 2 length / height times as long.
  constexpr auto rounding = static_cast<float>(eps_height);
  return height > 2.0f * scene.margin && (scene.margin - rounding) * length <= rounding * height;
}

HALFLIGHT_INLINE bool may_contain(const Compiled& scene, std::uint32_t owner, std::uint32_t object) {
  if (owner == no_object || owner == object || scene.roles[owner] != Role::solid) { return false; }
  const FloatBox &a = scene.bounds[owner], &b = scene.bounds[object];
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.hi[k] < b.lo[k] || b.hi[k] < a.lo[k]) { return false; }
  }
  return true;
}

}  // namespace raycast
