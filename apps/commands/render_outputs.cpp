// SPDX-License-Identifier: MIT
#include "apps/commands/render_outputs.hpp"

#include <chrono>
#include <ctime>
#include <utility>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/audit/picture_error.hpp>
#include <radiosity/picture/lookup.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/memory.hpp>

#include "apps/audited_picture.hpp"
#include "apps/export/export_mesh.hpp"
#include "apps/export/viewer.hpp"
#include "apps/memory.hpp"
#include "apps/mesh_file.hpp"
#include "apps/ply.hpp"
#include "apps/png.hpp"
#include "apps/raycast_picture.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

class Stopwatch {
 public:
  [[nodiscard]] radiosity::StageTime stop(std::string name) const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
    return {std::move(name), wall.count(), static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC, radiosity::peak_memory()};
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

// The line below the title of a page: how large and how wrong the solution is.
std::string summary(const radiosity::Solution& solution) {
  const radiosity::Audit& audit = solution.audit;
  const std::string size = std::to_string(audit.leaves) + " patches of " + std::to_string(audit.polygons) + " input faces";
  return size + (audit.surface_error ? ", error " + percent(audit.surface_error->relative_l2) + " of the reflected light" : "");
}

}  // namespace

std::optional<RenderFormat> render_format(const std::string& path) {
  if (path.size() > 4 && path.ends_with(".png")) { return RenderFormat::png; }
  if (path.size() > 4 && path.ends_with(".ply")) { return RenderFormat::ply; }
  if (has_ending(path, ".html")) { return RenderFormat::html; }
  return export_format(path) != nullptr ? std::optional(RenderFormat::exported) : std::nullopt;
}

std::string render_endings() { return ".png, .ply, .glb, .obj or .html"; }

bool has_picture(const RenderOptions& options) {
  for (const std::string& output : options.outputs) {
    if (render_format(output) == RenderFormat::png) { return true; }
  }
  return false;
}

std::optional<Picture> Artist::draw(const radiosity::Mesh& mesh, const radiosity::Frame& frame, const radiosity::Control& control) const {
  const double by = exposure(mesh);
  if (options_.method == PictureMethod::mesh) { return apps::draw(mesh, view_, by, 4, control.cancel); }
  const radiosity::Lookup lookup(file_.scene, mesh, frame);
  return apps::draw(lookup, view_, by, options_.solver.threads, 4, control);
}

std::optional<radiosity::PictureError> Artist::audit(const Picture& picture, double exposure, const radiosity::AuditGoal& goal,
                                                     const radiosity::Control& control) {
  if (!asked_) {
    audit_ = radiosity::PictureAudit::make(file_.scene);
    asked_ = true;
  }
  if (!audit_) { return std::nullopt; }
  return audit_->measure(audited(picture, view_, exposure), goal, options_.solver.threads, options_.solver.seed, control);
}

std::optional<std::vector<RenderOutput>> encode(const RenderOptions& options, const SceneFile& file, const Camera& camera, Artist& artist,
                                                const radiosity::Solution& solution, const radiosity::Control& control, Report& report) {
  if (control.cancelled()) { return std::nullopt; }
  std::vector<RenderOutput> outputs;
  std::string png;
  if (has_picture(options)) {
    const Stopwatch watch;
    const auto picture = artist.draw(solution.mesh, solution.frame, control);
    if (!picture) { return std::nullopt; }
    png = to_png(*picture);
    report.picture = PictureReport{camera.name, artist.size().width, artist.size().height, options.method};
    std::vector<radiosity::StageTime> stages{watch.stop("picture")};
    leave_out_others(stages);
    report.picture_time = stages.front();
    if (!report.audit.picture_error && options.solver.audit_points > 0) {
      const Stopwatch audit_watch;
      report.audit.picture_error =
          artist.audit(*picture, report.exposure, radiosity::goal_to_know(report.audit, options.solver.audit_points), control);
      stages = {audit_watch.stop("picture audit")};
      leave_out_others(stages);
      report.audit.stages.push_back(stages.front());
      report.audit.interrupted = report.audit.interrupted || control.cancelled();  // the picture is complete, its error not measured
    }
  }
  std::optional<ExportMesh> exported;
  for (const std::string& path : options.outputs) {
    outputs.push_back({path, {}});
    switch (*render_format(path)) {
      case RenderFormat::png:
        outputs.back().bytes = png;
        break;
      case RenderFormat::ply:
        outputs.back().bytes = to_ply(solution.mesh, radiosity::surfaces(file.scene), report.exposure);
        break;
      case RenderFormat::html:
        outputs.back().bytes = viewer_page(file, solution, camera, report.exposure, options.scene, summary(solution));
        break;
      case RenderFormat::exported:
        if (!exported) { exported = options.onto_input ? given_mesh(file, solution) : solution_mesh(file, solution); }
        if (exported) { outputs.back().bytes = export_format(path)->write(*exported, report.exposure); }
        break;
    }
    report.files.push_back(path);
  }
  if (!options.json.empty()) {
    report.files.push_back(options.json);
    outputs.push_back({options.json, to_json(report)});
  }
  return outputs;
}

}  // namespace apps
