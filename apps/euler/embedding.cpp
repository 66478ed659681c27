// SPDX-License-Identifier: MIT
#include "apps/euler/embedding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "apps/euler/relaxation.hpp"

namespace apps::euler {
namespace {

using Point = glm::dvec2;

std::uint32_t inner_point(const PlanarMap& map, std::uint32_t dart, std::size_t k) {
  const std::size_t along = dart % 2 == 0 ? k : inner_points - 1 - k;
  return static_cast<std::uint32_t>(map.vertices.size() + dart / 2 * inner_points + along);
}

// All points on the walk around a face, in order.
std::vector<std::uint32_t> points_around(const PlanarMap& map, std::uint32_t face) {
  std::vector<std::uint32_t> points;
  for (const std::uint32_t d : map.faces[face]) {
    points.push_back(map.darts[d].vertex);
    for (std::size_t k = 0; k < inner_points; ++k) { points.push_back(inner_point(map, d, k)); }
  }
  return points;
}

// Rest shapes use the distance of neighbouring points on an edge as unit. Strips of this width run along both sides of edges.
constexpr double strip = 0.9;

// A part that is attached to the boundary of its face by a single vertex is pulled outwards by few links and inwards by many. Weights
// that fall by this factor from face to face compensate for this; otherwise each level of nested loops would be a hundred times smaller
// than the one around it.
constexpr double softer = 0.03;

struct Builder {
  Net net;

  double pull = 1.0;

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Point& pa, const Point& pb, const Point& pc) {
    net.triangles.push_back({{a, b, c}, glm::inverse(glm::dmat2(pb - pa, pc - pa)), pull});
    net.rest_area += 0.5 * ((pb - pa).x * (pc - pa).y - (pb - pa).y * (pc - pa).x);
  }
};

// For each face, the number of edges between it and the outer face.
std::vector<int> depths(const PlanarMap& map, std::uint32_t outer) {
  std::vector<int> depth(map.faces.size(), -1);
  std::vector<std::uint32_t> reached{outer};
  depth[outer] = 0;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const std::uint32_t d : map.faces[reached[i]]) {
      const std::uint32_t next = map.darts[d ^ 1U].face;
      if (depth[next] >= 0) { continue; }
      depth[next] = depth[reached[i]] + 1;
      reached.push_back(next);
    }
  }
  return depth;
}

Net triangulate(const PlanarMap& map, std::uint32_t outer) {
  Builder builder;
  Net& net = builder.net;
  const std::vector<int> depth = depths(map, outer);
  net.count = static_cast<std::uint32_t>(map.vertices.size() + map.edges.size() * inner_points);
  for (std::uint32_t face = 0; face < map.faces.size(); ++face) {
    builder.pull = std::pow(softer, depth[face]);
    const std::vector<std::uint32_t> p = points_around(map, face);
    const auto n = static_cast<std::uint32_t>(p.size());
    const std::uint32_t ring = net.count;
    net.count += n;
    const std::uint32_t centre = net.count;
    if (face != outer) { ++net.count; }
    const double height = std::max(1.0, n / (2.0 * std::numbers::pi) - strip);  // of the triangles at the centre
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      // Stubs carry the labels of both half-edges.
      const double step = map.edges[map.faces[face][i / (inner_points + 1)] / 2].stub ? 1.6 : 1.0;
      if (i % (inner_points + 1) < (inner_points + 1) / 2) {  // diagonals from the ends of an edge: mirror images of each other
        builder.triangle(p[i], p[j], ring + j, {0, 0}, {step, 0}, {step, strip});
        builder.triangle(p[i], ring + j, ring + i, {0, 0}, {step, strip}, {0, strip});
      } else {
        builder.triangle(p[i], p[j], ring + i, {0, 0}, {step, 0}, {0, strip});
        builder.triangle(p[j], ring + j, ring + i, {step, 0}, {step, strip}, {0, strip});
      }
      if (face == outer) {
        net.outer_ring.push_back(ring + i);
      } else {
        builder.triangle(ring + i, ring + j, centre, {0, 0}, {1, 0}, {0.5, height});
      }
    }
  }
  for (const Triangle& t : net.triangles) {
    for (const auto& [a, b] :
         {std::pair(t.corner[0], t.corner[1]), std::pair(t.corner[1], t.corner[2]), std::pair(t.corner[2], t.corner[0])}) {
      net.links.push_back({a, b, t.pull});  // twice for an edge of two triangles
    }
  }
  for (std::uint32_t d = 0; d < map.darts.size(); d += 2) {
    std::array<std::uint32_t, inner_points + 2> line{};
    line.front() = map.darts[d].vertex;
    for (std::size_t k = 0; k < inner_points; ++k) { line[k + 1] = inner_point(map, d, k); }
    line.back() = map.darts[d + 1].vertex;
    for (std::size_t k = 1; k + 1 < line.size(); ++k) { net.bends.push_back({line[k - 1], line[k], line[k + 1]}); }
  }
  return net;
}

