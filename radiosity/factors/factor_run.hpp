// SPDX-License-Identifier: MIT
#pragma once

// Computes the form factors of all pairs of surfaces, each pair by one of three methods: by faces where that is proven to be exact, else by
// meshes where nothing can stand between, else by rays.

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
  std::uint64_t rays = std::uint64_t{1} << 22;  // at most, from each object
  unsigned threads = 0;                         // 0: as many as the machine has; results do not depend on it
  std::uint64_t seed = 1;
};

namespace detail {

// What a run needs to know; lengths in the frame.
struct FactorRun {
  const Prepared& prepared;
  const FactorOptions& options;
  FactorRows rows;
  std::vector<FlatFace> faces;
  std::vector<Blocker> blockers;
  double slack = 0.0;
  std::vector<Estimate> area;
  std::vector<std::optional<Estimate>> exchange;  // [i * n + j], i <= j: when known from the faces
  std::uint64_t points = 0;

  // Can an object that is not made of faces stand between the facets of the two rows?
  [[nodiscard]] bool curved_between(const FactorRow& a, const FactorRow& b) const;

  // The exchanges of all pairs of rows that faces can tell.
  void by_faces();

  // Is all of a curved object, or of an exact row, exposed, and does it see each other object as if there were no third?
  [[nodiscard]] bool stands_free(const FactorRow& row) const;
  // Are the corners of the box inside the convex room, away from its walls?
  [[nodiscard]] bool clear_of_walls(const raycast::PlacedObject& room, const raycast::Box& box) const;
  // Can nothing stand between two rows that stand free?
  [[nodiscard]] bool nothing_between(std::uint32_t a, std::uint32_t b) const;

  // The exchanges that meshes can tell, and the areas of what stands free.
  void by_meshes();

  [[nodiscard]] bool known(std::size_t i, std::size_t j) const {
    return exchange[std::min(i, j) * rows.rows.size() + std::max(i, j)].has_value();
  }
  [[nodiscard]] bool needs_rays(std::size_t i) const;

  // One counter for each row that needs rays; rows of one object without facets share theirs.
  [[nodiscard]] std::vector<std::shared_ptr<RayCounter>> by_rays();

  // Twice as many rays until the wanted error is reached, less a tenth: the mean of both ends is not weighed by their spreads alone
  // (weighted()), and may err by a little more than the better one.
  void run(RayCounter& counter, std::uint32_t first, std::uint32_t end) const;

  // Can anything lie on the object, or reach into it?
  [[nodiscard]] bool may_be_covered(std::uint32_t object) const;
};

// What the rays of one or both ends say about the exchange of two rows.
[[nodiscard]] Estimate weighted(const std::vector<std::shared_ptr<RayCounter>>& counters, const std::vector<Estimate>& area,
                                std::uint32_t i, std::uint32_t j);

}  // namespace detail

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/factors/factor_run.cpp>
#endif
