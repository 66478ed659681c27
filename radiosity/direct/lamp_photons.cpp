// SPDX-License-Identifier: MIT
#include <radiosity/direct/lamp_photons.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/circulators.hpp>
#include <brep/handles.hpp>
#include <brep/inline.hpp>

#include <raycast/object.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

namespace detail {

// A triangle of an emitting surface.
struct ShiningTriangle {
  std::array<glm::dvec3, 3> corner;
  const Surface* of = nullptr;
  std::uint32_t object = 0, sheet = 0;
  double power = 0.0, until = 0.0;  // `until`: cumulative probability up to and including it
};

[[nodiscard]] HALFLIGHT_INLINE std::vector<ShiningTriangle> shining_triangles(const std::vector<Surface>& surfaces,
                                                                              const std::vector<Color>& emission) {
  std::vector<ShiningTriangle> triangles;
  for (std::uint32_t o = 0; o < surfaces.size(); ++o) {
    const Surface& surface = surfaces[o];
    for (const brep::FaceId f : brep::faces(surface.brep)) {
      const std::uint32_t sheet = surface.brep.data(f).sheet;
      if (sheet == brep::no_sheet) { continue; }
      const Color& exitance = emission[surface.first_surface + sheet];
      if (is_black(exitance)) { continue; }
      const Polygon polygon = corner_polygon(surface.brep, f);
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        ShiningTriangle triangle{{polygon[0], polygon[i], polygon[i + 1]}, &surface, o, sheet};
        const auto& [a, b, c] = triangle.corner;
        triangle.power = triangle_area(a, b, c) * sum_of_channels(exitance);
        if (triangle.power > 0.0) { triangles.push_back(triangle); }
      }
    }
  }
  return triangles;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<LampPhoton> lamp_photons(const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
                                                      const MeetFront& meet, double price) {
  constexpr std::size_t of_a_lamp = 512, fewest = 512, least = 1u << 13, most = 1u << 15;
  constexpr double most_microseconds = 3e4;  // about the time of a small audit
  std::vector<detail::ShiningTriangle> triangles = detail::shining_triangles(surfaces, emission);
  const auto source = [](const detail::ShiningTriangle& triangle) { return triangle.of->first_surface + triangle.sheet; };
  std::map<std::uint32_t, double> power_of;
  double all = 0.0;
  for (const detail::ShiningTriangle& triangle : triangles) {
    power_of[source(triangle)] += triangle.power;
    all += triangle.power;
  }
  if (power_of.empty()) { return {}; }
  const auto probability = [&](const detail::ShiningTriangle& triangle) {
    return 0.5 * triangle.power / all + 0.5 * triangle.power / power_of[source(triangle)] / static_cast<double>(power_of.size());
  };
  double until = 0.0;
  for (detail::ShiningTriangle& triangle : triangles) { triangle.until = until += probability(triangle); }
  const auto affordable = static_cast<std::size_t>(most_microseconds / std::max(price, most_microseconds / most));
  const auto count =
      static_cast<std::uint32_t>(std::min(std::clamp(of_a_lamp * power_of.size(), least, most), std::max(fewest, affordable)));
  const Sobol4 sequence{8};
  std::vector<LampPhoton> photons;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::array<double, 4> u = sequence(i);
    const double at = u[0] * until;
    const detail::ShiningTriangle& triangle = drawn(triangles, at);
    const double own = probability(triangle);
    const auto& [a, b, c] = triangle.corner;
    const glm::dvec3 chord = triangle_point(triangle_weights(std::clamp((triangle.until - at) / own, 0.0, 1.0), u[3]), a, b, c);
    const raycast::ScenePoint from{triangle.of->object->project(triangle.sheet, chord), triangle.object, triangle.sheet};
    const auto landed = meet(from, cosine_direction(from.normal, u[1], u[2]));
    if (landed) { photons.push_back({*landed, source(triangle), triangle.power / own}); }
  }
  return photons;
}

HALFLIGHT_INLINE std::vector<PhotonGrid::Photon> photons_by_lamp(const std::vector<Surface>& surfaces, const std::vector<Color>& emission,
                                                                 const MeetFront& meet, double price) {
  std::set<std::uint32_t> shining;
  for (const detail::ShiningTriangle& triangle : detail::shining_triangles(surfaces, emission)) {
    shining.insert(triangle.of->first_surface + triangle.sheet);
  }
  if (shining.size() < 2) { return {}; }
  std::vector<PhotonGrid::Photon> photons;
  for (const LampPhoton& photon : lamp_photons(surfaces, emission, meet, price)) {
    photons.push_back({photon.landed.position, photon.landed.normal, photon.source});
  }
  return photons;
}

}  // namespace radiosity
