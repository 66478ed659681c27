// SPDX-License-Identifier: MIT
#include "apps/scene_file/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <raycast/objects/box.hpp>
#include <raycast/objects/cone.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/disk.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/superquadric.hpp>
#include <raycast/objects/torus.hpp>
#include <raycast/planar.hpp>

namespace apps::scene_file {
namespace {

using Shape = std::shared_ptr<const raycast::Object>;

std::string who(const ObjectSyntax& syntax) { return std::string(to_string(syntax.kind)) + " " + quoted(syntax.name.text) + ": "; }

// Takes the object out of what a factory of raycast/ returned, or reports its sentence.
template <class Made>
Shape take(Made made, const ObjectSyntax& syntax, Place place, Errors& errors) {
  if (made.object) { return std::move(made.object); }
  errors.add(place, who(syntax) + std::string(made.refusal));
  return nullptr;
}

Shape make_box(const ObjectSyntax& syntax, Errors& errors) {
  const glm::dvec3 lo = glm::min(syntax.from->value, syntax.to->value);
  const glm::dvec3 hi = glm::max(syntax.from->value, syntax.to->value);
  for (int i = 0; i < 3; ++i) {
    if (lo[i] < hi[i]) { continue; }
    errors.add(syntax.to->place, who(syntax) + "has no size along " + std::string(1, "xyz"[i]) + "; 'from' and 'to' are opposite corners");
    return nullptr;
  }
  return take(raycast::BoxObject::make(lo, hi), syntax, syntax.to->place, errors);
}

Shape make_disk(const ObjectSyntax& syntax, Errors& errors) {
  if (syntax.normal->value == glm::dvec3(0.0)) {
    errors.add(syntax.normal->place, who(syntax) + "'normal' has no direction; expected the vector towards which the disk shines");
    return nullptr;
  }
  return take(raycast::Disk::make(syntax.center->value, syntax.normal->value, syntax.radius->value), syntax, syntax.name.place, errors);
}

// Cylinders, cones and tori.
Shape make_turned(const ObjectSyntax& syntax, Errors& errors) {
  const glm::dvec3& axis = syntax.axis->value;
  const double radius = syntax.radius->value;
  if (axis == glm::dvec3(0.0)) {
    errors.add(syntax.axis->place, who(syntax) + "'axis' has no length; expected the vector " +
                                       (syntax.kind == Kind::torus ? "through the hole" : "from the bottom to the top"));
    return nullptr;
  }
  if (syntax.kind == Kind::torus) {
    return take(raycast::Torus::make(syntax.center->value, axis, radius, syntax.tube->value), syntax, syntax.tube->place, errors);
  }
  if (syntax.kind == Kind::cylinder) {
    return take(raycast::Cylinder::make(syntax.base->value, axis, radius), syntax, syntax.name.place, errors);
  }
  const double top = syntax.top ? syntax.top->value : 0.0;
  return take(raycast::Cone::make(syntax.base->value, axis, radius, top), syntax, syntax.name.place, errors);
}

Shape make_superquadric(const ObjectSyntax& syntax, Errors& errors) {
  const auto [profile, around] = syntax.exponents->value;
  const double ring = syntax.ring ? syntax.ring->value : 0.0;
  return take(raycast::Superquadric::make(syntax.center->value, syntax.radii->value, profile, around, ring), syntax,
              ring > 0.0 && !(ring > 1.0) ? syntax.ring->place : syntax.exponents->place, errors);
}

// Place of the vertex that lies farthest off the mean plane, if that is off by more than rounding; else `fallback`.
Place off_plane(const std::vector<glm::dvec3>& points, const std::vector<Place>& places, Place fallback) {
  glm::dvec3 normal(0.0);
  glm::dvec3 mean(0.0);
  glm::dvec3 lo = points[0];
  glm::dvec3 hi = points[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3& p = points[i];
    normal += glm::cross(p - points[0], points[(i + 1) % points.size()] - points[0]);
    mean += p / static_cast<double>(points.size());
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  const double length = glm::length(normal);
  if (!(length > 0.0)) { return fallback; }
  double worst = 1e-6 * glm::length(hi - lo);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = std::abs(glm::dot(points[i] - mean, normal)) / length;
    if (distance > worst) {
      worst = distance;
      fallback = places[i];
    }
  }
  return fallback;
}

bool few_enough(const ObjectSyntax& syntax, std::size_t corners, Place place, Errors& errors) {
  if (corners <= max_polygon_corners) { return true; }
  errors.add(place, who(syntax) + std::to_string(corners) + " corners are too many for one polygon; at most " +
                        std::to_string(max_polygon_corners));
  return false;
}

Shape make_polygon(const ObjectSyntax& syntax, Errors& errors) {
  if (!few_enough(syntax, syntax.vertices.size(), syntax.name.place, errors)) { return nullptr; }
  std::vector<glm::dvec3> points;
  std::vector<Place> places;
  for (const auto& vertex : syntax.vertices) {
    points.push_back(vertex.value);
    places.push_back(vertex.place);
  }
  auto made = raycast::Polygon::make(points);
  if (!made.object && points.size() > 3) { return take(std::move(made), syntax, off_plane(points, places, syntax.name.place), errors); }
  return take(std::move(made), syntax, syntax.name.place, errors);
}

// Every face alone, so that a fault is reported at its line.
bool check_faces(const ObjectSyntax& syntax, Errors& errors) {
  const std::size_t before = errors.count();
  std::vector<glm::dvec3> points;
  for (const FaceSyntax& face : syntax.faces) {
    if (errors.full()) { return false; }
    if (!few_enough(syntax, face.count, face.place, errors)) { continue; }
    points.clear();
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const std::uint32_t index = syntax.corners[face.first + i];
      if (index >= syntax.vertices.size()) {
        errors.add(face.place, who(syntax) + "there is no vertex " + std::to_string(index) + "; vertices are numbered 0 to " +
                                   std::to_string(syntax.vertices.size() - 1));
        break;
      }
      points.push_back(syntax.vertices[index].value);
    }
    if (points.size() != face.count) { continue; }
    if (const auto fault = raycast::polygon_fault(points)) { errors.add(face.place, who(syntax) + "the face " + *fault); }
  }
  return errors.count() == before && !errors.full();
}

Shape make_mesh(const ObjectSyntax& syntax, Errors& errors) {
  if (!check_faces(syntax, errors)) { return nullptr; }
  std::vector<glm::dvec3> positions;
  for (const auto& vertex : syntax.vertices) { positions.push_back(vertex.value); }
  std::vector<std::vector<std::uint32_t>> faces;
  for (const FaceSyntax& face : syntax.faces) {
    const auto first = syntax.corners.begin() + face.first;
    faces.emplace_back(first, first + face.count);
  }
  return take(raycast::Mesh::make(positions, faces), syntax, syntax.name.place, errors);
}

}  // namespace

Shape make_shape(const ObjectSyntax& syntax, Errors& errors) {
  switch (syntax.kind) {
    case Kind::polygon:
      return make_polygon(syntax, errors);
    case Kind::box:
      return make_box(syntax, errors);
    case Kind::sphere:
      return take(raycast::Sphere::make(syntax.center->value, syntax.radius->value), syntax, syntax.name.place, errors);
    case Kind::disk:
      return make_disk(syntax, errors);
    case Kind::cylinder:
    case Kind::cone:
    case Kind::torus:
      return make_turned(syntax, errors);
    case Kind::superquadric:
      return make_superquadric(syntax, errors);
    case Kind::mesh:
      return make_mesh(syntax, errors);
    case Kind::unite:
    case Kind::intersection:
    case Kind::difference:
      break;  // make_csg
  }
  return nullptr;
}

}  // namespace apps::scene_file
