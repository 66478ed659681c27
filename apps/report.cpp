// SPDX-License-Identifier: MIT
#include "apps/report.hpp"

#include <string_view>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/left_out.hpp>

#include "apps/scene_file.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

std::string error_text(const std::optional<radiosity::ErrorEstimate>& error) {
  if (!error) { return "not measured"; }
  if (error->high == 0.0) { return "none"; }
  // The error is lost in the noise of path tracing, or not known to within its own size.
  if (radiosity::is_wide(*error)) { return "below " + percent(error->high); }
  return percent(error->relative_l2) + "  (" + percent(error->low) + " to " + percent(error->high) + ")";
}

// Noise hides whether a pixel is off if it is larger than the levels; then next to nothing is known about the share of such pixels.
bool is_unknown(const radiosity::ShareBounds& share) { return share.most - share.least > 0.9; }

std::string share_text(const radiosity::ShareBounds& share) {
  const std::string least = percent(share.least), most = percent(share.most);
  if (least == most) { return least; }
  return share.least == 0.0 ? "at most " + most : share.most == 1.0 ? "at least " + least : least + " to " + most;
}

// The shares of the pixels that are more than 2 and 8 levels off.
std::string shares_text(const radiosity::ShareBounds& over2, const radiosity::ShareBounds& over8) {
  if (is_unknown(over2) && is_unknown(over8)) { return "unknown: the paths at a pixel are noisier than that"; }
  const auto text = [](const radiosity::ShareBounds& share) { return is_unknown(share) ? "unknown" : share_text(share); };
  return text(over2) + ", " + text(over8) + " of the pixels";
}

// Is the interval too wide to tell how large the error is?
bool leaves_open(const radiosity::ErrorEstimate& error) {
  return error.high > radiosity::negligible_error && error.high - error.low > std::max(0.01, 1.5 * error.relative_l2);
}

std::string lost_rays(const radiosity::StrayRays& stray) {
  const std::string lost = (stray.closed_lost > 0 ? std::to_string(stray.closed_lost) : "none") + " of ";
  if (stray.closed_rays == stray.rays) {
    return lost + std::to_string(stray.rays) + " rays left the scene, so each row is taken to sum to 1";
  }
  const double share = static_cast<double>(stray.closed_rays) / static_cast<double>(stray.rays);
  return lost + std::to_string(stray.closed_rays) + " rays left parts of the scene, " + percent(share) +
         " of its area, so each row there is taken to sum to 1";
}

std::string text_row(std::string_view label, const std::string& value) { return "  " + left(std::string(label), 24, 1) + value + "\n"; }

class Text {
 public:
  explicit Text(const Report& report) : report_(report), audit_(report.audit), facts_(facts_of(report)) {}

