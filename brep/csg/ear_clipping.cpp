// SPDX-License-Identifier: MIT
#include <brep/csg/ear_clipping.hpp>

#include <cstddef>
#include <optional>
#include <vector>

#include <brep/inline.hpp>

namespace brep::csg::detail {

HALFLIGHT_INLINE std::optional<std::vector<Ear>> ears(const std::vector<GridCorner>& corners) {
  std::vector<std::size_t> left(corners.size());
  std::vector<Ear> result;
  for (std::size_t i = 0; i < left.size(); ++i) { left[i] = i; }
  const auto is_ear = [&](std::size_t k) {
    const GridCorner &a = corners[left[(k + left.size() - 1) % left.size()]], &b = corners[left[k]],
                     &c = corners[left[(k + 1) % left.size()]];
    if (turn(a, b, c) <= 0) { return false; }
    for (std::size_t i : left) {
      const GridCorner& p = corners[i];
      if (p == a || p == b || p == c) { continue; }
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) { return false; }
    }
    return true;
  };
  for (std::size_t at = 0; left.size() > 3;) {
    std::size_t tried = 0;
    while (tried < left.size() && !is_ear(at % left.size())) { ++at, ++tried; }
    if (tried == left.size()) { return std::nullopt; }
    at %= left.size();
    result.push_back({left[(at + left.size() - 1) % left.size()], left[at]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    ++at;  // not a fan
  }
  if (left.size() < 3 || turn(corners[left[0]], corners[left[1]], corners[left[2]]) <= 0) { return std::nullopt; }
  return result;
}

}  // namespace brep::csg::detail
