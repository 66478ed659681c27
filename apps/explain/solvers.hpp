// SPDX-License-Identifier: MIT
#pragma once

// The solvers of solve.hpp on one system, pass by pass: residual against work, and the radiosities on the way. One pass is the work of
// one application of all links. Over-shooting stands beside them: it is not among the library's solvers, for what it gains on shooting
// conjugate gradients gain without it.

#include <string>
#include <vector>

#include <radiosity/solver/transport.hpp>

namespace apps::explain {

struct Method {
  std::string name;
  std::vector<double> residual;                // relative, at the start and after each pass
  std::vector<std::vector<double>> radiosity;  // of each node at the same moments
};
struct Comparison {
  double reflectance = 0.0;  // the greatest
  std::vector<Method> methods;
  std::vector<double> solution;
};

struct System {
  radiosity::Transport& transport;
  const std::vector<double>& area;
  std::vector<double> reflectance, emission;  // one an input surface
};

inline constexpr unsigned most_passes = 40;

// `keep`: the radiosities are kept, too.
[[nodiscard]] Comparison compare_solvers(const System& system, bool keep);

}  // namespace apps::explain
