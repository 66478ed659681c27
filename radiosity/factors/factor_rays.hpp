// SPDX-License-Identifier: MIT
#pragma once

// Form factors on the true surfaces, by rays: from points spread evenly over what is exposed of an object, in directions that follow the
// cosine, it is counted where they arrive first. Sixteen independently scrambled Sobol sequences give sixteen estimates; their mean is the
// result and their spread its standard error. In a closed scene every ray arrives, so the row of each sequence sums to 1.
//
// Where the rays begin. On flat faces: points of the faces. On anything else: lines spread evenly over all lines that meet the object's
// bounds. What crosses a surface is evenly distributed over its area and follows the cosine (Cauchy 1841, Crofton 1868), whatever the
// shape, so spans are all that is asked of an object; the number of crossings gives its area.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/ray.hpp>
#include <raycast/scene.hpp>

#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

// A flat piece of a surface.
struct Facet {
  Piece contour;
  glm::dvec3 normal{0.0};
  double area = 0.0;
};

// Where rays begin, and what their first hits count for.
struct RaySource {
  std::uint32_t object = 0;
  bool may_be_covered = false;          // points must be asked whether they are exposed
  std::span<const Facet> facets;        // when flat; else lines through the object's bounds
  std::uint32_t row = 0;                // of the facets
  std::span<const std::uint32_t> rows;  // of the sheets of the object, when there are no facets
};

inline constexpr std::size_t sequences = 16;

// Counts of one source, by sequence: [sequence * rows + row].
struct RayCounts {
  std::uint64_t lines = 0;           // or points, of one sequence
  std::vector<std::uint64_t> begun;  // at exposed points of each row
  std::vector<std::uint64_t> hits;   // [(sequence * source rows + source row) * rows + row]; source rows in the order of first_row
};

class RayCounter {
 public:
  // `row_of[object][sheet]`; rows are numbered without gaps and there are `rows` of them. The rows of a source lie side by side.
  RayCounter(const raycast::Scene& scene, const std::vector<std::vector<std::uint32_t>>& row_of, const RaySource& source,
             std::uint32_t first_row, std::uint32_t source_rows, std::uint32_t rows, std::uint64_t seed);

  // Casts until each sequence has gone through `lines` points.
  void extend(std::uint64_t lines, unsigned threads);

  struct Mean {
    double value = 0.0, error = 0.0;
  };
  // The factor from a row of the source to another; the error is half of a 95 % interval. The spread of sixteen numbers says little of a
  // handful of rays that arrive, or do not, and nothing of none: with k of them, k + 2 + 2 sqrt(k) is about the upper end of the 95 %
  // interval of a Poisson distribution (3 when there are none: the rule of three). From sixteen on, one a sequence, the spread counts.
  [[nodiscard]] Mean factor(std::uint32_t from, std::uint32_t to) const;
  // The sum of all factors from a row.
  [[nodiscard]] Mean sum(std::uint32_t from) const;
  // Rays from exposed points of a row.
  [[nodiscard]] std::uint64_t rays(std::uint32_t from) const;
  // The exposed area of a row.
  [[nodiscard]] Mean area(std::uint32_t from) const;

 private:
  [[nodiscard]] std::uint64_t begun(std::size_t s, std::uint32_t from) const { return counts_.begun[s * source_rows_ + from - first_row_]; }
  [[nodiscard]] std::uint64_t hits(std::size_t s, std::uint32_t from, std::uint32_t to) const {
    return counts_.hits[(s * source_rows_ + from - first_row_) * rows_ + to];
  }
  [[nodiscard]] static Mean mean_of(const std::array<double, sequences>& values);
  template <class Count>
  [[nodiscard]] Mean mean(std::uint32_t from, const Count& count, double least) const {
    std::array<double, sequences> values{};
    for (std::size_t s = 0; s < sequences; ++s) {
      const std::uint64_t rays = begun(s, from);
      values[s] = rays > 0 ? count(s) / static_cast<double>(rays) : 0.0;
    }
    Mean result = mean_of(values);
    result.error = std::max(result.error, least);
    return result;
  }

  void cast(std::size_t s, const std::array<double, 4>& u, RayCounts& counts) const;

  // A point of the facet, continuous in both arguments; `rest` is an area.
  [[nodiscard]] static glm::dvec3 point_of(const Facet& facet, double rest, double v);

  // A line through the bounds of the object, evenly over all of them: an even point of the six sides, a cosine direction inwards. Its
  // length is the diameter of the scene.
  [[nodiscard]] raycast::Segment line_of(const std::array<double, 4>& u) const;

  void begin(std::size_t s, std::uint32_t row, const glm::dvec3& x, const glm::dvec3& direction, const glm::dvec3& normal,
             RayCounts& counts) const;

  const raycast::Scene* scene_;
  const std::vector<std::vector<std::uint32_t>>* row_of_;
  RaySource source_;
  std::uint32_t first_row_, source_rows_, rows_;
  std::uint64_t seed_;
  RayCounts counts_;
  std::vector<double> cumulative_;
  std::array<double, 3> side_{};
  double box_area_ = 0.0;
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factor_rays.cpp>
#endif
