// SPDX-License-Identifier: MIT
#pragma once

// Directions in which light may come to a point, for the path tracer: what emits, as shapes in a binary tree. A shape is chosen on the
// way down the tree, at each node by power over squared distance (Conty Estevez and Kulla 2018), then a direction towards it.
//
//   flat emitters     the triangles of their faces; a point of a triangle, spread evenly over its area
//   curved emitters   spheres around pieces of their faces, large enough for the true surface; a direction, spread evenly over the solid
//                     angle of the sphere. One sphere for the whole of a compact one.
//
// The shapes only propose directions: what a direction carries is found by a ray. So a shape may be larger than what it stands for,
// overlap others or be hidden, and every direction has a density() that can be computed, which the balance heuristic needs (Veach and
// Guibas 1995).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/box.hpp>

#include <radiosity/form_factor.hpp>
#include <radiosity/material.hpp>
#include <radiosity/random.hpp>
#include <radiosity/surface.hpp>

namespace radiosity {

class Emitters {
 public:
  Emitters() = default;
  // `surfaces` are boundaries in the frame, refined or not; `emission`: radiant exitance of each input surface.
  Emitters(const std::vector<Surface>& surfaces, const std::vector<Color>& emission);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }

  struct Sample {
    glm::dvec3 direction{0.0};  // unit
    double density = 0.0;       // per solid angle, of all shapes together
  };
  // A direction from the point x into the hemisphere of the unit normal n; none when the chosen shape cannot be seen from there.
  template <class Numbers>
  [[nodiscard]] std::optional<Sample> sample(const glm::dvec3& x, const glm::dvec3& n, Numbers& random) const;

  // The density per solid angle of the directions that sample() gives, in the unit direction w. They may sum to less than 1: what is
  // missing are samples that gave none.
  [[nodiscard]] double density(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& w) const { return density(x, n, w, none); }

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  struct Shape {
    std::array<glm::dvec3, 3> corner{glm::dvec3{0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}};  // of a triangle
    glm::dvec3 normal{0.0};                                                               // of a triangle, unit; 0: a sphere
    glm::dvec3 centre{0.0};
    double radius = 0.0;  // of the sphere, or of one around the triangle
    double area = 0.0;    // of the triangle, or of the piece that the sphere stands for
    double power = 0.0;
    std::uint32_t surface = 0;
    [[nodiscard]] bool flat() const { return normal != glm::dvec3{0.0}; }
  };
  struct Node {
    glm::dvec3 centre{0.0};  // of a sphere around all shapes below
    double radius = 0.0;
    double power = 0.0;
    glm::dvec3 normal{0.0};   // of all shapes below, when they lie in one plane; else 0
    double offset = 0.0;      // of that plane
    std::uint32_t first = 0;  // its shape, or the first of its two children
    bool leaf = true;
    bool several = false;  // surfaces below
  };

  void add_flat(std::uint32_t surface, const Polygon& polygon, double exitance);
  void add_curved(std::uint32_t surface, const std::vector<Polygon>& faces, const raycast::PlacedObject& object, std::uint32_t sheet,
                  double exitance);
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t last);
  [[nodiscard]] double importance(const Node& node, const glm::dvec3& x, const glm::dvec3& n) const;
  [[nodiscard]] double first_share(const Node& node, const glm::dvec3& x, const glm::dvec3& n) const;
  [[nodiscard]] static double density_of(const Shape& shape, const glm::dvec3& x, const glm::dvec3& w, bool meets);
  // As above; the direction is known to meet the shape of the leaf `sampled`, whatever rounding says.
  [[nodiscard]] double density(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& w, std::uint32_t sampled) const;

  std::vector<Shape> shapes_;
  std::vector<Node> nodes_;  // the root first
};

namespace detail {

// Triangles that are hardly longer than wide: needles are halved across their longest edge, into 4096 pieces at most.
inline std::vector<std::array<glm::dvec3, 3>> compact_triangles(const std::vector<Polygon>& faces) {
  std::vector<std::array<glm::dvec3, 3>> pieces;
  for (const Polygon& face : faces) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) { pieces.push_back({face[0], face[i], face[i + 1]}); }
  }
  const std::size_t most = std::max<std::size_t>(4096, 2 * pieces.size());
  for (std::size_t k = 0; k < pieces.size() && pieces.size() < most;) {
    auto& [a, b, c] = pieces[k];
    const double ab = glm::length(b - a), bc = glm::length(c - b), ca = glm::length(a - c);
    const double longest = std::max({ab, bc, ca});
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    if (!(area > 0.0) || longest * longest <= 8.0 * area) {  // a right triangle of two equal legs has 4
      ++k;
      continue;
    }
    while (glm::length(b - a) < longest) {  // now a b is the longest
      const glm::dvec3 first = a;
      a = b;
      b = c;
      c = first;
    }
    const glm::dvec3 middle = 0.5 * (a + b);
    const std::array<glm::dvec3, 3> rest{middle, b, c};
    b = middle;
    pieces.push_back(rest);
  }
  return pieces;
}

}  // namespace detail

