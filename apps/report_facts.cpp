// SPDX-License-Identifier: MIT
#include "apps/report.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <glm/vec3.hpp>

#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/left_out.hpp>

#include "apps/process.hpp"

namespace apps {
namespace {

// The largest memory that the process has held before the report, as far as it was measured.
std::optional<std::uint64_t> peak_bytes(const Report& report) {
  std::optional<std::uint64_t> peak;
  for (const radiosity::StageTime& stage : report.audit.stages) { peak = std::max(peak, stage.peak_bytes); }
  return report.picture_time ? std::max(peak, report.picture_time->peak_bytes) : peak;
}

void add_error(Facts& facts, const std::string& path, const radiosity::ErrorEstimate& error) {
  facts.add_all("%", path + ".", "relative_l2", error.relative_l2, "standard_error", error.standard_error, "low", error.low, "high",
                error.high);
  facts.add(path + ".wide", radiosity::is_wide(error));
}

void add_picture_error(Facts& facts, const radiosity::PictureError& picture) {
  add_error(facts, "error.picture", picture.error);
  facts.add("error.picture.audited", picture.audited);
  const auto share = [&](const char* path, const radiosity::ShareBounds& of) {
    facts.add(path, [of](JsonWriter& json) { json.value(std::array{of.least, of.most}); });
  };
  share("error.picture.over_2_levels", picture.over2);
  share("error.picture.over_8_levels", picture.over8);
  if (picture.worst) {
    facts.add_all("", "error.picture.worst_tile.", "column", picture.worst->column, "row", picture.worst->row);
    add_error(facts, "error.picture.worst_tile", picture.worst->error);
  } else {
    facts.add("error.picture.worst_tile", {});
  }
  facts.add_all("", "error.picture.", "points", picture.points, "rays", picture.rays);
}

void add_errors(Facts& facts, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  if (!audit.leaf_error) { return facts.add("error", {}); }
  if (audit.surface_error) { add_error(facts, "error", *audit.surface_error); }  // missing if no reconstruction was requested
  facts.add_all("", "error.", "points", audit.audit_points, "rays", audit.audit_rays);
  add_error(facts, "error.leaf", *audit.leaf_error);
  if (audit.mesh) {
    const radiosity::MeshRefinement& mesh = *audit.mesh;
    add_error(facts, "error.mesh.before", mesh.before);
    add_error(facts, "error.mesh.after", mesh.after);
    facts.add_all("", "error.mesh.", "faces_before", mesh.faces_before, "faces_after", mesh.faces_after);
    facts.add_all("%", "error.mesh.", "outlines_before", mesh.outlines_before, "outlines_after", mesh.outlines_after, "wanted",
                  mesh.wanted);
    facts.add("error.mesh.met", mesh.met);
  }
  if (audit.picture_error) {
    add_picture_error(facts, *audit.picture_error);
  } else if (report.picture) {
    facts.add("error.picture", {});
  }
}

// Stages of the same name (in a run repeated to meet its error target) are added up; of their peaks the last is the largest.
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
  facts.add_all(unit, path + ".", "min", range.min, "mean", range.mean, "max", range.max);
}

void add_settings(Facts& facts, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  facts.add("exposure", report.exposure, "%.5g");
  facts.add("exposure_automatic", report.automatic_exposure);
  facts.add("tone", std::string(name(report.tone)));
  facts.add_all("%.3g", "settings.", "epsilon", audit.epsilon, "min_area", audit.min_area);
  facts.add("settings.lit_part", audit.lit_part, "%.2g");
  facts.add("settings.light_epsilon", audit.light_epsilon, "%.3g");
  facts.add("settings.reflected_share", audit.reflected_share, "%.2g");
  facts.add("settings.error_target", report.options.error);
  facts.add("settings.solver", std::string(name(report.options.solver)));
  facts.add("settings.reconstruction", std::string(name(report.options.reconstruction)));
  facts.add("settings.channels", audit.channels);
  facts.add_all("1", "settings.", "threads", audit.threads, "seed", audit.seed);
  if (report.lightmap) {
    facts.add_all("1", "lightmap.", "width", report.lightmap->width, "height", report.lightmap->height);
    facts.add("lightmap.texel", report.lightmap->texel, "%.3g");
  } else {
    facts.add("lightmap", {});
  }
  if (!report.picture) { return facts.add("picture", {}); }
  const radiosity::Camera& camera = report.picture->camera;
  const auto vector = [&](const char* path, const glm::dvec3& v) { facts.add(path, [v](JsonWriter& json) { json.value(v); }); };
  facts.add("picture.camera", camera.name);
  vector("picture.eye", camera.eye);
  vector("picture.target", camera.eye + camera.forward);
  vector("picture.up", camera.up);
  facts.add("picture.fov", camera.field_of_view);
  facts.add_all("1", "picture.", "width", report.picture->width, "height", report.picture->height);
  facts.add("picture.method", std::string(name(report.picture->method)));
}

// Adds a list whose items `write` writes.
template <class Item, class Write>
void add_list(Facts& facts, const char* path, const std::vector<Item>& items, const Write& write) {
  facts.add(path, [&items, write](JsonWriter& json) { json.list(items, [&](const Item& item) { write(json, item); }); });
}

void add_lists(Facts& facts, const Report& report) {
  const radiosity::Audit& audit = report.audit;
  const auto sentence = [](JsonWriter& json, const std::string& text) { json.value(text); };
  add_list(facts, "taken_in", report.taken_in, sentence);
  add_list(facts, "warnings", audit.warnings, sentence);
  if (audit.stray) {
    const radiosity::StrayRays& stray = *audit.stray;
    facts.add_all("%", "stray_rays.", "escaping", stray.escaping, "to_backs", stray.to_backs, "standard_error", stray.standard_error,
                  "closed_share", stray.rays > 0 ? static_cast<double>(stray.closed_rays) / stray.rays : 0.0);
  } else {
    facts.add("stray_rays", {});
  }
  add_list(facts, "left_out", audit.left_out, [](JsonWriter& json, const radiosity::LeftOut& item) {
    json.object("what", item.what, "why", item.why, "saved", item.saved, "seconds", item.seconds);
  });
  add_list(facts, "surfaces", audit.surfaces, [](JsonWriter& json, const radiosity::SurfaceMean& surface) {
    json.object("name", surface.name, "area", surface.area, "radiosity", surface.radiosity);
  });
  add_list(facts, "files", report.files, sentence);
}

}  // namespace

