// SPDX-License-Identifier: MIT

// How small a patch becomes for the form factor of a pair.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/visibility/occlusion.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"

TEST_CASE("least area: form factors leave no part below min_area, and link what is too near when no quarter may be smaller") {
  const std::uint64_t seed = test::seed();
  CAPTURE(seed);
  std::mt19937_64 random{seed};
  const auto log_between = [&](double a, double b) { return a * std::pow(b / a, std::uniform_real_distribution<double>{}(random)); };
  const radiosity::Scene scene = scenes::room_with_box();
  for (int k = 0; k < 5; ++k) {
    radiosity::Options options{.epsilon = log_between(0.02, 0.2), .min_area = log_between(1e-4, 1e-2)};
    options.light_epsilon = 1e6;  // the light of lamps asks for nothing
    options.indirect = radiosity::Indirect::links;
    options.audit_points = 0;
    CAPTURE(options.epsilon, options.min_area);
    radiosity::detail::Run run{scene, options, {}, {}};
    for (const auto next : {radiosity::stage::build, radiosity::stage::refine}) { REQUIRE_FALSE(next(run)); }

    const radiosity::Hierarchy& nodes = run.scene.hierarchy;
    double total = 0.0, smallest_root = 1e300;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!radiosity::is_input_face(nodes, i)) { continue; }
      total += nodes[i].area;
      smallest_root = std::min(smallest_root, nodes[i].area);
    }
    constexpr double rounding = 1e-9;
    const double least = options.min_area * total;
    double smallest = 1e300;
    for (const radiosity::Node& node : nodes) { smallest = std::min(smallest, node.area); }
    // Part of the total may be buried, so this bound is the larger one.
    CHECK(smallest >= std::min(smallest_root, 0.5 * least) * (1.0 - rounding));
    std::size_t near = 0;
    for (const radiosity::NodePair& pair : run.refined.linked) {
      const radiosity::Node &p = nodes[pair.p], &q = nodes[pair.q];
      if (!(radiosity::form_factor_estimate(p, q) > options.epsilon * (1.0 + rounding))) { continue; }
      ++near;
      CHECK(std::max(p.area, q.area) <= 4.0 * least * (1.0 + rounding));
    }
    CAPTURE(near);
    CHECK(!run.refined.linked.empty());
  }
}
