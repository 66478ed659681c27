// SPDX-License-Identifier: MIT
#include "apps/intake/room_lamp.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <raycast/objects/polygon.hpp>

namespace apps {
namespace {

constexpr double hang = 0.03;  // of the lamp below the ceiling, relative to the height of the air under the ceiling

// A point under a ceiling, in the air.
struct HangingPlace {
  glm::dvec3 point{0.0};
  double air = 0.0;  // smallest distance to anything around and below it
};

// Where a lamp could hang in a room.
class Ceilings {
 public:
  Ceilings(const raycast::Scene& objects, const raycast::Box& room) : objects_(objects), room_(room) {}

  // Under the ceiling above this point; nothing if the point is not in the air, or has no ceiling.
  [[nodiscard]] std::optional<HangingPlace> under(const glm::dvec3& from) const {
    const std::optional<raycast::Hit> ceiling = objects_.closest({from, {0, 0, 1}});
    if (!ceiling || !ceiling->front) { return std::nullopt; }
    const double up = ceiling->t, down = free_way(from, {0, 0, -1});
    if (!(down > 0.0)) { return std::nullopt; }
    HangingPlace place{from + glm::dvec3(0, 0, up - hang * (up + down)), (1.0 - hang) * (up + down)};
    if (objects_.covered(place.point, {0, 0, -1}, raycast::no_object)) { return std::nullopt; }  // inside an object
    constexpr int directions = 16;  // the nearest of the walls of a box stands at most 2 % nearer than the nearest hit
    for (int i = 0; i < directions; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / directions;
      place.air = std::min(place.air, free_way(place.point, {std::cos(angle), std::sin(angle), 0.0}));
    }
    return place.air > 0.0 ? std::optional(place) : std::nullopt;
  }

 private:
  // The distance to the first surface, or to the bounds of the room where it is open; 0 if the back of a surface is met.
  [[nodiscard]] double free_way(const glm::dvec3& from, const glm::dvec3& direction) const {
    if (const auto hit = objects_.closest({from, direction})) { return hit->front ? hit->t : 0.0; }
    double way = room_.diameter();
    for (int k = 0; k < 3; ++k) {
      if (direction[k] != 0.0) { way = std::min(way, ((direction[k] > 0.0 ? room_.hi : room_.lo)[k] - from[k]) / direction[k]); }
    }
    return std::max(way, 0.0);
  }

  const raycast::Scene& objects_;
  raycast::Box room_;
};

// The places under the points of a sequence that covers a box evenly and avoids its planes of symmetry, in which faces of beams may lie:
// multiples of the powers of 1 / g, where g^4 = g + 1 (Roberts 2018). With each point the opposite one is taken, so that the places of a
// symmetric room are symmetric.
std::vector<HangingPlace> some_places(const Ceilings& ceilings, const raycast::Box& room) {
  constexpr int enough = 4096, most = 16384;
  constexpr glm::dvec3 step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  std::vector<HangingPlace> found;
  for (int i = 1; i <= most && found.size() < enough; ++i) {
    const glm::dvec3 share = glm::fract(static_cast<double>(i) * step) - 0.5;
    for (const glm::dvec3 side : {glm::dvec3(1, 1, 1), glm::dvec3(-1, -1, 1)}) {
      if (const auto place = ceilings.under(room.centre() + side * share * room.size())) { found.push_back(*place); }
    }
  }
  return found;
}

}  // namespace

std::shared_ptr<const raycast::Object> room_lamp(const raycast::Scene& objects, const raycast::Box& room) {
  const Ceilings ceilings(objects, room);
  std::vector<HangingPlace> found = some_places(ceilings, room);
  // The lower half of the room: as under a table.
  const auto low = std::partition(found.begin(), found.end(), [&](const HangingPlace& p) { return p.point.z > room.centre().z; });
  if (low != found.begin()) { found.erase(low, found.end()); }
  if (found.empty()) { return nullptr; }
  // As much air as a tenth of all places have at least: the most that any has may be in a nook that other samples miss.
  const auto tenth = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 10);
  std::ranges::nth_element(found, tenth, std::ranges::greater(), &HangingPlace::air);
  const double much = tenth->air;
  constexpr double gap = 0.05;  // half as wide as this part of its height, the place is a gap between things, not a room
  if (much < gap * room.size().z) { return nullptr; }
  // In a corridor there is equally much air everywhere; then the place nearest to the middle lights most of it.
  constexpr double as_good = 0.9;
  std::erase_if(found, [&](const HangingPlace& p) { return p.air < as_good * much; });
  glm::dvec3 middle(0.0);
  for (const HangingPlace& p : found) { middle += p.point / static_cast<double>(found.size()); }
  HangingPlace best = std::ranges::min(found, {}, [&](const HangingPlace& p) { return glm::length(p.point - middle); });
  const auto there = ceilings.under({glm::dvec2(middle), best.point.z});
  if (there && there->air >= as_good * much) { best = *there; }
  std::vector<glm::dvec3> corners;
  for (const glm::dvec3 corner : {glm::dvec3(-1, -1, 0), glm::dvec3(-1, 1, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, -1, 0)}) {
    corners.push_back(best.point + 0.3 * much * corner);
  }
  return raycast::Polygon::make(std::move(corners)).object;
}

}  // namespace apps
