// SPDX-License-Identifier: MIT
#include "apps/euler/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <brep/handles.hpp>

#include "apps/euler/relaxation.hpp"

namespace apps::euler {
namespace {

using Point = glm::dvec2;

struct Before {
  std::map<std::uint32_t, Point> vertices, edges;  // edges: their midpoints
  std::set<std::uint32_t> outer;
  std::vector<bool> cut;
};

Before look_back(const Layout& layout) {
  Before before;
  const std::size_t columns = columns_of(layout);
  for (std::size_t i = 0; i < layout.panels.size(); ++i) {
    const Panel& panel = layout.panels[i];
    const Point shift = 2.5 * Point(static_cast<double>(i % columns), -static_cast<double>(i / columns));
    before.outer.insert(panel.outer_face);
    for (const VertexMark& v : panel.vertices) { before.vertices[v.vertex] = v.at + shift; }
    for (const Strand& s : panel.strands) {
      const std::uint32_t e = s.halfedge / 2;
      if (before.cut.size() <= e) { before.cut.resize(e + 1, false); }
      before.cut[e] = s.stub;
      if (!s.stub) { before.edges[e] = s.curve.points[2] + shift; }
    }
  }
  return before;
}

// The faces in the order in which they are tried as outer face: first those of the previous picture, then those with the longest walks.
std::vector<std::uint32_t> outer_faces(const PlanarMap& map, const Before& before) {
  std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> rank;  // lower is better
  std::vector<std::uint32_t> order(map.faces.size());
  for (std::uint32_t i = 0; i < map.faces.size(); ++i) {
    const auto& walk = map.faces[i];
    order[i] = i;
    rank.emplace_back(
        -std::count_if(walk.begin(), walk.end(), [&](std::uint32_t d) { return before.outer.count(map.darts[d].true_face) != 0; }),
        -static_cast<std::ptrdiff_t>(walk.size()));
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(rank[a], map.darts[map.faces[a].front()].true_face) < std::pair(rank[b], map.darts[map.faces[b].front()].true_face);
  });
  return order;
}

Point turned(const Point& p, double angle) {
  return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
}

// Turns the drawing by the best number of corners and scales it to fill the square.
void settle(Embedding& drawing, const PlanarMap& map, std::size_t corners, const Before& before) {
  const auto each_point = [&](auto&& visit) {
    for (Point& p : drawing.vertices) { visit(p); }
    for (auto& edge : drawing.edges) {
      for (Point& p : edge) { visit(p); }
    }
  };
  // Positions of elements in both pictures, now and before. The best rotation has the largest sum of scalar products of the two, where
  // those of the previous picture are measured from their mean.
  std::vector<std::pair<Point, Point>> pairs;
  const auto pair = [&](const Point& p, const std::map<std::uint32_t, Point>& old, std::uint32_t name) {
    if (const auto found = old.find(name); found != old.end()) { pairs.emplace_back(p, found->second); }
  };
  for (std::size_t i = 0; i < map.vertices.size(); ++i) { pair(drawing.vertices[i], before.vertices, map.vertices[i]); }
  for (std::size_t i = 0; i < map.edges.size(); ++i) { pair(drawing.edges[i][1], before.edges, map.edges[i].edge); }
  Point middle(0.0);
  for (const auto& [now, then] : pairs) { middle += then / static_cast<double>(pairs.size()); }
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(corners);
  double best = -std::numeric_limits<double>::infinity(), angle = 0.0;
  for (std::size_t k = 0; k < corners; ++k) {
    double sum = 0.0;
    for (const auto& [now, then] : pairs) { sum += glm::dot(turned(now, turn * static_cast<double>(k)), then - middle); }
    if (sum > best + 1e-9) {
      best = sum;
      angle = turn * static_cast<double>(k);
    }
  }
  Point low(std::numeric_limits<double>::infinity()), high(-low);
  each_point([&](Point& p) {
    p = turned(p, angle);
    low = glm::min(low, p);
    high = glm::max(high, p);
  });
  const double half = 0.5 * std::max(high.x - low.x, high.y - low.y);
  each_point([&](Point& p) { p = (p - 0.5 * (low + high)) / half; });
}

bool cross(const std::vector<Point>& s, const std::vector<Point>& t) {
  for (std::size_t i = 1; i < s.size(); ++i) {
    for (std::size_t j = 1; j < t.size(); ++j) {
      const Point &a = s[i - 1], &b = s[i], &c = t[j - 1], &d = t[j];
      if (twice_area(a, b, c) * twice_area(a, b, d) < 0 && twice_area(c, d, a) * twice_area(c, d, b) < 0) { return true; }
    }
  }
  return false;
}

// The polylines do not cross. If their rounded forms do, both are rounded less, finally not at all.
void part(std::vector<Strand>& strands) {
  std::vector<std::vector<Point>> lines(strands.size());
  std::vector<bool> changed(strands.size(), true);
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < strands.size(); ++i) {
      if (changed[i]) { lines[i] = strands[i].curve.flat(8); }
    }
    std::vector<bool> sharper(strands.size(), false);
    for (std::size_t i = 0; i < strands.size(); ++i) {
      for (std::size_t j = i; j < strands.size(); ++j) {
        if ((changed[i] || changed[j]) && cross(lines[i], lines[j])) { sharper[i] = sharper[j] = true; }
      }
    }
    for (std::size_t i = 0; i < strands.size(); ++i) {
      double& rounding = strands[i].curve.rounding;
      changed[i] = sharper[i] && rounding > 0.0;
      if (changed[i]) { rounding = rounding > 0.2 ? 0.6 * rounding : 0.0; }
      again = again || changed[i];
    }
  }
}

