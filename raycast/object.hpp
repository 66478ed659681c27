// SPDX-License-Identifier: MIT
#pragma once

// An object keeps its original, exact representation from the scene file to the end of the run; the mesh of the radiosity solution is
// only derived from it (paper 4.1: "objects keep their original representation as long as possible"). To become a full member a new
// object implements four methods:
//
//   bounds        where it is
//   spans         where a line is inside it                   (the paper's intersection with a ray)
//   approximate   its polygonal mesh, into a brep::Builder     (the paper's approxShape)
//   project       the nearest point of a sheet, and its normal (new vertices are placed on the true surface with it)
//
// A sheet is a smooth piece of the surface: a sphere has one, a cylinder three, a box six. Objects are immutable after they were made,
// so any number of threads may ask. They speak in their own coordinates; transform.hpp places them in the world.

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
  glm::dvec3 normal{0.0};  // unit length, out of the solid = into the air
};

class Compiler;

inline constexpr std::uint32_t no_object = 0xffffffff;  // an object's number in a scene: none

class Object {
 public:
  Object() = default;
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  virtual ~Object() = default;

  [[nodiscard]] virtual Box bounds() const = 0;

  // Adds to `out` (which is empty) where the whole line, t in R, is inside the solid. Requires has_line(line).
  // A surface without inside gives spans of length zero.
  virtual void spans(const Segment& line, Spans& out) const = 0;

  // Adds a closed mesh to `out`: vertices on the surface, faces counter-clockwise seen from the air, each face within `tolerance`
  // (a length) of the surface. Where the object has no surface (the back of a polygon, a hole of an open mesh) the mesh is closed
  // by faces of brep::no_sheet.
  virtual void approximate(double tolerance, brep::Builder& out) const = 0;

  // The point of the sheet's smooth surface that is nearest to p, and the normal there. The surface is not trimmed: a box's sheet is a
  // whole plane, a cylinder's side goes on beyond its caps. Idempotent up to rounding.
  [[nodiscard]] virtual SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const = 0;

  // Where a new vertex of a mesh comes to lie that is made at p between others on the sheet: nearest to p, but on an edge within the sheet
  // if the others lie on it. There the sides of a blade are nearer than its edge, which would be lost.
  [[nodiscard]] virtual glm::dvec3 vertex(std::uint32_t sheet, const glm::dvec3& p) const { return project(sheet, p).position; }

  // Traits with safe defaults.
  [[nodiscard]] virtual bool convex() const { return false; }  // the solid, or the flat polygon, is a convex set
  [[nodiscard]] virtual bool flat() const { return false; }    // every sheet is a plane
  [[nodiscard]] virtual bool exact() const { return flat(); }  // the approximation is the object: flat, with straight borders
  [[nodiscard]] virtual bool nearest() const { return true; }  // project() finds the nearest point, not only one that is nearest around it
  [[nodiscard]] virtual bool solid() const { return true; }    // false: a surface without inside, whose back is black
  [[nodiscard]] virtual std::uint32_t sheet_count() const { return 1; }
  [[nodiscard]] virtual std::string_view sheet_name(std::uint32_t) const { return {}; }

  // The largest distance between a vertex that approximate() emits and the surface that spans() answers for, beyond rounding: a polygon
  // may be non-planar by 1e-6 of its diameter. Points of such a sheet are known no better than this.
  [[nodiscard]] virtual double slack() const { return 0.0; }

  // An object that consists of shapes which the fast lanes know tells them (compile.hpp). Whatever says nothing is asked through spans().
  virtual void compile(Compiler&) const {}

  // Of objects that compile to faces: the sheet of a face; two of one sheet lie in one plane.
  [[nodiscard]] virtual std::uint32_t sheet_of(std::uint32_t face) const { return face; }
  // Of objects that compile to faces: where the line crosses the face, which it is known to do, and the sheet that the face belongs to.
  // Bit for bit what spans() says.
  [[nodiscard]] virtual Crossing crossing(const Segment&, std::uint32_t face) const { return {0.0, face}; }
  // Of objects that compile to faces: -1 where the line, which comes near the face, enters through it, 1 where it leaves, 0 where it passes
  // beside. Bit for bit what spans() says.
  [[nodiscard]] virtual int winding(const Segment&, std::uint32_t) const { return 0; }

  // A single planar polygon returns its corners, counter-clockwise seen from the air, and a scene keeps it in array form.
  // Everything else returns nothing.
  [[nodiscard]] virtual std::span<const glm::dvec3> outline() const { return {}; }

  // Those of the spans, bit for bit, that meet t in [0, 1], and perhaps others. A mesh need not look at its faces along the whole line.
  virtual void spans_of_segment(const Segment& segment, Spans& out) const { spans(segment, out); }

  // About what spans() costs, in rays through a scene of few polygons.
  [[nodiscard]] virtual double work() const { return 0.25; }

  // Is it known, for less than spans() costs, that the line is inside along one span at most? Never true where spans() finds more.
  [[nodiscard]] virtual bool passes_once(const Segment&) const { return convex(); }
};

// What a factory gives: the object, or a sentence that says why there is none.
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

// Coordinates beyond 1e60 in magnitude, infinities and NaN are refused by every factory: cubes and squares of lengths must stay finite.
[[nodiscard]] inline bool usable(double x) { return x > -largest_length && x < largest_length; }
[[nodiscard]] inline bool usable(const glm::dvec3& p) { return usable(p.x) && usable(p.y) && usable(p.z); }

// A length that is positive, above 1e-60, and not lost beside coordinates of the given magnitude.
[[nodiscard]] inline bool usable_length(double length, double magnitude) {
  return length > smallest_length && length < largest_length && length > tol_vanishing * magnitude;
}

}  // namespace raycast
