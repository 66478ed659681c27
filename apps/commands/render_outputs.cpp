// SPDX-License-Identifier: MIT
#include "apps/commands/render_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <raycast/object.hpp>
#include <raycast/scene.hpp>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/camera/gather_picture.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/result/stopwatch.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/commands/picture_warnings.hpp"
#include "apps/export/export_mesh.hpp"
#include "apps/light_file.hpp"
#include "apps/memory.hpp"
#include "apps/mesh_file.hpp"
#include "apps/picture_file.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

std::string encoded(const radiosity::Picture& picture, RenderFormat format, const radiosity::Tone& tone) {
  return format == RenderFormat::png ? to_png(picture, tone) : format == RenderFormat::hdr ? to_hdr(picture) : to_pfm(picture);
}

// The mesh to export; also appends its lightmap to the outputs if one is requested, which has a rectangle for each face, suns included.
std::optional<ExportMesh> exported_mesh(const RenderOptions& options, const SceneFile& file, const radiosity::Solution& solution,
                                        const radiosity::Tone& tone, std::vector<RenderOutput>& outputs, Report& report) {
  std::optional<ExportMesh> mesh;
  if (options.onto_input) {
    mesh = given_mesh(file, solution);
  } else {
    mesh = solution_mesh(file, solution, options.lightmap.empty() ? without_suns(file, solution.shown()) : solution.mesh);
  }
  if (!mesh || options.lightmap.empty()) { return mesh; }
  const std::optional<LightTexture> texture = options.onto_input ? given_texture(file, solution, tone, options.texel, *mesh)
                                                                 : solution_texture(solution, tone, options.texel, *mesh);
  if (!texture) { return mesh; }
  mesh->texture = to_png(texture->picture, tone);
  mesh->texture_name = std::filesystem::path(options.lightmap).filename().string();
  const auto format = *render_format(options.lightmap);
  outputs.push_back({options.lightmap, format == RenderFormat::png ? mesh->texture : encoded(texture->picture, format, tone)});
  report.files.push_back(options.lightmap);
  report.lightmap =
      LightmapReport{texture->picture.width, texture->picture.height, texture->texel, options.texel && *options.texel < texture->texel};
  return mesh;
}

// The line below the title of a page: the size and the error of the solution.
std::string summary(const radiosity::Solution& solution) {
  const radiosity::Audit& audit = solution.audit;
  const std::string size = std::to_string(audit.leaves) + " patches of " + std::to_string(audit.polygons) + " input faces";
  return size + (audit.surface_error ? ", error " + percent(audit.surface_error->relative_l2) + " of the reflected light" : "");
}

}  // namespace

std::optional<Exposure> Exposure::parse(std::string_view text) {
  const bool stops = text.ends_with("ev") || text.ends_with("EV");
  if (stops) { text.remove_suffix(2); }
  if (stops && text.starts_with('+') && !text.starts_with("+-")) { text.remove_prefix(1); }
  const auto value = number_in<double>(text);
  if (!value || !std::isfinite(*value)) { return std::nullopt; }
  if (stops) { return std::abs(*value) <= 64.0 ? std::optional(Exposure{std::exp2(*value), true}) : std::nullopt; }
  return *value > 0.0 ? std::optional(Exposure{*value, false}) : std::nullopt;
}

std::optional<RenderFormat> render_format(const std::string& path) {
  if (has_ending(path, ".png")) { return RenderFormat::png; }
  if (has_ending(path, ".hdr")) { return RenderFormat::hdr; }
  if (has_ending(path, ".pfm")) { return RenderFormat::pfm; }
  if (has_ending(path, ".light")) { return RenderFormat::light; }
  if (has_ending(path, ".ply")) { return RenderFormat::ply; }
  if (has_ending(path, ".html")) { return RenderFormat::html; }
  return export_format(path) != nullptr ? std::optional(RenderFormat::exported) : std::nullopt;
}

bool is_picture(const std::string& path) {
  const auto format = render_format(path);
  return format == RenderFormat::png || format == RenderFormat::hdr || format == RenderFormat::pfm;
}

std::string render_endings() { return ".png, .hdr, .pfm, .light, .ply, .glb, .obj or .html"; }

bool has_picture(const RenderOptions& options) { return std::any_of(options.outputs.begin(), options.outputs.end(), is_picture); }

