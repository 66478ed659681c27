// SPDX-License-Identifier: MIT
// ElevationGrid and Extrusion of VRML 97, sections 6.17 and 6.18 of the standard, as the points and indices of a face set.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {
namespace {

class FaceMaker {
 public:
  explicit FaceMaker(const Node& node) : place_(node.place) {}

  void point(const glm::dvec3& p) { faces_.points.numbers.insert(faces_.points.numbers.end(), {p.x, p.y, p.z}); }
  void face(std::span<const std::size_t> corners) {
    for (const std::size_t corner : corners) { faces_.index.numbers.push_back(static_cast<double>(corner)); }
    faces_.index.numbers.push_back(-1.0);
  }
  Faces take() {
    faces_.index.places.assign(faces_.index.numbers.size(), place_);
    return std::move(faces_);
  }

 private:
  Place place_;
  Faces faces_;
};

// Is the number of points acceptable? A few numbers in a file can request millions of points.
bool fits(double columns, double rows) { return columns * rows <= 2e6; }

// Rotations of the cross-section, which lies in the xz plane, to be perpendicular to the spine at its points: the columns are x, y, z of
// the standard's spine-aligned cross-section plane (SCP).
using Planes = std::vector<glm::dmat3>;

// The rotation by the smallest angle that takes the y axis to this direction.
glm::dmat3 turned_from_y(const glm::dvec3& y) {
  const glm::dvec3 axis = glm::cross(glm::dvec3(0.0, 1.0, 0.0), y);
  const double sine = glm::length(axis);
  if (sine > 1e-12) { return glm::dmat3(glm::rotate(glm::dmat4(1.0), std::atan2(sine, y.y), axis / sine)); }
  return y.y < 0.0 ? glm::dmat3({1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}) : glm::dmat3(1.0);
}

// For a spine whose consecutive points are different.
Planes planes_of_distinct(std::span<const glm::dvec3> spine) {
  const std::size_t n = spine.size();
  if (n < 2) { return Planes(n, glm::dmat3(1.0)); }
  const bool closed = n > 2 && spine.front() == spine.back();
  const auto unit = [](const glm::dvec3& v) { return glm::length(v) > 0.0 ? glm::normalize(v) : v; };
  std::vector<glm::dvec3> y(n), z(n, glm::dvec3(0.0));
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i == 0, last = i + 1 == n;
    const glm::dvec3& before = !first ? spine[i - 1] : closed ? spine[n - 2] : spine[i];
    const glm::dvec3& after = !last ? spine[i + 1] : closed ? spine[1] : spine[i];
    const glm::dvec3 back = unit(before - spine[i]), ahead = unit(after - spine[i]);
    y[i] = unit(after - before);
    if (y[i] == glm::dvec3(0.0)) { y[i] = ahead; }  // the spine turns back on itself
    const glm::dvec3 across = glm::cross(ahead, back);
    if (glm::length(across) > 1e-9) { z[i] = glm::normalize(across); }  // otherwise the spine is straight at this point
  }
  const auto found = std::find_if(z.begin(), z.end(), [](const glm::dvec3& v) { return v != glm::dvec3(0.0); });
  Planes planes;
  if (found == z.end()) {
    planes.assign(n, turned_from_y(unit(spine[1] - spine[0])));
    return planes;
  }
  std::fill(z.begin(), found, *found);
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 && z[i] == glm::dvec3(0.0)) { z[i] = z[i - 1]; }
    if (i > 0 && glm::dot(z[i], z[i - 1]) < 0.0) { z[i] = -z[i]; }  // avoids a twist where the curvature changes sign
    const glm::dvec3 x = unit(glm::cross(y[i], z[i]));
    planes.emplace_back(x, y[i], glm::cross(x, y[i]));
  }
  return planes;
}

// Consecutive equal points share a plane.
Planes planes_of(std::span<const glm::dvec3> spine) {
  std::vector<glm::dvec3> distinct;
  std::vector<std::size_t> number;
  for (const glm::dvec3& p : spine) {
    if (distinct.empty() || distinct.back() != p) { distinct.push_back(p); }
    number.push_back(distinct.size() - 1);
  }
  const Planes of_distinct = planes_of_distinct(distinct);
  Planes planes;
  for (const std::size_t i : number) { planes.push_back(of_distinct[i]); }
  return planes;
}

