// SPDX-License-Identifier: MIT
#pragma once

// The single-precision form of a scene for the fast code: shapes in arrays by kind, and a tree whose nodes have eight children.
//
// Objects far away from all others are not in it (far_objects.hpp). Coordinates are relative to the middle of the rest, the scene in what
// follows, and scaled by a power of two, so that it lies in [-1,1]^3; nothing below depends on the size or position of the scene. Segments
// may extend slightly beyond it (to |x| <= 1.5; longer ones are clipped, bundle.hpp).
//
// The error bound: `margin` = eps_height (tolerances.hpp) plus the skins of scene.hpp. A decision whose distance from its limit exceeds
// the margin is the same as in double precision; the others are left to double precision.
//
// Boxes of nodes are grown by the margin and rounded outwards, so no node with a shape that may be met is missed.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/air_cells.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

// The kinds of shapes. triangle, quad: convex polygons of three or four corners; body: a convex solid bounded by planes; guard: the
// bounds of an object whose faces are stored; form: a shape with a formula in its own coordinates; other: the bounds of an object that is
// tested through its spans.
enum class Kind : std::uint32_t { triangle, quad, sphere, body, cylinder, guard, other, form };

// The id of a shape: its kind and its index among its kind.
[[nodiscard]] constexpr std::uint32_t shape_id(Kind kind, std::uint32_t index) { return static_cast<std::uint32_t>(kind) << 29 | index; }
[[nodiscard]] constexpr Kind kind_of(std::uint32_t shape) { return static_cast<Kind>(shape >> 29); }
[[nodiscard]] constexpr std::uint32_t index_of(std::uint32_t shape) { return shape & 0x1fffffffu; }
inline constexpr std::uint32_t no_shape = 0xffffffff;

// Eight faces as structure of arrays. Row 0 is the plane: height above the front; the other rows are the edges: distance into the polygon.
template <int Edges>
struct alignas(64) FaceBlock {
  float row[Edges + 1][4][8];
  std::uint32_t object[8], face[8], sheet[8];  // an unused place has no_object and heights of 1 everywhere, which nothing crosses
};
struct alignas(64) SphereBlock {
  float centre[3][8], radius[8];
  std::uint32_t object[8];
};
struct Body {
  std::uint32_t first, count, object;  // planes: heights above them are outside
};
struct CylinderShape {
  float base[3], axis[3], height, radius;
  std::uint32_t object;
};

struct Guard {
  std::uint32_t object;
  AirCells air;  // for a solid
};

// A shape about the origin of its own coordinates, with the affine map into them. `slop`: error of a point's coordinates there, that is,
// the margin in units of the shape. With p, q:
//   disk      z = 0, |x, y| <= 1
//   cone      0 <= z <= 1, |x, y| <= p + q z
//   convex    G(A(x, y), z) <= 1 with the gauges A = (|x|^p + |y|^p)^(1/p) and G of q; p, q >= 1
//   concave   G(|A(x, y) - ring|, z) <= 1: any exponents; tori, too
enum class FormKind : std::uint32_t { disk, cone, convex, concave };
struct Form {
  float map[3][4] = {}, slop[3] = {}, p = 0.0f, q = 0.0f, ring = 0.0f;
  float eps = 0.0f;  // relative error of the computed G (forms.inc)
  FormKind kind;
  std::uint32_t object = 0;
};

struct alignas(64) Node {
  float bound[6][8];       // lo x y z and hi x y z of the eight children; unused ones have lo = inf, hi = -inf
  std::uint32_t child[8];  // a node, or a leaf: bit 31, kind, count - 1 (3 bits), index of its first shape among its kind (25 bits)
};
[[nodiscard]] constexpr std::uint32_t leaf_of(Kind kind, std::uint32_t count, std::uint32_t first) {
  return 0x80000000u | static_cast<std::uint32_t>(kind) << 28 | (count - 1) << 25 | first;
}
[[nodiscard]] constexpr bool is_leaf(std::uint32_t child) { return child >> 31; }
[[nodiscard]] constexpr Kind leaf_kind(std::uint32_t child) { return static_cast<Kind>(child >> 28 & 7u); }
[[nodiscard]] constexpr std::uint32_t leaf_count(std::uint32_t child) { return (child >> 25 & 7u) + 1; }
[[nodiscard]] constexpr std::uint32_t leaf_first(std::uint32_t child) { return child & 0x1ffffffu; }

