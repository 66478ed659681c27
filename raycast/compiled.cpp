// SPDX-License-Identifier: MIT
#include <raycast/compiled.hpp>

#include <cstddef>
#include <cstdint>

#include <raycast/inline.hpp>

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
      return guards[i];
    case Kind::form:
      return forms[i].object;
    default:
      return others[i];
  }
}

HALFLIGHT_INLINE std::size_t Compiled::bytes() const {
  return nodes.capacity() * sizeof(Node) + triangles.capacity() * sizeof(FaceBlock<3>) + quads.capacity() * sizeof(FaceBlock<4>) +
         spheres.capacity() * sizeof(SphereBlock) + bodies.capacity() * sizeof(Body) + planes.capacity() * 16 +
         cylinders.capacity() * sizeof(CylinderShape) + forms.capacity() * sizeof(Form) +
         (guards.capacity() + others.capacity() + leaves.capacity() + rooms.capacity() + room_bodies.capacity()) * sizeof(std::uint32_t) +
         roles.capacity() + bounds.capacity() * sizeof(FloatBox);
}

HALFLIGHT_INLINE bool may_contain(const Compiled& scene, std::uint32_t owner, std::uint32_t object) {
  if (owner == 0xffffffffu || owner == object || scene.roles[owner] != Role::solid) { return false; }
  const FloatBox &a = scene.bounds[owner], &b = scene.bounds[object];
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.hi[k] < b.lo[k] || b.hi[k] < a.lo[k]) { return false; }
  }
  return true;
}

}  // namespace raycast
