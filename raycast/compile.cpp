// SPDX-License-Identifier: MIT
#include <raycast/compile.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <brep/ears.hpp>
#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/air_cells.hpp>
#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/object.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

namespace raycast {

HALFLIGHT_INLINE void Compiler::sphere(const glm::dvec3& centre, double radius) {
  if (object_->inside()) { return; }
  if (!similar_) {
    return superquadric(centre, glm::dmat3(1.0 / radius), 2.0, 2.0, 0.0);  // an ellipsoid
  }
  const glm::dvec3 c = map(centre);
  const double r = radius * stretch_ * out_.scale;
  Box box{c - r, c + r};
  add(box, Kind::sphere, static_cast<std::uint32_t>(spheres_.size()));
  spheres_.push_back({static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z), static_cast<float>(r)});
}

HALFLIGHT_INLINE void Compiler::cylinder(const glm::dvec3& base, const AxisFrame& frame, double radius, double height) {
  if (object_->inside()) { return; }
  if (!similar_) { return cone(base, frame.into(radius, height), 1.0, 0.0); }
  const glm::dvec3 axis = height * frame.w;
  const glm::dvec3 b = map(base), w = object_->placement().linear * axis * out_.scale, unit = glm::normalize(w);
  CylinderShape cylinder{{}, {}, static_cast<float>(glm::length(w)), static_cast<float>(radius * stretch_ * out_.scale), index_};
  for (int k = 0; k < 3; ++k) { cylinder.base[k] = static_cast<float>(b[k]), cylinder.axis[k] = static_cast<float>(unit[k]); }
  add_object_box(Kind::cylinder, static_cast<std::uint32_t>(cylinders_.size()));
  cylinders_.push_back(cylinder);
}

HALFLIGHT_INLINE void Compiler::superquadric(const glm::dvec3& centre, const glm::dmat3& unit, double p, double q, double ring) {
  if (ring > largest_ring) { return; }  // distances from such a large ring are not accurate enough
  const double eps = eps_power * (1.0 + 0.5 / p + 0.5 / q + (p + q) / 128.0);
  form({.p = static_cast<float>(p),
        .q = static_cast<float>(q),
        .ring = static_cast<float>(ring),
        .eps = static_cast<float>(eps),
        .kind = p >= 1.0 && q >= 1.0 && ring == 0.0 ? FormKind::convex : FormKind::concave},
       centre, unit);
}

HALFLIGHT_INLINE void Compiler::cone(const glm::dvec3& base, const glm::dmat3& unit, double p, double q) {
  form({.p = static_cast<float>(p), .q = static_cast<float>(q), .eps = static_cast<float>(eps_cone), .kind = FormKind::cone}, base, unit);
}

HALFLIGHT_INLINE void Compiler::body(std::span<const Plane> planes) {
  const auto first = static_cast<std::uint32_t>(out_.planes.size());
  const glm::dmat3 normals = glm::transpose(glm::inverse(object_->placement().linear));
  for (const Plane& plane : planes) {
    const glm::dvec3 n = glm::normalize(normals * plane.normal);
    out_.planes.push_back(row(n, -glm::dot(n, map(plane.point))));
  }
  const auto index = static_cast<std::uint32_t>(bodies_.size());
  bodies_.push_back({first, static_cast<std::uint32_t>(planes.size()), index_});
  if (object_->inside()) {
    room_body_ = index;
  } else {
    add_object_box(Kind::body, index);
  }
}

HALFLIGHT_INLINE void Compiler::face(std::uint32_t number, std::span<const glm::dvec3> corners) {
  const std::uint32_t sheet = object_->sheet_of(number);
  world_.clear();
  for (const glm::dvec3& p : corners) { world_.push_back(map(p)); }
  if (turned_) { std::reverse(world_.begin(), world_.end()); }
  if (corners.size() == 3) {
    // Slivers are left to double precision, because their normal is not accurate.
    const glm::dvec3 area = glm::cross(world_[1] - world_[0], world_[2] - world_[0]);
    const double length = glm::length(area);
    const double extent =
        std::max({glm::dot(world_[1] - world_[0], world_[1] - world_[0]), glm::dot(world_[2] - world_[0], world_[2] - world_[0])});
    pieces(number, sheet, length > tol_sliver * extent ? area / length : glm::dvec3{0.0}, true);
  } else {
    const Plane plane = plane_of(world_);
    pieces(number, sheet, known(plane) ? plane.normal : glm::dvec3{0.0}, brep::is_convex(world_));
  }
}

