// SPDX-License-Identifier: MIT
#include <radiosity/intake/side_light.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/ears.hpp>
#include <brep/inline.hpp>
#include <brep/polygon.hpp>

#include <raycast/box.hpp>
#include <raycast/line_query.hpp>
#include <raycast/ray.hpp>

#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>

namespace radiosity::intake {
HALFLIGHT_INLINE SideLight::SideLight(Working& mesh, std::span<const std::uint32_t> piece, std::uint32_t pieces)
    : mesh_(mesh), piece_(piece), views_(pieces) {
  std::vector<raycast::Box> boxes;
  raycast::Box all;
  for (const Face& face : mesh.faces) {
    const std::span<const glm::dvec3> outline = mesh.outline(face);
    outline_.emplace_back(outline.begin(), outline.end());
    plane_.push_back(raycast::plane_of(outline));
    area_.push_back(brep::area(outline));
    boxes.emplace_back();
    for (const glm::dvec3& p : outline) {
      boxes.back().extend(p);
      all.extend(p);
    }
    boxes.back() = boxes.back().grown(mesh.tolerance);
  }
  size_ = all.diameter();
  bvh_ = raycast::Bvh(boxes);
}

HALFLIGHT_INLINE SideLight::Met SideLight::first_met(const glm::dvec3& from, const glm::dvec3& direction, std::uint32_t source) const {
  const raycast::Segment ray{from, 2.0 * size_ * direction};
  const raycast::RayFrame frame(ray);
  const double same = 2.0 * mesh_.tolerance / size_;
  double limit = 1.0, best = 1.0 + same;
  Met met;
  raycast::nearest_along(bvh_, raycast::SlabTest(ray), 0.0, limit, [&](std::uint32_t f) {
    const double along = glm::dot(plane_[f].normal, ray.direction);
    const double t = along != 0.0 ? glm::dot(plane_[f].point - ray.origin, plane_[f].normal) / along : -1.0;
    if (f == source || !(t > 0.0 && t <= limit) || frame.winding(outline_[f]) == 0) { return; }
    const std::uint32_t side = 2 * f + (along < 0.0 ? 0 : 1);
    met.beside = t < best - same ? none : t < best ? met.side : side;
    met.side = t < best ? side : met.side;
    best = std::min(best, t);
    limit = std::min(1.0, best + same);
  });
  met.way = std::min(best, 1.0) * 2.0 * size_;
  return met;
}

HALFLIGHT_INLINE glm::dvec3 SideLight::point_of(std::uint32_t face, double u, double v) const {
  const std::span<const glm::dvec3> p = outline_[face];
  std::array<std::uint32_t, 3> corner{0, 1, 2};
  if (p.size() > 3) {
    const std::vector<std::array<std::uint32_t, 3>> triangles = brep::ears(p);
    if (triangles.empty()) { return brep::centroid(p); }
    double at = u * area_[face];
    for (const std::array<std::uint32_t, 3>& t : triangles) {
      corner = t;
      const double area = triangle_area(p[t[0]], p[t[1]], p[t[2]]);
      u = area > 0.0 ? std::clamp(at / area, 0.0, 1.0) : u;
      at -= area;
      if (at < 0.0) { break; }
    }
  }
  return triangle_point(triangle_weights(u, v), p[corner[0]], p[corner[1]], p[corner[2]]);
}

HALFLIGHT_INLINE std::uint32_t SideLight::nearest_point(std::uint32_t side, const glm::dvec3& place) const {
  std::uint32_t best = first_point_[side];
  double least = HUGE_VAL;
  for (std::uint32_t k = first_point_[side]; k < first_point_[side + 1]; ++k) {
    const glm::dvec3 way = points_[k].position - place;
    if (glm::dot(way, way) < least) {
      least = glm::dot(way, way);
      best = k;
    }
  }
  return best;
}

HALFLIGHT_INLINE bool SideLight::cut_off(const glm::dvec3& place, const Point& point, double way) const {
  constexpr double near = 0.25;  // relative to the length of the ray
  const glm::dvec3 across = point.position - place;
  const double distance = glm::length(across);
  if (!(distance > near * way)) { return false; }
  const glm::dvec3 normal = (point.side % 2 == 0 ? 1.0 : -1.0) * plane_[point.side / 2].normal;
  return first_met(place + 4.0 * mesh_.tolerance * normal, across / distance, point.side / 2).way < distance;
}

// Distributes half of the points by area, and half equally among the faces.
HALFLIGHT_INLINE void SideLight::place_points() {
  constexpr double all_points = 32'000.0, most = 128.0;
  double whole = 0.0;
  for (const double area : area_) { whole += area; }
  const double evenly = all_points / static_cast<double>(std::max<std::size_t>(area_.size(), 1));
  points_.clear();
  first_point_.assign(1, 0);
  for (std::uint32_t side = 0; side < 2 * area_.size(); ++side) {
    const double area = area_[side / 2], wanted = 0.5 * (evenly + all_points * (whole > 0.0 ? area / whole : 0.0));
    const auto count = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, most));
    Random random(0x5ead, side);
    for (std::uint32_t k = 0; k < count; ++k) {
      const double u = (k + random.uniform()) / count, v = random.uniform();
      points_.push_back({point_of(side / 2, u, v), side, area / count, 0.0, 0.0});
    }
    first_point_.push_back(static_cast<std::uint32_t>(points_.size()));
  }
  rays_ = points_.size() < 100'000 ? 8 : 4;
}

