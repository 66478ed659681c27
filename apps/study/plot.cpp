// SPDX-License-Identifier: MIT
#include "apps/study/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "apps/study/log_axis.hpp"
#include "apps/study/numbers.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

constexpr double mark_radius = 4.2;
constexpr Srgb pale_ink = 0x666666;
constexpr const char* noise_note = "hollow: the error is at most this";

void draw_axes(Drawing& drawing, const PlotFrame& frame, double text_size) {
  const LogAxis cost = LogAxis::between(frame.cost_low, frame.cost_high);
  double widest = 0.0;
  for (const Tick& tick : cost.ticks(0.0)) { widest = std::max(widest, text_width(short_number(tick.value), text_size)); }
  for (const Tick& tick : cost.ticks((widest + 4.0) / frame.width)) {
    const double x = frame.at(tick.value, frame.error_low).x;
    if (tick.labelled) {
      drawing.add(line({x, frame.top}, {x, frame.bottom()}, 0.8, faint));
      drawing.add(Label{
          .at = {x, frame.bottom() + 1.5 * text_size}, .text = short_number(tick.value), .size = text_size, .anchor = Anchor::middle});
    }
    drawing.add(line({x, frame.bottom()}, {x, frame.bottom() - (tick.labelled ? 6.0 : 3.0)}, 1.0));
  }
  for (const Tick& tick : LogAxis::between(frame.error_low, frame.error_high).ticks(1.5 * text_size / frame.height)) {
    const double y = frame.at(frame.cost_low, tick.value).y;
    if (tick.labelled) {
      drawing.add(line({frame.left, y}, {frame.right(), y}, 0.8, faint));
      drawing.add(
          Label{.at = {frame.left - 7.0, y + 0.34 * text_size}, .text = percent(tick.value), .size = text_size, .anchor = Anchor::end});
    }
    drawing.add(line({frame.left, y}, {frame.left + (tick.labelled ? 6.0 : 3.0), y}, 1.0));
  }
  Shape box = rectangle({frame.left, frame.top}, {frame.right(), frame.bottom()}, paper);
  box.filled = false;
  box.stroke_width = 1.0;
  drawing.add(box);
}

void draw_axis_names(Drawing& drawing, const PlotText& text, const glm::dvec2& cost, const glm::dvec2& error) {
  drawing.add(Label{.at = cost, .text = text.cost, .size = 13.0, .anchor = Anchor::middle});
  drawing.add(Label{.at = error, .text = text.error, .size = 13.0, .anchor = Anchor::middle, .upright = false});
}

Shape mark(const CurveStyle& style, const glm::dvec2& at, bool hollow, const std::string& title) {
  return {.points = mark_outline(style.mark, at, mark_radius),
          .closed = true,
          .filled = true,
          .fill = hollow ? paper : style.color,
          .stroke_width = hollow ? 1.6 : 0.8,
          .stroke = hollow ? style.color : paper,
          .title = title};
}

Shape curve_line(const CurveStyle& style, std::vector<glm::dvec2> points) {
  const std::vector<double> dashes = style.dashed ? std::vector{6.0, 4.0} : std::vector<double>{};
  return {.points = std::move(points), .stroke_width = 1.8, .stroke = style.color, .dashes = dashes};
}

Shape noise_line(const glm::dvec2& from, const glm::dvec2& to) { return {.points = {from, to}, .stroke_width = 1.4, .dashes = {1.5, 3.5}}; }

Shape front_line(std::vector<glm::dvec2> points) { return {.points = std::move(points), .stroke_width = 7.0, .opacity = 0.16}; }

// Draws the Pareto front as a staircase: an error reached at some cost is also reachable at any higher cost.
void draw_front(Drawing& drawing, const PlotFrame& frame, const std::vector<Curve>& curves) {
  std::vector<CostPoint> all;
  for (const Curve& curve : curves) { all.insert(all.end(), curve.points.begin(), curve.points.end()); }
  const std::vector<std::size_t> front = pareto_front(all);
  if (front.empty()) { return; }
  std::vector<glm::dvec2> steps{frame.at(all[front[0]].cost, frame.error_high) + glm::dvec2(0.0, 4.0)};
  for (const std::size_t i : front) {
    const glm::dvec2 p = frame.at(all[i].cost, all[i].error);
    steps.emplace_back(p.x, steps.back().y);
    steps.push_back(p);
  }
  steps.emplace_back(frame.right() - 4.0, steps.back().y);
  drawing.add(front_line(std::move(steps)));
}

void draw_curves(Drawing& drawing, const PlotFrame& frame, const std::vector<Curve>& curves, double noise) {
  if (noise > 0.0) {
    const double y = frame.at(frame.cost_low, noise).y;
    drawing.add(noise_line({frame.left, y}, {frame.right(), y}));
  }
  for (const Curve& curve : curves) {
    std::vector<glm::dvec2> points;
    for (const CostPoint& p : curve.points) {
      if (drawable(p)) { points.push_back(frame.at(p.cost, p.error)); }
    }
    if (points.size() > 1) { drawing.add(curve_line(curve.style, std::move(points))); }
  }
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const CostPoint& p = curve.points[i];
      if (!drawable(p)) { continue; }
      drawing.add(mark(curve.style, frame.at(p.cost, p.error), p.limited, i < curve.titles.size() ? curve.titles[i] : ""));
    }
  }
}

