// SPDX-License-Identifier: MIT
#pragma once

// Points of a lamp to which segments are sent: coarse samples, stratified over its area, and around each of them finer ones, for lamps of
// which a point may see little, such as a sky through a window.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/direct/facets.hpp>

namespace radiosity {

// How segments to a facet end. The facets of a curved object lie beneath its surface, so the object would block segments to them. So
// either the object owns the end and does not block its own points, or, if stand-in meshes replace it, the points are lifted above these.
struct SampleEnd {
  std::uint32_t owner = raycast::no_object;
  double lift = 0.0;  // along the normal of the facet
};

struct LampSample {
  glm::dvec3 position{0.0}, normal{0.0};
  SampleEnd end;
};

// The first `count` points of Sobol's sequence (1967), mapped to the triangles of the facets laid side by side: each multiple of sixteen
// points is stratified over the area. `ends`: by facet. `seed`: different for each lamp, so that the sampling errors of lamps of equal
// shape are independent.
[[nodiscard]] std::vector<LampSample> lamp_samples(const Facets& facets, std::span<const SampleEnd> ends, std::size_t count,
                                                   std::uint64_t seed);

// A lamp that is a ball is seen as a disk from anywhere, so its samples are points of a disk: none is wasted on the side that is not seen,
// and all carry the same. They lie in the unit disk of the plane z = 0, stratified as above (concentric map of Shirley and Chiu 1997).
[[nodiscard]] std::vector<LampSample> disk_samples(const SampleEnd& end, std::size_t count, std::uint64_t seed);

// Sixteen points close to the rim. A straight edge that hides none of them hides less than 1 % of the disk.
[[nodiscard]] std::vector<LampSample> rim_samples(const SampleEnd& end);

// A ball as seen from x, a point outside of it.
class SeenBall {
 public:
  SeenBall(const glm::dvec3& centre, double radius, const glm::dvec3& x);
  [[nodiscard]] bool outside() const { return versine_ > 0.0; }
  // The point of the ball for a sample of the disk: equal areas there are equal solid angles.
  [[nodiscard]] LampSample at(const LampSample& of_disk) const;

 private:
  glm::dvec3 centre_, x_, axis_{0.0}, s_{0.0}, t_{0.0};
  double radius_, distance_, versine_ = 0.0;  // 1 - the cosine of the apparent radius
};

// Fine samples of equal area, grouped by the nearest coarse sample, so that they fill its Voronoi cell (Voronoi 1908). Any first part of
// a group is spread over the cell, too.
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
  // The cell's share of the lamp's area.
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
