// SPDX-License-Identifier: MIT
#include "apps/euler/embedding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

namespace apps::euler {
namespace {

using Point = glm::dvec2;

struct Link {
  std::uint32_t a, b;
  double weight;
};

struct Triangle {
  std::array<std::uint32_t, 3> corner;  // counter-clockwise
  glm::dmat2 rest;                      // the inverse of its edge vectors in its rest shape
  double pull;                          // the weight of its sides
};

// The triangulation: vertices of the map first, then inner points of edges, rings, centres.
struct Net {
  std::vector<Triangle> triangles;
  std::vector<Link> links;
  std::vector<std::array<std::uint32_t, 3>> bends;  // three points in a row on an edge
  std::vector<std::uint32_t> outer_ring;            // clockwise, as the walk around the outer face
  double rest_area = 0.0;
  std::uint32_t count = 0;
};

std::uint32_t inner_point(const PlanarMap& map, std::uint32_t dart, std::size_t k) {
  const std::size_t along = dart % 2 == 0 ? k : inner_points - 1 - k;
  return static_cast<std::uint32_t>(map.vertices.size() + dart / 2 * inner_points + along);
}

// All points that the walk around a face passes, in order.
std::vector<std::uint32_t> points_around(const PlanarMap& map, std::uint32_t face) {
  std::vector<std::uint32_t> points;
  for (const std::uint32_t d : map.faces[face]) {
    points.push_back(map.darts[d].vertex);
    for (std::size_t k = 0; k < inner_points; ++k) { points.push_back(inner_point(map, d, k)); }
  }
  return points;
}

// Rest shapes are in units of the distance of neighbouring points on an edge: strips of this width run along both sides of edges.
constexpr double strip = 0.9;

// A part that hangs in a face by one vertex is pulled out by few links and held together by many. That the weights fall by this factor from
// face to face makes up for it, else each level of nested loops would be a hundred times smaller than the one around it.
constexpr double softer = 0.03;

struct Builder {
  Net net;

