// SPDX-License-Identifier: MIT
#pragma once

// Computes the form factors of all pairs of surfaces, each by one of three methods: from the faces if that is proven to be exact,
// otherwise from meshes if nothing can stand in between, otherwise by rays.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <raycast/box.hpp>
#include <raycast/transform.hpp>

#include <radiosity/factors/factor_integral.hpp>
#include <radiosity/factors/factor_rays.hpp>
#include <radiosity/factors/factor_rows.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <radiosity/visibility/shadow.hpp>

namespace radiosity {

struct FactorOptions {
  double error = 1e-3;                          // wanted of each factor; rays are cast until it is reached
  std::uint64_t rays = std::uint64_t{1} << 22;  // limit of the rays from each object
  unsigned threads = 0;                         // 0: as many as the machine has; results do not depend on it
  std::uint64_t seed = 1;
};

namespace detail {

// Data of a run; lengths in the frame.
struct FactorRun {
  const Prepared& prepared;
  const FactorOptions& options;
  FactorRows rows;
  std::vector<FlatFace> faces;
  std::vector<Blocker> blockers;
  double slack = 0.0;
  std::vector<Estimate> area;
  std::vector<std::optional<Estimate>> exchange;  // [i * n + j], i <= j: exchange, if known from faces or meshes
  std::uint64_t points = 0;

  // Can an object that does not consist of flat faces stand between the facets of the two rows?
  [[nodiscard]] bool curved_between(const FactorRow& a, const FactorRow& b) const;

  // Computes the exchanges of all pairs of rows for which faces suffice.
  void by_faces();

  // Is the whole surface (of a curved object or an exact row) exposed, and can no third object stand between it and another one?
  [[nodiscard]] bool stands_free(const FactorRow& row) const;
  // Do all corners of the box lie inside the convex room and away from its walls?
  [[nodiscard]] bool clear_of_walls(const raycast::PlacedObject& room, const raycast::Box& box) const;
  // Can nothing stand between two rows that both stand free?
  [[nodiscard]] bool nothing_between(std::uint32_t a, std::uint32_t b) const;

  // Computes the exchanges for which meshes suffice, and the areas of rows that stand free.
  void by_meshes();

  [[nodiscard]] bool known(std::size_t i, std::size_t j) const {
    return exchange[std::min(i, j) * rows.rows.size() + std::max(i, j)].has_value();
  }
  [[nodiscard]] bool needs_rays(std::size_t i) const;

  // One counter for each row that needs rays; rows of the same object without facets share one.
  [[nodiscard]] std::vector<std::shared_ptr<RayCounter>> by_rays();

  // Doubles the number of rays until the error is at most 0.9 of the wanted one. The margin is needed because the mean of both ends is
  // not weighted by their variances alone (weighted()), so its error may be a little larger than that of the better end.
  void run(RayCounter& counter, std::uint32_t first, std::uint32_t end) const;

  // Can another object lie on this one or reach into it?
  [[nodiscard]] bool may_be_covered(std::uint32_t object) const;
};

// The exchange of two rows estimated from the rays of one or both of them.
[[nodiscard]] Estimate weighted(const std::vector<std::shared_ptr<RayCounter>>& counters, const std::vector<Estimate>& area,
                                std::uint32_t i, std::uint32_t j);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factor_run.cpp>
#endif
