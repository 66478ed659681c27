// SPDX-License-Identifier: MIT
// Lamps that are sunk into walls without a thickness: a part of each shines at nothing.

#include <cmath>
#include <cstddef>

#include <radiosity/intake/intake.hpp>
#include <radiosity/radiosity.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"

using soup::Soup;

namespace {

// A room of walls without a thickness, and lamps half in two of them.
Soup room_of_sunk_lamps() {
  Soup soup;
  soup.names = {"room", "lamp"};
  Soup box;
  soup::add_box(box, {0, 0, 0}, {3, 8, 2.6}, 1, true);
  for (std::size_t f = 0; f < box.count(); ++f) {
    soup.polygon(box.outline(f));
    soup.group.back() = 0;
  }
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 middle{k % 2 == 0 ? 0.0 : 3.0, 1.0 + 2.0 * (k / 2), 2.0};
    soup::add_box(soup, middle - glm::dvec3(0.08, 0.4, 0.1), middle + glm::dvec3(0.08, 0.4, 0.1), 1, false, 1);
  }
  return soup;
}

}  // namespace

TEST_CASE("lamps in clusters that reach out of a room give it as much light as one by one", "[accuracy]") {
  const Soup soup = room_of_sunk_lamps();
  const radiosity::Intake taken = soup.take_in();
  const auto light_on_walls = [&](radiosity::Solver solver, radiosity::Indirect indirect) {
    const radiosity::Options options{.epsilon = 0.01, .indirect = indirect, .solver = solver, .audit_points = 0};
    const radiosity::Outcome outcome = radiosity::solve({soup.materials, taken.objects}, options);
    REQUIRE(outcome.solution);
    CHECK((outcome.solution->audit.clusters > 0) == (indirect == radiosity::Indirect::rays));
    double sum = 0.0;
    for (const radiosity::SurfaceMean& s : outcome.solution->audit.surfaces) {
      sum += s.name.starts_with("room") ? s.area * s.radiosity.x : 0.0;
    }
    return sum;
  };
  const double one_by_one = light_on_walls(radiosity::Solver::gauss_seidel, radiosity::Indirect::links);
  const double in_clusters = light_on_walls(radiosity::Solver::conjugate_gradients, radiosity::Indirect::rays);
  CHECK(std::abs(in_clusters / one_by_one - 1.0) < 0.02);  // .0005 has been seen; rows that sum to 1 made it .11
}
