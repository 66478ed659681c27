// SPDX-License-Identifier: MIT
#include "apps/report.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <string_view>

#include "apps/json.hpp"
#include "apps/version.hpp"

namespace apps {
namespace {

#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
std::string
format(const char* pattern, ...) {
  std::va_list arguments;
  va_start(arguments, pattern);
  char text[160] = "";
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string percent(double part) { return format("%.3g %%", 100.0 * part); }

std::string bytes(std::uint64_t count) {
  constexpr const char* units[] = {"B", "kB", "MB", "GB", "TB"};
  double value = static_cast<double>(count);
  int unit = 0;
  while (value >= 1000.0 && unit < 4) {
    value /= 1000.0;
    ++unit;
  }
  return format(unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
}

// 1234567 as "1 234 567".
std::string grouped(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t at = digits.size(); at > 3;) {
    at -= 3;
    digits.insert(at, " ");
  }
  return digits;
}

std::string color(const radiosity::Color& c) {
  return c.x == c.y && c.y == c.z ? format("%.5g", c.x) : format("%.5g %.5g %.5g", c.x, c.y, c.z);
}

void row(std::string& out, std::string_view label, const std::string& value) {
  out += "  ";
  out += label;
  out.append(label.size() < 24 ? 24 - label.size() : 1, ' ');
  out += value + "\n";
}

std::string error_text(const std::optional<radiosity::ErrorEstimate>& error) {
  if (!error) { return "not measured"; }
  if (error->low == 0.0) { return error->high > 0.0 ? "below " + percent(error->high) : "none"; }  // lost in the noise of path tracing
  return percent(error->relative_l2) + "  (" + percent(error->low) + " to " + percent(error->high) + ")";
}

void picture_error(std::string& out, const radiosity::PictureError& picture) {
  row(out, "picture front", error_text(picture.error));
  const auto share = [](const radiosity::ShareBounds& of) {
    return of.least == of.most ? percent(of.least) : percent(of.least) + " to " + percent(of.most);
  };
  row(out, "  off by 2, 8 of 255", share(picture.over2) + ", " + share(picture.over8) + " of the pixels");
  if (picture.worst) {
    row(out, "  worst sixteenth",
        error_text(picture.worst->error) + format(", column %u, row %u of 4", picture.worst->column + 1, picture.worst->row + 1));
  }
  row(out, "  path-traced pixels", grouped(picture.points) + ", " + grouped(picture.rays) + " rays");
}

void error_and_time(std::string& out, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  out += "error (RMS, relative to the RMS of the reflected radiosity; 95 % interval)\n";
  if (audit.picture_error) { picture_error(out, *audit.picture_error); }
  if (report.options.reconstruction != radiosity::Reconstruction::none) { row(out, "surfaces", error_text(audit.surface_error)); }
  row(out, "leaf constants", error_text(audit.leaf_error));
  if (audit.estimated_error) {
    const bool picture = report.options.reconstruction < radiosity::Reconstruction::constant;
    row(out, "estimated from links",
        percent(*audit.estimated_error) + (picture ? " of the picture, " + percent(*audit.estimated_leaf_error) + " of the leaves" : "") +
            (audit.generations > 0 ? ", after " + std::to_string(audit.generations) + " generations" : ""));
    if (!audit.estimate_doubt.empty()) { row(out, "", "no bound: " + audit.estimate_doubt); }
    if (audit.target_missed) { row(out, "", "TARGET MISSED: the error is above " + percent(audit.target)); }
  }
  if (audit.leaf_error) { row(out, "path-traced points", grouped(audit.audit_points) + ", " + grouped(audit.audit_rays) + " rays"); }
  out += "time (s), peak memory         wall       CPU   of the process until then\n";
  const auto time = [&](const std::string& name, const radiosity::StageTime& stage) {
    const std::string peak = stage.peak_bytes ? "   " + bytes(*stage.peak_bytes) : std::string();
    row(out, name, format("%10.3f%10.3f", stage.wall_seconds, stage.cpu_seconds) + peak);
  };
  for (const radiosity::StageTime& stage : audit.stages) {
    if (!stage.name.ends_with("audit")) { time(stage.name, stage); }
  }
  time("total", {"", audit.wall_seconds, audit.cpu_seconds});
  for (const radiosity::StageTime& stage : audit.stages) {
    if (stage.name.ends_with("audit")) { time(stage.name + " (apart)", stage); }
  }
  if (report.picture_time) { time("picture (apart)", *report.picture_time); }
}

// Most that the process has held until the report, as far as it was measured.
std::optional<std::uint64_t> peak_bytes(const Report& report) {
  std::optional<std::uint64_t> peak;
  for (const radiosity::StageTime& stage : report.audit.stages) { peak = std::max(peak, stage.peak_bytes); }
  return report.picture_time ? std::max(peak, report.picture_time->peak_bytes) : peak;
}

void sizes_and_checks(std::string& out, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  out += "size\n";
  row(out, "input polygons", grouped(audit.polygons));
  row(out, "nodes, leaves", grouped(audit.nodes) + ", " + grouped(audit.leaves));
  row(out, "proportions",
      format("%.2f to %.2f, mean %.2f (regular polygon: 1)", audit.proportion.min, audit.proportion.max, audit.proportion.mean));
  const std::string of_clusters =
      audit.clusters > 0 ? ", " + grouped(audit.cluster_links) + " of them with one of " + grouped(audit.clusters) + " clusters"
                         : std::string{};
  row(out, "links", grouped(audit.links) + of_clusters);
  row(out, "rays",
      grouped(audit.rays) + " cast, " + grouped(audit.rays_avoided) + " avoided: " + grouped(audit.pairs_clear) + " pairs proven clear, " +
          grouped(audit.pairs_hidden) + " proven blocked");
  const std::optional<std::uint64_t> peak = peak_bytes(report);
  row(out, "memory", (peak ? bytes(*peak) + " at the peak of the process, " : std::string()) + bytes(audit.bytes) + " held by the result");
  out += "checks\n";
  const auto range = [](const radiosity::Audit::Range& r) { return format("%.6f to %.6f, mean %.6f", r.min, r.max, r.mean); };
  row(out, "row sums", range(audit.row_sum));
  if (audit.closure) {
    row(out, "  as computed", range(audit.computed_row_sum));
    row(out, "  correction",
        percent(*audit.closure) + " RMS (quadrature and sampling explain " + percent(audit.closure_limit) +
            "): the scene is proven closed, so each row must sum to 1");
  }
  row(out, "energy balance", percent(audit.energy_balance) + " amiss, " + percent(audit.escaped) + " escaped");
  if (audit.stray) {
    row(out, "open scene",
        percent(audit.stray->escaping) + " of the rays from its surfaces meet nothing, " + percent(audit.stray->to_backs) +
            " a black back (+- " + percent(audit.stray->standard_error) + ")");
  }
  row(out, "residual",
      format("%.2e after %u iterations%s", audit.residual, static_cast<unsigned>(audit.iterations),
             audit.converged           ? ""
             : audit.interrupted       ? " - INTERRUPTED, the best so far"
             : !audit.shortage.empty() ? " - OUT OF MEMORY, the best so far"
             : audit.target_missed     ? ""  // said above
                                       : " - NOT CONVERGED"));
  if (!audit.shortage.empty()) { row(out, "memory", audit.shortage); }
  out += "settings\n";
  if (report.options.refinement == radiosity::Refinement::a_posteriori) {
    row(out, "refinement",
        audit.target > 0.0 ? format("bf, estimate at most %.3g", audit.target) : std::string("bf, until the time was used"));
  } else {
    row(out, "refinement", format("f, epsilon %.3g, min area %.3g, of lights %.3g", audit.epsilon, audit.min_area, audit.light_epsilon));
  }
  row(out, "channels, threads, seed", format("%u, %u, %llu", audit.channels, audit.threads, static_cast<unsigned long long>(audit.seed)));
  if (report.options.reconstruction != radiosity::Reconstruction::none) {
    row(out, "exposure", format("%.5g%s", report.exposure, report.automatic_exposure ? " (automatic)" : ""));
  }
  if (report.picture) {
    row(out, "picture",
        format("%u x %u, of the %s, camera ", report.picture->width, report.picture->height,
               report.picture->method == PictureMethod::mesh ? "mesh" : "objects (raycast)") +
            report.picture->camera);
  }
}

void left_out_and_surfaces(std::string& out, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  if (!audit.warnings.empty()) { out += "warnings\n"; }
  for (const std::string& sentence : audit.warnings) { out += "  " + sentence + "\n"; }
  out += "left out\n";
  if (audit.left_out.empty()) { out += "  nothing\n"; }
  for (const radiosity::LeftOut& item : audit.left_out) {
    out += "  " + item.what + ": " + item.why + (item.saved.empty() ? "" : "; saved " + item.saved) +
           (item.seconds > 0.0 ? format(", about %.2g s", item.seconds) : "") + "\n";
  }
  constexpr std::size_t most = 40;
  out += "mean radiosity (W/m2)         area (m2)   R G B\n";
  for (std::size_t i = 0; i < audit.surfaces.size() && i < most; ++i) {
    const radiosity::SurfaceMean& surface = audit.surfaces[i];
    row(out, surface.name, format("%13.5g   ", surface.area) + color(surface.radiosity));
  }
  if (audit.surfaces.size() > most) { out += "  ... and " + std::to_string(audit.surfaces.size() - most) + " more; --json has all\n"; }
}

void write_error(JsonWriter& json, const radiosity::ErrorEstimate& error) {
  json.key("relative_l2").number(error.relative_l2);
  json.key("standard_error").number(error.standard_error);
  json.key("low").number(error.low).key("high").number(error.high);
}

void write_picture_error(JsonWriter& json, const radiosity::PictureError& picture) {
  json.open_object();
  write_error(json, picture.error);
  json.key("audited").number(picture.audited);
  const auto share = [&](const char* key, const radiosity::ShareBounds& of) {
    json.key(key).open_array();
    json.number(of.least).number(of.most);
    json.close();
  };
  share("over_2_levels", picture.over2);
  share("over_8_levels", picture.over8);
  json.key("worst_tile");
  if (picture.worst) {
    json.open_object();
    json.key("column").count(picture.worst->column).key("row").count(picture.worst->row);
    write_error(json, picture.worst->error);
    json.close();
  } else {
    json.null();
  }
  json.key("points").count(picture.points).key("rays").count(picture.rays);
  json.close();
}

void write_errors(JsonWriter& json, const radiosity::Audit& audit) {
  json.key("error");
  if (!audit.leaf_error) {
    json.null();
    return;
  }
  json.open_object();
  if (audit.surface_error) { write_error(json, *audit.surface_error); }  // else nobody asked for a reconstruction
  json.key("points").count(audit.audit_points);
  json.key("rays").count(audit.audit_rays);
  json.key("leaf");
  json.open_object();
  write_error(json, *audit.leaf_error);
  json.close();
  if (audit.picture_error) {
    json.key("picture");
    write_picture_error(json, *audit.picture_error);
  }
  json.close();
}

// Stages of one name (a run that was repeated to meet its error target) are added up.
void write_times(JsonWriter& json, const char* key, const Report& report, double radiosity::StageTime::*member, double total) {
  std::vector<std::pair<std::string, double>> times;
  const auto add = [&](const radiosity::StageTime& stage) {
    std::string name = stage.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    const auto same = std::find_if(times.begin(), times.end(), [&](const auto& time) { return time.first == name; });
    if (same == times.end()) {
      times.emplace_back(std::move(name), stage.*member);
    } else {
      same->second += stage.*member;
    }
  };
  for (const radiosity::StageTime& stage : report.audit.stages) { add(stage); }
  if (report.picture_time) { add(*report.picture_time); }
  json.key(key).open_object();
  for (const auto& [name, seconds] : times) { json.key(name).number(seconds); }
  json.key("total").number(total);
  json.close();
}

// Until the end of each stage; null where the system does not tell. That of the process is the largest.
void write_peaks(JsonWriter& json, const Report& report) {
  const auto write = [&](std::string name, const std::optional<std::uint64_t>& peak) {
    std::replace(name.begin(), name.end(), ' ', '_');
    json.key(name);
    if (peak) {
      json.count(*peak);
    } else {
      json.null();
    }
  };
  json.key("peak_bytes").open_object();
  const std::vector<radiosity::StageTime>& stages = report.audit.stages;
  for (std::size_t i = 0; i < stages.size(); ++i) {  // of stages of one name the last: peaks only grow
    const bool again = std::any_of(stages.begin() + static_cast<std::ptrdiff_t>(i) + 1, stages.end(),
                                   [&](const radiosity::StageTime& later) { return later.name == stages[i].name; });
    if (!again) { write(stages[i].name, stages[i].peak_bytes); }
  }
  if (report.picture_time) { write(report.picture_time->name, report.picture_time->peak_bytes); }
  write("process", peak_bytes(report));
  json.close();
}

void write_color(JsonWriter& json, const radiosity::Color& color) {
  json.open_array();
  for (int c = 0; c < 3; ++c) { json.number(color[c]); }
  json.close();
}

void write_range(JsonWriter& json, const char* key, const radiosity::Audit::Range& range) {
  json.key(key).open_object();
  json.key("min").number(range.min).key("mean").number(range.mean).key("max").number(range.max);
  json.close();
}

void write_lists(JsonWriter& json, const Report& report) {
  json.key("warnings").open_array();
  for (const std::string& sentence : report.audit.warnings) { json.string(sentence); }
  json.close();
  json.key("stray_rays");
  if (const auto& stray = report.audit.stray) {
    json.open_object();
    json.key("escaping")
        .number(stray->escaping)
        .key("to_backs")
        .number(stray->to_backs)
        .key("standard_error")
        .number(stray->standard_error);
    json.close();
  } else {
    json.null();
  }
  json.key("left_out").open_array();
  for (const radiosity::LeftOut& item : report.audit.left_out) {
    json.open_object();
    json.key("what").string(item.what).key("why").string(item.why).key("saved").string(item.saved).key("seconds").number(item.seconds);
    json.close();
  }
  json.close();
  json.key("surfaces").open_array();
  for (const radiosity::SurfaceMean& surface : report.audit.surfaces) {
    json.open_object();
    json.key("name").string(surface.name).key("area").number(surface.area).key("radiosity");
    write_color(json, surface.radiosity);
    json.close();
  }
  json.close();
  json.key("files").open_array();
  for (const std::string& file : report.files) { json.string(file); }
  json.close();
}

void write_settings(JsonWriter& json, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  json.key("settings").open_object();
  json.key("epsilon").number(audit.epsilon).key("min_area").number(audit.min_area).key("light_epsilon").number(audit.light_epsilon);
  json.key("error_target");
  if (report.options.error) {
    json.number(*report.options.error);
  } else {
    json.null();
  }
  json.key("solver").string(name(report.options.solver));
  json.key("reconstruction").string(name(report.options.reconstruction));
  json.key("channels").count(audit.channels).key("threads").count(audit.threads).key("seed").count(audit.seed);
  json.close();
  json.key("picture");
  if (!report.picture) {
    json.null();
    return;
  }
  json.open_object();
  json.key("camera").string(report.picture->camera);
  json.key("width").count(report.picture->width).key("height").count(report.picture->height);
  json.key("method").string(report.picture->method == PictureMethod::mesh ? "mesh" : "raycast");
  json.close();
}

}  // namespace

std::string to_text(const Report& report) {
  std::string out = report.scene + "\n";
  error_and_time(out, report);
  sizes_and_checks(out, report);
  left_out_and_surfaces(out, report);
  for (const std::string& file : report.files) { out += "written: " + file + "\n"; }
  return out;
}

std::string to_json(const Report& report) {
  const radiosity::Audit& audit = report.audit;
  JsonWriter json;
  json.open_object();
  json.key("program").string("halflight").key("version").string(version);
  json.key("scene").string(report.scene);
  write_errors(json, audit);
  write_times(json, "cpu_seconds", report, &radiosity::StageTime::cpu_seconds, audit.cpu_seconds);
  write_times(json, "wall_seconds", report, &radiosity::StageTime::wall_seconds, audit.wall_seconds);
  write_peaks(json, report);
  json.key("polygons").count(audit.polygons);
  json.key("nodes").count(audit.nodes).key("leaves").count(audit.leaves).key("links").count(audit.links);
  json.key("clusters").count(audit.clusters).key("cluster_links").count(audit.cluster_links);
  json.key("rays").count(audit.rays).key("rays_avoided").count(audit.rays_avoided);
  json.key("pairs_clear").count(audit.pairs_clear).key("pairs_blocked").count(audit.pairs_hidden).key("bytes").count(audit.bytes);
  write_range(json, "proportion", audit.proportion);
  write_range(json, "row_sum", audit.row_sum);
  write_range(json, "computed_row_sum", audit.computed_row_sum);
  json.key("closure");
  if (audit.closure) {
    json.number(*audit.closure);
  } else {
    json.null();
  }
  json.key("estimated_error");
  if (audit.estimated_error) {
    json.number(*audit.estimated_error);
  } else {
    json.null();
  }
  json.key("estimated_leaf_error");
  if (audit.estimated_leaf_error) {
    json.number(*audit.estimated_leaf_error);
  } else {
    json.null();
  }
  json.key("estimate_doubt").string(audit.estimate_doubt).key("target_missed").boolean(audit.target_missed);
  json.key("energy_balance").number(audit.energy_balance).key("escaped").number(audit.escaped);
  json.key("residual").number(audit.residual).key("iterations").count(audit.iterations);
  json.key("residual_histories").open_array();
  for (const std::vector<double>& history : audit.histories) {
    json.open_array();
    for (const double residual : history) { json.number(residual); }
    json.close();
  }
  json.close();
  json.key("converged").boolean(audit.converged);
  json.key("shortage").string(audit.shortage);
  json.key("exposure").number(report.exposure).key("exposure_automatic").boolean(report.automatic_exposure);
  write_settings(json, report);
  write_lists(json, report);
  json.close();
  return json.text();
}

}  // namespace apps
