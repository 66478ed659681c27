// SPDX-License-Identifier: MIT
#include "apps/study/folder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include <radiosity/support/left_out.hpp>

#include "apps/files.hpp"
#include "apps/json.hpp"
#include "apps/study/error_picture.hpp"
#include "apps/study/plot.hpp"
#include "apps/study/verdicts.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

// --- results.csv

constexpr std::string_view csv_head =
    "scene,reference,noise,point_noise,method,setting,reconstruction,cpu_seconds,seconds_saved,peak_bytes,bytes,links,leaves,rays,"
    "cells_l1,cells_l2,cells_worst,points_l1,points_l2,points_worst,below_noise,"
    "part_discretisation,part_links,part_solver,part_reconstruction,picture_l2,picture_low,picture_high,cut_off,refused\n";

constexpr auto csv_columns = static_cast<std::size_t>(1 + std::count(csv_head.begin(), csv_head.end(), ','));

// Empty if not measured.
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
    line.empty(csv_columns - 1 - line.count());  // the reason is in the last column
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

// --- results.json

using apps::JsonWriter;

// A norm below the noise of the reference is replaced by that noise, and its name is listed.
auto written(const Norms& norms, double noise) {
  return [norms, noise](JsonWriter& json) {
    const std::pair<const char*, double> values[] = {{"l1", norms.l1}, {"l2", norms.l2}, {"worst", norms.worst}};
    std::vector<std::string> below;
    json.open_object();
    for (const auto& [norm, value] : values) {
      const KnownError error = known_error(value, noise);
      json.fields(norm, error.value);
      if (error.limited) { below.emplace_back(norm); }
    }
    json.fields("below_noise", below).close();
  };
}

auto written(const Errors& errors, const Reference& reference) {
  return [&](JsonWriter& json) {
    json.object("cells", written(errors.cells, reference.noise), "points", written(errors.points, reference.point_noise));
  };
}

void write(JsonWriter& json, const Run& run, const Reference& reference, bool pareto) {
  if (!run.refused.empty()) {
    json.object("setting", run.setting, "refused", run.refused);
    return;
  }
  const auto errors = [&](JsonWriter& inner) {
    inner.object("leaves", written(run.leaves_error, reference), "simple", written(run.simple_error, reference), "weighted",
                 written(run.weighted_error, reference));
  };
  const auto picture = [&](JsonWriter& inner) {
    const auto& error = run.picture_error;
    error ? inner.object("relative_l2", error->relative_l2, "low", error->low, "high", error->high) : inner.null();
  };
  const auto parts = [&](JsonWriter& inner) {
    const auto& part = run.parts;
    part ? inner.object("discretisation", part->discretisation, "links", part->links, "solver", part->solver, "reconstruction",
                        part->reconstruction)
         : inner.null();
  };
  json.object("setting", run.setting, "refused", std::optional<std::string>(), "cut_off",
              run.cut_off.empty() ? std::optional<std::string>() : run.cut_off, "cpu_seconds", run.cpu_seconds, "seconds_saved",
              run.seconds_saved, "peak_bytes", run.peak_bytes, "bytes", run.bytes, "links", run.links, "leaves", run.leaves, "rays",
              run.rays, "pareto", pareto, "errors", errors, "picture", picture, "parts", parts);
}

void write(JsonWriter& json, const SceneStudy& scene) {
  const std::set<const Run*> front = on_front(scene);
  const auto slope = [&](const Method& method, Cost cost) {
    const auto law = fit_power_law(points_of(method, scene.reference, cost));
    return law ? std::optional(law->exponent) : std::nullopt;
  };
  const auto reference = [&](JsonWriter& inner) {
    const Reference& r = scene.reference;
    inner.object("kind", r.kind, "noise", r.noise, "point_noise", r.point_noise, "cells", r.cells, "points", r.points, "paths", r.paths,
                 "cached", r.cached);
  };
  json.open_object().fields("scene", scene.scene, "title", scene.title, "reference", reference);
  json.key("methods").list(scene.methods, [&](const Method& method) {
    const auto slopes = [&](JsonWriter& inner) {
      inner.object("cpu_time", slope(method, Cost::cpu_time), "memory", slope(method, Cost::memory), "links", slope(method, Cost::links));
    };
    json.open_object().fields("name", method.name, "summary", method.summary, "slopes", slopes);
    json.key("runs").list(method.runs, [&](const Run& run) { write(json, run, scene.reference, front.contains(&run)); });
    json.close();
  });
  json.key("left_out").list(scene.left_out, [&](const radiosity::LeftOut& item) {
    json.object("what", item.what, "why", item.why, "saved", item.saved);
  });
  json.close();
}

// --- the folder

// A file's name, and the function that makes its bytes when it is written.
struct File {
  std::string name;
  std::function<std::string()> bytes;
};

// Keeps letters (also those beyond ASCII), digits and '-'; anything else becomes '_'.
std::string file_name(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       (static_cast<unsigned char>(c) & 0x80U) != 0;
    if (plain) {
      result += c;
    } else if (!result.empty() && result.back() != '_') {
      result += '_';
    }
  }
  return result;
}

std::vector<File> files(const Study& study) {
  std::vector<File> result;
  const auto add = [&result](const std::string& stem, const std::string& ending, std::function<std::string()> bytes) {
    std::string name = stem + ending;
    const auto taken = [&] { return std::any_of(result.begin(), result.end(), [&](const File& f) { return f.name == name; }); };
    for (int i = 2; taken(); ++i) { name = stem + "_" + std::to_string(i) + ending; }
    result.push_back({std::move(name), std::move(bytes)});
  };
  add("index", ".html", [&study] { return page(study); });
  add("results", ".csv", [&study] { return to_csv(study); });
  add("results", ".json", [&study] { return to_json(study); });
  for (const SceneStudy& scene : study.scenes) {
    const std::string stem = file_name(scene.scene) + "_";
    for (Figure& figure : figures(study, scene)) {
      add(stem + figure.name, ".svg", [figure] { return to_svg_file(figure.drawing, figure.caption); });
    }
    const double limit = error_limit(scene);
    for (const ErrorPicture& picture : scene.pictures) {
      add(stem + "error_" + file_name(picture.method), ".svg", [&scene, &picture, limit] {
        return to_svg_file(error_figure(picture, scene.camera, limit), "error picture: " + picture.method + ", " + picture.setting);
      });
    }
  }
  return result;
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

std::string to_json(const Study& study) {
  JsonWriter json;
  json.open_object();
  json.fields("program", "halflight", "version", study.version, "machine", study.machine, "compiler", study.compiler, "seed", study.seed);
  json.key("scenes").list(study.scenes, [&](const SceneStudy& scene) { write(json, scene); }).close();
  return json.text();
}

std::vector<std::string> page_files(const Study& study) {
  std::vector<std::string> names;
  for (const File& file : files(study)) { names.push_back(file.name); }
  return names;
}

std::optional<std::string> write_pages(const Study& study, const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) { return "cannot make the folder " + folder + ": " + failed.message(); }
  for (const File& file : files(study)) {
    if (auto fault = apps::write_file((std::filesystem::path(folder) / file.name).string(), file.bytes())) { return fault; }
  }
  return std::nullopt;
}

}  // namespace study
