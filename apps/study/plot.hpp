// SPDX-License-Identifier: MIT
#pragma once

// Work-precision plots: error against cost on logarithmic axes, one curve per method, a mark at every setting.
//
// Points limited by the reference's noise are hollow and lie on the line of that noise: the error is at most that. The Pareto front of
// all methods is a grey staircase behind the curves: no run lies to the left of it or below it. The legend gives each method's fitted
// slope (verdicts.hpp).

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "apps/study/drawing.hpp"
#include "apps/study/results.hpp"
#include "apps/study/verdicts.hpp"

namespace study {

// Curves are distinguished by colour (Okabe and Ito 2008, designed for colour-blind readers; their yellow is left out, because it is too
// pale for lines on paper) and by the shape of the marks, in case the page is printed in grey. After seven curves the lines are dashed.
enum class Mark { circle, square, triangle, diamond, triangle_down, pentagon, cross, star, saltire };

struct CurveStyle {
  Srgb color = ink;
  Mark mark = Mark::circle;
  bool dashed = false;
};

inline constexpr std::array<Srgb, 7> curve_colors = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x000000};
inline constexpr std::size_t mark_count = 9;

// Any two of the first 63 styles differ in colour or mark; the first seven differ in both.
[[nodiscard]] inline CurveStyle curve_style(std::size_t index) {
  return {curve_colors[index % curve_colors.size()], static_cast<Mark>(index % mark_count),
          index % (2 * curve_colors.size()) >= curve_colors.size()};
}

// The outline of a mark. All marks have approximately the area of a circle of this radius.
[[nodiscard]] inline std::vector<glm::dvec2> mark_outline(Mark mark, const glm::dvec2& at, double radius) {
  constexpr double pi = std::numbers::pi;
  std::vector<glm::dvec2> points;
  const auto add = [&](double angle, double r) { points.push_back(at + radius * r * glm::dvec2(std::sin(angle), -std::cos(angle))); };
  if (mark == Mark::cross || mark == Mark::saltire) {  // four arms as wide as long, upright or rotated
    constexpr double arm = 1.32, half = 0.44;
    const double corner = std::hypot(arm, half), skew = std::atan2(half, arm);
    for (int i = 0; i < 4; ++i) {
      const double a = (mark == Mark::saltire ? pi / 4.0 : 0.0) + 0.5 * pi * i;
      add(a - skew, corner);
      add(a + skew, corner);
      add(a + pi / 4.0, half * std::numbers::sqrt2);
    }
    return points;
  }
  struct Ring {  // a star or polygon: every second corner is at the inner radius
    int corners = 0;
    double turn = 0.0, outer = 1.0, inner = 1.0;
  };
  constexpr std::array<Ring, mark_count> rings{{{20, 0.0, 1.0, 1.0},
                                                {4, pi / 4.0, 1.25, 1.25},
                                                {3, 0.0, 1.45, 1.45},
                                                {4, 0.0, 1.35, 1.35},
                                                {3, pi, 1.45, 1.45},
                                                {5, 0.0, 1.18, 1.18},
                                                {},
                                                {10, 0.0, 1.65, 0.66},
                                                {}}};
  const Ring& ring = rings[static_cast<std::size_t>(mark)];
  for (int i = 0; i < ring.corners; ++i) { add(ring.turn + 2.0 * pi * i / ring.corners, i % 2 == 0 ? ring.outer : ring.inner); }
  return points;
}

struct Curve {
  std::string name;
  CurveStyle style;
  std::vector<CostPoint> points;    // in the order of the settings
  std::vector<std::string> titles;  // one per point: tooltip in a browser
};

struct PlotText {
  std::string title;
  std::string cost;   // labels of the axes
  std::string error;  // the error is a fraction; its ticks are in per cent
};

// The area between the axes, and the positions of values in it.
class PlotFrame {
 public:
  // The axes include all points and the noise.
  PlotFrame(const std::vector<Curve>& curves, double noise);

  [[nodiscard]] glm::dvec2 at(double cost, double error) const;
  [[nodiscard]] double right() const { return left + width; }
  [[nodiscard]] double bottom() const { return top + height; }

  double left = 78.0, top = 34.0, width = 430.0, height = 300.0;
  double cost_low = 0.1, cost_high = 10.0, error_low = 0.001, error_high = 0.1;  // values at the ends of the axes
};

// `noise` is 0 if there is none. Curves without any drawable point are marked as such in the legend.
[[nodiscard]] Drawing plot(const PlotText& text, const std::vector<Curve>& curves, double noise);

struct Panel {
  std::string title;
  std::vector<Curve> curves;
};

// One small plot per panel, all with the same axes, three in a row; the legend below names the curves of the first panel.
[[nodiscard]] Drawing panels(const PlotText& text, const std::vector<Panel>& panels, double noise);

// A plot of a study.
struct Figure {
  std::string name;     // for the name of its file
  std::string caption;  // one or two sentences
  Drawing drawing;
};

// Error against CPU time, memory and links, and the effect of the reconstructions. A method has the same colour and mark in all scenes.
[[nodiscard]] std::vector<Figure> figures(const Study& study, const SceneStudy& scene);

}  // namespace study
