// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/study/folder.hpp"
#include "apps/study/verdicts.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

constexpr std::string_view csv_head =
    "scene,reference,noise,point_noise,method,setting,reconstruction,cpu_seconds,seconds_saved,peak_bytes,bytes,links,leaves,rays,"
    "cells_l1,cells_l2,cells_worst,points_l1,points_l2,points_worst,below_noise,"
    "part_discretisation,part_links,part_solver,part_reconstruction,picture_l2,picture_low,picture_high,cut_off,refused\n";

constexpr auto csv_columns = static_cast<std::size_t>(1 + std::count(csv_head.begin(), csv_head.end(), ','));

// Empty: not measured.
std::string text_of(double x) { return std::isfinite(x) ? apps::shortest(x) : std::string(); }

class Line {
 public:
  void field(std::string_view text) {
    text_ += (count_ == 0 ? "" : ",") + csv_field(text);
    ++count_;
  }
  void fields(const auto&... texts) { (field(texts), ...); }
  void empty(std::size_t count) {
    for (; count > 0; --count) { field(""); }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::string end() const { return text_ + "\n"; }

 private:
  std::string text_;
  std::size_t count_ = 0;
};

void add_errors(Line& line, const Errors& errors, const Reference& reference) {
  std::string limited;
  const auto add = [&](double measured, double noise, const char* column) {
    const KnownError error = known_error(measured, noise);
    line.field(text_of(error.value));
    if (error.limited) { limited += (limited.empty() ? "" : " ") + std::string(column); }
  };
  add(errors.cells.l1, reference.noise, "cells_l1");
  add(errors.cells.l2, reference.noise, "cells_l2");
  add(errors.cells.worst, reference.noise, "cells_worst");
  add(errors.points.l1, reference.point_noise, "points_l1");
  add(errors.points.l2, reference.point_noise, "points_l2");
  add(errors.points.worst, reference.point_noise, "points_worst");
  line.field(limited);
}

std::string run_line(const SceneStudy& scene, const Method& method, const Run& run, Stage stage) {
  static constexpr std::array<const char*, 3> names = {"none", "simple", "weighted"};
  Line line;
  line.fields(scene.scene, scene.reference.kind, text_of(scene.reference.noise), text_of(scene.reference.point_noise), method.name,
              run.setting, names[static_cast<std::size_t>(stage)]);
  if (!run.refused.empty()) {
    line.empty(csv_columns - 1 - line.count());  // the reason stands in the last column
    line.field(run.refused);
    return line.end();
  }
  line.fields(text_of(run.cpu_seconds), text_of(run.seconds_saved));
  for (const std::uint64_t n : {run.peak_bytes, run.bytes, run.links, run.leaves, run.rays}) { line.field(std::to_string(n)); }
  add_errors(line, errors(run, stage), scene.reference);
  if (run.parts) {
    const ErrorParts& parts = *run.parts;
    line.fields(text_of(parts.discretisation), text_of(parts.links), text_of(parts.solver), text_of(parts.reconstruction));
  } else {
    line.empty(4);
  }
  if (run.picture_error && stage == Stage::weighted) {
    line.fields(text_of(run.picture_error->relative_l2), text_of(run.picture_error->low), text_of(run.picture_error->high));
  } else {
    line.empty(3);
  }
  line.fields(run.cut_off, "");
  return line.end();
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) { return std::string(text); }
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') { quoted += '"'; }
    quoted += c;
  }
  return quoted + "\"";
}

std::string to_csv(const Study& study) {
  std::string text(csv_head);
  for (const SceneStudy& scene : study.scenes) {
    for (const Method& method : scene.methods) {
      for (const Run& run : method.runs) {
        for (const Stage stage : stages) { text += run_line(scene, method, run, stage); }
      }
    }
  }
  return text;
}

}  // namespace study
