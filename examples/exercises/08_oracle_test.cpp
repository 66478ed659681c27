// SPDX-License-Identifier: MIT
// Tests exercise 8: by default as it stands here, else the file that EXERCISE names.
#include <cmath>

#include <raycast/objects/box.hpp>
#include <raycast/objects/polygon.hpp>

#include <radiosity/radiosity.hpp>

#include "check.hpp"

#ifndef EXERCISE
#define EXERCISE "08_oracle.hpp"
#endif
#include EXERCISE

static_assert(radiosity::Oracle<OracleOfMine>);

int main() {
  radiosity::Scene scene;
  scene.materials = {{"lamp", {0.0, 0.0, 0.0}, {10.0, 10.0, 10.0}}, {"wall", {0.7, 0.7, 0.7}, {0.0, 0.0, 0.0}}};
  const auto room = raycast::BoxObject::make({0, 0, 0}, {4, 3, 2.5});
  const auto lamp = raycast::Polygon::make({{1.5, 1, 2.4}, {1.5, 2, 2.4}, {2.5, 2, 2.4}, {2.5, 1, 2.4}});
  scene.objects = {{"room", room.object, {}, {1}}, {"lamp", lamp.object, {}, {0}}};
  scene.objects[0].placement.inside = true;
  radiosity::Options options;
  options.min_area = 2.5e-4;
  options.light_epsilon = 1e9;  // the light oracle never objects
  options.audit_points = 500;
  bool promise = true;
  options.oracle = [&promise](const radiosity::Question& question) {
    const radiosity::Decision first = OracleOfMine{}(question);
    if (OracleOfMine{}(question) != first) { promise = false; }
    return first;
  };
  options.threads = 1;
  const radiosity::Outcome outcome = radiosity::solve(scene, options);
  check(promise, "the same question has two answers");
  check(outcome.solution.has_value(), "the run ends without a solution; does the oracle ever say link?");
  const radiosity::Audit& audit = outcome.solution->audit;
  const double error = audit.estimated_error.value_or(1.0);
  check(audit.links <= 20000, std::to_string(audit.links) + " links are too many: it splits what could be linked");
  check(error <= 0.08, "estimated error " + std::to_string(std::lround(100.0 * error)) + " %: it links what is too near or too large");
  return solved("exercise 8");
}
