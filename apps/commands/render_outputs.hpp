// SPDX-License-Identifier: MIT
#pragma once

// The options of `halflight render`, and its outputs: the picture, drawn and audited, the mesh, and the report.

#include <cstddef>
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

// By measurement: the accuracy of the solution that suffices for a picture in gathered light.
inline constexpr double gathered_epsilon = 0.01, gathered_min_area = 2e-4;

enum class ErrorOf { picture, surfaces };

// The exposure as given on the command line.
struct Exposure {
  double factor = 1.0;
  bool of_automatic = false;  // is the factor relative to the automatic exposure?

  // Parses a factor above 0, or stops (powers of two) relative to the automatic exposure, such as 1ev or -0.5ev.
  [[nodiscard]] static std::optional<Exposure> parse(std::string_view text);
};

struct RenderOptions {
  std::string scene;
  ModelOptions model;
  std::vector<std::string> outputs;  // pictures and meshes, by their endings
  bool onto_input = false;           // is the mesh of the input file exported instead of that of the solution?
  std::string light;                 // a .light file to draw instead of a new solution; empty: none
  std::string lightmap;              // of the exported mesh; empty: none
  std::optional<double> texel;       // edge length of a texel of the lightmap, metres
  std::string json;                  // empty: none
  std::string camera;                // empty: the first one of the file, or the automatic one
  std::optional<radiosity::PictureSize> size;
  std::optional<Exposure> exposure;
  radiosity::ToneCurve tone = radiosity::ToneCurve::linear;
  PictureMethod method = PictureMethod::gather;
  std::optional<double> epsilon, min_area;  // default: depends on the outputs
  bool quiet = false;
  std::optional<ErrorOf> error_of;      // default: picture if there is one, else surfaces
  std::optional<std::uint64_t> memory;  // bytes that the process may use
  radiosity::Options solver;
};

// The arguments of `halflight render`, which store their values in `options`.
[[nodiscard]] std::vector<Argument> render_arguments(RenderOptions& options);

enum class RenderFormat { png, hdr, pfm, light, ply, html, exported };

// The format, by the ending of the name.
[[nodiscard]] std::optional<RenderFormat> render_format(const std::string& path);

// Does the name end like that of a picture: with .png, .hdr or .pfm?
[[nodiscard]] bool is_picture(const std::string& path);

// ".png, .ply, ... or .html"
[[nodiscard]] std::string render_endings();

[[nodiscard]] bool has_picture(const RenderOptions& options);

// The settings of the solution. If only gathered light is seen, the solution is coarser: direct light is recomputed, and errors of the
// mesh are averaged over all that a point sees, so the time is better spent on the picture than on the mesh.
[[nodiscard]] radiosity::Options solver_options(const RenderOptions& options);

// Draws a solution as it will be shown, and measures the error of the picture.
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
  // As asked for, or `mesh` once a picture in gathered light has not fitted in the memory allowed.
  [[nodiscard]] PictureMethod method() const { return method_; }
  // The effort that goes into a picture, in rays (audit_effort.hpp).
  [[nodiscard]] std::uint64_t worth();
  // Null if interrupted; valid until the next call. A picture of the same light as the last one, as after the rounds towards a target, is
  // not drawn again.
  [[nodiscard]] const radiosity::Picture* draw(const radiosity::Mesh& mesh, const radiosity::Frame& frame, const radiosity::Tone& tone,
                                               const radiosity::Control& control);
  // Was the last picture drawn of this light, so that draw() returns it at once?
  [[nodiscard]] bool has_drawn(const radiosity::Mesh& mesh, const radiosity::Tone& tone) const;
  // Draws the triangles of this mesh, coarsely, which takes a moment. Valid until the next call.
  [[nodiscard]] const radiosity::Picture* draw_mesh(const radiosity::Mesh& mesh, const radiosity::Tone& tone);
  // Nothing if interrupted, or if the error cannot be measured; then `reason` says why.
  [[nodiscard]] std::optional<radiosity::PictureError> audit(const radiosity::Picture& picture, const radiosity::Tone& tone,
                                                             const radiosity::AuditGoal& goal, const radiosity::Control& control,
                                                             std::string* reason = nullptr);

 private:
  // What a picture shows; two solutions with the same sum of all radiosities, to the last bit, are the same.
  struct Light {
    std::size_t corners = 0;
    radiosity::Color sum{0.0};
    double exposure = 1.0;
    friend bool operator==(const Light&, const Light&) = default;
  };

  [[nodiscard]] static Light light_of(const radiosity::Mesh& mesh, const radiosity::Tone& tone);
  // Null for a scene whose pictures cannot be audited.
  [[nodiscard]] const radiosity::PictureAudit* meter();

  const RenderOptions& options_;
  const SceneFile& file_;
  const radiosity::Camera& camera_;
  radiosity::View view_;
  PictureMethod method_ = options_.method;
  std::optional<radiosity::PictureAudit> audit_;
  bool asked_ = false;
  Light shown_;
  std::optional<radiosity::Picture> picture_;
};

struct RenderOutput {
  std::string path;
  std::string bytes;
};

// The picture in each requested format.
[[nodiscard]] std::vector<RenderOutput> encode(const RenderOptions& options, const radiosity::Picture& picture,
                                               const radiosity::Tone& tone);

// All outputs, in memory; also completes the report. If the run was or is interrupted, pictures show the mesh (--method mesh), unless
// their light has been gathered already.
[[nodiscard]] std::vector<RenderOutput> encode(Artist& artist, const radiosity::Solution& solution, const radiosity::Control& control,
                                               Report& report);

}  // namespace apps
