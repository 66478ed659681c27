// SPDX-License-Identifier: MIT

// A gathered picture of a curved surface shows the light at what is seen through the middle of each pixel.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/cone.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/superquadric.hpp>
#include <raycast/objects/torus.hpp>

#include <radiosity/camera/gather_picture.hpp>
#include <radiosity/camera/view.hpp>
#include <radiosity/picture/final_gather.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace {

constexpr glm::dvec3 lamp_centre{-3.0, -4.0, 3.0};
constexpr double lamp_radius = 0.05, lamp_exitance = 1e4, dark_reflectance = 1e-3;

std::vector<std::shared_ptr<const raycast::Object>> curved_things() {
  return {raycast::Sphere::make({0, 0, 0}, 1.0).object, raycast::Cylinder::make({0, 0, -1}, {0, 0, 2}, 0.8).object,
          raycast::Cone::make({0, 0, -1}, {0, 0, 2}, 1.0, 0.3).object, raycast::Torus::make({0, 0, 0}, {0, 1, 0}, 0.7, 0.3).object,
          raycast::Superquadric::make({0, 0, 0}, {1.0, 0.8, 0.9}, 0.8, 1.2).object};
}

}  // namespace

// The light at that one of four rays which is nearest to the middle of the pixel, a third of a pixel beside it, would be off by .6 to 1.8 %
// of the brightest in the mean, to the other side above and below the middle of the picture.
TEST_CASE("a gathered picture shows curved surfaces where they are, not beside it", "[picture]") {
  for (const auto& shape : curved_things()) {
    // So dark that what a torus reflects onto itself does not count.
    radiosity::Scene scene{{{"dark", radiosity::Color{dark_reflectance}, radiosity::Color{0.0}},
                            {"lamp", radiosity::Color{0.0}, radiosity::Color{lamp_exitance}}},
                           {}};
    scene.objects = {scenes::object("thing", shape), scenes::object("lamp", raycast::Sphere::make(lamp_centre, lamp_radius).object, 1)};
    const radiosity::Options options{.epsilon = 0.1, .min_area = 1e-2, .audit_points = 0};
    const radiosity::Solution solution = scenes::solved(scene, options);
    const radiosity::FinalGather light{scene, solution.mesh, solution.frame};
    const radiosity::Camera camera{.eye = {0, -6, 0.5}, .forward = {0, 6, -0.5}, .field_of_view = 22};
    const radiosity::View view = radiosity::make_view(camera, {49, 49});
    const radiosity::Picture picture = radiosity::draw(light, view, 1.0).value();
    const raycast::Scene objects{{raycast::PlacedObject{shape}}};
    const auto in_middle = [&](double x, double y) -> std::optional<raycast::SurfacePoint> {
      const raycast::Segment ray{view.eye, view.direction(x, y)};
      const auto hit = objects.closest(ray);
      if (!hit) { return std::nullopt; }
      return objects.point(*hit, ray);
    };
    double brightest = 0.0, square = 0.0;
    int count = 0;
    for (const radiosity::Color& c : picture.radiosity) { brightest = std::max(brightest, c.x); }
    for (std::uint32_t y = 0; y < 49; ++y) {
      for (std::uint32_t x = 0; x < 49; ++x) {
        const auto hit = in_middle(x + 0.5, y + 0.5);
        if (!hit) { continue; }
        bool whole = true;  // no outline or crease through it or beside it
        for (const double u : {-1.0, 0.0, 1.0, 2.0}) {
          for (const double v : {-1.0, 0.0, 1.0, 2.0}) {
            const auto other = in_middle(x + u, y + v);
            whole = whole && other && glm::dot(other->normal, hit->normal) > 0.95;
          }
        }
        const glm::dvec3 d = lamp_centre - hit->position;
        const double r = glm::length(d), cosine = glm::dot(hit->normal, d) / r;
        const bool lit = cosine > 0.1 && !objects.closest(raycast::Segment{hit->position + 1e-6 * hit->normal, d});
        if (!whole || !lit) { continue; }
        const double exact = dark_reflectance * lamp_exitance * cosine * lamp_radius * lamp_radius / (r * r);
        const double off = picture.radiosity[std::size_t{y} * 49 + x].x / brightest - exact / brightest;
        square += off * off;
        ++count;
      }
    }
    REQUIRE(count > 100);
    CAPTURE(count, square);
    CHECK(std::sqrt(square / count) < 0.001);
  }
}
