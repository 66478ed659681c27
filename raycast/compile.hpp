// SPDX-License-Identifier: MIT
#pragma once

// Converts objects to compiled.hpp. An object made of shapes that the fast single-precision code knows declares them in Object::compile,
// in its own coordinates; any other object is represented by its bounds and tested through its spans. The same applies to shapes that are
// distorted by their placement, unless they are polyhedral.

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
#include <raycast/transform.hpp>

namespace raycast {

struct Item {  // a shape before its position in the arrays is known
  FloatBox box;
  Kind kind;
  std::uint32_t object, data;
};

class Compiler {
 public:
  // --- To be called by Object::compile. Each object may use only one kind. ---

  void sphere(const glm::dvec3& centre, double radius);
  void cylinder(const glm::dvec3& base, const AxisFrame& frame, double radius, double height);
  // The disk |x, y| <= 1 and z = 0, with (x, y, z) = unit (p - centre).
  void disk(const glm::dvec3& centre, const glm::dmat3& unit) { form({.kind = FormKind::disk}, centre, unit); }
  // 0 <= z <= 1, |x, y| <= p + q z, neither beyond 1.
  void cone(const glm::dvec3& base, const glm::dmat3& unit, double p, double q);
  // The torus-like solid ((|x|^p + |y|^p)^(1/p) - ring)^q + |z|^q <= 1, with (x, y, z) = unit (p - centre).
  void superquadric(const glm::dvec3& centre, const glm::dmat3& unit, double p, double q, double ring);
  // A convex solid behind all these planes, of which there are at most 32.
  void body(std::span<const Plane> planes);
  // Is there room for so many more faces? Beyond four million faces in a scene no copies are made.
  [[nodiscard]] bool takes_faces(std::size_t count) const { return face_count_ + count <= 4'000'000; }
  // Is this object a room, with the air inside it? Its faces may be declared only if the first face that a ray from the air meets is
  // where the air ends, that is, if the surface does not meet itself.
  [[nodiscard]] bool room() const { return object_->inside(); }
  // A face of a surface, with corners in order; all faces must be declared. Faces of one sheet lie in one plane.
  void face(std::uint32_t number, std::span<const glm::dvec3> corners);

  // --- To be called by Scene. ---

  // `skin`: upper bound of every skin in the scene.
  Compiler(Compiled& out, const Box& bounds, double skin);
  enum class Rays { meet, pass };  // do rays meet the object, or pass through it?
  void add(std::uint32_t index, const PlacedObject& object, std::span<const glm::dvec3> outline, const glm::dvec3& normal,
           Rays rays = Rays::meet);
  // Arranges the shapes in arrays and a tree. Up to `loop_limit` shapes are tested in a loop for occlusion; the first hit
  // always uses the tree.
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
  // The cells of air over a solid whose faces were declared from this item on.
  [[nodiscard]] AirCells air_cells(std::size_t first_item) const;
  void add_object_box(Kind kind, std::uint32_t data) { items_.push_back({out_.bounds.back(), kind, index_, data}); }

  // Sets the map of the form and adds it, if double precision in its coordinates is more accurate than the margin; not for uneven maps.
  void form(Form f, const glm::dvec3& centre, const glm::dmat3& unit);

  // Is the mean plane of `world_` accurate enough for single precision? A corner that is off the plane by s shifts the outline seen by a
  // segment by s length / (|from| + |to|) in the plane, with the heights of the ends as in face() of shapes.inc. The tolerance there is
  // 12 skins times that factor, because the margin holds 4; so half a skin is well within it. A skin contains the slacks of two objects.
  // So only polygons that are nearly a line fail this test.
  [[nodiscard]] bool known(const Plane& plane) const;

  // Cuts the polygon `world_` into pieces of at most four corners. If the plane is not known (normal 0), or the polygon cannot be
  // triangulated, the rows of the whole polygon stay zero: neither in nor out, so that double precision decides.
  static constexpr std::size_t most_corners = 1000;  // because triangulation by ears is quadratic
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
  // State of the object being added:
  const PlacedObject* object_ = nullptr;
  std::uint32_t index_ = 0, room_body_ = no_shape;
  double stretch_ = 1.0, skin_ = 0.0;     // skin_: in compiled coordinates
  bool turned_ = false, similar_ = true;  // turned_: do the corners of a face run clockwise seen from the air?
};

}  // namespace raycast

#ifdef HALFLIGHT_HEADER_ONLY
#include <raycast/compile.cpp>
#endif
