// SPDX-License-Identifier: MIT
// Implements halflight.h: each function checks its arguments, calls bake.hpp, and converts the results. Compiled only into the shared
// library, because all other code is C++ already.
#include <radiosity/bake/halflight.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/bake/bake.hpp>
#include <radiosity/bake/c_names.hpp>
#include <radiosity/bake/lightmap.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/number_text.hpp>

struct halflight_job {
  std::span<const float> positions;
  std::span<const std::uint32_t> indices, material;
  std::uint32_t stride = 3;
  std::vector<radiosity::Material> materials;
  radiosity::BakeOptions options;
  halflight_progress progress = nullptr;
  void* user = nullptr;
  bool running = false;  // halflight_run has been called and has not returned

  std::optional<radiosity::Baked> baked;
  std::optional<radiosity::Lightmap> lightmap;
  std::vector<std::string> changes;
  std::string message;
};

namespace {

using radiosity::BakeOptions;
using radiosity::c_interface::Figure, radiosity::c_interface::figures, radiosity::c_interface::number_options,
    radiosity::c_interface::NumberOption;

halflight_status refuse(halflight_job* job, std::string message, halflight_status status = HALFLIGHT_INVALID) {
  if (job != nullptr) { job->message = std::move(message); }
  return status;
}

// Calls `attempt`, which may allocate: std::bad_alloc is caught here and must not reach C. Any other exception comes from a
// callback of the caller and passes through.
template <class Attempt>
auto unless_out_of_memory(halflight_job* job, decltype(std::declval<Attempt>()()) otherwise, const Attempt& attempt) {
  try {
    return attempt();
  } catch (const std::bad_alloc&) {
    if (job != nullptr) { job->message = "out of memory"; }  // short enough for the string's internal buffer: no allocation
    return otherwise;
  }
}

// Results are valid only for the buffers with which the job was run.
void forget_results(halflight_job& job) {
  job.baked.reset();
  job.lightmap.reset();
  job.changes.clear();
}

// True, with a message, if the job is running: it must not be changed, run again or destroyed from its own callback.
bool is_running(halflight_job* job) {
  if (job == nullptr || !job->running) { return false; }
  job->message = "the job is running: it cannot be changed or run again from its progress callback";
  return true;
}

// Sets `running` during its lifetime, so that it is reset also if a callback throws.
class Running {
 public:
  explicit Running(halflight_job& job) : job_{job} { job.running = true; }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() { job_.running = false; }

 private:
  halflight_job& job_;
};

// Light beyond the range of float is the largest float, not infinite.
float as_float(double x) { return static_cast<float>(std::min<double>(x, std::numeric_limits<float>::max())); }

// Copies the components of the vectors to `out`, which has room for `count` vectors.
template <class Vector>
halflight_status copy(halflight_job* job, const std::vector<Vector>& list, const char* name, float* out, std::size_t count) {
  if (out == nullptr) { return refuse(job, std::string("there is no buffer for the ") + name); }
  if (count < list.size()) {
    return refuse(job, "there are " + std::to_string(list.size()) + " " + name + ", and room for " + std::to_string(count));
  }
  for (const Vector& vector : list) {
    for (int k = 0; k < Vector::length(); ++k) { *out++ = as_float(vector[k]); }
  }
  return HALFLIGHT_OK;
}

// The triangles of a job as polygons of the C++ interface.
struct JobPolygons {
  explicit JobPolygons(const halflight_job& job) : indices{job.indices}, first(job.indices.size() / 3 + 1), material(first.size() - 1, 0) {
    for (std::size_t i = 0; i + 2 < job.positions.size(); i += job.stride) {
      positions.emplace_back(job.positions[i], job.positions[i + 1], job.positions[i + 2]);
    }
    for (std::size_t t = 0; t < first.size(); ++t) { first[t] = static_cast<std::uint32_t>(3 * t); }
  }
  [[nodiscard]] radiosity::PolygonView view() const { return {positions, indices, first, material}; }
  [[nodiscard]] double area() const {
    double sum = 0.0;
    for (std::size_t c = 0; c + 2 < indices.size(); c += 3) {
      if (std::max({indices[c], indices[c + 1], indices[c + 2]}) >= positions.size()) { continue; }
      const glm::dvec3& a = positions[indices[c]];
      const double area = radiosity::triangle_area(a, positions[indices[c + 1]], positions[indices[c + 2]]);
      sum += std::isfinite(area) ? area : 0.0;
    }
    return sum;
  }

