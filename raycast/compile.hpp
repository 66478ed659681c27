// SPDX-License-Identifier: MIT
#pragma once

// From objects to compiled.hpp. An object that consists of shapes which the fast lanes know says so in Object::compile, in its own
// coordinates; what says nothing is kept behind its bounds and asked through its spans. Shapes that a placement distorts are treated
// the same way, unless they are polyhedral.

#include "circle.hpp"
#include "compiled.hpp"
#include "transform.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace raycast {

struct Item {  // a shape before it has its place
  FloatBox box;
  Kind kind;
  std::uint32_t object, data;
};

class Compiler {
 public:
  // --- What Object::compile may call. Only one kind per object. ---

  void ball(const glm::dvec3& centre, double radius) {
    if (object_->inside()) return;
    if (!similar_) return superquadric(centre, glm::dmat3(1.0 / radius), 2.0, 2.0, 0.0);  // an ellipsoid
    const glm::dvec3 c = map(centre);
    const double r = radius * stretch_ * out_.scale;
    Box box{c - r, c + r};
    add(box, Kind::ball, static_cast<std::uint32_t>(balls_.size()));
    balls_.push_back({static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z), static_cast<float>(r)});
  }
  void cylinder(const glm::dvec3& base, const AxisFrame& frame, double radius, double height) {
    if (object_->inside()) return;
    if (!similar_) return cone(base, frame.into(radius, height), 1.0, 0.0);
    const glm::dvec3 axis = height * frame.w;
    const glm::dvec3 b = map(base), w = object_->placement().linear * axis * out_.scale, unit = glm::normalize(w);
    Tube tube{{}, {}, static_cast<float>(glm::length(w)), static_cast<float>(radius * stretch_ * out_.scale), index_};
    for (int k = 0; k < 3; ++k) tube.base[k] = static_cast<float>(b[k]), tube.axis[k] = static_cast<float>(unit[k]);
    add_object_box(Kind::cylinder, static_cast<std::uint32_t>(tubes_.size()));
    tubes_.push_back(tube);
  }
  // |x, y| <= 1, z = 0 where x, y, z are unit (p - centre).
  void disk(const glm::dvec3& centre, const glm::dmat3& unit) { form(FormKind::disk, centre, unit, 0.0, 0.0, 0.0, 0.0); }
  // 0 <= z <= 1, |x, y| <= p + q z, neither beyond 1.
  void cone(const glm::dvec3& base, const glm::dmat3& unit, double p, double q) { form(FormKind::cone, base, unit, p, q, 0.0, 0x1p-20); }
  // ((|x|^p + |y|^p)^(1/p) - ring)^q + |z|^q <= 1.
  void superquadric(const glm::dvec3& centre, const glm::dmat3& unit, double p, double q, double ring) {
    if (std::min(p, q) < 0.2 || std::max(p, q) > 16.0 || ring > 64.0) return;  // powers are not known well enough
    form(p >= 1.0 && q >= 1.0 && ring == 0.0 ? FormKind::convex : FormKind::concave, centre, unit, p, q, ring,
         0x1p-15 * (1.0 + 0.5 / p + 0.5 / q));
  }
  // A convex solid behind all these planes; at most 32 of them.
  void body(std::span<const Plane> planes) {
    const auto first = static_cast<std::uint32_t>(out_.planes.size());
    const glm::dmat3 normals = glm::transpose(glm::inverse(object_->placement().linear));
    for (const Plane& plane : planes) {
      const glm::dvec3 n = glm::normalize(normals * plane.normal);
      out_.planes.push_back(row(n, -glm::dot(n, map(plane.point))));
    }
    const auto index = static_cast<std::uint32_t>(bodies_.size());
    bodies_.push_back({first, static_cast<std::uint32_t>(planes.size()), index_});
    if (object_->inside())
      room_body_ = index;
    else
      add_object_box(Kind::body, index);
  }
  // Is it worth listing so many faces? Beyond four million in a scene no copies are made of them.
  [[nodiscard]] bool takes_faces(std::size_t count) const { return !object_->inside() && face_count_ + count <= 4'000'000; }
  // One face of a surface, in the order of its corners; all faces must be listed.
  void face(std::uint32_t number, std::span<const glm::dvec3> corners) {
    world_.clear();
    for (const glm::dvec3& p : corners) world_.push_back(map(p));
    if (mirrored_) std::reverse(world_.begin(), world_.end());
    if (corners.size() == 3) {
      // Slivers are left to double precision: their normal is not known.
      const glm::dvec3 area = glm::cross(world_[1] - world_[0], world_[2] - world_[0]);
      const double length = glm::length(area);
      const double extent =
          std::max({glm::dot(world_[1] - world_[0], world_[1] - world_[0]), glm::dot(world_[2] - world_[0], world_[2] - world_[0])});
      pieces(number, length > 1e-6 * extent ? area / length : glm::dvec3{0.0}, true);
    } else {
      const Plane plane = plane_of(world_);
      const double extent = brep::extent(world_);
      const bool exact = plane.slack == 0.0 && glm::length(brep::vector_area(world_)) > 1e-6 * extent * extent;
      pieces(number, exact ? plane.normal : glm::dvec3{0.0}, brep::is_convex(world_));
    }
  }

  // --- What Scene calls. ---

  // `skin` is at least every skin of the scene.
  Compiler(Compiled& out, const Box& bounds, double skin) : out_(out) {
    out_.centre = bounds.empty() ? glm::dvec3{0.0} : bounds.centre();
    const glm::dvec3 size = bounds.size();
    int exponent = 0;
    std::frexp(0.5 * std::max({size.x, size.y, size.z}), &exponent);
    out_.scale = std::ldexp(1.0, -exponent);
    out_.margin = static_cast<float>(0x1p-19 + 4 * skin * out_.scale);
  }
  void add(std::uint32_t index, const PlacedObject& object, std::span<const glm::dvec3> outline, const glm::dvec3& normal) {
    object_ = &object;
    index_ = index;
    const glm::dmat3& m = object.placement().linear;
    mirrored_ = glm::determinant(m) < 0.0;
    const glm::dmat3 square = glm::transpose(m) * m;
    const double s = (square[0][0] + square[1][1] + square[2][2]) / 3;
    similar_ = true;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) similar_ = similar_ && std::abs(square[i][j] - (i == j ? s : 0.0)) <= 1e-9 * s;
    stretch_ = std::sqrt(s);
    out_.bounds.push_back(rounded(scaled(object.bounds())));
    out_.roles.push_back(!outline.empty() ? Role::polygon : object.solid() ? Role::solid : Role::surface);
    room_body_ = no_shape;
    const std::size_t before = items_.size();
    const std::uint32_t faces_before = face_count_;
    if (!outline.empty()) {
      world_.clear();
      for (const glm::dvec3& p : outline) world_.push_back(out_.local(p));
      const double extent = brep::extent(world_);
      const bool exact = object.slack() == 0.0 && glm::length(brep::vector_area(world_)) > 1e-6 * extent * extent;
      pieces(0, exact ? normal : glm::dvec3{0.0}, object.convex());
    } else {
      object.object().compile(*this);
    }
    if (object.inside()) {
      out_.bounds.back() = {{-1e30f, -1e30f, -1e30f}, {1e30f, 1e30f, 1e30f}};
      out_.rooms.push_back(index);
      out_.room_bodies.push_back(room_body_);
    } else if (items_.size() == before) {
      add_object_box(Kind::other, 0);
    } else if (face_count_ > faces_before && outline.empty()) {
      add_object_box(Kind::guard, 0);
    }
  }
  // Arranges everything. Up to `loop_limit` shapes are a loop for occlusion; the first hit is always looked for in the tree.
  void finish(std::size_t loop_limit);  // tree.hpp

 private:
  struct Face {
    std::array<std::array<float, 4>, 5> row;
    std::uint32_t number;
  };

  [[nodiscard]] glm::dvec3 map(const glm::dvec3& p) const {
    return out_.local(object_->placement().linear * p + object_->placement().translation);
  }
  static std::array<float, 4> row(const glm::dvec3& n, double c) {
    return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z), static_cast<float>(c)};
  }
  [[nodiscard]] Box scaled(const Box& b) const { return {out_.local(b.lo), out_.local(b.hi)}; }
  [[nodiscard]] FloatBox rounded(const Box& b) const {  // grown by the margin, outwards
    FloatBox result;
    const double grow = out_.margin;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      result.lo[i] = std::nextafter(static_cast<float>(b.lo[k] - grow), -1e30f);
      result.hi[i] = std::nextafter(static_cast<float>(b.hi[k] + grow), 1e30f);
    }
    return result;
  }
  void add(const Box& box, Kind kind, std::uint32_t data) { items_.push_back({rounded(box), kind, index_, data}); }
  void add_object_box(Kind kind, std::uint32_t data) { items_.push_back({out_.bounds.back(), kind, index_, data}); }

  // What double precision computes in the shape's coordinates must be better than the margin there: so not under very uneven maps.
  void form(FormKind kind, const glm::dvec3& centre, const glm::dmat3& unit, double p, double q, double ring, double eps) {
    if (object_->inside()) return;
    const Placement& place = object_->placement();
    const glm::dmat3 inverse = glm::inverse(place.linear), linear = unit * inverse / out_.scale;
    const glm::dvec3 shift = unit * (inverse * (out_.centre - place.translation) - centre);
    const auto norm = [](const glm::dmat3& m) { return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2])); };
    if (!(norm(unit * inverse) * norm(glm::inverse(unit * inverse)) < 1e4)) return;
    Form f{{}, {}, static_cast<float>(p), static_cast<float>(q), static_cast<float>(ring), static_cast<float>(eps), kind, index_};
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 row{linear[0][k], linear[1][k], linear[2][k]};
      for (int i = 0; i < 3; ++i) f.map[k][i] = static_cast<float>(row[i]);
      f.map[k][3] = static_cast<float>(shift[k]);
      f.slop[k] = 2.0f * out_.margin * static_cast<float>(glm::length(row));
      if (!(f.slop[k] < 0.02f)) return;
    }
    add_object_box(Kind::form, static_cast<std::uint32_t>(forms_.size()));
    forms_.push_back(f);
  }

  // Cuts the polygon `world_` into pieces of at most four corners. Where the plane is not known (normal 0) or the polygon is not convex
  // its rows stay zero: neither in nor out, double precision decides.
  void pieces(std::uint32_t number, const glm::dvec3& normal, bool convex) {
    const std::size_t n = world_.size();
    const bool known = convex && normal != glm::dvec3{0.0};
    for (std::size_t first = 1; first + 1 < n; first += 2) {
      const bool whole = !known || n <= 4;
      const std::size_t corners = whole ? n : std::min<std::size_t>(4, n - first + 1);
      const auto corner = [&](std::size_t i) -> const glm::dvec3& { return i == 0 || whole ? world_[i] : world_[first + i - 1]; };
      Face face{{}, number};
      Box box;
      for (std::size_t i = 0; i < corners; ++i) box.extend(corner(i));
      face.row[0] = row(normal, -glm::dot(normal, world_[0]));
      if (known)
        for (std::size_t i = 0; i < corners; ++i) {
          const glm::dvec3 side = corner((i + 1) % corners) - corner(i);
          const glm::dvec3 in = glm::normalize(glm::cross(normal, side));
          face.row[i + 1] = row(in, -glm::dot(in, corner(i)));
        }
      ++face_count_;
      add(box, corners == 3 ? Kind::triangle : Kind::quad, static_cast<std::uint32_t>(faces_.size()));
      faces_.push_back(face);
      if (whole) return;
    }
  }

  template <int Edges>
  std::uint32_t emit_faces(std::vector<FaceBlock<Edges>>& blocks, std::span<const Item> items) {
    FaceBlock<Edges> block{};
    for (std::size_t i = 0; i < 8; ++i) {
      block.object[i] = no_object_id;
      block.row[0][3][i] = 1.0f;
      if (i >= items.size()) continue;
      const Face& face = faces_[items[i].data];
      for (std::size_t r = 0; r <= Edges; ++r)
        for (std::size_t c = 0; c < 4; ++c) block.row[r][c][i] = face.row[r][c];
      block.object[i] = items[i].object;
      block.face[i] = face.number;
    }
    blocks.push_back(block);
    return 8 * static_cast<std::uint32_t>(blocks.size() - 1);
  }
  std::uint32_t emit(Kind kind, std::span<const Item> items) {
    const auto append = [&](auto& out, auto&& make) {
      const auto first = static_cast<std::uint32_t>(out.size());
      for (const Item& item : items) out.push_back(make(item));
      return first;
    };
    switch (kind) {
      case Kind::triangle:
        return emit_faces(out_.triangles, items);
      case Kind::quad:
        return emit_faces(out_.quads, items);
      case Kind::ball: {
        BallBlock block{};
        for (std::size_t i = 0; i < 8; ++i) {
          block.object[i] = no_object_id;
          block.radius[i] = -1.0f;
          for (std::size_t k = 0; k < 3; ++k) block.centre[k][i] = 8.0f;
          if (i >= items.size()) continue;
          for (std::size_t k = 0; k < 3; ++k) block.centre[k][i] = balls_[items[i].data][k];
          block.radius[i] = balls_[items[i].data][3];
          block.object[i] = items[i].object;
        }
        out_.balls.push_back(block);
        return 8 * static_cast<std::uint32_t>(out_.balls.size() - 1);
      }
      case Kind::body:
        return append(out_.bodies, [&](const Item& item) { return bodies_[item.data]; });
      case Kind::cylinder:
        return append(out_.tubes, [&](const Item& item) { return tubes_[item.data]; });
      case Kind::form:
        return append(out_.forms, [&](const Item& item) { return forms_[item.data]; });
      case Kind::guard:
        return append(out_.guards, [&](const Item& item) { return item.object; });
      default:
        return append(out_.others, [&](const Item& item) { return item.object; });
    }
  }

  static constexpr std::uint32_t no_object_id = 0xffffffff;
  Compiled& out_;
  std::vector<Item> items_;
  std::vector<Face> faces_;
  std::vector<std::array<float, 4>> balls_;
  std::vector<Body> bodies_;
  std::vector<Tube> tubes_;
  std::vector<Form> forms_;
  std::vector<glm::dvec3> world_;
  std::uint32_t face_count_ = 0;
  // Of the object being added:
  const PlacedObject* object_ = nullptr;
  std::uint32_t index_ = 0, room_body_ = no_shape;
  double stretch_ = 1.0;
  bool mirrored_ = false, similar_ = true;
};

}  // namespace raycast
