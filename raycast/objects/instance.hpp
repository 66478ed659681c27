// SPDX-License-Identifier: MIT
#pragma once

// An object placed in the coordinates of another one: any number of instances, at any depth, share one object. (The objects of a scene
// share theirs without it: a PlacedObject is an object and a placement.) Every query is answered by the shared object in its own
// coordinates; project() is then the nearest point up to the condition number of the map, see transform.hpp.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

namespace raycast {

class Instance final : public Object {
 public:
  // Refuses: no object; a placement that `check` refuses; a placement that turns the object inside out, which only the outermost may do.
  static Made<Instance> make(std::shared_ptr<const Object> object, const Placement& placement) {
    if (!object) { return "an instance needs an object"; }
    if (placement.inside) { return "an instance cannot be turned inside out: turn what is made of it"; }
    if (std::optional<std::string> fault = check(placement)) { return std::move(*fault); }
    return std::shared_ptr<const Instance>(new Instance(PlacedObject(std::move(object), placement)));
  }

  [[nodiscard]] Box bounds() const override { return placed_.bounds(); }
  void spans(const Segment& line, Spans& out) const override { placed_.spans(line, out); }
  void approximate(double tolerance, brep::Builder& out) const override { placed_.approximate(tolerance, out); }
  [[nodiscard]] SurfacePoint project(std::uint32_t sheet, const glm::dvec3& p) const override { return placed_.project(sheet, p); }
  [[nodiscard]] glm::dvec3 vertex(std::uint32_t sheet, const glm::dvec3& p) const override { return placed_.vertex(sheet, p); }

  [[nodiscard]] bool convex() const override { return placed_.convex(); }
  [[nodiscard]] bool flat() const override { return placed_.flat(); }
  [[nodiscard]] bool exact() const override { return placed_.exact(); }
  [[nodiscard]] bool nearest() const override { return placed_.placement().identity() && placed_.object().nearest(); }
  [[nodiscard]] bool solid() const override { return placed_.solid(); }
  [[nodiscard]] std::uint32_t sheet_count() const override { return placed_.sheet_count(); }
  [[nodiscard]] std::string_view sheet_name(std::uint32_t sheet) const override { return placed_.sheet_name(sheet); }
  [[nodiscard]] double slack() const override { return placed_.slack(); }
  [[nodiscard]] double work() const override { return placed_.object().work(); }
  [[nodiscard]] std::span<const glm::dvec3> outline() const override { return outline_; }

 private:
  explicit Instance(PlacedObject placed) : placed_(std::move(placed)), outline_(placed_.outline()) {}

  PlacedObject placed_;
  std::vector<glm::dvec3> outline_;
};

}  // namespace raycast
