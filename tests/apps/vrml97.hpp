// SPDX-License-Identifier: MIT
#pragma once

// VRML 97 as text for the tests of its reader, without the first line of the file, and a check that two models are the same.

#include <cstddef>
#include <string>

#include <radiosity/scene/bounds.hpp>

#include "models.hpp"
#include "vrml_twins.hpp"

namespace vrml97 {

inline apps::Model read(const std::string& body, const models::Files& files = {}) {
  return models::read("a.wrl", vrml_twins::head + body, files);
}
inline std::string error(const std::string& body, const models::Files& files = {}) {
  return models::error("a.wrl", vrml_twins::head + body, files);
}

inline void check_same(const apps::Model& a, const apps::Model& b) {
  const auto same_look = [](const apps::ModelMaterial& m, const apps::ModelMaterial& n) {
    return m.reflectance == n.reflectance && m.emission == n.emission && m.two_sided == n.two_sided;
  };
  REQUIRE(a.objects.size() == b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    const radiosity::SceneObject &x = a.objects[i], &y = b.objects[i];
    CHECK(x.placement.linear == y.placement.linear);
    CHECK(x.placement.translation == y.placement.translation);
    CHECK(radiosity::placed_bounds(*x.shape, x.placement).hi == radiosity::placed_bounds(*y.shape, y.placement).hi);
    CHECK(x.shape->sheet_count() == y.shape->sheet_count());
    CHECK(same_look(a.materials[x.material[0]], b.materials[y.material[0]]));
  }
  CHECK(a.positions == b.positions);
  CHECK(a.corners == b.corners);
  CHECK(a.first_corner == b.first_corner);
  REQUIRE(a.polygons() == b.polygons());
  for (std::size_t p = 0; p < a.polygons(); ++p) { CHECK(same_look(a.materials[a.material[p]], b.materials[b.material[p]])); }
  REQUIRE((a.cameras.size() == 1 && b.cameras.size() == 1 && a.lights.size() == 1 && b.lights.size() == 1));
  CHECK(a.cameras[0].name == b.cameras[0].name);
  CHECK(a.cameras[0].forward == b.cameras[0].forward);
  CHECK(a.cameras[0].field_of_view == b.cameras[0].field_of_view);
  CHECK(a.lights[0].position == b.lights[0].position);
  CHECK(a.lights[0].intensity == b.lights[0].intensity);
}

}  // namespace vrml97
