// SPDX-License-Identifier: MIT
#pragma once

// Points of a lamp to which segments are sent: some that are even over its area, and around each of these finer ones, for lamps of which a
// point sees little: a sky through a window.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/ray.hpp>

#include <radiosity/direct/facets.hpp>

namespace radiosity {

// Where segments to a facet end. Facets of a curved object cut its corners, so their points may lie beneath what segments meet: either the
// object owns them, and does not block its own points, or, where meshes stand in for it, they are lifted above these.
struct SampleEnd {
  std::uint32_t owner = raycast::no_object;
  double lift = 0.0;  // along the normal of the facet
};

struct LampSample {
  glm::dvec3 position{0.0}, normal{0.0};
  SampleEnd end;
};

// The first `count` of Sobol's points (1967), mapped to the triangles of the facets laid side by side: each multiple of sixteen of them is
// even over the area. `ends`: of each facet. `seed`: another one for each lamp, or what the points of one miss those of all
// others of its shape would miss, too.
[[nodiscard]] std::vector<LampSample> lamp_samples(const Facets& facets, std::span<const SampleEnd> ends, std::size_t count,
                                                   std::uint64_t seed);

// Fine samples of equal area, by the coarse one that each is nearest to. Those of a coarse sample fill its cell (Voronoi 1908), the first
// ones too.
class FineSamples {
 public:
  FineSamples() = default;
  FineSamples(std::span<const LampSample> coarse, std::span<const LampSample> fine);

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  [[nodiscard]] std::span<const LampSample> of(std::uint32_t cell) const {
    return std::span{samples_}.subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
  }
  // Cells that touch this one, ascending.
  [[nodiscard]] std::span<const std::uint32_t> beside(std::uint32_t cell) const { return beside_[cell]; }
  // Its part of the lamp's area.
  [[nodiscard]] double share(std::uint32_t cell) const {
    return static_cast<double>(of(cell).size()) / static_cast<double>(samples_.size());
  }

 private:
  std::vector<LampSample> samples_;
  std::vector<std::size_t> begin_;
  std::vector<std::vector<std::uint32_t>> beside_;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/direct/lamp_samples.cpp>
#endif
