// SPDX-License-Identifier: MIT
#include <brep/csg/regions.hpp>

#include <cstdint>
#include <optional>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/directions.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/work.hpp>
#include <brep/edge_uses.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE std::optional<brep::detail::UnionFind> Regions::run(const WorkFace& face, const std::vector<std::uint32_t>& halves) {
  for (std::uint32_t h : halves) { work_.halves[h].face = invalid_index; }
  std::uint32_t cycles = 0;
  for (std::uint32_t h : halves) {
    if (work_.halves[h].face != invalid_index) { continue; }
    for (std::uint32_t x = h; work_.halves[x].face == invalid_index; x = work_.halves[x].next) { work_.halves[x].face = cycles; }
    ++cycles;
  }
  brep::detail::UnionFind regions(cycles);
  if (cycles == 1) { return regions; }

  brep::detail::UnionFind drawings(cycles);  // cycles that hang together by points
  first_at_.resize(work_.points.size(), invalid_index);
  for (std::uint32_t h : halves) {
    std::uint32_t& first = first_at_[work_.halves[h].point];
    if (first == invalid_index) { first = work_.halves[h].face; }
    drawings.unite(first, work_.halves[h].face);
  }
  for (std::uint32_t h : halves) { first_at_[work_.halves[h].point] = invalid_index; }
  bool one = true;
  for (std::uint32_t c = 1; c < cycles; ++c) { one = one && drawings.find(c) == 0; }
  if (one) { return regions; }

  const Plane& plane = work_.plane(face);
  const Projection on(plane, face.plane.sign());
  std::vector<std::uint32_t> extreme(cycles, invalid_index);  // of each drawing: a half-edge that starts at its extreme point
  for (std::uint32_t h : halves) {
    std::uint32_t& best = extreme[drawings.find(work_.halves[h].face)];
    if (best == invalid_index || beyond(work_.from(h), work_.from(best), on)) { best = h; }
  }
  for (std::uint32_t c = 0; c < cycles; ++c) {
    if (extreme[c] == invalid_index) { continue; }
    const std::uint32_t point = work_.halves[extreme[c]].point;
    const std::uint32_t outer = cycle_around(plane, on, halves, point);
    if (outer == invalid_index) { continue; }
    const std::uint32_t met = first_met(face, on, halves, drawings, c, work_.points[point]);
    if (met == invalid_index) { return std::nullopt; }
    regions.unite(outer, work_.halves[met].face);
  }
  return regions;
}

HALFLIGHT_INLINE std::uint32_t Regions::cycle_around(const Plane& plane, const Projection& on, const std::vector<std::uint32_t>& halves,
                                                     std::uint32_t point) const {
  std::optional<Direction> last;
  std::uint32_t cycle = invalid_index;
  const auto meet = [&](const Direction& d, std::uint32_t leaving) {
    const int order = last ? turn(*last, d) : 1;
    if (order > 0) { cycle = leaving; }
    if (order == 0 && leaving != invalid_index) { cycle = leaving; }
    if (order > 0) { last = d; }
  };
  for (std::uint32_t h : halves) {
    const WorkHalf& half = work_.halves[h];
    if (half.point == point) { meet(direction(work_, plane, half.across, on, work_.from(h), work_.to(h)), half.face); }
    if (work_.halves[half.next].point == point) {
      meet(direction(work_, plane, half.across, on, work_.to(h), work_.from(h)), invalid_index);
    }
  }
  return cycle;
}

HALFLIGHT_INLINE std::uint32_t Regions::first_met(const WorkFace& face, const Projection& on, const std::vector<std::uint32_t>& halves,
                                                  brep::detail::UnionFind& drawings, std::uint32_t drawing, const Point& from) const {
  std::uint32_t best = invalid_index;
  for (std::uint32_t h : halves) {
    if (work_.predicates.compare(work_.from(h), from, on.v) > 0 || work_.predicates.compare(work_.to(h), from, on.v) <= 0) { continue; }
    if (drawings.find(work_.halves[h].face) == drawing || side_of(face, h, from) <= 0) { continue; }
    if (best == invalid_index || nearer(face, on, h, best)) { best = h; }
  }
  return best;
}

HALFLIGHT_INLINE bool Regions::nearer(const WorkFace& face, const Projection& on, std::uint32_t a, std::uint32_t b) const {
  const Predicates& p = work_.predicates;
  const int low = p.compare(work_.from(a), work_.from(b), on.v) >= 0 ? side_of(face, b, work_.from(a)) : -side_of(face, a, work_.from(b));
  if (low != 0) { return low > 0; }
  return (p.compare(work_.to(a), work_.to(b), on.v) <= 0 ? side_of(face, b, work_.to(a)) : -side_of(face, a, work_.to(b))) > 0;
}

HALFLIGHT_INLINE int Regions::side_of(const WorkFace& face, std::uint32_t h, const Point& point) const {
  const PlaneNumber across = work_.halves[h].across;
  const int side = work_.predicates.side(point, across);
  if (side == 0) { return 0; }
  const Line line(work_.plane(face), work_.predicates.plane(across));
  const bool along = (work_.predicates.compare(work_.from(h), work_.to(h), line.axis) < 0) == (line.direction > 0);
  return along == (face.plane.sign() > 0) ? -side : side;
}

}  // namespace brep::csg::detail
