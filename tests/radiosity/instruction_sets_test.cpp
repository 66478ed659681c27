// SPDX-License-Identifier: MIT

// Inner loops that take eight at once: the same bits with every instruction set that this machine has, and what one at a time gives.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/isa.hpp>

#include <radiosity/exchange/kernel_sums.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/segment_samples.hpp>
#include <radiosity/visibility/visibility.hpp>

#include "catch.hpp"
#include "seed.hpp"

namespace {

using radiosity::Patch;
using raycast::Isa;

std::vector<Isa> sets_of_this_machine() {
  std::vector<Isa> sets{Isa::portable};
  if (raycast::best_isa() != Isa::portable) { sets.push_back(Isa::avx2); }
  if (raycast::best_isa() == Isa::avx512) { sets.push_back(Isa::avx512); }
  return sets;
}

// A convex polygon of this many corners on a circle, stretched and placed at random.
Patch random_patch(std::mt19937_64& random, std::size_t corners) {
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  const auto vector = [&] { return glm::dvec3{uniform(random), uniform(random), uniform(random)}; };
  const glm::dvec3 centre = vector(), s = vector(), t = vector();
  radiosity::Polygon contour;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 6.283185307179586 * (static_cast<double>(i) + 0.35 * uniform(random)) / static_cast<double>(corners);
    contour.push_back(centre + std::cos(angle) * s + std::sin(angle) * t);
  }
  return radiosity::make_patch(contour);
}

}  // namespace

TEST_CASE("segments: eight drawn at once have the bits of segments drawn one by one, with every instruction set") {
  const std::uint64_t seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 generator{seed};
  for (int round = 0; round < 300; ++round) {
    const Patch p = random_patch(generator, 3 + generator() % 2), q = random_patch(generator, 3 + generator() % 2);
    const auto shift = static_cast<std::uint32_t>(generator() % 16);
    const radiosity::Random random{generator(), generator()};
    for (const Isa set : sets_of_this_machine()) {
      radiosity::Random one_by_one = random, passed = random;
      radiosity::detail::SampledSegments drawn;
      const std::uint64_t state = passed.pass(radiosity::detail::numbers_per_round);
      const radiosity::detail::SampledPair between{radiosity::detail::SamplePieces{p}, radiosity::detail::SamplePieces{q}, 0.01};
      radiosity::detail::draw_segments(between, state, shift, drawn, set);
      for (std::uint32_t i = 0; i < 16; ++i) {
        INFO("segment " << i << ", set " << static_cast<int>(set) << ", corners " << p.contour.size() << " " << q.contour.size());
        const glm::dvec3 x = radiosity::draw_exposed({&p, 0, nullptr, 0}, i, one_by_one);
        const glm::dvec3 y = radiosity::draw_exposed({&q, 0, nullptr, 0}, radiosity::detail::opposite_cell(i, shift), one_by_one);
        const glm::dvec3 d = y - x;
        const double r2 = glm::dot(d, d) + 0.01;
        const double weight = std::max(0.0, glm::dot(p.normal, d)) * std::max(0.0, -glm::dot(q.normal, d)) / (r2 * r2);
        const raycast::Segment segment = drawn.segments.at(i);
        REQUIRE(segment.origin == x);
        REQUIRE(segment.direction == d);
        REQUIRE(drawn.weight[i] == weight);
      }
      CHECK(passed.bits() == one_by_one.bits());
    }
  }
}

TEST_CASE("kernel sums: every instruction set gives the same bits, those of the sum over pairs of points but for rounding") {
  using radiosity::detail::KernelLight;
  using radiosity::detail::KernelPoints;
  const std::uint64_t seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 generator{seed};
  for (int round = 0; round < 300; ++round) {
    const Patch p = random_patch(generator, 3 + generator() % 5), q = random_patch(generator, 3 + generator() % 5);
    double total = 0.0, size = 0.0;
    std::vector<double> on_q(q.rule3.size(), 0.0);
    for (const auto& a : p.rule3) {
      for (std::size_t j = 0; j < q.rule3.size(); ++j) {
        const auto& b = q.rule3[j];
        const glm::dvec3 d = b.position - a.position;
        const double r2 = glm::dot(d, d);
        const double light = a.weight * b.weight * std::max(0.0, glm::dot(p.normal, d)) * std::max(0.0, -glm::dot(q.normal, d)) / (r2 * r2);
        total += light;
        on_q[j] += light;
      }
    }
    for (const double x : on_q) { size += x; }
    const KernelPoints points_p{p, p.rule3}, points_q{q, q.rule3};
    KernelLight first;
    radiosity::detail::light_of_kernel(points_p, points_q, first, Isa::portable);
    const double first_sum = radiosity::detail::sum_of_kernel(points_p, points_q, Isa::portable);
    // Some 1000 terms, each with ten roundings, and cosines near 0 err by the rounding of coordinates of the size of 1.
    CHECK(std::abs(first.total - total) <= 1e-11 * (total + 1e-3));
    for (std::size_t j = 0; j < on_q.size(); ++j) { CHECK(std::abs(first.on_q[j] - on_q[j]) <= 1e-11 * (size + 1e-3)); }
    for (const Isa set : sets_of_this_machine()) {
      KernelLight light;
      radiosity::detail::light_of_kernel(points_p, points_q, light, set);
      const double sum = radiosity::detail::sum_of_kernel(points_p, points_q, set);
      CHECK(std::memcmp(&sum, &first_sum, sizeof(sum)) == 0);
      CHECK(std::memcmp(light.on_p, first.on_p, p.rule3.size() * sizeof(double)) == 0);
      CHECK(std::memcmp(light.on_q, first.on_q, q.rule3.size() * sizeof(double)) == 0);
      CHECK(light.total == first.total);
      CHECK(light.square == first.square);
    }
  }
}

TEST_CASE("links: light is carried to the same bits with every instruction set") {
  const std::uint64_t seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 generator{seed};
  std::normal_distribution<double> normal;
  const auto vector = [&] { return glm::dvec3{normal(generator), normal(generator), normal(generator)}; };
  constexpr std::uint32_t nodes = 20;
  using Moments = radiosity::Transport::Moments;
  std::vector<Moments> sent(nodes);
  for (Moments& m : sent) { m = {normal(generator), vector()}; }
  radiosity::Links links(1000);
  for (radiosity::Link& link : links) {
    link.p = static_cast<std::uint32_t>(generator() % nodes);
    link.q = static_cast<std::uint32_t>(generator() % nodes);
    link.exchange = static_cast<float>(std::abs(normal(generator)));
    if (generator() % 2 == 0) { link.shape_p = radiosity::EndShape::of_patch(glm::vec3{vector()}); }
    if (generator() % 2 == 0) { link.shape_q = radiosity::EndShape::of_patch(glm::vec3{vector()}); }
  }
  std::vector<Moments> first(nodes);
  radiosity::Transport::carry(links, sent, first, Isa::portable);
  for (const Isa set : sets_of_this_machine()) {
    std::vector<Moments> arrived(nodes);
    radiosity::Transport::carry(links, sent, arrived, set);
    for (std::uint32_t i = 0; i < nodes; ++i) {
      CHECK(arrived[i].value == first[i].value);
      CHECK(arrived[i].slope == first[i].slope);
    }
  }
}
