// SPDX-License-Identifier: MIT
// Models whose lamps are no polygons, such as spheres of MGF and VRML.
#include <string>

#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/scene.hpp>

#include <radiosity/scene/bounds.hpp>
#include <radiosity/scene/scene.hpp>

#include "apps/intake/light_views.hpp"
#include "catch.hpp"
#include "models.hpp"

using models::scene;

TEST_CASE("a room whose only lamp is a ball without polygons is seen and lit within") {
  const std::string room =
                        "v a =\n p 0 0 0\nv b =\n p 4 0 0\nv c =\n p 4 4 0\nv d =\n p 0 4 0\n"
                        "v e =\n p 0 0 3\nv f =\n p 4 0 3\nv g =\n p 4 4 3\nv h =\n p 0 4 3\n"
                        "m wall =\n sides 1\n rd .5\n",
                    inwards = "f a b c d\nf e h g f\nf a e f b\nf b f g c\nf c g h d\nf d h e a\n",
                    outwards = "f d c b a\nf f g h e\nf b f e a\nf c g f b\nf d h g c\nf a e h d\n",
                    ball = "v i =\n p 2 2 2\nm lamp =\n ed 179\nsph i .2\n";
  for (const std::string& walls : {inwards, outwards}) {
    const apps::SceneFile taken = scene("a.mgf", room + walls + ball);
    REQUIRE(taken.scene.objects.size() == 2);
    const raycast::Scene objects{radiosity::placed_objects(taken.scene)};
    const auto hit = objects.closest({{1, 1, 1}, {0, 0, -2}});
    REQUIRE(hit);
    CHECK(hit->front);
    CHECK(hit->t == Approx(0.5));
  }
}

TEST_CASE("a slab into which a ball that shines is sunk by half, and a block under a sky that shines, are no rooms") {
  const std::string block =
                        "m grey =\n sides 1\n rd .5\nv a =\n p -2 -2 2.5\nv b =\n p 2 -2 2.5\nv c =\n p 2 2 2.5\nv d =\n p -2 2 2.5\n"
                        "v e =\n p -2 -2 3\nv f =\n p 2 -2 3\nv g =\n p 2 2 3\nv h =\n p -2 2 3\n"
                        "f d c b a\nf f g h e\nf b f e a\nf c g f b\nf d h g c\nf a e h d\n",
                    lamp = "m lamp =\n sides 1\n ed 179\n", ball = "v o =\n p 0 0 2.55\nsph o .2\n", sky = "v o =\n p 0 0 2.8\nsph o -50\n";
  for (const std::string& shape : {ball, sky}) {
    const apps::SceneFile taken = scene("a.mgf", block + lamp + shape);
    const raycast::Scene objects{radiosity::placed_objects(taken.scene)};
    const auto hit = objects.closest({{1, 1, 0}, {0, 0, 5}});
    REQUIRE(hit);
    CHECK(hit->front);
    CHECK(hit->t == Approx(0.5));
  }
}

TEST_CASE("a ball that shines lights what is beside and below it as well as what is above it") {
  const radiosity::Scene scene{
      {{"grey", radiosity::Color(0.5), radiosity::Color(0.0)}, {"lamp", radiosity::Color(0.0), radiosity::Color(1.0)}},
      {{"floor", raycast::Polygon::make({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}).object, {}, {0}},
       {"ball", raycast::Sphere::make({0, 0, 3}, 0.2).object, {}, {1}}}};
  const radiosity::Camera down{.eye = {0.0, -0.1, 2.0}, .forward = {0.0, 0.1, -1.0}, .field_of_view = 40.0};
  CHECK(apps::LightViews(scene).lit_share(down) == 1.0);
}
