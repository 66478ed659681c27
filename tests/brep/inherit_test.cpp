// SPDX-License-Identifier: MIT
// What new elements inherit, what survives a join, and when data are let go: the table of brep/inherit.hpp, line by line.

#include <brep/inherit.hpp>

#include <memory>

#include <brep/euler_log.hpp>

#include "calls.hpp"

using namespace brep;

namespace {

struct Numbered {
  int number = -1;
};
// Decides itself: counts generations, and remembers whose child it is.
struct Child {
  int number = -1, generation = 0, parent = -1;
  void inherit(const Child& of) {
    parent = of.number;
    generation = of.generation + 1;
  }
};
struct MoveOnly {
  std::unique_ptr<int> number;
};
// Owns something, and lets the owner count.
struct Shared {
  std::shared_ptr<int> owned;
};
using Plain = BRep<Numbered, Numbered, Numbered>;
using Family = BRep<Child, Numbered, Child>;

// A square pillow, all elements numbered; each number tells the element: 100 + index.
template <class B>
B square() {
  B m;
  const HalfedgeId h = *make_segment(m);
  for (int i = 0; i < 2; ++i) { REQUIRE(split_edge(m, h)); }
  REQUIRE(split_face(m, twin(m.next(m.next(h))), h));
  for (VertexId v : vertices(m)) { m.data(v) = {static_cast<int>(100 + v.index)}; }
  for (FaceId f : faces(m)) { m.data(f) = {static_cast<int>(100 + f.index)}; }
  for (HalfedgeId x : shapes::all_halfedges(m)) { m.data(x) = {static_cast<int>(100 + x.index)}; }
  REQUIRE(shapes::faults(m) == "");
  return m;
}
int number(VertexId v) { return static_cast<int>(100 + v.index); }
int number(FaceId f) { return static_cast<int>(100 + f.index); }
int number(HalfedgeId h) { return static_cast<int>(100 + h.index); }

}  // namespace

TEST_CASE("split_face and cut: the new face starts with a copy of the face that was split, new half-edges with default data") {
  Plain m = square<Plain>();
  const HalfedgeId a{0}, b = m.next(m.next(a));
  const FaceId f = m.face(a);
  const HalfedgeId h = *split_face(m, a, b);
  CHECK((m.data(m.face(h)).number == number(f) && m.data(m.face(twin(h))).number == number(f)));
  CHECK((m.data(h).number == -1 && m.data(twin(h)).number == -1));
  CHECK((m.data(a).number == number(a) && m.data(m.vertex(a)).number == number(m.vertex(a))));

  const FaceId kept = m.face(h), other = m.face(twin(a));
  const HalfedgeId joint = *bridge(m, h, twin(a));
  CHECK(m.data(kept).number == number(f));  // bridge keeps the data of the face that stays
  const FaceId fresh = *cut(m, joint);
  CHECK(fresh == other);
  CHECK(m.data(fresh).number == number(f));  // the data of the killed face are gone
}

TEST_CASE("split_vertex, split_edge and unweld: the new vertex has default data") {
  Plain m = square<Plain>();
  const HalfedgeId a{0};
  CHECK(m.data(m.target(*split_vertex(m, a, a))).number == -1);
  CHECK(m.data(m.vertex(*split_edge(m, a))).number == -1);
  const VertexId v = m.vertex(a), w = m.vertex(m.next(m.next(twin(a))));
  REQUIRE(v != w);
  const HalfedgeId h = *weld(m, a, m.halfedge(w));
  CHECK(m.data(v).number == number(v));  // weld keeps the data of the vertex that stays
  const VertexId fresh = *unweld(m, h);
  CHECK(m.data(fresh).number == -1);
  CHECK(m.data(v).number == number(v));
}

TEST_CASE("a killed element's data do not come back with its slot: the next owner starts with default data") {
  Plain m = square<Plain>();
  const HalfedgeId a{0};
  const HalfedgeId spur = *split_vertex(m, a, a);
  const VertexId w = m.target(spur);
  m.data(spur).number = 7, m.data(twin(spur)).number = 8, m.data(w).number = 9;
  REQUIRE(join_vertices(m, spur));
  const HalfedgeId again = *split_vertex(m, a, a);
  REQUIRE((again == spur && m.target(again) == w));
  CHECK((m.data(again).number == -1 && m.data(twin(again)).number == -1 && m.data(w).number == -1));

  Plain segments;
  const HalfedgeId h = *make_segment(segments);
  segments.data(segments.face(h)).number = 3;
  segments.data(segments.vertex(h)).number = 4;
  REQUIRE(kill_segment(segments, h));
  REQUIRE(make_segment(segments));
  CHECK((segments.data(segments.face(h)).number == -1 && segments.data(segments.vertex(h)).number == -1));
}

