// SPDX-License-Identifier: MIT
#pragma once

// Integrates, over a convex polygon, the light that its points receive past blockers, with a reliable error bound.
//
// Adaptive bisection with 3 x 3 Gauss points, the worst element first, gives six digits if these points have met every blocker. But a
// slit or a small blocker may lie between the points of an element, whose parts then agree on a wrong value. So the function is compared
// with the elements' polynomials at fresh random points; elements that prove wrong are refined, and new points are drawn. A deviation
// that n points do not meet is, with probability 95 %, smaller than 3 / n of the whole (rule of three; Hanley and Lippman-Hand 1983); the
// points are drawn in proportion to the unoccluded light, so that is a share of that light. Elements that no blocker can change, or that
// one hides completely, need no points.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/support/draw.hpp>
#include <radiosity/support/sobol.hpp>

namespace radiosity {

// A value with its uncertainty.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

// When to stop; `tolerance` and `wanted` are in units of the integral.
struct IntegralLimits {
  double tolerance = 0.0;  // of the elements
  double wanted = 0.0;     // total error, including what the elements may have missed
  std::uint64_t most = 0;  // largest number of points
  std::uint64_t seed = 0;
};

namespace detail {

// f(x): the function; clear(x): its value without blockers; certain(corners): do blockers make no difference on that part of the polygon,
// or does one of them hide everything?
template <class Function, class Clear, class Certain>
class Integral {
 public:
  Integral(std::span<const glm::dvec3> polygon, const glm::dvec3& normal, const Function& f, const Clear& clear, const Certain& certain,
           const IntegralLimits& limits)
      : normal_{normal}, f_{&f}, clear_{&clear}, certain_{&certain}, limits_{limits} {
    for (std::size_t i = 1; i + 1 < polygon.size(); i += 2) {
      const bool last = i + 2 >= polygon.size();
      quads_.push_back({polygon[0], polygon[i], polygon[i + 1], last ? polygon[i + 1] : polygon[i + 2]});
    }
  }

  [[nodiscard]] Estimate run(std::uint64_t& asked) {
    constexpr int start = 4;  // fine enough that most shadows meet a Gauss point
    for (std::size_t quad = 0; quad < quads_.size(); ++quad) {
      for (int i = 0; i < start * start; ++i) { add(quad, (i % start) / 4.0, (i / start) / 4.0, 1.0 / start); }
    }
    refine();
    Estimate result = compare(0);
    for (std::uint32_t round = 1; wrong_ && round < 4 && asked_ < limits_.most; ++round) {
      std::make_heap(elements_.begin(), elements_.end(), less_wrong);
      refine();
      result = compare(round);
    }
    asked += asked_;
    return result;
  }

 private:
  struct Quad {
    glm::dvec3 a, b, c, d;

    [[nodiscard]] glm::dvec3 at(double u, double v) const { return (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * d + u * c); }
    [[nodiscard]] double area_element(double u, double v, const glm::dvec3& normal) const {
      return glm::dot(glm::cross((1.0 - v) * (b - a) + v * (c - d), (1.0 - u) * (d - a) + u * (c - b)), normal);
    }
  };
  using Samples = std::array<double, 9>;
  // The part [u, u + size] x [v, v + size] of a quadrilateral, with the values at the Gauss points of its quarters.
  struct Element {
    std::size_t quad;
    double u, v, size;
    std::array<Samples, 4> quarter;
    double value, error;
    std::int8_t certain;  // -1: not determined yet
  };

