// SPDX-License-Identifier: MIT
#pragma once

// Where two faces meet: the common part of their two intervals on the line of their planes (paper 2.2: "faces ... are intersected").
//
// A face meets the line in points of its boundary, between which the line runs inside the face, outside, or along an edge of it. To know
// which, walk along the line with two bits, "inside just to the left" and "inside just to the right": an edge that reaches the line from a
// side turns the bit of that side. Both bits: inside; one bit: along an edge. The walks of both faces together give the common
// segments, cut at every point of either boundary, and all common points. Faces in one plane are not compared: where their
// borders meet, the faces on the other sides of these borders lie in other planes and find the common points.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <brep/csg/point_table.hpp>
#include <brep/csg/work.hpp>

namespace brep::csg::detail {

struct Segment {
  std::uint32_t face;  // which it cuts
  std::uint32_t from, to;
  PlaneNumber across;
};
struct EdgeNode {
  std::uint32_t edge;  // the lower half-edge
  std::uint32_t point;
};

class Contacts {
 public:
  explicit Contacts(Work& work) : table(work), work_(work) {}

  PointTable table;
  std::vector<Segment> segments;  // inside of faces
  std::vector<EdgeNode> nodes;    // inside of edges
  std::vector<std::uint32_t>
      along;               // lower half-edges of edges that run along a face or an edge of the other operand, perhaps several times
  bool consistent = true;  // false: a face is not bounded as a face must be

  // Compares the faces f and g of the two operands.
  void compare(std::uint32_t f, std::uint32_t g) {
    if (!meet(f, g)) { return; }
    walk(f, g);
  }

 protected:
  struct Event {
    Point point;
    std::uint32_t half;
    std::uint8_t of_g, vertex, turn;  // turn: bit 0 left, bit 1 right
    std::uint32_t group;
  };
  struct Along {
    std::uint32_t half, first, last;  // groups
    bool of_g;
  };

  // Fills events_ and along_ and sorts them into groups of equal points. False: no common point.
  bool meet(std::uint32_t f, std::uint32_t g) {
    const WorkFace &ff = work_.faces[f], &gg = work_.faces[g];
    const PlaneNumber p = ff.plane.number(), q = gg.plane.number();
    if (p == q || !sides(ff, q, sides_f_) || !sides(gg, p, sides_g_)) { return false; }
    const Line line(work_.predicates.plane(p), work_.predicates.plane(q));
    if (line.axis < 0) { return false; }
    axis_ = line.axis;
    events_.clear();
    along_.clear();
    collect(ff, q, sides_f_, false);
    const std::size_t middle = events_.size();
    collect(gg, p, sides_g_, true);
    if (middle == 0 || middle == events_.size()) { return false; }
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (const Event& e : events_) {
      low[e.of_g] = std::min(low[e.of_g], e.point.position[axis_]);
      high[e.of_g] = std::max(high[e.of_g], e.point.position[axis_]);
    }
    if (low[0] > high[1] || low[1] > high[0]) { return false; }
    std::sort(events_.begin(), events_.end(),
              [&](const Event& a, const Event& b) { return work_.predicates.compare(a.point, b.point, axis_) < 0; });
    groups_.clear();
    for (std::uint32_t i = 0; i < events_.size(); ++i) {
      if (i == 0 || work_.predicates.compare(events_[i - 1].point, events_[i].point, axis_) != 0) { groups_.push_back(i); }
      events_[i].group = static_cast<std::uint32_t>(groups_.size() - 1);
    }
    groups_.push_back(static_cast<std::uint32_t>(events_.size()));
    for (Along& a : along_) {
      for (const Event& e : events_) {
        if (!e.vertex || (e.of_g != 0) != a.of_g) { continue; }
        if (e.half == a.half) { a.first = e.group; }
        if (e.half == work_.halves[a.half].next) { a.last = e.group; }
      }
      if (a.first > a.last) { std::swap(a.first, a.last); }
    }
    return true;
  }

  // On which side of the plane the half-edges of the face start; false: all on one side of it.
  bool sides(const WorkFace& f, PlaneNumber q, std::vector<std::int8_t>& result) const {
    result.resize(f.count);
    bool front = false, back = false, on = false;
    for (std::uint32_t i = 0; i < f.count; ++i) {
      const int s = work_.predicates.side(work_.from(f.first + i), q);
      result[i] = static_cast<std::int8_t>(s);
      front = front || s > 0;
      back = back || s < 0;
      on = on || s == 0;
    }
    return on || (front && back);
  }