radiosity::Options solver_options(const RenderOptions& options) {
  radiosity::Options solver = options.solver;
  const auto is_gathered = [](const std::string& path) { return is_picture(path) || render_format(path) == RenderFormat::light; };
  const bool mesh_is_seen =
      options.method != PictureMethod::gather || !std::all_of(options.outputs.begin(), options.outputs.end(), is_gathered);
  if (!options.outputs.empty() && !mesh_is_seen) {
    solver.epsilon = gathered_epsilon;
    solver.min_area = gathered_min_area;
  }
  solver.epsilon = options.epsilon.value_or(solver.epsilon);
  solver.min_area = options.min_area.value_or(solver.min_area);
  if (options.outputs.empty()) { solver.reconstruction = radiosity::Reconstruction::none; }
  return solver;
}

radiosity::Tone Artist::tone(const radiosity::Mesh& mesh) const {
  const bool automatic = !options_.exposure || options_.exposure->of_automatic;
  const double factor = options_.exposure ? options_.exposure->factor : 1.0;
  return {automatic ? factor * radiosity::automatic_exposure(mesh, file_.scene, view_) : factor, options_.tone};
}

Artist::Light Artist::light_of(const radiosity::Mesh& mesh, const radiosity::Tone& tone) {
  Light light{mesh.corners.size(), radiosity::Color{0.0}, tone.exposure};
  for (const radiosity::MeshCorner& corner : mesh.corners) { light.sum += corner.radiosity; }
  return light;
}

bool Artist::has_drawn(const radiosity::Mesh& mesh, const radiosity::Tone& tone) const {
  return picture_ && light_of(mesh, tone) == shown_;
}

const radiosity::Picture* Artist::draw(const radiosity::Mesh& mesh, const radiosity::Frame& frame, const radiosity::Tone& tone,
                                       const radiosity::Control& control) {
  if (has_drawn(mesh, tone)) { return &*picture_; }
  shown_ = light_of(mesh, tone);
  if (method_ == PictureMethod::gather) {
    const radiosity::FinalGather light{file_.scene, mesh, frame};
    picture_ = radiosity::draw(light, view_, tone, options_.solver.threads, control, memory_left(options_.memory));
    if (!picture_ && !control.cancelled()) { method_ = PictureMethod::mesh; }
  }
  if (method_ == PictureMethod::mesh) { picture_ = radiosity::draw(mesh, view_, tone, 4, control.cancel); }
  return picture_ ? &*picture_ : nullptr;
}

const radiosity::Picture* Artist::draw_mesh(const radiosity::Mesh& mesh, const radiosity::Tone& tone) {
  constexpr unsigned samples = 2;  // along a pixel: few, so that an interrupted run ends soon
  shown_ = {};
  picture_ = radiosity::draw(mesh, view_, tone, samples);
  return &*picture_;
}

const radiosity::PictureAudit* Artist::meter() {
  if (!asked_) {
    audit_ = radiosity::PictureAudit::make(file_.scene);
    asked_ = true;
  }
  return audit_ ? &*audit_ : nullptr;
}

std::optional<radiosity::PictureError> Artist::audit(const radiosity::Picture& picture, const radiosity::Tone& tone,
                                                     const radiosity::AuditGoal& goal, const radiosity::Control& control,
                                                     std::string* reason) {
  const radiosity::PictureAudit* const its = meter();
  if (!its) {
    if (reason) { *reason = "the paths of this scene do not end, for its surfaces reflect nearly all light"; }
    return std::nullopt;
  }
  return its->measure(radiosity::audited(picture, view_, tone), goal, options_.solver.threads, options_.solver.seed, control, reason);
}

std::uint64_t Artist::worth() {
  const radiosity::PictureAudit* const its = meter();
  if (!its || method_ == PictureMethod::mesh) { return 0; }
  return radiosity::picture_worth(its->ray_work(), view_.size.width, view_.size.height);
}

std::vector<RenderOutput> encode(const RenderOptions& options, const radiosity::Picture& picture, const radiosity::Tone& tone) {
  std::vector<RenderOutput> outputs;
  for (const std::string& path : options.outputs) {
    if (is_picture(path)) { outputs.push_back({path, encoded(picture, *render_format(path), tone)}); }
  }
  return outputs;
}

