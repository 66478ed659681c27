// SPDX-License-Identifier: MIT
#pragma once

// A logarithmic axis: the range of its values, their positions, and its ticks. As many ticks are labelled as there is room for: 1 2 3 5 7
// of each decade, else 1 2 5, else decades, else every second decade, and so on. With room for three labels in two decades, every axis
// has at least two labels.

#include <algorithm>
#include <cmath>
#include <vector>

namespace study {

struct Tick {
  double value = 1.0;
  bool labelled = false;
};

class LogAxis {
 public:
  LogAxis() = default;
  // From `low` to `high`, both positive, with a margin of 6 % of the range at both ends, and at least half a decade altogether.
  LogAxis(double low, double high) : LogAxis(between(low, high)) {
    const double missing = std::max(0.0, 0.5 - (high_ - low_));
    const double margin = 0.06 * (high_ - low_) + 0.5 * missing;
    low_ -= margin;
    high_ += margin;
  }

  // Without a margin.
  [[nodiscard]] static LogAxis between(double low, double high) {
    LogAxis axis;
    axis.low_ = std::log10(low);
    axis.high_ = std::log10(high);
    return axis;
  }

  // The position of a value: 0 at the low end, 1 at the high end.
  [[nodiscard]] double place(double value) const { return (std::log10(value) - low_) / (high_ - low_); }
  [[nodiscard]] double low() const { return std::pow(10.0, low_); }
  [[nodiscard]] double high() const { return std::pow(10.0, high_); }

  // `room`: the length of a label as a fraction of the axis.
  [[nodiscard]] std::vector<Tick> ticks(double room) const {
    std::vector<Tick> result;
    const double least = room * (high_ - low_);                                // smallest distance between labels, in decades
    const bool few = least <= std::log10(2.0);                                 // do labels fit from 1 to 2 and from 5 to 10?
    const bool fewer = least <= std::log10(7.0 / 5.0) && high_ - low_ < 1.0;   // do labels fit from 5 to 7?
    const int every = std::max(1, static_cast<int>(std::ceil(least - 1e-9)));  // label every how many decades
    for (int decade = static_cast<int>(std::floor(low_)); decade <= static_cast<int>(std::floor(high_)); ++decade) {
      for (int k = 1; k < 10; ++k) {
        const double value = k * std::pow(10.0, decade);
        if (place(value) < 0.0 || place(value) > 1.0) { continue; }
        const bool labelled = k == 1 ? decade % every == 0 : (few && (k == 2 || k == 5)) || (fewer && (k == 3 || k == 7));
        result.push_back({value, labelled});
      }
    }
    return result;
  }

 private:
  double low_ = 0.0;  // exponents of ten
  double high_ = 1.0;
};

}  // namespace study
