// SPDX-License-Identifier: MIT
#pragma once

// Furniture for the tests of the intake: boxes that stand on and against each other, so that they share corners, edges, parts of edges
// and faces, in a room. The boxes are unions of the cells of a lattice, so that it is known which points of them the air of the room
// touches: a law for what the intake makes of them, whatever was done to their polygons.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/polygon.hpp>

#include <raycast/planar.hpp>

#include <radiosity/intake/intake.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"

namespace furniture {

using Cell = std::array<int, 3>;

struct LatticeBox {
  Cell lo{}, hi{};  // cells lo to hi - 1
};

// A point of a box that the air of the room touches.
struct SeenPoint {
  glm::dvec3 position{0.0}, normal{0.0};
};

class Lattice {
 public:
  static constexpr int size = 6;

  // Boxes one after the other, each next to an earlier one where that is possible.
  Lattice(std::mt19937& random, int boxes) {
    for (std::vector<double>& line : lines_) {
      line.push_back(0.0);
      for (int i = 0; i < size; ++i) { line.push_back(line.back() + std::uniform_real_distribution<double>(0.03, 0.3)(random)); }
    }
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int tries = 0; tries < 400 && static_cast<int>(boxes_.size()) < boxes; ++tries) {
      LatticeBox box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = below(size);
        box.hi[k] = std::min(size, box.lo[k] + 1 + below(4));
      }
      if (is_free(box) && (boxes_.empty() || touches(box))) { put(box); }
    }
    flood();
  }

  [[nodiscard]] const std::vector<LatticeBox>& boxes() const { return boxes_; }
  [[nodiscard]] glm::dvec3 at(const Cell& c) const {
    return {lines_[0][static_cast<std::size_t>(c[0])], lines_[1][static_cast<std::size_t>(c[1])],
            lines_[2][static_cast<std::size_t>(c[2])]};
  }
  [[nodiscard]] glm::dvec3 extent() const { return at({size, size, size}); }

  // The middles of all sides of cells that lie on a box and that air from outside touches.
  [[nodiscard]] std::vector<SeenPoint> seen() const {
    std::vector<SeenPoint> points;
    each_cell([&](const Cell& c) {
      if (state(c) != State::box) { return; }
      for (std::size_t k = 0; k < 3; ++k) {
        for (const int step : {-1, 1}) {
          Cell beside = c, far = c;
          beside[k] += step;
          for (int& i : far) { ++i; }
          if (state(beside) != State::air) { continue; }
          SeenPoint p{0.5 * (at(c) + at(far)), glm::dvec3(0.0)};
          const auto axis = static_cast<glm::length_t>(k);
          p.position[axis] = (step > 0 ? at(far) : at(c))[axis];
          p.normal[axis] = step;
          points.push_back(p);
        }
      }
    });
    return points;
  }

 private:
  enum class State : unsigned char { unknown, box, air };

  template <class Visit>
  static void each_cell(const Visit& visit) {
    for (int i = 0; i < size * size * size; ++i) { visit(Cell{i % size, i / size % size, i / size / size}); }
  }
  [[nodiscard]] static bool within(const Cell& c) {
    return std::all_of(c.begin(), c.end(), [](int i) { return i >= 0 && i < size; });
  }
  [[nodiscard]] static std::size_t index(const Cell& c) { return static_cast<std::size_t>(c[0] + size * (c[1] + size * c[2])); }
  // Outside of the lattice is air, but below it the floor.
  [[nodiscard]] State state(const Cell& c) const {
    if (!within(c)) { return c[2] < 0 ? State::unknown : State::air; }
    return cells_[index(c)];
  }
  template <class Visit>
  static void each_of(const LatticeBox& box, const Visit& visit) {
    each_cell([&](const Cell& c) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (c[k] < box.lo[k] || c[k] >= box.hi[k]) { return; }
      }
      visit(c);
    });
  }
  [[nodiscard]] bool is_free(const LatticeBox& box) const {
    bool result = true;
    each_of(box, [&](const Cell& c) { result = result && cells_[index(c)] != State::box; });
    return result;
  }
  [[nodiscard]] bool touches(const LatticeBox& box) const {
    return std::any_of(boxes_.begin(), boxes_.end(), [&](const LatticeBox& other) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (box.hi[k] < other.lo[k] || box.lo[k] > other.hi[k]) { return false; }
      }
      return true;
    });
  }
  void put(const LatticeBox& box) {
    boxes_.push_back(box);
    each_of(box, [&](const Cell& c) { cells_[index(c)] = State::box; });
  }
  // Air comes in from all sides but the floor.
  void flood() {
    for (bool again = true; again;) {
      again = false;
      each_cell([&](const Cell& c) {
        if (cells_[index(c)] != State::unknown) { return; }
        for (std::size_t k = 0; k < 3; ++k) {
          for (const int step : {-1, 1}) {
            Cell beside = c;
            beside[k] += step;
            if (state(beside) != State::air || cells_[index(c)] == State::air) { continue; }
            cells_[index(c)] = State::air;
            again = true;
          }
        }
      });
    }
  }

  std::array<std::vector<double>, 3> lines_;
  std::vector<LatticeBox> boxes_;
  std::array<State, size * size * size> cells_{};
};

