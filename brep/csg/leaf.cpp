// SPDX-License-Identifier: MIT
#include <brep/csg/leaf.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/csg/boundary.hpp>
#include <brep/csg/ear_clipping.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/wide.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>
#include <brep/result.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE Refusal Leaf::run(Boundary& boundary) {
  number_points();
  plane_.assign(anchor.size(), OrientedPlane{});
  bool planar = true;
  for (std::uint32_t f = 0; f < anchor.size(); ++f) {
    if (const Refusal refusal = check_edges(f); refusal.code != Code::none) { return refusal; }
    const std::optional<OrientedPlane> plane = snapped_plane(f);
    if (plane) { plane_[f] = *plane; }
    planar = planar && plane;
  }
  if (!planar) {
    const std::vector<Corner> bridged = corners;
    strip_bridges();
    planar = is_simple() && place_by_planes();
    if (!planar) {
      corners = bridged;
      if (const Refusal refusal = triangulate(); refusal.code != Code::none) { return refusal; }
      strip_bridges();
    }
  } else {
    strip_bridges();
  }
  emit(boundary);
  return {};
}

HALFLIGHT_INLINE Leaf::Grid3 Leaf::snapped(std::uint32_t vertex) const {
  Grid3 result{};
  for (int i = 0; i < 3; ++i) { result[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::round(vertices[vertex][i])); }
  return result;
}

HALFLIGHT_INLINE void Leaf::number_points() {
  struct Hash {
    std::size_t operator()(const Grid3& p) const {
      std::uint64_t h = 0;
      for (std::int64_t x : p) { h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u; }
      return h ^ (h >> 32);
    }
  };
  std::unordered_map<Grid3, std::uint32_t, Hash> seen(2 * vertices.size());
  point_.resize(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const Grid3 p = snapped(v);
    const auto [entry, fresh] = seen.emplace(p, static_cast<std::uint32_t>(points_.size()));
    if (fresh) {
      Point added{{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])}, {}};
      added.planes = {invalid_index, invalid_index, invalid_index};
      points_.push_back(added);
    }
    point_[v] = entry->second;
  }
}

HALFLIGHT_INLINE Refusal Leaf::check_edges(std::uint32_t f) const {
  std::uint32_t c = anchor[f];
  do {
    if (point_[corners[c].vertex] == point_[corners[corners[c].next].vertex]) { return {Code::collapsed, {FaceId{given[f]}}}; }
    c = corners[c].next;
  } while (c != anchor[f]);
  return {};
}

HALFLIGHT_INLINE std::array<Int128, 3> Leaf::newell(std::uint32_t f) const {
  std::array<Int128, 3> sum{};
  const Grid3 o = snapped(corners[anchor[f]].vertex);
  std::uint32_t c = anchor[f];
  do {
    Grid3 a = snapped(corners[c].vertex), b = snapped(corners[corners[c].next].vertex);
    for (std::size_t i = 0; i < 3; ++i) { a[i] -= o[i], b[i] -= o[i]; }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      sum[i] += static_cast<Int128>(a[j]) * b[k] - static_cast<Int128>(a[k]) * b[j];
    }
    c = corners[c].next;
  } while (c != anchor[f]);
  return sum;
}

HALFLIGHT_INLINE std::optional<OrientedPlane> Leaf::snapped_plane(std::uint32_t f) const {
  const std::array<Int128, 3> sum = newell(f);
  const Int128 divisor = gcd(gcd(sum[0], sum[1]), sum[2]);
  if (divisor == 0) { return std::nullopt; }
  Grid3 n{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Int128 x = sum[i] / divisor;
    if (size(x) > (Int128{1} << 53)) { return std::nullopt; }
    n[i] = static_cast<std::int64_t>(x);
  }
  const auto product = [&](const Grid3& p) {
    return static_cast<Int128>(n[0]) * p[0] + static_cast<Int128>(n[1]) * p[1] + static_cast<Int128>(n[2]) * p[2];
  };
  const Int128 d = -product(snapped(corners[anchor[f]].vertex));
  std::uint32_t c = anchor[f];
  do {
    if (product(snapped(corners[c].vertex)) != -d) { return std::nullopt; }
    c = corners[c].next;
  } while (c != anchor[f]);
  return planes_.insert(n, d);
}

