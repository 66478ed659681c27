// SPDX-License-Identifier: MIT
// Gathered light in concave corners, where what a point sees lies nearer than a leaf is wide.
#include "catch.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/audit/path_tracer.hpp>
#include <radiosity/camera/gather_picture.hpp>
#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/picture/gathered_point.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/prepare.hpp>

#include "apps/scene_file.hpp"

namespace {

struct CornellBox {
  apps::SceneFile file;
  radiosity::Solution solution;

  // Solved with the settings that pictures have unless told otherwise.
  CornellBox() {
    std::ifstream stream(HALFLIGHT_SCENES "/cornell.scene");
    apps::SceneResult parsed = apps::parse_scene(std::string{std::istreambuf_iterator<char>(stream), {}});
    REQUIRE(parsed.file);
    file = std::move(*parsed.file);
    const radiosity::Options options{.audit_points = 0};
    radiosity::Outcome outcome = radiosity::solve(file.scene, options);
    REQUIRE(outcome.solution);
    solution = std::move(*outcome.solution);
  }
};

double sum(const radiosity::Color& c) { return c.x + c.y + c.z; }

}  // namespace

// The front of the short block gets no light from the lamp, and at its foot nearly all that it sees is a floor in shadow, with a lit strip
// before it. The mesh alone, with leaves of the floor as wide as the strip, makes the lowest millimetre 19 % too bright and the next four
// 15 %. What is near is followed by paths only where the corners of its triangle differ by a twentieth: an even triangle is believed,
// and may be off by a tenth in between. To this comes what the gathering itself is off: over 64 places of 3 % each, with 1 % from tracing,
// four standard errors are 5 %.
TEST_CASE("a dark corner: gathered light is that of path tracing, up to the edge", "[picture]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(take(1, random(1, 1'000'000))));
  CAPTURE(seed);
  const CornellBox box;
  const radiosity::FinalGather light{box.file.scene, box.solution.mesh, box.solution.frame};
  const radiosity::PrepareResult p = radiosity::prepare(box.file.scene);
  REQUIRE(p.prepared);
  const radiosity::PathTracer tracer{box.file.scene, p.prepared->objects, p.prepared->surfaces};
  constexpr std::uint32_t block = 6, front = 2;
  const std::uint32_t surface = tracer.surface(block, front);
  const radiosity::Color rho = tracer.material(surface).reflectance;
  const glm::dvec3 right{0.130, 0.0, 0.065}, left{0.290, 0.0, 0.114};
  const glm::dvec3 normal = glm::normalize(glm::cross({0.0, 1.0, 0.0}, left - right));
  radiosity::Random random{seed, 1};
  std::uint64_t cast = 0;
  for (const double height : {0.001, 0.004, 0.008, 0.012, 0.016}) {  // of the block's 0.165
    constexpr int places = 64, paths = 512;
    double gathered = 0.0, traced = 0.0;
    for (int i = 0; i < places; ++i) {
      const glm::dvec3 x = right + (0.1 + 0.5 * random.uniform()) * (left - right) + glm::dvec3{0.0, height, 0.0};
      const radiosity::FinalGather::Place place{{(x - light.frame().centre) * light.frame().scale, normal}, block, surface};
      gathered += sum(rho * light.indirect(place, radiosity::gather_rays, random.bits()).irradiance) / places;
      for (int k = 0; k < paths; ++k) {
        const auto found = tracer.radiosity({{place.point.position, normal}, block, front}, random, cast);
        traced += sum(found.all - found.direct) / (places * paths);
      }
    }
    CAPTURE(height, gathered, traced);
    CHECK(std::abs(gathered - traced) < 0.15 * traced);
  }
}

TEST_CASE("light in dark corners does not depend on the threads", "[picture]") {
  const CornellBox box;
  const radiosity::FinalGather light{box.file.scene, box.solution.mesh, box.solution.frame};
  const radiosity::View view = radiosity::make_view(box.file.cameras.front(), {60, 60});
  CHECK(radiosity::draw(light, view, 1.0, 1).value().radiosity == radiosity::draw(light, view, 1.0, 3).value().radiosity);
}
