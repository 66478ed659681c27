// SPDX-License-Identifier: MIT
#include "apps/commands/factors.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <ctime>

#include "apps/commands/common.hpp"
#include "apps/files.hpp"
#include "apps/json.hpp"

#include <radiosity/factors.hpp>

namespace apps {
namespace {

using radiosity::Factors;

struct Seconds {
  double wall = 0.0, cpu = 0.0;
};

std::string formatted(const char* format, double x) {
  char text[40] = "";
  std::snprintf(text, sizeof text, format, x);
  return text;
}
std::string left(std::string text, std::size_t width) {
  text.resize(std::max(text.size() + 2, width), ' ');
  return text;
}
std::string right(const std::string& text, std::size_t width) {
  return std::string(text.size() + 2 < width ? width - text.size() : 2, ' ') + text;
}

// With the fewest digits that read back as the same number.
std::string exact(double x) {
  std::array<char, 40> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr};
}

const char* name(radiosity::FactorMethod method) {
  constexpr const char* names[] = {"faces", "meshes", "rays"};
  return names[static_cast<std::size_t>(method)];
}

double worst(const Factors& f) {
  double error = 0.0;
  for (const radiosity::Estimate& e : f.factor) { error = std::max(error, e.error); }
  return error;
}

std::string summary(const Factors& f, const FactorsOptions& options, const Seconds& seconds) {
  constexpr std::size_t widest = 10;  // columns that a terminal shows
  const std::size_t n = f.surfaces.size();
  std::size_t width = 10;
  for (const auto& s : f.surfaces) { width = std::max(width, s.name.size() + 2); }
  const bool matrix = n <= widest;
  std::string text = options.scene + "\n" + left("from \\ to", width) + right("area", 12) + right("row sum", 12) + right("+-", 9);
  for (std::size_t j = 0; matrix && j < n; ++j) { text += right(f.surfaces[j].name, 12); }
  text += "\n";
  for (std::size_t i = 0; i < n; ++i) {
    const Factors::Surface& s = f.surfaces[i];
    text += left(s.name, width) + right(formatted("%.6g", s.area.value), 12) + right(formatted("%.7f", s.row_sum.value), 12) +
            right(formatted("%.0e", s.row_sum.error), 9);
    for (std::size_t j = 0; matrix && j < n; ++j) {
      text += right(formatted("%.7f", f(i, j).value), std::max<std::size_t>(12, f.surfaces[j].name.size() + 2));
    }
    text += "\n";
  }
  if (!matrix) { text += "The matrix has " + std::to_string(n) + " rows: --csv and --json write it.\n"; }
  std::array<std::size_t, 3> counts{};
  for (const radiosity::FactorMethod m : f.method) { ++counts[static_cast<std::size_t>(m)]; }
  text += "factors: " + std::to_string(counts[0]) + " between flat faces (" + std::to_string(f.points) + " points behind others), " +
          std::to_string(counts[1]) + " by meshes extrapolated to curved surfaces, " + std::to_string(counts[2]) + " by " +
          std::to_string(f.rays) + " rays\n";
  text += "largest error of a factor: " + formatted("%.1e", worst(f)) + ", wanted " + formatted("%.1e", options.error) +
          (f.converged ? "\n" : ": NOT REACHED\n");
  return text + "time: " + formatted("%.3f", seconds.wall) + " s, CPU " + formatted("%.3f", seconds.cpu) + " s\n";
}

// One line a surface; a name has no comma (examples/scenes/README.md).
std::string csv(const Factors& f) {
  std::string text = "surface,area,area error,row sum,row sum error";
  for (const auto& s : f.surfaces) { text += "," + s.name; }
  for (const auto& s : f.surfaces) { text += "," + s.name + " error"; }
  text += "\n";
  for (std::size_t i = 0; i < f.surfaces.size(); ++i) {
    const Factors::Surface& s = f.surfaces[i];
    text += s.name;
    for (const double x : {s.area.value, s.area.error, s.row_sum.value, s.row_sum.error}) { text += "," + exact(x); }
    for (std::size_t j = 0; j < f.surfaces.size(); ++j) { text += "," + exact(f(i, j).value); }
    for (std::size_t j = 0; j < f.surfaces.size(); ++j) { text += "," + exact(f(i, j).error); }
    text += "\n";
  }
  return text;
}

std::string json(const Factors& f, const FactorsOptions& options, const Seconds& seconds) {
  JsonWriter out;
  const std::size_t n = f.surfaces.size();
  out.open_object();
  out.key("scene").string(options.scene);
  out.key("error_wanted").number(options.error);
  out.key("error_reached").number(worst(f));
  out.key("converged").boolean(f.converged);
  out.key("points").count(f.points);
  out.key("rays").count(f.rays);
  out.key("wall_seconds").number(seconds.wall);
  out.key("cpu_seconds").number(seconds.cpu);
  out.key("surfaces").open_array();
  for (const Factors::Surface& s : f.surfaces) {
    out.open_object();
    out.key("name").string(s.name);
    out.key("area").number(s.area.value);
    out.key("area_error").number(s.area.error);
    out.key("row_sum").number(s.row_sum.value);
    out.key("row_sum_error").number(s.row_sum.error);
    out.close();
  }
  out.close();
  const auto matrix = [&](const char* key, const auto& write) {
    out.key(key).open_array();
    for (std::size_t i = 0; i < n; ++i) {
      out.open_array();
      for (std::size_t j = 0; j < n; ++j) { write(i, j); }
      out.close();
    }
    out.close();
  };
  matrix("factors", [&](std::size_t i, std::size_t j) { out.number(f(i, j).value); });
  matrix("errors", [&](std::size_t i, std::size_t j) { out.number(f(i, j).error); });
  matrix("methods", [&](std::size_t i, std::size_t j) { out.string(name(f.method[i * n + j])); });
  out.close();
  return out.text();
}

}  // namespace