  std::span<const std::uint32_t> indices;
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> first, material;
};

}  // namespace

extern "C" {

const char* halflight_version(void) { return HALFLIGHT_C_VERSION; }

halflight_job* halflight_create(void) { return new (std::nothrow) halflight_job; }

void halflight_destroy(halflight_job* job) {
  if (job == nullptr || !job->running) { delete job; }
}

halflight_status halflight_set_positions(halflight_job* job, const float* xyz, size_t count, size_t stride) {
  return unless_out_of_memory(job, HALFLIGHT_OUT_OF_MEMORY, [&]() -> halflight_status {
    if (is_running(job)) { return HALFLIGHT_INVALID; }
    if (job == nullptr || (xyz == nullptr && count > 0)) { return refuse(job, "there are no positions"); }
    if (stride < 3 || stride > 1'000'000) {
      return refuse(job, "the stride of the positions is " + std::to_string(stride) + "; a vertex has three numbers");
    }
    if (count > std::numeric_limits<std::uint32_t>::max()) { return refuse(job, "there are more vertices than indices can count"); }
    forget_results(*job);
    job->positions = {xyz, count == 0 ? 0 : (count - 1) * stride + 3};
    job->stride = static_cast<std::uint32_t>(stride);
    return HALFLIGHT_OK;
  });
}

halflight_status halflight_set_triangles(halflight_job* job, const uint32_t* indices, size_t triangles, const uint32_t* material) {
  return unless_out_of_memory(job, HALFLIGHT_OUT_OF_MEMORY, [&]() -> halflight_status {
    if (is_running(job)) { return HALFLIGHT_INVALID; }
    if (job == nullptr || (indices == nullptr && triangles > 0)) { return refuse(job, "there are no indices"); }
    if (triangles > std::numeric_limits<std::uint32_t>::max() / 3) { return refuse(job, "there are more triangles than can be counted"); }
    forget_results(*job);
    job->indices = {indices, 3 * triangles};
    job->material = {material, material == nullptr ? 0 : triangles};
    return HALFLIGHT_OK;
  });
}

int halflight_add_material(halflight_job* job, const char* name, const double reflectance[3], const double emission[3]) {
  return unless_out_of_memory(job, -HALFLIGHT_OUT_OF_MEMORY, [&]() -> int {
    if (is_running(job)) { return -HALFLIGHT_INVALID; }
    if (job == nullptr || reflectance == nullptr) { return -refuse(job, "a material needs a reflectance"); }
    radiosity::Material material{
        name == nullptr ? "material" : name, {reflectance[0], reflectance[1], reflectance[2]}, radiosity::Color(0.0)};
    if (emission != nullptr) { material.emission = {emission[0], emission[1], emission[2]}; }
    if (auto sentence = radiosity::fault(material)) { return -refuse(job, std::move(*sentence)); }
    job->materials.push_back(std::move(material));
    return static_cast<int>(job->materials.size()) - 1;
  });
}

halflight_status halflight_set_number(halflight_job* job, const char* option, double value) {
  return unless_out_of_memory(job, HALFLIGHT_OUT_OF_MEMORY, [&]() -> halflight_status {
    if (is_running(job)) { return HALFLIGHT_INVALID; }
    if (job == nullptr || option == nullptr) { return refuse(job, "there is no option without a name"); }
    for (const NumberOption& known : number_options) {
      if (known.name != option) { continue; }
      if (!(value >= known.least && value <= known.most) || (known.whole && value != std::floor(value))) {
        return refuse(job, std::string(option) + " cannot be " + radiosity::number_text(value));
      }
      known.set(job->options, value);
      return HALFLIGHT_OK;
    }
    return refuse(job, "there is no option '" + std::string(option) + "'", HALFLIGHT_NOTHING);
  });
}

halflight_status halflight_set_progress(halflight_job* job, halflight_progress callback, void* user) {
  return unless_out_of_memory(job, HALFLIGHT_OUT_OF_MEMORY, [&]() -> halflight_status {
    if (job == nullptr || is_running(job)) { return HALFLIGHT_INVALID; }
    job->progress = callback;
    job->user = user;
    return HALFLIGHT_OK;
  });
}

halflight_status halflight_run(halflight_job* job) {
  return unless_out_of_memory(job, HALFLIGHT_OUT_OF_MEMORY, [&]() -> halflight_status {
    if (job == nullptr || is_running(job)) { return HALFLIGHT_INVALID; }
    std::atomic<bool> stop{false};
    radiosity::Control control;
    control.cancel = &stop;
    if (job->progress != nullptr) {
      control.progress = [&](std::string_view stage, double fraction) {
        if (job->progress(job->user, std::string(stage).c_str(), fraction) != 0) { stop.store(true, std::memory_order_relaxed); }
      };
    }
    forget_results(*job);
    radiosity::BakeOutcome outcome;
    {
      const Running running(*job);
      outcome = radiosity::bake({job->positions, job->indices, job->materials, job->material, job->stride}, job->options, control);
    }
    if (!outcome.baked) {
      std::string message;
      for (const std::string& sentence : outcome.failure.sentences) { message += (message.empty() ? "" : "\n") + sentence; }
      using Kind = radiosity::Failure::Kind;
      const Kind kind = outcome.failure.kind;
      return refuse(job, std::move(message),
                    kind == Kind::cancelled       ? HALFLIGHT_CANCELLED
                    : kind == Kind::out_of_memory ? HALFLIGHT_OUT_OF_MEMORY
                                                  : HALFLIGHT_INVALID);
    }
    job->baked = std::move(outcome.baked);
    for (const radiosity::Change& change : job->baked->changes) { job->changes.push_back(radiosity::sentence(change)); }
    const radiosity::Audit& audit = job->baked->audit;
    job->changes.insert(job->changes.end(), audit.warnings.begin(), audit.warnings.end());
    if (!audit.shortage.empty()) { job->changes.push_back(audit.shortage); }
    if (audit.target_missed) {
      job->changes.push_back("the error that was asked for was not reached" +
                             (audit.rounds_ended_by.empty() ? std::string() : ": ended by " + audit.rounds_ended_by));
    }
    if (audit.error_unknown()) { job->changes.push_back("more than half of the light may be wrong; path tracing cannot tell"); }
    if (audit.far_off()) { job->changes.push_back("path tracing found the result more than a quarter off"); }
    return HALFLIGHT_OK;
  });
}

const char* halflight_message(const halflight_job* job) { return job == nullptr ? "there is no job" : job->message.c_str(); }

halflight_status halflight_read(halflight_job* job, int result, float* out, size_t count) {
  return unless_out_of_memory(job, HALFLIGHT_OUT_OF_MEMORY, [&]() -> halflight_status {
    if (job == nullptr) { return HALFLIGHT_INVALID; }
    const bool of_lightmap = result == HALFLIGHT_LIGHTMAP_TEXELS || result == HALFLIGHT_LIGHTMAP_COORDINATES;
    if (!job->baked) { return refuse(job, "there is no result before halflight_run", HALFLIGHT_NOT_RUN); }
    if (of_lightmap && !job->lightmap) { return refuse(job, "there is no lightmap before halflight_make_lightmap", HALFLIGHT_NOT_RUN); }
    switch (result) {
      case HALFLIGHT_CORNER_COLORS:
        return copy(job, job->baked->colors.corner, "colours", out, count);
      case HALFLIGHT_VERTEX_COLORS:
        return copy(job, job->baked->colors.vertex, "colours", out, count);
      case HALFLIGHT_LIGHTMAP_TEXELS:
        return copy(job, job->lightmap->texels, "texels", out, count);
      case HALFLIGHT_LIGHTMAP_COORDINATES:
        return copy(job, job->lightmap->coordinates, "coordinates", out, count);
    }
    return refuse(job, "there is no result of the number " + std::to_string(result), HALFLIGHT_NOTHING);
  });
}

halflight_status halflight_at(const halflight_job* job, size_t triangle, const float point[3], int back, float rgb[3]) {
  if (job == nullptr || point == nullptr || rgb == nullptr) { return HALFLIGHT_INVALID; }
  if (!job->baked) { return HALFLIGHT_NOT_RUN; }
  if (!std::all_of(point, point + 3, [](float x) { return std::isfinite(x); })) { return HALFLIGHT_INVALID; }
  const auto color = job->baked->light.radiosity(triangle, {point[0], point[1], point[2]},
                                                 back != 0 ? radiosity::FaceSide::back : radiosity::FaceSide::front);
  if (!color) { return HALFLIGHT_NOTHING; }
  for (int k = 0; k < 3; ++k) { rgb[k] = as_float((*color)[k]); }
  return HALFLIGHT_OK;
}

halflight_status halflight_make_lightmap(halflight_job* job, double texel, uint32_t most, uint32_t* width, uint32_t* height) {
  return unless_out_of_memory(job, HALFLIGHT_OUT_OF_MEMORY, [&]() -> halflight_status {
    if (job == nullptr || width == nullptr || height == nullptr) { return refuse(job, "the size of a lightmap needs a place to go to"); }
    if (!job->baked) { return refuse(job, "there is no lightmap before halflight_run", HALFLIGHT_NOT_RUN); }
    if (!(texel >= 0.0 && std::isfinite(texel)) || most < 64) {
      return refuse(job, "a lightmap has texels of some size, and sides of 64 texels or more");
    }
    job->lightmap.reset();
    {
      const JobPolygons polygons(*job);
      constexpr double usual_texels = 1 << 20;
      if (texel == 0.0) { texel = std::sqrt(polygons.area() / usual_texels); }
      radiosity::Lightmap map = radiosity::make_lightmap(job->baked->light, polygons.view(), texel, most);
      if (map.texels.empty()) { return refuse(job, "no triangle has light", HALFLIGHT_NOTHING); }
      job->lightmap = std::move(map);
    }
    *width = job->lightmap->width;
    *height = job->lightmap->height;
    return HALFLIGHT_OK;
  });
}

halflight_status halflight_figure(halflight_job* job, const char* name, double* value) {
  return unless_out_of_memory(job, HALFLIGHT_OUT_OF_MEMORY, [&]() -> halflight_status {
    if (job == nullptr || name == nullptr || value == nullptr) { return refuse(job, "a figure has a name, and a place to go to"); }
    if (!job->baked) { return refuse(job, "there are no figures before halflight_run", HALFLIGHT_NOT_RUN); }
    for (const Figure& figure : figures) {
      if (figure.name != name) { continue; }
      const std::optional<double> found = figure.value(*job->baked);
      if (!found) { return refuse(job, std::string(name) + " was not measured", HALFLIGHT_NOTHING); }
      *value = *found;
      return HALFLIGHT_OK;
    }
    return refuse(job, "there is no figure '" + std::string(name) + "'", HALFLIGHT_NOTHING);
  });
}

const char* halflight_change(const halflight_job* job, size_t number) {
  return job == nullptr || number >= job->changes.size() ? nullptr : job->changes[number].c_str();
}

}  // extern "C"