// The i-th value, of `size` numbers; the last one is used beyond the end.
template <std::size_t size>
std::array<double, size> value(const Node& node, const char* field, std::size_t i, const std::array<double, size>& otherwise) {
  const Field* const found = node.find(field);
  const std::size_t count = found != nullptr ? found->numbers.size() / size : 0;
  if (count == 0) { return otherwise; }
  std::array<double, size> result{};
  std::copy_n(&found->numbers[size * std::min(i, count - 1)], size, result.begin());
  return result;
}

}  // namespace

std::optional<Faces> elevation_grid(const Node& node) {
  const double columns = node.number("xDimension", 0.0), rows = node.number("zDimension", 0.0);
  const Field* const height = node.find("height");
  const bool enough = height != nullptr && columns >= 2.0 && rows >= 2.0 && static_cast<double>(height->numbers.size()) >= columns * rows;
  if (!enough || !fits(columns, rows)) { return std::nullopt; }
  FaceMaker made(node);
  const auto nx = static_cast<std::size_t>(columns), nz = static_cast<std::size_t>(rows);
  const double dx = node.number("xSpacing", 1.0), dz = node.number("zSpacing", 1.0);
  for (std::size_t j = 0; j < nz; ++j) {
    for (std::size_t i = 0; i < nx; ++i) {
      made.point({dx * static_cast<double>(i), height->numbers[j * nx + i], dz * static_cast<double>(j)});
    }
  }
  for (std::size_t j = 0; j + 1 < nz; ++j) {
    for (std::size_t i = 0; i + 1 < nx; ++i) {  // counter-clockwise seen from above
      const std::size_t at = j * nx + i;
      made.face(std::array{at, at + nx, at + nx + 1, at + 1});
    }
  }
  return made.take();
}

std::optional<Faces> extrusion(const Node& node) {
  std::vector<glm::dvec2> section{{1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}};
  std::vector<glm::dvec3> spine{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  if (const Field* const given = node.find("crossSection")) {
    section.clear();
    for (std::size_t i = 0; i + 1 < given->numbers.size(); i += 2) { section.emplace_back(given->numbers[i], given->numbers[i + 1]); }
  }
  if (const Field* const given = node.find("spine")) {
    spine.clear();
    for (std::size_t i = 0; i + 2 < given->numbers.size(); i += 3) {
      spine.emplace_back(given->numbers[i], given->numbers[i + 1], given->numbers[i + 2]);
    }
  }
  const std::size_t rows = spine.size();
  if (section.size() < 2 || rows < 2 || !fits(static_cast<double>(section.size()), static_cast<double>(rows))) { return std::nullopt; }
  const bool round = section.size() > 3 && section.front() == section.back();
  if (round) { section.pop_back(); }
  const std::size_t n = section.size();
  FaceMaker made(node);
  const Planes planes = planes_of(spine);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto scale = value<2>(node, "scale", i, {1.0, 1.0});
    const auto turn = value<4>(node, "orientation", i, {0.0, 0.0, 1.0, 0.0});
    const glm::dvec3 axis(turn[0], turn[1], turn[2]);
    glm::dmat3 plane = planes[i];
    if (glm::length(axis) > 0.0) { plane = plane * glm::dmat3(glm::rotate(glm::dmat4(1.0), turn[3], glm::normalize(axis))); }
    for (const glm::dvec2& p : section) { made.point(spine[i] + plane * glm::dvec3(p.x * scale[0], 0.0, p.y * scale[1])); }
  }
  for (std::size_t i = 0; i + 1 < rows; ++i) {  // facing outwards if the section is counter-clockwise seen from the end of the spine
    for (std::size_t k = 0; k < (round ? n : n - 1); ++k) {
      const std::size_t a = i * n + k, b = i * n + (k + 1) % n;
      made.face(std::array{a, b, b + n, a + n});
    }
  }
  if (n < 3 || spine.front() == spine.back()) { return made.take(); }  // the ends of a closed spine are inside
  std::vector<std::size_t> cap(n);
  for (std::size_t k = 0; k < n; ++k) { cap[k] = n - 1 - k; }
  if (!node.is_false("beginCap")) { made.face(cap); }
  for (std::size_t k = 0; k < n; ++k) { cap[k] = (rows - 1) * n + k; }
  if (!node.is_false("endCap")) { made.face(cap); }
  return made.take();
}

}  // namespace apps::vrml
