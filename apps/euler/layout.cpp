// SPDX-License-Identifier: MIT
#include "apps/euler/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace apps::euler {
namespace {

using Point = glm::dvec2;
constexpr int pieces = 6;  // of an arc, for distances

struct Before {
  std::map<std::uint32_t, Point> vertices, edges;  // edges: the middle
  std::set<std::uint32_t> outer;
  std::vector<bool> cut;
};

Before look_back(const Layout& layout) {
  Before before;
  for (const Panel& panel : layout.panels) {
    before.outer.insert(panel.outer_face);
    for (const VertexMark& v : panel.vertices) { before.vertices[v.vertex] = v.at; }
    for (const Strand& s : panel.strands) {
      const std::uint32_t e = s.halfedge / 2;
      if (before.cut.size() <= e) { before.cut.resize(e + 1, false); }
      before.cut[e] = s.stub;
      if (!s.stub) { before.edges[e] = s.curve.points[2]; }
    }
  }
  return before;
}

std::uint32_t choose_outer(const PlanarMap& map, const Before& before) {
  std::uint32_t longest = 0, familiar = 0;
  std::size_t most = 0;
  for (std::uint32_t i = 0; i < map.faces.size(); ++i) {
    const auto known = static_cast<std::size_t>(std::count_if(
        map.faces[i].begin(), map.faces[i].end(), [&](std::uint32_t d) { return before.outer.count(map.darts[d].true_face) != 0; }));
    if (known > most) {
      most = known;
      familiar = i;
    }
    const auto name = [&](std::uint32_t face) { return map.darts[map.faces[face].front()].true_face; };
    const std::size_t n = map.faces[i].size(), best = map.faces[longest].size();
    if (n > best || (n == best && name(i) < name(longest))) { longest = i; }
  }
  const std::size_t n = map.faces[familiar].size(), best = map.faces[longest].size();
  return most > 0 && (n >= 3 || best < 3) ? familiar : longest;
}

Point turned(const Point& p, double angle) {
  return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
}

// Turns the drawing by some number of corners, fills the square.
void settle(Embedding& drawing, const PlanarMap& map, std::size_t corners, const Before& before) {
  const auto each_point = [&](auto&& visit) {
    for (Point& p : drawing.vertices) { visit(p); }
    for (auto& edge : drawing.edges) {
      for (Point& p : edge) { visit(p); }
    }
  };
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(corners);
  double best = std::numeric_limits<double>::infinity(), angle = 0.0;
  for (std::size_t k = 0; k < corners; ++k) {
    double sum = 0.0;
    const auto compare = [&](const Point& p, const auto& old, std::uint32_t name) {
      const auto found = old.find(name);
      if (found == old.end()) { return; }
      const Point d = turned(p, turn * static_cast<double>(k)) - found->second;
      sum += glm::dot(d, d);
    };
    for (std::size_t i = 0; i < map.vertices.size(); ++i) { compare(drawing.vertices[i], before.vertices, map.vertices[i]); }
    for (std::size_t i = 0; i < map.edges.size(); ++i) { compare(drawing.edges[i][1], before.edges, map.edges[i].edge); }
    if (sum < best - 1e-9) {
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

double distance(const Point& p, const Point& a, const Point& b) {
  const Point d = b - a;
  const double t = std::clamp(glm::dot(p - a, d) / std::max(glm::dot(d, d), 1e-300), 0.0, 1.0);
  return glm::length(p - a - t * d);
}

// A face of the plane map as straight pieces, each with the dart it belongs to.
struct Outline {
  std::vector<Point> points;
  std::vector<std::uint32_t> dart;

  [[nodiscard]] bool holds(const Point& p) const {
    int winding = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point a = points[i], b = points[(i + 1) % points.size()];
      const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (a.y <= p.y && b.y > p.y && side > 0) { ++winding; }
      if (a.y > p.y && b.y <= p.y && side < 0) { --winding; }
    }
    return winding != 0;
  }
};

Outline outline_of(const PlanarMap& map, const Panel& panel, std::uint32_t face) {
  Outline outline;
  for (const std::uint32_t d : map.faces[face]) {
    std::vector<Point> line = panel.strands[d / 2].curve.flat(pieces);
    if (d % 2 == 1) { std::reverse(line.begin(), line.end()); }
    line.pop_back();
    outline.points.insert(outline.points.end(), line.begin(), line.end());
    outline.dart.insert(outline.dart.end(), line.size(), d);
  }
  return outline;
}

// Labels of the faces inside one face of the plane map: where the way to all lines is longest. Several faces meet there when
// edges are cut open; each gets a label for each run of its darts, in the part that lies nearest to them.
void place_labels(const PlanarMap& map, std::uint32_t face, bool outer, Panel& panel) {
  const Outline outline = outline_of(map, panel, face);
  const auto& walk = map.faces[face];
  const auto name = [&](std::size_t k) { return map.darts[walk[k % walk.size()]].true_face; };
  std::vector<std::size_t> run(walk.size(), 0);  // of equal names, going round
  std::size_t first = 0, runs = 1;
  while (first < walk.size() && name(first) == name(first + walk.size() - 1)) { ++first; }
  if (first == walk.size()) {
    if (outer) {
      panel.labels.push_back({name(0), {-1.08, 1.08}});
      return;
    }
  } else {
    for (std::size_t k = 1; k < walk.size(); ++k) {
      if (name(first + k) != name(first + k - 1)) { ++runs; }
      run[(first + k) % walk.size()] = runs - 1;
    }
  }
  std::map<std::uint32_t, std::size_t> place;
  for (std::size_t k = 0; k < walk.size(); ++k) { place[walk[k]] = k; }
  struct Best {
    double room = -1.0;
    Point at{0.0};
    std::uint32_t face = 0;
  };
  std::vector<Best> best(runs);
  const double reach = outer ? 1.15 : 1.0;
  constexpr int grid = 48;
  for (int iy = 0; iy <= grid; ++iy) {
    for (int ix = 0; ix <= grid; ++ix) {
      const Point p(reach * (2.0 * ix / grid - 1.0), reach * (2.0 * iy / grid - 1.0));
      if (outline.holds(p) == outer) { continue; }
      double room = outer ? reach + 0.1 - std::max(std::abs(p.x), std::abs(p.y)) : 4.0, nearest = 4.0;
      std::size_t owner = 0;
      for (std::size_t i = 0; i < outline.points.size(); ++i) {
        const Point a = outline.points[i], b = outline.points[(i + 1) % outline.points.size()];
        const double d = distance(p, a, b);
        const bool left = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0;
        if (d < nearest - 1e-9 || (d < nearest + 1e-9 && left)) {  // both sides of a spur are equally near
          nearest = d;
          owner = place[outline.dart[i]];
        }
      }
      room = std::min(room, nearest);
      Best& b = best[run[owner]];
      if (room > b.room + 1e-9) { b = {room, p, name(owner)}; }
    }
  }
  for (const Best& b : best) {
    if (b.room > 0) { panel.labels.push_back({b.face, b.at}); }
  }
}

Panel draw(const PlanarMap& map, const Before& before, double smallest) {
  const std::uint32_t outer = choose_outer(map, before);
  const std::size_t corners = map.faces[outer].size();
  // Three corners and more: a side below, the first corner left of it. Two: left and right. One: below.
  const double first_corner = corners == 2   ? std::numbers::pi
                              : corners == 1 ? -0.5 * std::numbers::pi
                                             : std::numbers::pi * (-0.5 - 1.0 / static_cast<double>(corners));
  Embedding drawing = embed(map, outer, first_corner);
  settle(drawing, map, corners, before);

  Panel panel;
  double length = 0.0;
  for (std::uint32_t i = 0; i < map.edges.size(); ++i) {
    Strand strand{map.darts[2 * i].halfedge, map.edges[i].stub, {}};
    strand.curve.points.front() = drawing.vertices[map.darts[2 * i].vertex];
    std::copy(drawing.edges[i].begin(), drawing.edges[i].end(), strand.curve.points.begin() + 1);
    strand.curve.points.back() = drawing.vertices[map.darts[2 * i + 1].vertex];
    for (std::size_t k = 1; k < strand.curve.points.size(); ++k) {
      length += std::log(glm::length(strand.curve.points[k] - strand.curve.points[k - 1]));
    }
    panel.strands.push_back(strand);
  }
  const double typical = (inner_points + 1) * std::exp(length / static_cast<double>((inner_points + 1) * map.edges.size()));
  panel.text = std::clamp(0.15 * typical, smallest, std::max(smallest, 0.078));
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
    place_labels(map, f, f == outer, panel);
  }
  return panel;
}

}  // namespace

std::vector<Point> Curve::flat(int n) const {
  std::vector<Point> line{points.front()};
  Point start = points.front();
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const Point end = k + 2 == points.size() ? points.back() : 0.5 * (points[k] + points[k + 1]);
    for (int i = 1; i <= n; ++i) {
      const double t = static_cast<double>(i) / n;
      line.push_back(glm::mix(glm::mix(start, points[k], t), glm::mix(points[k], end, t), t));
    }
    start = end;
  }
  return line;
}

Layout lay_out(const Records& records, const Layout& before, double smallest) {
  const Before seen = look_back(before);
  Layout layout;
  for (const auto& shell : shells_of(records)) { layout.panels.push_back(draw(planar_map(records, shell, seen.cut), seen, smallest)); }
  return layout;
}

}  // namespace apps::euler
