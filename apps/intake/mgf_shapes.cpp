// SPDX-License-Identifier: MIT
#include "apps/intake/mgf_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <brep/polygon.hpp>

#include <raycast/objects/sphere.hpp>
#include <raycast/objects/torus.hpp>
#include <raycast/transform.hpp>

namespace apps::intake::mgf {

namespace {

constexpr int sides_of_circle = 32;

// A face with holes as one polygon: from its outline a seam runs to each hole, around it and back.
class Seams {
 public:
  using Loop = std::vector<glm::dvec3>;

  // The inside lies to the left of all: the holes run the other way round than the outline.
  Seams(Loop outline, std::vector<Loop> holes) : outline_(std::move(outline)), holes_(std::move(holes)) {
    const glm::dvec3 n = brep::vector_area(outline_), size = glm::abs(n);
    const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    u_ = (drop + 1) % 3, v_ = (drop + 2) % 3;
    if (n[drop] < 0.0) { std::swap(u_, v_); }
  }

  [[nodiscard]] Loop join() {
    while (!holes_.empty()) { join(next_seam()); }
    return std::move(outline_);
  }

 private:
  struct Seam {
    double length;
    std::size_t corner, hole, of_hole;
  };

  [[nodiscard]] glm::dvec2 flat(const glm::dvec3& p) const { return {p[u_], p[v_]}; }
  // 1 when c lies left of a -> b, -1 when it lies right.
  [[nodiscard]] int side(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const {
    const glm::dvec2 ab = flat(b) - flat(a), ac = flat(c) - flat(a);
    const double area = ab.x * ac.y - ab.y * ac.x;
    return area > 0.0 ? 1 : area < 0.0 ? -1 : 0;
  }

  // The shortest seam to any of the holes that crosses nothing; when each of the shortest ones does, the shortest.
  [[nodiscard]] Seam next_seam() const {
    std::vector<Seam> seams;
    for (std::size_t h = 0; h < holes_.size(); ++h) {
      for (std::size_t k = 0; k < holes_[h].size(); ++k) {
        for (std::size_t i = 0; i < outline_.size(); ++i) { seams.push_back({glm::distance(outline_[i], holes_[h][k]), i, h, k}); }
      }
    }
    const auto few = seams.begin() + std::min<std::ptrdiff_t>(64, std::ssize(seams));
    std::partial_sort(seams.begin(), few, seams.end(), [](const Seam& a, const Seam& b) { return a.length < b.length; });
    const auto clear = std::find_if(seams.begin(), few, [&](const Seam& seam) { return is_clear(seam); });
    return clear == few ? seams.front() : *clear;
  }
  [[nodiscard]] bool is_clear(const Seam& seam) const {
    const glm::dvec3 &from = outline_[seam.corner], &to = holes_[seam.hole][seam.of_hole];
    return leads_inside(outline_, seam.corner, to) && leads_inside(holes_[seam.hole], seam.of_hole, from) && !crosses(outline_, from, to) &&
           std::none_of(holes_.begin(), holes_.end(), [&](const Loop& hole) { return crosses(hole, from, to); });
  }
  // O'Rourke, Computational Geometry in C, 1998, 1.5.
  [[nodiscard]] bool leads_inside(const Loop& loop, std::size_t i, const glm::dvec3& to) const {
    const glm::dvec3 &at = loop[i], &next = loop[(i + 1) % loop.size()], &before = loop[(i + loop.size() - 1) % loop.size()];
    if (side(at, next, before) >= 0) { return side(at, to, before) > 0 && side(to, at, next) > 0; }
    return !(side(at, to, next) >= 0 && side(to, at, before) >= 0);
  }
  // Touching counts; edges that begin where the segment ends do not.
  [[nodiscard]] bool crosses(const Loop& loop, const glm::dvec3& from, const glm::dvec3& to) const {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if (a == from || a == to || b == from || b == to) { continue; }
      if (side(from, to, a) * side(from, to, b) <= 0 && side(a, b, from) * side(a, b, to) <= 0) { return true; }
    }
    return false;
  }

  void join(const Seam& seam) {
    Loop loop = std::move(holes_[seam.hole]);
    holes_.erase(holes_.begin() + static_cast<std::ptrdiff_t>(seam.hole));
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(seam.of_hole), loop.end());
    loop.push_back(loop.front());
    loop.push_back(outline_[seam.corner]);
    outline_.insert(outline_.begin() + static_cast<std::ptrdiff_t>(seam.corner) + 1, loop.begin(), loop.end());
  }

  Loop outline_;
  std::vector<Loop> holes_;
  int u_ = 0, v_ = 1;
};

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

// Corners before the transform, counter-clockwise from the front.
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

// An outline, then outlines of holes, each after a '-'. Holes run the other way round than the outline; one that does not is turned.
void Shapes::face_with_holes(const Line& line, Errors& errors) {
  constexpr std::size_t most = 500;  // seams are looked for among all pairs of corners
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
  polygon(Seams(loops[0], {loops.begin() + 1, loops.end()}).join(), line);
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

// Seen from within where a radius is negative.
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

// What lies between a circle around `a` and one around `b`, both across `axis`: seen from outside, of a ring from where its axis points;
// with a negative radius from the other side. Radii may be 0.
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