  std::string write() {
    out_ = report_.scene + "\n";
    if (!report_.taken_in.empty()) { out_ += "taken in\n"; }
    for (const std::string& sentence : report_.taken_in) { out_ += "  " + sentence + "\n"; }
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
  void row(std::string_view label, const std::string& value) { out_ += text_row(label, value); }
  // A sentence that names facts; left out if one of them is not known. `more` is appended unchanged.
  void say(std::string_view label, std::string_view sentence, const std::string& more = {}) {
    if (const auto text = facts_.text(sentence)) { row(label, *text + more); }
  }

  void errors() {
    out_ += "error (RMS, relative to the RMS of the reflected radiosity; 95 % interval)\n";
    if (audit_.picture_error) {
      out_ += picture_error_text(*audit_.picture_error, report_.picture ? report_.picture->camera.name : "");
    } else if (report_.picture && !report_.picture_error_unknown.empty()) {
      row("picture " + report_.picture->camera.name, "unknown: " + report_.picture_error_unknown);
    }
    if (report_.options.reconstruction != radiosity::Reconstruction::none) { row("surfaces", error_text(audit_.surface_error)); }
    row("leaf constants", error_text(audit_.leaf_error));
    const auto& surfaces = audit_.surface_error ? audit_.surface_error : audit_.leaf_error;
    if ((surfaces && leaves_open(*surfaces)) || (audit_.picture_error && leaves_open(audit_.picture_error->error))) {
      row("", "wide: an audit takes at most about as long as what it judges, or " +
                  grouped(radiosity::rays_to_know_a_point * report_.options.audit_points) + " plain rays; --audit " +
                  std::to_string(4 * std::uint64_t{report_.options.audit_points}) + " allows four times as many");
    }
    if (audit_.mesh) { mesh(*audit_.mesh); }
    if (audit_.estimated_error) {
      const bool smooth = report_.options.reconstruction < radiosity::Reconstruction::constant;
      say("estimated from links", smooth ? "{estimated_error} of the surfaces, {estimated_leaf_error} of the leaves" : "{estimated_error}",
          audit_.generations > 0 ? ", after " + std::to_string(audit_.generations) + " generations" : "");
      if (!audit_.estimate_doubt.empty()) { say("", "{estimate_doubt}"); }
    }
    if (audit_.target_missed) {
      const double target = report_.options.error.value_or(audit_.target);
      const bool above = surfaces && surfaces->low > target && (!audit_.picture_error || audit_.picture_error->error.low > target);
      row("", (above ? "TARGET MISSED: the error is more than " : "TARGET MISSED: the error is not known to be within ") + percent(target) +
                  (audit_.rounds_ended_by.empty() ? "" : "; ended by " + audit_.rounds_ended_by));
    }
    say("path-traced points", "{error.points}, {error.rays} rays");
  }

  void mesh(const radiosity::MeshRefinement& mesh) {
    const bool changed = mesh.after.relative_l2 != mesh.before.relative_l2;
    row("mesh, against gather", error_text(mesh.before) + (changed ? " -> " + error_text(mesh.after) : ""));
    row("", grouped(mesh.faces_before) + (changed ? " -> " + grouped(mesh.faces_after) : "") + " faces" +
                (mesh.met ? "" : "; NOT within " + percent(mesh.wanted)));
    if (mesh.outlines_before > 0.0) {
      row("  of that by outlines", percent(mesh.outlines_before) + (changed ? " -> " + percent(mesh.outlines_after) : ""));
    }
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
    say("nodes, leaves",
        audit_.leaf_splits > 0 ? "{nodes}, {leaves}; {leaf_splits} split for the light of links that they had" : "{nodes}, {leaves}");
    say("proportions", "{proportion.min} to {proportion.max}, mean {proportion.mean} (regular polygon: 1)");
    if (audit_.imprinted) { edges(*audit_.imprinted); }
    say("links",
        audit_.stored_rays > 0 && audit_.clusters > 0
            ? "{links}, {ray_links} of them made of {stored_rays} stored rays, {cluster_links} with one of {clusters} clusters of lamps"
        : audit_.clusters > 0    ? "{links}, {cluster_links} of them with one of {clusters} clusters"
        : audit_.stored_rays > 0 ? "{links}, {ray_links} of them made of {stored_rays} stored rays"
        : audit_.link_splits > 0 ? "{links}; {link_splits} more were split for the light that they carry"
                                 : "{links}");
    say("rays", "{rays} cast, {rays_avoided} avoided: {pairs_clear} pairs proven clear, {pairs_blocked} proven blocked");
    row("memory",
        facts_.text("{peak_bytes.process} at the peak of the process, ").value_or("") + *facts_.text("{bytes} held by the result"));
  }

  void edges(const radiosity::ImprintedEdges& imprinted) {
    const auto faces = [](std::uint64_t n) { return grouped(n) + " " + plural(n, "face"); };
    std::string text = grouped(imprinted.edges) + " imprinted on " + faces(imprinted.faces);
    if (imprinted.limited > 0) { text += "; limit reached on " + grouped(imprinted.limited); }
    if (imprinted.not_looked_at > 0) {
      text += "; not looked for on " + faces(imprinted.not_looked_at) + ": too many faces, lamps and objects";
    }
    row("edges of shadows", text);
  }

  void checks() {
    out_ += "checks\n";
    say("row sums", "{row_sum.min} to {row_sum.max}, mean {row_sum.mean}");
    if (audit_.overfull > 0.0) {
      say("  above 1.1", "on {overfull} of the area, as on slivers and in gaps narrower than patches; more than 1 cannot be: made 1 there");
    }
    if (audit_.closure || audit_.stored_rays > 0) {
      say("  as computed", "{computed_row_sum.min} to {computed_row_sum.max}, mean {computed_row_sum.mean}");
    }
    if (audit_.stored_rays > 0) { say("  noise of rays", "{ray_correction} RMS, taken out of the row sums"); }
    if (audit_.closure) {
      say("  correction", "{closure} RMS (quadrature and sampling explain ",
          percent(audit_.closure_limit) +
              "): " + (audit_.stray ? lost_rays(*audit_.stray) : "the scene is proven closed, so each row must sum to 1"));
    }
    say("energy balance", "{energy_balance} amiss, {escaped} escaped");
    say("open scene",
        "{stray_rays.escaping} of the rays from its surfaces meet nothing, {stray_rays.to_backs} a black back (+- "
        "{stray_rays.standard_error})");
    say("residual", "{residual} after {iterations} " + plural(audit_.iterations, "iteration"));
    row("status", status());
    if (!audit_.shortage.empty()) { say("memory", "{shortage}"); }
  }

  [[nodiscard]] std::string status() const {
    using Status = radiosity::RunStatus;
    switch (audit_.status()) {
      case Status::interrupted:
        return "INTERRUPTED, the best so far";
      case Status::out_of_memory:
        return "OUT OF MEMORY, the best so far";
      case Status::target_missed:
        return "TARGET MISSED, as told above";
      case Status::estimate_refuted:
        return "ESTIMATE REFUTED: solved as far as the links tell, but path tracing found more than three times their error";
      case Status::far_off:
        return "FAR OFF: solved as far as the links tell, but path tracing found the result more than a quarter off, or most pixels wrong";
      case Status::error_unknown:
        return "ERROR UNKNOWN: by the links more than half of the light may be wrong, and path tracing cannot tell that it is not";
      case Status::not_converged:
        return "NOT CONVERGED: the residual is larger than asked for";
      case Status::converged:
        break;
    }
    return "converged";
  }

  void settings() {
    out_ += "settings\n";
    if (report_.options.refinement == radiosity::Refinement::a_posteriori) {
      row("refinement", audit_.target > 0.0 ? "bf, estimate at most " + formatted("%.3g", audit_.target) : "bf, until the time was used");
    } else {
      say("refinement", "f, epsilon {settings.epsilon}, min area {settings.min_area}, of lights {settings.light_epsilon}",
          audit_.coarsened ? ": larger than asked for, to end " + std::string(audit_.interrupted ? "soon" : "within the memory") : "");
      if (audit_.lit_part < 1.0) { say("", "min area of what is lit, {settings.lit_part} of the scene: its lamps light no more"); }
      if (audit_.reflected_share && *audit_.reflected_share < 0.25) {
        row("",
            "of lights finer: the reflected light is " + formatted("%.2g", *audit_.reflected_share) + " as bright as the mean emission");
      }
    }
    if (audit_.rays_for_view) { row("", "stored rays more and finer where the camera looks, for nothing but its picture is written"); }
    say("channels, threads, seed", "{settings.channels}, {settings.threads}, {settings.seed}");
    if (report_.options.reconstruction != radiosity::Reconstruction::none) {
      say("exposure, tone", "{exposure}" + std::string(report_.automatic_exposure ? " (automatic)" : "") + ", {tone}");
    }
    constexpr const char* shows[] = {"of the mesh", "of the objects, in gathered light"};
    const auto method = static_cast<std::size_t>(report_.picture ? report_.picture->method : PictureMethod::mesh);
    const bool coarser = report_.lightmap && report_.lightmap->coarser;
    say("lightmap", "{lightmap.width} x {lightmap.height}, texels of {lightmap.texel} m",
        coarser ? ", larger than asked for, because such small ones do not fit into a picture" : "");
    say("picture", std::string("{picture.width} x {picture.height}, ") + shows[method] + ", camera {picture.camera}");
    if (report_.picture) { row("", "--camera \"" + camera_text(report_.picture->camera) + "\""); }
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
    out_ += and_more(audit_.surfaces.size(), most, "; --json has all");
  }

  const Report& report_;
  const radiosity::Audit& audit_;
  Facts facts_;
  std::string out_;
};

}  // namespace

std::string picture_error_text(const radiosity::PictureError& picture, const std::string& camera) {
  std::string text = text_row("picture " + camera, error_text(picture.error));
  text += text_row("  off by 2, 8 of 255", shares_text(picture.over2, picture.over8));
  if (picture.worst) {
    text += text_row("  worst sixteenth", error_text(picture.worst->error) + ", column " + std::to_string(picture.worst->column + 1) +
                                              ", row " + std::to_string(picture.worst->row + 1) + " of 4");
  }
  return text + text_row("  path-traced pixels", grouped(picture.points) + ", " + grouped(picture.rays) + " rays");
}

std::string to_text(const Report& report) { return Text(report).write(); }
std::string to_json(const Report& report) { return facts_of(report).json(); }

}  // namespace apps
