// SPDX-License-Identifier: MIT
#include "apps/scene_file/build.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include "apps/graph_walk.hpp"
#include "apps/scene_file.hpp"
#include "apps/words.hpp"

namespace apps::scene_file {

Groups::Groups(const SceneSyntax& syntax, Errors& errors) : syntax_(&syntax), entries_(syntax.groups.size()) {
  for (std::size_t i = 0; i < syntax.groups.size(); ++i) {
    const Name& name = syntax.groups[i].name;
    const auto [earlier, is_new] = index_.emplace(name.text, i);
    if (!is_new) {
      errors.add(name.place, "the group " + in_quotes(name.text) + " is defined twice; the first one stands at " +
                                 to_string(syntax.groups[earlier->second].name.place));
    }
    if (syntax.groups[i].items.empty()) {
      errors.add(name.place, "the group " + in_quotes(name.text) + " is empty; expected objects between '{' and '}'");
    }
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].state == State::unseen) { visit(i, errors); }
  }
  for (const Item& item : syntax.items) {
    const auto* use = std::get_if<UseSyntax>(&item);
    if (use != nullptr && find(use->group) == nullptr) { report_unknown(use->group, errors); }
  }
}

const GroupSyntax* Groups::find(const Name& group) const {
  const auto found = index_.find(group.text);
  return found == index_.end() ? nullptr : &syntax_->groups[found->second];
}

std::size_t Groups::size(const GroupSyntax& group) const {
  return entries_[static_cast<std::size_t>(&group - syntax_->groups.data())].size;
}

bool Groups::expand(ObjectSyntax& syntax, Errors& errors) const {
  Expansion expansion;
  return expand(syntax, 0, expansion, errors);
}

bool Groups::expand(ObjectSyntax& syntax, std::size_t depth, Expansion& expansion, Errors& errors) const {
  const auto refuse = [&errors](Place place, std::string sentence) {
    errors.add(place, std::move(sentence));
    return false;
  };
  if (depth == max_use_depth) {
    return refuse(syntax.name.place, "unions, intersections and differences are nested deeper than " + std::to_string(max_use_depth));
  }
  if (!expansion.open.empty() && ++expansion.operands > max_used_operands) {
    return refuse(syntax.name.place, "the solid grows beyond " + std::to_string(max_used_operands) + " operands from groups here");
  }
  if (syntax.group) {
    const GroupSyntax* const group = find(*syntax.group);
    if (group == nullptr) {
      report_unknown(*syntax.group, errors);
      return false;
    }
    if (std::find(expansion.open.begin(), expansion.open.end(), group) != expansion.open.end()) {
      return refuse(syntax.group->place, "cyclic use: " + in_quotes(syntax.group->text) + " takes part in itself");
    }
    expansion.open.push_back(group);
    for (const Item& item : group->items) {
      if (const auto* object = std::get_if<ObjectSyntax>(&item)) {
        if (!object->sound) { return false; }
        syntax.operands.push_back(*object);
      } else {
        syntax.operands.push_back(as_operand(std::get<UseSyntax>(item)));
      }
    }
  }
  for (ObjectSyntax& operand : syntax.operands) {
    if (!expand(operand, depth + 1, expansion, errors)) { return false; }
  }
  if (syntax.group) { expansion.open.pop_back(); }
  return true;
}

void Groups::report_unknown(const Name& group, Errors& errors) const {
  std::vector<std::string_view> known;
  for (const GroupSyntax& other : syntax_->groups) {
    if (known.size() < 1000) { known.push_back(other.name.text); }
  }
  errors.add(group.place, "there is no group " + in_quotes(group.text) + suggestion(group.text, known));
}

// Depth-first search with an explicit stack; a group is done after all groups that it uses.
void Groups::visit(std::size_t root, Errors& errors) {
  struct Step {
    std::size_t group;
    std::size_t item;
  };
  std::vector<Step> path{{root, 0}};
  entries_[root].state = State::open;
  const auto report_cycle = [&](const UseSyntax& use, std::size_t target) {
    std::string names;
    const auto begin = std::find_if(path.begin(), path.end(), [&](const Step& s) { return s.group == target; });
    for (auto step = begin; step != path.end() && step - begin < 5; ++step) {
      names += in_quotes(syntax_->groups[step->group].name.text) + " uses ";
    }
    names += path.end() - begin > 5 ? "... uses " : "";
    errors.add(use.group.place, "cyclic use: " + names + in_quotes(use.group.text));
  };
  while (!path.empty()) {
    Step& step = path.back();
    Entry& entry = entries_[step.group];
    const std::vector<Item>& items = syntax_->groups[step.group].items;
    if (step.item == items.size()) {
      entry.state = State::done;
      path.pop_back();
      continue;
    }
    const auto* use = std::get_if<UseSyntax>(&items[step.item]);
    const auto found = use == nullptr ? index_.end() : index_.find(use->group.text);
    if (found != index_.end() && entries_[found->second].state == State::unseen) {
      entries_[found->second].state = State::open;
      path.push_back({found->second, 0});  // comes back to this item afterwards
      continue;
    }
    ++step.item;
    std::size_t inner = 1;
    if (found != index_.end()) {
      const Entry& used = entries_[found->second];
      inner = used.size;
      if (used.state == State::open) { report_cycle(*use, found->second); }
      entry.depth = std::max(entry.depth, used.depth + 1);
      if (used.depth == max_use_depth) { errors.add(use->group.place, "groups are nested deeper than " + std::to_string(max_use_depth)); }
    } else if (use != nullptr) {
      report_unknown(use->group, errors);
    }
    entry.size = std::min(entry.size + inner, max_objects + 1);
  }
}

namespace {

class Uses {
 public:
  struct State {
    std::string prefix;
    raycast::Placement placement;
    std::optional<Place> at;  // of the outermost statement in the file; nothing above it
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
  // Every use leads to an object, so most_visits is never reached; if the walk ends early, the reason is among the errors.
  static_cast<void>(GraphWalk<Uses, Uses::State>(uses, {max_use_depth + 2, 2 * max_use_depth * max_objects}).visit(root, state));
}

}  // namespace apps::scene_file
