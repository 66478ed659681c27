// SPDX-License-Identifier: MIT
#include "apps/scene_file/uses.hpp"

#include <optional>
#include <variant>

#include "apps/scene_file.hpp"
#include "apps/scene_graph.hpp"

namespace apps::scene_file {
namespace {

class Uses {
 public:
  struct State {
    std::string prefix;
    raycast::Placement placement;
    std::optional<Place> at;  // of the statement of the file, once within one
  };
  Uses(const std::vector<Item>& items, const Groups& groups, Errors& errors, const PlaceObject& place)
      : items_(items), groups_(groups), errors_(errors), place_(place) {}

  bool enter(const Item* item, State& state) {
    if (item == nullptr) { return true; }  // the root
    const auto* const use = std::get_if<UseSyntax>(item);
    if (!state.at) {
      state.at = std::visit([](const auto& it) { return it.name.place; }, *item);
      placed_ += use == nullptr ? 1 : groups_.size(*groups_.find(use->group));
      if (placed_ > max_objects) {
        errors_.add(*state.at, "the scene grows beyond " + std::to_string(max_objects) + " objects here");
        return false;
      }
    }
    if (use == nullptr) {
      place_(std::get<ObjectSyntax>(*item), state.prefix, state.placement, *state.at);
    } else {
      state.prefix += use->name.text + ".";
      state.placement = raycast::compose(state.placement, use->placement);
    }
    return errors_.count() == 0;
  }

  [[nodiscard]] std::vector<const Item*> children(const Item* item) const {
    const auto* const use = item == nullptr ? nullptr : std::get_if<UseSyntax>(item);
    std::vector<const Item*> list;
    if (item != nullptr && use == nullptr) { return list; }
    for (const Item& child : use == nullptr ? items_ : groups_.find(use->group)->items) { list.push_back(&child); }
    return list;
  }

  void leave(const Item*, const State& before, State& state) const { state = before; }

 private:
  const std::vector<Item>& items_;
  const Groups& groups_;
  Errors& errors_;
  const PlaceObject& place_;
  std::size_t placed_ = 0;
};

}  // namespace

void place_all(const std::vector<Item>& items, const Groups& groups, Errors& errors, const PlaceObject& place) {
  Uses uses(items, groups, errors, place);
  Uses::State state;
  const Item* const root = nullptr;
  // Every use leads to an object, so that most_visits is never reached; what ends the walk is among the errors.
  static_cast<void>(GraphWalk<Uses, Uses::State>(uses, {max_use_depth + 2, 2 * max_use_depth * max_objects}).visit(root, state));
}

}  // namespace apps::scene_file
