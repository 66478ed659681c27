// SPDX-License-Identifier: MIT
#include "apps/report.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/left_out.hpp>

#include "apps/facts.hpp"
#include "apps/text.hpp"
#include "apps/version.hpp"

namespace apps {
namespace {

// Most that the process has held until the report, as far as it was measured.
std::optional<std::uint64_t> peak_bytes(const Report& report) {
  std::optional<std::uint64_t> peak;
  for (const radiosity::StageTime& stage : report.audit.stages) { peak = std::max(peak, stage.peak_bytes); }
  return report.picture_time ? std::max(peak, report.picture_time->peak_bytes) : peak;
}

// --- the facts, in the order of the JSON

void add_error(Facts& facts, const std::string& path, const radiosity::ErrorEstimate& error) {
  facts.add(path + ".relative_l2", error.relative_l2, "%");
  facts.add(path + ".standard_error", error.standard_error, "%");
  facts.add(path + ".low", error.low, "%");
  facts.add(path + ".high", error.high, "%");
}

void add_picture_error(Facts& facts, const radiosity::PictureError& picture) {
  add_error(facts, "error.picture", picture.error);
  facts.add("error.picture.audited", picture.audited);
  const auto share = [&](const char* path, const radiosity::ShareBounds& of) {
    facts.add(path, [of](JsonWriter& json) { json.open_array().number(of.least).number(of.most).close(); });
  };
  share("error.picture.over_2_levels", picture.over2);
  share("error.picture.over_8_levels", picture.over8);
  if (picture.worst) {
    facts.add("error.picture.worst_tile.column", picture.worst->column);
    facts.add("error.picture.worst_tile.row", picture.worst->row);
    add_error(facts, "error.picture.worst_tile", picture.worst->error);
  } else {
    facts.add("error.picture.worst_tile", {});
  }
  facts.add("error.picture.points", picture.points);
  facts.add("error.picture.rays", picture.rays);
}

void add_errors(Facts& facts, const radiosity::Audit& audit) {
  if (!audit.leaf_error) { return facts.add("error", {}); }
  if (audit.surface_error) { add_error(facts, "error", *audit.surface_error); }  // else nobody asked for a reconstruction
  facts.add("error.points", audit.audit_points);
  facts.add("error.rays", audit.audit_rays);
  add_error(facts, "error.leaf", *audit.leaf_error);
  if (audit.picture_error) { add_picture_error(facts, *audit.picture_error); }
}

// Stages of one name (a run that was repeated to meet its error target) are added up; of their peaks the last is the largest.
void add_stages(Facts& facts, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  struct Sum {
    std::string key;
    radiosity::StageTime stage;
    std::size_t last;
  };
  std::vector<Sum> sums;
  std::size_t number = 0;
  const auto add = [&](const radiosity::StageTime& stage) {
    std::string key = stage.name;
    std::replace(key.begin(), key.end(), ' ', '_');
    const auto same = std::find_if(sums.begin(), sums.end(), [&](const Sum& sum) { return sum.key == key; });
    if (same == sums.end()) {
      sums.push_back({std::move(key), stage, number++});
      return;
    }
    same->stage.cpu_seconds += stage.cpu_seconds;
    same->stage.wall_seconds += stage.wall_seconds;
    same->stage.peak_bytes = stage.peak_bytes;
    same->last = number++;
  };
  for (const radiosity::StageTime& stage : audit.stages) { add(stage); }
  if (report.picture_time) { add(*report.picture_time); }
  for (const Sum& sum : sums) { facts.add("cpu_seconds." + sum.key, sum.stage.cpu_seconds); }
  facts.add("cpu_seconds.total", audit.cpu_seconds);
  for (const Sum& sum : sums) { facts.add("wall_seconds." + sum.key, sum.stage.wall_seconds); }
  facts.add("wall_seconds.total", audit.wall_seconds);
  std::stable_sort(sums.begin(), sums.end(), [](const Sum& a, const Sum& b) { return a.last < b.last; });
  for (const Sum& sum : sums) { facts.add("peak_bytes." + sum.key, sum.stage.peak_bytes, "B"); }
  facts.add("peak_bytes.process", peak_bytes(report), "B");
}

void add_range(Facts& facts, const std::string& path, const radiosity::Audit::Range& range, const char* unit) {
  facts.add(path + ".min", range.min, unit);
  facts.add(path + ".mean", range.mean, unit);
  facts.add(path + ".max", range.max, unit);
}

void add_settings(Facts& facts, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  facts.add("exposure", report.exposure, "%.5g");
  facts.add("exposure_automatic", report.automatic_exposure);
  facts.add("settings.epsilon", audit.epsilon, "%.3g");
  facts.add("settings.min_area", audit.min_area, "%.3g");
  facts.add("settings.light_epsilon", audit.light_epsilon, "%.3g");
  facts.add("settings.error_target", report.options.error);
  facts.add("settings.solver", std::string(name(report.options.solver)));
  facts.add("settings.reconstruction", std::string(name(report.options.reconstruction)));
  facts.add("settings.channels", audit.channels);
  facts.add("settings.threads", audit.threads, "1");
  facts.add("settings.seed", audit.seed, "1");
  if (!report.picture) { return facts.add("picture", {}); }
  facts.add("picture.camera", report.picture->camera);
  facts.add("picture.width", report.picture->width, "1");
  facts.add("picture.height", report.picture->height, "1");
  facts.add("picture.method", std::string(report.picture->method == PictureMethod::mesh ? "mesh" : "raycast"));
}

// A list of what `write` writes of each.
template <class Item, class Write>
void add_list(Facts& facts, const char* path, const std::vector<Item>& items, const Write& write) {
  facts.add(path, [&items, write](JsonWriter& json) {
    json.open_array();
    for (const Item& item : items) { write(json, item); }
    json.close();
  });
}

void add_lists(Facts& facts, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  const auto sentence = [](JsonWriter& json, const std::string& text) { json.string(text); };
  add_list(facts, "warnings", audit.warnings, sentence);
  if (audit.stray) {
    facts.add("stray_rays.escaping", audit.stray->escaping, "%");
    facts.add("stray_rays.to_backs", audit.stray->to_backs, "%");
    facts.add("stray_rays.standard_error", audit.stray->standard_error, "%");
  } else {
    facts.add("stray_rays", {});
  }
  add_list(facts, "left_out", audit.left_out, [](JsonWriter& json, const radiosity::LeftOut& item) {
    json.open_object().key("what").string(item.what).key("why").string(item.why).key("saved").string(item.saved);
    json.key("seconds").number(item.seconds).close();
  });
  add_list(facts, "surfaces", audit.surfaces, [](JsonWriter& json, const radiosity::SurfaceMean& surface) {
    json.open_object().key("name").string(surface.name).key("area").number(surface.area).key("radiosity").open_array();
    for (int c = 0; c < 3; ++c) { json.number(surface.radiosity[c]); }
    json.close().close();
  });
  add_list(facts, "files", report.files, sentence);
}

Facts facts_of(const Report& report) {
  const radiosity::Audit& audit = report.audit;
  Facts facts;
  facts.add("program", std::string("halflight"));
  facts.add("version", std::string(version));
  facts.add("scene", report.scene);
  add_errors(facts, audit);
  add_stages(facts, report);
  facts.add("polygons", audit.polygons);
  facts.add("nodes", audit.nodes);
  facts.add("leaves", audit.leaves);
  facts.add("links", audit.links);
  facts.add("clusters", audit.clusters);
  facts.add("cluster_links", audit.cluster_links);
  facts.add("rays", audit.rays);
  facts.add("rays_avoided", audit.rays_avoided);
  facts.add("pairs_clear", audit.pairs_clear);
  facts.add("pairs_blocked", audit.pairs_hidden);
  facts.add("bytes", audit.bytes, "B");
  add_range(facts, "proportion", audit.proportion, "%.2f");
  add_range(facts, "row_sum", audit.row_sum, "%.6f");
  add_range(facts, "computed_row_sum", audit.computed_row_sum, "%.6f");
  facts.add("closure", audit.closure, "%");
  facts.add("estimated_error", audit.estimated_error, "%");
  facts.add("estimated_leaf_error", audit.estimated_leaf_error, "%");
  facts.add("estimate_doubt", audit.estimate_doubt);
  facts.add("target_missed", audit.target_missed);
  facts.add("energy_balance", audit.energy_balance, "%");
  facts.add("escaped", audit.escaped, "%");
  facts.add("residual", audit.residual, "%.2e");
  facts.add("iterations", audit.iterations, "1");
  add_list(facts, "residual_histories", audit.histories, [](JsonWriter& json, const std::vector<double>& history) {
    json.open_array();
    for (const double residual : history) { json.number(residual); }
    json.close();
  });
  facts.add("converged", audit.converged);
  facts.add("shortage", audit.shortage);
  add_settings(facts, report);
  add_lists(facts, report);
  return facts;
}

// --- the text

std::string error_text(const std::optional<radiosity::ErrorEstimate>& error) {
  if (!error) { return "not measured"; }
  if (error->low == 0.0) { return error->high > 0.0 ? "below " + percent(error->high) : "none"; }  // lost in the noise of path tracing
  return percent(error->relative_l2) + "  (" + percent(error->low) + " to " + percent(error->high) + ")";
}

class Text {
 public:
  explicit Text(const Report& report) : report_(report), audit_(report.audit), facts_(facts_of(report)) {}