HALFLIGHT_INLINE Compiler::Compiler(Compiled& out, const Box& bounds, double skin) : out_(out) {
  out_.centre = bounds.empty() ? glm::dvec3{0.0} : bounds.centre();
  const glm::dvec3 size = bounds.size();
  int exponent = 0;
  std::frexp(0.5 * std::max({size.x, size.y, size.z}), &exponent);
  out_.scale = std::ldexp(1.0, -exponent);
  skin_ = skin * out_.scale;
  out_.margin = static_cast<float>(eps_height + 4 * skin_);
}

HALFLIGHT_INLINE bool Compiler::known(const Plane& plane) const {
  const double extent = brep::extent(world_);
  return plane.slack <= 0.5 * skin_ && glm::length(brep::vector_area(world_)) > tol_sliver * extent * extent;
}

HALFLIGHT_INLINE void Compiler::add(std::uint32_t index, const PlacedObject& object, std::span<const glm::dvec3> outline,
                                    const glm::dvec3& normal, Rays rays) {
  object_ = &object;
  index_ = index;
  const glm::dmat3& m = object.placement().linear;
  turned_ = (glm::determinant(m) < 0.0) != object.inside();
  similar_ = keeps_angles(m);
  stretch_ = std::sqrt((glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2])) / 3);
  out_.bounds.push_back(rounded(scaled(object.bounds())));
  out_.roles.push_back(!outline.empty() ? Role::polygon : object.solid() ? Role::solid : Role::surface);
  out_.first_sheet.push_back(no_shape);
  if (object.flat() && object.solid() && rays == Rays::meet) {
    out_.first_sheet.back() = static_cast<std::uint32_t>(out_.sheets.size());
    for (std::uint32_t sheet = 0; sheet < object.sheet_count(); ++sheet) {
      const SurfacePoint at = object.project(sheet, out_.centre);
      out_.sheets.push_back(row(at.normal, -glm::dot(at.normal, out_.local(at.position))));
    }
  }
  if (object.inside()) { out_.bounds.back() = {{-no_bound, -no_bound, -no_bound}, {no_bound, no_bound, no_bound}}; }
  if (rays == Rays::pass) { return; }
  room_body_ = no_shape;
  const std::size_t before = items_.size();
  const std::uint32_t faces_before = face_count_;
  if (!outline.empty()) {
    world_.clear();
    for (const glm::dvec3& p : outline) { world_.push_back(out_.local(p)); }
    pieces(0, 0, known({world_[0], normal, out_.scale * object.slack()}) ? normal : glm::dvec3{0.0}, object.convex());
  } else {
    object.object().compile(*this);
  }
  if (object.inside() && items_.size() > before) {
    out_.face_rooms.push_back({index, air_cells(before)});
  } else if (object.inside()) {
    out_.rooms.push_back(index);
    out_.room_bodies.push_back(room_body_);
  } else if (items_.size() == before) {
    add_object_box(Kind::other, 0);
  } else if (face_count_ > faces_before && outline.empty()) {
    add_object_box(Kind::guard, static_cast<std::uint32_t>(guards_.size()));
    guards_.push_back({index, object.solid() ? air_cells(before) : AirCells{}});
  }
}

HALFLIGHT_INLINE AirCells Compiler::air_cells(std::size_t first_item) const {
  // Enough cells that a room of a dozen walls has cells of air in its middle, and a lattice between its bars; at most a megabyte for a
  // million faces.
  const std::size_t wanted = std::clamp<std::size_t>(32 * (items_.size() - first_item), 1024, std::size_t{1} << 18);
  const FloatBox body = rounded(scaled(object_->bounds()));
  AirCells cells(body.lo, body.hi, wanted);
  for (std::size_t i = first_item; i < items_.size(); ++i) {
    cells.meet({items_[i].box.lo, items_[i].box.hi, faces_[items_[i].data].row[0]}, out_.margin);
  }
  cells.finish([&](float x, float y, float z) {
    const glm::dvec3 p = glm::dvec3(x, y, z) / out_.scale + out_.centre;
    for (int k = 0; k < 3; ++k) {
      Segment line{p, glm::dvec3{0.0}};
      line.direction[k] = 1.0 / out_.scale;
      Spans spans;
      object_->spans(line, spans);
      if (std::any_of(spans.begin(), spans.end(), [](const Span& s) { return s.in.t <= 0.0 && s.out.t >= 0.0; })) { return false; }
    }
    return true;
  });
  return cells;
}

HALFLIGHT_INLINE FloatBox Compiler::rounded(const Box& b) const {  // grown by the margin and rounded outwards
  FloatBox result;
  const double grow = out_.margin;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    result.lo[i] = std::nextafter(static_cast<float>(b.lo[k] - grow), -no_bound);
    result.hi[i] = std::nextafter(static_cast<float>(b.hi[k] + grow), no_bound);
  }
  return result;
}

