// SPDX-License-Identifier: MIT
#include <raycast/transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

HALFLIGHT_INLINE std::optional<std::string> check(const Placement& placement) {
  const glm::dmat3& m = placement.linear;
  if (!usable(m[0]) || !usable(m[1]) || !usable(m[2]) || !usable(placement.translation)) {
    return "the placement is not finite (or beyond 1e60)";
  }
  double product = 1.0;
  for (int k = 0; k < 3; ++k) { product *= glm::length(m[k]); }
  if (!(product > smallest_volume) || !(std::abs(glm::determinant(m)) > tol_singular * product)) {
    return "the placement flattens the object: its determinant is zero";
  }
  return std::nullopt;
}

HALFLIGHT_INLINE double stretch(const glm::dmat3& linear) {
  glm::dmat3 power = glm::transpose(linear) * linear;
  double log_scale = 0.0, exponent = 1.0;
  for (int i = 0; i <= 9; ++i) {
    const double trace = power[0][0] + power[1][1] + power[2][2];
    log_scale += std::log(trace) * exponent;
    if (i == 9) { break; }
    power = power / trace;
    power = power * power;
    exponent *= 0.5;
  }
  return std::exp(0.5 * log_scale);
}

HALFLIGHT_INLINE bool keeps_angles(const glm::dmat3& linear) {
  const glm::dmat3 square = glm::transpose(linear) * linear;
  const double s = (square[0][0] + square[1][1] + square[2][2]) / 3;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!(std::abs(square[i][j] - (i == j ? s : 0.0)) <= tol_similar * s)) { return false; }
    }
  }
  return true;
}

HALFLIGHT_INLINE PlacedObject::PlacedObject(std::shared_ptr<const Object> object, const Placement& placement)
    : object_(std::move(object)), placement_(placement), identity_(placement.identity()) {
  if (!identity_) {
    inverse_ = glm::inverse(placement_.linear);
    normal_map_ = glm::transpose(inverse_);
    stretch_ = stretch(placement_.linear);
  }
  if (const std::span<const glm::dvec3> corners = object_->outline(); !corners.empty()) {
    for (const glm::dvec3& p : corners) { bounds_.extend(to_world(p)); }
  } else {
    bounds_ = world_box(object_->bounds());
  }
  if (!object_->flat()) { return; }
  const glm::dvec3 anywhere = object_->bounds().centre();
  std::vector<glm::dvec3> normals(object_->sheet_count());
  for (std::uint32_t s = 0; s < normals.size(); ++s) { normals[s] = normal_to_world(object_->project(s, anywhere).normal); }
  normals_ = std::make_shared<const std::vector<glm::dvec3>>(std::move(normals));
}

HALFLIGHT_INLINE std::vector<glm::dvec3> PlacedObject::outline() const {
  const std::span<const glm::dvec3> corners = object_->outline();
  std::vector<glm::dvec3> result;
  for (const glm::dvec3& p : corners) { result.push_back(to_world(p)); }
  if (mirrored()) { std::reverse(result.begin(), result.end()); }
  return result;
}

HALFLIGHT_INLINE void PlacedObject::approximate(double tolerance, brep::Builder& out) const {
  if (identity_ && !placement_.inside) { return object_->approximate(tolerance, out); }
  brep::Builder local;
  object_->approximate(tolerance / stretch_, local);
  if (local.vertex_count() == 0) { return; }
  const std::uint32_t first = out.vertex(to_world(local.position(0)));
  for (std::uint32_t v = 1; v < local.vertex_count(); ++v) { out.vertex(to_world(local.position(v))); }
  std::vector<std::uint32_t> corners;
  for (std::uint32_t f = 0; f < local.face_count(); ++f) {
    corners.assign(local.corners(f).begin(), local.corners(f).end());
    for (std::uint32_t& v : corners) { v += first; }
    if (mirrored() != placement_.inside) {
      std::reverse(corners.begin() + 1, corners.end());  // corner 0 stays first
    }
    out.face(std::span<const std::uint32_t>(corners), local.sheet(f));
  }
}

HALFLIGHT_INLINE SurfacePoint PlacedObject::project(std::uint32_t sheet, const glm::dvec3& p) const {
  const SurfacePoint local = object_->project(sheet, identity_ ? p : inverse_ * (p - placement_.translation));
  return {to_world(local.position), normals_ ? (*normals_)[sheet] : normal_to_world(local.normal)};
}

HALFLIGHT_INLINE glm::dvec3 PlacedObject::vertex(std::uint32_t sheet, const glm::dvec3& p) const {
  return identity_ ? object_->vertex(sheet, p) : to_world(object_->vertex(sheet, inverse_ * (p - placement_.translation)));
}

HALFLIGHT_INLINE Box PlacedObject::world_box(const Box& box) const {
  if (identity_) { return box; }
  const glm::dvec3 centre = placement_.linear * box.centre() + placement_.translation, half = 0.5 * box.size();
  Box result{centre, centre};
  for (int row = 0; row < 3; ++row) {
    double reach = 0.0, sum = std::abs(placement_.translation[row]);
    for (int column = 0; column < 3; ++column) {
      reach += std::abs(placement_.linear[column][row]) * half[column];
      sum += std::abs(placement_.linear[column][row]) * box.magnitude();
    }
    result.lo[row] -= reach + eps_map * sum;
    result.hi[row] += reach + eps_map * sum;
  }
  return result;
}

}  // namespace raycast