HALFLIGHT_INLINE void SideLight::shoot() {
  std::vector<double> area(views_.size(), 0.0);  // by piece
  for (std::uint32_t f = 0; f < area_.size(); ++f) { area[piece_[f]] += area_[f]; }
  met_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    const std::uint32_t face = point.side / 2, piece = piece_[face];
    const glm::dvec3 normal = (point.side % 2 == 0 ? 1.0 : -1.0) * plane_[face].normal;
    const glm::dvec3 from = point.position + 4.0 * mesh_.tolerance * normal;
    if (point.side % 2 == 0 && first_met(point.position - 4.0 * mesh_.tolerance * normal, normal, face).way <= 8.0 * mesh_.tolerance) {
      views_[piece].covered += point.area / area[piece];
    }
    SideView& view = point.side % 2 == 0 ? views_[piece].front : views_[piece].back;
    Random random(0x11647, k);
    for (std::uint32_t r = 0; r < rays_; ++r) {
      const double u = (r + random.uniform()) / rays_;
      const glm::dvec3 direction = cosine_direction(normal, u, random.uniform());
      const Met met = first_met(from, direction, face);
      const glm::dvec3 place = from + met.way * direction;
      RayEnd end{met.side == none ? none : nearest_point(met.side, place), met.beside == none ? none : nearest_point(met.beside, place)};
      const bool alone = end.point != none && end.beside == none;
      end.as_lit = alone && cut_off(place, points_[end.point], met.way) ? static_cast<std::uint32_t>(k) : end.point;
      met_.push_back(end);
      const double part = point.area / (area[piece] * rays_);
      view.way += met.way * part;
      if (met.side == none) { continue; }
      view.met += part;
      view.to_met += met.way * part;
    }
  }
}

// A lamp emits to the side with the longer distance to the surfaces that it lights, because a flat lamp close to a ceiling was not meant
// to light the ceiling. Directions in which there is nothing do not count: a part of the sky was not meant to light what is outside of it.
HALFLIGHT_INLINE void SideLight::set_lamps(std::span<const Material> materials) {
  constexpr double much_longer = 2.0;
  for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
    const Face& face = mesh_.faces[f];
    const bool back_shines = face.back != none && !is_black(materials[face.back].emission);
    if (is_black(materials[face.material].emission) && !back_shines) { continue; }
    const auto distance = [](const SideView& view) { return view.met > 0.0 ? view.to_met / view.met : 0.0; };
    const double front = distance(views_[piece_[f]].front), back = distance(views_[piece_[f]].back);
    sent_[2 * f] = front * much_longer >= back ? 1.0 : 0.0;
    sent_[2 * f + 1] = back * much_longer >= front ? 1.0 : 0.0;
  }
}

HALFLIGHT_INLINE void SideLight::set_eyes(std::span<const glm::dvec3> eyes) {
  constexpr std::uint32_t directions = 512;
  constexpr std::size_t most = 16;
  constexpr double as_lamps = 0.01;  // an eye emits as much as a lamp with this share of the total area
  double whole = 0.0;
  for (const double area : area_) { whole += area; }
  for (const glm::dvec3& eye : eyes.first(std::min(most, eyes.size()))) {
    for (std::uint32_t i = 0; i < directions; ++i) {  // on a spiral over the sphere
      const double z = 1.0 - (2.0 * i + 1.0) / directions, r = std::sqrt(1.0 - z * z), turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const Met met = first_met(eye, {r * std::cos(turn), r * std::sin(turn), z}, none);
      if (met.side != none) { sent_[met.side] += as_lamps * whole / directions / area_[met.side / 2]; }
    }
  }
}

// If two surfaces coincide, the darker one is used: from inside a box that stands against a larger one, the box's own wall, not that of
// the larger one, which may be lit around the box.
HALFLIGHT_INLINE double SideLight::light_along(const RayEnd& end) const {
  constexpr double reflectance = 0.7;
  if (end.point == none) { return outside_; }
  const Point& point = points_[end.point];
  if (end.beside == none) { return sent_[point.side] + reflectance * points_[end.as_lit].before; }
  const Point& beside = points_[end.beside];
  return std::max(sent_[point.side], sent_[beside.side]) + reflectance * std::min(point.before, beside.before);
}

HALFLIGHT_INLINE void SideLight::bounce() {
  constexpr int bounces = 12;
  for (int b = 0; b < bounces; ++b) {
    for (Point& point : points_) { point.before = point.light; }
    for (std::size_t k = 0; k < points_.size(); ++k) {
      double sum = 0.0;
      for (std::size_t r = k * rays_; r < (k + 1) * rays_; ++r) { sum += light_along(met_[r]); }
      points_[k].light = sum / rays_;
    }
  }
}

HALFLIGHT_INLINE std::vector<PieceView> SideLight::solve(std::span<const Material> materials, std::span<const glm::dvec3> eyes) {
  views_.assign(views_.size(), {});
  sent_.assign(2 * mesh_.faces.size(), 0.0);
  place_points();
  shoot();
  set_lamps(materials);
  set_eyes(eyes);
  const bool any = std::any_of(sent_.begin(), sent_.end(), [](double sent) { return sent > 0.0; });
  outside_ = any ? 1e-4 : 1.0;
  bounce();
  std::vector<double> area(views_.size(), 0.0);
  for (std::uint32_t f = 0; f < area_.size(); ++f) { area[piece_[f]] += area_[f]; }
  for (const Point& point : points_) {
    const std::uint32_t piece = piece_[point.side / 2];
    (point.side % 2 == 0 ? views_[piece].front : views_[piece].back).light += point.light * point.area / area[piece];
  }
  return views_;
}

}  // namespace radiosity::intake
