// SPDX-License-Identifier: MIT
#pragma once

// Random trees of box, sphere, cylinder, frustum, cone and torus, with an oracle that shares no code with them: is a point inside?
// Positions, axes and radii are drawn from the reals, or rounded to steps of 1/8 so that solids touch, coincide and share axes.

#include "support.hpp"

#include <raycast/objects/cone.hpp>
#include <raycast/objects/csg.hpp>
#include <raycast/objects/torus.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace test {

struct RandomSolid {
  raycast::CsgNode node;
  std::function<bool(const dvec3&)> inside;
  std::string text;  // as in a scene file
};

class RandomSolids {
 public:
  enum Kind { box, sphere, cylinder, cone, torus, kinds };

  // `step`: numbers are multiples of it; 0: any.
  RandomSolids(Random& random, double step) : random_(random), step_(step) {}

  // About a cube of edge 2 from the origin; `smallest`: of radii and edges.
  RandomSolid leaf(Kind kind, double smallest, double largest) {
    using namespace raycast;
    RandomSolid result;
    const dvec3 at = point();
    const std::string name = " p" + std::to_string(++count_) + " ";
    if (kind == box) {
      dvec3 size(0.0);
      for (int k = 0; k < 3; ++k) { size[k] = round(random_.uniform(smallest, 2 * largest)); }
      const glm::dmat3 turn = step_ > 0.0 || random_.below(3) == 0 ? glm::dmat3(1.0) : random_.rotation();
      result.node.solid = BoxObject::make(-0.5 * size, 0.5 * size).object;
      result.node.placement = {turn, at, false};
      result.inside = [=](const dvec3& p) {
        const dvec3 q = glm::abs(glm::transpose(turn) * (p - at));
        return q.x < 0.5 * size.x && q.y < 0.5 * size.y && q.z < 0.5 * size.z;
      };
      result.text = "box" + name + "size" + show(size) + " at" + show(at) + (turn == glm::dmat3(1.0) ? "" : " (turned)");
    } else if (kind == sphere) {
      const double r = round(random_.uniform(smallest, largest));
      result.node.solid = Sphere::make(at, r).object;
      result.inside = [=](const dvec3& p) { return glm::length(p - at) < r; };
      result.text = "sphere" + name + "center" + show(at) + " radius " + std::to_string(r);
    } else if (kind == torus) {
      const double major = round(random_.uniform(smallest, largest)), minor = major * random_.uniform(0.2, 0.8);
      const dvec3 w = axis();
      result.node.solid = Torus::make(at, w, major, minor).object;
      result.inside = [=](const dvec3& p) {
        const double z = glm::dot(p - at, w);
        return std::hypot(glm::length(p - at - z * w) - major, z) < minor;
      };
      result.text =
          "torus" + name + "center" + show(at) + " axis" + show(w) + " radius " + std::to_string(major) + " tube " + std::to_string(minor);
    } else {
      const double height = round(random_.uniform(smallest, 3 * largest)), r = round(random_.uniform(smallest, largest));
      const double top = kind == cylinder ? r : random_.below(2) == 0 ? 0.0 : r * random_.uniform(0.1, 0.9);
      const dvec3 w = axis();
      if (kind == cylinder) {
        result.node.solid = Cylinder::make(at, height * w, r).object;
      } else {
        result.node.solid = Cone::make(at, height * w, r, top).object;
      }
      result.inside = [=](const dvec3& p) {
        const double z = glm::dot(p - at, w);
        return z > 0.0 && z < height && glm::length(p - at - z * w) < r + (top - r) * z / height;
      };
      result.text = (kind == cylinder ? "cylinder" : "cone") + name + "base" + show(at) + " axis" + show(height * w) + " radius " +
                    std::to_string(r) + (kind == cylinder ? "" : " top " + std::to_string(top));
    }
    return result;
  }
  RandomSolid any_leaf(double smallest, double largest) { return leaf(static_cast<Kind>(random_.below(kinds)), smallest, largest); }

  static RandomSolid combine(raycast::CsgOperation operation, std::vector<RandomSolid> parts) {
    RandomSolid result;
    result.node.operation = operation;
    const char* names[] = {"union", "intersection", "difference"};
    result.text = std::string(names[static_cast<int>(operation)]) + " {";
    std::vector<std::function<bool(const dvec3&)>> inside;
    for (RandomSolid& part : parts) {
      result.text += " " + part.text;
      inside.push_back(std::move(part.inside));
      result.node.parts.push_back(std::move(part.node));
    }
    result.text += " }";
    result.inside = [operation, inside](const dvec3& p) {
      const auto in = [&](const auto& f) { return f(p); };
      if (operation == raycast::CsgOperation::unite) { return std::any_of(inside.begin(), inside.end(), in); }
      if (operation == raycast::CsgOperation::intersect) { return std::all_of(inside.begin(), inside.end(), in); }
      return in(inside[0]) && std::none_of(inside.begin() + 1, inside.end(), in);
    };
    return result;
  }

  // Of 2 to `most` leaves, parted at random.
  RandomSolid tree(std::uint32_t leaves, double smallest, double largest) {
    if (leaves == 1) { return any_leaf(smallest, largest); }
    std::vector<RandomSolid> parts;
    std::uint32_t left = leaves;
    while (left > 0) {
      const std::uint32_t n = 1 + random_.below(std::min(left, leaves - 1));
      parts.push_back(tree(n, smallest, largest));
      left -= n;
    }
    return combine(static_cast<raycast::CsgOperation>(random_.below(3)), std::move(parts));
  }

 private:
  [[nodiscard]] double round(double x) const { return step_ > 0.0 ? std::max(step_, std::round(x / step_) * step_) : x; }
  dvec3 point() {
    dvec3 p(0.0);
    for (int k = 0; k < 3; ++k) { p[k] = random_.uniform(0.0, 2.0); }
    return step_ > 0.0 ? glm::round(p / step_) * step_ : p;
  }
  dvec3 axis() {
    if (step_ == 0.0) { return random_.direction(); }
    dvec3 w(0.0);
    w[static_cast<int>(random_.below(3))] = random_.below(2) == 0 ? 1.0 : -1.0;
    return w;
  }
  static std::string show(const dvec3& p) { return " " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z); }

  Random& random_;
  double step_;
  int count_ = 0;
};

}  // namespace test
