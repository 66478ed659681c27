// SPDX-License-Identifier: MIT
#pragma once

// What the fast lanes see of a scene: shapes in single precision, arrays by kind, and a tree whose nodes have eight children.
//
// Coordinates are moved to the middle of the scene and scaled by a power of two, so that the scene lies in [-1,1]^3; nothing below
// depends on the size or the place of the scene. Segments may leave it a little (to |x| <= 1.5; what is longer is clipped, bundle.hpp).
//
// The error bound: `margin` = eps_height (tolerances.hpp) plus the skins of scene.hpp. What lies farther than this from the limit of a
// decision is decided as the double-precision reference decides it; what lies nearer is not decided here but there.
//
// Boxes of nodes are grown by the margin and rounded outwards; so a node is never missed for a shape that could be met.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/air_cells.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

// The kinds of shapes. faces: convex polygons of three or four corners; body: a convex solid behind planes; guard: the bounds of an object
// that is kept as faces; form: a shape with a formula in coordinates of its own; other: bounds of an object that is asked through its
// spans.
enum class Kind : std::uint32_t { triangle, quad, sphere, body, cylinder, guard, other, form };

// A shape's name: its kind and its index among its kind.
[[nodiscard]] constexpr std::uint32_t shape_id(Kind kind, std::uint32_t index) { return static_cast<std::uint32_t>(kind) << 29 | index; }
[[nodiscard]] constexpr Kind kind_of(std::uint32_t shape) { return static_cast<Kind>(shape >> 29); }
[[nodiscard]] constexpr std::uint32_t index_of(std::uint32_t shape) { return shape & 0x1fffffffu; }
inline constexpr std::uint32_t no_shape = 0xffffffff;

// Eight faces side by side. Row 0 is the plane: height above the front; rows 1.. are the edges: distance into the polygon.
template <int Edges>
struct alignas(64) FaceBlock {
  float row[Edges + 1][4][8];
  std::uint32_t object[8], face[8], sheet[8];  // of an unused place: no_object, and heights of 1 everywhere, which nothing crosses
};
struct alignas(64) SphereBlock {
  float centre[3][8], radius[8];
  std::uint32_t object[8];
};
struct Body {
  std::uint32_t first, count, object;  // planes: heights outside
};
struct CylinderShape {
  float base[3], axis[3], height, radius;
  std::uint32_t object;
};

struct Guard {
  std::uint32_t object;
  AirCells air;  // of a solid
};

// A shape about the origin of its own coordinates, and the affine map into them. `slop` bounds how far a point's coordinates are off there:
// the margin in the units of the shape. With p, q:
//   disk      z = 0, |x, y| <= 1
//   cone      0 <= z <= 1, |x, y| <= p + q z
//   convex    G(A(x, y), z) <= 1 with the gauges A = (|x|^p + |y|^p)^(1/p) and G of q; p, q >= 1
//   concave   G(|A(x, y) - ring|, z) <= 1: any exponents; tori, too
enum class FormKind : std::uint32_t { disk, cone, convex, concave };
struct Form {
  float map[3][4], slop[3], p, q, ring;
  float eps;  // relative error of G as it is computed (forms.inc)
  FormKind kind;
  std::uint32_t object;
};

struct alignas(64) Node {
  float bound[6][8];       // lo x y z, hi x y z of the eight children; an unused one has lo = inf, hi = -inf
  std::uint32_t child[8];  // a node, or a leaf: bit 31, kind, count - 1 (3 bits), index of the first shape (25 bits) among its kind
};
[[nodiscard]] constexpr std::uint32_t leaf_of(Kind kind, std::uint32_t count, std::uint32_t first) {
  return 0x80000000u | static_cast<std::uint32_t>(kind) << 28 | (count - 1) << 25 | first;
}
[[nodiscard]] constexpr bool is_leaf(std::uint32_t child) { return child >> 31; }
[[nodiscard]] constexpr Kind leaf_kind(std::uint32_t child) { return static_cast<Kind>(child >> 28 & 7u); }
[[nodiscard]] constexpr std::uint32_t leaf_count(std::uint32_t child) { return (child >> 25 & 7u) + 1; }
[[nodiscard]] constexpr std::uint32_t leaf_first(std::uint32_t child) { return child & 0x1ffffffu; }

// How a face of an object blocks: a polygon never blocks its owner; of an open surface every crossing counts; of a solid's surface the
// crossings pair to spans.
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
  std::vector<Node> nodes;  // the first is the root; none without shapes
  std::vector<FaceBlock<3>> triangles;
  std::vector<FaceBlock<4>> quads;
  std::vector<SphereBlock> spheres;
  std::vector<Body> bodies;
  std::vector<std::array<float, 4>> planes;
  std::vector<CylinderShape> cylinders;
  std::vector<Form> forms;
  std::vector<Guard> guards;
  std::vector<std::uint32_t> others;  // objects
  std::vector<std::uint32_t> leaves;  // of a scene of few shapes, where occlusion is a loop over them: all leaves, with shapes of their own
  std::vector<Role> roles;            // by object
  std::vector<FloatBox> bounds;       // by object, grown by the margin; everything for a room
  std::vector<Guard> face_rooms;      // objects turned inside out that are kept as faces
  std::vector<std::uint32_t> rooms;   // the others that are turned inside out
  std::vector<std::uint32_t> room_bodies;    // by room: its convex body, or no_shape
  std::vector<std::array<float, 4>> sheets;  // planes of the sheets of flat solids: heights in the air
  std::vector<std::uint32_t> first_sheet;    // by object, of these; no_shape where it is none
  std::uint32_t shape_count = 0;

  [[nodiscard]] bool few() const { return nodes.empty() || !leaves.empty(); }
  [[nodiscard]] static bool is_leaf(std::uint32_t child) { return raycast::is_leaf(child); }
  [[nodiscard]] glm::dvec3 local(const glm::dvec3& p) const { return (p - centre) * scale; }
  [[nodiscard]] std::uint32_t object_of(std::uint32_t shape) const;
  [[nodiscard]] bool is_face_room(std::uint32_t object) const {
    return std::any_of(face_rooms.begin(), face_rooms.end(), [&](const Guard& room) { return room.object == object; });
  }
  [[nodiscard]] std::size_t bytes() const;
  // Of a ray through the whole tree, without an end: how many nodes it opens and what it does in their leaves, where eight faces or spheres
  // side by side count as one node. Each is met as often as its bounds are smaller than the whole (MacDonald and Booth 1990).
  [[nodiscard]] double walk_work() const;
};

// Does a segment of this length that begins on a sheet of its owner, and ends at `to`, leave the owner at once? Then what lies of it in the
// owner, up to skins, is shorter than eps_height, and nothing that is met deeper than the margin is within.
[[nodiscard]] bool leaves_at_once(const Compiled& scene, std::uint32_t owner, std::uint32_t sheet, const float (&to)[3], float length);

// May a span of the object lie within the solid that owns an end of a segment? Not when their bounds are apart.
[[nodiscard]] bool may_contain(const Compiled& scene, std::uint32_t owner, std::uint32_t object);

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/compiled.cpp>
#endif
