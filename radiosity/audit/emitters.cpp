// SPDX-License-Identifier: MIT
#include <radiosity/audit/emitters.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/geometry.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/geometry/compact_triangles.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/draw.hpp>

namespace radiosity {

HALFLIGHT_INLINE bool Emitters::even(const std::vector<Surface>& surfaces, const std::vector<Color>& emission) {
  double area = 0.0, power = 0.0, brightest = 0.0, dimmest = std::numeric_limits<double>::infinity();
  bool all_around = true;  // are all emitting surfaces walls of rooms?
  for (const Surface& surface : surfaces) {
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      const std::uint32_t sheet = surface.brep.data(f).sheet;
      if (sheet == brep::no_sheet) { continue; }
      const Color& e = emission[surface.first_surface + sheet];
      const double exitance = sum_of_channels(e), of_face = brep::area(surface.brep, f);
      area += of_face;
      power += of_face * exitance;
      brightest = std::max(brightest, exitance);
      dimmest = std::min(dimmest, exitance);
      all_around = all_around && (exitance == 0.0 || surface.object->inside());
    }
  }
  return brightest * area <= 1.5 * power && (all_around || brightest <= 2.0 * dimmest);
}

// Number of flat faces by exitance.
[[nodiscard]] HALFLIGHT_INLINE std::map<double, std::size_t> faces_by_exitance(const Surface& surface, const std::vector<Color>& emission) {
  std::map<double, std::size_t> count;
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    const std::uint32_t sheet = surface.brep.data(f).sheet;
    if (sheet == brep::no_sheet || !surface.object->flat()) { continue; }
    const Color& e = emission[surface.first_surface + sheet];
    ++count[sum_of_channels(e)];
  }
  return count;
}

HALFLIGHT_INLINE Emitters::Emitters(const std::vector<Surface>& surfaces, const std::vector<Color>& emission) {
  if (even(surfaces, emission)) { return; }
  kept_as_.assign(emission.size(), brep::invalid_index);
  node_of_.assign(emission.size(), brep::invalid_index);
  for (const Surface& surface : surfaces) {
    std::vector<std::vector<Polygon>> curved(surface.object->sheet_count());  // curved faces, by sheet
    std::map<double, std::vector<Polygon>> bodies;                            // flat faces of this object, by exitance
    const std::map<double, std::size_t> alike = faces_by_exitance(surface, emission);
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      const std::uint32_t sheet = surface.brep.data(f).sheet;
      if (sheet == brep::no_sheet) { continue; }
      const Color& exitance = emission[surface.first_surface + sheet];
      if (is_black(exitance)) { continue; }
      Polygon polygon;
      for (const brep::HalfedgeId h : brep::halfedges_of(surface.brep, f)) {
        polygon.push_back(surface.brep.data(surface.brep.vertex(h)).position);
      }
      const double sum = sum_of_channels(exitance);
      if (!surface.object->flat()) {
        curved[sheet].push_back(std::move(polygon));
      } else if (alike.at(sum) <= most_single_faces) {
        add_flat(surface.first_surface + sheet, polygon, sum);
      } else {
        kept_as_[surface.first_surface + sheet] = surface.first_surface;
        bodies[sum].push_back(std::move(polygon));
      }
    }
    for (const auto& [sum, faces] : bodies) {
      auto pieces = detail::compact_triangles(faces);
      add_spheres(surface.first_surface, pieces, surface.object->slack(), sum);
    }
    for (std::uint32_t s = 0; s < curved.size(); ++s) {
      const Color& exitance = emission[surface.first_surface + s];
      if (!curved[s].empty()) { add_curved(surface.first_surface + s, curved[s], *surface.object, s, sum_of_channels(exitance)); }
    }
  }
  if (shapes_.empty()) { return; }
  nodes_.reserve(2 * shapes_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(shapes_.size()), true);
}