std::string slope_text(const Curve& curve) {
  if (const std::optional<PowerLaw> law = fit_power_law(curve.points)) {
    return "slope " + signed_number(law->exponent) + " ± " + fixed(law->deviation, 2);
  }
  return std::any_of(curve.points.begin(), curve.points.end(), drawable) ? "no slope: too few points" : "no result";
}

// Draws the legend from `at` downwards; returns the y of its end.
double draw_legend(Drawing& drawing, glm::dvec2 at, const std::vector<Curve>& curves, double noise) {
  const auto entry = [&](Shape sample, const std::string& name, const std::string& note) {
    drawing.add(std::move(sample));
    drawing.add(Label{.at = at + glm::dvec2(36.0, 4.0), .text = name});
    if (!note.empty()) { drawing.add(Label{.at = at + glm::dvec2(36.0, 18.0), .text = note, .size = 11.0, .color = pale_ink}); }
  };
  const glm::dvec2 across(28.0, 0.0);
  for (const Curve& curve : curves) {
    entry(curve_line(curve.style, {at, at + across}), curve.name, slope_text(curve));
    drawing.add(mark(curve.style, at + 0.5 * across, false, ""));
    at.y += 35.0;
  }
  at.y += 4.0;
  entry(front_line({at, at + across}), "Pareto front", "");
  at.y += 22.0;
  if (noise > 0.0) {
    entry(noise_line(at, at + across), "noise of the reference", noise_note);
    at.y += 35.0;
  }
  return at.y;
}

double legend_width(const std::vector<Curve>& curves) {
  double width = text_width(noise_note, 11.0);
  for (const Curve& curve : curves) { width = std::max({width, text_width(curve.name, 12.0), text_width(slope_text(curve), 11.0)}); }
  return 36.0 + width + 10.0;
}

}  // namespace

PlotFrame::PlotFrame(const std::vector<Curve>& curves, double noise) {
  constexpr double big = std::numeric_limits<double>::max();
  double low_cost = big, high_cost = 0.0, low_error = noise > 0.0 ? noise : big, high_error = noise;
  for (const Curve& curve : curves) {
    for (const CostPoint& p : curve.points) {
      if (!drawable(p)) { continue; }
      low_cost = std::min(low_cost, p.cost), high_cost = std::max(high_cost, p.cost);
      low_error = std::min(low_error, p.error), high_error = std::max(high_error, p.error);
    }
  }
  if (low_cost > high_cost) { low_cost = high_cost = 1.0; }
  if (low_error > high_error) { low_error = high_error = 0.01; }
  const LogAxis cost(low_cost, high_cost);
  const LogAxis error(low_error, high_error);
  cost_low = cost.low(), cost_high = cost.high();
  error_low = error.low(), error_high = error.high();
}

glm::dvec2 PlotFrame::at(double cost, double error) const {
  return {left + LogAxis::between(cost_low, cost_high).place(cost) * width,
          bottom() - LogAxis::between(error_low, error_high).place(error) * height};
}

Drawing plot(const PlotText& text, const std::vector<Curve>& curves, double noise) {
  Drawing drawing;
  const PlotFrame frame(curves, noise);
  drawing.add(Label{.at = {frame.left, frame.top - 12.0}, .text = text.title, .size = 14.0, .bold = true});
  draw_axes(drawing, frame, 12.0);
  draw_axis_names(drawing, text, {frame.left + 0.5 * frame.width, frame.bottom() + 40.0}, {14.0, frame.top + 0.5 * frame.height});
  draw_front(drawing, frame, curves);
  draw_curves(drawing, frame, curves, noise);
  const double end = draw_legend(drawing, {frame.right() + 18.0, frame.top + 8.0}, curves, noise);
  drawing.width = frame.right() + 18.0 + legend_width(curves);
  drawing.height = std::max(frame.bottom() + 50.0, end);
  return drawing;
}

