// SPDX-License-Identifier: MIT
#include "apps/euler/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/euler/relaxation.hpp"

namespace apps::euler {
namespace {

using Point = glm::dvec2;
constexpr int pieces = 6;  // segments per arc, for computing distances
constexpr double edge_of_panel = 1.18;

double distance(const Point& p, const Point& a, const Point& b) {
  const Point d = b - a;
  const double t = std::clamp(glm::dot(p - a, d) / std::max(glm::dot(d, d), 1e-300), 0.0, 1.0);
  return glm::length(p - a - t * d);
}

// Shrinks a name while it overlaps another one, to a size that is readable when magnified; to 0, not drawn, if even that does not fit.
void shrink_until_free(const std::vector<NameBox>& taken, double smallest, std::size_t letters, const Point& at, double& size) {
  const auto covered = [&] {
    return std::any_of(taken.begin(), taken.end(), [box = name_box(at, letters, size)](const NameBox& other) { return cover(box, other); });
  };
  while (size > 0.2 * smallest && covered()) { size *= 0.85; }
  if (covered()) { size = 0.0; }
}

// One face of the plane map, sampled at points. Where edges are cut open, it may consist of several faces of the shell; each run of darts
// on the walk that belong to one of these owns the part that is nearest to it.
class Region {
 public:
  Region(const PlanarMap& map, const Panel& panel, std::uint32_t face, bool outer) : outer_(outer) {
    const auto& walk = map.faces[face];
    const auto name = [&](std::size_t k) { return map.darts[walk[k % walk.size()]].true_face; };
    std::size_t first = 0;
    while (first < walk.size() && name(first) == name(first + walk.size() - 1)) { ++first; }
    for (std::size_t k = 0; k < walk.size(); ++k) {
      if (k == 0 || name(first + k) != name(first + k - 1)) { runs_.push_back({name(first + k), {}}); }
      const std::uint32_t d = walk[(first + k) % walk.size()];
      runs_.back().darts.push_back(d);
      std::vector<Point> line = panel.strands[d / 2].curve.flat(pieces);
      if (d % 2 == 1) { std::reverse(line.begin(), line.end()); }
      line.pop_back();
      points_.insert(points_.end(), line.begin(), line.end());
      owner_.insert(owner_.end(), line.size(), runs_.size() - 1);
    }
    sample();
  }

  [[nodiscard]] bool whole() const { return runs_.size() == 1; }
  [[nodiscard]] double room() const {
    double most = 0.0;
    for (const Site& s : sites_) { most = std::max(most, s.room); }
    return most;
  }

  void label(Panel& panel, double size) const {
    if (outer_ && whole()) {
      panel.labels.push_back({runs_.front().name, {-1.08, 1.08}, size});
      return;
    }
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const std::uint32_t d = runs_[r].darts[runs_[r].darts.size() / 2];
      const Point near = panel.strands[d / 2].curve.points[2];
      double best = -std::numeric_limits<double>::infinity();
      Point at(0.0);
      for (const Site& s : sites_) {
        if (s.owner != r) { continue; }
        double room = s.room;
        for (const Strand& strand : panel.strands) {
          for (const std::uint32_t k : {0U, 1U}) { room = std::min(room, glm::length(s.at - strand.names[k]) - 0.9 * strand.sizes[k]); }
          if (strand.stub) { room = std::min(room, glm::length(s.at - strand.curve.points.back()) - panel.text); }
        }
        for (const VertexMark& v : panel.vertices) { room = std::min(room, glm::length(s.at - v.at) - panel.text); }
        for (const FaceLabel& l : panel.labels) { room = std::min(room, glm::length(s.at - l.at) - 0.8 * l.size); }
        // If the face is the only one here, its name is in the middle. Otherwise it is near its run of darts, provided there is
        // enough room.
        const double value = whole() ? room : std::min(room, size) - 0.2 * glm::length(s.at - near);
        if (value > best + 1e-9) {
          best = value;
          at = s.at;
        }
      }
      if (best > -std::numeric_limits<double>::infinity()) { panel.labels.push_back({runs_[r].name, at, size}); }
    }
  }

 private:
  struct Run {
    std::uint32_t name;
    std::vector<std::uint32_t> darts;
  };
  struct Site {
    Point at;
    double room;  // distance from all lines
    std::size_t owner;
  };

  [[nodiscard]] bool holds(const Point& p) const {
    int winding = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Point a = points_[i], b = points_[(i + 1) % points_.size()];
      if (a.y <= p.y && b.y > p.y && twice_area(a, b, p) > 0) { ++winding; }
      if (a.y > p.y && b.y <= p.y && twice_area(a, b, p) < 0) { --winding; }
    }
    return (winding != 0) != outer_;
  }
  void sample() {
    Point low(outer_ ? -edge_of_panel : std::numeric_limits<double>::infinity()), high(-low);
    for (const Point& p : points_) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    const int grid = outer_ ? 48 : 28;
    for (int iy = 1; iy < grid; ++iy) {
      for (int ix = 1; ix < grid; ++ix) {
        const Point p = low + (high - low) * Point(ix, iy) / static_cast<double>(grid);
        if (!holds(p)) { continue; }
        Site site{p, std::numeric_limits<double>::infinity(), 0};
        for (std::size_t i = 0; i < points_.size(); ++i) {
          const Point a = points_[i], b = points_[(i + 1) % points_.size()];
          const double d = distance(p, a, b);
          // For a point equally near to both sides of a spur, the side it is on decides.
          if (d < site.room - 1e-9 || (d < site.room + 1e-9 && twice_area(a, b, p) > 0)) {
            site.room = d;
            site.owner = owner_[i];
          }
        }
        if (outer_) { site.room = std::min(site.room, edge_of_panel - std::max(std::abs(p.x), std::abs(p.y))); }
        sites_.push_back(site);
      }
    }
  }

