// SPDX-License-Identifier: MIT
#include "apps/intake/panes.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "apps/mesh_file/reading.hpp"
#include "apps/text.hpp"

namespace apps {

Panes::Panes(const Model& model, std::span<const radiosity::Material> materials) {
  std::vector<std::uint8_t> of_material;
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    of_material.push_back(model.materials[m].opacity < least_opacity && radiosity::is_black(materials[m].emission) ? 1 : 0);
  }
  std::swap(of_material_, of_material);
  polygons_ = static_cast<std::size_t>(
      std::count_if(model.material.begin(), model.material.end(), [this](std::uint32_t m) { return of_material_[m] != 0; }));
  objects_ = static_cast<std::size_t>(
      std::count_if(model.objects.begin(), model.objects.end(), [this](const auto& object) { return has(object); }));
  const bool all = polygons_ == model.polygons() && objects_ == model.objects.size();
  if (all || polygons_ + objects_ == 0) {
    of_material_.clear();
    polygons_ = objects_ = 0;
  }
  for (std::uint32_t p = 0; polygons_ > 0 && p < model.polygons(); ++p) {
    if (of_material_[model.material[p]] != 0) { continue; }
    number_.push_back(p);
    corners_.insert(corners_.end(), model.corners.begin() + model.first_corner[p], model.corners.begin() + model.first_corner[p + 1]);
    first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
    material_.push_back(model.material[p]);
    group_.push_back(model.group[p]);
  }
}

bool Panes::has(const radiosity::SceneObject& object) const {
  return !of_material_.empty() &&
         std::all_of(object.material.begin(), object.material.end(), [this](std::uint32_t m) { return of_material_[m] != 0; });
}

std::string Panes::sentence(const Model& model) const {
  if (polygons_ + objects_ == 0) { return {}; }
  std::set<std::string_view> seen;
  std::string names;  // the first ones in the order of the file
  constexpr std::size_t most_names = 3;
  const auto add = [&](std::uint32_t m) {
    if (of_material_[m] == 0 || !seen.insert(model.materials[m].name).second || seen.size() > most_names + 1) { return; }
    names += (names.empty() ? "" : ", ") + (seen.size() > most_names ? "..." : mesh_file::shown(model.materials[m].name));
  };
  for (const std::uint32_t m : model.material) { add(m); }
  for (const radiosity::SceneObject& object : model.objects) {
    if (has(object)) { add(object.material[0]); }
  }
  std::string what = polygons_ > 0 ? counted(polygons_, "polygon") : std::string();
  if (objects_ > 0) { what += (what.empty() ? "" : " and ") + counted(objects_, "solid"); }
  const bool one = polygons_ + objects_ == 1;
  return what + (one ? " lets" : " let") + " most light through (" + names + "): left out, so that it passes (--opaque)";
}

radiosity::PolygonView Panes::others(const Model& model, std::span<const std::uint8_t> two_sided) const {
  if (polygons_ == 0) { return {model.positions, model.corners, model.first_corner, model.material, model.group, model.groups, two_sided}; }
  return {model.positions, corners_, first_corner_, material_, group_, model.groups, two_sided};
}

void Panes::renumber(radiosity::Intake& intake) const {
  if (polygons_ == 0) { return; }
  for (radiosity::Change& change : intake.changes) {
    for (auto* const polygon : {&change.first, &change.worst}) {
      if (*polygon < number_.size()) { *polygon = number_[*polygon]; }
    }
  }
  std::vector<std::uint32_t> first(number_.size() + polygons_ + 1, 0);
  for (std::size_t i = 0; i < number_.size(); ++i) { first[number_[i] + 1] = static_cast<std::uint32_t>(intake.parts.of(i).size()); }
  for (std::size_t p = 1; p < first.size(); ++p) { first[p] += first[p - 1]; }
  intake.parts.first = std::move(first);
}

}  // namespace apps
