// SPDX-License-Identifier: MIT
// The kinds of objects: the table of the grammar, and the functions that make their shapes.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <brep/polygon.hpp>
#include <brep/union_find.hpp>

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

#include "apps/scene_file/lexer.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {
namespace {

std::string who(const ObjectSyntax& syntax) { return std::string(syntax.kind->word) + " " + in_quotes(syntax.name.text) + ": "; }

// Returns the object made by a factory of raycast/, or reports its refusal.
template <class Made>
Shape take(Made made, const ObjectSyntax& syntax, Place place, Errors& errors) {
  if (made.object) { return std::move(made.object); }
  errors.add(place, who(syntax) + std::string(made.refusal));
  return nullptr;
}

Shape make_box(const ObjectSyntax& syntax, Errors& errors) {
  const glm::dvec3 lo = glm::min(syntax.vector("from"), syntax.vector("to"));
  const glm::dvec3 hi = glm::max(syntax.vector("from"), syntax.vector("to"));
  for (int i = 0; i < 3; ++i) {
    if (lo[i] < hi[i]) { continue; }
    errors.add(syntax.place("to"),
               who(syntax) + "has no size along " + std::string(1, "xyz"[i]) + "; 'from' and 'to' are opposite corners");
    return nullptr;
  }
  return take(raycast::BoxObject::make(lo, hi), syntax, syntax.place("to"), errors);
}

Shape make_disk(const ObjectSyntax& syntax, Errors& errors) {
  if (syntax.vector("normal") == glm::dvec3(0.0)) {
    errors.add(syntax.place("normal"), who(syntax) + "'normal' has no direction; expected the vector towards which the disk shines");
    return nullptr;
  }
  return take(raycast::Disk::make(syntax.vector("center"), syntax.vector("normal"), syntax.number("radius")), syntax, syntax.name.place,
              errors);
}

Shape make_sphere(const ObjectSyntax& syntax, Errors& errors) {
  return take(raycast::Sphere::make(syntax.vector("center"), syntax.number("radius")), syntax, syntax.name.place, errors);
}

bool has_axis(const ObjectSyntax& syntax, const char* direction, Errors& errors) {
  if (syntax.vector("axis") != glm::dvec3(0.0)) { return true; }
  errors.add(syntax.place("axis"), who(syntax) + "'axis' has no length; expected the vector " + direction);
  return false;
}

Shape make_cylinder(const ObjectSyntax& syntax, Errors& errors) {
  if (!has_axis(syntax, "from the bottom to the top", errors)) { return nullptr; }
  return take(raycast::Cylinder::make(syntax.vector("base"), syntax.vector("axis"), syntax.number("radius")), syntax, syntax.name.place,
              errors);
}

Shape make_cone(const ObjectSyntax& syntax, Errors& errors) {
  if (!has_axis(syntax, "from the bottom to the top", errors)) { return nullptr; }
  const double top = syntax.find("top") != nullptr ? syntax.number("top") : 0.0;
  return take(raycast::Cone::make(syntax.vector("base"), syntax.vector("axis"), syntax.number("radius"), top), syntax, syntax.name.place,
              errors);
}

Shape make_torus(const ObjectSyntax& syntax, Errors& errors) {
  if (!has_axis(syntax, "through the hole", errors)) { return nullptr; }
  return take(raycast::Torus::make(syntax.vector("center"), syntax.vector("axis"), syntax.number("radius"), syntax.number("tube")), syntax,
              syntax.place("tube"), errors);
}

Shape make_superquadric(const ObjectSyntax& syntax, Errors& errors) {
  const auto [profile, around, unused] = syntax.find("exponents")->numbers;
  const double ring = syntax.find("ring") != nullptr ? syntax.number("ring") : 0.0;
  return take(raycast::Superquadric::make(syntax.vector("center"), syntax.vector("radii"), profile, around, ring), syntax,
              syntax.place(ring > 0.0 && !(ring > 1.0) ? "ring" : "exponents"), errors);
}

// The rounding error of the coordinates as written: half a unit of the last digit of the largest one. Writers drop zeros at the end, so
// the largest number of digits of any coordinate counts. Numbers with three or fewer digits count as exact.
double written_rounding(const std::vector<PlacedVertex>& vertices) {
  std::size_t digits = 0;
  double largest = 0.0;
  for (const PlacedVertex& vertex : vertices) {
    digits = std::max(digits, vertex.digits);
    for (int k = 0; k < 3; ++k) { largest = std::max(largest, std::abs(vertex.value[k])); }
  }
  if (digits < 4 || !(largest > 0.0)) { return 0.0; }
  return 0.5 * std::pow(10.0, std::floor(std::log10(largest)) + 1.0 - static_cast<double>(digits));
}

// Place of the vertex farthest from the mean plane, if its distance is more than `tolerance`; else `fallback`.
Place off_plane(const std::vector<glm::dvec3>& points, const std::vector<Place>& places, double tolerance, Place fallback) {
  glm::dvec3 normal(0.0);
  glm::dvec3 mean(0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3& p = points[i];
    normal += glm::cross(p - points[0], points[(i + 1) % points.size()] - points[0]);
    mean += p / static_cast<double>(points.size());
  }
  const double length = glm::length(normal);
  if (!(length > 0.0)) { return fallback; }
  double worst = tolerance;
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
  const double rounding = written_rounding(syntax.vertices);
  auto made = raycast::Polygon::make(points, rounding);
  if (!made.object && points.size() > 3) {
    const Place place = off_plane(points, places, raycast::planar_tolerance(points, rounding), syntax.name.place);
    return take(std::move(made), syntax, place, errors);
  }
  return take(std::move(made), syntax, syntax.name.place, errors);
}

// Checks every face on its own, so that a fault is reported at its line.
bool check_faces(const ObjectSyntax& syntax, Errors& errors) {
  const std::size_t before = errors.count();
  const double rounding = written_rounding(syntax.vertices);
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
    if (const auto fault = raycast::polygon_fault(points, rounding)) { errors.add(face.place, who(syntax) + "the face " + *fault); }
  }
  return errors.count() == before && !errors.full();
}