  double pull = 1.0;

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Point& pa, const Point& pb, const Point& pc) {
    net.triangles.push_back({{a, b, c}, glm::inverse(glm::dmat2(pb - pa, pc - pa)), pull});
    net.rest_area += 0.5 * ((pb - pa).x * (pc - pa).y - (pb - pa).y * (pc - pa).x);
  }
};

// How many edges lie between each face and the outer one.
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
      const double step = map.edges[map.faces[face][i / (inner_points + 1)] / 2].stub ? 1.6 : 1.0;  // stubs have labels of both halves
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
      net.links.push_back({a, b, t.pull});  // twice where two triangles meet
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

// Places each free point at the weighted mean of its neighbours. Points are eliminated one by one, those with few neighbours first;
// each leaves its neighbours linked to each other (the star-mesh transform of electrical networks). Only positive numbers are
// added and multiplied, so even parts that come out a million times smaller than the disc are exact to rounding.
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

double area(const Point& a, const Point& b, const Point& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool all_turn_left(const Net& net, const std::vector<Point>& x) {
  return std::all_of(net.triangles.begin(), net.triangles.end(),
                     [&](const Triangle& t) { return area(x[t.corner[0]], x[t.corner[1]], x[t.corner[2]]) > 0; });
}

// Evens out what the weighted means left tiny. Each point in turn goes to the least value of the sum of |J|^2 - 2 log det(J) over its
// triangles, a convex function, by Newton's method: where all is tiny only the ratio of areas counts, so a part grows by
// a factor in each round however small it begins.
void unfold(const Net& net, double scale, const std::vector<bool>& fixed, std::vector<Point>& x) {
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> at(net.count);  // the triangles of a point, and which corner it is
  for (std::uint32_t t = 0; t < net.triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) { at[net.triangles[t].corner[k]].emplace_back(t, k); }
  }
  constexpr int most = 200;
  for (int round = 0; round < most; ++round) {
    double largest = 0.0;  // change of log(area)
    for (std::uint32_t i = 0; i < net.count; ++i) {
      if (fixed[i]) { continue; }
      Point slope(0.0);
      glm::dmat2 curvature(0.0);
      for (const auto& [t, k] : at[i]) {
        const auto& corner = net.triangles[t].corner;
        const Point b = x[corner[(k + 1) % 3]] - x[i], c = x[corner[(k + 2) % 3]] - x[i];
        const double det = b.x * c.y - b.y * c.x;
        const Point grow(b.y - c.y, c.x - b.x);  // of det when x[i] moves
        const glm::dmat2& rest = net.triangles[t].rest;
        const auto row = [&](std::uint32_t m) {
          return m == 0   ? -Point(rest[0].x + rest[0].y, rest[1].x + rest[1].y)
                 : m == 1 ? Point(rest[0].x, rest[1].x)
                          : Point(rest[0].y, rest[1].y);
        };
        const Point mine = row(k), next = row((k + 1) % 3), last = row((k + 2) % 3);
        // J = b next^T + c last^T since the three rows sum to zero; moving x[i] by d adds d mine^T.
        slope += 2.0 / (scale * scale) * (b * glm::dot(next, mine) + c * glm::dot(last, mine)) - 2.0 / det * grow;
        const double even = 2.0 / (scale * scale) * glm::dot(mine, mine), steep = 2.0 / (det * det);
        curvature +=
            glm::dmat2(even + steep * grow.x * grow.x, steep * grow.x * grow.y, steep * grow.x * grow.y, even + steep * grow.y * grow.y);
      }
      Point step = -glm::inverse(curvature) * slope;
      for (int halvings = 0; halvings < 30; ++halvings, step *= 0.5) {
        double change = 0.0;
        bool open = true;
        for (const auto& [t, k] : at[i]) {
          const auto& corner = net.triangles[t].corner;
          const Point& b = x[corner[(k + 1) % 3]];
          const Point& c = x[corner[(k + 2) % 3]];
          const double before = area(x[i], b, c), after = area(x[i] + step, b, c);
          open = open && after > 0.2 * before;
          change = std::max(change, std::abs(after / before - 1.0));
        }
        if (!open) { continue; }
        x[i] += step;
        largest = std::max(largest, change);
        break;
      }
    }
    if (largest < 0.05) { break; }
  }
}

// How far all triangles are from their rest shapes (the symmetric Dirichlet energy |J|^2 (1 + 1 / det(J)^2), infinite where a
// triangle is turned over) and how much edges bend. Scale: the length in the disc of a rest shape's unit.
double energy(const Net& net, double scale, double stiffness, const std::vector<bool>& fixed, const std::vector<Point>& x,
              std::vector<Point>& gradient) {
  std::fill(gradient.begin(), gradient.end(), Point(0.0));
  double sum = 0.0;
  for (const Triangle& t : net.triangles) {
    const auto& [a, b, c] = t.corner;
    const glm::dmat2 j = glm::dmat2(x[b] - x[a], x[c] - x[a]) * t.rest / scale;
    const double det = j[0].x * j[1].y - j[0].y * j[1].x;
    if (!(det > 0)) { return std::numeric_limits<double>::infinity(); }
    const double square = glm::dot(j[0], j[0]) + glm::dot(j[1], j[1]);
    const double inverse = 1.0 / (det * det);
    sum += square * (1.0 + inverse);
    const glm::dmat2 cofactor(j[1].y, -j[1].x, -j[0].y, j[0].x);
    const glm::dmat2 slope = (2.0 * (1.0 + inverse) * j - 2.0 * square * inverse / det * cofactor) * glm::transpose(t.rest) / scale;
    gradient[b] += slope[0];
    gradient[c] += slope[1];
    gradient[a] -= slope[0] + slope[1];
  }
  for (const auto& [a, b, c] : net.bends) {
    const Point bend = (x[a] - 2.0 * x[b] + x[c]) / scale;
    sum += stiffness * glm::dot(bend, bend);
    const Point slope = 2.0 * stiffness / scale * bend;
    gradient[a] += slope;
    gradient[b] -= 2.0 * slope;
    gradient[c] += slope;
  }
  for (std::size_t i = 0; i < net.count; ++i) {
    if (fixed[i]) { gradient[i] = Point(0.0); }
  }
  return sum;
}

double dot(const std::vector<Point>& a, const std::vector<Point>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) { sum += glm::dot(a[i], b[i]); }
  return sum;
}

