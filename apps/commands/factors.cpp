// SPDX-License-Identifier: MIT
// halflight factors SCENE: the form factors between the surfaces of a scene, each with its error.
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <memory>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factor_run.hpp>
#include <radiosity/factors/factors.hpp>
#include <radiosity/factors/total_exchange.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/commands/command.hpp"
#include "apps/commands/common.hpp"
#include "apps/json.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

struct FactorsOptions {
  ModelOptions model;
  std::string scene, csv, json, total_exchange;
  double error = 1e-3;
  unsigned threads = 0;
};

using radiosity::Estimate;
using radiosity::Factors;
using radiosity::TotalExchange;

// The total exchange factors of one channel, or of all channels if every surface is grey.
struct Channel {
  std::string name;
  std::vector<double> emissivity;
  TotalExchange exchange;
};

const char* name(radiosity::FactorMethod method) {
  constexpr const char* names[] = {"faces", "meshes", "rays"};
  return names[static_cast<std::size_t>(method)];
}

double worst(const std::vector<radiosity::Estimate>& factors) {
  double error = 0.0;
  for (const radiosity::Estimate& e : factors) { error = std::max(error, e.error); }
  return error;
}

// What a surface does not reflect it absorbs, so its emissivity is 1 - reflectance (Kirchhoff 1860).
std::vector<Channel> total_exchange_of(const Factors& f, const radiosity::Scene& scene, std::string& refusal) {
  const auto reflectance = [&](const Factors::Surface& s) { return scene.materials[s.material].reflectance; };
  const bool grey =
      std::all_of(f.surfaces.begin(), f.surfaces.end(), [&](const Factors::Surface& s) { return radiosity::is_grey(reflectance(s)); });
  std::vector<Channel> channels;
  for (int c = 0; c < (grey ? 1 : 3); ++c) {
    constexpr const char* names[] = {"red", "green", "blue"};
    Channel channel{grey ? "grey" : names[c], {}, {}};
    for (const auto& s : f.surfaces) { channel.emissivity.push_back(1.0 - reflectance(s)[c]); }
    radiosity::TotalExchangeResult result = radiosity::total_exchange(f, channel.emissivity);
    if (!result.exchange) {
      refusal = result.refusal;
      return {};
    }
    channel.exchange = std::move(*result.exchange);
    channels.push_back(std::move(channel));
  }
  return channels;
}

constexpr std::size_t widest = 10;  // number of columns that fit a terminal

// One line per surface: its name, one number, the sum of its row with its error, and the row itself if it fits.
std::string matrix_text(const Factors& f, const std::string& corner, const char* column, const std::function<double(std::size_t)>& number,
                        const std::function<Estimate(std::size_t)>& row_sum, const std::vector<Estimate>& factor) {
  const std::size_t n = f.surfaces.size();
  const bool fits = n <= widest;
  std::size_t width = 10;
  for (const auto& s : f.surfaces) { width = std::max(width, s.name.size() + 2); }
  std::string text = left(corner, width) + right(column, 12) + right("row sum", 12) + right("+-", 9);
  for (std::size_t j = 0; fits && j < n; ++j) { text += right(f.surfaces[j].name, 12); }
  text += "\n";
  for (std::size_t i = 0; i < std::min(n, longest_list); ++i) {
    text += left(f.surfaces[i].name, width) + right(formatted("%.6g", number(i)), 12) + right(formatted("%.7f", row_sum(i).value), 12) +
            right(formatted("%.0e", row_sum(i).error), 9);
    for (std::size_t j = 0; fits && j < n; ++j) {
      text += right(formatted("%.7f", factor[i * n + j].value), std::max<std::size_t>(12, f.surfaces[j].name.size() + 2));
    }
    text += "\n";
  }
  return text;
}

std::string table(const Factors& f, const Channel& channel) {
  const TotalExchange& exchange = channel.exchange;
  const std::string matrix = f.surfaces.size() > widest
                                 ? std::string()
                                 : matrix_text(
                                       f, "script F, " + channel.name, "emissivity", [&](std::size_t i) { return channel.emissivity[i]; },
                                       [&](std::size_t i) { return exchange.row_sum[i]; }, exchange.factor);
  return matrix + "largest error of a total exchange factor (" + channel.name + "): " + formatted("%.1e", worst(exchange.factor)) + "\n";
}