struct FaceLists {
  std::vector<glm::dvec3> positions;
  std::vector<std::vector<std::uint32_t>> faces;  // indices into the positions
};

// Separates the two sides of meshes that contain a sheet and its back on the same vertices. As one mesh they are not a manifold, because
// an edge inside the sheet has four faces, or they enclose nothing. With separate vertices the two sides are two surfaces back to back.
//
// Faces are connected if they share an edge with consistent orientation that is not a fold: if two faces are folded flat onto each other,
// one is the back of the other. Connected faces share vertices, others get copies. Every index must be in range.
FaceLists with_sides_parted(const FaceLists& mesh) {
  constexpr double tol_flat = 1e-9;  // for 1 + the cosine between the normals
  std::vector<glm::dvec3> normals, outline;
  std::multimap<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;  // directed, with the faces to which they belong
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<std::uint32_t>& face = mesh.faces[f];
    outline.clear();
    for (std::size_t i = 0; i < face.size(); ++i) {
      outline.push_back(mesh.positions[face[i]]);
      edges.emplace(std::pair(face[i], face[(i + 1) % face.size()]), f);
    }
    normals.push_back(glm::normalize(brep::vector_area(outline)));
  }
  brep::detail::UnionFind joined(mesh.faces.size());
  for (const auto& [edge, f] : edges) {
    const auto [first, last] = edges.equal_range({edge.second, edge.first});
    for (auto other = first; other != last; ++other) {
      if (glm::dot(normals[f], normals[other->second]) > tol_flat - 1.0) { joined.unite(f, other->second); }
    }
  }
  FaceLists parted;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;  // by connected component and vertex
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    parted.faces.emplace_back();
    for (const std::uint32_t v : mesh.faces[f]) {
      const auto [copy, is_new] = copies.emplace(std::pair(joined.find(f), v), static_cast<std::uint32_t>(parted.positions.size()));
      if (is_new) { parted.positions.push_back(mesh.positions[v]); }
      parted.faces.back().push_back(copy->second);
    }
  }
  return parted;
}

Shape make_mesh(const ObjectSyntax& syntax, Errors& errors) {
  if (!check_faces(syntax, errors)) { return nullptr; }
  FaceLists mesh;
  for (const auto& vertex : syntax.vertices) { mesh.positions.push_back(vertex.value); }
  for (const FaceSyntax& face : syntax.faces) {
    const auto first = syntax.corners.begin() + face.first;
    mesh.faces.emplace_back(first, first + face.count);
  }
  const double rounding = written_rounding(syntax.vertices);
  auto made = raycast::Mesh::make(mesh.positions, mesh.faces, rounding);
  if (!made) {
    const FaceLists parted = with_sides_parted(mesh);
    if (auto sides = raycast::Mesh::make(parted.positions, parted.faces, rounding)) { made = std::move(sides); }
  }
  return take(std::move(made), syntax, syntax.name.place, errors);
}

}  // namespace

std::span<const ObjectKind> object_kinds() {
  using enum Form;
  static const std::vector<ObjectKind> table = {
      // Columns: word, clauses, does it enclose a volume, function that makes it.
      {"polygon", {{"vertex", vertex}}, false, make_polygon},
      {"disk", {{"center", vector}, {"normal", vector}, {"radius", length}}, false, make_disk},
      {"box", {{"from", vector}, {"to", vector}}, true, make_box},
      {"sphere", {{"center", vector}, {"radius", length}}, true, make_sphere},
      {"cylinder", {{"base", vector}, {"axis", vector}, {"radius", length}}, true, make_cylinder},
      {"cone", {{"base", vector}, {"axis", vector}, {"radius", length}, {"top", length, false}}, true, make_cone},
      {"torus", {{"center", vector}, {"axis", vector}, {"radius", length}, {"tube", length}}, true, make_torus},
      {"superquadric", {{"center", vector}, {"radii", vector}, {"exponents", pair}, {"ring", length, false}}, true, make_superquadric},
      {"mesh", {{"vertex", vertex}, {"face", face}}, true, make_mesh},
      {"union", {}},
      {"intersection", {}},
      {"difference", {}},
  };
  return table;
}

}  // namespace apps::scene_file
