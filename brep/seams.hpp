// SPDX-License-Identifier: MIT
#pragma once

// A face with holes as one polygon, as a BRep without rings has it (paper 2.1: a hole is reached by a bridge edge): from the outline a seam
// runs to each hole, around it and back. The seam is the shortest one that crosses nothing.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/polygon.hpp>

namespace brep {

namespace detail {

class Seams {
 public:
  using Loop = std::vector<glm::dvec3>;

  Seams(Loop outline, std::vector<Loop> holes) : outline_(std::move(outline)), holes_(std::move(holes)) {
    const glm::dvec3 n = brep::vector_area(outline_), size = glm::abs(n);
    const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    u_ = (drop + 1) % 3, v_ = (drop + 2) % 3;
    if (n[drop] < 0.0) { std::swap(u_, v_); }
  }

  [[nodiscard]] Loop join() {
    while (!holes_.empty()) { join(next_seam()); }
    return std::move(outline_);
  }

 private:
  struct Seam {
    double length;
    std::size_t corner, hole, of_hole;
  };

  [[nodiscard]] glm::dvec2 flat(const glm::dvec3& p) const { return {p[u_], p[v_]}; }
  // 1 when c lies left of a -> b, -1 when it lies right.
  [[nodiscard]] int side(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const {
    const glm::dvec2 ab = flat(b) - flat(a), ac = flat(c) - flat(a);
    const double area = ab.x * ac.y - ab.y * ac.x;
    return area > 0.0 ? 1 : area < 0.0 ? -1 : 0;
  }

  // The shortest seam to any of the holes that crosses nothing; when each of the shortest ones does, the shortest.
  [[nodiscard]] Seam next_seam() const {
    std::vector<Seam> seams;
    for (std::size_t h = 0; h < holes_.size(); ++h) {
      for (std::size_t k = 0; k < holes_[h].size(); ++k) {
        for (std::size_t i = 0; i < outline_.size(); ++i) { seams.push_back({glm::distance(outline_[i], holes_[h][k]), i, h, k}); }
      }
    }
    const auto few = seams.begin() + std::min<std::ptrdiff_t>(64, std::ssize(seams));
    std::partial_sort(seams.begin(), few, seams.end(), [](const Seam& a, const Seam& b) { return a.length < b.length; });
    const auto clear = std::find_if(seams.begin(), few, [&](const Seam& seam) { return is_clear(seam); });
    return clear == few ? seams.front() : *clear;
  }
  [[nodiscard]] bool is_clear(const Seam& seam) const {
    const glm::dvec3 &from = outline_[seam.corner], &to = holes_[seam.hole][seam.of_hole];
    return leads_inside(outline_, seam.corner, to) && leads_inside(holes_[seam.hole], seam.of_hole, from) && !crosses(outline_, from, to) &&
           std::none_of(holes_.begin(), holes_.end(), [&](const Loop& hole) { return crosses(hole, from, to); });
  }
  // O'Rourke, Computational Geometry in C, 1998, 1.5.
  [[nodiscard]] bool leads_inside(const Loop& loop, std::size_t i, const glm::dvec3& to) const {
    const glm::dvec3 &at = loop[i], &next = loop[(i + 1) % loop.size()], &before = loop[(i + loop.size() - 1) % loop.size()];
    if (side(at, next, before) >= 0) { return side(at, to, before) > 0 && side(to, at, next) > 0; }
    return !(side(at, to, next) >= 0 && side(to, at, before) >= 0);
  }
  // Touching counts; edges that begin where the segment ends do not.
  [[nodiscard]] bool crosses(const Loop& loop, const glm::dvec3& from, const glm::dvec3& to) const {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if (a == from || a == to || b == from || b == to) { continue; }
      if (side(from, to, a) * side(from, to, b) <= 0 && side(a, b, from) * side(a, b, to) <= 0) { return true; }
    }
    return false;
  }

  void join(const Seam& seam) {
    Loop loop = std::move(holes_[seam.hole]);
    holes_.erase(holes_.begin() + static_cast<std::ptrdiff_t>(seam.hole));
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(seam.of_hole), loop.end());
    loop.push_back(loop.front());
    loop.push_back(outline_[seam.corner]);
    outline_.insert(outline_.begin() + static_cast<std::ptrdiff_t>(seam.corner) + 1, loop.begin(), loop.end());
  }

  Loop outline_;
  std::vector<Loop> holes_;
  int u_ = 0, v_ = 1;
};

}  // namespace detail

// The loops lie in one plane, and the inside of the face lies to the left of all: the holes run the other way round than the outline. Cost:
// pairs of corners of different loops, for each hole.
[[nodiscard]] inline std::vector<glm::dvec3> join_holes(std::vector<glm::dvec3> outline, std::vector<std::vector<glm::dvec3>> holes) {
  return detail::Seams(std::move(outline), std::move(holes)).join();
}

}  // namespace brep