  [[nodiscard]] double gauss(std::size_t quad, double u0, double v0, double size, Samples& samples) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const double u = u0 + size * gauss3_x[i];
        const double v = v0 + size * gauss3_x[j];
        samples[3 * i + j] = (*f_)(quads_[quad].at(u, v));
        sum += gauss3_w[i] * gauss3_w[j] * quads_[quad].area_element(u, v, normal_) * samples[3 * i + j];
      }
    }
    asked_ += 9;
    return sum * size * size;
  }
  void add(std::size_t quad, double u, double v, double size) {
    Samples own{};
    const double whole = gauss(quad, u, v, size, own);
    Element e{quad, u, v, size, {}, 0.0, 0.0, -1};
    const double half = 0.5 * size;
    for (std::size_t k = 0; k < 4; ++k) { e.value += gauss(quad, u + (k & 1 ? half : 0.0), v + (k & 2 ? half : 0.0), half, e.quarter[k]); }
    e.error = std::abs(e.value - whole);
    error_ += e.error;
    elements_.push_back(e);
    std::push_heap(elements_.begin(), elements_.end(), less_wrong);
  }
  [[nodiscard]] static bool less_wrong(const Element& x, const Element& y) { return x.error < y.error; }

  void refine() {
    error_ = 0.0;
    for (const Element& e : elements_) { error_ += e.error; }
    while (error_ > limits_.tolerance && asked_ < limits_.most) {
      std::pop_heap(elements_.begin(), elements_.end(), less_wrong);
      const Element e = elements_.back();
      elements_.pop_back();
      error_ -= e.error;
      const double half = 0.5 * e.size;
      for (std::size_t k = 0; k < 4; ++k) { add(e.quad, e.u + (k & 1 ? half : 0.0), e.v + (k & 2 ? half : 0.0), half); }
    }
  }

  [[nodiscard]] Quad corners(const Element& e) const {
    const Quad& quad = quads_[e.quad];
    return {quad.at(e.u, e.v), quad.at(e.u + e.size, e.v), quad.at(e.u + e.size, e.v + e.size), quad.at(e.u, e.v + e.size)};
  }
  // The polynomial through the samples of the quarter that contains (s, t) in [0, 1]^2 of the element.
  [[nodiscard]] static double interpolated(const Element& e, double s, double t) {
    const std::size_t right = s >= 0.5;
    const std::size_t upper = t >= 0.5;
    const auto weights = [](double x) {
      constexpr auto& g = gauss3_x;
      return std::array<double, 3>{(x - g[1]) * (x - g[2]) / ((g[0] - g[1]) * (g[0] - g[2])),
                                   (x - g[0]) * (x - g[2]) / ((g[1] - g[0]) * (g[1] - g[2])),
                                   (x - g[0]) * (x - g[1]) / ((g[2] - g[0]) * (g[2] - g[1]))};
    };
    const auto ws = weights(2.0 * s - static_cast<double>(right));
    const auto wt = weights(2.0 * t - static_cast<double>(upper));
    double sum = 0.0;
    for (std::size_t i = 0; i < 9; ++i) { sum += ws[i / 3] * wt[i % 3] * e.quarter[right + 2 * upper][i]; }
    return sum;
  }

  // Compares the elements with fresh points, whose number depends on how much light blockers could hide. Elements that are off by more
  // than a fiftieth of the wanted error are marked for refinement.
  [[nodiscard]] Estimate compare(std::uint32_t round) {
    Estimate result;
    std::vector<double> cumulative;  // unoccluded light of the elements that are not certain
    std::vector<double> unblocked;
    double light = 0.0;
    for (Element& e : elements_) {
      result.value += e.value;
      result.error += e.error;
      const Quad part = corners(e);
      if (e.certain < 0) { e.certain = (*certain_)(std::array<glm::dvec3, 4>{part.a, part.b, part.c, part.d}) ? 1 : 0; }
      unblocked.push_back(e.certain > 0 ? 0.0 : (*clear_)(part.at(0.5, 0.5)));
      light += unblocked.back() * part.area_element(0.5, 0.5, normal_);
      cumulative.push_back(light);
    }
    wrong_ = false;
    if (!(light > 0.0)) { return result; }
    // About half of the points are rejected below, and the remaining uncertainty is to be half of the wanted error.
    const auto points = static_cast<std::uint32_t>(std::clamp(13.0 * light / limits_.wanted, 128.0, static_cast<double>(limits_.most)));
    const Sobol4 sequence{limits_.seed, round};
    double met = 0.0;
    double sum = 0.0;
    double square = 0.0;
    for (std::uint32_t i = 0; i < points; ++i) {
      const std::array<double, 4> x = sequence(i);
      const std::size_t k = drawn_index(cumulative, x[0] * light);
      Element& e = elements_[k];
      const Quad part = corners(e);
      const double area = part.area_element(0.5, 0.5, normal_);
      // Rejection sampling, uniform by area: the area element is linear and at most twice its mean.
      if (!(unblocked[k] > 0.0) || 2.0 * area * x[3] > part.area_element(x[1], x[2], normal_)) { continue; }
      const double difference = (*f_)(part.at(x[1], x[2])) - interpolated(e, x[1], x[2]);
      const double share = difference * light / unblocked[k];
      met += 1.0;
      sum += share;
      square += share * share;
      if (std::abs(difference) * area > 0.02 * limits_.wanted) {
        e.error = std::max(e.error, std::abs(difference) * area);
        wrong_ = true;
      }
    }
    asked_ += static_cast<std::uint64_t>(met);
    if (!(met > 1.0)) { return {result.value, result.error + light}; }
    const double mean = sum / met;
    const double spread = std::sqrt(std::max(0.0, square / met - mean * mean) / (met - 1.0));
    if (wrong_) { result.value += mean; }  // unbiased, because these points did not influence the elements
    result.error += (wrong_ ? 0.0 : std::abs(mean)) + 2.0 * spread + 3.0 * light / met;
    return result;
  }

  glm::dvec3 normal_;
  const Function* f_;
  const Clear* clear_;
  const Certain* certain_;
  IntegralLimits limits_;
  std::vector<Quad> quads_;
  std::vector<Element> elements_;
  std::uint64_t asked_ = 0;
  double error_ = 0.0;
  bool wrong_ = false;
};

}  // namespace detail

}  // namespace radiosity
