// SPDX-License-Identifier: MIT
#pragma once

// Work-precision plots: error against cost on logarithmic axes, one curve a method, a mark at every setting.
//
// Points that are limited by the reference's noise are hollow and stand on the line of that noise: the error is at most that. The Pareto
// front of all methods lies as a grey staircase behind the curves: no run is left of it or below. The legend gives each method's
// fitted slope (cost_points.hpp).

#include <string>
#include <vector>

#include "apps/study/cost_points.hpp"
#include "apps/study/curve_style.hpp"
#include "apps/study/drawing.hpp"
#include "apps/study/results.hpp"

namespace study {

struct Curve {
  std::string name;
  CurveStyle style;
  std::vector<CostPoint> points;    // in the order of the settings
  std::vector<std::string> titles;  // one a point: what a browser shows
};

struct PlotText {
  std::string title;
  std::string cost;   // what stands at the axes
  std::string error;  // a fraction; ticks are in per cent
};

// The field between the axes, and where values fall in it.
class PlotFrame {
 public:
  // The axes hold all points and the noise.
  PlotFrame(const std::vector<Curve>& curves, double noise);

  [[nodiscard]] glm::dvec2 at(double cost, double error) const;
  [[nodiscard]] double right() const { return left + width; }
  [[nodiscard]] double bottom() const { return top + height; }

  double left = 78.0, top = 34.0, width = 430.0, height = 300.0;
  double cost_low = 0.1, cost_high = 10.0, error_low = 0.001, error_high = 0.1;  // at the ends of the axes
};

// `noise` is 0 without one. Curves without any point that can be drawn stand in the legend as such.
[[nodiscard]] Drawing plot(const PlotText& text, const std::vector<Curve>& curves, double noise);

struct Panel {
  std::string title;
  std::vector<Curve> curves;
};

// One small plot a panel on the same axes, three in a row; the legend below names the curves of the first panel.
[[nodiscard]] Drawing panels(const PlotText& text, const std::vector<Panel>& panels, double noise);

// The plots of a study: which curves, of which errors, against which cost.
struct Figure {
  std::string name;     // for the file
  std::string caption;  // one or two sentences
  Drawing drawing;
};

// Error against CPU time, memory and links, and what the reconstructions change. A method has the same colour and mark in all scenes.
[[nodiscard]] std::vector<Figure> figures(const Study& study, const SceneStudy& scene);

}  // namespace study
