// SPDX-License-Identifier: MIT
#include <radiosity/camera/contacts.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>

#include <brep/inline.hpp>

namespace radiosity {

namespace detail {

// What stands out less than this is too small for its light to reach a second pixel; in pixels, and relative to its distance, so that
// neither a concave surface nor a slanted one stands out of itself.
inline constexpr double least_height = 0.5, least_slope = 0.3;
// What is farther away, in pixels, does not touch the surface: it hides it from the camera only.
inline constexpr double most_apart = 20.0;

}  // namespace detail

HALFLIGHT_INLINE bool Contacts::is_contact(const Fragment& f) const {
  const auto& p = f.place.point;
  const double pixel = seen_.pixel_size()(p.position);
  bool result = false;
  blocks_.each_neighbour(f.x, f.y, [&](std::uint32_t x, std::uint32_t y) {
    if (result) { return; }
    for (const Fragment& other : seen_.at(x, y)) {
      const glm::dvec3 d = other.place.point.position - p.position;
      const double height = glm::dot(d, p.normal), length = glm::length(d);
      result =
          result || (height > detail::least_height * pixel && height > detail::least_slope * length && length < detail::most_apart * pixel);
    }
  });
  return result;
}

HALFLIGHT_INLINE void Contacts::find(std::size_t block) {
  for (const Fragment& f : seen_.of(block)) {
    if (seen_.by_an_edge(f.x, f.y) && is_contact(f)) {
      of_[block].push_back({f.place.point.position, f.place.point.normal, f.place.object});
    }
  }
}

HALFLIGHT_INLINE double Contacts::distance(const Fragment& f, double most) const {
  const auto& p = f.place.point;
  constexpr double same_way = 0.9;
  blocks_.each_block_within(f.x, f.y, most / seen_.pixel_size()(p.position), [&](std::size_t b) {
    for (const Contact& contact : of_[b]) {
      if (contact.object != f.place.object || !(glm::dot(contact.normal, p.normal) > same_way)) { continue; }
      most = std::min(most, glm::length(contact.position - p.position));
    }
  });
  return most;
}

}  // namespace radiosity
