// SPDX-License-Identifier: MIT
#include <raycast/objects/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/inline.hpp>
#include <brep/union_find.hpp>

#include <raycast/box.hpp>
#include <raycast/bvh.hpp>
#include <raycast/compile.hpp>
#include <raycast/faces_apart.hpp>
#include <raycast/line_query.hpp>
#include <raycast/object.hpp>
#include <raycast/planar.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/tolerances.hpp>

namespace raycast {

HALFLIGHT_INLINE Made<Mesh> Mesh::make(const std::vector<glm::dvec3>& positions, const std::vector<std::vector<std::uint32_t>>& faces,
                                       double rounding) {
  std::shared_ptr<Mesh> mesh(new Mesh);
  if (std::string refusal = mesh->take(positions, faces, rounding); !refusal.empty()) { return refusal; }
  if (std::string refusal = mesh->close_borders(); !refusal.empty()) { return refusal; }
  if (mesh->borders_.empty() && !(mesh->volume() > 0.0)) {
    return "the mesh is closed and inside out: list the corners of its faces counter-clockwise seen from outside";
  }
  mesh->prepare();
  return std::shared_ptr<const Mesh>(std::move(mesh));
}

HALFLIGHT_INLINE void Mesh::spans_near(const Segment& line, double t0, double t1, Spans& out) const {
  if (solid()) { return spans(line, out); }
  const double distance = box_.magnitude() + glm::length(line.origin) + box_.diameter();
  const double margin = tol_beyond_ends + eps_surface * distance / glm::length(line.direction);
  spans_between(line, t0 - margin, t1 + margin, out);
}

HALFLIGHT_INLINE void Mesh::compile(Compiler& compiler) const {
  if (convex_ && slack_ == 0.0) {
    if (const std::vector<Plane> distinct = distinct_planes(); distinct.size() <= 32) { return compiler.body(distinct); }
  }
  if (!compiler.takes_faces(planes_.size()) || (compiler.room() && !embedded())) { return; }
  std::vector<glm::dvec3> polygon;
  for (std::uint32_t f = 0; f < planes_.size(); ++f) {
    polygon.clear();
    for (const std::uint32_t v : corners(f)) { polygon.push_back(positions_[v]); }
    compiler.face(f, polygon);
  }
}

HALFLIGHT_INLINE Crossing Mesh::crossing(const Segment& line, std::uint32_t face) const {
  double shift = 0.0;
  const Segment near = nearer(line, shift);
  return {shift + crossing_near(near, face), face};
}

HALFLIGHT_INLINE void Mesh::approximate(double, brep::Builder& out) const {
  std::vector<std::uint32_t> loop;
  const std::uint32_t first = positions_.empty() ? 0 : out.vertex(positions_[0]);
  for (std::size_t i = 1; i < positions_.size(); ++i) { out.vertex(positions_[i]); }
  const auto face = [&](std::span<const std::uint32_t> from, std::uint32_t sheet) {
    loop.assign(from.begin(), from.end());
    for (std::uint32_t& v : loop) { v += first; }
    out.face(std::span<const std::uint32_t>(loop), sheet);
  };
  for (std::uint32_t f = 0; f < planes_.size(); ++f) { face(corners(f), f); }
  for (const std::vector<std::uint32_t>& border : borders_) { face(border, brep::no_sheet); }
}

template <class Visit>
void Mesh::crossings(const Segment& line, double t0, double t1, Visit&& visit) const {
  // Seen from the middle of the mesh, rounding is relative to the size of the mesh, not to the distance of the ray's origin.
  double shift = 0.0;
  const Segment near = nearer(line, shift);
  const RayFrame frame(near);
  const auto cross = [&](std::uint32_t f) {
    if (const int w = winding(frame, f); w != 0) { visit(Crossing{shift + crossing_near(near, f), f}, w); }
    return false;
  };
  if (bvh_.empty()) {
    for (std::uint32_t f = 0; f < planes_.size(); ++f) { cross(f); }
  } else {
    static_cast<void>(any_along(bvh_, SlabTest(near), t0 - shift, t1 - shift, cross));
  }
}

HALFLIGHT_INLINE void Mesh::spans_between(const Segment& line, double t0, double t1, Spans& out) const {
  InlineVector<Crossing, 16> in, leave;
  crossings(line, t0, t1, [&](const Crossing& at, int w) { (w < 0 ? in : leave).push(at); });
  const auto earlier = [](const Crossing& a, const Crossing& b) { return a.t < b.t || (a.t == b.t && a.sheet < b.sheet); };
  if (!solid()) {
    for (const Crossing& c : leave) { in.push(c); }
  }
  std::sort(in.begin(), in.end(), earlier);
  std::sort(leave.begin(), leave.end(), earlier);
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (!solid()) {
      out.push(in[i]);
    } else if (i < leave.size()) {
      out.push(Span{in[i], leave[i]});
    }
  }
}

