// SPDX-License-Identifier: MIT
#include <radiosity/solver/balance.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <brep/inline.hpp>

namespace radiosity {

namespace detail {

// Applies D S D with the current D.
struct Scaled {
  void operator()(const std::vector<double>& x, std::vector<double>& y) {
    scratch.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) { scratch[i] = scale[i] * x[i]; }
    (*apply)(scratch, y);
    for (std::size_t i = 0; i < x.size(); ++i) { y[i] *= scale[i]; }
    ++products;
  }
  [[nodiscard]] bool exhausted() const { return products >= 400; }

  const SymmetricOperator* apply;
  std::vector<double> scale;
  std::vector<double> scratch{};
  int products = 0;
};

// Solves (diag(rows) + S) x = r in the free rows, until the residual is `part` of that of x = 0.
[[nodiscard]] HALFLIGHT_INLINE std::vector<double> newton_step(Scaled& matrix, const std::vector<double>& rows,
                                                               const std::vector<bool>& free, std::vector<double> r, double part) {
  const std::size_t n = rows.size();
  std::vector<double> x(n, 0.0);
  std::vector<double> step(n, 0.0);
  std::vector<double> image;
  const auto square_of = [&] {  // in the norm of the preconditioner diag(rows)
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) { sum += free[i] ? r[i] * r[i] / rows[i] : 0.0; }
    return sum;
  };
  double square = square_of();
  const double wanted = part * part * square;
  for (double along = 0.0; square > wanted && !matrix.exhausted();) {
    for (std::size_t i = 0; i < n; ++i) { step[i] = free[i] ? r[i] / rows[i] + along * step[i] : 0.0; }
    matrix(step, image);
    double curvature = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      image[i] = free[i] ? image[i] + rows[i] * step[i] : 0.0;
      curvature += step[i] * image[i];
    }
    if (!(curvature > 0.0)) { break; }
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += square / curvature * step[i];
      r[i] -= square / curvature * image[i];
    }
    const double next = square_of();
    along = next / square;
    square = next;
  }
  return x;
}

// Sum of the squared deviations of the row sums, each divided by the larger of actual and wanted value. Rows that should be 0 are left
// out, because scaling cannot change them.
[[nodiscard]] HALFLIGHT_INLINE double distance(const std::vector<double>& rows, const std::vector<double>& wanted) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (wanted[i] > 0.0) { sum += (wanted[i] - rows[i]) * (wanted[i] - rows[i]) / std::max(rows[i], wanted[i]); }
  }
  return sum;
}

}  // namespace detail

HALFLIGHT_INLINE std::vector<double> balance(const SymmetricOperator& apply, const std::vector<double>& t, const Balance& goal) {
  const std::size_t n = t.size();
  detail::Scaled matrix{&apply, std::vector<double>(n, 1.0)};
  const std::vector<double> ones(n, 1.0);
  std::vector<double> rows;
  std::vector<double> missing(n, 0.0);
  std::vector<bool> free(n, false);
  const auto limit = [&](double scale) { return std::clamp(scale, goal.limits.least, goal.limits.most); };
  // The best scale so far. If the system is nearly singular, a Newton step may lead away from the goal.
  double nearest = std::numeric_limits<double>::infinity(), start = nearest;
  std::vector<double> nearest_scale = matrix.scale;
  // Rounds in a row that came hardly nearer, as where no scale meets the goal. Those that are far away do not count: the next few lead
  // back, and often nearer than before, as in halls thousands of times as wide as high.
  int idle = 0;
  for (bool plain = true; !matrix.exhausted() && idle < 5; plain = false) {
    matrix(ones, rows);
    const double off = detail::distance(rows, t);
    if (plain) { start = off; }
    if (off < 10.0 * nearest) { idle = off < 0.9 * nearest ? 0 : idle + 1; }
    if (off < nearest) {
      nearest = off;
      nearest_scale = matrix.scale;
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      missing[i] = t[i] - rows[i];
      const double scale = matrix.scale[i];
      free[i] = rows[i] > 0.0 && t[i] > 0.0 && (missing[i] == 0.0 || limit(missing[i] > 0.0 ? 2.0 * scale : 0.5 * scale) != scale);
      if (free[i]) { worst = std::max(worst, std::abs(missing[i]) / t[i]); }
    }
    if (worst < goal.tolerance) { return off <= start ? matrix.scale : nearest_scale; }
    // Far from the goal a Newton step may lead anywhere, so one step of the simple iteration comes first.
    std::vector<double> step;
    if (!plain) {
      // No more exactly than the goal needs, which the last step would exceed by far (Kelley 1995, 6.3).
      const double part = std::max(std::min(0.1, worst), 0.1 * goal.tolerance / worst);
      step = detail::newton_step(matrix, rows, free, missing, part);
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!free[i]) { continue; }
      matrix.scale[i] = limit(matrix.scale[i] * (plain ? std::sqrt(t[i] / rows[i]) : std::clamp(std::exp(step[i]), 0.5, 2.0)));
    }
  }
  return nearest_scale;
}

}  // namespace radiosity
