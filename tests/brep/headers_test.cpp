// SPDX-License-Identifier: MIT
// Every header of brep/ goes with every other one: here are all of them in one file, and no name hides that of another.

#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/circulators.hpp>
#include <brep/conditions.hpp>
#include <brep/csg/csg.hpp>
#include <brep/diagnosis.hpp>
#include <brep/dual.hpp>
#include <brep/edge_uses.hpp>
#include <brep/edit.hpp>
#include <brep/euler.hpp>
#include <brep/euler_log.hpp>
#include <brep/euler_script.hpp>
#include <brep/euler_script_parse.hpp>
#include <brep/euler_script_run.hpp>
#include <brep/euler_script_text.hpp>
#include <brep/euler_script_words.hpp>
#include <brep/euler_table.hpp>
#include <brep/extrude.hpp>
#include <brep/geometry.hpp>
#include <brep/glue.hpp>
#include <brep/handles.hpp>
#include <brep/inherit.hpp>
#include <brep/isomorphism.hpp>
#include <brep/neighbours.hpp>
#include <brep/outline.hpp>
#include <brep/polygon.hpp>
#include <brep/pool.hpp>
#include <brep/proportion.hpp>
#include <brep/range.hpp>
#include <brep/refine.hpp>
#include <brep/repair.hpp>
#include <brep/replay.hpp>
#include <brep/result.hpp>
#include <brep/shells.hpp>
#include <brep/small_list.hpp>
#include <brep/split.hpp>
#include <brep/split_objects.hpp>
#include <brep/split_plane.hpp>
#include <brep/statistics.hpp>
#include <brep/step.hpp>
#include <brep/surgery.hpp>
#include <brep/t_vertices.hpp>
#include <brep/tag.hpp>
#include <brep/testing.hpp>
#include <brep/triangulate.hpp>
#include <brep/unchecked.hpp>
#include <brep/validate.hpp>
#include <brep/validate_constraints.hpp>
#include <brep/validate_explain.hpp>

#include "shapes.hpp"

using namespace brep;

TEST_CASE("a BRep from the builder can be compared by the matchers where every header is included") {
  const auto cube = close<shapes::Mesh>(shapes::cube_builder());
  const auto bare = close<BRep<>>(shapes::cube_builder());
  REQUIRE((cube.brep && bare.brep));
  CHECK_THAT(*cube.brep, IsIsomorphicTo(*bare.brep));
  const auto octahedron = dual(*cube.brep);
  CHECK_THAT(*cube.brep, !IsIsomorphicTo(octahedron.brep));
}
