// SPDX-License-Identifier: MIT
#include <radiosity/audit/bright_places.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <raycast/object.hpp>
#include <raycast/transform.hpp>

#include <radiosity/direct/lamp_photons.hpp>
#include <radiosity/geometry/photon_grid.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

namespace detail {

// Photons a cell. With fewer than the least number the area of a cell is not known.
inline constexpr std::uint32_t most_of_cell = 32, least_of_cell = 8;
// A cell is bright if it reflects this many times as much per area as the mean of the cells that are not bright. Found in rounds, because
// the brightest cells raise the mean and hide others.
inline constexpr double place_contrast = 8.0;
inline constexpr int place_rounds = 8;
// Places are used if they hold at least this share of the light and at most this share of the area; otherwise unaimed paths find them
// well enough.
inline constexpr double least_of_light = 0.1, most_of_area = 0.05;
// Share of the choices made by the photons around a point; the others are made by power over squared distance, whether hidden or not.
inline constexpr double by_photons = 0.75;
// least_radius: relative to the diameter of the scene. border_of_cone: a direction at the border of a cone must have the density with
// which it was chosen, and rounding must not decide that. The rounding error of the squared sine is about 1e-16 and the squared sine
// itself at least 1e-9; adding a millionth of it covers the error.
inline constexpr double least_radius = 1e-4, border_of_cone = 1e-6;

}  // namespace detail

HALFLIGHT_INLINE double BrightPlaces::Place::area() const { return 2.0 * std::numbers::pi * squares; }

HALFLIGHT_INLINE BrightPlaces::Place BrightPlaces::place_of(std::span<const Reflected> light, std::uint32_t first, std::uint32_t last) {
  Place place{first, last};
  const std::span<const Reflected> own = light.subspan(first, last - first);
  glm::dvec3 normal{0.0};
  for (const Reflected& one : own) {
    place.power += one.power;
    place.centre += one.power * one.from.position;
    normal += one.power * one.from.normal;
  }
  place.centre /= place.power;
  normal /= place.power;
  glm::dvec3 apart{0.0}, turned{0.0};
  for (const Reflected& one : own) {
    const glm::dvec3 d = one.from.position - place.centre, n = one.from.normal - normal;
    apart += one.power / place.power * d * d;
    turned += one.power / place.power * n * n;
    place.radius = std::max(place.radius, glm::length(d));
  }
  place.squares = apart.x + apart.y + apart.z;
  turned *= place.squares;
  const std::array<double, 6> spread{apart.x, apart.y, apart.z, turned.x, turned.y, turned.z};
  place.axis = static_cast<int>(std::max_element(spread.begin(), spread.end()) - spread.begin());
  return place;
}

HALFLIGHT_INLINE std::uint32_t BrightPlaces::cut(std::span<Reflected> light, const Place& place) {
  const auto at = [axis = place.axis](const Reflected& one) { return axis < 3 ? one.from.position[axis] : one.from.normal[axis - 3]; };
  const std::span<Reflected> own = light.subspan(place.first, place.last - place.first);
  const double mean = std::accumulate(own.begin(), own.end(), 0.0, [&](double sum, const Reflected& one) { return sum + at(one); }) /
                      static_cast<double>(own.size());
  auto second = std::partition(own.begin(), own.end(), [&](const Reflected& one) { return at(one) < mean; });
  if (second == own.begin() || second == own.end()) { second = own.begin() + std::ssize(own) / 2; }  // all are the same
  return place.first + static_cast<std::uint32_t>(second - own.begin());
}

HALFLIGHT_INLINE std::vector<BrightPlaces::Reflected> BrightPlaces::bright_light(std::vector<Reflected> light, double area) {
  std::erase_if(light, [](const Reflected& one) { return !(one.power > 0.0); });
  if (light.size() < 2 * detail::most_of_cell) { return {}; }
  std::vector<Place> cells, open{place_of(light, 0, static_cast<std::uint32_t>(light.size()))};
  const double all = open.front().power;
  while (!open.empty()) {
    const Place cell = open.back();
    open.pop_back();
    if (cell.last - cell.first <= detail::most_of_cell) {
      cells.push_back(cell);
      continue;
    }
    const std::uint32_t second = cut(light, cell);
    open.push_back(place_of(light, cell.first, second));
    open.push_back(place_of(light, second, cell.last));
  }
  double power = all, rest = area;
  auto bright = cells.end();  // cells from here on are bright
  for (int round = 0; round < detail::place_rounds && rest > 0.0; ++round) {
    const double least = detail::place_contrast * power / rest;
    const auto first = std::stable_partition(cells.begin(), bright, [&](const Place& cell) {
      return cell.last - cell.first < detail::least_of_cell || !(cell.power > least * cell.area());
    });
    if (first == bright) { break; }
    for (auto cell = first; cell != bright; ++cell) {
      rest -= cell->area();
      power -= cell->power;
    }
    bright = first;
  }
  if (!(all - power > detail::least_of_light * all) || !(area - rest < detail::most_of_area * area)) { return {}; }
  std::vector<Reflected> result;
  for (auto cell = bright; cell != cells.end(); ++cell) {
    result.insert(result.end(), light.begin() + cell->first, light.begin() + cell->last);
  }
  return result;
}

