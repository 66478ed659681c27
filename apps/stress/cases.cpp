// SPDX-License-Identifier: MIT
#include "apps/stress/groups.hpp"

namespace apps::stress {

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> result;
    for (const auto& group : {light_cases(), contact_cases(), boundary_cases(), size_cases()}) {
      result.insert(result.end(), group.begin(), group.end());
    }
    return result;
  }();
  return all;
}

}  // namespace apps::stress