inline Emitters::Emitters(const std::vector<Surface>& surfaces, const std::vector<Color>& emission) {
  for (const Surface& surface : surfaces) {
    std::vector<std::vector<Polygon>> curved(surface.object->sheet_count());  // faces, by sheet
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      const std::uint32_t sheet = surface.brep.data(f).sheet;
      if (sheet == brep::no_sheet) { continue; }
      const Color& exitance = emission[surface.first_surface + sheet];
      if (is_black(exitance)) { continue; }
      Polygon polygon;
      for (const brep::HalfedgeId h : brep::halfedges_of(surface.brep, f)) {
        polygon.push_back(surface.brep.data(surface.brep.vertex(h)).position);
      }
      if (surface.object->flat()) {
        add_flat(surface.first_surface + sheet, polygon, exitance.x + exitance.y + exitance.z);
      } else {
        curved[sheet].push_back(std::move(polygon));
      }
    }
    for (std::uint32_t s = 0; s < curved.size(); ++s) {
      const Color& exitance = emission[surface.first_surface + s];
      if (!curved[s].empty()) {
        add_curved(surface.first_surface + s, curved[s], *surface.object, s, exitance.x + exitance.y + exitance.z);
      }
    }
  }
  if (shapes_.empty()) { return; }
  nodes_.reserve(2 * shapes_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(shapes_.size()));
}

inline void Emitters::add_flat(std::uint32_t surface, const Polygon& polygon, double exitance) {
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
    shape.power = exitance * shape.area;
    shape.surface = surface;
    shapes_.push_back(shape);
  }
}

inline void Emitters::add_curved(std::uint32_t surface, const std::vector<Polygon>& faces, const raycast::PlacedObject& object,
                                 std::uint32_t sheet, double exitance) {
  const auto pieces = detail::compact_triangles(faces);
  // How far the surface bulges out of its faces: half as much again as in the middle of the worst.
  double bulge = object.slack();
  double area = 0.0;
  raycast::Box bounds;
  for (const auto& [a, b, c] : pieces) {
    const glm::dvec3 middle = (a + b + c) / 3.0;
    bulge = std::max(bulge, 1.5 * glm::length(object.project(sheet, middle).position - middle));
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
    for (const glm::dvec3& p : {a, b, c}) { bounds.extend(p); }
  }
  const glm::dvec3 centre = 0.5 * (bounds.lo + bounds.hi);
  double radius = 0.0;
  for (const auto& piece : pieces) {
    for (const glm::dvec3& p : piece) { radius = std::max(radius, glm::length(p - centre)); }
  }
  // From afar a convex surface shows a quarter of its area on average (Cauchy 1832); a sphere that shows no more than twice that will do.
  if (std::numbers::pi * (radius + bulge) * (radius + bulge) <= 0.5 * area) {
    Shape whole;
    whole.centre = centre;
    whole.radius = radius + bulge;
    whole.area = area;
    whole.power = exitance * area;
    whole.surface = surface;
    shapes_.push_back(whole);
    return;
  }
  for (const auto& piece : pieces) {
    Shape shape;
    const auto& [a, b, c] = piece;
    shape.area = 0.5 * glm::length(glm::cross(b - a, c - a));
    if (!(shape.area > 0.0)) { continue; }
    shape.centre = (a + b + c) / 3.0;
    for (const glm::dvec3& p : piece) { shape.radius = std::max(shape.radius, glm::length(p - shape.centre)); }
    shape.radius += bulge;
    shape.power = exitance * shape.area;
    shape.surface = surface;
    shapes_.push_back(shape);
  }
}