HALFLIGHT_INLINE PhotonGrid BrightPlaces::sent_on(std::span<const Reflected> light, const Use& use, const MeetFront& meet) const {
  std::vector<double> until;
  double power = 0.0;
  for (const Place& place : places_) { until.push_back(power += place.power); }
  std::vector<PhotonGrid::Photon> photons;
  const Sobol4 sequence{9};
  for (std::uint32_t i = 0; i < use.photons; ++i) {
    const std::array<double, 4> u = sequence(i);
    const std::size_t k = drawn_index(until, u[0] * power);
    const std::uint32_t first = places_[k].first, count = places_[k].last - first;
    const raycast::ScenePoint& from = light[first + std::min(static_cast<std::uint32_t>(u[3] * count), count - 1)].from;
    const auto landed = meet(from, cosine_direction(from.normal, u[1], u[2]));
    if (landed) { photons.push_back({landed->position, landed->normal, static_cast<std::uint32_t>(k)}); }
  }
  return {photons, use.diameter};
}

HALFLIGHT_INLINE BrightPlaces::BrightPlaces(std::vector<Reflected> light, const Use& use, const MeetFront& meet) : share_{use.share} {
  std::vector<Reflected> bright = bright_light(std::move(light), use.area);
  if (bright.empty()) { return; }
  places_.push_back(place_of(bright, 0, static_cast<std::uint32_t>(bright.size())));
  const auto worth = [](const Place& place) { return place.power * place.squares; };
  while (places_.size() < most_places) {
    const auto next = std::max_element(places_.begin(), places_.end(), [&](const Place& a, const Place& b) { return worth(a) < worth(b); });
    if (next->last - next->first < 2 * detail::most_of_cell) { break; }
    const Place whole = *next;
    const std::uint32_t second = cut(bright, whole);
    *next = place_of(bright, whole.first, second);
    places_.push_back(place_of(bright, second, whole.last));
  }
  for (Place& place : places_) { place.radius = std::max(place.radius, detail::least_radius * use.diameter); }
  photons_ = sent_on(bright, use, meet);
}

HALFLIGHT_INLINE BrightPlaces::From::From(const BrightPlaces& places, const glm::dvec3& position, const glm::dvec3& normal)
    : normal_{normal} {
  double sum = 0.0;
  for (const Place& place : places.places_) {
    Cone& cone = cones_[count_++];
    cone.axis = place.centre - position;
    cone.square = glm::dot(cone.axis, cone.axis);
    cone.sine2 = place.radius * place.radius / cone.square;
    const double facing = std::max(0.0, glm::dot(cone.axis, normal) + place.radius), reach = cone.square + place.radius * place.radius;
    sum += cone.chance = place.power * facing * facing / (reach * reach);
  }
  if (!(sum > 0.0)) { return; }
  share_ = places.share_;
  const PhotonGrid::Around around = places.photons_.around(position, normal);
  const double guided = around.shares.empty() ? 0.0 : detail::by_photons;
  for (std::size_t k = 0; k < count_; ++k) { cones_[k].chance *= (1.0 - guided) / sum; }
  for (const PhotonGrid::Share& share : around.shares) { cones_[share.source].chance += guided * share.share; }
}

HALFLIGHT_INLINE std::optional<glm::dvec3> BrightPlaces::From::direction(double choice, double u, double v) const {
  if (!(choice < share_)) { return cosine_direction(normal_, u, v); }
  choice /= share_;
  std::size_t k = 0;
  for (; k + 1 < count_ && choice >= cones_[k].chance; ++k) { choice -= cones_[k].chance; }
  // Uniformly distributed within the cone; in all directions if the point lies within the sphere.
  const Cone& cone = cones_[k];
  const double below = cone.sine2 < 1.0 ? u * cone.sine2 / (1.0 + std::sqrt(1.0 - cone.sine2)) : 2.0 * u;  // 1 - cosine, from the axis
  const glm::dvec3 axis = cone.square > 0.0 ? cone.axis / std::sqrt(cone.square) : normal_;
  const double angle = 2.0 * std::numbers::pi * v, sine = std::sqrt(std::max(0.0, below * (2.0 - below)));
  const auto [s, t] = orthonormal(axis);
  const glm::dvec3 w = glm::normalize(sine * std::cos(angle) * s + sine * std::sin(angle) * t + (1.0 - below) * axis);
  return glm::dot(w, normal_) > 0.0 ? std::optional{w} : std::nullopt;
}

HALFLIGHT_INLINE double BrightPlaces::From::density_of(const Cone& cone, const glm::dvec3& w) const {
  if (!(cone.sine2 < 1.0)) { return 0.25 * std::numbers::inv_pi; }
  const double along = glm::dot(w, cone.axis);
  if (!(along > 0.0) || along * along < cone.square * (1.0 - (1.0 + detail::border_of_cone) * cone.sine2)) { return 0.0; }
  return (1.0 + std::sqrt(1.0 - cone.sine2)) / (2.0 * std::numbers::pi * cone.sine2);
}

HALFLIGHT_INLINE double BrightPlaces::From::density(const glm::dvec3& w) const {
  const double even = std::max(0.0, glm::dot(w, normal_)) * std::numbers::inv_pi;
  if (!(share_ > 0.0)) { return even; }
  double aimed = 0.0;
  for (std::size_t k = 0; k < count_; ++k) {
    if (cones_[k].chance > 0.0) { aimed += cones_[k].chance * density_of(cones_[k], w); }
  }
  return (1.0 - share_) * even + share_ * aimed;
}

}  // namespace radiosity