std::string summary(const Factors& f, const FactorsOptions& options, const radiosity::StageTime& time) {
  const std::size_t n = f.surfaces.size();
  std::string text = options.scene + "\n" +
                     matrix_text(
                         f, "from \\ to", "area", [&](std::size_t i) { return f.surfaces[i].area.value; },
                         [&](std::size_t i) { return f.surfaces[i].row_sum; }, f.factor);
  text += and_more(n, longest_list);
  if (n > widest) { text += "The matrix has " + std::to_string(n) + " rows: --csv and --json write it.\n"; }
  std::array<std::size_t, 3> counts{};
  for (const radiosity::FactorMethod m : f.method) { ++counts[static_cast<std::size_t>(m)]; }
  text += "factors: " + std::to_string(counts[0]) + " between flat faces (" + std::to_string(f.points) + " points behind others), " +
          std::to_string(counts[1]) + " by meshes extrapolated to curved surfaces, " + std::to_string(counts[2]) + " by " +
          std::to_string(f.rays) + " rays\n";
  text += "largest error of a factor: " + formatted("%.1e", worst(f.factor)) + ", wanted " + formatted("%.1e", options.error) +
          (f.converged ? "\n" : ": NOT REACHED\n");
  return text + "time: " + formatted("%.3f", time.wall_seconds) + " s, CPU " + formatted("%.3f", time.cpu_seconds) + " s\n";
}

// One line per surface: its data, its factors, then their errors. Names contain no commas (examples/scenes/README.md).
std::string csv_head(const Factors& f, std::string text) {
  for (const auto& s : f.surfaces) { text += "," + s.name; }
  for (const auto& s : f.surfaces) { text += "," + s.name + " error"; }
  return text + "\n";
}
std::string csv_line(std::size_t i, std::string text, std::initializer_list<double> numbers, const std::vector<Estimate>& factor,
                     std::size_t n) {
  for (const double x : numbers) { text += "," + shortest(x); }
  for (std::size_t j = 0; j < n; ++j) { text += "," + shortest(factor[i * n + j].value); }
  for (std::size_t j = 0; j < n; ++j) { text += "," + shortest(factor[i * n + j].error); }
  return text + "\n";
}

std::string csv(const Factors& f) {
  std::string text = csv_head(f, "surface,area,area error,row sum,row sum error");
  for (std::size_t i = 0; i < f.surfaces.size(); ++i) {
    const Factors::Surface& s = f.surfaces[i];
    text += csv_line(i, s.name, {s.area.value, s.area.error, s.row_sum.value, s.row_sum.error}, f.factor, f.surfaces.size());
  }
  return text;
}

std::string csv(const Factors& f, const std::vector<Channel>& channels) {
  std::string text = csv_head(f, "channel,surface,area,emissivity,row sum,row sum error");
  for (const Channel& channel : channels) {
    const TotalExchange& exchange = channel.exchange;
    for (std::size_t i = 0; i < f.surfaces.size(); ++i) {
      text += csv_line(i, channel.name + "," + f.surfaces[i].name,
                       {f.surfaces[i].area.value, channel.emissivity[i], exchange.row_sum[i].value, exchange.row_sum[i].error},
                       exchange.factor, f.surfaces.size());
    }
  }
  return text;
}

