// SPDX-License-Identifier: MIT
#pragma once

// The true radiosity of a scene at fixed points: every input surface is divided into cells, and every cell has up to four stratified
// points of the true surface that are not buried. In a closed scene where every surface emits 1 - rho times the same value, B is that
// value everywhere (the furnace; for any shapes and occluders). Otherwise each point is path-traced (radiosity/audit/path_tracer.hpp) and
// has a standard error.
//
// Path-traced values are stored in a file, with a checksum of all that they depend on and one of themselves. A damaged file is never used
// but replaced; a file for another scene, or any other file, is left unchanged.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/object.hpp>

#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/study/results.hpp"

namespace study {

struct ReferencePoint {
  raycast::ScenePoint at;  // in the coordinates of the frame
  radiosity::Color radiosity{0.0};
  radiosity::Color standard_error{0.0};
};

struct ReferenceCell {
  std::vector<glm::dvec3> corners;  // counter-clockwise seen from the front, in the scene's coordinates
  double area = 0.0;                // exposed
  std::uint32_t first_point = 0;
  std::uint32_t points = 0;  // at least one
};

struct TrueRadiosity {
  bool analytic = false;
  bool cached = false;
  std::uint64_t paths = 0;  // per point; 0 if analytic
  std::vector<ReferenceCell> cells;
  std::vector<ReferencePoint> points;
  std::vector<radiosity::LeftOut> left_out;  // by the plan of the scene
  std::vector<std::string> taken;            // paths where the values could not be stored, because another file is there
};

struct ReferenceOptions {
  std::uint32_t cells = 300;   // at least, for all surfaces together
  std::uint64_t paths = 8192;  // per point; eight times a power of two is most efficient
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

// The points of a scene, without values; on failure nothing, and a sentence in `fault`.
[[nodiscard]] std::optional<TrueRadiosity> reference_points(const radiosity::Scene& scene, const ReferenceOptions& options,
                                                            std::string& fault);

// A checksum of the scene's text, the points and all that the paths depend on, except their number.
[[nodiscard]] std::string reference_key(std::string_view text, const TrueRadiosity& points, const ReferenceOptions& options);

// Converts the values to the text of a cache file, and back. from_cache() returns false and changes nothing if the file is damaged or has
// another key, other points or fewer paths than `least`.
[[nodiscard]] std::string to_cache(const TrueRadiosity& truth, const std::string& key);
[[nodiscard]] bool from_cache(std::string_view file, const std::string& key, std::uint64_t least, TrueRadiosity& truth);

// The same with files: reads the first valid one of the `caches`, and writes to the first that can be written. If other files are at all
// of these places, they are left unchanged, and the last name with the key in it is used ("room.KEY.reference.json").
[[nodiscard]] bool read_cache(const std::vector<std::string>& caches, const std::string& key, std::uint64_t least, TrueRadiosity& truth);
void write_cache(const std::vector<std::string>& caches, const std::string& key, TrueRadiosity& truth);

// The reference of the scene whose file has this `text`: analytic, from the `caches`, or path-traced and then stored there. If there is
// none, or on cancel, nothing and a sentence in `fault`.
[[nodiscard]] std::optional<TrueRadiosity> make_reference(const radiosity::Scene& scene, std::string_view text,
                                                          const std::vector<std::string>& caches, const ReferenceOptions& options,
                                                          const radiosity::Control& control, std::string& fault);

// Errors of `values`, one per point. Also sets `signed_cells`, if given: the error of each cell's mean, averaged over the channels,
// relative to the largest mean.
[[nodiscard]] Errors errors_of(const TrueRadiosity& truth, const std::vector<radiosity::Color>& values,
                               std::vector<double>* signed_cells = nullptr);

// The difference of two functions at the points, as a relative L2 error.
[[nodiscard]] double distance(const TrueRadiosity& truth, const std::vector<radiosity::Color>& a, const std::vector<radiosity::Color>& b);

// The norms of the standard errors.
[[nodiscard]] Reference describe(const TrueRadiosity& truth);

}  // namespace study
