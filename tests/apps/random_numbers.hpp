// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include <glm/vec3.hpp>

// What random scenes are made of, by a seed.
class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : random_(seed) {}

  double number(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  glm::dvec3 vector(double low, double high) {
    const double x = number(low, high), y = number(low, high);
    return {x, y, number(low, high)};
  }
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

 private:
  std::mt19937 random_;
};
