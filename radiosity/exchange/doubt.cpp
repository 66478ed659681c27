// SPDX-License-Identifier: MIT
#include <radiosity/exchange/doubt.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>

namespace radiosity {

HALFLIGHT_INLINE void DoubtSum::add(std::uint32_t p, std::uint32_t q, const Doubt& doubt) {
  add(p, static_cast<double>(doubt.p));
  add(q, static_cast<double>(doubt.q));
  square_ += static_cast<double>(doubt.square);
  chord_ += static_cast<double>(doubt.chord);
  depth_ = std::max(depth_, static_cast<double>(doubt.depth));
}

HALFLIGHT_INLINE void DoubtSum::add(const DoubtSum& other) {
  for (std::uint32_t i = 0; i < other.across_.size(); ++i) {
    add(i, other.across_[i]);
    if (other.across_[i] > 0.0) { squares_[i] += other.squares_[i] - other.across_[i] * other.across_[i]; }
  }
  square_ += other.square_;
  chord_ += other.chord_;
  depth_ = std::max(depth_, other.depth_);
}

HALFLIGHT_INLINE void DoubtSum::remove(std::uint32_t p, std::uint32_t q, const Doubt& doubt) {
  remove(p, static_cast<double>(doubt.p));
  remove(q, static_cast<double>(doubt.q));
  square_ = std::max(0.0, square_ - static_cast<double>(doubt.square));
  chord_ = std::max(0.0, chord_ - static_cast<double>(doubt.chord));
}

HALFLIGHT_INLINE double DoubtSum::rms(const Hierarchy& hierarchy, const std::vector<double>& area, double total) const {
  double sum = square_ + chord_ * depth_;
  for (std::size_t i = 0; i < across_.size(); ++i) { sum += hierarchy[i].leaf() ? 0.0 : area[i] * across_[i] * across_[i]; }
  return total > 0.0 ? std::sqrt(sum / total) : 0.0;
}

HALFLIGHT_INLINE double DoubtSum::alike(const Hierarchy& hierarchy, const std::vector<double>& area) const {
  double sum = 0.0;
  double apart = 0.0;
  for (std::size_t i = 0; i < across_.size(); ++i) {
    if (hierarchy[i].leaf()) { continue; }
    sum += area[i] * across_[i] * across_[i];
    apart += area[i] * squares_[i];
  }
  return apart > 0.0 ? sum / apart : 1.0;
}

HALFLIGHT_INLINE void DoubtSum::add(std::uint32_t node, double error) {
  if (!(error > 0.0)) { return; }
  if (node >= across_.size()) {
    across_.resize(node + 1, 0.0);
    squares_.resize(node + 1, 0.0);
  }
  across_[node] += error;
  squares_[node] += error * error;
}

HALFLIGHT_INLINE void DoubtSum::remove(std::uint32_t node, double error) {
  if (!(error > 0.0) || node >= across_.size()) { return; }
  across_[node] = std::max(0.0, across_[node] - error);  // the remainder may be negative by rounding
  squares_[node] = std::max(0.0, squares_[node] - error * error);
}

}  // namespace radiosity
