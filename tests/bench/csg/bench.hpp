// SPDX-License-Identifier: MIT
#pragma once

// Boolean operations of halflight and of CGAL on the same operands. A case is a fold: the first operand, then one operation with each of
// the others in turn, as a program does that subtracts one bar after the other. Only the operations are timed; an engine says apart
// what it takes besides to bring the operands in and the result out.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bench {

struct Polygons {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::vector<std::uint32_t>> faces;  // convex, counter-clockwise from outside
};

Polygons octasphere(std::uint32_t splits);  // 8 splits^2 triangles, radius 1
Polygons box(const std::array<double, 3>& lo, const std::array<double, 3>& hi);
Polygons moved(Polygons polygons, double x, double y, double z);

enum class Operation { unite, intersect, subtract };

struct Case {
  std::string name;
  Operation operation;
  std::vector<Polygons> operands;
  double volume;                                             // of the result
  std::optional<double> manifold, cgal_exact, cgal_inexact;  // CPU milliseconds, measured once on another day (README.md)
};

std::vector<Case> cases(bool all);

struct Outcome {
  double seconds = 0.0;     // of the operations
  double in_and_out = 0.0;  // seconds of the rest
  double volume = 0.0;
  std::size_t faces = 0, vertices = 0;
  bool failed = false;
};

class Engine {
 public:
  virtual ~Engine() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  // Nothing when the engine is known not to live through the case.
  virtual std::optional<Outcome> run(const Case& c) = 0;
};

double thread_seconds();

std::unique_ptr<Engine> halflight_engine();
std::unique_ptr<Engine> cgal_exact_engine();
std::unique_ptr<Engine> cgal_inexact_engine();

}  // namespace bench
