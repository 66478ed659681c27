// SPDX-License-Identifier: MIT
#include <radiosity/direct/uncovered.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/brep.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/scene.hpp>
#include <raycast/tolerances.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/facets.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/hierarchy/surface.hpp>

namespace radiosity {

namespace detail {

// cover_tolerance: largest distance of a cover's facets from its curved rim, relative to the object's diameter. least_cover: covered
// parts smaller than this share of a facet are rounding.
inline constexpr double cover_tolerance = 0.002, least_cover = 1e-9;

// May a face with this normal and corner coincide with the facet? The final decision is made by Scene::covered at a point.
[[nodiscard]] HALFLIGHT_INLINE bool may_coincide(const Facets::Facet& facet, const glm::dvec3& normal, const glm::dvec3& corner,
                                                 double near) {
  return std::abs(facet.height(corner)) <= near && glm::dot(facet.normal, normal) > raycast::tol_same_way;
}

// Result of cutting a convex piece of a facet along the edges of a convex cover: the part within, and convex pieces of the part outside.
struct CoverCut {
  Polygon within;
  std::vector<Polygon> without;
};
[[nodiscard]] HALFLIGHT_INLINE CoverCut cut_along(const Polygon& piece, const Facets::Facet& cover, double least_area) {
  const auto area = [](const Polygon& p) { return p.size() < 3 ? 0.0 : glm::length(vector_area(p)); };
  CoverCut cut{piece, {}};
  for (std::size_t i = 0; i < cover.contour.size() && area(cut.within) > least_area; ++i) {
    const glm::dvec3& a = cover.contour[i];
    const glm::dvec3 inwards = glm::cross(cover.normal, cover.contour[i + 1 < cover.contour.size() ? i + 1 : 0] - a);
    Polygon inside, outside;
    clip_to_horizon(cut.within, a, inwards, inside);
    clip_to_horizon(cut.within, a, -inwards, outside);
    if (area(outside) > least_area) { cut.without.push_back(std::move(outside)); }
    cut.within = std::move(inside);
  }
  if (!(area(cut.within) > least_area)) { cut.within.clear(); }
  return cut;
}

[[nodiscard]] HALFLIGHT_INLINE glm::dvec3 mean_corner(const Polygon& polygon) {
  glm::dvec3 sum{0.0};
  for (const glm::dvec3& p : polygon) { sum += p; }
  return sum / static_cast<double>(polygon.size());
}

// The faces of later objects that may coincide with one of these facets.
[[nodiscard]] HALFLIGHT_INLINE std::vector<Facets::Facet> covers_of(const Facets& facets, std::uint32_t object,
                                                                    const raycast::Scene& objects, const std::vector<Surface>& surfaces,
                                                                    double near) {
  raycast::Box box;
  for (const Facets::Facet& facet : facets.facets) {
    for (const glm::dvec3& p : facet.contour) { box.extend(p); }
  }
  box = box.grown(near);
  std::vector<Facets::Facet> result;
  const auto take = [&](Polygon contour) {
    const glm::dvec3 area = vector_area(contour);
    const double length = glm::length(area);
    const bool meets = length > 0.0 && std::any_of(facets.facets.begin(), facets.facets.end(), [&](const Facets::Facet& facet) {
                         return may_coincide(facet, area / length, contour[0], near);
                       });
    if (meets) { result.push_back({std::move(contour), area / length, 0.0, length}); }
  };
  for (std::uint32_t o = object + 1; o < objects.size(); ++o) {
    const raycast::PlacedObject& other = objects.object(o);
    const raycast::Box bounds = other.bounds();
    if (!bounds.meets(box)) { continue; }
    if (!other.exact()) {
      for (Facets::Facet& facet : radiosity::facets_of(other, cover_tolerance * bounds.diameter()).facets) {
        take(std::move(facet.contour));
      }
      continue;
    }
    for (const brep::FaceId f : brep::faces(surfaces[o].brep)) {
      if (surfaces[o].brep.data(f).sheet == brep::no_sheet) { continue; }
      const glm::dvec3& corner = surfaces[o].brep.data(surfaces[o].brep.vertex(surfaces[o].brep.halfedge(f))).position;
      const bool near_plane = std::any_of(facets.facets.begin(), facets.facets.end(),
                                          [&](const Facets::Facet& facet) { return std::abs(facet.height(corner)) <= near; });
      if (near_plane) { take(corner_polygon(surfaces[o].brep, f)); }
    }
  }
  return result;
}

}  // namespace detail

HALFLIGHT_INLINE void cut_out_covered(Facets& facets, std::uint32_t object, const raycast::Scene& objects,
                                      const std::vector<Surface>& surfaces) {
  if (facets.empty()) { return; }
  const double near = 4.0 * (raycast::tol_contact * objects.object(object).bounds().diameter() + objects.object(object).slack() +
                             raycast::eps_surface * objects.bounds().magnitude());
  const std::vector<Facets::Facet> covers = detail::covers_of(facets, object, objects, surfaces, near);
  if (covers.empty()) { return; }
  bool changed = false;
  std::vector<Facets::Facet> uncovered;
  for (const Facets::Facet& facet : facets.facets) {
    std::vector<Polygon> pieces{facet.contour};
    for (const Facets::Facet& cover : covers) {
      if (!detail::may_coincide(facet, cover.normal, cover.contour[0], near)) { continue; }
      std::vector<Polygon> next;
      for (Polygon& piece : pieces) {
        detail::CoverCut cut = detail::cut_along(piece, cover, detail::least_cover * facet.area);
        if (cut.within.empty() || !objects.covered(detail::mean_corner(cut.within), facet.normal, object)) {
          next.push_back(std::move(piece));
        } else {
          std::move(cut.without.begin(), cut.without.end(), std::back_inserter(next));
          changed = true;
        }
      }
      pieces = std::move(next);
    }
    for (Polygon& piece : pieces) {
      const double area = glm::length(vector_area(piece));
      uncovered.push_back({std::move(piece), facet.normal, facet.offset, area});
    }
  }
  if (!changed) { return; }
  facets.facets = std::move(uncovered);
  facets.edges.clear();  // each piece has its own edges; along borders between pieces their contour terms cancel
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f) {
    const Polygon& contour = facets.facets[f].contour;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      facets.edges.push_back({contour[i], contour[i + 1 < contour.size() ? i + 1 : 0], f, brep::invalid_index});
    }
  }
}

}  // namespace radiosity
