// SPDX-License-Identifier: MIT

// Laws of symmetric scaling: the row sums are met, the scale is the one that the plain iteration finds, few products suffice whatever the
// eigenvalues are, and a goal that no scale meets ends.

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <radiosity/solver/balance.hpp>

#include "../catch.hpp"
#include "seed.hpp"

namespace {

// A symmetric matrix, row by row.
struct Matrix {
  explicit Matrix(std::size_t size) : n{size}, entry(size * size, 0.0) {}
  double& at(std::size_t i, std::size_t j) { return entry[i * n + j]; }

  void operator()(const std::vector<double>& x, std::vector<double>& y) {
    ++products;
    y.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) { y[i] += entry[i * n + j] * x[j]; }
    }
  }
  [[nodiscard]] double worst(const std::vector<double>& scale, const std::vector<double>& t) {
    std::vector<double> rows;
    (*this)(scale, rows);
    double most = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      if (t[i] > 0.0) { most = std::max(most, std::abs(scale[i] * rows[i] / t[i] - 1.0)); }
    }
    return most;
  }

  std::size_t n;
  std::vector<double> entry;
  int products = 0;
};

std::vector<double> balanced(Matrix& matrix, const std::vector<double>& t, const radiosity::Balance& goal) {
  matrix.products = 0;
  return radiosity::balance([&](const std::vector<double>& x, std::vector<double>& y) { matrix(x, y); }, t, goal);
}

}  // namespace

TEST_CASE("row sums are met, by the scale of the plain iteration") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<> unit;
  for (int round = 0; round < 50; ++round) {
    Matrix matrix{2 + random() % 30};
    std::vector<double> t(matrix.n);
    for (std::size_t i = 0; i < matrix.n; ++i) {
      t[i] = 0.1 + unit(random);
      for (std::size_t j = 0; j < i; ++j) { matrix.at(i, j) = matrix.at(j, i) = unit(random) < 0.3 ? unit(random) : 0.0; }
      matrix.at(i, i) = 0.2 + unit(random);  // so that a scale exists
    }
    const std::vector<double> scale = balanced(matrix, t, {.tolerance = 1e-12});
    CHECK(matrix.products < 150);
    CHECK(matrix.worst(scale, t) < 2e-12);
    std::vector<double> plain(matrix.n, 1.0);
    std::vector<double> rows;
    for (int step = 0; step < 20000 && matrix.worst(plain, t) > 1e-12; ++step) {
      matrix(plain, rows);
      for (std::size_t i = 0; i < matrix.n; ++i) { plain[i] *= std::sqrt(t[i] / (plain[i] * rows[i])); }
    }
    for (std::size_t i = 0; i < matrix.n; ++i) { CHECK(scale[i] == test::Approx(plain[i]).epsilon(1e-8)); }
  }
}

TEST_CASE("two sides that light hardly anything but each other are balanced in few products") {
  for (const double within : {1e-1, 1e-3, 1e-6}) {
    Matrix matrix{20};
    for (std::size_t i = 0; i < 20; ++i) {
      for (std::size_t j = 0; j < 20; ++j) {
        matrix.at(i, j) = (i < 10) == (j < 10) ? within : 1.0 + 0.1 * std::cos(static_cast<double>(i * j));
      }
    }
    const std::vector<double> t(20, 1.0);
    const std::vector<double> scale = balanced(matrix, t, {.tolerance = 1e-10});
    CHECK(matrix.products < 100);  // the plain iteration: some 10 / within
    CHECK(matrix.worst(scale, t) < 2e-10);
  }
}

TEST_CASE("a goal that no scale meets ends, with scales within their limits") {
  Matrix matrix{2};
  matrix.at(0, 1) = matrix.at(1, 0) = 1.0;  // both rows sum up to the same power
  for (const double scale : balanced(matrix, {1.0, 2.0}, {{0.25, 4.0}, 1e-12})) {
    CHECK(scale >= 0.25);
    CHECK(scale <= 4.0);
  }
  CHECK(matrix.products <= 401);
}

TEST_CASE("rows that want nothing, or receive nothing, keep their scale") {
  Matrix matrix{3};
  matrix.at(0, 0) = 4.0;
  matrix.at(1, 1) = 1.0;
  const std::vector<double> scale = balanced(matrix, {1.0, 0.0, 1.0}, {.tolerance = 1e-12});
  CHECK(scale[0] == test::Approx(0.5));
  CHECK(scale[1] == 1.0);
  CHECK(scale[2] == 1.0);
}

