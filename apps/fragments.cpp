// SPDX-License-Identifier: MIT
#include "apps/fragments.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/tolerances.hpp>

#include <radiosity/picture/final_gather.hpp>

namespace apps {

bool one_piece(const radiosity::FinalGather::Place& a, const radiosity::FinalGather::Place& b, const PixelSize& pixel_size) {
  if (a.surface != b.surface || !(glm::dot(a.point.normal, b.point.normal) > 0.97)) { return false; }
  constexpr double apart = 4.0;  // pixels
  return std::abs(glm::dot(a.point.normal, b.point.position - a.point.position)) < apart * pixel_size(a.point.position);
}

void add_fragments(const radiosity::FinalGather& light, std::uint32_t x, std::uint32_t y,
                   std::span<const std::optional<radiosity::FinalGather::Place>> seen, const PixelSize& pixel_size,
                   std::vector<Fragment>& out) {
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  for (const auto& place : seen) {
    if (!place) { continue; }
    const auto same =
        std::find_if(out.begin() + first, out.end(), [&](const Fragment& f) { return one_piece(f.place, *place, pixel_size); });
    if (same == out.end()) {
      out.push_back({x, y, 1.0f, *place, place->point.position, place->point.normal});
    } else {
      same->share += 1.0f;
      same->positions += place->point.position;
      same->normals += place->point.normal;
    }
  }
  for (auto f = out.begin() + first; f != out.end(); ++f) {
    const glm::dvec3 middle = f->positions / static_cast<double>(f->share);
    f->share /= static_cast<float>(seen.size());
    if (light.objects().object(f->place.object).flat()) {
      f->place.point = {middle, glm::normalize(f->normals)};
      continue;
    }
    // The middle of points of a curved surface lies off it: the nearest of them is on it.
    double nearest = raycast::infinity;
    const radiosity::FinalGather::Place of_piece = f->place;
    for (const auto& place : seen) {
      if (!place || !one_piece(of_piece, *place, pixel_size)) { continue; }
      const double distance = glm::length(place->point.position - middle);
      if (distance < nearest) {
        nearest = distance;
        f->place.point = place->point;
      }
    }
  }
}

}  // namespace apps