TEST_CASE("join_faces and join_vertices: the element that stays keeps its data") {
  Plain m = square<Plain>();
  const HalfedgeId a{0};
  const VertexId v = m.vertex(a);
  REQUIRE(*join_vertices(m, a) == v);
  CHECK(m.data(v).number == number(v));
  const HalfedgeId b = shapes::all_halfedges(m)[0];
  const FaceId f = m.face(b);
  REQUIRE(*join_faces(m, b) == f);
  CHECK(m.data(f).number == number(f));
}

TEST_CASE("a type with a member inherit decides itself, and make_segment has no parent") {
  Family m = square<Family>();
  for (VertexId v : vertices(m)) { m.data(v).generation = 0; }
  for (FaceId f : faces(m)) { m.data(f).generation = 0; }
  const HalfedgeId a{0};
  const FaceId f = m.face(a);
  const auto is_child = [](const Child& data, int parent) { return data.parent == parent && data.generation == 1 && data.number == -1; };
  const HalfedgeId h = *split_face(m, a, m.next(m.next(a)));
  CHECK(is_child(m.data(m.face(twin(h))), number(f)));
  CHECK(m.data(f).generation == 0);
  const VertexId v = m.vertex(a), end = m.target(a);
  CHECK(is_child(m.data(m.target(*split_vertex(m, a, a))), number(v)));
  CHECK(is_child(m.data(m.vertex(*split_edge(m, a))), number(end)));
  const HalfedgeId loop = *split_face(m, a, a);  // one side of it is a one-edge face: give that side a spur, then the loop can go
  const HalfedgeId inside = m.next(twin(loop)) == twin(loop) ? twin(loop) : loop;
  REQUIRE(split_vertex(m, inside, inside));
  CHECK(is_child(m.data(*unweld(m, loop)), number(v)));
  const FaceId kept = m.face(a);
  const HalfedgeId segment = *make_segment(m);
  CHECK((m.data(m.face(segment)).generation == 0 && m.data(m.vertex(segment)).generation == 0));
  const int kept_number = m.data(kept).number;
  const int kept_generation = m.data(kept).generation;
  const FaceId fresh = *cut(m, *bridge(m, a, segment));
  CHECK((m.data(fresh).parent == kept_number && m.data(fresh).generation == kept_generation + 1));
}

TEST_CASE("a face type that cannot be copied starts with default data") {
  BRep<NoData, NoData, MoveOnly> m;
  const HalfedgeId h = *make_segment(m);
  m.data(m.face(h)).number = std::make_unique<int>(4);
  const HalfedgeId n = *split_face(m, h, twin(h));
  CHECK(*m.data(m.face(n)).number == 4);
  CHECK(m.data(m.face(twin(n))).number == nullptr);
}

TEST_CASE("what killed data own is released at once, with a log it is kept until its step cannot come back") {
  const auto value = std::make_shared<int>(1);
  BRep<Shared, Shared, Shared> m;
  HalfedgeId h = *make_segment(m);
  m.data(h).owned = m.data(m.vertex(h)).owned = m.data(m.face(h)).owned = value;
  CHECK(value.use_count() == 4);
  REQUIRE(kill_segment(m, h));
  CHECK(value.use_count() == 1);

  BRep<Shared, Shared, Shared, EulerLog> logged;
  h = *make_segment(logged);
  logged.data(h).owned = logged.data(logged.vertex(h)).owned = logged.data(logged.face(h)).owned = value;
  REQUIRE(kill_segment(logged, h));
  CHECK(value.use_count() == 4);
  REQUIRE(undo(logged));
  CHECK((logged.data(h).owned == value && logged.data(logged.vertex(h)).owned == value && logged.data(logged.face(h)).owned == value));
  CHECK(value.use_count() == 4);
  REQUIRE(undo(logged));          // the segment was never made
  REQUIRE(make_segment(logged));  // and never will be
  CHECK(value.use_count() == 1);
}

TEST_CASE("data that own memory live through random sequences of all operators") {  // leaks and uses after a kill show under the sanitizer
  struct Heavy {
    std::vector<int> list{1, 2, 3};
  };
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    BRep<Heavy, Heavy, Heavy> m;
    for (int i = 0; i < 500; ++i) { calls::apply(m, calls::random_call(m, random, 40)); }
    auto copy = m;
    const auto before = shapes::picture(m);
    for (int i = 0; i < 200; ++i) { calls::apply(copy, calls::random_call(copy, random, 5)); }
    CHECK(shapes::picture(m) == before);  // copies are independent
    for (FaceId f : faces(m)) { CHECK(m.data(f).list.size() == 3); }
    for (HalfedgeId h : shapes::all_halfedges(m)) { CHECK(m.data(h).list.size() == 3); }
  }
}
