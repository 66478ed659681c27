// SPDX-License-Identifier: MIT
#pragma once

// All pairs of boxes, one of each of two sets, that meet: the candidates for intersection.
//
// A tree of boxes that is never stored: each set keeps only what meets the box around the other; the larger set is halved along its longest
// side, and both halves go on with the other set, until few pairs are left. Parts far from the other set are gone after the first few
// levels, so where two surfaces of v faces meet in curves the time is O(v log v) on average (paper 2.2).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/csg/boundary.hpp>

namespace brep::csg::detail {

struct BoxItem {
  Box box;
  std::uint32_t number;
};

class BoxPairs {
 public:
  std::vector<BoxItem> a, b;  // reordered by run

  // Calls visit(number of a, number of b) for each pair that meets.
  template <class Visit>
  void run(Visit&& visit) {
    std::vector<Task> tasks{{a.data(), a.data() + a.size(), b.data(), b.data() + b.size()}};
    while (!tasks.empty()) {
      Task t = tasks.back();
      tasks.pop_back();
      const Box box_a = around(t.a, t.a_end);
      t.b_end = keep(t.b, t.b_end, box_a);
      const Box box_b = around(t.b, t.b_end);
      t.a_end = keep(t.a, t.a_end, box_b);
      const auto count_a = static_cast<std::size_t>(t.a_end - t.a), count_b = static_cast<std::size_t>(t.b_end - t.b);
      if (count_a * count_b <= few) {
        for (const BoxItem* x = t.a; x != t.a_end; ++x) {
          for (const BoxItem* y = t.b; y != t.b_end; ++y) {
            if (x->box.meets(y->box)) { visit(x->number, y->number); }
          }
        }
      } else if (count_a >= count_b) {
        BoxItem* const middle = halve(t.a, t.a_end);
        tasks.push_back({t.a, middle, t.b, t.b_end});
        tasks.push_back({middle, t.a_end, t.b, t.b_end});
      } else {
        BoxItem* const middle = halve(t.b, t.b_end);
        tasks.push_back({t.a, t.a_end, t.b, middle});
        tasks.push_back({t.a, t.a_end, middle, t.b_end});
      }
    }
  }

 private:
  static constexpr std::size_t few = 64;
  struct Task {
    BoxItem *a, *a_end, *b, *b_end;
  };

  static Box around(const BoxItem* x, const BoxItem* end) {
    Box box;
    for (; x != end; ++x) { box.add(x->box); }
    return box;
  }
  static BoxItem* keep(BoxItem* x, BoxItem* end, const Box& box) {
    return std::partition(x, end, [&](const BoxItem& item) { return item.box.meets(box); });
  }
  static BoxItem* halve(BoxItem* x, BoxItem* end) {
    const Box box = around(x, end);
    std::size_t axis = 0;
    const auto length = [&](std::size_t i) { return std::int64_t{box.hi[i]} - box.lo[i]; };
    for (std::size_t i = 1; i < 3; ++i) { axis = length(i) > length(axis) ? i : axis; }
    BoxItem* const middle = x + (end - x) / 2;
    std::nth_element(x, middle, end, [axis](const BoxItem& p, const BoxItem& q) {
      return std::int64_t{p.box.lo[axis]} + p.box.hi[axis] < std::int64_t{q.box.lo[axis]} + q.box.hi[axis];
    });
    return middle;
  }
};

}  // namespace brep::csg::detail
