// SPDX-License-Identifier: MIT
// Joins lamps of equal exitance, so that a picture asks about fewer of them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/scene.hpp>

#include <radiosity/direct/direct_light.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

HALFLIGHT_INLINE std::vector<DirectLight::Candidate> DirectLight::join_alike(const std::vector<Candidate>& singles,
                                                                             const raycast::Scene& objects, std::uint32_t most) {
  std::vector<Candidate> joined;
  // Joins flat sheets of equal exitance, for objects that have more than `few` of them. The candidates are sorted by object.
  const auto join_sheets = [&](std::size_t few) {
    joined.clear();
    for (std::size_t first = 0, last = 0; first < singles.size(); first = last) {
      const std::uint32_t o = singles[first].parts[0].object;
      while (last < singles.size() && singles[last].parts[0].object == o) { ++last; }
      const std::size_t first_of_object = joined.size();
      for (const Candidate& single : std::span{singles}.subspan(first, last - first)) {
        const auto alike = std::find_if(joined.begin() + static_cast<std::ptrdiff_t>(first_of_object), joined.end(),
                                        [&](const Candidate& c) { return c.exitance == single.exitance; });
        if (last - first <= few || !objects.object(o).flat() || alike == joined.end()) {
          joined.push_back(single);
          continue;
        }
        alike->parts[0].sheets.push_back(single.parts[0].sheets[0]);
        alike->area += single.area;
      }
    }
  };
  // The walls of a sky stay separate lamps as long as there is room for them, because a single lamp would surround its own centre.
  constexpr std::size_t few_sheets = 8;
  join_sheets(few_sheets);
  if (joined.size() > most) { join_sheets(1); }
  if (joined.size() <= most) { return joined; }
  // Joins objects of equal exitance into groups, halved by position until each has at most `of_one` members.
  const auto before = [](const Color& a, const Color& b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; };
  std::stable_sort(joined.begin(), joined.end(), [&](const auto& a, const auto& b) { return before(a.exitance, b.exitance); });
  const std::size_t of_one = (2 * joined.size() + most - 1) / most;
  std::vector<Candidate> result;
  const auto take = [&](const auto& self, std::span<Candidate> group) -> void {
    if (group.size() <= of_one) {
      Candidate sum = group[0];
      for (const Candidate& c : group.subspan(1)) {
        sum.parts.push_back(c.parts[0]);
        sum.area += c.area;
      }
      result.push_back(std::move(sum));
      return;
    }
    const auto centre = [&](const Candidate& c) { return objects.object(c.parts[0].object).bounds().centre(); };
    raycast::Box centres;
    for (const Candidate& c : group) { centres.extend(centre(c)); }
    const glm::dvec3 extent = centres.hi - centres.lo;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::stable_sort(group.begin(), group.end(), [&](const auto& a, const auto& b) { return centre(a)[axis] < centre(b)[axis]; });
    self(self, group.first(group.size() / 2));
    self(self, group.subspan(group.size() / 2));
  };
  for (std::size_t begin = 0, end = 0; begin < joined.size(); begin = end) {
    while (end < joined.size() && joined[end].exitance == joined[begin].exitance) { ++end; }
    take(take, std::span{joined}.subspan(begin, end - begin));
  }
  return result;
}

}  // namespace radiosity