void describe(CLI::App& command, FactorsOptions& options) {
  command.add_option("scene", options.scene, "the .scene file")->required()->type_name("SCENE");
  command.add_option("--csv", options.csv, "write the matrix: one line a surface, its factors, then their errors")->type_name("FILE");
  command.add_option("--json", options.json, "write the matrix, its errors and how each was found")->type_name("FILE");
  command.add_option("--error", options.error, "wanted error of each factor")->capture_default_str();
  command.add_option("--threads", options.threads, "0: as many as the machine has; results do not depend on it");
}

ExitCode run(const FactorsOptions& options) {
  for (const std::string& path : {options.csv, options.json}) {
    if (path.empty()) { continue; }
    if (const auto fault = check_writable(path)) {
      complain(*fault);
      return ExitCode::failure;
    }
  }
  ExitCode code = ExitCode::ok;
  const auto file = load_scene(options.scene, code);
  if (!file) { return code; }
  if (!(options.error > 0.0)) {
    complain("--error " + formatted("%g", options.error) + ": it must be above 0");
    return ExitCode::usage;
  }
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  radiosity::FactorOptions settings;
  settings.error = options.error;
  settings.threads = options.threads;
  const radiosity::FactorsResult result = radiosity::factors(file->scene, settings);
  if (!result.factors) {
    for (const std::string& fault : result.faults) { std::fprintf(stderr, "%s: error: %s\n", options.scene.c_str(), fault.c_str()); }
    return ExitCode::invalid_input;
  }
  const Seconds seconds{std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count(),
                        static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
  std::string text = summary(*result.factors, options, seconds);
  for (const auto& [path, bytes] :
       {std::pair{options.csv, csv(*result.factors)}, std::pair{options.json, json(*result.factors, options, seconds)}}) {
    if (path.empty()) { continue; }
    if (const auto fault = write_file(path, bytes)) {
      complain(*fault);
      return ExitCode::failure;
    }
    text += "written: " + path + "\n";
  }
  std::fputs(text.c_str(), stdout);
  if (std::fflush(stdout) != 0) {
    complain("cannot write to standard output");
    return ExitCode::failure;
  }
  return result.factors->converged ? ExitCode::ok : ExitCode::not_converged;
}

}  // namespace apps
