// SPDX-License-Identifier: MIT
#pragma once

// Where to draw the bridge edges of a face with holes, so that its loop looks simple.
//
// Holes are taken from right to left by their rightmost points; each is joined to the nearest visible corner of what is joined already.
// There is one: the first edge to the right belongs to the outer cycle or to a hole that came before (Eberly 2002). Only the drawing
// depends on this, topology does not; rounded coordinates are good enough, and a bridge that comes close to a vertex is avoided.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <brep/brep.hpp>
#include <brep/unchecked.hpp>

namespace brep::csg::detail {

template <class B, class Place>
class Bridges {
 public:
  // place(h): where the half-edge starts, seen in the plane of the face from outside, in spacings.
  Bridges(B& brep, Place place, const std::vector<HalfedgeId>& cycles) : brep_(brep), place_(std::move(place)) {
    for (std::size_t c = 0; c < cycles.size(); ++c) {
      std::vector<Corner>& cycle = cycles_.emplace_back();
      HalfedgeId h = cycles[c];
      do {
        cycle.push_back({h, place_(h)});
        h = brep.next(h);
      } while (h != cycles[c]);
      for (std::size_t i = 0; i < cycle.size(); ++i) { edges_.push_back({cycle[i].at, cycle[i + 1 < cycle.size() ? i + 1 : 0].at}); }
    }
  }

  // Joins all cycles to the one of the largest area, whose face stays.
  void run() {
    std::size_t outer = 0;
    for (std::size_t c = 1; c < cycles_.size(); ++c) { outer = area(cycles_[c]) > area(cycles_[outer]) ? c : outer; }
    std::swap(cycles_[0], cycles_[outer]);
    std::vector<Corner> joined = std::move(cycles_[0]);
    cycles_.erase(cycles_.begin());
    const auto right = [](const Corner& a, const Corner& b) { return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y; };
    for (std::vector<Corner>& hole : cycles_) { std::rotate(hole.begin(), std::max_element(hole.begin(), hole.end(), right), hole.end()); }
    std::stable_sort(cycles_.begin(), cycles_.end(), [&](const auto& a, const auto& b) { return right(b[0], a[0]); });
    for (const std::vector<Corner>& hole : cycles_) {
      const Corner from = hole[0];
      std::vector<std::pair<double, std::size_t>> near;
      for (std::size_t i = 0; i < joined.size(); ++i) {
        const glm::dvec2 d = joined[i].at - from.at;
        near.emplace_back(glm::dot(d, d), i);
      }
      std::sort(near.begin(), near.end());
      std::size_t to = near.front().second;
      for (double margin : {8.0, 0.0}) {
        const auto seen = std::find_if(near.begin(), near.end(), [&](const auto& n) { return visible(from, joined[n.second], margin); });
        if (seen == near.end()) { continue; }
        to = seen->second;
        break;
      }
      edges_.push_back({from.at, joined[to].at});
      const HalfedgeId h = unchecked::bridge(brep_, joined[to].h, from.h);  // runs to the hole
      joined.insert(joined.end(), hole.begin(), hole.end());
      joined.push_back({h, joined[to].at});  // the corners before the bridge, at both ends
      joined.push_back({twin(h), from.at});
    }
  }

 private:
  struct Corner {
    HalfedgeId h;
    glm::dvec2 at;
  };
  struct Edge {
    glm::dvec2 from, to;
  };

  static double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
  static double area(const std::vector<Corner>& cycle) {
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < cycle.size(); ++i) { sum += cross(cycle[i].at - cycle[0].at, cycle[i + 1].at - cycle[0].at); }
    return sum;
  }

  [[nodiscard]] bool visible(const Corner& from, const Corner& to, double margin) const {
    const glm::dvec2 d = to.at - from.at;
    if (from.at == to.at || !within(from, d) || !within(to, -d)) { return false; }
    for (const Edge& e : edges_) {
      const double a = cross(d, e.from - from.at), b = cross(d, e.to - from.at);
      if ((a > margin && b > margin) || (a < -margin && b < -margin)) { continue; }
      const bool shares_from = e.from == from.at || e.from == to.at, shares_to = e.to == from.at || e.to == to.at;
      if (shares_from && shares_to) { return false; }
      if (shares_from || shares_to) {  // the other end must not lie on the bridge
        const glm::dvec2 other = shares_from ? e.to : e.from;
        const double s = cross(d, other - from.at), along = glm::dot(d, other - from.at);
        if (std::abs(s) <= margin && along > 0.0 && along < glm::dot(d, d)) { return false; }
        continue;
      }
      const glm::dvec2 x = e.to - e.from;
      const double s = cross(x, from.at - e.from), t = cross(x, to.at - e.from);
      if ((s > margin && t > margin) || (s < -margin && t < -margin)) { continue; }
      return false;
    }
    return true;
  }
  // Does the direction leave into the face at the corner?
  [[nodiscard]] bool within(const Corner& c, const glm::dvec2& d) const {
    const glm::dvec2 out = place_(brep_.next(c.h)) - c.at, in = place_(brep_.prev(c.h)) - c.at;
    if (cross(out, in) > 0.0) { return cross(out, d) > 0.0 && cross(d, in) > 0.0; }
    return cross(out, d) > 0.0 || cross(d, in) > 0.0;
  }

  B& brep_;
  Place place_;
  std::vector<std::vector<Corner>> cycles_;
  std::vector<Edge> edges_;
};

}  // namespace brep::csg::detail