  std::string write() {
    out_ = report_.scene + "\n";
    errors();
    times();
    sizes();
    checks();
    settings();
    lists();
    for (const std::string& file : report_.files) { out_ += "written: " + file + "\n"; }
    return out_;
  }

 private:
  void row(std::string_view label, const std::string& value) { out_ += "  " + left(std::string(label), 24, 1) + value + "\n"; }
  // A sentence that names facts; left out where one of them is not known. `more` follows as it is.
  void say(std::string_view label, std::string_view sentence, const std::string& more = {}) {
    if (const auto text = facts_.text(sentence)) { row(label, *text + more); }
  }

  void errors() {
    out_ += "error (RMS, relative to the RMS of the reflected radiosity; 95 % interval)\n";
    if (audit_.picture_error) { picture_error(*audit_.picture_error); }
    if (report_.options.reconstruction != radiosity::Reconstruction::none) { row("surfaces", error_text(audit_.surface_error)); }
    row("leaf constants", error_text(audit_.leaf_error));
    if (audit_.estimated_error) {
      const bool picture = report_.options.reconstruction < radiosity::Reconstruction::constant;
      say("estimated from links", picture ? "{estimated_error} of the picture, {estimated_leaf_error} of the leaves" : "{estimated_error}",
          audit_.generations > 0 ? ", after " + std::to_string(audit_.generations) + " generations" : "");
      if (!audit_.estimate_doubt.empty()) { say("", "no bound: {estimate_doubt}"); }
      if (audit_.target_missed) { row("", "TARGET MISSED: the error is above " + percent(audit_.target)); }
    }
    say("path-traced points", "{error.points}, {error.rays} rays");
  }

