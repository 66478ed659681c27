// SPDX-License-Identifier: MIT
#pragma once

// From objects to compiled.hpp. An object that consists of shapes which the fast lanes know says so in Object::compile, in its own
// coordinates; what says nothing is kept behind its bounds and asked through its spans. Shapes that a placement distorts are treated
// the same way, unless they are polyhedral.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <raycast/air_cells.hpp>
#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/planar.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

struct Item {  // a shape before it has its place
  FloatBox box;
  Kind kind;
  std::uint32_t object, data;
};

class Compiler {
 public:
  // --- What Object::compile may call. Only one kind per object. ---

  void sphere(const glm::dvec3& centre, double radius);
  void cylinder(const glm::dvec3& base, const AxisFrame& frame, double radius, double height);
  // |x, y| <= 1, z = 0 where x, y, z are unit (p - centre).
  void disk(const glm::dvec3& centre, const glm::dmat3& unit) { form(FormKind::disk, centre, unit, 0.0, 0.0, 0.0, 0.0); }
  // 0 <= z <= 1, |x, y| <= p + q z, neither beyond 1.
  void cone(const glm::dvec3& base, const glm::dmat3& unit, double p, double q) { form(FormKind::cone, base, unit, p, q, 0.0, eps_cone); }
  // ((|x|^p + |y|^p)^(1/p) - ring)^q + |z|^q <= 1.
  void superquadric(const glm::dvec3& centre, const glm::dmat3& unit, double p, double q, double ring);
  // A convex solid behind all these planes; at most 32 of them.
  void body(std::span<const Plane> planes);
  // Is it worth listing so many faces? Beyond four million in a scene no copies are made of them.
  [[nodiscard]] bool takes_faces(std::size_t count) const { return face_count_ + count <= 4'000'000; }
  // The air is within the object. Its faces may be listed if the first of them that a ray from the air meets is where the air ends: if the
  // surface does not meet itself.
  [[nodiscard]] bool room() const { return object_->inside(); }
  // One face of a surface, in the order of its corners; all faces must be listed. Faces of one sheet lie in one plane.
  void face(std::uint32_t number, std::span<const glm::dvec3> corners);

  // --- What Scene calls. ---

  // `skin` is at least every skin of the scene.
  Compiler(Compiled& out, const Box& bounds, double skin);
  enum class Rays { meet, pass };  // what they do at the object
  void add(std::uint32_t index, const PlacedObject& object, std::span<const glm::dvec3> outline, const glm::dvec3& normal,
           Rays rays = Rays::meet);
  // Arranges everything. Up to `loop_limit` shapes are a loop for occlusion; the first hit is always looked for in the tree.
  void finish(std::size_t loop_limit);  // wide_tree.hpp

 private:
  struct Face {
    std::array<std::array<float, 4>, 5> row;
    std::uint32_t number, sheet;
  };

  [[nodiscard]] glm::dvec3 map(const glm::dvec3& p) const {
    return out_.local(object_->placement().linear * p + object_->placement().translation);
  }
  static std::array<float, 4> row(const glm::dvec3& n, double c) {
    return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z), static_cast<float>(c)};
  }
  [[nodiscard]] Box scaled(const Box& b) const { return {out_.local(b.lo), out_.local(b.hi)}; }
  [[nodiscard]] FloatBox rounded(const Box& b) const;
  void add(const Box& box, Kind kind, std::uint32_t data) { items_.push_back({rounded(box), kind, index_, data}); }
  // The faces listed from this item on bound a solid: which cells over its body are air?
  [[nodiscard]] AirCells air_cells(std::size_t first_item) const;
  void add_object_box(Kind kind, std::uint32_t data) { items_.push_back({out_.bounds.back(), kind, index_, data}); }

  // What double precision computes in the shape's coordinates must be better than the margin there: so not under very uneven maps.
  void form(FormKind kind, const glm::dvec3& centre, const glm::dmat3& unit, double p, double q, double ring, double eps);

  // Is the mean plane of `world_` known well enough for single precision? A corner that is off the plane by s moves the outline that a
  // segment sees by s length / (|from| + |to|) across the plane, with heights of the ends as in face() of shapes.inc. The tolerance there
  // holds 12 skins times that factor, because the margin holds 4; so half a skin is far within it. A skin contains two slacks of any
  // object: only what is nearly a line is not known.
  [[nodiscard]] bool known(const Plane& plane) const;

  // Cuts the polygon `world_` into pieces of at most four corners. Where the plane is not known (normal 0), or no triangles are found, the
  // rows of the whole stay zero: neither in nor out, double precision decides.
  static constexpr std::size_t most_corners = 1000;  // cutting off ears takes their square
  void pieces(std::uint32_t number, std::uint32_t sheet, const glm::dvec3& normal, bool convex);

  template <int Edges>
  std::uint32_t emit_faces(std::vector<FaceBlock<Edges>>& blocks, std::span<const Item> items) {
    FaceBlock<Edges> block{};
    for (std::size_t i = 0; i < 8; ++i) {
      block.object[i] = no_object_id;
      block.row[0][3][i] = 1.0f;
      if (i >= items.size()) { continue; }
      const Face& face = faces_[items[i].data];
      for (std::size_t r = 0; r <= Edges; ++r) {
        for (std::size_t c = 0; c < 4; ++c) { block.row[r][c][i] = face.row[r][c]; }
      }
      block.object[i] = items[i].object;
      block.face[i] = face.number;
      block.sheet[i] = face.sheet;
    }
    blocks.push_back(block);
    return 8 * static_cast<std::uint32_t>(blocks.size() - 1);
  }
  std::uint32_t emit(Kind kind, std::span<const Item> items);

  static constexpr std::uint32_t no_object_id = 0xffffffff;
  Compiled& out_;
  std::vector<Item> items_;
  std::vector<Face> faces_;
  std::vector<std::array<float, 4>> spheres_;
  std::vector<Body> bodies_;
  std::vector<CylinderShape> cylinders_;
  std::vector<Form> forms_;
  std::vector<Guard> guards_;
  std::vector<glm::dvec3> world_;
  std::uint32_t face_count_ = 0;
  // Of the object being added:
  const PlacedObject* object_ = nullptr;
  std::uint32_t index_ = 0, room_body_ = no_shape;
  double stretch_ = 1.0, skin_ = 0.0;     // skin_: in the compiled scene
  bool turned_ = false, similar_ = true;  // turned_: the corners of a face run clockwise seen from the air
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/compile.cpp>
#endif
