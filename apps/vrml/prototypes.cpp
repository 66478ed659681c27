// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {
namespace {

using NodePointer = std::shared_ptr<const Node>;

class Instantiation {
 public:
  Instantiation(const Prototype& prototype, const Fields& given, std::size_t& budget)
      : prototype_(prototype), given_(given), budget_(budget) {}

  // Copies an open node; returns a closed one itself. The recursion is as deep as the node's tree, whose height the parser limits.
  NodePointer copy(const NodePointer& node) {
    if (!node->open) { return node; }
    const auto [known, is_new] = copies_.emplace(node.get(), nullptr);
    if (!is_new) { return known->second; }  // used twice in the body, so it is also one node in the instance
    auto made = std::make_shared<Node>(*node);
    take(1 + made->children.size() + made->fields.size());
    copy_list(made->children);
    for (auto field = made->fields.begin(); field != made->fields.end() && budget_ > 0;) {
      if (!field->second->is.empty()) { field->second = value(field->second->is); }
      if (field->second == nullptr) {
        field = made->fields.erase(field);
        continue;
      }
      take(field->second->nodes.size());
      const bool in_body = node->fields.find(field->first)->second == field->second;
      if (in_body && std::any_of(field->second->nodes.begin(), field->second->nodes.end(), [](const auto& n) { return n->open; })) {
        auto copied = std::make_shared<Field>(*field->second);
        copy_list(copied->nodes);
        field->second = std::move(copied);
      }
      ++field;
    }
    settle(*made);
    copies_[node.get()] = made;
    return made;
  }

 private:
  void take(std::size_t count) { budget_ -= std::min(budget_, count); }
  void copy_list(std::vector<NodePointer>& nodes) {
    for (NodePointer& node : nodes) {
      if (budget_ > 0) { node = copy(node); }
    }
  }
  // Null if there is none, e.g. for an event.
  [[nodiscard]] std::shared_ptr<const Field> value(const std::string& name) const {
    if (const auto found = given_.find(name); found != given_.end()) { return found->second; }
    const auto found = prototype_.defaults.find(name);
    return found == prototype_.defaults.end() ? nullptr : found->second;
  }

  const Prototype& prototype_;
  const Fields& given_;
  std::size_t& budget_;
  std::map<const Node*, NodePointer> copies_;
};

}  // namespace

std::shared_ptr<const Prototype> Prototypes::find(std::string_view name) const {
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
    if (const auto found = scope->find(name); found != scope->end()) { return found->second; }
  }
  return nullptr;
}

void settle(Node& node) {
  node.height = 0;
  node.open = false;
  const auto has_below = [&node](const std::vector<NodePointer>& below) {
    for (const NodePointer& child : below) {
      node.height = std::max(node.height, child->height + 1);
      node.open |= child->open;
    }
  };
  has_below(node.children);
  for (const auto& [name, field] : node.fields) {
    has_below(field->nodes);
    node.open |= !field->is.empty();
  }
}

NodePointer instance(const Prototype& prototype, const Fields& given, std::size_t& budget) {
  const NodePointer made = Instantiation(prototype, given, budget).copy(prototype.root);
  return budget > 0 ? made : nullptr;
}

}  // namespace apps::vrml