Facts facts_of(const Report& report) {
  const radiosity::Audit& audit = report.audit;
  Facts facts;
  facts.add("program", std::string("halflight"));
  facts.add("version", std::string(version));
  facts.add("scene", report.scene);
  add_errors(facts, report);
  add_stages(facts, report);
  facts.add_all("", "", "polygons", audit.polygons, "nodes", audit.nodes, "leaves", audit.leaves, "leaf_splits", audit.leaf_splits);
  if (audit.imprinted) {
    const radiosity::ImprintedEdges& imprinted = *audit.imprinted;
    facts.add_all("", "discontinuities.", "edges", imprinted.edges, "faces", imprinted.faces, "limited", imprinted.limited, "not_looked_at",
                  imprinted.not_looked_at);
  } else {
    facts.add("discontinuities", {});
  }
  facts.add_all("", "", "links", audit.links, "link_splits", audit.link_splits, "ray_links", audit.ray_links, "stored_rays",
                audit.stored_rays, "rays_for_view", audit.rays_for_view, "clusters", audit.clusters, "cluster_links", audit.cluster_links,
                "rays", audit.rays, "rays_avoided", audit.rays_avoided, "pairs_clear", audit.pairs_clear, "pairs_blocked",
                audit.pairs_hidden);
  facts.add("bytes", audit.bytes, "B");
  add_range(facts, "proportion", audit.proportion, "%.2f");
  add_range(facts, "row_sum", audit.row_sum, "%.6f");
  add_range(facts, "computed_row_sum", audit.computed_row_sum, "%.6f");
  facts.add_all("%", "", "overfull", audit.overfull, "ray_correction", audit.ray_correction, "closure", audit.closure, "estimated_error",
                audit.estimated_error, "estimated_leaf_error", audit.estimated_leaf_error);
  facts.add_all("", "", "estimate_doubt", audit.estimate_doubt, "target_missed", audit.target_missed, "rounds_ended_by",
                audit.rounds_ended_by);
  facts.add_all("%", "", "energy_balance", audit.energy_balance, "escaped", audit.escaped);
  facts.add("residual", audit.residual, "%.2e");
  facts.add("iterations", audit.iterations, "1");
  add_list(facts, "residual_histories", audit.histories, [](JsonWriter& json, const std::vector<double>& history) { json.value(history); });
  facts.add("status", std::string(name(audit.status())));
  facts.add_all("", "", "converged", audit.status() == radiosity::RunStatus::converged, "interrupted", audit.interrupted, "shortage",
                audit.shortage, "coarsened", audit.coarsened);
  add_settings(facts, report);
  add_lists(facts, report);
  return facts;
}

}  // namespace apps