HALFLIGHT_INLINE bool Leaf::is_simple() const {
  std::vector<std::uint8_t> degree(points_.size(), 0);
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    if (gone_[c]) { continue; }
    std::uint8_t& n = degree[point_[corners[c].vertex]];
    if (++n > 3) { return false; }
  }
  for (std::uint8_t n : degree) {
    if (n != 3) { return false; }
  }
  return true;
}

HALFLIGHT_INLINE std::vector<Leaf::Mean> Leaf::means() const {
  std::vector<Mean> result(anchor.size());
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    if (gone_[c]) { continue; }
    Mean& m = result[corners[c].face];
    const glm::dvec3 &v = vertices[corners[c].vertex], &w = vertices[corners[corners[c].next].vertex];
    if (m.count == 0.0) { m.origin = v; }
    m.normal += glm::cross(v - m.origin, w - m.origin);
    m.middle += v - m.origin;
    m.count += 1.0;
    for (int i = 0; i < 3; ++i) { m.level[i] = m.level[i] && v[i] == m.origin[i]; }
  }
  return result;
}

HALFLIGHT_INLINE bool Leaf::place_by_planes() {
  std::vector<OrientedPlane> plane = plane_;
  const std::vector<Mean> mean = means();
  for (std::uint32_t f = 0; f < plane.size(); ++f) {
    const Mean& m = mean[f];
    if (plane[f].code != invalid_index && (m.level[0] || m.level[1] || m.level[2])) { continue; }
    const double length = glm::length(m.normal);
    if (!(length > 0.0)) { return false; }
    Grid3 n{};
    Int128 offset = Int128{1} << 26;  // in 2^-27 spacings, rounded
    for (int i = 0; i < 3; ++i) {
      n[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::round(m.normal[i] / length * 0x1p52));
      offset += static_cast<Int128>(n[static_cast<std::size_t>(i)]) *
                static_cast<std::int64_t>(std::round((m.origin[i] + m.middle[i] / m.count) * 0x1p27));
    }
    plane[f] = planes_.insert(n, -(offset >> 27));
  }
  const Predicates predicates(planes_);
  std::vector<Point> placed = points_;
  std::vector<std::uint8_t> done(points_.size(), 0);
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    const std::uint32_t p = point_[corners[c].vertex];
    if (gone_[c] || done[p]) { continue; }
    done[p] = 1;
    const std::uint32_t second = corners[corners[c].twin].next, third = corners[corners[second].twin].next;
    const PlaneNumber a = plane[corners[c].face].number(), b = plane[corners[second].face].number(),
                      d = plane[corners[third].face].number();
    if (meet(planes_[a], planes_[b], planes_[d]).w.zero()) { return false; }
    const Homogeneous<4> h = meet(planes_[a], planes_[b], planes_[d]);
    const glm::dvec3 rough = glm::dvec3{h.x[0].approximate(), h.x[1].approximate(), h.x[2].approximate()} / h.w.approximate();
    const glm::dvec3 moved = glm::abs(rough - vertices[corners[c].vertex]);
    if (!(moved.x < 1.0 && moved.y < 1.0 && moved.z < 1.0)) { return false; }
    placed[p] = predicates.point(a, b, d);
  }
  for (std::uint32_t c = 0; c < corners.size(); ++c) {  // no edge may be turned round by it
    if (gone_[c]) { continue; }
    const std::uint32_t v = corners[c].vertex, w = corners[corners[c].next].vertex;
    if (!(glm::dot(placed[point_[w]].position - placed[point_[v]].position, vertices[w] - vertices[v]) > 0.0)) { return false; }
  }
  plane_ = std::move(plane);
  points_ = std::move(placed);
  return true;
}

HALFLIGHT_INLINE Refusal Leaf::triangulate() {
  const auto count = static_cast<std::uint32_t>(anchor.size());
  for (std::uint32_t f = 0; f < count; ++f) {
    if (plane_[f].code != invalid_index) { continue; }
    const std::array<Int128, 3> sum = newell(f);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) { axis = size(sum[i]) > size(sum[axis]) ? i : axis; }
    if (sum[axis] == 0) { return {Code::collapsed, {FaceId{given[f]}}}; }
    std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (sum[axis] < 0) { std::swap(u, v); }
    std::vector<std::uint32_t> loop;
    std::vector<GridCorner> seen;
    std::uint32_t c = anchor[f];
    do {
      const Grid3 p = snapped(corners[c].vertex);
      loop.push_back(c);
      seen.push_back({p[u], p[v]});
      c = corners[c].next;
    } while (c != anchor[f]);
    const auto cut = ears(seen);
    if (!cut) { return {Code::not_planar, {FaceId{given[f]}}}; }
    for (const Ear& ear : *cut) { loop[ear.before] = cut_off(loop[ear.corner]); }
  }
  for (std::uint32_t f = 0; f < anchor.size(); ++f) {
    if (plane_[f].code != invalid_index) { continue; }
    const std::optional<OrientedPlane> plane = snapped_plane(f);
    if (!plane) { return {Code::collapsed, {FaceId{given[f]}}}; }
    plane_[f] = *plane;
  }
  return {};
}

