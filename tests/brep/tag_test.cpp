// SPDX-License-Identifier: MIT
// Tags: eight independent marks and a level, on faces and vertices, and on one kind alone.

#include <brep/tag.hpp>

#include "shapes.hpp"

using namespace brep;

TEST_CASE("marks are independent: each of the 256 combinations is what was set, and the level is left alone") {
  for (unsigned set = 0; set < 256; ++set) {
    Tag tag;
    tag.level = 9;
    for (unsigned i = 0; i < 8; ++i) {
      tag.mark(i);
      if ((set >> i & 1u) == 0) tag.unmark(i);
    }
    for (unsigned i = 0; i < 8; ++i) CHECK(tag.marked(i) == ((set >> i & 1u) != 0));
    CHECK((tag.marks == set && tag.level == 9));
  }
  CHECK(sizeof(Tag) == 2);
}

TEST_CASE("clear_mark takes one named mark from every face and vertex and nothing else; reset_tags takes all") {
  enum class Mark { visited, lit = 5 };
  auto m = shapes::build(shapes::cube_builder());
  for (FaceId f : faces(m)) {
    m.data(f).mark(Mark::visited);
    m.data(f).mark(Mark::lit);
    m.data(f).level = 3;
  }
  for (VertexId v : vertices(m)) m.data(v).mark(Mark::visited);
  m.data(VertexId{4}).mark(Mark::lit);
  clear_mark(m, Mark::visited);
  for (FaceId f : faces(m)) {
    CHECK((!m.data(f).marked(Mark::visited) && m.data(f).marked(Mark::lit) && m.data(f).marked(5)));
    CHECK((m.data(f).level == 3 && m.data(f).sheet == f.index));
  }
  for (VertexId v : vertices(m)) CHECK((!m.data(v).marked(Mark::visited) && m.data(v).marked(Mark::lit) == (v.index == 4)));
  const glm::dvec3 place = m.data(VertexId{7}).position;
  reset_tags(m);
  for (FaceId f : faces(m)) CHECK((m.data(f).marks == 0 && m.data(f).level == 0 && m.data(f).sheet == f.index));
  for (VertexId v : vertices(m)) CHECK(m.data(v).marks == 0);
  CHECK(m.data(VertexId{7}).position == place);
}

TEST_CASE("a BRep where faces alone are tagged, and one where nothing is") {
  auto m = shapes::build<BRep<NoData, NoData, shapes::Face>>(shapes::cube_builder());
  for (FaceId f : faces(m)) m.data(f).mark(2);
  clear_mark(m, 2);
  for (FaceId f : faces(m)) CHECK(m.data(f).marks == 0);
  auto bare = shapes::build<BRep<>>(shapes::cube_builder());
  reset_tags(bare);
  CHECK(shapes::faults(bare) == "");
}
