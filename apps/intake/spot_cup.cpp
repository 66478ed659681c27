// SPDX-License-Identifier: MIT
#include "apps/intake/spot_cup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/circle.hpp>
#include <raycast/objects/mesh.hpp>

namespace apps {
namespace {

// Intensities by the angle from the axis up to `reach`, most of them beyond `even`, up to where they hardly change.
class Profile {
 public:
  Profile(double even, double reach) : even_(even), reach_(reach) {}

  template <class Intensity>
  void fill(const Intensity& intensity) {
    for (std::size_t i = 0; i < size; ++i) { values_[i] = intensity(angle(i)); }
  }
  // Over all directions, up to a constant factor.
  [[nodiscard]] double flux() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < size; ++i) { sum += weight(i) * values_[i]; }
    return sum;
  }
  [[nodiscard]] double relative_difference(const Profile& other) const {
    double squares = 0.0, all = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      const double off = values_[i] - other.values_[i];
      squares += weight(i) * off * off;
      all += weight(i) * values_[i] * values_[i];
    }
    return all > 0.0 ? std::sqrt(squares / all) : 0.0;
  }

 private:
  static constexpr std::size_t size = 160, size_of_even = 32;
  [[nodiscard]] double step(std::size_t i) const {
    return i < size_of_even ? even_ / static_cast<double>(size_of_even) : (reach_ - even_) / static_cast<double>(size - size_of_even);
  }
  [[nodiscard]] double angle(std::size_t i) const {
    const double middle = static_cast<double>(i < size_of_even ? i : i - size_of_even) + 0.5;
    return (i < size_of_even ? 0.0 : even_) + middle * step(i);
  }
  [[nodiscard]] double weight(std::size_t i) const { return std::sin(angle(i)) * step(i); }

  double even_, reach_;
  std::array<double, size> values_{};
};

// A ray from the ball's centre passes the edge of the opening at `middle`; of the ball, `half_width` to either side of that.
SpotCup cup(double middle, double half_width) {
  const double depth = std::cos(middle) / std::sin(half_width);
  return {depth * std::tan(middle), depth};
}

}  // namespace

double spot_intensity(const ModelLight& light, double angle) {
  if (angle >= light.outer) { return 0.0; }
  if (light.fade == ModelLight::Fade::power_of_cosine) { return std::pow(std::max(0.0, std::cos(angle)), light.power); }
  if (angle <= light.inner) { return 1.0; }
  if (light.fade == ModelLight::Fade::by_angle) { return (light.outer - angle) / (light.outer - light.inner); }
  const double share = (std::cos(angle) - std::cos(light.outer)) / (std::cos(light.inner) - std::cos(light.outer));
  return share * share;
}

double seen_through(const SpotCup& cup, double angle) {
  constexpr int chords = 32;  // Gauss-Chebyshev: their ends lie on the outline of the ball
  const double moved = cup.depth * std::sin(angle), half_width = cup.rim * std::cos(angle);
  double seen = 0.0, all = 0.0;
  for (int i = 0; i < chords; ++i) {
    const double at = (i + 0.5) / chords * std::numbers::pi, half_chord = std::sin(at);
    const double across = (std::cos(at) + moved) / half_width;
    const double half_opening = std::abs(across) < 1.0 ? cup.rim * std::sqrt(1.0 - across * across) : 0.0;
    seen += half_chord * std::min(half_chord, half_opening);
    all += half_chord * half_chord;
  }
  return seen / all;
}