HALFLIGHT_INLINE std::vector<Plane> Mesh::distinct_planes() const {
  std::vector<Plane> distinct;
  for (const Plane& plane : planes_) {
    const auto same = [&](const Plane& other) {
      return glm::dot(plane.normal, other.normal) > 1.0 - tol_same_normal &&
             std::abs(glm::dot(plane.normal, plane.point - other.point)) < tol_same_plane * box_.diameter();
    };
    if (std::none_of(distinct.begin(), distinct.end(), same)) { distinct.push_back(plane); }
    if (distinct.size() > 32) { break; }
  }
  return distinct;
}

HALFLIGHT_INLINE void Mesh::clip(const Segment& line, Spans& out) const {
  double shift = 0.0;
  const Segment near = nearer(line, shift);
  Span span{{-infinity, 0}, {infinity, 0}};
  for (std::uint32_t f = 0; f < planes_.size(); ++f) {
    const double height = glm::dot(planes_[f].normal, near.origin - planes_[f].point);
    const double rate = glm::dot(planes_[f].normal, near.direction);
    if (rate == 0.0) {
      if (height > 0.0) { return; }
      continue;
    }
    const double t = -height / rate;
    if (rate < 0.0 ? t > span.in.t : t < span.out.t) { (rate < 0.0 ? span.in : span.out) = {t, f}; }
  }
  span.in.t += shift, span.out.t += shift;
  out.push(span);  // drops an empty span
}

HALFLIGHT_INLINE double Mesh::crossing_near(const Segment& line, std::uint32_t f) const {
  const double dd = glm::dot(line.direction, line.direction);
  const std::span<const std::uint32_t> face = corners(f);
  double lowest = infinity, highest = -infinity;  // multiplied by dd
  for (const std::uint32_t v : face) {
    const double along = glm::dot(positions_[v] - line.origin, line.direction);
    lowest = std::min(lowest, along);
    highest = std::max(highest, along);
  }
  double t = 0.0;
  if (triangles_) {
    const glm::dvec3 &a = positions_[face[0]], &b = positions_[face[1]], &c = positions_[face[2]];
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    t = glm::dot(normal, a - line.origin) / glm::dot(normal, line.direction);
  } else {
    const Plane& plane = planes_[f];
    t = glm::dot(plane.normal, plane.point - line.origin) / glm::dot(plane.normal, line.direction);
  }
  const double at = t * dd;
  if (!(at >= lowest)) {
    return lowest / dd;  // also for NaN
  }
  return at <= highest ? t : highest / dd;
}

HALFLIGHT_INLINE double Mesh::volume() const {
  double six = 0.0;
  for (std::uint32_t f = 0; f < planes_.size(); ++f) {
    const auto face = corners(f);
    for (std::size_t i = 2; i < face.size(); ++i) {
      six += glm::dot(positions_[face[0]] - positions_[0],
                      glm::cross(positions_[face[i - 1]] - positions_[0], positions_[face[i]] - positions_[0]));
    }
  }
  return six / 6.0;
}

HALFLIGHT_INLINE std::string Mesh::take(const std::vector<glm::dvec3>& positions, const std::vector<std::vector<std::uint32_t>>& faces,
                                        double rounding) {
  if (faces.empty()) { return "the mesh has no faces"; }
  std::vector<std::uint32_t> renamed(positions.size(), brep::no_sheet);  // keeps the order without gaps
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const std::uint32_t v : faces[f]) {
      if (v >= positions.size()) {
        return "face " + std::to_string(f) + " names vertex " + std::to_string(v) + ", but there are " + std::to_string(positions.size());
      }
      renamed[v] = 0;
    }
  }
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (renamed[v] == 0) {
      renamed[v] = static_cast<std::uint32_t>(positions_.size());
      positions_.push_back(positions[v]);
    }
  }
  std::vector<glm::dvec3> polygon;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    polygon.clear();
    for (const std::uint32_t v : faces[f]) {
      corners_.push_back(renamed[v]);
      polygon.push_back(positions[v]);
    }
    if (std::optional<std::string> fault = polygon_fault(polygon, rounding)) { return "face " + std::to_string(f) + " " + *fault; }
    first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
    planes_.push_back(plane_of(polygon));
    slack_ = std::max(slack_, planes_.back().slack);
    names_.push_back("f" + std::to_string(f));
  }
  return {};
}