std::string json(const Factors& f, const std::vector<Channel>& channels, const FactorsOptions& options, const radiosity::StageTime& time) {
  JsonWriter out;
  const std::size_t n = f.surfaces.size();
  out.open_object();
  out.fields("scene", options.scene, "error_wanted", options.error, "error_reached", worst(f.factor), "converged", f.converged, "points",
             f.points, "rays", f.rays, "wall_seconds", time.wall_seconds, "cpu_seconds", time.cpu_seconds);
  out.key("surfaces").list(f.surfaces, [&](const Factors::Surface& s) {
    out.object("name", s.name, "area", s.area.value, "area_error", s.area.error, "row_sum", s.row_sum.value, "row_sum_error",
               s.row_sum.error);
  });
  // Writes a matrix as a list of rows; entry(i) is the number with index i, row by row.
  const auto matrix = [&](const char* key, const auto& entry) {
    out.key(key).open_array();
    for (std::size_t i = 0; i < n; ++i) {
      out.open_array();
      for (std::size_t j = 0; j < n; ++j) { out.value(entry(i * n + j)); }
      out.close();
    }
    out.close();
  };
  const auto estimates = [&](const std::vector<Estimate>& factor) {
    matrix("factors", [&](std::size_t k) { return factor[k].value; });
    matrix("errors", [&](std::size_t k) { return factor[k].error; });
  };
  estimates(f.factor);
  matrix("methods", [&](std::size_t k) { return name(f.method[k]); });
  if (!channels.empty()) {
    out.key("total_exchange").list(channels, [&](const Channel& channel) {
      out.open_object().fields("channel", channel.name, "emissivities", channel.emissivity);
      out.key("row_sums").list(channel.exchange.row_sum, [&](const Estimate& sum) { out.number(sum.value); });
      estimates(channel.exchange.factor);
      out.close();
    });
  }
  out.close();
  return out.text();
}

ExitCode run(const FactorsOptions& options) {
  const std::vector<std::string> outputs{options.csv, options.total_exchange, options.json};
  ExitCode code = check_outputs(outputs, {options.scene});
  if (code != ExitCode::ok) { return code; }
  const auto file = load_scene(options.scene, outputs, code, options.model);
  if (!file) { return code; }
  std::vector<radiosity::StageTime> times;
  radiosity::detail::Stopwatch watch(times);
  const radiosity::FactorOptions settings{.error = options.error, .threads = options.threads};
  const radiosity::FactorsResult result = radiosity::factors(file->scene, settings);
  if (!result.factors) {
    complain_of(options.scene, result.faults);
    return ExitCode::invalid_input;
  }
  std::string refusal;
  std::vector<Channel> channels;
  if (!options.total_exchange.empty()) { channels = total_exchange_of(*result.factors, file->scene, refusal); }
  if (!refusal.empty()) {
    std::fprintf(stderr, "%s: error: no total exchange factors: %s\n", options.scene.c_str(), refusal.c_str());
    return ExitCode::invalid_input;
  }
  watch.lap("factors");
  std::string text = summary(*result.factors, options, times[0]);
  for (const Channel& channel : channels) { text += table(*result.factors, channel); }
  for (const auto& [path, bytes] :
       {std::pair{options.csv, csv(*result.factors)}, std::pair{options.total_exchange, csv(*result.factors, channels)},
        std::pair{options.json, json(*result.factors, channels, options, times[0])}}) {
    if (path.empty()) { continue; }
    if (!save(path, bytes)) { return ExitCode::failure; }
    text += "written: " + path + "\n";
  }
  if (!print(text, outputs)) { return ExitCode::failure; }
  return result.factors->converged ? ExitCode::ok : ExitCode::not_converged;
}

}  // namespace

Command factors_command() {
  const auto options = std::make_shared<FactorsOptions>();
  return {
      "factors", "the form factors between the surfaces of a scene, each with its error: 95 of 100 are within twice that",
      with_model_arguments(
          {scene_argument(options->scene),
           text("--csv", "FILE", options->csv, "write the matrix: one line a surface, its factors, then their errors"),
           text("--json", "FILE", options->json, "write the matrix, its errors and how each was found"),
           text("--total-exchange", "FILE", options->total_exchange,
                "write the total exchange factors, reflections included (script F; emissivity = 1 - reflectance); --json gets them, too"),
           above_zero("--error", options->error, 1.0, "wanted error of each factor").by_default(formatted("%g", options->error)),
           whole_number("--threads", options->threads, 0, most_threads, "0: as many as the machine has; results do not depend on it")},
          options->model),
      [options] { return run(*options); }};
}

}  // namespace apps
