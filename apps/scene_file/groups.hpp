// SPDX-License-Identifier: MIT
#pragma once

// Which group uses which. A group that uses itself, however indirectly, is refused; so is nesting beyond
// max_use_depth and a scene that would grow beyond max_objects: both are found by counting, before anything is placed. An operand that is a
// use stands for the union of what is in the group.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <raycast/transform.hpp>

#include "apps/input_errors.hpp"
#include "apps/scene_file/lexer.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

// Operands that uses may give one solid: uses of uses multiply, and the solid is evaluated while the file is read.
inline constexpr std::size_t max_used_operands = 2000;

class Groups {
 public:
  // Reports duplicate names, empty groups, uses of unknown groups, cycles and nesting that is too deep.
  Groups(const SceneSyntax& syntax, Errors& errors);

  // The group of this name, or null.
  [[nodiscard]] const GroupSyntax* find(const Name& group) const;
  // Objects that one use of the group places; saturates above max_objects.
  [[nodiscard]] std::size_t size(const GroupSyntax& group) const;

  // Gives the uses among the operands of a union, intersection or difference, and among their operands, the objects of their groups.
  // False after an error: unknown groups, cycles, nesting that is too deep, too many operands.
  bool expand(ObjectSyntax& syntax, Errors& errors) const;

 private:
  enum class State : unsigned char { unseen, open, done };
  struct Entry {
    State state = State::unseen;
    std::size_t size = 0;
    std::size_t depth = 1;
  };
  void visit(std::size_t root, Errors& errors);
  struct Expansion {
    std::vector<const GroupSyntax*> open;  // around the operand
    std::size_t operands = 0;
  };
  bool expand(ObjectSyntax& syntax, std::size_t depth, Expansion& expansion, Errors& errors) const;
  void report_unknown(const Name& group, Errors& errors) const;

  const SceneSyntax* syntax_;
  std::unordered_map<std::string_view, std::size_t> index_;
  std::vector<Entry> entries_;  // one per group
};

// The statements of a scene as a graph (apps/graph_walk.hpp): under the root lie those of the file, under a use those of its group. Each
// node keeps its placement and its name to what lies below it.
//
// Is told of an object as often as it is used: with the names of the uses around it, "first.", their placement, and the place of the
// statement of the file.
using PlaceObject = std::function<void(const ObjectSyntax& object, const std::string& prefix, const raycast::Placement& outer, Place at)>;

// Walks all uses in the order of the file; ends at the first error, or when the scene grows beyond max_objects.
void place_all(const std::vector<Item>& items, const Groups& groups, Errors& errors, const PlaceObject& place);

}  // namespace apps::scene_file
