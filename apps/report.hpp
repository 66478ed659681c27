// SPDX-License-Identifier: MIT
#pragma once

// The report of a run: how wrong it is, how long it took, what it left out. It exists as text for people and as JSON, whose
// keys are documented in examples/scenes/README.md ("Report keys") and are stable.

#include <optional>
#include <string>
#include <vector>

#include <radiosity/camera/tone.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/error_estimate.hpp>
#include <radiosity/scene/options.hpp>

#include "apps/facts.hpp"

namespace apps {

// What the picture shows: the mesh, or the true objects in light gathered for each pixel.
enum class PictureMethod { mesh, gather };
inline constexpr const char* name(PictureMethod method) {
  constexpr const char* names[] = {"mesh", "gather"};
  return names[static_cast<int>(method)];
}

struct PictureReport {
  radiosity::Camera camera;
  unsigned width = 0;
  unsigned height = 0;
  PictureMethod method = PictureMethod::mesh;
};

struct LightmapReport {
  unsigned width = 0;
  unsigned height = 0;
  double texel = 0.0;    // metres
  bool coarser = false;  // than asked for, because the finer one would not fit into a picture
};

struct Report {
  std::string scene;                  // the file's name as it was given
  std::vector<std::string> taken_in;  // what was changed when a file of another program was read
  radiosity::Options options;
  radiosity::Audit audit;
  double exposure = 1.0;
  bool automatic_exposure = true;
  radiosity::ToneCurve tone = radiosity::ToneCurve::linear;
  std::optional<PictureReport> picture;
  std::string picture_error_unknown;                 // why the error of the picture was asked for and is not known; else empty
  std::optional<radiosity::StageTime> picture_time;  // drawing and encoding; not part of the total
  std::optional<LightmapReport> lightmap;
  std::vector<std::string> files;  // what was written
};

[[nodiscard]] std::string to_text(const Report& report);
// The report's rows about the error of the picture taken by this camera.
[[nodiscard]] std::string picture_error_text(const radiosity::PictureError& picture, const std::string& camera);
[[nodiscard]] std::string to_json(const Report& report);

[[nodiscard]] Facts facts_of(const Report& report);

}  // namespace apps
