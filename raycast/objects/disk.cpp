// SPDX-License-Identifier: MIT
#include <raycast/objects/disk.hpp>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/circle.hpp>
#include <raycast/object.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

HALFLIGHT_INLINE Made<Disk> Disk::make(const glm::dvec3& centre, const glm::dvec3& normal, double radius) {
  if (!usable(centre) || !usable(normal)) { return "a disk's centre and normal must be finite (and below 1e60)"; }
  if (!usable_length(glm::length(normal), 0.0)) { return "a disk's normal must have a length: it says which side is seen"; }
  if (!usable_length(radius, Box{centre, centre}.magnitude())) {
    return "a disk's radius must be positive, finite and not vanishing beside its centre's coordinates";
  }
  return std::shared_ptr<const Disk>(new Disk(centre, normal, radius));
}

HALFLIGHT_INLINE Box Disk::bounds() const {
  Box box;
  frame_.extend(box, centre_, radius_);
  return box.grown(eps_bounds * box.magnitude());
}

HALFLIGHT_INLINE void Disk::spans(const Segment& line, Spans& out) const {
  const double along = glm::dot(frame_.w, line.direction);
  const double shift = nearest_parameter(line, centre_);
  const glm::dvec3 f = line.at(shift) - centre_;
  if (along == 0.0 || !(glm::dot(f, f) < radius_ * radius_)) { return; }
  const double height = glm::dot(frame_.w, f), step = -height / along;
  const glm::dvec3 across = (f - height * frame_.w) + step * (line.direction - along * frame_.w);
  if (glm::dot(across, across) < radius_ * radius_) { out.push(Span{{shift + step, 0}, {shift + step, 0}}); }
}

HALFLIGHT_INLINE void Disk::approximate(double tolerance, brep::Builder& out) const {
  const int n = circle_points(tolerance / radius_);
  const double angle = 2 * std::numbers::pi / n, radius = radius_ * std::sqrt(angle / std::sin(angle));
  std::vector<std::uint32_t> front;
  for (int i = 0; i < n; ++i) {
    const glm::dvec2 p = circle_point(i, n);
    front.push_back(out.vertex(centre_ + radius * (p.x * frame_.u + p.y * frame_.v)));
  }
  out.face(std::span<const std::uint32_t>(front), 0);
  const std::vector<std::uint32_t> back(front.rbegin(), front.rend());
  out.face(std::span<const std::uint32_t>(back), brep::no_sheet);
}

}  // namespace raycast
