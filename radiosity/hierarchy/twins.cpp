// SPDX-License-Identifier: MIT
#include <radiosity/hierarchy/twins.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

namespace detail {

// The bounds of an object, rounded to a millionth of the scene.
struct Place {
  std::array<double, 6> bounds;
  std::uint32_t object;
};

// All objects, sorted so that equal bounds are adjacent.
HALFLIGHT_INLINE std::vector<Place> sorted_places(const std::vector<Surface>& surfaces) {
  std::vector<Place> places;
  raycast::Box all;
  for (const Surface& surface : surfaces) { all.extend(surface.object->bounds()); }
  const double grid = 0x1p-20 * all.diameter();
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    const raycast::Box& box = surfaces[o].object->bounds();
    Place place{{}, o};
    for (int k = 0; k < 3; ++k) {
      place.bounds[static_cast<std::size_t>(k)] = std::round(box.lo[k] / grid);
      place.bounds[static_cast<std::size_t>(k + 3)] = std::round(box.hi[k] / grid);
    }
    places.push_back(place);
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.bounds != b.bounds ? a.bounds < b.bounds : a.object < b.object; });
  return places;
}

// The corners of all faces, with the normals of their sheets.
HALFLIGHT_INLINE std::vector<raycast::SurfacePoint> corners(const Surface& surface) {
  std::vector<raycast::SurfacePoint> points;
  for (const brep::FaceId f : brep::faces(surface.brep)) {
    const std::uint32_t sheet = surface.brep.data(f).sheet;
    if (sheet == brep::no_sheet) { continue; }
    for (const brep::HalfedgeId h : brep::halfedges_of(surface.brep, f)) {
      const glm::dvec3& p = surface.brep.data(surface.brep.vertex(h)).position;
      points.push_back({p, surface.object->project(sheet, p).normal});
    }
  }
  return points;
}

// Is every corner of a a corner of b or, if b is curved, on b? Duplicates usually have their corners in the same order, so each
// search begins at the same index.
HALFLIGHT_INLINE bool lies_in(const Surface& a, const Surface& b) {
  const raycast::PlacedObject& other = *b.object;
  const double touch = 1e-9 * other.bounds().diameter() + other.slack() + a.object->slack();
  const std::vector<raycast::SurfacePoint> of_a = corners(a);
  const std::vector<raycast::SurfacePoint> of_b = other.exact() ? corners(b) : std::vector<raycast::SurfacePoint>{};
  const std::size_t count = other.exact() ? of_b.size() : other.sheet_count();
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    bool found = false;
    for (std::size_t k = 0; k < count && !found; ++k) {
      const std::size_t j = (i + k) % count;
      const auto q = other.exact() ? of_b[j] : other.project(static_cast<std::uint32_t>(j), of_a[i].position);
      found = glm::length(q.position - of_a[i].position) <= touch && glm::dot(q.normal, of_a[i].normal) > 0.999;
    }
    if (!found) { return false; }
  }
  return true;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<std::array<std::uint32_t, 2>> twins(const std::vector<Surface>& surfaces) {
  const std::vector<detail::Place> places = detail::sorted_places(surfaces);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t first = 0; first < places.size();) {
    std::size_t last = first + 1;
    while (last < places.size() && places[last].bounds == places[first].bounds) { ++last; }
    // Processes from the last object to the first. An object is a copy if it equals a later one that is not a copy itself; so in a chain
    // of objects, each slightly different from the next, no two copies differ much. Each is compared with the next 64 objects that are
    // not copies.
    std::vector<std::uint32_t> kept;
    for (std::size_t i = last; i-- > first;) {
      const std::uint32_t a = places[i].object;
      const auto is_same = [&](std::uint32_t b) {
        return detail::lies_in(surfaces[a], surfaces[b]) && detail::lies_in(surfaces[b], surfaces[a]);
      };
      const auto end = kept.rend() - static_cast<std::ptrdiff_t>(kept.size() - std::min<std::size_t>(kept.size(), 64));
      const auto later = std::find_if(kept.rbegin(), end, is_same);
      if (later != end) {
        pairs.push_back({a, *later});
      } else {
        kept.push_back(a);
      }
    }
    first = last;
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

HALFLIGHT_INLINE std::vector<std::uint32_t> copies(const std::vector<Surface>& surfaces) {
  std::vector<std::uint32_t> earlier;
  for (const auto& [a, b] : twins(surfaces)) { earlier.push_back(a); }
  return earlier;
}

}  // namespace radiosity
