// SPDX-License-Identifier: MIT
#pragma once

// How curves are told apart: by colour (Okabe and Ito 2008, made for colour-blind readers; their yellow is too pale for lines on paper
// and left out), and by the shape of the marks where a page is printed grey. After seven curves the lines are dashed.

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "apps/study/drawing.hpp"

namespace study {

enum class Mark { circle, square, triangle, diamond, triangle_down, pentagon, cross, star, saltire };

struct CurveStyle {
  Tone tone = ink;
  Mark mark = Mark::circle;
  bool dashed = false;
};

inline constexpr std::array<Tone, 7> curve_tones = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x000000};
inline constexpr std::size_t mark_count = 9;

// Any two of the first 63 styles differ in colour or mark, the first seven in both.
[[nodiscard]] inline CurveStyle curve_style(std::size_t index) {
  return {curve_tones[index % curve_tones.size()], static_cast<Mark>(index % mark_count),
          index % (2 * curve_tones.size()) >= curve_tones.size()};
}

// The outline of a mark. All marks have about the area of a circle of this radius.
[[nodiscard]] inline std::vector<glm::dvec2> mark_outline(Mark mark, const glm::dvec2& at, double radius) {
  std::vector<glm::dvec2> points;
  const auto ring = [&](int corners, double turn, double outer, double inner) {
    for (int i = 0; i < corners; ++i) {
      const double angle = turn + 2.0 * std::numbers::pi * i / corners;
      const double r = radius * (i % 2 == 0 ? outer : inner);
      points.push_back(at + r * glm::dvec2(std::sin(angle), -std::cos(angle)));
    }
  };
  // A plus of arms as wide as they are long.
  const auto plus = [&](double turn) {
    constexpr double arm = 1.32;
    constexpr double half = 0.44;
    const double corner = std::hypot(arm, half);
    const double skew = std::atan2(half, arm);
    for (int i = 0; i < 4; ++i) {
      const double a = turn + 0.5 * std::numbers::pi * i;
      for (const auto& [angle, r] :
           {std::pair{a - skew, corner}, std::pair{a + skew, corner}, std::pair{a + std::numbers::pi / 4.0, half * std::numbers::sqrt2}}) {
        points.push_back(at + radius * r * glm::dvec2(std::sin(angle), -std::cos(angle)));
      }
    }
  };
  constexpr double pi = std::numbers::pi;
  switch (mark) {
    case Mark::circle:
      ring(20, 0.0, 1.0, 1.0);
      break;
    case Mark::square:
      ring(4, pi / 4.0, 1.25, 1.25);
      break;
    case Mark::triangle:
      ring(3, 0.0, 1.45, 1.45);
      break;
    case Mark::diamond:
      ring(4, 0.0, 1.35, 1.35);
      break;
    case Mark::triangle_down:
      ring(3, pi, 1.45, 1.45);
      break;
    case Mark::pentagon:
      ring(5, 0.0, 1.18, 1.18);
      break;
    case Mark::cross:
      plus(0.0);
      break;
    case Mark::star:
      ring(10, 0.0, 1.65, 0.66);
      break;
    case Mark::saltire:
      plus(pi / 4.0);
      break;
  }
  return points;
}

}  // namespace study