namespace {

// Draws the picture, and enters its time and error in the report. An interrupted run ends soon, so it does not gather light any more: its
// picture shows the mesh, and is not audited.
const radiosity::Picture* drawn(Artist& artist, const radiosity::Solution& solution, const radiosity::Tone& tone,
                                const radiosity::Control& control, Report& report) {
  const RenderOptions& options = artist.options();
  std::vector<radiosity::StageTime> stages;
  radiosity::detail::Stopwatch watch(stages);
  const radiosity::Mesh& mesh = artist.method() == PictureMethod::mesh ? solution.shown() : solution.mesh;
  const bool begin = !control.cancelled() || artist.has_drawn(mesh, tone);
  const radiosity::Picture* picture = begin ? artist.draw(mesh, solution.frame, tone, control) : nullptr;
  PictureMethod method = artist.method();
  const char* const gathering = "the gathering of light for the picture, which shows the mesh";
  if (!picture) {
    report.audit.picture_error.reset();  // of a picture that is not shown
    report.audit.left_out.push_back(
        {method == PictureMethod::gather ? gathering : "12 of the 16 samples of each pixel of the picture", "the run was interrupted", ""});
    method = PictureMethod::mesh;
    picture = artist.draw_mesh(solution.shown(), tone);
  } else if (method != options.method) {
    report.audit.picture_error.reset();  // an earlier picture, which did fit into memory, may have left one
    report.audit.left_out.push_back({gathering, "it would take more than the memory allowed", ""});
  }
  report.picture = PictureReport{artist.camera(), artist.size().width, artist.size().height, method};
  watch.lap("picture");
  const bool automatic = !options.exposure || options.exposure->of_automatic;
  if (std::string sentence = warning_of_picture(*picture, artist.file(), artist.view(), automatic ? &tone : nullptr, report.audit.surfaces);
      !sentence.empty()) {
    report.audit.warnings.push_back(std::move(sentence));
  }
  const bool wanted = !report.audit.picture_error && options.solver.audit_points > 0;
  if (wanted && !control.cancelled()) {
    const radiosity::AuditGoal goal = radiosity::goal_to_know(report.audit, options.solver.audit_points, artist.worth());
    report.audit.picture_error = artist.audit(*picture, tone, goal, control, &report.picture_error_unknown);
    watch.lap("picture audit");
  }
  report.audit.interrupted = report.audit.interrupted || control.cancelled();
  if (wanted && !report.audit.picture_error && report.audit.interrupted) {
    report.audit.left_out.push_back({"the error of the picture", "the run was interrupted", ""});
  }
  leave_out_others(stages);
  report.picture_time = stages.front();
  report.audit.stages.insert(report.audit.stages.end(), stages.begin() + 1, stages.end());
  return picture;
}

}  // namespace

std::vector<RenderOutput> encode(Artist& artist, const radiosity::Solution& solution, const radiosity::Control& control, Report& report) {
  const RenderOptions& options = artist.options();
  const SceneFile& file = artist.file();
  std::vector<RenderOutput> outputs;
  const radiosity::Tone tone = artist.tone(solution.mesh);
  report.exposure = tone.exposure;
  report.tone = tone.curve;
  report.automatic_exposure = !options.exposure || options.exposure->of_automatic;
  const radiosity::Picture* const picture = has_picture(options) ? drawn(artist, solution, tone, control, report) : nullptr;
  std::optional<ExportMesh> exported;
  const auto is_exported = [&](const std::string& path) {
    return render_format(path) == RenderFormat::exported || (options.onto_input && has_ending(path, ".ply"));
  };
  if (std::any_of(options.outputs.begin(), options.outputs.end(), is_exported)) {
    exported = exported_mesh(options, file, solution, tone, outputs, report);
  }
  for (const std::string& path : options.outputs) {
    const RenderFormat format = *render_format(path);
    std::string bytes;
    if (is_picture(path)) {
      bytes = encoded(*picture, format, tone);
    } else if (format == RenderFormat::light) {
      bytes = to_light_file(solution.mesh, solution.frame, file.scene, {options.scene, file.text, file.beside, options.model});
    } else if (format == RenderFormat::html) {
      bytes = viewer_page(file, solution, artist.camera(), tone.exposure, options.scene, summary(solution));
    } else if (format == RenderFormat::exported) {
      if (exported) { bytes = export_format(path)->write(*exported, tone); }
    } else {
      bytes = options.onto_input && exported
                  ? to_ply(*exported, tone)
                  : to_ply(with_sky_of_file(file, in_depth_order(file, solution, without_suns(file, solution.shown()))),
                           radiosity::surfaces(file.scene), tone);
    }
    outputs.push_back({path, std::move(bytes)});
    report.files.push_back(path);
  }
  if (!options.json.empty()) {
    report.files.push_back(options.json);
    outputs.push_back({options.json, to_json(report)});
  }
  return outputs;
}

}  // namespace apps
