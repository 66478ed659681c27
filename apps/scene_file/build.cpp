// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/handles.hpp>

#include <raycast/transform.hpp>

#include <radiosity/scene/bounds.hpp>

#include "apps/scene_file/build.hpp"
#include "apps/text.hpp"
#include "apps/words.hpp"

namespace apps::scene_file {
SceneFile Builder::build() {
  materials();
  cameras();
  unique_names(syntax_.items);
  make(syntax_.items);
  for (const GroupSyntax& group : syntax_.groups) {
    unique_names(group.items);
    make(group.items);
  }
  if (errors_.count() == 0) { see_from_inside(); }
  if (errors_.count() == 0) { place(); }
  if (errors_.count() == 0 && file_.scene.objects.empty()) {
    std::vector<std::string_view> words;
    for (const ObjectKind& kind : object_kinds()) { words.push_back(kind.word); }
    words.push_back("use");
    errors_.add({1, 1}, "the scene is empty; expected at least one object (" + list_of(words) + ")");
  }
  return std::move(file_);
}

void Builder::materials() {
  for (const MaterialSyntax& material : syntax_.materials) {
    const auto index = static_cast<std::uint32_t>(file_.scene.materials.size());
    const auto [earlier, is_new] = material_index_.emplace(material.name.text, index);
    if (!is_new) {
      errors_.add(material.name.place, "the material " + in_quotes(material.name.text) + " is given twice; the first one stands at " +
                                           to_string(syntax_.materials[earlier->second].name.place));
    }
    if (material_names_.size() < 1000) { material_names_.push_back(material.name.text); }
    file_.scene.materials.push_back({material.name.text, material.reflectance, material.emission});
  }
}

void Builder::cameras() {
  std::unordered_map<std::string_view, Place> names;
  for (const CameraSyntax& syntax : syntax_.cameras) {
    const auto [earlier, is_new] = names.emplace(syntax.camera.name, syntax.place);
    if (!is_new) {
      errors_.add(syntax.place,
                  "camera " + in_quotes(syntax.camera.name) + ": its name is taken; the first one stands at " + to_string(earlier->second));
    }
    if (syntax.sound) { file_.cameras.push_back(make_camera(syntax, errors_)); }
  }
}

void Builder::unique_names(const std::vector<Item>& items) {
  std::unordered_map<std::string_view, Place> names;
  for (const Item& item : items) {
    const Name& name = std::visit([](const auto& it) -> const Name& { return it.name; }, item);
    const auto [earlier, is_new] = names.emplace(name.text, name.place);
    if (!is_new) {
      errors_.add(name.place, "the name " + in_quotes(name.text) + " is taken; the first one stands at " + to_string(earlier->second));
    }
  }
}

void Builder::make(const std::vector<Item>& items) {
  for (const Item& item : items) {
    const auto* object = std::get_if<ObjectSyntax>(&item);
    if (object == nullptr || !object->sound || errors_.full()) { continue; }
    Made made = object->file ? make_from_file(*object) : make(*object);
    if (made.shape == nullptr && made.parts.empty()) { continue; }
    if (object->inside && !made.shape->solid()) {
      errors_.add(*object->inside, "'inside' needs a closed solid; " + in_quotes(object->name.text) + " has no inside");
    }
    made_.emplace(object, std::move(made));
  }
}

Made Builder::make(const ObjectSyntax& object) {
  if (!is_csg(*object.kind)) {
    Made made{object.kind->make(object, errors_), {}};
    if (made.shape != nullptr) { made.material = sheet_materials(object, *made.shape); }
    return made;
  }
  ObjectSyntax whole = object;
  if (!groups_.expand(whole, errors_)) { return {}; }
  const CsgShape csg = make_csg(whole, errors_);
  Made made{csg.whole, {}};
  std::size_t leaf = 0;
  operand_materials(whole, nullptr, csg, leaf, made.material);
  return made;
}

// Appends one material for every sheet of every leaf, in order: that of the leaf, or of the nearest enclosing statement that has one.
void Builder::operand_materials(const ObjectSyntax& object, const Name* around, const CsgShape& csg, std::size_t& leaf,
                                std::vector<std::uint32_t>& out) {
  if (is_csg(*object.kind)) {
    const Name* const own = object.material ? &*object.material : around;
    for (const ObjectSyntax& operand : object.operands) { operand_materials(operand, own, csg, leaf, out); }
    return;
  }
  const raycast::Object* const shape = csg.leaves[leaf++].get();
  if (shape == nullptr) { return; }
  const std::vector<std::uint32_t> list = sheet_materials(object, *shape, around);
  out.insert(out.end(), list.begin(), list.end());
  if (list.size() == 1) { out.insert(out.end(), shape->sheet_count() - 1, list[0]); }
}

std::optional<std::uint32_t> Builder::material_index(const Name& name) {
  const auto found = material_index_.find(name.text);
  if (found != material_index_.end()) { return found->second; }
  if (syntax_.complete) {
    errors_.add(name.place, "there is no material " + in_quotes(name.text) + suggestion(name.text, material_names_));
  }
  return std::nullopt;
}

// Sheets by name; sheets without names are known by their numbers only.
static SheetNames sheet_names(const raycast::Object& shape) {
  SheetNames names;
  for (std::uint32_t i = 0; i < shape.sheet_count(); ++i) { names.emplace(shape.sheet_name(i), i); }
  return names;
}

// Finds the sheet by its name or number; sheet_count() after an error.
std::uint32_t Builder::sheet_index(const Name& sheet, const raycast::Object& shape, const SheetNames& names) {
  const std::uint32_t count = shape.sheet_count();
  const std::string_view text = sheet.text;
  if (const auto found = names.find(text); found != names.end()) { return found->second; }
  if (const auto number = number_in<std::uint32_t>(text); number && *number < count) { return *number; }
  std::vector<std::string_view> known;
  for (std::uint32_t i = 0; i < std::min(count, 100U); ++i) { known.push_back(shape.sheet_name(i)); }
  errors_.add(sheet.place,
              "there is no sheet " + in_quotes(text) + "; expected " + (count == 1 ? "none: the object has one sheet" : list_of(known)));
  return count;
}

std::vector<std::uint32_t> Builder::sheet_materials(const ObjectSyntax& object, const raycast::Object& shape, const Name* around) {
  constexpr std::uint32_t no_material = brep::invalid_index;
  const Name* const given_material = object.material ? &*object.material : around;
  const std::uint32_t whole = given_material != nullptr ? material_index(*given_material).value_or(0) : no_material;
  if (object.sheets.empty()) {
    if (whole == no_material) {
      errors_.add(object.name.place, in_quotes(object.name.text) + " has no material, and nothing around it has one");
    }
    return {whole};
  }
  std::vector<std::uint32_t> result(shape.sheet_count(), whole);
  const SheetNames names = sheet_names(shape);
  std::vector<bool> given(shape.sheet_count(), false);
  for (const SheetSyntax& sheet : object.sheets) {
    const std::uint32_t material = material_index(sheet.material).value_or(0);
    const std::uint32_t index = sheet_index(sheet.sheet, shape, names);
    if (index == result.size()) { continue; }
    if (given[index]) { errors_.add(sheet.sheet.place, "the sheet " + in_quotes(sheet.sheet.text) + " is given twice"); }
    given[index] = true;
    result[index] = material;
  }
  const auto bare = std::find(result.begin(), result.end(), no_material);
  if (bare != result.end()) {
    const auto index = static_cast<std::uint32_t>(bare - result.begin());
    errors_.add(object.name.place, in_quotes(object.name.text) + " has no material for its sheet " + in_quotes(shape.sheet_name(index)));
  }
  return result;
}

void Builder::place() {
  const auto tell = [&](const std::vector<Item>& items) {
    for (const Item& item : items) {
      const auto* const object = std::get_if<ObjectSyntax>(&item);
      const auto made = object == nullptr ? made_.end() : made_.find(object);
      if (made == made_.end()) { continue; }
      for (const std::string& note : made->second.notes) { file_.notes.push_back(object->name.text + ": " + note); }
    }
  };
  tell(syntax_.items);
  for (const GroupSyntax& group : syntax_.groups) { tell(group.items); }
  place_all(syntax_.items, groups_, errors_,
            [this](const ObjectSyntax& object, const std::string& prefix, const raycast::Placement& outer, Place at) {
              place(object, prefix, outer, at);
            });
}

void Builder::place(const ObjectSyntax& object, const std::string& prefix, const raycast::Placement& outer, Place at) {
  const Made& made = made_.at(&object);
  raycast::Placement placement = raycast::compose(outer, object.placement);
  const std::string name = prefix + object.name.text;
  const bool seen_inside = !made.around_eyes.empty() && !eyes_.within(bounds_of(made.parts), placement, &object).empty();
  for (const radiosity::SceneObject& part : seen_inside ? made.around_eyes : made.parts) {
    place({name + "." + part.name, part.shape, raycast::compose(placement, part.placement), part.material}, object, at);
  }
  if (!made.parts.empty()) { return; }
  placement.inside = object.inside.has_value();
  place({name, made.shape, placement, made.material}, object, at);
}

void Builder::place(radiosity::SceneObject placed, const ObjectSyntax& object, Place at) {
  const std::string& name = placed.name;
  if (file_.scene.objects.size() >= max_objects) {
    if (!errors_.just_reported(at)) { errors_.add(at, "the scene grows beyond " + std::to_string(max_objects) + " objects here"); }
    return;
  }
  if (const auto sentence = raycast::check(placed.placement)) {
    errors_.add(at, in_quotes(name) + ": " + std::string(*sentence));
    return;
  }
  if (!(radiosity::placed_bounds(*placed.shape, placed.placement).magnitude() <= max_number)) {
    errors_.add(at, in_quotes(name) + " reaches beyond 1e30 after its placement");
    return;
  }
  file_.scene.objects.push_back(std::move(placed));
  file_.origins.push_back({object.kind->word, object.name.place});
}

radiosity::Camera make_camera(const CameraSyntax& syntax, Errors& errors) {
  radiosity::Camera camera = syntax.camera;
  const std::string who = "camera " + in_quotes(camera.name) + ": ";
  const auto parallel = [&](const glm::dvec3& up) {
    return glm::length(glm::cross(camera.forward, up)) <= 1e-9 * glm::length(camera.forward) * glm::length(up);
  };
  if (!(glm::length(camera.forward) > 0.0)) {
    errors.add(syntax.place, who + "it looks nowhere; 'target' differs from 'eye', 'look' is not 0 0 0");
  } else if (camera.up == glm::dvec3(0.0)) {
    camera.up = parallel({0.0, 0.0, 1.0}) ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
  } else if (parallel(camera.up)) {
    errors.add(syntax.place, who + "'up' points along the view");
  }
  return camera;
}

SceneFile build(const SceneSyntax& syntax, const SideFile& side_file, Errors& errors) { return Builder(syntax, side_file, errors).build(); }

}  // namespace apps::scene_file
