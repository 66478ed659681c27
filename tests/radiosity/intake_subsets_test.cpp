// SPDX-License-Identifier: MIT
// The intake: faces that become objects of their own, such as those with two sides, leave the rest of their surface in one piece; so does a
// face that is no valid polygon.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/vec3.hpp>

#include <radiosity/intake/intake.hpp>
#include <radiosity/intake/subset.hpp>

#include "catch.hpp"
#include "radiosity/polygon_soup.hpp"
#include "seed.hpp"

using radiosity::ChangeKind;
using soup::Soup;

namespace {

// A hilly field of 2 n * n triangles, no two of which are coplanar.
Soup hills(std::mt19937& random, int n) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Soup field;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) { field.vertex({i + 0.3 * unit(random), j + 0.3 * unit(random), unit(random)}); }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      field.face({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      field.face({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return field;
}

}  // namespace

// At a corner between them such faces have nothing but a point in common, with the others on both sides.
TEST_CASE("intake: a surface of which some faces have two sides becomes two objects, whichever faces these are") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 40; ++round) {
    Soup field = hills(random, 2 + static_cast<int>(random() % 12));
    field.materials.push_back(field.materials[0]);
    field.two_sided = {0, 0, 1};
    double two_sided = 0.0;
    for (std::size_t f = 0; f < field.count(); ++f) {
      field.material[f] = random() % 3 == 0 ? 2 : 0;
      two_sided += field.material[f] == 2 ? brep::area(field.outline(f)) : 0.0;
    }
    const radiosity::Intake taken = field.take_in();
    CAPTURE(round, field.count());
    soup::check_sound(field, taken);
    CHECK(soup::count_of(taken, ChangeKind::loose) == 0);
    CHECK(taken.objects.size() == (two_sided > 0.0 ? 2 : 1));
    CHECK(soup::measure(taken.objects).area == test::Approx(field.area() + two_sided));
  }
}

TEST_CASE("intake: faces taken out of a mesh share a vertex where an edge joins them, and only there") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  namespace intake = radiosity::intake;
  for (int round = 0; round < 30; ++round) {
    const Soup field = hills(random, 2 + static_cast<int>(random() % 8));
    intake::Working mesh;
    mesh.positions = field.positions;
    for (std::uint32_t f = 0; f < field.count(); ++f) {
      intake::Face face;
      face.corners.assign(field.corners.begin() + field.first[f], field.corners.begin() + field.first[f + 1]);
      face.polygon = f;
      mesh.faces.push_back(face);
    }
    const intake::Topology topology = intake::topology_of(mesh, false);
    intake::Subsets subsets(mesh, topology);
    for (int draw = 0; draw < 3; ++draw) {  // one draw must leave no trace for the next
      std::vector<std::uint32_t> chosen;
      for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        if (random() % 2 == 0) { chosen.push_back(f); }
      }
      std::shuffle(chosen.begin(), chosen.end(), random);
      const intake::Subset subset = subsets.of(chosen);
      REQUIRE(subset.corners.size() == chosen.size());
      std::vector<std::vector<std::uint32_t>> fan(subset.positions.size());  // by vertex: the given vertices at the other ends of its edges
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        const std::vector<std::uint32_t>& given = mesh.faces[chosen[i]].corners;
        REQUIRE(subset.corners[i].size() == given.size());
        for (std::size_t k = 0; k < given.size(); ++k) {
          CHECK(subset.positions[subset.corners[i][k]] == mesh.positions[given[k]]);
          fan[subset.corners[i][k]].push_back(given[(k + 1) % 3]);
          fan[subset.corners[i][k]].push_back(given[(k + 2) % 3]);
        }
      }
      // A fan of k triangles that are joined by edges has k - 1 inner edges, each of which is listed twice; k if it goes all around.
      for (std::vector<std::uint32_t>& ends : fan) {
        const std::size_t triangles = ends.size() / 2;
        std::sort(ends.begin(), ends.end());
        const auto distinct = static_cast<std::size_t>(std::unique(ends.begin(), ends.end()) - ends.begin());
        CHECK((distinct == triangles + 1 || (distinct == triangles && triangles > 2)));
      }
      // And faces on both sides of an edge share both of its ends.
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        for (std::uint32_t s = topology.first[chosen[i]]; s < topology.first[chosen[i] + 1]; ++s) {
          if (topology.mate[s] == intake::none) { continue; }
          const std::uint32_t other = subsets.face_of(topology.mate[s]);
          const auto place = std::find(chosen.begin(), chosen.end(), other);
          if (place == chosen.end()) { continue; }
          const std::vector<std::uint32_t>& theirs = subset.corners[static_cast<std::size_t>(place - chosen.begin())];
          CHECK(std::find(theirs.begin(), theirs.end(), subset.corners[i][s - topology.first[chosen[i]]]) != theirs.end());
        }
      }
    }
  }
}

// A runner lies a little above a floor, beyond which its pointed end reaches: the rest of it is moved onto the floor.
TEST_CASE("intake: a face that is bent when its neighbours are moved is given in triangles, and they stay in one piece") {
  const unsigned seed = test::seed();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 10; ++round) {
    Soup soup;
    soup.names = {"floor"};
    soup.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
    soup.names.push_back("runner");
    soup.materials.push_back(soup.materials[0]);
    const double z = (1.5 + 2.0 * unit(random)) * radiosity::IntakeOptions{}.weld * 6.0;
    const double step = 1.0 + 0.2 * unit(random), y = unit(random);
    const double end = 4.0 - 0.1 * step;
    for (int k = 2; k > 0; --k) {
      const double from = end - k * step, to = from + step;
      soup.polygon({{from, y, z}, {to, y, z}, {to, y + 1.0, z}, {from, y + 1.0, z}}, k == 1 ? 2 : 0);
    }
    soup.polygon({{end, y, z}, {end + 0.5 * step, y, z}, {end + step, y + 0.5, z}, {end + 0.5 * step, y + 1.0, z}, {end, y + 1.0, z}});
    const radiosity::Intake taken = soup.take_in();
    CAPTURE(round, z, step);
    soup::check_sound(soup, taken);
    CHECK(soup::count_of(taken, ChangeKind::decal_laid) > 0);
    CHECK(soup::count_of(taken, ChangeKind::unusable) == 0);
    CHECK(soup::count_of(taken, ChangeKind::loose) == 1);
    CHECK(taken.objects.size() == 5);  // floor, squares of the runner, and three triangles
    CHECK(soup::measure(taken.objects).area == test::Approx(soup.area()).epsilon(1e-6));
  }
}
