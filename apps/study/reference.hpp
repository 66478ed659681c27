// SPDX-License-Identifier: MIT
#pragma once

// What the radiosity of a scene truly is, at fixed points: every input surface is cut into cells, every cell holds up to four stratified
// points of the true surface that are not buried. In a closed scene where every surface emits 1 - rho times the same, B is
// that number everywhere (the furnace; any shapes, any occluders); else each point is path-traced (radiosity/audit/path_tracer.hpp) and
// brings its standard errors.
//
// Path-traced values are kept in a file, with a checksum of all they depend on and one of themselves: a file that is damaged is
// made anew and never trusted; one for another scene, or none of ours, is left as it is.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/study/results.hpp"

namespace study {

struct ReferencePoint {
  glm::dvec3 position{0.0};  // on the true surface, in the coordinates of the frame
  glm::dvec3 normal{0.0};
  std::uint32_t object = 0;
  std::uint32_t sheet = 0;
  std::uint32_t cell = 0;
  radiosity::Color radiosity{0.0};
  radiosity::Color standard_error{0.0};
};

struct ReferenceCell {
  std::vector<glm::dvec3> corners;  // counter-clockwise seen from the bright side, in the scene's coordinates
  double area = 0.0;                // exposed
  std::uint32_t first_point = 0;
  std::uint32_t points = 0;  // at least one
};

struct TrueRadiosity {
  bool analytic = false;
  bool cached = false;
  std::uint64_t paths = 0;  // a point; 0 when analytic
  std::vector<ReferenceCell> cells;
  std::vector<ReferencePoint> points;
  std::vector<radiosity::LeftOut> left_out;  // by the plan of the scene
  std::vector<std::string> taken;            // where it could not be kept, because another file is there
};

struct ReferenceOptions {
  std::uint32_t cells = 300;   // at least, all surfaces together
  std::uint64_t paths = 8192;  // a point; eight powers of two are spent best
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

// The points of a scene, without values; or nothing and a sentence in `fault`.
[[nodiscard]] std::optional<TrueRadiosity> reference_points(const radiosity::Scene& scene, const ReferenceOptions& options,
                                                            std::string& fault);

// A checksum of the scene's text, the points and what the paths depend on, but not of their number.
[[nodiscard]] std::string reference_key(std::string_view text, const TrueRadiosity& points, const ReferenceOptions& options);

// The values as the text of a cache file, and back: false, with nothing changed, when the file is damaged, has another key, other points
// or fewer paths than `least`.
[[nodiscard]] std::string to_cache(const TrueRadiosity& truth, const std::string& key);
[[nodiscard]] bool from_cache(std::string_view file, const std::string& key, std::uint64_t least, TrueRadiosity& truth);

// The same with files: the values of the first of the `caches` that is good, and written to the first that can be written. Where all hold
// files of others, which are left as they are, the last with the key in its name is used ("room.KEY.reference.json").
[[nodiscard]] bool read_cache(const std::vector<std::string>& caches, const std::string& key, std::uint64_t least, TrueRadiosity& truth);
void write_cache(const std::vector<std::string>& caches, const std::string& key, TrueRadiosity& truth);

// The reference of the scene whose file has this `text`: analytic, from the `caches`, or path-traced and then written to them. Nothing and
// a sentence in `fault` where there is no reference, or on cancel.
[[nodiscard]] std::optional<TrueRadiosity> make_reference(const radiosity::Scene& scene, std::string_view text,
                                                          const std::vector<std::string>& caches, const ReferenceOptions& options,
                                                          const radiosity::Control& control, std::string& fault);

// Errors of `values`, one a point. With `signed_cells` also each cell's mean error over the channels, relative to the greatest mean.
[[nodiscard]] Errors errors_of(const TrueRadiosity& truth, const std::vector<radiosity::Color>& values,
                               std::vector<double>* signed_cells = nullptr);

// Relative L2 at the points of the difference of two functions.
[[nodiscard]] double distance(const TrueRadiosity& truth, const std::vector<radiosity::Color>& a, const std::vector<radiosity::Color>& b);

// The same norms of the standard errors.
[[nodiscard]] Reference describe(const TrueRadiosity& truth);

}  // namespace study
