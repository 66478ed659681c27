// SPDX-License-Identifier: MIT
#include <radiosity/picture/spot_photons.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

namespace radiosity {

HALFLIGHT_INLINE SpotPhotons::SpotPhotons(std::vector<Photon> photons, double reach)
    : photons_{std::move(photons)}, axis_(photons_.size(), 0), reach_{reach} {
  sort(0, photons_.size());
}

HALFLIGHT_INLINE void SpotPhotons::sort(std::size_t first, std::size_t last) {
  if (last - first < 2) { return; }
  glm::dvec3 lo = photons_[first].position, hi = lo;
  for (std::size_t i = first; i < last; ++i) {
    lo = glm::min(lo, photons_[i].position);
    hi = glm::max(hi, photons_[i].position);
  }
  const glm::dvec3 d = hi - lo;
  const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return photons_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last), [&](const Photon& a, const Photon& b) { return a.position[axis] < b.position[axis]; });
  axis_[middle] = static_cast<std::uint8_t>(axis);
  sort(first, middle);
  sort(middle + 1, last);
}

HALFLIGHT_INLINE SpotPhotons::Found SpotPhotons::around(const glm::dvec3& position, const glm::dvec3* normal) const {
  constexpr double same_way = 0.7;                        // least cosine between the normals
  std::vector<std::pair<double, std::uint32_t>> nearest;  // a heap: squared distance, photon
  nearest.reserve(most_found + 1);
  double square = reach_ * reach_;
  struct Range {
    std::size_t first, last;
    double off;  // squared distance from the point to the splitting plane
  };
  std::array<Range, 128> open;
  std::size_t count = 0;
  open[count++] = {0, photons_.size(), 0.0};
  while (count > 0) {
    const Range range = open[--count];
    if (range.first >= range.last || range.off > square) { continue; }
    const std::size_t middle = range.first + (range.last - range.first) / 2;
    const Photon& photon = photons_[middle];
    const glm::dvec3 d = photon.position - position;
    const double own = glm::dot(d, d), along = d[axis_[middle]];
    if (own < square && (normal == nullptr || glm::dot(photon.normal, *normal) > same_way)) {
      nearest.emplace_back(own, static_cast<std::uint32_t>(middle));
      std::push_heap(nearest.begin(), nearest.end());
      if (nearest.size() > most_found) {
        std::pop_heap(nearest.begin(), nearest.end());
        nearest.pop_back();
      }
      if (nearest.size() == most_found) { square = nearest.front().first; }
    }
    const Range below{range.first, middle, along < 0.0 ? along * along : range.off};
    const Range above{middle + 1, range.last, along > 0.0 ? along * along : range.off};
    open[count++] = along > 0.0 ? above : below;  // pushed last, visited first: the nearer half
    open[count++] = along > 0.0 ? below : above;
  }
  Found found;
  found.radius = std::sqrt(square);
  for (const auto& [distance, photon] : nearest) { found.photons.push_back(photon); }
  return found;
}

}  // namespace radiosity
