// SPDX-License-Identifier: MIT
// VRML 1.0 against the scene file: a random graph in both formats is one scene, for rays and for light.

#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/scene.hpp>

#include <radiosity/picture/lookup.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/scene/bounds.hpp>

#include "example_scenes.hpp"
#include "models.hpp"
#include "seed.hpp"
#include "vrml_graph.hpp"

namespace {

using vrml_graph::Graph;
using vrml_graph::text;

// Is there something, and does nothing touch anything else, the lamp or the floor?
bool apart(const radiosity::Scene& scene) {
  std::vector<raycast::Box> boxes;
  for (const radiosity::SceneObject& object : scene.objects) { boxes.push_back(radiosity::placed_bounds(*object.shape, object.placement)); }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (!(boxes[i].lo[k] > -10.0 && boxes[i].hi[k] < 10.0 && boxes[i].hi[k] - boxes[i].lo[k] > 0.2)) { return false; }
    }
    for (std::size_t j = 0; j < i; ++j) {
      bool separate = false;
      for (int k = 0; k < 3; ++k) { separate |= boxes[i].lo[k] > boxes[j].hi[k] + 0.1 || boxes[j].lo[k] > boxes[i].hi[k] + 0.1; }
      if (!separate) { return false; }
    }
  }
  return boxes.size() >= 3 && boxes.size() <= 10;
}

const std::string floor_and_lamp_vrml =
    "Separator { ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID }\n"
    "Separator { Material { diffuseColor 0.6 0.6 0.5 } Coordinate3 { point [ -14 -11 -14, -14 -11 14, 14 -11 14, 14 -11 -14 ] }\n"
    "IndexedFaceSet { coordIndex [ 0 1 2 3 ] } }\n"
    "Separator { Material { diffuseColor 0 0 0 emissiveColor 9 8 7 } Coordinate3 { point [ -4 12 -4, 4 12 -4, 4 12 4, -4 12 4 ] }\n"
    "IndexedFaceSet { coordIndex [ 0 1 2 3 ] } } }\n";
std::string floor_and_lamp_scene() {
  return "material floor reflectance 0.6 0.6 0.5\nmaterial lamp reflectance 0 emission " +
         text(std::numbers::pi * glm::dvec3(9.0, 8.0, 7.0)) +
         "\npolygon floor material floor { \n vertex -14 14 -11\n vertex -14 -14 -11\n vertex 14 -14 -11\n vertex 14 14 -11\n}\n"
         "polygon lamp material lamp {\n vertex -4 4 12\n vertex 4 4 12\n vertex 4 -4 12\n vertex -4 -4 12\n}\n";
}

// A scene and its light, asked by rays.
class Lit {
 public:
  explicit Lit(const radiosity::Scene& scene) : scene_(scene), outcome_{radiosity::solve(scene, options())} {
    for (const std::string& sentence : outcome_.failure.sentences) { UNSCOPED_INFO(sentence); }
    REQUIRE(outcome_.solution);
    lookup_.emplace(scene, outcome_.solution->mesh, outcome_.solution->frame);
  }

  struct Met {
    glm::dvec3 at{0.0};
    radiosity::Color reflectance{0.0}, emission{0.0}, radiosity{0.0};
  };
  [[nodiscard]] std::optional<Met> meet(const glm::dvec3& from, const glm::dvec3& along) const {
    const radiosity::Frame& frame = lookup_->frame();
    const glm::dvec3 origin = (from - frame.centre) * frame.scale, direction = along * frame.scale;
    const auto hit = lookup_->objects().closest({origin, direction});
    if (!hit || !hit->front) { return std::nullopt; }
    const glm::dvec3 at = origin + hit->t * direction;
    const auto& of_sheets = scene_.objects[hit->object].material;
    const radiosity::Material& material = scene_.materials[of_sheets.size() == 1 ? of_sheets[0] : of_sheets[hit->sheet]];
    return Met{frame.to_scene(at), material.reflectance, material.emission,
               lookup_->at(hit->object, hit->sheet, at).value_or(radiosity::Color(0.0))};
  }
  // The whole light's relative L2 error is less, in 95 of 100 cases.
  [[nodiscard]] double error() const { return outcome_.solution->audit.surface_error->high; }

 private:
  static radiosity::Options options() { return {.epsilon = 0.05, .min_area = 1e-3}; }

  const radiosity::Scene& scene_;
  radiosity::Outcome outcome_;
  std::optional<radiosity::Lookup> lookup_;
};

void compare(unsigned seed) {
  CAPTURE(seed);
  Graph graph(seed);
  const std::string scene_text = graph.scene() + floor_and_lamp_scene();
  const std::string vrml_text = "#VRML V1.0 ascii\nSeparator {\nSeparator {\n" + graph.vrml() + "}\n" + floor_and_lamp_vrml + "}\n";
  const radiosity::Scene expected = parsed_scene(scene_text), found = models::scene("a.wrl", vrml_text).scene;
  const Lit as_scene(expected), as_vrml(found);
  std::mt19937 random(seed);
  const auto number = [&](double most) { return std::uniform_real_distribution(-most, most)(random); };
  double square = 0.0, reference = 0.0;
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    // From around the things towards one of them.
    const glm::dvec3 from = 25.0 * glm::normalize(glm::dvec3(number(1.0), number(1.0), number(1.0)));
    const radiosity::SceneObject& object = expected.objects[random() % expected.objects.size()];
    const raycast::Box box = radiosity::placed_bounds(*object.shape, object.placement);
    const glm::dvec3 to = 0.5 * (box.lo + box.hi) + 0.5 * (box.hi - box.lo) * glm::dvec3(number(1.0), number(1.0), number(1.0));
    CAPTURE(object.name, from.x, from.y, from.z, to.x, to.y, to.z);
    const auto a = as_scene.meet(from, to - from), b = as_vrml.meet(from, to - from);
    REQUIRE(a.has_value() == b.has_value());
    if (!a) { continue; }
    ++met;
    CHECK(glm::length(a->at - b->at) < 1e-9);
    CHECK(glm::length(a->reflectance - b->reflectance) < 1e-12);
    CHECK(glm::length(a->emission - b->emission) < 1e-12 * (1.0 + glm::length(a->emission)));
    square += glm::dot(a->radiosity - b->radiosity, a->radiosity - b->radiosity);
    reference += glm::dot(a->radiosity - a->emission, a->radiosity - a->emission);
  }
  CHECK(met > 50);
  // Both are off from the same truth by as much as they say.
  CHECK(std::sqrt(square / reference) <= as_scene.error() + as_vrml.error());
}

}  // namespace

TEST_CASE("VRML: a random graph is the scene that a scene file says it is, for rays and for light") {
  const unsigned first = test::seed() % 1'000'000'000U;
  CAPTURE(first);
  int compared = 0;
  for (unsigned seed = first; compared < 6 && seed < first + 8000; ++seed) {
    const std::string things = Graph(seed).scene();
    if (things.empty() || !apart(parsed_scene(things))) { continue; }
    compare(seed);
    ++compared;
  }
  CHECK(compared == 6);
}
