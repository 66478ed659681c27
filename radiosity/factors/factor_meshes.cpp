// SPDX-License-Identifier: MIT
#include <radiosity/factors/factor_meshes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/builder_input.hpp>
#include <brep/inline.hpp>

#include <raycast/box.hpp>
#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/exchange/exchange.hpp>
#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/patch.hpp>

namespace radiosity {

namespace detail {

HALFLIGHT_INLINE ObjectMesh mesh_of(const raycast::PlacedObject& object, double tolerance) {
  brep::Builder builder;
  object.approximate(tolerance, builder);
  ObjectMesh mesh;
  mesh.patches.resize(object.sheet_count());
  mesh.reach.resize(object.sheet_count(), 0.0);
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    const std::uint32_t sheet = builder.sheet(f);
    if (sheet == brep::no_sheet) { continue; }
    Polygon contour;
    glm::dvec3 middle{0.0};
    for (const std::uint32_t v : builder.corners(f)) { contour.push_back(builder.position(v)); }
    for (const glm::dvec3& p : contour) { middle += p / static_cast<double>(contour.size()); }
    ++mesh.faces;
    mesh.most_corners = std::max(mesh.most_corners, contour.size());
    const double distance = glm::length(object.project(sheet, middle).position - middle);
    mesh.chord_error += distance;
    mesh.reach[sheet] = std::max(mesh.reach[sheet], distance);
    const glm::dvec3 normal = vector_area(contour);
    const bool planar = std::all_of(contour.begin(), contour.end(), [&](const glm::dvec3& p) {
      return std::abs(glm::dot(normal, p - middle)) <= 1e-12 * glm::length(normal);
    });
    if (planar || contour.size() != 4) {
      mesh.patches[sheet].push_back(make_patch(contour));
    } else {
      mesh.patches[sheet].push_back(make_patch({contour[0], contour[1], contour[2]}));
      mesh.patches[sheet].push_back(make_patch({contour[0], contour[2], contour[3]}));
    }
  }
  mesh.chord_error /= static_cast<double>(std::max<std::size_t>(1, mesh.faces));
  return mesh;
}

[[nodiscard]] HALFLIGHT_INLINE double exchange_of(const std::vector<Patch>& p, const std::vector<Patch>& q) {
  double sum = 0.0;
  for (const Patch& a : p) {
    for (const Patch& b : q) {
      if (&a != &b && glm::dot(a.normal, b.centre - a.centre) > -b.radius && glm::dot(b.normal, a.centre - b.centre) > -a.radius) {
        sum += exchange(a, b);
      }
    }
  }
  return sum;
}

// Does each pair of patches face away from each other: does one lie below the horizon of the other by more than `reach`?
[[nodiscard]] HALFLIGHT_INLINE bool face_away(const std::vector<Patch>& p, const std::vector<Patch>& q, double reach) {
  const auto below = [&](const Patch& a, const Patch& b) {
    return std::all_of(b.contour.begin(), b.contour.end(),
                       [&](const glm::dvec3& x) { return glm::dot(a.normal, x - a.centre) <= 1e-12 - reach; });
  };
  return std::all_of(p.begin(), p.end(), [&](const Patch& a) {
    return std::all_of(q.begin(), q.end(), [&](const Patch& b) { return below(a, b) || below(b, a); });
  });
}

}  // namespace detail

HALFLIGHT_INLINE void make_meshes(const raycast::PlacedObject& object, std::span<const std::uint32_t> row_of_sheet,
                                  std::vector<RowMeshes>& rows) {
  double tolerance = 0.02 * object.bounds().diameter();
  detail::ObjectMesh mesh[3];
  mesh[1] = detail::mesh_of(object, tolerance);
  for (int round = 0; round < 16 && mesh[1].faces < 200 && mesh[1].most_corners < 64; ++round) {
    tolerance *= 0.7;
    mesh[1] = detail::mesh_of(object, tolerance);
  }
  mesh[0] = detail::mesh_of(object, 4.0 * tolerance);
  mesh[2] = detail::mesh_of(object, 0.25 * tolerance);
  const auto ratio = [&](const detail::ObjectMesh& coarse, const detail::ObjectMesh& fine) {
    const double corners = static_cast<double>(fine.most_corners) / static_cast<double>(coarse.most_corners);
    return object.flat() ? corners * corners : coarse.chord_error / fine.chord_error;
  };
  for (std::uint32_t s = 0; s < row_of_sheet.size(); ++s) {
    RowMeshes& row = rows[row_of_sheet[s]];
    row.outline = !object.flat() && !object.inside();
    row.reach = mesh[2].reach[s];
    double area[3] = {0.0, 0.0, 0.0};
    for (std::size_t k = 0; k < 3; ++k) {
      row.level[k] = mesh[k].patches[s];
      for (const Patch& patch : row.level[k]) { area[k] += patch.area; }
    }
    for (std::size_t k = 0; k < 2; ++k) { row.ratio[k] = ratio(mesh[k], mesh[k + 1]); }
    const Estimate change = detail::extrapolated(area[0], area[1], area[2], row.ratio);
    row.area = {area[2] + change.value, change.error + 1e-8 * area[2]};
  }
}

HALFLIGHT_INLINE Estimate free_exchange(const RowMeshes& p, const RowMeshes& q, bool same_object) {
  const double finest = detail::exchange_of(p.level[2], q.level[2]);
  Estimate result{finest, 1e-5 * finest};  // quadrature error (exchange.hpp), mostly far smaller
  if (!(finest > 0.0)) {
    // On the true surface a cap of height e may rise above the horizon of the mesh. On a sphere of radius r its area is 2 pi r e and its
    // slope below sqrt(2 e / r), whose square bounds the form factor of what it sees.
    const double reach = std::max(p.reach, q.reach);
    return {0.0, detail::face_away(p.level[2], q.level[2], reach) ? 0.0 : 4.0 * std::numbers::pi * reach * reach};
  }
  const auto take = [&](double coarsest, double coarse, const RowMeshes& row) {
    const Estimate change = detail::extrapolated(coarsest, coarse, finest, row.ratio);
    result.value += change.value;
    result.error += change.error + (row.outline ? 0.5 * std::abs(change.value) : 0.0);
    return coarse;
  };
  if (same_object) {
    if (p.curved()) { take(detail::exchange_of(p.level[0], q.level[0]), detail::exchange_of(p.level[1], q.level[1]), p); }
    return result;
  }
  double by_p = 0.0;
  double by_q = 0.0;
  if (p.curved()) { by_p = take(detail::exchange_of(p.level[0], q.level[2]), detail::exchange_of(p.level[1], q.level[2]), p); }
  if (q.curved()) { by_q = take(detail::exchange_of(p.level[2], q.level[0]), detail::exchange_of(p.level[2], q.level[1]), q); }
  if (p.curved() && q.curved()) {
    // Where both nearly touch, both corrections count light at the same places.
    const double both = finest - by_p - by_q + detail::exchange_of(p.level[1], q.level[1]);
    const double change = both / (std::min(p.ratio[1], q.ratio[1]) - 1.0);
    result.value -= change;
    result.error += std::abs(change);
  }
  return result;
}

}  // namespace radiosity
