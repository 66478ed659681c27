// SPDX-License-Identifier: MIT
#include "apps/study/folder.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "apps/study/verdicts.hpp"

namespace study {
namespace {

// Calls use(method, run, is it the first of its method?, is it on the Pareto front of CPU time?).
template <class Use>
void each_run(const SceneStudy& scene, const Use& use) {
  const std::set<const Run*> front = on_front(scene);
  for (const Method& method : scene.methods) {
    for (const Run& run : method.runs) { use(method, run, &run == &method.runs[0], front.contains(&run)); }
  }
}

std::string seconds(double x) { return figure(x); }

TableRow first_cells(const Method& method, const Run& run, bool begins, bool strong) {
  TableRow row{{begins ? method.name : "", run.setting + (run.cut_off.empty() ? "" : " †")}, strong, begins, ""};
  if (!run.refused.empty()) { row.remark = "no result: " + run.refused; }
  return row;
}

}  // namespace

Table summary_table(const SceneStudy& scene) {
  const std::vector<double> goals = targets(scene);
  Table table;
  table.head = {"method"};
  for (const double goal : goals) {
    for (const char* what : {"s to ", "memory to ", "links to "}) {
      if (what[0] == 's' || goal == goals.back()) { table.head.push_back(what + percent(goal)); }
    }
  }
  table.head.insert(table.head.end(), {"least error", "worst cell", "in s", "slope"});
  for (const Method& method : scene.methods) {
    TableRow row{{method.name}, false, false, ""};
    for (const double goal : goals) {
      const Run* run = cheapest_within(method, scene.reference, goal);
      row.cells.push_back(run != nullptr ? seconds(run->cpu_seconds) : "–");
      if (goal != goals.back()) { continue; }
      row.cells.push_back(run != nullptr ? memory_text(*run) : "–");
      row.cells.push_back(run != nullptr ? count_text(run->links) : "–");
    }
    const Run* best = most_accurate(method, scene.reference);
    row.cells.push_back(best != nullptr ? to_text(main_error(*best, scene.reference)) : "–");
    row.cells.push_back(best != nullptr ? to_text(known_error(best->leaves_error.cells.worst, scene.reference.noise)) : "–");
    row.cells.push_back(best != nullptr ? seconds(best->cpu_seconds) : "–");
    const auto law = fit_power_law(points_of(method, scene.reference, Cost::cpu_time));
    row.cells.push_back(law ? signed_number(law->exponent) : "–");
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table run_table(const SceneStudy& scene) {
  Table table{{"method", "setting", "CPU s", "s saved", "memory", "links", "leaves", "rays", "before", "simple", "weighted",
               "before, points", "simple, points", "weighted, points"},
              2,
              {}};
  each_run(scene, [&](const Method& method, const Run& run, bool begins, bool strong) {
    TableRow row = first_cells(method, run, begins, strong);
    if (row.remark.empty()) {
      for (std::string cell : {seconds(run.cpu_seconds), seconds(run.seconds_saved), memory_text(run), count_text(run.links),
                               count_text(run.leaves), count_text(run.rays)}) {
        row.cells.push_back(std::move(cell));
      }
      for (const Stage stage : stages) { row.cells.push_back(to_number(known_error(errors(run, stage).cells.l2, scene.reference.noise))); }
      for (const Stage stage : stages) {
        row.cells.push_back(to_number(known_error(errors(run, stage).points.l2, scene.reference.point_noise)));
      }
    }
    table.rows.push_back(std::move(row));
  });
  return table;
}

Table norm_table(const SceneStudy& scene) {
  Table table{{"method", "setting"}, 2, {}};
  for (const char* norm : {"L1, ", "worst, "}) {
    for (const char* where : {"cells: ", "points: "}) {
      for (const char* stage : {"before", "simple", "weighted"}) { table.head.push_back(std::string(norm) + where + stage); }
    }
  }
  each_run(scene, [&](const Method& method, const Run& run, bool begins, bool strong) {
    TableRow row = first_cells(method, run, begins, strong);
    for (const auto norm : {&Norms::l1, &Norms::worst}) {
      for (const auto& [where, noise] :
           {std::pair{&Errors::cells, scene.reference.noise}, std::pair{&Errors::points, scene.reference.point_noise}}) {
        for (const Stage stage : stages) {
          if (row.remark.empty()) { row.cells.push_back(to_number(known_error(errors(run, stage).*where.*norm, noise))); }
        }
      }
    }
    table.rows.push_back(std::move(row));
  });
  return table;
}

Table part_table(const SceneStudy& scene) {
  Table table{{"method", "setting", "discretisation", "links and visibility", "solver residual", "reconstruction"}, 2, {}};
  const Method* last = nullptr;
  each_run(scene, [&](const Method& method, const Run& run, bool, bool strong) {
    if (!run.parts || !run.refused.empty()) { return; }
    TableRow row = first_cells(method, run, &method != last, strong);
    last = &method;
    row.cells.push_back(to_number(known_error(run.parts->discretisation, scene.reference.point_noise)));
    for (const double part : {run.parts->links, run.parts->solver, run.parts->reconstruction}) {
      row.cells.push_back(figure(100.0 * part));
    }
    table.rows.push_back(std::move(row));
  });
  return table;
}

std::vector<std::string> findings(const SceneStudy& scene) {
  std::vector<std::string> result;
  for (const double target : targets(scene)) {
    std::vector<std::pair<double, const Method*>> reached;
    for (const Method& method : scene.methods) {
      if (const Run* run = cheapest_within(method, scene.reference, target)) { reached.emplace_back(run->cpu_seconds, &method); }
    }
    std::stable_sort(reached.begin(), reached.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string text =
        "Within " + percent(target) + ": " + reached[0].second->name + " needs least time, " + seconds(reached[0].first) + " s";
    if (reached.size() > 1) { text += ", then " + reached[1].second->name + ", " + seconds(reached[1].first) + " s"; }
    if (reached.size() < scene.methods.size()) {
      text += "; " + std::to_string(reached.size()) + " of " + std::to_string(scene.methods.size()) + " methods get there";
    }
    result.push_back(text + ".");
  }
  const Method* best = nullptr;
  const Run* least = nullptr;
  for (const Method& method : scene.methods) {
    const Run* run = most_accurate(method, scene.reference);
    if (run == nullptr) { continue; }
    const double error = main_error(*run, scene.reference).value;
    const double so_far = least == nullptr ? 0.0 : main_error(*least, scene.reference).value;
    if (least != nullptr && (error > so_far || (error == so_far && run->cpu_seconds >= least->cpu_seconds))) { continue; }
    best = &method;
    least = run;
  }
  if (best != nullptr) {
    result.push_back("Least error: " + best->name + ", " + to_text(main_error(*least, scene.reference)) + " in " +
                     seconds(least->cpu_seconds) + " s.");
  }
  return result;
}

std::string reference_text(const Reference& reference) {
  const auto part = [](std::uint64_t count, const char* what, double noise) {
    return count_text(count) + what + (noise > 0.0 ? " (noise " + percent(noise) + ")" : "");
  };
  return reference.kind + ", " + part(reference.cells, " cell means", reference.noise) + " and " +
         part(reference.points, " points", reference.point_noise) +
         (reference.paths > 0 ? ", " + count_text(reference.paths) + " paths" : "") +
         (reference.cached ? ", kept from an earlier run" : "") + ".";
}

}  // namespace study
