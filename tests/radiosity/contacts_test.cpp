// SPDX-License-Identifier: MIT
// Indirect light in a gathered picture beside what stands out of a wall.
#include "catch.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/camera/fragments.hpp>
#include <radiosity/camera/indirect_light.hpp>
#include <radiosity/camera/picture_blocks.hpp>
#include <radiosity/camera/seen_surfaces.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/final_gather.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>

#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

using radiosity::Color;

struct Slab {
  glm::dvec3 from{0.0}, to{0.0};
};

// A wall in the plane y = 0 above green ground, under a sky that only rays find, with slabs that stand out of it.
struct Facade {
  radiosity::Scene scene;
  std::vector<Slab> slabs;
  explicit Facade(radiosity::Random& random) {
    const auto uniform = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
    scene.materials = {{"plaster", Color{0.7}, Color{0.0}}, {"grass", Color{0.1, 0.3, 0.1}, Color{0.0}}, {"sky", Color{0.0}, Color{1.0}}};
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 2; ++column) {
        const double x = 4.0 * column + uniform(0.3, 1.0), z = 0.6 + row + uniform(0.0, 0.5);
        slabs.push_back({{x, -uniform(0.03, 0.1), z}, {x + uniform(1.5, 2.5), 0.1, z + uniform(0.05, 0.2)}});
      }
    }
    scene.objects = {scenes::object("world", scenes::box({-30, -30, 0}, {38, 30, 20}), 2, true),
                     scenes::object("wall", scenes::box({-1, 0, 0}, {9, 4, 7}), 0)};
    scene.objects[0].material = {2, 2, 2, 2, 1, 2};
    for (const Slab& slab : slabs) {
      scene.objects.push_back(scenes::object("slab" + std::to_string(scene.objects.size()), scenes::box(slab.from, slab.to), 0));
    }
  }
};

// The relative errors of interpolated indirect light in a quarter of the pixels that show the wall less than 6 cm, five pixels, beneath a
// slab.
std::vector<double> errors_beneath_slabs(radiosity::Random& random) {
  const Facade facade{random};
  const radiosity::Solution solution = scenes::solved(facade.scene, {.epsilon = 0.1, .audit_points = 0});
  const radiosity::FinalGather light{facade.scene, solution.mesh, solution.frame};
  const radiosity::Camera camera{.eye = {2.0 + 4.0 * random.uniform(), -9.0, 2.0}, .forward = {0.0, 1.0, 0.15}, .field_of_view = 55.0};
  const radiosity::View view = radiosity::make_view(camera, {800, 600});
  const radiosity::Control control;
  const radiosity::PictureBlocks blocks{view.size, 0, control};
  radiosity::SeenSurfaces seen{light, view, blocks};
  radiosity::IndirectLight indirect{light, view.size, blocks, seen};
  REQUIRE(seen.look());
  REQUIRE(indirect.gather(0.0, 1.0));
  std::vector<double> result;
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    for (const radiosity::Fragment& f : seen.of(b)) {
      const glm::dvec3 x = f.place.point.position / solution.frame.scale + solution.frame.centre;
      const bool beneath = std::any_of(facade.slabs.begin(), facade.slabs.end(), [&](const Slab& slab) {
        return x.x > slab.from.x && x.x < slab.to.x && x.z < slab.from.z && x.z > slab.from.z - 0.06;
      });
      if (f.place.object != 1 || f.share < 1.0f || !beneath || random.uniform() > 0.25) { continue; }
      const Color truth = indirect.gathered(f, {1024, 4096, 0.01, 1024}).irradiance;
      result.push_back(glm::length(indirect.at(f) - truth) / glm::length(truth));
    }
  }
  return result;
}

}  // namespace

// Points may be off by 3 % and bend between pixels; what is more than 20 % off shows as a stain. Of 17 600 pixels of eight facades one was,
// 0.006 %; where spheres were limited by their own rays alone, 0.4 to 6.5 % of each facade's, because points that do not notice a slab lent
// the open wall's light to what lies beneath it.
TEST_CASE("beneath a slab that stands out of a wall a picture shows the indirect light that is gathered there", "[picture][accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  std::size_t all = 0, stained = 0;
  for (int round = 0; round < 2; ++round) {
    const std::vector<double> errors = errors_beneath_slabs(random);
    all += errors.size();
    stained += static_cast<std::size_t>(std::count_if(errors.begin(), errors.end(), [](double error) { return error > 0.2; }));
  }
  CAPTURE(all, stained);
  REQUIRE(all > 2000);
  CHECK(static_cast<double>(stained) < 0.001 * static_cast<double>(all));
}