  bool outer_;
  std::vector<Run> runs_;
  std::vector<Point> points_;
  std::vector<std::size_t> owner_;  // by point: the run of the segment from this point to the next
  std::vector<Site> sites_;
};

// The occupied areas of the panel, and the smallest ratio of a half-edge's name to its wanted size; 0 if one is not drawn.
struct Crowd {
  std::vector<NameBox> taken;
  double least = 1.0;
};
// Places the names of the half-edges, with the panel's size of text. `rooms`: by face.
Crowd name_halfedges(const PlanarMap& map, const std::vector<double>& rooms, std::uint32_t outer, double smallest, Panel& panel) {
  panel.gap = 0.36 * panel.text;
  Crowd crowd;
  std::vector<NameBox>& taken = crowd.taken;
  for (const VertexMark& v : panel.vertices) { taken.push_back(vertex_box(panel, v)); }
  for (std::size_t i = 0; i < panel.strands.size(); ++i) {
    Strand& s = panel.strands[i];
    if (s.stub) { taken.push_back({s.curve.points.back(), {0.9 * panel.text, 0.65 * panel.text}}); }
  }
  for (std::size_t i = 0; i < panel.strands.size(); ++i) {
    Strand& s = panel.strands[i];
    std::vector<Point> line = s.curve.flat(pieces);
    for (const std::uint32_t k : {0U, 1U}) {
      const std::uint32_t face = map.darts[2 * i + k].face;
      s.sizes[k] = face == outer ? panel.text : std::clamp(0.34 * rooms[face], 0.75 * smallest, panel.text);
      const std::size_t letters = std::to_string(s.halfedge ^ k).size() + 1;
      // Tries the middle of the edge, then other positions along it, then smaller letters; if nothing is free, the name is not drawn
      // (size 0).
      for (const double size : {1.0, 0.85, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2}) {
        bool found = false;
        for (const double along : {0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.18, 0.82, 0.1, 0.9}) {
          const Spot spot = spot_on(line, along * length_of(line));
          const Point out = spot.left();
          // The distance from the edge depends on the direction, because names are wider than high.
          const double reach = std::abs(out.x) * 0.28 * static_cast<double>(letters) + std::abs(out.y) * 0.36;
          const Point at = spot.at + (panel.gap + (0.16 + reach) * size * s.sizes[k]) * out;
          const NameBox box = name_box(at, letters, size * s.sizes[k]);
          found = std::none_of(taken.begin(), taken.end(), [&](const NameBox& other) { return cover(box, other); });
          if (found || along == 0.5) { s.names[k] = at; }
          if (found) { break; }
        }
        if (found || size == 0.2) {
          s.sizes[k] *= found ? size : 0.0;
          crowd.least = std::min(crowd.least, found ? size : 0.0);
          break;
        }
      }
      taken.push_back(name_box(s.names[k], letters, s.sizes[k]));
      std::reverse(line.begin(), line.end());
    }
  }
  return crowd;
}

}  // namespace

void place_names(const PlanarMap& map, std::uint32_t outer, double smallest, Panel& panel) {
  std::vector<Region> regions;
  std::vector<double> rooms, inner;
  for (std::uint32_t f = 0; f < map.faces.size(); ++f) {
    regions.emplace_back(map, panel, f, f == outer);
    rooms.push_back(regions.back().room());
    if (f != outer) { inner.push_back(rooms.back()); }
  }
  double length = 0.0;
  for (const Strand& s : panel.strands) { length += std::log(std::max(length_of(s.curve.flat(1)), 1e-9)); }
  double wanted = 0.14 * std::exp(length / static_cast<double>(panel.strands.size()));
  if (!inner.empty()) {
    const auto middle = inner.begin() + static_cast<std::ptrdiff_t>(inner.size() / 2);
    std::nth_element(inner.begin(), middle, inner.end());
    wanted = std::min(wanted, 0.5 * *middle);
  }
  const double largest = std::max(smallest, 0.072);
  panel.text = std::clamp(wanted, smallest, largest);
  // Reduces the size if names would be less than half as large as wanted.
  Crowd crowd = name_halfedges(map, rooms, outer, smallest, panel);
  while (crowd.least < 0.5 && panel.text > smallest) {
    panel.text = std::max(smallest, 0.9 * panel.text);
    crowd = name_halfedges(map, rooms, outer, smallest, panel);
  }
  std::vector<NameBox>& taken = crowd.taken;
  for (std::uint32_t f = 0; f < map.faces.size(); ++f) {
    const bool small = f != outer && regions[f].whole();
    const std::size_t before = panel.labels.size();
    regions[f].label(panel, small ? std::clamp(0.52 * rooms[f], smallest, 1.4 * panel.text) : 1.4 * panel.text);
    for (std::size_t l = before; l < panel.labels.size(); ++l) {
      FaceLabel& label = panel.labels[l];
      const std::size_t letters = std::to_string(label.face).size() + 1;
      shrink_until_free(taken, smallest, letters, label.at, label.size);
      taken.push_back(name_box(label.at, letters, label.size));
    }
  }
}

}  // namespace apps::euler
