// SPDX-License-Identifier: MIT
// Composite operators one after another, in any order, on random maps.

#include <brep/edit.hpp>
#include <brep/euler_log.hpp>
#include <brep/extrude.hpp>
#include <brep/glue.hpp>
#include <brep/shells.hpp>
#include <brep/triangulate.hpp>

#include "calls.hpp"
#include "shapes.hpp"

using namespace brep;
using shapes::faults;
using shapes::Random;
using shapes::records;
using Logged = BRep<NoData, NoData, NoData, EulerLog>;

TEST_CASE("random sequences of composite operators: every state valid, refusals change nothing, the log takes all back") {
  std::size_t states = 0, refused = 0;
  long most_handles = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    Logged m = calls::random_map<Logged>(random, 20);
    const auto start = records(m);
    const std::size_t first = mark(m);
    for (int step = 0; step < 150; ++step) {
      const auto all = shapes::all_halfedges(m);
      if (all.empty()) { break; }
      const HalfedgeId a = all[random.below(all.size())], c = all[random.below(all.size())];
      const auto before = records(m);
      const long handles = genus(m);
      const std::size_t shells = shell_count(m);
      bool done = false;
      const std::uint32_t which = m.edge_count() < 150 ? random.below(7) : random.below(3);
      switch (which) {
        case 0:
          done = collapse_edge(m, a).has_value();
          break;
        case 1:
          done = glue_faces(m, a, c).has_value();
          break;
        case 2:
          done = flip_edge(m, a).has_value();
          break;
        case 3:
          done = extrude_face(m, m.face(a)).has_value();
          break;
        case 4:
          done = poke_face(m, m.face(a)).has_value();
          break;
        case 5:
          done = punch_hole(m, a, c).has_value();
          break;
        default:
          done = triangulate_face(m, m.face(a)).has_value();
          break;
      }
      if (!done) {
        ++refused;
        REQUIRE(records(m) == before);
        continue;
      }
      ++states;
      REQUIRE(faults(m) == "");
      if (which != 1 && which != 5) { REQUIRE((genus(m) == handles && shell_count(m) == shells)); }
      REQUIRE(genus(m) >= 0);
      most_handles = std::max(most_handles, genus(m));
    }
    REQUIRE(undo_to(m, first));
    REQUIRE(records(m) == start);
  }
  CHECK(states > 2000);
  CHECK(refused > 500);
  CHECK(most_handles > 3);
}