// How a face of an object blocks: a polygon never blocks its owner; on an open surface every crossing counts by itself; on a solid's
// surface crossings are paired to spans.
enum class Role : std::uint8_t { polygon, surface, solid };

struct FloatBox {
  std::array<float, 3> lo{no_bound, no_bound, no_bound}, hi{-no_bound, -no_bound, -no_bound};
  void extend(const FloatBox& b) {
    for (std::size_t k = 0; k < 3; ++k) { lo[k] = std::min(lo[k], b.lo[k]), hi[k] = std::max(hi[k], b.hi[k]); }
  }
  [[nodiscard]] float half_area() const {
    const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x < 0.0f ? 0.0f : x * y + y * z + z * x;
  }
};

struct Compiled {
  static constexpr std::size_t fan_out = 8;

  glm::dvec3 centre{0.0};
  double scale = 1.0;
  float margin = static_cast<float>(eps_height);
  std::vector<Node> nodes;  // the root comes first; empty without shapes
  std::vector<FaceBlock<3>> triangles;
  std::vector<FaceBlock<4>> quads;
  std::vector<SphereBlock> spheres;
  std::vector<Body> bodies;
  std::vector<std::array<float, 4>> planes;
  std::vector<CylinderShape> cylinders;
  std::vector<Form> forms;
  std::vector<Guard> guards;
  std::vector<std::uint32_t> others;  // object numbers
  std::vector<std::uint32_t> leaves;  // if there are few shapes, occlusion is a loop over these leaves, which store their shapes separately
  std::vector<Role> roles;            // by object
  std::vector<FloatBox> bounds;       // by object, grown by the margin; unbounded for a room
  std::vector<Guard> face_rooms;      // rooms whose faces are stored
  std::vector<std::uint32_t> rooms;   // all other rooms
  std::vector<std::uint32_t> room_bodies;    // by room: its convex body, or no_shape
  std::vector<std::array<float, 4>> sheets;  // planes of the sheets of flat solids: heights in the air
  std::vector<std::uint32_t> first_sheet;    // by object: index into `sheets`, or no_shape

  [[nodiscard]] bool few() const { return nodes.empty() || !leaves.empty(); }
  [[nodiscard]] static bool is_leaf(std::uint32_t child) { return raycast::is_leaf(child); }
  [[nodiscard]] glm::dvec3 local(const glm::dvec3& p) const { return (p - centre) * scale; }
  [[nodiscard]] std::uint32_t object_of(std::uint32_t shape) const;
  [[nodiscard]] bool is_face_room(std::uint32_t object) const {
    return std::any_of(face_rooms.begin(), face_rooms.end(), [&](const Guard& room) { return room.object == object; });
  }
  [[nodiscard]] std::size_t bytes() const;
  // Expected work of a ray through the whole tree without an end: the nodes that it opens plus the work in their leaves, where eight
  // faces or spheres count as one node. The probability of meeting a node is the ratio of its surface to that of the whole (MacDonald and
  // Booth 1990).
  [[nodiscard]] double walk_work() const;
};

// Does a segment of this length that begins on a sheet of its owner and ends at `to` leave the owner at once? Then its part inside the
// owner, up to skins, is shorter than eps_height, and no shape met deeper than the margin lies in that part.
[[nodiscard]] bool leaves_at_once(const Compiled& scene, std::uint32_t owner, std::uint32_t sheet, const float (&to)[3], float length);

// May a span of the object lie within the solid that owns an end of a segment? Not if their bounds are disjoint.
[[nodiscard]] bool may_contain(const Compiled& scene, std::uint32_t owner, std::uint32_t object);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/compiled.cpp>
#endif
