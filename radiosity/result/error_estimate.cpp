// SPDX-License-Identifier: MIT
#include <radiosity/result/error_estimate.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <brep/inline.hpp>

namespace radiosity {

namespace detail {

// The 97.5 % quantile of Student's distribution (Abramowitz and Stegun 26.7.5): accurate to 1 % from 3 degrees of freedom on, too small
// below.
[[nodiscard]] inline double two_sided_95(double degrees) {
  constexpr double x = 1.959963984540054;  // quantile of the normal distribution
  constexpr double first = (x * x * x + x) / 4.0, second = (5.0 * x * x * x * x * x + 16.0 * x * x * x + 3.0 * x) / 96.0;
  return x + first / degrees + second / (degrees * degrees);
}

}  // namespace detail

HALFLIGHT_INLINE void ErrorSums::add(double of_square, double of_reference, double of_noise) {
  square.push_back(of_square);
  reference.push_back(of_reference);
  noise += of_noise;
}

HALFLIGHT_INLINE std::optional<ErrorSums::Moments> ErrorSums::moments() const {
  const auto n = static_cast<double>(square.size());
  if (square.size() < 2) { return std::nullopt; }
  double error = 0.0;
  double signal = 0.0;
  for (std::size_t i = 0; i < square.size(); ++i) {
    error += square[i] / n;
    signal += reference[i] / n;
  }
  if (!(signal > 0.0)) { return std::nullopt; }
  Moments result;
  result.ratio = error / signal;
  double second = 0.0;
  double third = 0.0;
  double brightness = 0.0;
  for (std::size_t i = 0; i < square.size(); ++i) {
    const double light = reference[i] / signal, of_others = std::max(1.0 - light / n, 1.0 / n);
    const double off = (square[i] / signal - result.ratio * light) / of_others;
    second += off * off;
    third += off * off * off;
    brightness += light * light;
  }
  result.equal_points = n * n / brightness;
  result.variance = second / (n - 1.0);
  if (result.variance > 0.0) {
    result.skewness = third / n / (result.variance * std::sqrt(result.variance));
    result.noise_share = std::min(1.0, noise / n / (result.variance * signal * signal));
  }
  return result;
}

HALFLIGHT_INLINE std::optional<ErrorEstimate> ErrorSums::estimate() const {
  const std::optional<Moments> m = moments();
  if (!m) { return std::nullopt; }
  const auto n = static_cast<double>(square.size());
  const double noise_of_mean = std::sqrt(m->variance / n);
  const double lean = m->skewness / std::sqrt(n);
  const auto quantile = [&](double x) {  // quantile of (estimate - truth) / noise, for the quantile x of the normal distribution
    return std::abs(lean) > 1e-6 ? 3.0 / lean * (std::cbrt(1.0 + lean * (x - lean / 6.0)) - 1.0) : x;
  };
  const double two_sided = detail::two_sided_95(std::max(1.0, m->equal_points - 1.0));
  const auto root = [](double x) { return std::sqrt(std::max(0.0, x)); };
  ErrorEstimate result;
  result.relative_l2 = root(m->ratio);
  result.low = root(m->ratio - noise_of_mean * quantile(two_sided));
  result.high = std::max(result.relative_l2, root(m->ratio - noise_of_mean * quantile(-two_sided)));
  // If noise hides the error, the error is not known to be smaller than the noise, even if chance has made the estimated mean negative.
  if (result.low == 0.0) { result.high = std::max(result.high, root(std::max(0.0, m->ratio) + two_sided * noise_of_mean)); }
  // d sqrt(x) = dx / (2 sqrt(x)); if noise hides the error, the noise itself is the bound.
  result.standard_error = m->ratio > noise_of_mean ? 0.5 * noise_of_mean / result.relative_l2 : std::sqrt(noise_of_mean);
  return result;
}

}  // namespace radiosity
