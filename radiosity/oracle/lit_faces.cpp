// SPDX-License-Identifier: MIT
#include <radiosity/oracle/lit_faces.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <raycast/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/scene/material.hpp>

namespace radiosity {

HALFLIGHT_INLINE LitFaces::LitFaces(const Hierarchy& hierarchy, std::span<const Color> reflectance, std::span<const Color> emission,
                                    const std::vector<bool>& buried)
    : counts_(hierarchy.size(), false) {
  double all = 0.0;
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    counts_[i] = is_input_face(hierarchy, i) && !(i < buried.size() && buried[i]);
    if (!counts_[i]) { continue; }
    all += hierarchy[i].area;
    power_ += hierarchy[i].area * brightest(emission[hierarchy[i].surface]);
  }
  std::vector<bool> lit(counts_);
  for (std::size_t i = 0; i < hierarchy.size(); ++i) {
    const std::uint32_t surface = hierarchy[i].surface;
    lit[i] = lit[i] && !is_black(reflectance[surface]) && brightest(emission[surface]) * all < power_;
    if (lit[i]) { area_ += hierarchy[i].area; }
  }
  if (area_ > 0.0) {
    counts_ = std::move(lit);
  } else {
    area_ = all;
  }
}

}  // namespace radiosity