  void picture_error(const radiosity::PictureError& picture) {
    row("picture front", error_text(picture.error));
    const auto share = [](const radiosity::ShareBounds& of) {
      return of.least == of.most ? percent(of.least) : percent(of.least) + " to " + percent(of.most);
    };
    row("  off by 2, 8 of 255", share(picture.over2) + ", " + share(picture.over8) + " of the pixels");
    if (picture.worst) {
      row("  worst sixteenth", error_text(picture.worst->error) + ", column " + std::to_string(picture.worst->column + 1) + ", row " +
                                   std::to_string(picture.worst->row + 1) + " of 4");
    }
    row("  path-traced pixels", grouped(picture.points) + ", " + grouped(picture.rays) + " rays");
  }

  void times() {
    out_ += "time (s), peak memory         wall       CPU   of the process until then\n";
    const auto time = [&](const std::string& name, const radiosity::StageTime& stage) {
      row(name, formatted("%10.3f", stage.wall_seconds) + formatted("%10.3f", stage.cpu_seconds) +
                    (stage.peak_bytes ? "   " + bytes_text(*stage.peak_bytes) : std::string()));
    };
    for (const radiosity::StageTime& stage : audit_.stages) {
      if (!stage.name.ends_with("audit")) { time(stage.name, stage); }
    }
    time("total", {"", audit_.wall_seconds, audit_.cpu_seconds});
    for (const radiosity::StageTime& stage : audit_.stages) {
      if (stage.name.ends_with("audit")) { time(stage.name + " (apart)", stage); }
    }
    if (report_.picture_time) { time("picture (apart)", *report_.picture_time); }
  }

