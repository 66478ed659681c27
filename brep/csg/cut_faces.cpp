// SPDX-License-Identifier: MIT
#include <brep/csg/cut_faces.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <brep/csg/boundary.hpp>
#include <brep/csg/contacts.hpp>
#include <brep/csg/directions.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/regions.hpp>
#include <brep/csg/split_edges.hpp>
#include <brep/csg/work.hpp>
#include <brep/edge_uses.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE void CutFaces::run(std::vector<Segment>& segments, const SplitEdges& edges, const std::vector<std::uint32_t>& contacts) {
  for (Segment& s : segments) {
    if (s.from > s.to) { std::swap(s.from, s.to); }
  }
  remove_copies(segments);
  if (split_at_contacts(segments, contacts)) { remove_copies(segments); }
  for (const Segment& s : segments) { touched.push_back(s.face); }
  for (const EdgeParts& p : edges.parts()) {
    touched.push_back(work_.halves[p.edge].face);
    touched.push_back(work_.halves[p.twin].face);
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  stamp_.assign(work_.points.size(), invalid_index);
  const Segment* s = segments.data();
  const Segment* const end = s + segments.size();
  for (std::uint32_t f : touched) {
    const Segment* const first = s;
    while (s != end && s->face == f) { ++s; }
    cut(f, first, s);
  }
}

HALFLIGHT_INLINE void CutFaces::remove_copies(std::vector<Segment>& segments) {
  const auto key = [](const Segment& s) { return std::tuple(s.face, s.from, s.to, s.across); };
  std::sort(segments.begin(), segments.end(), [&](const Segment& a, const Segment& b) { return key(a) < key(b); });
  segments.erase(std::unique(segments.begin(), segments.end(),
                             [](const Segment& a, const Segment& b) { return a.face == b.face && a.from == b.from && a.to == b.to; }),
                 segments.end());
}

HALFLIGHT_INLINE bool CutFaces::split_at_contacts(std::vector<Segment>& segments, std::vector<std::uint32_t> points) const {
  struct Stop {
    std::uint32_t from, to, point;
  };
  std::vector<Stop> stops;
  if (segments.empty()) { return false; }
  const int axis = widest(points);
  std::sort(points.begin(), points.end(),
            [&](std::uint32_t a, std::uint32_t b) { return work_.points[a].position[axis] < work_.points[b].position[axis]; });
  std::vector<glm::dvec3> positions;
  for (std::uint32_t p : points) { positions.push_back(work_.points[p].position); }
  for (const Segment& s : segments) {
    const glm::dvec3 a = work_.points[s.from].position, b = work_.points[s.to].position;
    const glm::dvec3 lo = glm::min(a, b), hi = glm::max(a, b);
    auto p = static_cast<std::size_t>(
        std::lower_bound(positions.begin(), positions.end(), lo[axis], [&](const glm::dvec3& x, double at) { return x[axis] < at; }) -
        positions.begin());
    for (; p < positions.size() && positions[p][axis] <= hi[axis]; ++p) {
      const glm::dvec3& x = positions[p];
      if (x.x < lo.x || x.y < lo.y || x.z < lo.z || x.x > hi.x || x.y > hi.y || x.z > hi.z) { continue; }
      if (points[p] == s.from || points[p] == s.to) { continue; }
      const Point& point = work_.points[points[p]];
      if (work_.predicates.side(point, s.across) != 0 || work_.predicates.side(point, work_.faces[s.face].plane.number()) != 0) {
        continue;
      }
      if (between(points[p], s)) { stops.push_back({s.from, s.to, points[p]}); }
    }
  }
  if (stops.empty()) { return false; }
  std::sort(stops.begin(), stops.end(),
            [](const Stop& a, const Stop& b) { return std::tuple(a.from, a.to, a.point) < std::tuple(b.from, b.to, b.point); });
  std::vector<Segment> result;
  for (const Segment& s : segments) {
    auto stop = std::lower_bound(stops.begin(), stops.end(), s,
                                 [](const Stop& a, const Segment& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); });
    std::vector<std::uint32_t> chain{s.from, s.to};
    for (; stop != stops.end() && stop->from == s.from && stop->to == s.to; ++stop) {
      if (chain.back() != stop->point) { chain.push_back(stop->point); }
    }
    const int along = widest({s.from, s.to});
    std::sort(chain.begin(), chain.end(),
              [&](std::uint32_t a, std::uint32_t b) { return work_.predicates.compare(work_.points[a], work_.points[b], along) < 0; });
    for (std::size_t i = 1; i < chain.size(); ++i) {
      if (chain[i - 1] == chain[i]) { continue; }
      result.push_back({s.face, std::min(chain[i - 1], chain[i]), std::max(chain[i - 1], chain[i]), s.across});
    }
  }
  segments.swap(result);
  return true;
}

