// SPDX-License-Identifier: MIT
#include "apps/intake/mgf.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <brep/polygon.hpp>
#include <brep/seams.hpp>

#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>
#include <raycast/transform.hpp>

namespace apps::intake::mgf {

namespace {

constexpr int sides_of_circle = 32;

}  // namespace

bool Shapes::take(const Line& line, Errors& errors) {
  static const std::map<std::string_view, void (Shapes::*)(const Line&, Errors&)> entities{
      {"v", &Shapes::choose_vertex},    {"p", &Shapes::position},  {"n", &Shapes::normal},   {"f", &Shapes::face},
      {"fh", &Shapes::face_with_holes}, {"prism", &Shapes::prism}, {"sph", &Shapes::sphere}, {"torus", &Shapes::torus},
      {"cyl", &Shapes::cylinder},       {"cone", &Shapes::cone},   {"ring", &Shapes::ring}};
  const auto found = entities.find(line.words[0]);
  if (found == entities.end()) { return false; }
  (this->*found->second)(line, errors);
  return true;
}

glm::dvec3 Shapes::vector(const Line& line, Errors& errors) {
  return {number(line, 1, errors), number(line, 2, errors), number(line, 3, errors)};
}

std::vector<glm::dvec3> Shapes::positions_of(const Line& line, std::size_t first, std::size_t end, Errors& errors) {
  std::vector<glm::dvec3> positions;
  for (std::size_t i = first; i < end; ++i) {
    if (const Vertex* const v = vertices_.find(line, i, errors)) { positions.push_back(v->position); }
  }
  return positions;
}

// Adds a polygon; corners before the transform, counter-clockwise seen from the front.
void Shapes::polygon(std::vector<glm::dvec3> corners, const Line& line) {
  if (glm::determinant(glm::dmat3(transform)) < 0.0) { std::reverse(corners.begin(), corners.end()); }
  std::vector<std::uint32_t> indices;
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 p(transform * glm::dvec4(corner, 1.0));
    const auto [known, is_new] = positions_.emplace(std::array{p.x, p.y, p.z}, static_cast<std::uint32_t>(model_.positions.size()));
    if (is_new) { model_.positions.push_back(p); }
    indices.push_back(known->second);
  }
  model_.polygon(indices, looks_.material(), static_cast<std::uint32_t>(model_.groups.size() - 1), line.place(0).line);
}

void Shapes::face(const Line& line, Errors& errors) {
  const std::vector<glm::dvec3> corners = positions_of(line, 1, line.words.size(), errors);
  if (line.words.size() < 4) { return errors.add(line.place(line.words.size()), "a face has at least three vertices"); }
  if (corners.size() + 1 == line.words.size()) { polygon(corners, line); }
}

// An outline, then outlines of holes, each after a '-'. Holes must have the opposite orientation of the outline; others are reversed.
void Shapes::face_with_holes(const Line& line, Errors& errors) {
  constexpr std::size_t most = 500;  // the search for seams tests all pairs of corners
  if (line.words.size() > most) { return notes_.add("faces with holes and more than 500 corners are left out", at(line)); }
  std::vector<std::vector<glm::dvec3>> loops;
  for (std::size_t first = 1, end = 1; first <= line.words.size(); first = end + 1) {
    end = first;
    while (end < line.words.size() && line.words[end] != "-") { ++end; }
    if (end - first < 3) { return errors.add(line.place(end), "a face, and each of its holes, has at least three vertices"); }
    loops.push_back(positions_of(line, first, end, errors));
    if (loops.back().size() < end - first) { return; }
  }
  for (std::size_t k = 1; k < loops.size(); ++k) {
    if (glm::dot(brep::vector_area(loops[k]), brep::vector_area(loops[0])) > 0.0) { std::reverse(loops[k].begin(), loops[k].end()); }
  }
  polygon(brep::join_holes(loops[0], {loops.begin() + 1, loops.end()}), line);
}

void Shapes::prism(const Line& line, Errors& errors) {
  std::vector<glm::dvec3> top;
  glm::dvec3 area(0.0);
  const std::size_t last = line.words.size() - 1;
  if (last < 4) { return errors.add(line.place(last + 1), "a prism has at least three vertices and a length"); }
  const std::vector<glm::dvec3> base = positions_of(line, 1, last, errors);
  if (base.size() + 1 != last) { return; }
  const double length = number(line, last, errors);
  for (std::size_t i = 2; i < base.size(); ++i) { area += glm::cross(base[i - 1] - base[0], base[i] - base[0]); }
  if (!(glm::length(area) > 0.0) || length == 0.0) { return notes_.add("shapes without size are left out", at(line)); }
  for (const glm::dvec3& p : base) { top.push_back(p - length * glm::normalize(area)); }
  for (std::size_t i = 0; i < base.size(); ++i) {
    const std::size_t next = (i + 1) % base.size();
    polygon({base[next], base[i], top[i], top[next]}, line);
  }
  polygon({top.rbegin(), top.rend()}, line);
  polygon(base, line);
}

