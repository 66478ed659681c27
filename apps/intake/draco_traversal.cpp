// SPDX-License-Identifier: MIT
// The orders in which Draco visits the vertices of a mesh. Each step enters a triangle that was not visited, so there are as many as
// triangles; the vertices of a visited triangle are visited.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/intake/draco_corners.hpp"

namespace apps::intake::draco {
namespace {

class Traversal {
 public:
  explicit Traversal(const CornerTable& table) : table_(table), face_visited_(table.opposite.size() / 3, false) {
    sequence_.entry_of_vertex.assign(table.leftmost.size(), no_corner);
  }

  Sequence depth_first() {
    for (std::uint32_t first = 0; first < table_.opposite.size(); first += 3) {
      if (visited(first)) { continue; }
      visit_vertex(next(first));
      visit_vertex(previous(first));
      std::vector<std::uint32_t> open{first};
      while (!open.empty()) {
        std::uint32_t c = open.back();
        open.pop_back();
        while (!visited(c)) {
          face_visited_[c / 3] = true;
          const bool is_new = visit_vertex(c);
          const std::uint32_t right = table_.across(next(c)), left = table_.across(previous(c));
          if (is_new && !table_.on_boundary(table_.vertex[c])) {
            c = right;
          } else if (visited(right)) {
            c = left;
          } else {
            if (!visited(left)) { open.push_back(left); }
            c = right;
          }
        }
      }
    }
    return sequence_;
  }

  Sequence by_degree() {
    degree_.assign(table_.leftmost.size(), 0);
    for (std::uint32_t first = 0; first < table_.opposite.size(); first += 3) {
      if (visited(first)) { continue; }
      for (const std::uint32_t c : {next(first), previous(first), first}) { visit_vertex(c); }
      open_[0].push_back(first);
      best_ = 0;
      for (std::uint32_t c = pop(); c != no_corner; c = pop()) {
        while (!visited(c)) {
          face_visited_[c / 3] = true;
          visit_vertex(c);
          c = step_by_degree(table_.across(next(c)), table_.across(previous(c)));
        }
      }
    }
    return sequence_;
  }

 private:
  [[nodiscard]] bool visited(std::uint32_t c) const { return c == no_corner || face_visited_[c / 3]; }

  // The vertex of this corner gets the next entry, unless it has one. Was it new?
  bool visit_vertex(std::uint32_t c) {
    std::uint32_t& entry = sequence_.entry_of_vertex[table_.vertex[c]];
    if (entry != no_corner) { return false; }
    entry = static_cast<std::uint32_t>(sequence_.corner_of_entry.size());
    sequence_.corner_of_entry.push_back(c);
    return true;
  }

  // The corner to go on with, if one of them is as urgent as the best open one; what is left out becomes open.
  std::uint32_t step_by_degree(std::uint32_t right, std::uint32_t left) {
    const bool right_visited = visited(right);
    if (!visited(left)) {
      const std::size_t urgency = urgency_of(left);
      if (right_visited && urgency <= best_) { return left; }
      push(left, urgency);
    }
    if (!right_visited) {
      const std::size_t urgency = urgency_of(right);
      if (urgency <= best_) { return right; }
      push(right, urgency);
    }
    return no_corner;
  }
  // 0 if the vertex is known, 1 if a triangle has asked for it before, otherwise 2.
  std::size_t urgency_of(std::uint32_t c) {
    const std::uint32_t v = table_.vertex[c];
    return sequence_.entry_of_vertex[v] != no_corner ? 0 : ++degree_[v] > 1 ? 1 : 2;
  }
  void push(std::uint32_t c, std::size_t urgency) {
    open_[urgency].push_back(c);
    best_ = std::min(best_, urgency);
  }
  std::uint32_t pop() {
    for (std::size_t i = best_; i < open_.size(); ++i) {
      if (open_[i].empty()) { continue; }
      const std::uint32_t c = open_[i].back();
      open_[i].pop_back();
      best_ = i;
      return c;
    }
    return no_corner;
  }

  const CornerTable& table_;
  std::vector<bool> face_visited_;
  Sequence sequence_;
  std::vector<std::uint32_t> degree_;               // of each vertex: triangles that asked for it
  std::array<std::vector<std::uint32_t>, 3> open_;  // corners by urgency
  std::size_t best_ = 0;
};

}  // namespace

Sequence traverse(const CornerTable& table, bool by_degree) {
  return by_degree ? Traversal(table).by_degree() : Traversal(table).depth_first();
}

}  // namespace apps::intake::draco