HALFLIGHT_INLINE void Emitters::guide(std::vector<PhotonGrid::Photon> photons, double diameter) {
  for (PhotonGrid::Photon& photon : photons) {
    if (kept_as_[photon.source] != brep::invalid_index) { photon.source = kept_as_[photon.source]; }
  }
  std::erase_if(photons, [&](const PhotonGrid::Photon& photon) { return node_of_[photon.source] == brep::invalid_index; });
  photons_ = PhotonGrid{photons, diameter};
}

HALFLIGHT_INLINE void Emitters::add_flat(std::uint32_t surface, const Polygon& polygon, double exitance) {
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    Shape shape;
    shape.corner = {polygon[0], polygon[i], polygon[i + 1]};
    const auto& [a, b, c] = shape.corner;
    const glm::dvec3 twice = glm::cross(b - a, c - a);
    const double length = glm::length(twice);
    if (!(length > 0.0)) { continue; }
    shape.normal = twice / length;
    shape.area = 0.5 * length;
    shape.centre = (a + b + c) / 3.0;
    for (const glm::dvec3& p : shape.corner) { shape.radius = std::max(shape.radius, glm::length(p - shape.centre)); }
    for (std::size_t k = 0; k < 3; ++k) { shape.inwards[k] = glm::cross(shape.normal, shape.corner[(k + 1) % 3] - shape.corner[k]); }
    shape.power = exitance * shape.area;
    shape.surface = surface;
    shapes_.push_back(shape);
  }
}

HALFLIGHT_INLINE void Emitters::add_curved(std::uint32_t surface, const std::vector<Polygon>& faces, const raycast::PlacedObject& object,
                                           std::uint32_t sheet, double exitance) {
  auto pieces = detail::compact_triangles(faces);
  // Estimated distance between the surface and its faces: 1.5 times the largest distance measured at the triangle centres.
  double bulge = object.slack();
  for (const auto& [a, b, c] : pieces) {
    const glm::dvec3 middle = (a + b + c) / 3.0;
    bulge = std::max(bulge, 1.5 * glm::length(object.project(sheet, middle).position - middle));
  }
  add_spheres(surface, pieces, bulge, exitance);
}

// Adds one sphere around all pieces, or, if that would be much larger than the pieces, spheres around halves of them. Larger spheres mean
// that a ray meets fewer: a curved room that shines all over is one sphere.
HALFLIGHT_INLINE void Emitters::add_spheres(std::uint32_t surface, std::span<std::array<glm::dvec3, 3>> pieces, double bulge,
                                            double exitance) {
  Shape shape;
  raycast::Box bounds, middles;
  for (const auto& [a, b, c] : pieces) {
    shape.area += triangle_area(a, b, c);
    for (const glm::dvec3& p : {a, b, c}) { bounds.extend(p); }
    middles.extend((a + b + c) / 3.0);
  }
  if (!(shape.area > 0.0)) { return; }
  shape.centre = 0.5 * (bounds.lo + bounds.hi);
  for (const auto& piece : pieces) {
    for (const glm::dvec3& p : piece) { shape.radius = std::max(shape.radius, glm::length(p - shape.centre)); }
  }
  shape.radius += bulge;
  // A square inside its bounding sphere fills 2 / pi of the sphere's outline when seen from the front: no smaller piece fills more. A
  // closed convex surface at this limit fills an eighth of its sphere's outline on average (a quarter of its area: Cauchy 1832).
  if (pieces.size() == 1 || std::numbers::pi * shape.radius * shape.radius <= 2.0 * shape.area) {
    shape.power = exitance * shape.area;
    shape.surface = surface;
    shapes_.push_back(shape);
    return;
  }
  const glm::dvec3 extent = middles.hi - middles.lo;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t half = pieces.size() / 2;
  std::nth_element(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(half), pieces.end(), [axis](const auto& a, const auto& b) {
    return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
  });
  add_spheres(surface, pieces.first(half), bulge, exitance);
  add_spheres(surface, pieces.subspan(half), bulge, exitance);
}