// A negative radius means that the sphere is seen from inside.
void Shapes::sphere(const Line& line, Errors& errors) {
  const Vertex* const v = vertices_.find(line, 1, errors);
  const double radius = number(line, 2, errors);
  if (v != nullptr) { solid("sphere", raycast::Sphere::make(v->position, std::abs(radius)).object, radius < 0.0, line); }
}

void Shapes::torus(const Line& line, Errors& errors) {
  const Vertex* const v = vertices_.find(line, 1, errors);
  const double inner = number(line, 2, errors), outer = number(line, 3, errors);
  if (v == nullptr) { return; }
  const double small = std::abs(inner), large = std::abs(outer);
  solid("torus", raycast::Torus::make(v->position, v->normal, 0.5 * (small + large), 0.5 * (large - small)).object,
        inner < 0.0 || outer < 0.0, line);
}

void Shapes::solid(const char* kind, std::shared_ptr<const raycast::Object> object, bool from_within, const Line& line) {
  if (model_.objects.size() > max_objects) { return; }
  const raycast::Placement placement{glm::dmat3(transform), glm::dvec3(transform[3]), from_within};
  if (!object || raycast::check(*object, placement)) {
    return notes_.add("shapes without size, or flattened by their transform, are left out", at(line));
  }
  model_.objects.push_back({name.empty() ? kind : name, std::move(object), placement, {looks_.material()}});
  model_.origins.push_back({kind, line.place(0)});
}

void Shapes::strip_between_vertices(const Line& line, std::size_t second_radius, Errors& errors) {
  const Vertex *const a = vertices_.find(line, 1, errors), *const b = vertices_.find(line, 3, errors);
  const double from = number(line, 2, errors), to = second_radius == 2 ? from : number(line, second_radius, errors);
  if (a != nullptr && b != nullptr) { strip(a->position, b->position, b->position - a->position, from, to, line); }
}

void Shapes::ring(const Line& line, Errors& errors) {
  const Vertex* const v = vertices_.find(line, 1, errors);
  const double inner = number(line, 2, errors), outer = number(line, 3, errors);
  if (v != nullptr) { strip(v->position, v->position, v->normal, outer, inner, line); }
}

// The surface between a circle around `a` and one around `b`, both perpendicular to `axis`. The front is outside; for a ring it is the
// side to which the axis points; with a negative radius it is the other side. Radii may be 0.
void Shapes::strip(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& axis, double from, double to, const Line& line) {
  const double length = glm::length(axis), r = std::abs(from), s = std::abs(to);
  if (!(length > 0.0) || (r == 0.0 && s == 0.0) || (a == b && r == s)) { return notes_.add("shapes without size are left out", at(line)); }
  const glm::dvec3 n = axis / length;
  glm::dvec3 other(0.0);
  other[std::abs(n.x) < 0.6 ? 0 : std::abs(n.y) < 0.6 ? 1 : 2] = 1.0;
  const glm::dvec3 u = glm::normalize(glm::cross(n, other)), v = glm::cross(n, u);
  const auto point = [&](const glm::dvec3& centre, double radius, int i) {
    const double angle = 2.0 * std::numbers::pi * (i % sides_of_circle) / sides_of_circle;
    return centre + radius * (std::cos(angle) * u + std::sin(angle) * v);
  };
  const bool inwards = (from < 0.0 || to < 0.0);
  if (s == 0.0 && a == b) {  // a disk
    std::vector<glm::dvec3> disk;
    for (int i = 0; i < sides_of_circle; ++i) { disk.push_back(point(a, r, i)); }
    return polygon(std::move(disk), line);
  }
  for (int i = 0; i < sides_of_circle; ++i) {
    std::vector<glm::dvec3> corners;
    if (r > 0.0) {
      corners = {point(a, r, i), point(a, r, i + 1)};
    } else {
      corners = {a};
    }
    if (s > 0.0) {
      corners.insert(corners.end(), {point(b, s, i + 1), point(b, s, i)});
    } else {
      corners.push_back(b);
    }
    if (inwards) { std::reverse(corners.begin(), corners.end()); }
    polygon(std::move(corners), line);
  }
}

}  // namespace apps::intake::mgf