HALFLIGHT_INLINE std::uint32_t Leaf::cut_off(std::uint32_t c) {
  const std::uint32_t f = corners[c].face, before = corners[c].prev, after = corners[c].next;
  const auto d = static_cast<std::uint32_t>(corners.size()), back = d + 1, g = static_cast<std::uint32_t>(anchor.size());
  corners.push_back({corners[before].vertex, after, corners[before].prev, back, f});
  corners.push_back({corners[after].vertex, before, c, d, g});
  corners[corners[before].prev].next = d;
  corners[after].prev = d;
  corners[before].prev = back;
  corners[c].next = back;
  corners[before].face = corners[c].face = g;
  anchor.push_back(back);
  anchor[f] = d;
  given.push_back(given[f]);
  plane_.push_back(OrientedPlane{});
  return d;
}

HALFLIGHT_INLINE void Leaf::strip_bridges() {
  gone_.assign(corners.size(), 0);
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    const std::uint32_t t = corners[c].twin;
    if (gone_[c] || !is_bridge(c)) { continue; }
    const std::uint32_t before_c = corners[c].prev, after_c = corners[c].next, before_t = corners[t].prev, after_t = corners[t].next;
    if (after_c != t) { corners[before_t].next = after_c, corners[after_c].prev = before_t; }
    if (after_t != c) { corners[before_c].next = after_t, corners[after_t].prev = before_c; }
    gone_[c] = gone_[t] = 1;
  }
}

HALFLIGHT_INLINE void Leaf::emit(Boundary& boundary) {
  std::vector<std::uint32_t> first(anchor.size() + 1, 0), place(corners.size(), invalid_index);
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    if (!gone_[c]) { ++first[corners[c].face + 1]; }
  }
  for (std::size_t f = 0; f < anchor.size(); ++f) { first[f + 1] += first[f]; }
  std::vector<std::uint32_t> end = first;
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    if (!gone_[c]) { place[c] = end[corners[c].face]++; }
  }
  boundary.points = points_;
  boundary.halves.resize(first.back());
  boundary.faces.resize(anchor.size());
  for (std::uint32_t f = 0; f < anchor.size(); ++f) { boundary.faces[f] = {plane_[f], first[f], first[f + 1] - first[f], given[f], {}}; }
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    if (gone_[c]) { continue; }
    const Corner& corner = corners[c];
    const std::uint32_t point = point_[corner.vertex];
    boundary.halves[place[c]] = {point, place[corner.next], place[corner.twin], corner.face, plane_[corners[corner.twin].face].number()};
    boundary.faces[corner.face].box.add(points_[point].position, points_[point].on_grid());
  }
  for (Half& h : boundary.halves) {
    const PlaneNumber plane = boundary.faces[h.face].plane.number();
    if (h.across == plane) { h.across = upright(points_[h.point], points_[boundary.halves[h.next].point], plane); }
  }
}

HALFLIGHT_INLINE PlaneNumber Leaf::upright(const Point& p, const Point& q, PlaneNumber plane) {
  const Grid3 n = planes_[plane].n;
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i) { k = std::abs(n[i]) > std::abs(n[k]) ? i : k; }
  const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
  Grid3 m{};
  m[u] = static_cast<std::int64_t>(q.position[static_cast<int>(v)] - p.position[static_cast<int>(v)]);
  m[v] = static_cast<std::int64_t>(p.position[static_cast<int>(u)] - q.position[static_cast<int>(u)]);
  Int128 d = 0;
  for (int i = 0; i < 3; ++i) { d -= static_cast<Int128>(m[static_cast<std::size_t>(i)]) * static_cast<std::int64_t>(p.position[i]); }
  return planes_.insert(m, d).number();
}

}  // namespace brep::csg::detail