HALFLIGHT_INLINE std::string Mesh::close_borders() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // directed
  for (std::uint32_t f = 0; f < planes_.size(); ++f) {
    const auto face = corners(f);
    for (std::size_t i = 0; i < face.size(); ++i) { edges.push_back({face[i], face[(i + 1) % face.size()]}); }
  }
  std::sort(edges.begin(), edges.end());
  std::map<std::uint32_t, std::uint32_t> next;  // along the border, whose direction is opposite to that of its faces
  for (const auto& [a, b] : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), std::pair(b, a)) && !next.emplace(b, a).second) {
      return "the mesh is not a manifold: two borders meet at the vertex at (" + place(b) + "), or an edge has more than two faces";
    }
  }
  while (!next.empty()) {
    borders_.emplace_back();
    for (auto at = next.begin(); at != next.end(); at = next.find(borders_.back().back())) {
      if (borders_.back().empty()) { borders_.back().push_back(at->first); }
      borders_.back().push_back(at->second);
      next.erase(at);
    }
    if (borders_.back().front() != borders_.back().back()) { return "the mesh is not a manifold: a border does not close"; }
    borders_.back().pop_back();
  }
  brep::Builder builder;
  approximate(0.0, builder);
  const auto closed = brep::close<brep::BRep<>>(builder);
  if (!closed.defects.empty()) { return "the mesh is not a manifold: " + closed.defects.front().sentence; }
  return {};
}

HALFLIGHT_INLINE void Mesh::prepare() {
  for (const glm::dvec3& p : positions_) { box_.extend(p); }
  triangles_ = true;
  for (std::size_t f = 0; f < planes_.size(); ++f) { triangles_ = triangles_ && first_corner_[f + 1] == 3 * (f + 1); }
  if (planes_.size() > 8) {
    // The boxes are enlarged by the rounding of the line test.
    const double margin = eps_projection * (box_.magnitude() + box_.diameter()) + slack_;
    std::vector<Box> boxes(planes_.size());
    for (std::uint32_t f = 0; f < planes_.size(); ++f) {
      for (const std::uint32_t v : corners(f)) { boxes[f].extend(positions_[v]); }
      boxes[f] = boxes[f].grown(margin);
    }
    bvh_ = Bvh(boxes);
  }
  // Convex: every vertex is behind every plane, to tol_convex of the size. Not tested for meshes of many faces, which are rarely convex.
  convex_ = solid() && planes_.size() <= 1000;
  for (std::size_t f = 0; f < planes_.size() && convex_; ++f) {
    for (const glm::dvec3& p : positions_) {
      if (glm::dot(p - planes_[f].point, planes_[f].normal) > tol_convex * box_.diameter() + slack_) { convex_ = false; }
    }
  }
  few_planes_ = convex_ && slack_ == 0.0 && planes_.size() <= 32 && distinct_planes().size() == planes_.size();
}

HALFLIGHT_INLINE bool Mesh::embedded() const {
  if (convex_) { return true; }
  if (!solid()) { return false; }
  std::vector<MeshFace> faces;
  for (std::uint32_t f = 0; f < planes_.size(); ++f) { faces.push_back({corners(f), planes_[f].normal}); }
  if (!faces_apart(faces, positions_, bvh_, eps_projection * (box_.magnitude() + box_.diameter()))) { return false; }
  // The volume is positive, so a connected surface has its inside within. Several connected components may be nested, and each may be
  // inside out.
  const std::vector<std::uint32_t> piece = connected();
  if (std::all_of(piece.begin(), piece.end(), [](std::uint32_t first) { return first == 0; })) { return true; }
  std::vector<bool> known(piece.size());
  for (std::uint32_t f = 0; f < planes_.size(); ++f) {
    const std::uint32_t of = piece[corners(f).front()];
    known[of] = known[of] || alternates_at(f);
  }
  return std::all_of(piece.begin(), piece.end(), [&](std::uint32_t first) { return known[first]; });
}

HALFLIGHT_INLINE std::vector<std::uint32_t> Mesh::connected() const {
  brep::detail::UnionFind joined(positions_.size());
  for (std::uint32_t f = 0; f < planes_.size(); ++f) {
    for (const std::uint32_t v : corners(f)) { joined.unite(v, corners(f).front()); }
  }
  std::vector<std::uint32_t> first(positions_.size());
  for (std::uint32_t v = 0; v < first.size(); ++v) { first[v] = joined.find(v); }
  return first;
}

HALFLIGHT_INLINE bool Mesh::alternates_at(std::uint32_t face) const {
  glm::dvec3 middle{0.0};
  for (const std::uint32_t v : corners(face)) { middle += positions_[v] / static_cast<double>(corners(face).size()); }
  std::vector<std::pair<Crossing, int>> met;
  bool through = false;
  crossings({middle, planes_[face].normal}, -infinity, infinity, [&](const Crossing& at, int w) {
    met.push_back({at, w});
    through = through || at.sheet == face;
  });
  std::sort(met.begin(), met.end(), [](const auto& a, const auto& b) { return a.first.t < b.first.t; });
  for (std::size_t i = 0; i < met.size(); ++i) {  // t is a length because the direction is a unit vector
    if (i > 0 && !(met[i].first.t - met[i - 1].first.t > tol_between * box_.diameter())) { return false; }
    if (met[i].second != (i % 2 == 0 ? -1 : 1)) { return false; }
  }
  return through;
}

}  // namespace raycast
