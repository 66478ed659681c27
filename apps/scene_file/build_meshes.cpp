// SPDX-License-Identifier: MIT
// Meshes from files of other programs, within a scene.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/scene/bounds.hpp>

#include "apps/intake/to_scene.hpp"
#include "apps/scene_file/build.hpp"
#include "apps/scene_file/lexer.hpp"

namespace apps::scene_file {

std::optional<SceneFile> mesh_from_file(const ObjectSyntax& object, const SideFile& side_file, const std::vector<glm::dvec3>& eyes,
                                        Errors& errors) {
  const Name& file = *object.file;
  std::string fault = "cannot be read from here";
  const auto bytes = side_file ? side_file(file.text, fault) : std::nullopt;
  if (!bytes) {
    errors.add(file.place, "the file " + in_quotes(file.text) + " " + fault);
    return std::nullopt;
  }
  const ModelFormat* const format = model_format(file.text, *bytes);
  if (format == nullptr) {
    errors.add(file.place,
               "the file " + in_quotes(file.text) + " is of no known format; expected a name that ends with " + model_endings());
    return std::nullopt;
  }
  ModelResult read = format->read(*bytes, side_file);
  for (const InputError& error : read.errors) {
    const std::string at = error.place.line > 0 ? to_string(error.place) : "byte " + std::to_string(error.place.column);
    errors.add(file.place, file.text + ":" + at + ": " + error.sentence);
  }
  if (!read.model) { return std::nullopt; }
  read.model->name_file(file.text);
  if (object.material) {  // replaces the materials of the file
    for (ModelMaterial& material : read.model->materials) {
      material.reflectance = radiosity::Color(0.0);
      material.opacity = 1.0;
    }
  }
  std::vector<std::string> faults;
  auto part = to_part(std::move(*read.model), object.two_sided.has_value(), eyes, faults);
  for (const std::string& sentence : faults) { errors.add(file.place, file.text + ": " + sentence); }
  return part;
}

raycast::Box bounds_of(const std::vector<radiosity::SceneObject>& parts) {
  raycast::Box box;
  for (const radiosity::SceneObject& part : parts) { box.extend(radiosity::placed_bounds(*part.shape, part.placement)); }
  return box;
}

std::optional<glm::dvec3> point_within(const raycast::Placement& placement, const glm::dvec3& point) {
  const double volume = glm::determinant(placement.linear);
  if (volume == 0.0 || !std::isfinite(volume)) { return std::nullopt; }
  return glm::inverse(placement.linear) * (point - placement.translation);
}

void Eyes::add_lamps(const radiosity::SceneObject& placed, const std::vector<radiosity::Material>& materials, const ObjectSyntax* of) {
  constexpr double before = 1e-4;  // relative to the size of the lamp, which may lie on a wall
  const raycast::PlacedObject object(placed.shape, placed.placement);
  const raycast::Box box = object.bounds();
  for (std::uint32_t sheet = 0; sheet < placed.shape->sheet_count() && points_.size() < most; ++sheet) {
    const std::uint32_t material = placed.material[placed.material.size() == 1 ? 0 : sheet];
    if (material >= materials.size() || radiosity::is_black(materials[material].emission)) { continue; }
    const raycast::SurfacePoint at = object.project(sheet, box.centre());
    points_.push_back({at.position + before * box.diameter() * at.normal, of, count_});
  }
  ++count_;
}

// Does some object contain all these points and the mesh with these bounds, and has at least twice its volume?
bool Eyes::larger_room(const raycast::Box& mesh, std::size_t first, std::size_t end, const ObjectSyntax* of) const {
  const auto volume = [](const raycast::Box& box) { return box.size().x * box.size().y * box.size().z; };
  return std::any_of(rooms_.begin(), rooms_.end(), [&](const Room& room) {
    const raycast::Box box = room.bounds.grown(1e-9 * room.bounds.diameter());
    bool holds = room.of != of && volume(box) >= 2.0 * volume(mesh) && box.contains(mesh.lo) && box.contains(mesh.hi);
    for (std::size_t i = first; i < end; ++i) { holds = holds && room.of != points_[i].of && box.contains(points_[i].position); }
    return holds;
  });
}

std::vector<glm::dvec3> Eyes::within(const raycast::Box& box, const raycast::Placement& placement, const ObjectSyntax* mesh) const {
  const raycast::Box inner = box.grown(-1e-9 * box.diameter());  // points on its sides are not inside
  const raycast::Box placed = radiosity::placed_bounds(box, placement);
  std::vector<glm::dvec3> list;
  std::vector<glm::dvec3> its;  // the points of one camera or lamp that are inside
  for (std::size_t i = 0, first = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    if (point.lamp != points_[first].lamp) { first = i; }
    const auto here = point.of == mesh ? std::nullopt : point_within(placement, point.position);
    if (here && inner.contains(*here)) { its.push_back(*here); }
    if (i + 1 < points_.size() && points_[i + 1].lamp == point.lamp) { continue; }
    const std::size_t count = i + 1 - first;
    const bool pierces = !its.empty() && its.size() < count && larger_room(placed, first, i + 1, mesh);
    if (2 * its.size() >= count && !pierces) { list.insert(list.end(), its.begin(), its.end()); }
    its.clear();
  }
  return list;
}

namespace {

// Do the parts show the same sides, so that there is nothing new to see?
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

// Is it a statement of the scene itself, not of a group?
bool Builder::stands_alone(const ObjectSyntax& object) const {
  const auto own = [&](const Item& item) { return std::get_if<ObjectSyntax>(&item) == &object; };
  return std::any_of(syntax_.items.begin(), syntax_.items.end(), own);
}

// The eyes of the cameras in the coordinates of a mesh of the scene itself; empty for a mesh of a group, whose placement is not known yet.
std::vector<glm::dvec3> Builder::eyes_of(const ObjectSyntax& object) const {
  std::vector<glm::dvec3> eyes;
  if (!stands_alone(object)) { return eyes; }
  for (const radiosity::Camera& camera : file_.cameras) {
    if (const auto eye = point_within(object.placement, camera.eye)) { eyes.push_back(*eye); }
  }
  return eyes;
}

// Reads the objects of a file of another program, in its own coordinates. Adds its materials to the scene, prefixed by the name of the
// mesh.
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

// Assigns the scene's materials to the parts. `first`: index in the scene of the file's first material.
void Builder::take_parts(SceneFile part, const ObjectSyntax& object, std::uint32_t first, std::vector<radiosity::SceneObject>& parts) {
  const auto whole = object.material ? material_index(*object.material) : std::nullopt;
  for (radiosity::SceneObject& its : part.scene.objects) {
    for (std::uint32_t& m : its.material) { m = object.material ? whole.value_or(0) : first + m; }
    if (object.material) { its.material.resize(1); }
  }
  parts = std::move(part.scene.objects);
}

// Makes those meshes again that contain a camera or lamp that was not known when they were made.
void Builder::see_from_inside() {
  if (std::none_of(made_.begin(), made_.end(), [](const auto& made) { return !made.second.parts.empty(); })) { return; }
  for (const radiosity::Camera& camera : file_.cameras) { eyes_.add(camera); }
  const auto each = [&](const PlaceObject& visit) { place_all(syntax_.items, groups_, errors_, visit); };
  each([&](const ObjectSyntax& object, const std::string&, const raycast::Placement& outer, Place) {
    const Made& made = made_.at(&object);
    raycast::Placement placement = raycast::compose(outer, object.placement);
    if (raycast::check(placement)) { return; }  // reported when it is placed
    for (const radiosity::SceneObject& part : made.parts) {
      eyes_.add_lamps({{}, part.shape, raycast::compose(placement, part.placement), part.material}, file_.scene.materials, &object);
    }
    if (made.shape != nullptr) { eyes_.add_lamps({{}, made.shape, placement, made.material}, file_.scene.materials, &object); }
    raycast::Box box;
    for (const radiosity::SceneObject& part : made.parts) {
      const raycast::Box its = radiosity::placed_bounds(*part.shape, raycast::compose(placement, part.placement));
      box.extend(its.lo);
      box.extend(its.hi);
    }
    if (object.inside && made.shape != nullptr) { box = radiosity::placed_bounds(*made.shape, placement); }
    if (object.inside || !made.parts.empty()) { eyes_.add_room(box, &object); }
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