// Lowers the energy (L-BFGS, Nocedal 1980) from a drawing without crossings; no triangle turns over on the way.
void relax(const Net& net, double scale, const std::vector<bool>& fixed, std::vector<Point>& x) {
  constexpr double stiffness = 12.0;
  constexpr std::size_t memory = 8;
  constexpr int most = 300;
  struct Pair {
    std::vector<Point> step, change;
    double product;
  };
  std::vector<Pair> pairs;
  std::vector<Point> gradient(x.size(), Point(0.0)), next_gradient = gradient, direction = gradient, next = x;
  double now = energy(net, scale, stiffness, fixed, x, gradient);
  for (int round = 0; round < most; ++round) {
    direction = gradient;
    std::vector<double> share(pairs.size());
    for (std::size_t k = pairs.size(); k-- > 0;) {
      share[k] = dot(pairs[k].step, direction) / pairs[k].product;
      for (std::size_t i = 0; i < x.size(); ++i) { direction[i] -= share[k] * pairs[k].change[i]; }
    }
    if (!pairs.empty()) {
      const double factor = pairs.back().product / dot(pairs.back().change, pairs.back().change);
      for (Point& d : direction) { d *= factor; }
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double more = share[k] - dot(pairs[k].change, direction) / pairs[k].product;
      for (std::size_t i = 0; i < x.size(); ++i) { direction[i] += more * pairs[k].step[i]; }
    }
    double longest = 0.0;
    for (const Point& d : direction) { longest = std::max(longest, glm::length(d)); }
    const double slope = dot(direction, gradient);
    if (!(slope > 0) || !(longest > 0)) { break; }
    double size = std::min(1.0, 0.5 * scale / longest), value = 0.0;
    int halvings = 0;
    for (;; ++halvings) {
      for (std::size_t i = 0; i < x.size(); ++i) { next[i] = x[i] - size * direction[i]; }
      value = energy(net, scale, stiffness, fixed, next, next_gradient);
      if (value <= now - 1e-4 * size * slope || halvings == 40) { break; }
      size *= 0.5;
    }
    if (halvings == 40) { break; }
    Pair pair{next, next_gradient, 0.0};
    for (std::size_t i = 0; i < x.size(); ++i) {
      pair.step[i] -= x[i];
      pair.change[i] -= gradient[i];
    }
    pair.product = dot(pair.step, pair.change);
    const bool done = now - value < 1e-7 * now;
    x.swap(next);
    gradient.swap(next_gradient);
    now = value;
    if (done) { break; }
    if (pair.product > 0) {
      if (pairs.size() == memory) { pairs.erase(pairs.begin()); }
      pairs.push_back(std::move(pair));
    }
  }
}

}  // namespace

std::optional<Embedding> embed(const PlanarMap& map, std::uint32_t outer, double first_corner) {
  const Net net = triangulate(map, outer);
  std::vector<Point> x(net.count, Point(0.0));
  std::vector<bool> fixed(net.count, false);
  // The corners on the unit circle; from three to eight, the points between them on straight lines, else on the circle too.
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
    room -= 0.5 * area(x[net.outer_ring[0]], x[net.outer_ring[i]], x[net.outer_ring[i + 1]]);
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