Drawing panels(const PlotText& text, const std::vector<Panel>& panels, double noise) {
  constexpr std::size_t columns = 3;
  Drawing drawing;
  std::vector<Curve> all;
  for (const Panel& panel : panels) { all.insert(all.end(), panel.curves.begin(), panel.curves.end()); }
  PlotFrame frame(all, noise);
  frame.left = 64.0, frame.width = 196.0, frame.height = 146.0;
  const double step_x = frame.width + 34.0;  // with room for the last label of one panel beside the first of the next
  const double step_y = frame.height + 48.0;
  const double rows = std::ceil(static_cast<double>(panels.size()) / static_cast<double>(columns));
  drawing.width = frame.left + step_x * columns;
  drawing.add(Label{.at = {frame.left, 22.0}, .text = text.title, .size = 14.0, .bold = true});
  constexpr double first_top = 56.0;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t column = i % columns;
    frame.left = 64.0 + step_x * static_cast<double>(column);
    frame.top = first_top + step_y * static_cast<double>(i / columns);
    Drawing axes;
    draw_axes(axes, frame, 10.0);
    for (auto& item : axes.items) {  // only the first panel of a row labels the error axis
      const auto* label = std::get_if<Label>(&item);
      if (column == 0 || label == nullptr || label->anchor != Anchor::end) { drawing.items.push_back(std::move(item)); }
    }
    const double bold = 1.125 * text_width(panels[i].title, 12.0);
    drawing.add(Label{.at = {frame.left, frame.top - 6.0},
                      .text = panels[i].title,
                      .size = 12.0 * std::min(1.0, (step_x - 6.0) / std::max(bold, 1.0)),
                      .bold = true});
    draw_curves(drawing, frame, panels[i].curves, noise);
  }
  const double bottom = first_top + step_y * rows;
  draw_axis_names(drawing, text, {64.0 + 0.5 * step_x * columns, bottom - 8.0}, {14.0, first_top + 0.5 * (bottom - first_top)});
  double x = 64.0;
  for (std::size_t i = 0; !panels.empty() && i < panels[0].curves.size(); ++i) {
    const Curve& curve = panels[0].curves[i];
    drawing.add(curve_line(curve.style, {{x, bottom + 14.0}, {x + 28.0, bottom + 14.0}}));
    drawing.add(mark(curve.style, {x + 14.0, bottom + 14.0}, false, ""));
    drawing.add(Label{.at = {x + 36.0, bottom + 18.0}, .text = curve.name});
    x += 60.0 + text_width(curve.name, 12.0);
  }
  if (noise > 0.0) {
    drawing.add(noise_line({x, bottom + 14.0}, {x + 28.0, bottom + 14.0}));
    drawing.add(Label{.at = {x + 36.0, bottom + 18.0}, .text = "noise of the reference"});
  }
  drawing.height = bottom + 30.0;
  return drawing;
}

namespace {

// The index of the method among method_names().
std::size_t style_index(const Study& study, const std::string& method) {
  const std::vector<std::string> names = method_names(study);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), method) - names.begin());
}

std::string title(const Method& method, const Run& run, const KnownError& error) {
  return method.name + ", " + run.setting + ": error " + to_text(error) + ", " + figure(run.cpu_seconds) + " s, " + memory_text(run) +
         ", " + count_text(run.links) + " links";
}

std::vector<Curve> method_curves(const Study& study, const SceneStudy& scene, Cost cost) {
  std::vector<Curve> curves;
  for (const Method& method : scene.methods) {
    Curve curve{method.name, curve_style(style_index(study, method.name)), {}, {}};
    for (const Run& run : method.runs) {
      curve.points.push_back(point_of(run, scene.reference, cost));
      curve.titles.push_back(title(method, run, main_error(run, scene.reference)));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::vector<Panel> reconstruction_panels(const SceneStudy& scene) {
  static constexpr CurveStyle styles[] = {
      {0x000000, Mark::circle, false}, {0xe69f00, Mark::square, false}, {0x0072b2, Mark::triangle, false}};
  std::vector<Panel> result;
  for (const Method& method : scene.methods) {
    Panel panel{method.name, {}};
    for (const Stage stage : stages) {
      Curve curve{name(stage), styles[static_cast<std::size_t>(stage)], {}, {}};
      for (const Run& run : method.runs) {
        const KnownError error = credited(run) ? known_error(errors(run, stage).points.l2, scene.reference.point_noise) : KnownError{};
        curve.points.push_back({cost_of(run, Cost::cpu_time), error.value, error.limited});
        curve.titles.push_back(title(method, run, error));
      }
      panel.curves.push_back(std::move(curve));
    }
    result.push_back(std::move(panel));
  }
  return result;
}

}  // namespace

std::vector<Figure> figures(const Study& study, const SceneStudy& scene) {
  const std::string what = "relative L2 error of the cell means";
  const double noise = scene.reference.noise;
  std::vector<Figure> result;
  result.push_back(
      {"cpu", "Error of the cell means, before reconstruction, against CPU time.",
       plot({scene.scene + ": error against CPU time", "CPU time (s)", what}, method_curves(study, scene, Cost::cpu_time), noise)});
  result.push_back(
      {"memory", "The same runs against the peak memory of the process during the run, above what it held before.",
       plot({scene.scene + ": error against memory", "peak memory (bytes)", what}, method_curves(study, scene, Cost::memory), noise)});
  result.push_back(
      {"links", "The same runs against the number of links; of a dense matrix, its entries.",
       plot({scene.scene + ": error against links", "links or matrix entries", what}, method_curves(study, scene, Cost::links), noise)});
  result.push_back(
      {"reconstruction",
       "Error at points against CPU time, before reconstruction and after it: simple (paper, figs. 6–8) and weighted (paper, fig. 5).",
       panels({scene.scene + ": what reconstruction changes", "CPU time (s)", "relative L2 error at points"}, reconstruction_panels(scene),
              scene.reference.point_noise)});
  return result;
}

}  // namespace study
