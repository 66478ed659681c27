// SPDX-License-Identifier: MIT
// Handles, paged pools, and what the BRep promises about memory.

#include <brep/euler.hpp>
#include <brep/pool.hpp>
#include <brep/small_list.hpp>

#include <memory>
#include <unordered_set>

#include "shapes.hpp"

using namespace brep;

std::size_t allocation_count();  // allocation_count.cpp

TEST_CASE("handles print as letter and index, compare, hash, and know their twin and edge") {
  CHECK(to_string(VertexId{3}) == "v3");
  CHECK(to_string(HalfedgeId{7}) == "h7");
  CHECK(to_string(EdgeId{3}) == "e3");
  CHECK(to_string(FaceId{1}) == "f1");
  CHECK(to_string(FaceId{}) == "f?");
  CHECK(to_string(Element(FaceId{1})) == "f1");
  CHECK_FALSE(VertexId{}.valid());
  CHECK(twin(HalfedgeId{6}) == HalfedgeId{7});
  CHECK(twin(HalfedgeId{7}) == HalfedgeId{6});
  CHECK(edge(HalfedgeId{7}) == EdgeId{3});
  CHECK(halfedge(EdgeId{3}) == HalfedgeId{6});
  CHECK(VertexId{1} < VertexId{2});
  CHECK(std::unordered_set<FaceId>{FaceId{1}, FaceId{1}, FaceId{2}}.size() == 2);
  static_assert(!std::is_same_v<VertexId, FaceId> && sizeof(VertexId) == 4);
}

TEST_CASE("empty attribute types cost nothing: 16 bytes a half-edge, 4 a vertex, 4 a face") {
  static_assert(sizeof(detail::HalfedgeRecord) == 16 && sizeof(detail::AnchorRecord) == 4);
  static_assert(sizeof(BRep<>) == 3 * sizeof(Pool<detail::AnchorRecord, NoData>));
  BRep<> m;
  CHECK(m.bytes() == 0);
  for (int i = 0; i < 10000; ++i) { REQUIRE(make_segment(m)); }
  CHECK(m.bytes() >= 10000 * (2 * 16 + 2 * 4 + 4));
  CHECK(m.bytes() <= 11250 * (2 * 16 + 2 * 4 + 4));  // growth by an eighth
}

TEST_CASE("slots are reused last in first out, with default data") {
  Pool<detail::AnchorRecord, int> pool;
  for (std::uint32_t i = 0; i < 5; ++i) {
    CHECK(pool.allocate() == i);
    CHECK(pool.data(i) == 0);
    pool.data(i) = 7;
  }
  pool.release(1);
  pool.release(3);
  CHECK_FALSE(pool.alive(3));
  CHECK_FALSE(pool.alive(5));
  CHECK(pool.count() == 3);
  CHECK(pool.next_allocated() == 3);
  CHECK(pool.allocate() == 3);
  CHECK(pool.data(3) == 0);
  CHECK(pool.allocate() == 1);
  CHECK(pool.allocate() == 5);
  CHECK((pool.data(0) == 7 && pool.data(5) == 0));
}

TEST_CASE("data never move: a reference to data stays valid while the BRep grows") {
  struct Data {
    int value = 0;
  };
  BRep<Data, Data, Data> m;
  const HalfedgeId h = *make_segment(m);
  Data* const vertex = &m.data(m.vertex(h));
  Data* const half = &m.data(h);
  Data* const face = &m.data(m.face(h));
  vertex->value = 1, half->value = 2, face->value = 3;
  for (int i = 0; i < 20000; ++i) {
    const HalfedgeId n = *split_edge(m, h);
    if (i % 2 == 0) { REQUIRE(split_face(m, n, m.next(n))); }
  }
  CHECK((vertex == &m.data(m.vertex(h)) && half == &m.data(h) && face == &m.data(m.face(h))));
  CHECK((vertex->value == 1 && half->value == 2 && face->value == 3));
}

TEST_CASE("in steady state no operator allocates, and no refusal does") {
  auto m = shapes::build(shapes::cube_builder());
  const HalfedgeId a = m.halfedge(FaceId{0}), b = m.next(m.next(a)), other = m.halfedge(FaceId{1});
  const auto cycle = [&] {
    const auto h = split_face(m, a, b);
    const auto n = split_edge(m, *h);
    const auto w = split_vertex(m, a, a);
    bool good = h && n && w && join_vertices(m, *w) && join_vertices(m, twin(*n)) && join_faces(m, *h);
    good = good && !split_face(m, a, other) && !split_vertex(m, a, b) && !kill_segment(m, a) && !join_faces(m, HalfedgeId{});
    const auto s = make_segment(m);
    return good && s && kill_segment(m, *s);
  };
  CHECK(cycle());
  const std::size_t before = allocation_count(), bytes = m.bytes();  // the topology grows by realloc, which is not counted
  bool good = true;
  for (int i = 0; i < 1000; ++i) { good = cycle() && good; }
  const std::size_t after = allocation_count();
  CHECK(good);
  CHECK((after == before && m.bytes() == bytes));
}

