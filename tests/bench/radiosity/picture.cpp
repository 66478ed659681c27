// SPDX-License-Identifier: MIT

// Pictures of scenes at the program's defaults: in gathered light, of the mesh, and by the audit's path tracer in the CPU time of the
// first. One run, one thread, one line a scene; errors are relative L2 over the visible pixels, against paths (picture_error.hpp). The path
// tracer's is what the variance of its paths says, for as many a pixel as that time allows.
//
//     bench_picture SCENE...

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include <radiosity/audit/audit_effort.hpp>
#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/audit/picture_error.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

#include <radiosity/camera/gather_picture.hpp>
#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/camera/view.hpp>
#include "apps/commands/render_outputs.hpp"
#include "apps/scene_file.hpp"

namespace {

using radiosity::Color;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Row {
  double solve = 0.0, picture = 0.0, error = 0.0, doubt = 0.0;
  [[nodiscard]] double seconds() const { return solve + picture; }
};

std::optional<Row> measure(const radiosity::Scene& scene, const radiosity::View& view, apps::PictureMethod method) {
  apps::RenderOptions render;
  render.outputs = {"picture.png"};
  render.method = method;
  radiosity::Options options = apps::solver_options(render);
  options.threads = 1;
  options.audit_points = 0;
  Row row;
  double start = cpu_seconds();
  const radiosity::Outcome outcome = radiosity::solve(scene, options);
  row.solve = cpu_seconds() - start;
  if (!outcome.solution) { return std::nullopt; }
  start = cpu_seconds();
  const auto draw = [&] {
    if (method == apps::PictureMethod::mesh) { return radiosity::draw(outcome.solution->mesh, view, 1.0); }
    return radiosity::draw(radiosity::FinalGather{scene, outcome.solution->mesh, outcome.solution->frame}, view, 1.0, 1);
  };
  const radiosity::Picture picture = draw().value();
  row.picture = cpu_seconds() - start;
  const auto audit = radiosity::PictureAudit::make(scene);
  const auto error = audit ? audit->measure(radiosity::audited(picture, view, 1.0), {4000, 16'000'000}, 1, 1) : std::nullopt;
  if (!error) { return std::nullopt; }
  row.error = error->error.relative_l2;
  row.doubt = error->error.standard_error;
  return row;
}

// The error of a picture whose pixels are means of so many paths that it takes this time.
double path_traced(const radiosity::Scene& scene, const radiosity::View& view, double seconds) {
  const auto prepared = std::move(*radiosity::prepare(scene).prepared);
  const radiosity::PathTracer tracer{scene, prepared.objects, prepared.surfaces};
  constexpr std::uint32_t side = 24, paths = 64;
  double square = 0.0, variance = 0.0;
  std::uint64_t rays = 0;
  const double start = cpu_seconds();
  for (std::uint32_t i = 0; i < side * side; ++i) {
    radiosity::Random random{1, i};
    const double x = std::floor((i % side + random.uniform()) / side * view.size.width);
    const double y = std::floor((i / side + random.uniform()) / side * view.size.height);
    Color sum{0.0}, squares{0.0};
    bool shines = false;
    for (std::uint32_t k = 0; k < paths; ++k) {
      raycast::Segment ray{(view.eye - prepared.frame.centre) * prepared.frame.scale,
                           glm::normalize(view.direction(x + random.uniform(), y + random.uniform())) * prepared.objects.diameter()};
      std::uint32_t from = raycast::no_object;
      for (auto hit = prepared.objects.closest(ray, from); hit; hit = prepared.objects.closest(ray, from)) {
        ++rays;
        const raycast::ScenePoint at = prepared.objects.point(*hit, ray);
        if (!hit->front || prepared.objects.covered(at)) {  // backs are looked through
          ray.origin = at.position;
          from = hit->object;
          continue;
        }
        shines = shines || !radiosity::is_black(tracer.of(at).emission);
        const Color b = tracer.radiosity(at, random, rays).all;
        sum += b;
        squares += b * b;
        break;
      }
    }
    if (shines) { continue; }
    const Color mean = sum / static_cast<double>(paths);
    const Color spread = (squares / static_cast<double>(paths) - mean * mean) * (paths / (paths - 1.0));
    variance += spread.x + spread.y + spread.z;
    square += glm::dot(mean, mean) - (spread.x + spread.y + spread.z) / paths;
  }
  const double a_path = (cpu_seconds() - start) / (side * side * paths);
  const double paths_a_pixel = seconds / a_path / (static_cast<double>(view.size.width) * view.size.height);
  return std::sqrt(variance / square / paths_a_pixel);
}

}  // namespace

int main(int argc, char** argv) {
  std::printf(
      "| scene | gather: solve + picture, CPU s | error | mesh: solve + picture, CPU s | error | path tracer in gather's time | s to "
      "gather's error |\n");
  std::printf("| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i]);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    apps::SceneResult parsed = apps::parse_scene(text);
    if (!parsed.file) {
      std::fprintf(stderr, "%s cannot be read\n", argv[i]);
      return 1;
    }
    const radiosity::Scene& scene = parsed.file->scene;
    const radiosity::Camera camera = parsed.file->cameras.empty() ? radiosity::automatic_camera(scene) : parsed.file->cameras.front();
    const radiosity::View view = radiosity::make_view(camera, camera.size.value_or(radiosity::PictureSize{}));
    const auto gather = measure(scene, view, apps::PictureMethod::gather);
    const auto mesh = measure(scene, view, apps::PictureMethod::mesh);
    if (!gather || !mesh) {
      std::fprintf(stderr, "%s cannot be measured\n", argv[i]);
      return 1;
    }
    const double traced = path_traced(scene, view, gather->seconds());
    const double needed = gather->seconds() * traced * traced / (gather->error * gather->error);
    const std::string name = std::string(argv[i]).substr(std::string(argv[i]).find_last_of('/') + 1);
    std::printf("| %s | %.1f + %.1f | %.2f +- %.2f %% | %.1f + %.1f | %.2f +- %.2f %% | %.0f %% | %.0f |\n",
                name.substr(0, name.find('.')).c_str(), gather->solve, gather->picture, 100 * gather->error, 100 * gather->doubt,
                mesh->solve, mesh->picture, 100 * mesh->error, 100 * mesh->doubt, 100 * traced, needed);
    std::fflush(stdout);
  }
}