  void collect(const WorkFace& f, PlaneNumber q, const std::vector<std::int8_t>& side, bool of_g) {
    for (std::uint32_t i = 0; i < f.count; ++i) {
      const std::uint32_t h = f.first + i;
      const WorkHalf& half = work_.halves[h];
      const int s = side[i], after = side[half.next - f.first];
      if (s * after < 0) {
        const PlaneNumber p = f.plane.number();
        // Both ways along the edge must name the same planes in the same order: equal names are cheaper to compare.
        const Point x = work_.predicates.point(std::min(p, half.across), std::max(p, half.across), q);
        events_.push_back({x, h, of_g, false, 3, 0});
      } else if (s == 0) {
        const int before = side[half.prev - f.first];
        const int turn = ((after > 0) != (before > 0) ? 1 : 0) | ((after < 0) != (before < 0) ? 2 : 0);
        events_.push_back({work_.points[half.point], h, of_g, true, static_cast<std::uint8_t>(turn), 0});
        if (after == 0) { along_.push_back({h, 0, 0, of_g}); }
      }
    }
  }

  void walk(std::uint32_t f, std::uint32_t g) {
    const PlaneNumber p = work_.faces[f].plane.number(), q = work_.faces[g].plane.number();
    int state_f = 0, state_g = 0;
    std::uint32_t before = invalid_index;  // the common point at the beginning of the interval, if both run there
    const auto count = static_cast<std::uint32_t>(groups_.size() - 1);
    for (std::uint32_t k = 0; k < count; ++k) {
      int after_f = state_f, after_g = state_g;
      bool at_f = state_f != 0, at_g = state_g != 0;
      for (std::uint32_t i = groups_[k]; i < groups_[k + 1]; ++i) {
        (events_[i].of_g ? at_g : at_f) = true;
        (events_[i].of_g ? after_g : after_f) ^= events_[i].turn;
      }
      std::uint32_t here = invalid_index;
      if (at_f && at_g) {
        here = resolve(k);
        if (before != invalid_index) {
          if (!run_along(k, false)) { state_f == 3 ? segments.push_back({f, before, here, q}) : void(consistent = false); }
          if (!run_along(k, true)) { state_g == 3 ? segments.push_back({g, before, here, p}) : void(consistent = false); }
        }
      }
      state_f = after_f, state_g = after_g;
      before = state_f != 0 && state_g != 0 ? here : invalid_index;
    }
    consistent = consistent && state_f == 0 && state_g == 0;
  }

  // The number of the common point of group k, noted on the edges in whose inside it lies.
  std::uint32_t resolve(std::uint32_t k) {
    std::uint32_t number = invalid_index;
    for (std::uint32_t i = groups_[k]; i < groups_[k + 1]; ++i) {
      if (events_[i].vertex) { number = table.of_vertex(work_.halves[events_[i].half].point); }
    }
    if (number == invalid_index) { number = table.of(events_[groups_[k]].point); }
    for (std::uint32_t i = groups_[k]; i < groups_[k + 1]; ++i) {
      if (!events_[i].vertex) { nodes.push_back({lower(events_[i].half), number}); }
    }
    for (const Along& a : along_) {
      if (a.first < k && k < a.last) { nodes.push_back({lower(a.half), number}); }
    }
    return number;
  }

  // Notes the edges that the face has between the groups k - 1 and k; false: none.
  bool run_along(std::uint32_t k, bool of_g) {
    bool found = false;
    for (const Along& a : along_) {
      if (a.of_g != of_g || a.first >= k || a.last < k) { continue; }
      along.push_back(lower(a.half));
      found = true;
    }
    return found;
  }

  [[nodiscard]] std::uint32_t lower(std::uint32_t h) const { return std::min(h, work_.halves[h].twin); }

  Work& work_;
  std::vector<std::int8_t> sides_f_, sides_g_;
  std::vector<Event> events_;
  std::vector<Along> along_;
  std::vector<std::uint32_t> groups_;  // first events, and the end
  int axis_ = 0;
};

}  // namespace brep::csg::detail