// Builds the tree of the shapes [first, last) by halving: between surfaces while there are several, then by position.
HALFLIGHT_INLINE void Emitters::build(std::uint32_t index, std::uint32_t first, std::uint32_t last, bool several_above) {
  Node node;
  const std::span<Shape> shapes = std::span{shapes_}.subspan(first, last - first);
  raycast::Box bounds, centres;
  node.normal = shapes[0].normal;
  node.offset = glm::dot(node.normal, shapes[0].centre);
  for (const Shape& shape : shapes) {
    centres.extend(shape.centre);
    bounds.extend(shape.centre - shape.radius);
    bounds.extend(shape.centre + shape.radius);
    node.power += shape.power;
    node.several = node.several || shape.surface != shapes[0].surface;
    if (shape.normal != shapes[0].normal || glm::dot(node.normal, shape.centre) != node.offset) { node.normal = glm::dvec3{0.0}; }
  }
  node.centre = shapes.size() == 1 ? shapes[0].centre : 0.5 * (bounds.lo + bounds.hi);
  for (const Shape& shape : shapes) { node.radius = std::max(node.radius, glm::length(shape.centre - node.centre) + shape.radius); }
  node.leaf = shapes.size() == 1;
  node.first = first;
  if (several_above && !node.several) {
    node.surface = shapes[0].surface;
    node_of_[node.surface] = index;
  }
  if (!node.leaf) {
    const glm::dvec3 extent = centres.hi - centres.lo;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    auto middle = shapes.begin() + static_cast<std::ptrdiff_t>(shapes.size() / 2);
    if (node.several) {
      std::sort(shapes.begin(), shapes.end(), [](const Shape& a, const Shape& b) { return a.surface < b.surface; });
      // The border between two surfaces that is nearest to the middle.
      auto border = std::partition_point(shapes.begin(), shapes.end(), [&](const Shape& s) { return s.surface < middle->surface; });
      if (border == shapes.begin()) {
        border = std::partition_point(shapes.begin(), shapes.end(), [&](const Shape& s) { return s.surface <= middle->surface; });
      }
      middle = border;
    } else {
      std::nth_element(shapes.begin(), middle, shapes.end(),
                       [axis](const Shape& a, const Shape& b) { return a.centre[axis] < b.centre[axis]; });
    }
    const auto half = first + static_cast<std::uint32_t>(middle - shapes.begin());
    node.first = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[index] = node;
    build(node.first, first, half, node.several);
    build(node.first + 1, half, last, node.several);
    return;
  }
  nodes_[index] = node;
}

// Power over squared distance; 0 if nothing below can be seen from the front side of x or shows its front to x.
HALFLIGHT_INLINE double Emitters::importance(const Node& node, const glm::dvec3& x, const glm::dvec3& n) const {
  const glm::dvec3 d = node.centre - x;
  if (!(glm::dot(n, d) + node.radius > 0.0)) { return 0.0; }
  if (node.normal != glm::dvec3{0.0} && !(glm::dot(node.normal, x) > node.offset)) { return 0.0; }
  return node.power / std::max(std::max(glm::dot(d, d), node.radius * node.radius), std::numeric_limits<double>::min());
}

// The probability of the first child. Between surfaces neither child gets less than a tenth, because the brighter one may be hidden. NaN
// if neither child can be seen.
HALFLIGHT_INLINE double Emitters::first_share(const Node& node, const glm::dvec3& x, const glm::dvec3& n) const {
  const double first = importance(nodes_[node.first], x, n);
  const double second = importance(nodes_[node.first + 1], x, n);
  const double share = first / (first + second);
  return node.several && first > 0.0 && second > 0.0 ? 0.1 + 0.8 * share : share;
}