HALFLIGHT_INLINE int CutFaces::widest(const std::vector<std::uint32_t>& points) const {
  glm::dvec3 lo = work_.points[points[0]].position, hi = lo;
  for (std::uint32_t p : points) { lo = glm::min(lo, work_.points[p].position), hi = glm::max(hi, work_.points[p].position); }
  const glm::dvec3 size = hi - lo;
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

HALFLIGHT_INLINE bool CutFaces::between(std::uint32_t p, const Segment& s) const {
  const int axis = widest({s.from, s.to});
  const int a = work_.predicates.compare(work_.points[s.from], work_.points[p], axis);
  return a != 0 && a == work_.predicates.compare(work_.points[p], work_.points[s.to], axis);
}

HALFLIGHT_INLINE void CutFaces::cut(std::uint32_t f, const Segment* segment, const Segment* end) {
  halves_.clear();
  for (std::uint32_t i = 0; i < work_.faces[f].count; ++i) {
    const std::uint32_t h = work_.faces[f].first + i;
    halves_.push_back(h);
    for (std::uint32_t x = work_.halves[h].next; x >= work_.halves_given; x = work_.halves[x].next) { halves_.push_back(x); }
  }
  if (segment != end) {
    draw(f, segment, end);
    auto regions = regions_.run(work_.faces[f], halves_);
    if (!regions) {
      fault = f;
      return;
    }
    std::vector<std::uint32_t> face_of;  // region -> face
    for (std::uint32_t h : halves_) {
      const std::uint32_t region = regions->find(work_.halves[h].face);
      if (face_of.size() <= region) { face_of.resize(region + 1, invalid_index); }
      if (face_of[region] == invalid_index) {
        face_of[region] = region == 0 ? f : static_cast<std::uint32_t>(work_.faces.size());
        if (region != 0) { work_.faces.push_back(work_.faces[f]); }
      }
      work_.halves[h].face = face_of[region];
    }
    std::stable_sort(halves_.begin(), halves_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return work_.halves[a].face < work_.halves[b].face; });
  }
  for (std::size_t i = 0; i < halves_.size();) {
    WorkFace& face = work_.faces[work_.halves[halves_[i]].face];
    face.first = static_cast<std::uint32_t>(work_.lists.size());
    face.listed = true;
    const std::uint32_t number = work_.halves[halves_[i]].face;
    for (; i < halves_.size() && work_.halves[halves_[i]].face == number; ++i) { work_.lists.push_back(halves_[i]); }
    face.count = static_cast<std::uint32_t>(work_.lists.size()) - face.first;
  }
}

HALFLIGHT_INLINE void CutFaces::draw(std::uint32_t f, const Segment* segment, const Segment* end) {
  const Plane& plane = work_.plane(work_.faces[f]);
  const Projection on(plane, work_.faces[f].plane.sign());
  for (const Segment* s = segment; s != end; ++s) { stamp_[s->from] = stamp_[s->to] = f; }
  spokes_.clear();
  for (std::uint32_t h : halves_) {
    const WorkHalf& half = work_.halves[h];
    if (stamp_[half.point] == f) {
      spokes_.push_back({half.point, invalid_index, h, direction(work_, plane, half.across, on, work_.from(h), work_.to(h))});
    }
    if (stamp_[work_.halves[half.next].point] == f) {
      spokes_.push_back(
          {work_.halves[half.next].point, h, invalid_index, direction(work_, plane, half.across, on, work_.to(h), work_.from(h))});
    }
  }
  for (const Segment* s = segment; s != end; ++s) {
    const auto c = static_cast<std::uint32_t>(work_.halves.size());
    work_.halves.push_back({s->from, c + 1, c + 1, c + 1, f, s->across});
    work_.halves.push_back({s->to, c, c, c, f, s->across});
    cuts.push_back(c);
    halves_.push_back(c);
    halves_.push_back(c + 1);
    const Direction d = direction(work_, plane, s->across, on, work_.points[s->from], work_.points[s->to]);
    spokes_.push_back({s->from, c + 1, c, d});
    spokes_.push_back({s->to, c, c + 1, {-d.u, -d.v}});
  }
  std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
    if (a.point != b.point) { return a.point < b.point; }
    const bool less = before(a.direction, b.direction);
    if (less || before(b.direction, a.direction)) { return less; }
    return a.out == invalid_index && b.out != invalid_index;  // both sides of a slit: who arrives does not turn back at once
  });
  for (std::size_t first = 0, last = 0; first < spokes_.size(); first = last) {
    while (last < spokes_.size() && spokes_[last].point == spokes_[first].point) { ++last; }
    for (std::size_t i = first; i < last; ++i) {
      if (spokes_[i].in == invalid_index) { continue; }
      std::size_t out = i;
      do { out = out == first ? last - 1 : out - 1; } while (spokes_[out].out == invalid_index);
      work_.link(spokes_[i].in, spokes_[out].out);
    }
  }
}

}  // namespace brep::csg::detail
