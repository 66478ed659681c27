// SPDX-License-Identifier: MIT
#pragma once

// Form factors on the true surfaces, by rays: from points uniformly distributed over the exposed area of an object, in cosine-distributed
// directions, the first hits are counted by surface. Sixteen independently scrambled Sobol sequences give sixteen estimates; their mean
// is the result, and their spread gives its standard error. In a closed scene every ray hits something, so the row of each sequence sums
// to 1.
//
// Origins of the rays. On flat faces: points of the faces. On other objects: crossings with lines that are uniformly distributed over all
// lines through the object's bounds. Such crossings are uniform over the area and cosine-distributed (Cauchy 1841, Crofton 1868) for any
// shape, so an object needs to provide only spans. The number of crossings gives the area.

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

// Where rays begin, and to which rows their first hits are counted.
struct RaySource {
  std::uint32_t object = 0;
  bool may_be_covered = false;    // must points be tested for being exposed?
  std::span<const Facet> facets;  // of a flat object; if empty, lines through the object's bounds are used
  std::uint32_t first_row = 0, rows = 1;
  std::span<const std::uint32_t> row_of_sheet;  // if there are no facets
};

inline constexpr std::size_t sequences = 16;

// Counts of one source. `begun` is indexed by [sequence * rows + row].
struct RayCounts {
  std::uint64_t lines = 0;           // lines or points cast so far, by each sequence
  std::vector<std::uint64_t> begun;  // rays from exposed points of each row
  std::vector<std::uint64_t> hits;   // [(sequence * source rows + source row) * rows + row]; source rows count from its first_row
};

class RayCounter {
 public:
  // `row_of[object][sheet]`: rows are numbered 0 to `rows` - 1 without gaps. The rows of a source are consecutive.
  RayCounter(const raycast::Scene& scene, const std::vector<std::vector<std::uint32_t>>& row_of, const RaySource& source,
             std::uint32_t rows, std::uint64_t seed);

  // Casts until each sequence has used `lines` points.
  void extend(std::uint64_t lines, unsigned threads);

  struct Mean {
    double value = 0.0, error = 0.0;
  };
  // The factor from a row of the source to another one; the error is half of a 95 % interval. If only k < 16 rays arrive, the spread of
  // sixteen numbers says little, so k + 2 + 2 sqrt(k) is used, about the upper end of the 95 % interval of a Poisson distribution (3 if
  // k = 0: the rule of three). From sixteen rays on, one a sequence, the spread is used.
  [[nodiscard]] Mean factor(std::uint32_t from, std::uint32_t to) const;
  // The sum of all factors from a row.
  [[nodiscard]] Mean sum(std::uint32_t from) const;
  // Number of rays cast from exposed points of a row.
  [[nodiscard]] std::uint64_t rays(std::uint32_t from) const;
  // The exposed area of a row.
  [[nodiscard]] Mean area(std::uint32_t from) const;

 private:
  [[nodiscard]] std::uint64_t begun(std::size_t s, std::uint32_t from) const {
    return counts_.begun[s * source_.rows + from - source_.first_row];
  }
  [[nodiscard]] std::uint64_t hits(std::size_t s, std::uint32_t from, std::uint32_t to) const {
    return counts_.hits[(s * source_.rows + from - source_.first_row) * rows_ + to];
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

  // Maps to a point of the facet, continuously in both arguments; `rest`: an area, from 0 to that of the facet.
  [[nodiscard]] static glm::dvec3 point_of(const Facet& facet, double rest, double v);

  // A line through the bounds of the object, uniformly distributed over all such lines: a uniform point of the six sides and a
  // cosine-distributed direction inwards. Its length is the diameter of the scene.
  [[nodiscard]] raycast::Segment line_of(const std::array<double, 4>& u) const;

  void begin(std::size_t s, std::uint32_t row, const glm::dvec3& x, const glm::dvec3& direction, const glm::dvec3& normal,
             RayCounts& counts) const;

  const raycast::Scene* scene_;
  const std::vector<std::vector<std::uint32_t>>* row_of_;
  RaySource source_;
  std::uint32_t rows_;
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
