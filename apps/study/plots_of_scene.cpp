// SPDX-License-Identifier: MIT

#include <algorithm>
#include <utility>

#include "apps/study/plot.hpp"
#include "apps/study/verdicts.hpp"

namespace study {
namespace {

// By the order in which the study names its methods first.
std::size_t style_index(const Study& study, const std::string& method) {
  std::vector<std::string> names;
  for (const SceneStudy& scene : study.scenes) {
    for (const Method& m : scene.methods) {
      if (std::find(names.begin(), names.end(), m.name) == names.end()) { names.push_back(m.name); }
    }
  }
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