TEST_CASE("row sums end no further from the goal than they began, also where no scale within the limits meets it") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<> unit;
  for (int round = 0; round < 200; ++round) {
    // Patches of two sides that see only each other, with areas over six decades: the system of the linear step is singular, and the two
    // sides' sums differ. Some entries are slightly negative, as links with gradients are.
    Matrix matrix{4 + random() % 40};
    const std::size_t half = matrix.n / 2;
    for (std::size_t i = 0; i < half; ++i) {
      for (std::size_t j = half; j < matrix.n; ++j) {
        if (unit(random) < 0.3) { matrix.at(i, j) = matrix.at(j, i) = std::pow(10.0, -6.0 * unit(random)) * (unit(random) - 0.02); }
      }
    }
    const std::vector<double> ones(matrix.n, 1.0);
    std::vector<double> rows;
    matrix(ones, rows);
    std::vector<double> t(matrix.n, 0.0);
    for (std::size_t i = 0; i < matrix.n; ++i) { t[i] = unit(random) < 0.9 ? std::max(0.0, rows[i]) * (0.9 + 0.2 * unit(random)) : 0.0; }
    const auto off = [&](const std::vector<double>& scale) {
      matrix(scale, rows);
      double sum = 0.0;
      for (std::size_t i = 0; i < matrix.n; ++i) {
        const double row = scale[i] * rows[i];
        if (t[i] > 0.0) { sum += (row - t[i]) * (row - t[i]) / std::max(row, t[i]); }
      }
      return sum;
    };
    const double before = off(ones);
    CHECK(off(balanced(matrix, t, {{0.25, 4.0}, 1e-6})) <= before * (1.0 + 1e-12) + 1e-300);
  }
}

TEST_CASE("pairs of patches that see hardly anything but each other do not take all products") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<> unit;
  int products = 0;
  constexpr int rounds = 40;
  for (int round = 0; round < rounds; ++round) {
    // The two patches of a pair want sums that differ by up to two fifths, more than a thousandth of their light from others can make up
    // for within the limits. By measurement some 90 products suffice to come as near as 400.
    Matrix matrix{100};
    for (std::size_t i = 0; i < matrix.n; ++i) {
      for (std::size_t j = 0; j < i; ++j) { matrix.at(i, j) = matrix.at(j, i) = unit(random) < 0.1 ? 1e-3 * unit(random) : 0.0; }
    }
    for (std::size_t i = 0; i < matrix.n; i += 2) { matrix.at(i, i + 1) = matrix.at(i + 1, i) = std::pow(10.0, -3.0 * unit(random)); }
    std::vector<double> t;
    matrix(std::vector<double>(matrix.n, 1.0), t);
    for (double& wanted : t) { wanted *= 0.8 + 0.4 * unit(random); }
    static_cast<void>(balanced(matrix, t, {{1.0 / 4000.0, 4.0}, 1e-6}));
    products += matrix.products;
  }
  CHECK(products < 130 * rounds);
}

TEST_CASE("the goal is met, and not much more than that, because products are dear") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<> unit;
  double decades = 0.0;  // by which the goal is exceeded
  constexpr int rounds = 200;
  for (int round = 0; round < rounds; ++round) {
    Matrix matrix{60};
    for (std::size_t i = 0; i < matrix.n; ++i) {
      for (std::size_t j = 0; j < i; ++j) { matrix.at(i, j) = matrix.at(j, i) = unit(random) < 0.1 ? 0.1 * unit(random) : 0.0; }
      matrix.at(i, i) = 0.1 + 0.1 * unit(random);  // so that a scale exists
    }
    for (std::size_t i = 0; i < matrix.n; i += 2) { matrix.at(i, i + 1) = matrix.at(i + 1, i) = std::pow(10.0, -unit(random)); }
    std::vector<double> t;
    matrix(std::vector<double>(matrix.n, 1.0), t);
    for (double& wanted : t) { wanted *= 0.9 + 0.2 * unit(random); }
    const double tolerance = std::pow(10.0, -3.0 - 6.0 * unit(random));
    const double worst = matrix.worst(balanced(matrix, t, {.tolerance = tolerance}), t);
    CHECK(worst < 1.001 * tolerance);
    decades += std::log10(tolerance / std::max(worst, 1e-16));
  }
  CHECK(decades < 2.0 * rounds);
}
