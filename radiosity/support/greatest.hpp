// SPDX-License-Identifier: MIT
#pragma once

// The maximum of values that change one at a time.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace radiosity {

// A tournament tree: the winner of each match between two values is stored; when a value changes, its log n matches are repeated.
class Greatest {
 public:
  explicit Greatest(std::vector<double> values) : values_{std::move(values)}, winner_(2 * values_.size(), 0) {
    const std::size_t n = values_.size();
    for (std::size_t match = 2 * n; match-- > 1;) { winner_[match] = match < n ? winner(match) : static_cast<std::uint32_t>(match - n); }
  }
  [[nodiscard]] double operator[](std::uint32_t i) const { return values_[i]; }
  void set(std::uint32_t i, double value) {
    values_[i] = value;
    for (std::size_t match = (i + values_.size()) / 2; match > 0; match /= 2) { winner_[match] = winner(match); }
  }
  // Index of the maximum, the first one of equal values. Requires at least one value.
  [[nodiscard]] std::uint32_t index() const { return winner_[1]; }

 private:
  [[nodiscard]] std::uint32_t winner(std::size_t match) const {
    const std::uint32_t a = winner_[2 * match], b = winner_[2 * match + 1];
    return values_[a] > values_[b] || (values_[a] == values_[b] && a < b) ? a : b;
  }

  std::vector<double> values_;
  std::vector<std::uint32_t> winner_;  // winner of match i between those of 2 i and 2 i + 1; the second half are the values themselves
};

}  // namespace radiosity