Panel draw(const PlanarMap& map, const Before& before, double smallest) {
  constexpr std::size_t most_tries = 8;
  std::optional<Embedding> embedded;
  std::uint32_t outer = 0;
  const std::vector<std::uint32_t> order = outer_faces(map, before);
  for (std::size_t i = 0; i < std::min(most_tries, order.size()) && !embedded; ++i) {
    outer = order[i];
    const std::size_t corners = map.faces[outer].size();
    // A tree begins on the left. With three or more corners a side is at the bottom, and the first corner is its left end. Two corners
    // are left and right, one is at the bottom.
    const double first_corner = corners == 2 || map.faces.size() == 1 ? std::numbers::pi
                                : corners == 1                        ? -0.5 * std::numbers::pi
                                                                      : std::numbers::pi * (-0.5 - 1.0 / static_cast<double>(corners));
    embedded = embed(map, outer, first_corner);
  }
  if (!embedded) { return {}; }
  Embedding& drawing = *embedded;
  settle(drawing, map, map.faces[outer].size(), before);

  Panel panel;
  for (std::uint32_t i = 0; i < map.edges.size(); ++i) {
    Strand strand;
    strand.halfedge = map.darts[2 * i].halfedge;
    strand.stub = map.edges[i].stub;
    strand.curve.points.front() = drawing.vertices[map.darts[2 * i].vertex];
    std::copy(drawing.edges[i].begin(), drawing.edges[i].end(), strand.curve.points.begin() + 1);
    strand.curve.points.back() = drawing.vertices[map.darts[2 * i + 1].vertex];
    panel.strands.push_back(strand);
  }
  part(panel.strands);
  for (std::size_t i = 0; i < map.vertices.size(); ++i) {
    if (map.vertices[i] != brep::invalid_index) { panel.vertices.push_back({map.vertices[i], drawing.vertices[i]}); }
  }
  for (std::uint32_t f = 0; f < map.faces.size(); ++f) {
    const auto& walk = map.faces[f];
    const std::uint32_t face = map.darts[walk.front()].true_face;
    const bool whole = std::all_of(walk.begin(), walk.end(), [&](std::uint32_t d) { return map.darts[d].true_face == face; });
    if (f == outer) {
      panel.outer_whole = whole;
      std::map<std::uint32_t, int> share;
      for (const std::uint32_t d : walk) { ++share[map.darts[d].true_face]; }
      panel.outer_face =
          std::max_element(share.begin(), share.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
    } else if (whole) {
      FaceArea area{face, {}};
      for (const std::uint32_t d : walk) { area.strands.push_back(d % 2 == 0 ? d / 2 : ~std::size_t{d / 2}); }
      panel.areas.push_back(std::move(area));
    }
  }
  place_names(map, outer, smallest, panel);
  return panel;
}

}  // namespace

std::array<Point, 3> Curve::arc(std::size_t k) const {
  const Point before = k == 1 ? points[0] : 0.5 * (points[k - 1] + points[k]);
  const Point after = k + 2 == points.size() ? points[k + 1] : 0.5 * (points[k] + points[k + 1]);
  return {glm::mix(points[k], before, rounding), points[k], glm::mix(points[k], after, rounding)};
}

std::vector<Point> Curve::flat(int n) const {
  std::vector<Point> line{points.front()};
  const auto add = [&](const Point& p) {
    if (p != line.back()) { line.push_back(p); }
  };
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const auto [a, b, c] = arc(k);
    for (int i = 0; i <= n; ++i) {
      const double t = static_cast<double>(i) / n;
      add(glm::mix(glm::mix(a, b, t), glm::mix(b, c, t), t));
    }
  }
  add(points.back());
  return line;
}

double length_of(const std::vector<Point>& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) { sum += glm::length(line[i] - line[i - 1]); }
  return sum;
}

Spot spot_on(const std::vector<Point>& line, double way) {
  for (std::size_t i = 1;; ++i) {
    const Point d = line[i] - line[i - 1];
    const double length = std::max(glm::length(d), 1e-12);
    if (way <= length || i + 1 == line.size()) { return {line[i - 1] + d * (way / length), d / length}; }
    way -= length;
  }
}

std::size_t columns_of(const Layout& layout) {
  std::size_t columns = 1;
  while (columns * columns < layout.panels.size()) { ++columns; }
  return columns;
}

Layout lay_out(const Records& records, const Layout& before, double smallest) {
  const Before seen = look_back(before);
  Layout layout;
  const auto shells = shells_of(records);
  layout.panels.resize(shells.size());
  const double columns = static_cast<double>(columns_of(layout));
  for (std::size_t i = 0; i < shells.size(); ++i) {
    layout.panels[i] = draw(planar_map(records, shells[i], seen.cut), seen, std::min(0.13, smallest * columns));
  }
  return layout;
}

}  // namespace apps::euler