HALFLIGHT_INLINE double Emitters::density_of(const Shape& shape, const glm::dvec3& x, const glm::dvec3& w, bool meets) {
  if (shape.flat()) {
    const double cosine = -glm::dot(shape.normal, w);
    const double height = glm::dot(shape.normal, x - shape.corner[0]);
    if (!(cosine > 0.0) || !(height > 0.0)) { return 0.0; }
    const double distance = height / cosine;
    if (!meets) {
      const glm::dvec3 p = x + distance * w;
      for (std::size_t i = 0; i < 3; ++i) {
        if (glm::dot(shape.inwards[i], p - shape.corner[i]) < 0.0) { return 0.0; }
      }
    }
    return distance * distance / (cosine * shape.area);
  }
  const glm::dvec3 d = shape.centre - x;
  const double r2 = glm::dot(d, d);
  const double sine2 = shape.radius * shape.radius / r2;
  if (!(sine2 < 1.0)) { return 0.25 * std::numbers::inv_pi; }  // x is within
  const glm::dvec3 off = glm::cross(w, d);
  if (!meets && (glm::dot(off, off) > shape.radius * shape.radius || !(glm::dot(w, d) > 0.0))) { return 0.0; }
  const double solid_angle = 2.0 * std::numbers::pi * sine2 / (1.0 + std::sqrt(1.0 - sine2));
  return 1.0 / solid_angle;
}

HALFLIGHT_INLINE bool Emitters::meets(const Node& node, const glm::dvec3& x, const glm::dvec3& w) {
  const glm::dvec3 d = node.centre - x;
  const glm::dvec3 off = glm::cross(w, d);
  const double reach = 1.000001 * node.radius;  // rounding must not lose the leaf that was sampled
  return glm::dot(off, off) <= reach * reach && (glm::dot(w, d) > 0.0 || glm::dot(d, d) <= reach * reach);
}

HALFLIGHT_INLINE double Emitters::density(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& w, std::uint32_t sampled,
                                          std::size_t* opened) const {
  if (nodes_.empty()) { return 0.0; }
  struct Entry {
    std::uint32_t node;
    double probability;
  };
  std::array<Entry, 128> stack;  // the tree halves surfaces, then their shapes: 2 x 32 levels at most, two entries each
  std::size_t top = 0;
  double sum = 0.0;
  const PhotonGrid::Around around = photons_.around(x, n);
  bool met_sampled = sampled == brep::invalid_index;
  const auto take = [&](std::uint32_t index, double by_tree) {
    if (!(by_tree > 0.0)) { return; }
    const Node& node = nodes_[index];
    const double probability =
        node.surface == brep::invalid_index ? by_tree : (1.0 - around.trust) * by_tree + around.trust * around.share_of(node.surface);
    if (node.leaf) {
      const double of_leaf = density_of(shapes_[node.first], x, w, index == sampled);
      met_sampled = met_sampled || (index == sampled && of_leaf > 0.0);
      sum += probability * of_leaf;
    } else {
      stack[top++] = {index, probability};
    }
  };
  if (meets(nodes_[0], x, w)) { take(0, 1.0); }
  while (top > 0) {
    const auto [index, probability] = stack[--top];
    const Node& node = nodes_[index];
    if (opened != nullptr) { ++*opened; }
    const bool first = meets(nodes_[node.first], x, w), second = meets(nodes_[node.first + 1], x, w);
    if (!first && !second) { continue; }
    const double share = first_share(node, x, n);
    if (first) { take(node.first, probability * share); }
    if (second) { take(node.first + 1, probability * (1.0 - share)); }
  }
  return met_sampled ? sum : 0.0;
}

HALFLIGHT_INLINE double Emitters::work(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& w) const {
  constexpr double node = 0.015;        // fitted to furnaces with some twenty walls of different brightness
  constexpr std::size_t of_a_lamp = 2;  // already included in the cost of a ray among few polygons
  std::size_t opened = 0;
  static_cast<void>(density(x, n, w, brep::invalid_index, &opened));
  return opened > of_a_lamp ? node * static_cast<double>(opened - of_a_lamp) : 0.0;
}

}  // namespace radiosity
