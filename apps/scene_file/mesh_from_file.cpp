// SPDX-License-Identifier: MIT
#include "apps/scene_file/mesh_from_file.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <raycast/object.hpp>

#include <radiosity/scene/bounds.hpp>

#include "apps/intake/to_scene.hpp"
#include "apps/scene_file/lexer.hpp"
#include "apps/words.hpp"

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
  std::vector<std::string> faults;
  auto part = to_part(std::move(*read.model), object.two_sided.has_value(), eyes, faults);
  for (const std::string& sentence : faults) { errors.add(file.place, file.text + ": " + sentence); }
  return part;
}

raycast::Box bounds_of(const std::vector<radiosity::SceneObject>& parts) {
  raycast::Box box;
  for (const radiosity::SceneObject& part : parts) {
    const raycast::Box its = radiosity::placed_bounds(*part.shape, part.placement);
    box.extend(its.lo);
    box.extend(its.hi);
  }
  return box;
}

std::optional<glm::dvec3> point_within(const raycast::Placement& placement, const glm::dvec3& point) {
  const double volume = glm::determinant(placement.linear);
  if (volume == 0.0 || !std::isfinite(volume)) { return std::nullopt; }
  return glm::inverse(placement.linear) * (point - placement.translation);
}

void Eyes::add_lamps(const radiosity::SceneObject& placed, const std::vector<radiosity::Material>& materials, const ObjectSyntax* of) {
  constexpr double before = 1e-4;  // of the lamp's size: a lamp may lie on a wall
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

std::vector<glm::dvec3> Eyes::within(const raycast::Box& box, const raycast::Placement& placement, const ObjectSyntax* mesh) const {
  const raycast::Box inner = box.grown(-1e-9 * box.diameter());  // what lies on its sides is not within
  std::vector<glm::dvec3> list;
  std::vector<glm::dvec3> its;  // of one camera or lamp
  for (std::size_t i = 0, first = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    if (point.lamp != points_[first].lamp) { first = i; }
    const auto here = point.of == mesh ? std::nullopt : point_within(placement, point.position);
    if (here && inner.contains(*here)) { its.push_back(*here); }
    if (i + 1 < points_.size() && points_[i + 1].lamp == point.lamp) { continue; }
    if (2 * its.size() > i - first) { list.insert(list.end(), its.begin(), its.end()); }
    its.clear();
  }
  return list;
}

}  // namespace apps::scene_file
