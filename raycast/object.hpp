// SPDX-License-Identifier: MIT
#pragma once

// An object keeps its original, exact representation from the scene file to the end of the run; the mesh of the radiosity solution is
// only derived from it (paper 4.1: "objects keep their original representation as long as possible"). A new kind of object implements
// four methods:
//
//   bounds        its bounding box
//   spans         the intervals of a line inside it            (the paper's intersection with a ray)
//   approximate   its polygonal mesh, into a brep::Builder     (the paper's approxShape)
//   project       the nearest point of a sheet, and its normal (places new vertices on the true surface)
//
// A sheet is a smooth piece of the surface: a sphere has one, a cylinder three, a box six. Objects are immutable once made, so all
// methods are thread-safe. They use the object's own coordinates; transform.hpp places objects in the world.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>

namespace brep {
class Builder;  // brep/builder_input.hpp
}

namespace raycast {

struct SurfacePoint {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};  // unit length, out of the solid, into the air
};

class Compiler;

inline constexpr std::uint32_t no_object = 0xffffffff;  // an object's number in a scene: none

// A point of an object of a scene, and the sheet on which it lies.
struct ScenePoint : SurfacePoint {
  std::uint32_t object = 0, sheet = 0;
};

class Object {
 public:
  Object() = default;
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  virtual ~Object() = default;

  [[nodiscard]] virtual Box bounds() const = 0;

  // Adds to `out` (which is empty) the intervals of the whole line, t in R, inside the solid. Requires has_line(line). A
  // surface without inside gives spans of length zero.
  virtual void spans(const Segment& line, Spans& out) const = 0;

  // Adds a closed mesh to `out`: vertices on the surface, faces counter-clockwise seen from the air, each face within `tolerance` (a
  // length) of the surface. Where the object has no surface (the back of a polygon, a hole of an open mesh), faces of brep::no_sheet
  // close the mesh.
  virtual void approximate(double tolerance, brep::Builder& out) const = 0;

  // The point of the sheet's smooth surface nearest to p, and the normal there. The surface is not trimmed: a box's sheet is a whole
  // plane, a cylinder's side continues beyond its caps. Idempotent up to rounding.
  [[nodiscard]] virtual SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const = 0;

  // The position of a new mesh vertex that is made at p between others on the sheet: the nearest point, but a point on an edge within the
  // sheet if the other vertices lie on that edge. (For a blade, the nearest point would be on one of its sides, and the edge would be
  // lost.)
  [[nodiscard]] virtual glm::dvec3 vertex(std::uint32_t sheet, const glm::dvec3& p) const { return project(sheet, p).position; }

  // Traits with safe defaults.
  [[nodiscard]] virtual bool convex() const { return false; }  // is the solid, or the flat polygon, a convex set?
  [[nodiscard]] virtual bool flat() const { return false; }    // is every sheet a plane?
  [[nodiscard]] virtual bool exact() const { return flat(); }  // is the approximation the object itself: flat, with straight borders?
  // Does project() find the nearest point, rather than a local minimum of the distance?
  [[nodiscard]] virtual bool nearest() const { return true; }
  [[nodiscard]] virtual bool solid() const { return true; }  // false: a surface without inside, whose back is black
  [[nodiscard]] virtual std::uint32_t sheet_count() const { return 1; }
  [[nodiscard]] virtual std::string_view sheet_name(std::uint32_t) const { return {}; }

  // The largest distance between a vertex made by approximate() and the surface used by spans(), beyond rounding: a polygon may be
  // non-planar by 1e-6 of its diameter. Points of such a sheet are not known more accurately.
  [[nodiscard]] virtual double slack() const { return 0.0; }

  // An object made of shapes that the fast single-precision code knows declares them here (compile.hpp); any other is tested through
  // spans().
  virtual void compile(Compiler&) const {}

  // For objects that compile to faces: the sheet of a face. Faces of one sheet lie in one plane.
  [[nodiscard]] virtual std::uint32_t sheet_of(std::uint32_t face) const { return face; }
  // For objects that compile to faces: the crossing of the line with this face, which it is known to cross, and the face's sheet. Bit for
  // bit the result of spans().
  [[nodiscard]] virtual Crossing crossing(const Segment&, std::uint32_t face) const { return {0.0, face}; }
  // For objects that compile to faces: -1 if the line, which comes near the face, enters through it, 1 if it leaves, 0 if it passes
  // beside. Bit for bit consistent with spans().
  [[nodiscard]] virtual int winding(const Segment&, std::uint32_t) const { return 0; }

  // The corners of a single planar polygon, counter-clockwise seen from the air, which a scene then stores in arrays. Empty for
  // all other objects.
  [[nodiscard]] virtual std::span<const glm::dvec3> outline() const { return {}; }

  // The spans, bit for bit, that meet [t0, t1], and possibly others. (A mesh then need not test its faces along the whole line.)
  virtual void spans_near(const Segment& line, double t0, double t1, Spans& out) const {
    static_cast<void>(t0), static_cast<void>(t1);
    spans(line, out);
  }

  // Approximate cost of spans(), in rays through a scene of few polygons.
  [[nodiscard]] virtual double work() const { return 0.25; }

  // Is it known, at less than the cost of spans(), that the line has at most one span? Never true if spans() finds more.
  [[nodiscard]] virtual bool passes_once(const Segment&) const { return convex(); }
};

// The result of a factory: the object, or a sentence that says why there is none.
template <class T>
struct Made {
  std::shared_ptr<const T> object;
  std::string refusal;

  Made() = default;
  Made(std::shared_ptr<const T> made) : object(std::move(made)) {}
  Made(std::string sentence) : refusal(std::move(sentence)) {}
  Made(const char* sentence) : refusal(sentence) {}
  template <class U>
  requires std::is_convertible_v<const U*, const T*> Made(Made<U> other)
      : object(std::move(other.object)), refusal(std::move(other.refusal)) {}

  explicit operator bool() const { return object != nullptr; }
  const T& operator*() const { return *object; }
  const T* operator->() const { return object.get(); }
};

// All factories refuse infinities, NaN, and coordinates beyond 1e60, because cubes and squares of lengths must stay finite.
[[nodiscard]] inline bool usable(double x) { return x > -largest_length && x < largest_length; }
[[nodiscard]] inline bool usable(const glm::dvec3& p) { return usable(p.x) && usable(p.y) && usable(p.z); }

// Is the length positive, above 1e-60, and significant beside coordinates of the given magnitude?
[[nodiscard]] inline bool usable_length(double length, double magnitude) {
  return length > smallest_length && length < largest_length && length > tol_vanishing * magnitude;
}

}  // namespace raycast
