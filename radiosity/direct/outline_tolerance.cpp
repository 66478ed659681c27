// SPDX-License-Identifier: MIT
#include <radiosity/direct/outline_tolerance.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/hierarchy/curved_area.hpp>

namespace radiosity {

HALFLIGHT_INLINE double outline_tolerance(const raycast::PlacedObject& object, double part) {
  constexpr double coarse = 0.02, least = 0.125, right_angle = 0.99, tight = 0.8;
  const double bounds = object.bounds().diameter();
  if (object.sheet_count() < 2) { return part * bounds; }
  brep::Builder boundary;
  object.approximate(coarse * bounds, boundary);
  double share = 1.0;
  raycast::Box box;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> sheet_of_edge;
  for (std::uint32_t f = 0; f < boundary.face_count(); ++f) {
    const std::span<const std::uint32_t> corners = boundary.corners(f);
    const std::uint32_t sheet = boundary.sheet(f);
    for (std::size_t i = 0; i < corners.size() && sheet != brep::no_sheet; ++i) {
      const std::uint32_t a = corners[i], b = corners[i + 1 < corners.size() ? i + 1 : 0];
      box.extend(boundary.position(a));
      const auto other = sheet_of_edge.find({b, a});
      if (other == sheet_of_edge.end()) {
        sheet_of_edge.insert_or_assign({a, b}, sheet);
      } else if (other->second != sheet) {
        const glm::dvec3 middle = 0.5 * (boundary.position(a) + boundary.position(b));
        const glm::dvec3 sum = object.normal(sheet, middle) + object.normal(other->second, middle);
        share = std::min(share, 0.5 * glm::length(sum) * std::numbers::sqrt2);
      }
    }
  }
  const double size = box.empty() || box.diameter() > tight * bounds ? bounds : box.diameter();
  return part * size * (share > right_angle ? 1.0 : std::max(share, least));
}

namespace detail {

// The share of a sheet's area that its facets of this tolerance have.
[[nodiscard]] HALFLIGHT_INLINE double area_share(const Facets& facets, const raycast::PlacedObject& object, double tolerance,
                                                 std::uint32_t sheet) {
  const double flat = area_of(facets);
  double curved = 0.0;
  for (const Facets::Facet& facet : facets.facets) { curved += curved_area(object, sheet, facet.contour); }
  constexpr double rounding = 1e-9, finer = 1.0 / 16.0;
  if (curved > flat * (1.0 + rounding)) { return flat / curved; }
  return flat / area_of(radiosity::facets_of(object, finer * tolerance, sheet));  // a flat sheet: chords cut off parts along its border
}

}  // namespace detail

HALFLIGHT_INLINE Facets facets_for_outline(const raycast::PlacedObject& object, double part, std::uint32_t sheet) {
  constexpr double least_share = 0.997;
  constexpr std::size_t most_facets = 4096;
  double tolerance = outline_tolerance(object, part);
  Facets facets = facets_of(object, tolerance, sheet);
  constexpr int most_steps = 32;  // because at the cusp of a blade finer chords may never reach the share
  for (int step = 0; step < most_steps; ++step) {
    const double share = detail::area_share(facets, object, tolerance, sheet);
    if (share >= least_share) { break; }
    constexpr double least_step = 0.5, most_step = 0.8;  // the area that chords lose is about proportional to the tolerance
    tolerance *= std::clamp((1.0 - least_share) / (1.0 - share), least_step, most_step);
    Facets finer = facets_of(object, tolerance, sheet);
    if (finer.facets.size() > most_facets) { break; }
    facets = std::move(finer);
  }
  return facets;
}

}  // namespace radiosity
