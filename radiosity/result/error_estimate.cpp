// SPDX-License-Identifier: MIT
#include <radiosity/result/error_estimate.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <raycast/inline.hpp>

namespace radiosity {

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
  for (std::size_t i = 0; i < square.size(); ++i) {
    const double off = (square[i] - result.ratio * reference[i]) / signal;
    second += off * off;
    third += off * off * off;
  }
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
  const auto quantile = [&](double x) {  // of (estimate - truth) / noise, where x is that of the normal distribution
    return std::abs(lean) > 1e-6 ? 3.0 / lean * (std::cbrt(1.0 + lean * (x - lean / 6.0)) - 1.0) : x;
  };
  constexpr double two_sided = 1.959963984540054;  // 95 %
  const auto root = [](double x) { return std::sqrt(std::max(0.0, x)); };
  ErrorEstimate result;
  result.relative_l2 = root(m->ratio);
  result.low = root(m->ratio - noise_of_mean * quantile(two_sided));
  result.high = std::max(result.relative_l2, root(m->ratio - noise_of_mean * quantile(-two_sided)));
  // An error that is lost in the noise is not known to be smaller than the noise: a mean that chance took below 0 would say so.
  if (result.low == 0.0) { result.high = std::max(result.high, root(std::max(0.0, m->ratio) + two_sided * noise_of_mean)); }
  // d sqrt(x) = dx / (2 sqrt(x)); where the error is lost in the noise, the noise itself bounds it.
  result.standard_error = m->ratio > noise_of_mean ? 0.5 * noise_of_mean / result.relative_l2 : std::sqrt(noise_of_mean);
  return result;
}

}  // namespace radiosity
