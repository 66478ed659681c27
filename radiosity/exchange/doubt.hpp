// SPDX-License-Identifier: MIT
#pragma once

// The error of row sums that is expected from quadrature and sampling in the links. A closed scene is corrected so that its row sums are 1
// (Transport::close), but only where this error explains the correction: a larger one has another cause.
//
// The row sum of a leaf is the sum of what the links above it bring, and each link is off
//   - on a patch with children, by what its linear kernel leaves of the light's change across the patch (rest), and of the shadow's: RMS
//     values over the patch, times G / A. The links of one node err alike, as in a corner of a room, so here they add up as they are;
//     from node to node their squares do. A leaf has one value, so these errors count at nodes that have children at last;
//   - by what is not known of its visible fraction, of n segments of which k arrive: variance (k + 1)(n - k + 1) / ((n + 2)^2 (n + 3))
//     (Laplace 1774), and of the exposed area of its other end, of 256 points: independent, squares add up;
//   - on curved objects, by the chord: all links err alike there, and add up as they are.

#include <cstdint>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>

namespace radiosity {

// Of one link.
struct Doubt {
  float p = 0.0f, q = 0.0f;  // RMS error of the rows below each end by what the link cannot express
  float square = 0.0f;       // sum over the rows of their independent errors, squared, weighted by area
  float chord = 0.0f;        // sum over the rows of the errors by chords, weighted by area
  float depth = 0.0f;        // of the chord, relative to the light of the link
};

class DoubtSum {
 public:
  void add(std::uint32_t p, std::uint32_t q, const Doubt& doubt);
  void add(const DoubtSum& other);
  // Takes back what was added for a link that is no longer there. The largest chord stays, as a bound.
  void remove(std::uint32_t p, std::uint32_t q, const Doubt& doubt);
  // Expected RMS error of the row sums; `area` of each node, `total` of the scene. The mean of what the chords take, times the most that
  // they can take, bounds its mean square.
  [[nodiscard]] double rms(const Hierarchy& hierarchy, const std::vector<double>& area, double total) const;

  // How much more the squared errors across nodes are than if the links of one node erred independently.
  [[nodiscard]] double alike(const Hierarchy& hierarchy, const std::vector<double>& area) const;

 private:
  void add(std::uint32_t node, double error);
  void remove(std::uint32_t node, double error);

  std::vector<double> across_, squares_;  // of each node: the sum, and the sum of the squares
  double square_ = 0.0, chord_ = 0.0, depth_ = 0.0;
};

// The largest RMS error of row sums with which a scene is closed: what its links explain with a margin of one half, and the error
// of a form factor (exchange.hpp). Measured, row sums are off by .2 to 1.4 times what is expected (rooms of all shapes with sheets and
// solids in them, epsilon .02 to .1).
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