  void sizes() {
    out_ += "size\n";
    say("input polygons", "{polygons}");
    say("nodes, leaves", "{nodes}, {leaves}");
    say("proportions", "{proportion.min} to {proportion.max}, mean {proportion.mean} (regular polygon: 1)");
    say("links", audit_.clusters > 0 ? "{links}, {cluster_links} of them with one of {clusters} clusters" : "{links}");
    say("rays", "{rays} cast, {rays_avoided} avoided: {pairs_clear} pairs proven clear, {pairs_blocked} proven blocked");
    row("memory",
        facts_.text("{peak_bytes.process} at the peak of the process, ").value_or("") + *facts_.text("{bytes} held by the result"));
  }

  void checks() {
    out_ += "checks\n";
    say("row sums", "{row_sum.min} to {row_sum.max}, mean {row_sum.mean}");
    if (audit_.closure) {
      say("  as computed", "{computed_row_sum.min} to {computed_row_sum.max}, mean {computed_row_sum.mean}");
      say("  correction", "{closure} RMS (quadrature and sampling explain ",
          percent(audit_.closure_limit) + "): the scene is proven closed, so each row must sum to 1");
    }
    say("energy balance", "{energy_balance} amiss, {escaped} escaped");
    say("open scene",
        "{stray_rays.escaping} of the rays from its surfaces meet nothing, {stray_rays.to_backs} a black back (+- "
        "{stray_rays.standard_error})");
    say("residual", "{residual} after {iterations} iterations",
        audit_.converged           ? ""
        : audit_.interrupted       ? " - INTERRUPTED, the best so far"
        : !audit_.shortage.empty() ? " - OUT OF MEMORY, the best so far"
        : audit_.target_missed     ? ""  // said above
                                   : " - NOT CONVERGED");
    if (!audit_.shortage.empty()) { say("memory", "{shortage}"); }
  }

  void settings() {
    out_ += "settings\n";
    if (report_.options.refinement == radiosity::Refinement::a_posteriori) {
      row("refinement", audit_.target > 0.0 ? "bf, estimate at most " + formatted("%.3g", audit_.target) : "bf, until the time was used");
    } else {
      say("refinement", "f, epsilon {settings.epsilon}, min area {settings.min_area}, of lights {settings.light_epsilon}");
    }
    say("channels, threads, seed", "{settings.channels}, {settings.threads}, {settings.seed}");
    if (report_.options.reconstruction != radiosity::Reconstruction::none) {
      say("exposure", "{exposure}", report_.automatic_exposure ? " (automatic)" : "");
    }
    const bool mesh = report_.picture && report_.picture->method == PictureMethod::mesh;
    say("picture",
        std::string("{picture.width} x {picture.height}, of the ") + (mesh ? "mesh" : "objects (raycast)") + ", camera {picture.camera}");
  }

  void lists() {
    if (!audit_.warnings.empty()) { out_ += "warnings\n"; }
    for (const std::string& sentence : audit_.warnings) { out_ += "  " + sentence + "\n"; }
    out_ += audit_.left_out.empty() ? "left out\n  nothing\n" : "left out\n";
    for (const radiosity::LeftOut& item : audit_.left_out) {
      out_ += "  " + item.what + ": " + item.why + (item.saved.empty() ? "" : "; saved " + item.saved) +
              (item.seconds > 0.0 ? ", about " + formatted("%.2g", item.seconds) + " s" : "") + "\n";
    }
    constexpr std::size_t most = 40;
    out_ += "mean radiosity (W/m2)         area (m2)   R G B\n";
    for (std::size_t i = 0; i < audit_.surfaces.size() && i < most; ++i) {
      const radiosity::SurfaceMean& surface = audit_.surfaces[i];
      const radiosity::Color& c = surface.radiosity;
      std::string color = formatted("%.5g", c.x);
      if (!radiosity::is_grey(c)) { color += " " + formatted("%.5g", c.y) + " " + formatted("%.5g", c.z); }
      row(surface.name, formatted("%13.5g   ", surface.area) + color);
    }
    if (audit_.surfaces.size() > most) { out_ += "  ... and " + std::to_string(audit_.surfaces.size() - most) + " more; --json has all\n"; }
  }

  const Report& report_;
  const radiosity::Audit& audit_;
  Facts facts_;
  std::string out_;
};

}  // namespace

std::string to_text(const Report& report) { return Text(report).write(); }
std::string to_json(const Report& report) { return facts_of(report).json(); }

}  // namespace apps
