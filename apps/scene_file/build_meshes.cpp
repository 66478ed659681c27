// SPDX-License-Identifier: MIT
// Meshes from files of other programs, within a scene.

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include "apps/scene_file/builder.hpp"

namespace apps::scene_file {

namespace {

// Do the parts show the same sides: was there nothing new to see?
bool same_sides(const std::vector<radiosity::SceneObject>& a, const std::vector<radiosity::SceneObject>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const radiosity::SceneObject& one, const radiosity::SceneObject& other) {
    if (one.placement.inside != other.placement.inside || one.shape->sheet_count() != other.shape->sheet_count()) { return false; }
    const glm::dvec3 centre = one.shape->bounds().centre();
    for (std::uint32_t sheet = 0; sheet < one.shape->sheet_count(); ++sheet) {
      const raycast::SurfacePoint p = one.shape->project(sheet, centre), q = other.shape->project(sheet, centre);
      if (p.position != q.position || !(glm::dot(p.normal, q.normal) > 0.0)) { return false; }
    }
    return true;
  });
}

}  // namespace

// Is it a statement of the scene itself, and not of a group?
bool Builder::stands_alone(const ObjectSyntax& object) const {
  const auto own = [&](const Item& item) { return std::get_if<ObjectSyntax>(&item) == &object; };
  return std::any_of(syntax_.items.begin(), syntax_.items.end(), own);
}

// The eyes of the cameras in the coordinates of a mesh that stands in the scene itself. Where a group stands is not known yet.
std::vector<glm::dvec3> Builder::eyes_of(const ObjectSyntax& object) const {
  std::vector<glm::dvec3> eyes;
  if (!stands_alone(object)) { return eyes; }
  for (const radiosity::Camera& camera : file_.cameras) {
    if (const auto eye = point_within(object.placement, camera.eye)) { eyes.push_back(*eye); }
  }
  return eyes;
}

// The objects of a file of another program, in its own coordinates. Its materials are added to the scene's, under the name of the mesh.
Made Builder::make_from_file(const ObjectSyntax& object) {
  Made made;
  auto part = mesh_from_file(object, side_file_, eyes_of(object), errors_);
  if (!part) { return made; }
  made.notes = std::move(part->notes);
  made.first_material = static_cast<std::uint32_t>(file_.scene.materials.size());
  if (!object.material) {
    for (radiosity::Material& material : part->scene.materials) {
      material.name = object.name.text + "." + material.name;
      file_.scene.materials.push_back(std::move(material));
    }
  }
  take_parts(std::move(*part), object, made.first_material, made.parts);
  return made;
}

// `first`: the number of the first material of the file in the scene.
void Builder::take_parts(SceneFile part, const ObjectSyntax& object, std::uint32_t first, std::vector<radiosity::SceneObject>& parts) {
  const auto whole = object.material ? material_index(*object.material) : std::nullopt;
  for (radiosity::SceneObject& its : part.scene.objects) {
    for (std::uint32_t& m : its.material) { m = object.material ? whole.value_or(0) : first + m; }
    if (object.material) { its.material.resize(1); }
  }
  parts = std::move(part.scene.objects);
}

// Makes those meshes anew among which there is a camera or a lamp that was not known when they were made.
void Builder::see_from_inside() {
  if (std::none_of(made_.begin(), made_.end(), [](const auto& made) { return !made.second.parts.empty(); })) { return; }
  for (const radiosity::Camera& camera : file_.cameras) { eyes_.add(camera); }
  const auto each = [&](const PlaceObject& visit) { place_all(syntax_.items, groups_, errors_, visit); };
  each([&](const ObjectSyntax& object, const std::string&, const raycast::Placement& outer, Place) {
    const Made& made = made_.at(&object);
    raycast::Placement placement = raycast::compose(outer, object.placement);
    if (raycast::check(placement)) { return; }  // that is told when it is placed
    for (const radiosity::SceneObject& part : made.parts) {
      eyes_.add_lamps({{}, part.shape, raycast::compose(placement, part.placement), part.material}, file_.scene.materials, &object);
    }
    if (made.shape != nullptr) { eyes_.add_lamps({{}, made.shape, placement, made.material}, file_.scene.materials, &object); }
  });
  std::unordered_map<const ObjectSyntax*, std::vector<glm::dvec3>> eyes;
  std::vector<const ObjectSyntax*> order;
  each([&](const ObjectSyntax& object, const std::string&, const raycast::Placement& outer, Place) {
    const Made& made = made_.at(&object);
    if (made.parts.empty()) { return; }
    const auto [known, is_new] = eyes.try_emplace(&object);
    if (is_new) { order.push_back(&object); }
    constexpr std::size_t most = 1000;
    for (const glm::dvec3& eye : eyes_.within(bounds_of(made.parts), raycast::compose(outer, object.placement), &object)) {
      if (known->second.size() < most) { known->second.push_back(eye); }
    }
  });
  for (const ObjectSyntax* const object : order) {
    Made& made = made_.at(object);
    std::vector<glm::dvec3>& its = eyes.at(object);
    for (const glm::dvec3& eye : eyes_of(*object)) {
      if (std::find(its.begin(), its.end(), eye) == its.end()) { its.push_back(eye); }
    }
    if (its.size() == eyes_of(*object).size()) { continue; }
    auto part = mesh_from_file(*object, side_file_, its, errors_);
    if (!part) { return; }
    if (same_sides(made.parts, part->scene.objects)) { continue; }
    made.notes = std::move(part->notes);
    take_parts(std::move(*part), *object, made.first_material, made.around_eyes);
    if (stands_alone(*object)) { made.parts = std::move(made.around_eyes); }
  }
}

}  // namespace apps::scene_file