SpotCup spot_cup(const ModelLight& given) {
  constexpr double degree = std::numbers::pi / 180.0, narrowest = degree, widest = 90.0 * degree, widest_middle = 88.0 * degree;
  constexpr double fits = 0.95;                   // of the opening's radius: of the ball's
  constexpr double beyond = 1.1, farther = 0.02;  // light falls to so much of where it ends, but no more radians beyond that
  constexpr double least_full = 0.97;             // of the inner cone, in which the intensity has no edge
  constexpr double sharpest = 0.025, softest = 0.65, even_part = 0.9;
  constexpr int widths = 20, refinements = 4, halvings = 14;
  ModelLight light = given;
  light.outer = std::clamp(light.outer, narrowest, widest);
  light.inner = std::clamp(light.inner, 0.0, light.outer);
  double end = light.outer;  // a high power of the cosine ends long before the cone
  while (end > narrowest && spot_intensity(light, 0.9 * end) < 1e-3) { end *= 0.9; }
  const double reach = std::min({beyond * end, end + farther, widest});
  const double even = light.fade == ModelLight::Fade::power_of_cosine && light.power > 0.0 ? 0.0 : even_part * std::min(light.inner, end);
  Profile wanted{even, reach};
  wanted.fill([&](double angle) { return spot_intensity(light, angle); });
  const double flux = wanted.flux();
  const double narrow = std::min(sharpest * end, 0.5 * farther);
  // The cup of this half width of the edge that sends as much light; nothing if none does.
  const auto fitted = [&](double half_width) -> std::optional<SpotCup> {
    // The wider the opening, the more light.
    double low = std::asin(std::min(1.0, std::sin(half_width) / fits)), high = std::min(reach - half_width, widest_middle);
    Profile made{even, reach};
    const auto try_middle = [&](double middle) {
      const SpotCup tried = cup(middle, half_width);
      made.fill([&](double angle) { return seen_through(tried, angle); });
      return made.flux();
    };
    if (!(low < high) || try_middle(low) > flux || (half_width > narrow && try_middle(high) < flux)) { return std::nullopt; }
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (low + high);
      (try_middle(middle) < flux ? low : high) = middle;
    }
    const double middle = 0.5 * (low + high);
    if (light.fade == ModelLight::Fade::squared_cosine && middle - half_width < least_full * light.inner) { return std::nullopt; }
    try_middle(middle);
    SpotCup found = cup(middle, half_width);
    found.difference = wanted.relative_difference(made);
    return found;
  };
  SpotCup best;
  best.difference = 1e300;
  double best_width = narrow;
  const auto take_if_better = [&](double half_width) {
    const std::optional<SpotCup> found = fitted(half_width);
    if (!found || !(found->difference < best.difference)) { return; }
    best = *found;
    best_width = half_width;
  };
  double ratio = std::pow(softest * end / narrow, 1.0 / widths);
  for (int i = 0; i <= widths; ++i) { take_if_better(narrow * std::pow(ratio, i)); }
  for (int i = 0; i < refinements; ++i) {
    ratio = std::sqrt(ratio);
    const double middle = best_width;
    take_if_better(middle * ratio);
    if (middle > narrow) { take_if_better(std::max(narrow, middle / ratio)); }
  }
  return best;
}

std::shared_ptr<const raycast::Object> recess(const SpotCup& cup, const glm::dvec3& ball, const glm::dvec3& direction, double radius) {
  constexpr std::uint32_t sides = 24, rings = 4;
  constexpr double slice = 2.0 * std::numbers::pi / sides, gap = 0.05, of_depth = 0.1;
  const double above = radius * cup.depth, below = (1.0 + gap) * radius, wall = of_depth * above;
  const double rim = radius * cup.rim * std::sqrt(slice / std::sin(slice));
  const raycast::AxisFrame frame(glm::normalize(direction));
  std::vector<glm::dvec3> corners;
  const auto ring = [&](double ring_radius, double height) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = slice * i;
      corners.push_back(ball + ring_radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v) + height * frame.w);
    }
  };
  ring(rim, -below);
  ring(rim, above);
  ring(rim + wall, above);
  ring(rim + wall, -below - wall);
  std::vector<std::vector<std::uint32_t>> faces(2);  // the bottoms, inside and outside
  for (std::uint32_t i = 0; i < sides; ++i) {
    faces[0].push_back(i);
    faces[1].push_back(rings * sides - 1 - i);
  }
  for (std::uint32_t r = 0; r + 1 < rings; ++r) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = r * sides + i, b = r * sides + (i + 1) % sides;
      faces.push_back({b, a, a + sides, b + sides});
    }
  }
  return raycast::Mesh::make(corners, faces, 1e-12 * (glm::length(ball) + rim + above)).object;
}

}  // namespace apps
