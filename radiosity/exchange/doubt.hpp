// SPDX-License-Identifier: MIT
#pragma once

// The expected error of row sums by quadrature and sampling in the links. A closed scene is corrected so that its row sums are 1
// (Transport::close), but only if this error explains the correction; a larger correction must have another cause.
//
// The row sum of a leaf is the sum over the links of the leaf and its ancestors. Each link has an error from three sources:
//   - on a patch with children, what its linear kernel leaves of the variation of light (rest) and shadow across the patch: RMS values over
//     the patch, times G / A. The links of one node err alike, as in a corner of a room, so within a node these errors are added; over the
//     nodes their squares are added. A leaf has one value only, so these errors count only at nodes that have children in the end;
//   - the sampled visible fraction, k of n segments: variance (k + 1)(n - k + 1) / ((n + 2)^2 (n + 3)) (Laplace 1774), and the exposed area
//     of its other end, from 256 points: independent errors, squares are added;
//   - on curved objects, the distance between chord and surface: all links err alike there, so these errors are added.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>

namespace radiosity {

// The errors of one link.
struct Doubt {
  float p = 0.0f, q = 0.0f;  // RMS error of the row sums below each end, by variation that the link cannot represent
  float square = 0.0f;       // sum over the rows of the squared independent errors, weighted by area
  float chord = 0.0f;        // sum over the rows of the errors by chords, weighted by area
  float depth = 0.0f;        // error by chords, relative to the light of the link
};

class DoubtSum {
 public:
  void add(std::uint32_t p, std::uint32_t q, const Doubt& doubt);
  void add(const DoubtSum& other);
  // Subtracts what was added for a link that has been removed. The largest chord error stays, as an upper bound.
  void remove(std::uint32_t p, std::uint32_t q, const Doubt& doubt);
  // Expected RMS error of the row sums; `area`: of each node, `total`: of the scene. The mean square of the chord errors is bounded by
  // their mean times their maximum.
  [[nodiscard]] double rms(const Hierarchy& hierarchy, const std::vector<double>& area, double total) const;

  // Ratio of the squared errors across nodes to those that independent errors of the links of one node would give.
  [[nodiscard]] double alike(const Hierarchy& hierarchy, const std::vector<double>& area) const;

 private:
  void add(std::uint32_t node, double error);
  void remove(std::uint32_t node, double error);

  std::vector<double> across_, squares_;  // by node: the sum of the errors, and of their squares
  double square_ = 0.0, chord_ = 0.0, depth_ = 0.0;
};

// The largest RMS error of row sums with which a scene is closed: 1.5 times what its links explain, plus the error of a form factor
// (exchange.hpp). In measurements row sums were off by 0.2 to 1.4 times the expectation (rooms of all shapes with sheets and solids in
// them, epsilon 0.02 to 0.1).
[[nodiscard]] inline double explained_closure(const DoubtSum& doubt, const Hierarchy& hierarchy, const std::vector<double>& area,
                                              double total) {
  return 1.5 * doubt.rms(hierarchy, area, total) + 2e-5;
}

// Variance of the visible fraction when `fraction` of `segments` arrived.
[[nodiscard]] inline double visibility_variance(double fraction, double segments) {
  const double clear = fraction * segments;
  return (clear + 1.0) * (segments - clear + 1.0) / ((segments + 2.0) * (segments + 2.0) * (segments + 3.0));
}

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/exchange/doubt.cpp>
#endif