// What is done to the polygons.
struct Damage {
  bool each = false;     // every polygon at random
  bool per_box = false;  // every box at random
  bool all = false;
  bool triangles = false;
  bool own_groups = false;  // each box a group
  double doubled = 0.0;     // share of polygons that are given again for their backs
  int decimals = -1;        // of coordinates
};

// A room with a lamp and furniture, and the points of the furniture that are seen.
struct Furnished {
  soup::Soup soup;
  std::vector<SeenPoint> seen;
};

class FurnishedMaker {
 public:
  FurnishedMaker(const Lattice& lattice, std::mt19937& random, const Damage& damage) : random_(random), damage_(damage) {
    const double angle = std::uniform_real_distribution<double>(0.0, 6.0)(random);
    c_ = std::cos(angle);
    s_ = std::sin(angle);
    middle_ = 0.5 * lattice.extent();
    add_room();
    made_.soup.names.emplace_back("furniture");
    for (const LatticeBox& box : lattice.boxes()) {
      if (damage.own_groups) { made_.soup.names.push_back("box" + std::to_string(made_.soup.names.size())); }
      add_box(lattice.at(box.lo), lattice.at(box.hi));
    }
    for (SeenPoint point : lattice.seen()) {
      point.position = placed(point.position);
      point.normal = turned(point.normal);
      made_.seen.push_back(point);
    }
  }
  [[nodiscard]] const Furnished& made() const { return made_; }

 private:
  [[nodiscard]] glm::dvec3 turned(const glm::dvec3& v) const { return {c_ * v.x - s_ * v.y, s_ * v.x + c_ * v.y, v.z}; }
  [[nodiscard]] glm::dvec3 placed(const glm::dvec3& p) const { return place_ + turned(p - glm::dvec3(middle_.x, middle_.y, 0.0)); }
  [[nodiscard]] glm::dvec3 rounded(const glm::dvec3& p) const {
    const double scale = std::pow(10.0, damage_.decimals);
    return damage_.decimals < 0 ? p : glm::dvec3(std::round(p.x * scale), std::round(p.y * scale), std::round(p.z * scale)) / scale;
  }
  void add_room() {
    made_.soup.names = {"room"};
    soup::add_box(made_.soup, glm::dvec3(0.0), glm::dvec3(4.0, 4.0, 3.0), 1, true);
    made_.soup.names.emplace_back("lamp");
    made_.soup.polygon({{1, 1, 2.9}, {1, 2, 2.9}, {2, 2, 2.9}, {2, 1, 2.9}}, 1);
  }
  void add_box(const glm::dvec3& lo, const glm::dvec3& hi) {
    soup::Soup box;
    soup::add_box(box, lo, hi);
    const bool turn = damage_.all || (damage_.per_box && random_() % 2 == 0);
    for (std::size_t f = 0; f < box.count(); f += 2) {
      std::vector<glm::dvec3> a = box.outline(f), b = box.outline(f + 1);
      if (damage_.triangles) {
        add(a, turn);
        add(b, turn);
      } else {
        a.push_back(b[2]);
        add(a, turn);
      }
    }
  }
  void add(std::vector<glm::dvec3> outline, bool turn) {
    for (glm::dvec3& p : outline) { p = rounded(placed(p)); }
    if (turn || (damage_.each && random_() % 2 == 0)) { std::reverse(outline.begin(), outline.end()); }
    made_.soup.polygon(outline);
    if (std::uniform_real_distribution<double>(0.0, 1.0)(random_) >= damage_.doubled) { return; }
    std::reverse(outline.begin(), outline.end());
    made_.soup.polygon(outline);
  }

  std::mt19937& random_;
  const Damage& damage_;
  double c_ = 1.0, s_ = 0.0;
  glm::dvec3 place_{2.0, 2.0, 0.0}, middle_{0.0};
  Furnished made_;
};

// How many of the points have no surface that shows its front to the air, and how many have one that shows its back to it.
struct Sides {
  std::size_t missing = 0, backs = 0;
};
inline Sides sides_of(const std::vector<radiosity::SceneObject>& objects, const std::vector<SeenPoint>& points, double tolerance) {
  std::vector<std::vector<glm::dvec3>> faces;
  for (const radiosity::SceneObject& object : objects) {
    brep::Builder builder;
    object.shape->approximate(1.0, builder);
    for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
      if (builder.sheet(f) == brep::no_sheet) { continue; }
      faces.emplace_back();
      for (const std::uint32_t v : builder.corners(f)) { faces.back().push_back(builder.position(v)); }
      if (object.placement.inside) { std::reverse(faces.back().begin(), faces.back().end()); }
    }
  }
  Sides result;
  for (const SeenPoint& point : points) {
    const raycast::Segment through{point.position - tolerance * point.normal, 2.0 * tolerance * point.normal};
    bool front = false, back = false;
    for (const std::vector<glm::dvec3>& face : faces) {
      const raycast::Plane plane = raycast::plane_of(face);
      if (std::abs(glm::dot(point.position - plane.point, plane.normal)) > tolerance) { continue; }
      const double along = glm::dot(plane.normal, point.normal);
      if (std::abs(along) < 0.9 || raycast::RayFrame(through).winding(face) == 0) { continue; }
      (along > 0.0 ? front : back) = true;
    }
    result.missing += front ? 0 : 1;
    result.backs += back ? 1 : 0;
  }
  return result;
}

}  // namespace furniture