HALFLIGHT_INLINE void Compiler::form(Form f, const glm::dvec3& centre, const glm::dmat3& unit) {
  if (object_->inside()) { return; }
  const Placement& place = object_->placement();
  const glm::dmat3 inverse = glm::inverse(place.linear), linear = unit * inverse / out_.scale;
  const glm::dvec3 shift = unit * (inverse * (out_.centre - place.translation) - centre);
  const auto norm = [](const glm::dmat3& m) { return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2])); };
  if (!(norm(unit * inverse) * norm(glm::inverse(unit * inverse)) < largest_condition)) { return; }
  f.object = index_;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 row{linear[0][k], linear[1][k], linear[2][k]};
    for (int i = 0; i < 3; ++i) { f.map[k][i] = static_cast<float>(row[i]); }
    f.map[k][3] = static_cast<float>(shift[k]);
    f.slop[k] = 2.0f * out_.margin * static_cast<float>(glm::length(row));
    if (!(f.slop[k] < largest_slop)) { return; }
  }
  add_object_box(Kind::form, static_cast<std::uint32_t>(forms_.size()));
  forms_.push_back(f);
}

HALFLIGHT_INLINE void Compiler::pieces(std::uint32_t number, std::uint32_t sheet, const glm::dvec3& normal, bool convex) {
  const auto n = static_cast<std::uint32_t>(world_.size());
  const auto piece = [&](std::span<const std::uint32_t> corners, bool known) {
    Face face{{}, number, sheet};
    Box box;
    for (const std::uint32_t i : corners) { box.extend(world_[i]); }
    face.row[0] = row(normal, -glm::dot(normal, world_[0]));
    for (std::size_t i = 0; i < corners.size() && known; ++i) {
      const glm::dvec3& corner = world_[corners[i]];
      const glm::dvec3 in = glm::normalize(glm::cross(normal, world_[corners[(i + 1) % corners.size()]] - corner));
      face.row[i + 1] = row(in, -glm::dot(in, corner));
    }
    ++face_count_;
    add(box, corners.size() == 3 ? Kind::triangle : Kind::quad, static_cast<std::uint32_t>(faces_.size()));
    faces_.push_back(face);
  };
  if (normal != glm::dvec3{0.0} && convex) {
    for (std::uint32_t first = 1; first + 1 < n; first += 2) {
      const std::array<std::uint32_t, 4> corners{0, first, first + 1, first + 2};
      piece(std::span(corners).first(std::min<std::size_t>(4, n - first + 1)), true);
    }
    return;
  }
  if (normal != glm::dvec3{0.0} && n <= most_corners) {
    const std::vector<std::array<std::uint32_t, 3>> parts = brep::ears(world_);
    const auto turns_alike = [&](const std::array<std::uint32_t, 3>& part) {
      const glm::dvec3 &a = world_[part[0]], &b = world_[part[1]], &c = world_[part[2]];
      return glm::dot(glm::cross(b - a, c - a), normal) > 0.0;
    };
    if (std::all_of(parts.begin(), parts.end(), turns_alike)) {
      for (const std::array<std::uint32_t, 3>& part : parts) { piece(part, true); }
      return;
    }
  }
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0U);
  piece(all, false);
}

HALFLIGHT_INLINE std::uint32_t Compiler::emit(Kind kind, std::span<const Item> items) {
  const auto append = [&](auto& out, auto&& make) {
    const auto first = static_cast<std::uint32_t>(out.size());
    for (const Item& item : items) { out.push_back(make(item)); }
    return first;
  };
  switch (kind) {
    case Kind::triangle:
      return emit_faces(out_.triangles, items);
    case Kind::quad:
      return emit_faces(out_.quads, items);
    case Kind::sphere: {
      SphereBlock block{};
      for (std::size_t i = 0; i < 8; ++i) {
        block.object[i] = no_object_id;
        block.radius[i] = -1.0f;
        for (std::size_t k = 0; k < 3; ++k) { block.centre[k][i] = 8.0f; }
        if (i >= items.size()) { continue; }
        for (std::size_t k = 0; k < 3; ++k) { block.centre[k][i] = spheres_[items[i].data][k]; }
        block.radius[i] = spheres_[items[i].data][3];
        block.object[i] = items[i].object;
      }
      out_.spheres.push_back(block);
      return 8 * static_cast<std::uint32_t>(out_.spheres.size() - 1);
    }
    case Kind::body:
      return append(out_.bodies, [&](const Item& item) { return bodies_[item.data]; });
    case Kind::cylinder:
      return append(out_.cylinders, [&](const Item& item) { return cylinders_[item.data]; });
    case Kind::form:
      return append(out_.forms, [&](const Item& item) { return forms_[item.data]; });
    case Kind::guard:
      return append(out_.guards, [&](const Item& item) { return guards_[item.data]; });
    default:
      return append(out_.others, [&](const Item& item) { return item.object; });
  }
}

}  // namespace raycast
