// SPDX-License-Identifier: MIT
#pragma once

// What `halflight render` is asked for, and what it writes: the picture, drawn and audited, the mesh, and the report.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <radiosity/audit/picture_error.hpp>
#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/intake/to_scene.hpp"
#include "apps/report.hpp"
#include "apps/scene_file.hpp"

namespace apps {

struct Argument;

// By measurement: what a picture in gathered light needs of the solution.
inline constexpr double gathered_epsilon = 0.01, gathered_min_area = 2e-4;

enum class ErrorOf { picture, surfaces };

// As it was asked for.
struct Exposure {
  double factor = 1.0;
  bool of_automatic = false;  // times the automatic one

  // A factor above 0, or stops (powers of two) from the automatic exposure, such as 1ev or -0.5ev.
  [[nodiscard]] static std::optional<Exposure> parse(std::string_view text);
};

struct RenderOptions {
  std::string scene;
  ModelOptions model;
  std::vector<std::string> outputs;  // pictures and meshes, by their endings
  bool onto_input = false;           // exported: the user's polygons, not those of the solution
  std::string light;                 // a .light file that is drawn instead of a new solution; empty: none
  std::string lightmap;              // of what is exported; empty: none
  std::optional<double> texel;       // of the lightmap, metres
  std::string json;                  // empty: none
  std::string camera;                // empty: the first of the file, or the automatic one
  std::optional<radiosity::PictureSize> size;
  std::optional<Exposure> exposure;
  radiosity::ToneCurve tone = radiosity::ToneCurve::linear;
  PictureMethod method = PictureMethod::gather;
  std::optional<double> epsilon, min_area;  // default: what suits the outputs
  bool quiet = false;
  std::optional<ErrorOf> error_of;      // default: of the picture when there is one
  std::optional<std::uint64_t> memory;  // bytes that the process may hold
  radiosity::Options solver;
};

// What each option of `halflight render` is, and where its value goes.
[[nodiscard]] std::vector<Argument> render_arguments(RenderOptions& options);

enum class RenderFormat { png, hdr, pfm, light, ply, html, exported };

// By the ending of the name.
[[nodiscard]] std::optional<RenderFormat> render_format(const std::string& path);

// Does the name end as those of pictures do: .png, .hdr or .pfm?
[[nodiscard]] bool is_picture(const std::string& path);

// ".png, .ply, ... or .html"
[[nodiscard]] std::string render_endings();

[[nodiscard]] bool has_picture(const RenderOptions& options);

// The solution's settings as they are asked for. What is seen in gathered light alone is solved coarser: direct light is found anew,
// and what the mesh smears is averaged over all that a point sees, so that time does more for the picture than for the mesh.
[[nodiscard]] radiosity::Options solver_options(const RenderOptions& options);

// Draws a solution as it will be shown, and audits what it has drawn.
class Artist {
 public:
  Artist(const RenderOptions& options, const SceneFile& file, const radiosity::Camera& camera)
      : options_{options},
        file_{file},
        camera_{camera},
        view_{radiosity::make_view(camera, options.size.value_or(camera.size.value_or(radiosity::PictureSize{})))} {}

  [[nodiscard]] const RenderOptions& options() const { return options_; }
  [[nodiscard]] const SceneFile& file() const { return file_; }
  [[nodiscard]] const radiosity::Camera& camera() const { return camera_; }
  [[nodiscard]] radiosity::Tone tone(const radiosity::Mesh& mesh) const;
  [[nodiscard]] radiosity::PictureSize size() const { return view_.size; }
  [[nodiscard]] const radiosity::View& view() const { return view_; }
  [[nodiscard]] radiosity::Viewpoint viewpoint() const {
    return {view_.eye, [view = view_](const glm::dvec3& p, const glm::dvec3& n) { return view.share(p, n); }, view_.pixel_area()};
  }
  // About what the picture took (audit_effort.hpp).
  [[nodiscard]] std::uint64_t worth(const radiosity::Audit& audit) const;
  // Nothing when interrupted.
  [[nodiscard]] std::optional<radiosity::Picture> draw(const radiosity::Mesh& mesh, const radiosity::Frame& frame,
                                                       const radiosity::Tone& tone, const radiosity::Control& control) const;
  [[nodiscard]] std::optional<radiosity::PictureError> audit(const radiosity::Picture& picture, const radiosity::Tone& tone,
                                                             const radiosity::AuditGoal& goal, const radiosity::Control& control);

 private:
  const RenderOptions& options_;
  const SceneFile& file_;
  const radiosity::Camera& camera_;
  radiosity::View view_;
  std::optional<radiosity::PictureAudit> audit_;
  bool asked_ = false;
};

struct RenderOutput {
  std::string path;
  std::string bytes;
};

// The picture in each format that is asked for.
[[nodiscard]] std::vector<RenderOutput> encode(const RenderOptions& options, const radiosity::Picture& picture,
                                               const radiosity::Tone& tone);

// Everything that is to be written, in memory; the report is completed. Nothing when interrupted.
[[nodiscard]] std::optional<std::vector<RenderOutput>> encode(Artist& artist, const radiosity::Solution& solution,
                                                              const radiosity::Control& control, Report& report);

}  // namespace apps