// Places each free point at the weighted mean of its neighbours. Points are eliminated one by one, those with few neighbours first; the
// elimination links the neighbours with each other (the star-mesh transform of electrical networks). Only positive numbers are added and
// multiplied, so there is no cancellation, and even parts a million times smaller than the disc are exact to rounding.
void solve(const Net& net, const std::vector<bool>& fixed, std::vector<Point>& x) {
  struct Neighbour {
    std::uint32_t point;
    double weight;
  };
  std::vector<std::vector<Neighbour>> around(net.count);
  const auto link = [&](std::uint32_t a, std::uint32_t b, double w) {
    const auto known = std::find_if(around[a].begin(), around[a].end(), [&](const Neighbour& n) { return n.point == b; });
    if (known == around[a].end()) {
      around[a].push_back({b, w});
    } else {
      known->weight += w;
    }
  };
  for (const Link& l : net.links) {
    link(l.a, l.b, l.weight);
    link(l.b, l.a, l.weight);
  }
  std::set<std::pair<std::size_t, std::uint32_t>> waiting;  // free points by the number of their neighbours
  for (std::uint32_t i = 0; i < net.count; ++i) {
    if (!fixed[i]) { waiting.emplace(around[i].size(), i); }
  }
  std::vector<std::uint32_t> order;
  while (!waiting.empty()) {
    const std::uint32_t i = waiting.begin()->second;
    waiting.erase(waiting.begin());
    order.push_back(i);
    double sum = 0.0;
    for (const Neighbour& n : around[i]) { sum += n.weight; }
    for (Neighbour& n : around[i]) { n.weight /= sum; }
    for (const Neighbour& n : around[i]) {
      if (fixed[n.point]) { continue; }
      auto& theirs = around[n.point];
      waiting.erase({theirs.size(), n.point});
      const auto self = std::find_if(theirs.begin(), theirs.end(), [&](const Neighbour& t) { return t.point == i; });
      const double pull = self->weight;
      *self = theirs.back();
      theirs.pop_back();
      for (const Neighbour& m : around[i]) {
        if (m.point != n.point) { link(n.point, m.point, pull * m.weight); }
      }
      waiting.emplace(theirs.size(), n.point);
    }
  }
  for (std::size_t k = order.size(); k-- > 0;) {
    Point mean(0.0);
    for (const Neighbour& n : around[order[k]]) { mean += n.weight * x[n.point]; }
    x[order[k]] = mean;
  }
}

}  // namespace

std::optional<Embedding> embed(const PlanarMap& map, std::uint32_t outer, double first_corner) {
  const Net net = triangulate(map, outer);
  std::vector<Point> x(net.count, Point(0.0));
  std::vector<bool> fixed(net.count, false);
  // The corners lie on the unit circle. With three to eight corners the points between them lie on straight lines, else on the circle too.
  const std::size_t corners = map.faces[outer].size(), along = inner_points + 1;
  const bool polygon = corners >= 3 && corners <= 8;
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(corners);
  for (std::size_t i = 0; i < net.outer_ring.size(); ++i) {
    const double side = static_cast<double>(i / along), part = static_cast<double>(i % along) / static_cast<double>(along);
    const auto on_circle = [&](double k) { return Point(std::cos(first_corner - turn * k), std::sin(first_corner - turn * k)); };
    x[net.outer_ring[i]] = polygon ? glm::mix(on_circle(side), on_circle(side + 1), part) : on_circle(side + part);
    fixed[net.outer_ring[i]] = true;
  }
  double room = 0.0;
  for (std::size_t i = 1; i + 1 < net.outer_ring.size(); ++i) {
    room -= 0.5 * twice_area(x[net.outer_ring[0]], x[net.outer_ring[i]], x[net.outer_ring[i + 1]]);
  }
  solve(net, fixed, x);
  const double scale = std::sqrt(room / net.rest_area);
  unfold(net, scale, fixed, x);
  if (!all_turn_left(net, x)) { return std::nullopt; }
  relax(net, scale, fixed, x);
  Embedding result;
  result.vertices.assign(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(map.vertices.size()));
  for (std::uint32_t e = 0; e < map.edges.size(); ++e) {
    auto& points = result.edges.emplace_back();
    for (std::size_t k = 0; k < inner_points; ++k) { points[k] = x[inner_point(map, 2 * e, k)]; }
  }
  return result;
}

}  // namespace apps::euler
