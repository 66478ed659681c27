// SPDX-License-Identifier: MIT
#pragma once

// Which group uses which. A group that uses itself, however indirectly, is refused; so is nesting beyond
// max_use_depth and a scene that would grow beyond max_objects: both are found by counting, before anything is placed.

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "apps/scene_file/lexer.hpp"
#include "apps/scene_file/syntax.hpp"

namespace apps::scene_file {

class Groups {
 public:
  // Reports duplicate names, empty groups, uses of unknown groups, cycles and nesting that is too deep.
  Groups(const SceneSyntax& syntax, Errors& errors);

  // The group that `use` names, or null.
  [[nodiscard]] const GroupSyntax* find(const UseSyntax& use) const;
  // Objects and uses that one use of the group places, counting the use; saturates above max_objects.
  [[nodiscard]] std::size_t size(const GroupSyntax& group) const;

 private:
  enum class State : unsigned char { unseen, open, done };
  struct Entry {
    State state = State::unseen;
    std::size_t size = 1;
    std::size_t depth = 1;
  };
  void visit(std::size_t root, Errors& errors);
  void report_unknown(const UseSyntax& use, Errors& errors) const;

  const SceneSyntax* syntax_;
  std::unordered_map<std::string_view, std::size_t> index_;
  std::vector<Entry> entries_;  // one per group
};

}  // namespace apps::scene_file