// Halves the shapes [first, last): between surfaces while there are several, then by place.
inline void Emitters::build(std::uint32_t index, std::uint32_t first, std::uint32_t last) {
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
  if (!node.leaf) {
    const glm::dvec3 extent = centres.hi - centres.lo;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    auto middle = shapes.begin() + static_cast<std::ptrdiff_t>(shapes.size() / 2);
    if (node.several) {
      std::sort(shapes.begin(), shapes.end(), [](const Shape& a, const Shape& b) { return a.surface < b.surface; });
      // Of the borders between surfaces the one nearest to the middle.
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
    build(node.first, first, half);
    build(node.first + 1, half, last);
    return;
  }
  nodes_[index] = node;
}

// 0 when nothing below can be seen from the front side of x, or shows its front to x.
inline double Emitters::importance(const Node& node, const glm::dvec3& x, const glm::dvec3& n) const {
  const glm::dvec3 d = node.centre - x;
  if (!(glm::dot(n, d) + node.radius > 0.0)) { return 0.0; }
  if (node.normal != glm::dvec3{0.0} && !(glm::dot(node.normal, x) > node.offset)) { return 0.0; }
  return node.power / std::max({glm::dot(d, d), node.radius * node.radius, std::numeric_limits<double>::min()});
}

// The probability of the first child. Between surfaces neither gets less than a tenth, for the brighter one may be hidden. NaN when
// neither child can be seen.
inline double Emitters::first_share(const Node& node, const glm::dvec3& x, const glm::dvec3& n) const {
  const double first = importance(nodes_[node.first], x, n);
  const double second = importance(nodes_[node.first + 1], x, n);
  const double share = first / (first + second);
  return node.several && first > 0.0 && second > 0.0 ? 0.1 + 0.8 * share : share;
}

inline double Emitters::density_of(const Shape& shape, const glm::dvec3& x, const glm::dvec3& w, bool meets) {
  if (shape.flat()) {
    const double cosine = -glm::dot(shape.normal, w);
    const double height = glm::dot(shape.normal, x - shape.corner[0]);
    if (!(cosine > 0.0) || !(height > 0.0)) { return 0.0; }
    const double distance = height / cosine;
    if (!meets) {
      const glm::dvec3 p = x + distance * w;
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& a = shape.corner[i];
        if (glm::dot(glm::cross(shape.corner[(i + 1) % 3] - a, p - a), shape.normal) < 0.0) { return 0.0; }
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

inline double Emitters::density(const glm::dvec3& x, const glm::dvec3& n, const glm::dvec3& w, std::uint32_t sampled) const {
  if (nodes_.empty()) { return 0.0; }
  struct Entry {
    std::uint32_t node;
    double probability;
  };
  std::array<Entry, 128> stack;  // the tree halves surfaces, then their shapes: 2 x 32 levels at most, two entries each
  std::size_t top = 0;
  stack[top++] = {0, 1.0};
  double sum = 0.0;
  while (top > 0) {
    const auto [index, probability] = stack[--top];
    const Node& node = nodes_[index];
    if (node.leaf) {
      sum += probability * density_of(shapes_[node.first], x, w, index == sampled);
      continue;
    }
    const glm::dvec3 d = node.centre - x;
    const glm::dvec3 off = glm::cross(w, d);
    const double reach = 1.000001 * node.radius;  // rounding must not lose the leaf that was sampled
    if (glm::dot(off, off) > reach * reach || (!(glm::dot(w, d) > 0.0) && glm::dot(d, d) > reach * reach)) { continue; }
    const double share = first_share(node, x, n);
    if (share > 0.0) { stack[top++] = {node.first, probability * share}; }
    if (share < 1.0) { stack[top++] = {node.first + 1, probability * (1.0 - share)}; }
  }
  return sum;
}

template <class Numbers>
std::optional<Emitters::Sample> Emitters::sample(const glm::dvec3& x, const glm::dvec3& n, Numbers& random) const {
  if (nodes_.empty()) { return std::nullopt; }
  double choice = random.uniform();
  const double u = random.uniform();
  const double v = random.uniform();
  std::uint32_t index = 0;
  while (!nodes_[index].leaf) {
    const Node& node = nodes_[index];
    const double share = first_share(node, x, n);
    if (!(share >= 0.0)) { return std::nullopt; }
    if (choice < share) {
      choice = std::min(choice / share, 1.0 - 0x1p-53);
      index = node.first;
    } else {
      choice = std::min((choice - share) / (1.0 - share), 1.0 - 0x1p-53);
      index = node.first + 1;
    }
  }
  const Shape& shape = shapes_[nodes_[index].first];
  glm::dvec3 w{0.0};
  if (shape.flat()) {
    const double root = std::sqrt(u);
    const auto& [a, b, c] = shape.corner;
    w = (1.0 - root) * (a - x) + root * (1.0 - v) * (b - x) + root * v * (c - x);
  } else {
    const glm::dvec3 d = shape.centre - x;
    const double r2 = glm::dot(d, d);
    const double sine2 = shape.radius * shape.radius / r2;
    const double angle = 2.0 * std::numbers::pi * v;
    const bool within = !(sine2 < 1.0);
    const double below = within ? 2.0 * u : u * sine2 / (1.0 + std::sqrt(1.0 - sine2));  // 1 - cosine, from the axis
    const glm::dvec3 axis = r2 > 0.0 ? d / std::sqrt(r2) : n;
    const double sine = std::sqrt(std::max(0.0, below * (2.0 - below)));
    const auto [s, t] = orthonormal(axis);
    w = sine * std::cos(angle) * s + sine * std::sin(angle) * t + (1.0 - below) * axis;
  }
  const double length = glm::length(w);
  if (!(length > 0.0)) { return std::nullopt; }
  w /= length;
  if (!(glm::dot(n, w) > 0.0)) { return std::nullopt; }
  const double found = density(x, n, w, index);
  if (!(found > 0.0)) { return std::nullopt; }
  return Sample{w, found};
}

}  // namespace radiosity