TEST_CASE("a BRep can be copied and moved, the moved-from one is empty and usable") {
  struct Data {
    std::vector<int> list;
  };
  using M = BRep<Data, Data, Data>;
  M m;
  const HalfedgeId h = *make_segment(m);
  const HalfedgeId n = *split_edge(m, h);
  REQUIRE(join_vertices(m, twin(n)));  // a free slot travels along
  m.data(h).list = {1, 2};
  m.data(m.face(h)).list = {3};
  M copy = m;
  copy.data(h).list.push_back(3);
  CHECK(m.data(h).list.size() == 2);
  CHECK(shapes::records(copy) == shapes::records(m));
  const auto before = shapes::records(m);
  M moved = std::move(m);
  CHECK(shapes::records(moved) == before);
  CHECK((m.edge_count() == 0 && m.vertex_end() == 0 && shapes::faults(m) == ""));  // NOLINT: moved from on purpose
  REQUIRE(make_segment(m));
  CHECK(shapes::faults(m) == "");
  m = std::move(moved);
  CHECK(shapes::records(m) == before);
  CHECK(*split_edge(m, h) == n);  // the free list came along
  copy = m;
  CHECK(shapes::records(copy) == shapes::records(m));
}

TEST_CASE("data of killed elements let go of what they own at once") {
  struct Data {
    std::shared_ptr<int> owned;
  };
  BRep<Data, Data, Data> m;
  const auto token = std::make_shared<int>(1);
  const HalfedgeId h = *make_segment(m);
  m.data(h).owned = m.data(m.vertex(h)).owned = m.data(m.face(h)).owned = token;
  CHECK(token.use_count() == 4);
  REQUIRE(kill_segment(m, h));
  CHECK(token.use_count() == 1);
}

TEST_CASE("a BRep of movable data that cannot be copied works") {
  struct Data {
    std::unique_ptr<int> owned;
  };
  BRep<Data, Data, Data> m;
  const HalfedgeId h = *make_segment(m);
  m.data(m.face(h)).owned = std::make_unique<int>(1);
  const HalfedgeId s = *split_face(m, h, twin(h));
  CHECK((m.data(m.face(s)).owned && !m.data(m.face(twin(s))).owned));
  BRep<Data, Data, Data> moved = std::move(m);
  CHECK(*moved.data(moved.face(s)).owned == 1);
}

TEST_CASE("a small list keeps its values when it outgrows its inline storage") {
  SmallList<int, 4> list;
  for (int i = 0; i < 100; ++i) {
    list.push_back(i);
    CHECK(list.size() == static_cast<std::size_t>(i) + 1);
    for (std::size_t k = 0; k < list.size(); ++k) { CHECK(list[k] == static_cast<int>(k)); }
  }
  list.clear();
  CHECK(list.empty());
  list.push_back(5);
  CHECK((list.size() == 1 && list[0] == 5));
}

TEST_CASE("circulators: a face's loop, a vertex's fan, all elements in index order without the dead") {
  auto m = shapes::build(shapes::cube_builder());
  for (FaceId f : faces(m)) {
    CHECK(degree(m, f) == 4);
    CHECK(*halfedges_of(m, f).begin() == m.halfedge(f));
    for (HalfedgeId h : halfedges_of(m, f)) { CHECK(m.face(h) == f); }
  }
  for (VertexId v : vertices(m)) {
    CHECK(degree(m, v) == 3);
    for (HalfedgeId h : halfedges_from(m, v)) { CHECK(m.vertex(h) == v); }
  }
  const FaceId gone = m.face(twin(m.halfedge(FaceId{3})));
  REQUIRE(join_faces(m, m.halfedge(FaceId{3})));
  std::vector<FaceId> seen;
  for (FaceId f : faces(m)) { seen.push_back(f); }
  CHECK(seen.size() == 5);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
  CHECK(std::find(seen.begin(), seen.end(), gone) == seen.end());
  BRep<> empty;
  for (FaceId f : faces(empty)) { FAIL(to_string(f)); }
  CHECK((shell_count(empty) == 0 && genus(empty) == 0));
  static_assert(std::forward_iterator<decltype(halfedges_of(m, FaceId{}).begin())>);
  static_assert(std::forward_iterator<decltype(faces(m).begin())>);
}
