// SPDX-License-Identifier: MIT
// What lies around an element, on solids and on maps with loops, spurs and one-edge faces.

#include <brep/neighbours.hpp>

#include <algorithm>
#include <ranges>
#include <set>

#include <brep/euler.hpp>

#include "shapes.hpp"

using namespace brep;
using shapes::Mesh;

namespace {

using Bare = BRep<>;

template <class Range>
auto list(const Range& range) {
  std::vector<typename std::remove_cvref_t<decltype(*range.begin())>> result;
  for (auto x : range) { result.push_back(x); }
  return result;
}
template <class Range>
std::size_t distinct(const Range& range) {
  const auto all = list(range);
  return std::set<typename decltype(all)::value_type>(all.begin(), all.end()).size();
}

// Each incidence seen from one side is seen as often from the other.
template <class B>
void check_reciprocity(const B& m) {
  const auto key = [](Element a, Element b) {
    const auto word = [](Element e) { return std::pair{e.letter, e.index}; };
    return word(a) < word(b);
  };
  std::vector<std::pair<Element, Element>> forward, backward;
  for (FaceId f : faces(m)) {
    for (VertexId v : vertices_of(m, f)) { forward.emplace_back(f, v); }
    for (EdgeId e : edges_of(m, f)) { forward.emplace_back(f, e); }
    for (FaceId g : neighbours_of(m, f)) { forward.emplace_back(f, g), backward.emplace_back(g, f); }
    CHECK(list(vertices_of(m, f)).size() == degree(m, f));
    CHECK(list(edges_of(m, f)).size() == degree(m, f));
    CHECK(list(neighbours_of(m, f)).size() == degree(m, f));
  }
  for (VertexId v : vertices(m)) {
    for (FaceId f : faces_of(m, v)) { backward.emplace_back(f, v); }
    for (EdgeId e : edges_of(m, v)) { forward.emplace_back(v, e); }
    for (VertexId w : neighbours_of(m, v)) { forward.emplace_back(v, w), backward.emplace_back(w, v); }
    CHECK(list(neighbours_of(m, v)).size() == degree(m, v));
  }
  for (EdgeId e : edges(m)) {
    for (FaceId f : faces_of(m, e)) { backward.emplace_back(f, e); }
    for (VertexId v : vertices_of(m, e)) { backward.emplace_back(v, e); }
  }
  const auto order = [&](const auto& a, const auto& b) {
    return key(a.first, b.first) || (!key(b.first, a.first) && key(a.second, b.second));
  };
  std::sort(forward.begin(), forward.end(), order);
  std::sort(backward.begin(), backward.end(), order);
  CHECK(forward == backward);
  CHECK(list(halfedges(m)) == shapes::all_halfedges(m));
}

}  // namespace

TEST_CASE("a cube: each face has four vertices, edges and neighbours, each vertex three, each edge two") {
  const Mesh m = shapes::build(shapes::cube_builder());
  for (FaceId f : faces(m)) {
    CHECK((distinct(vertices_of(m, f)) == 4 && distinct(edges_of(m, f)) == 4 && distinct(neighbours_of(m, f)) == 4));
  }
  for (VertexId v : vertices(m)) {
    CHECK((distinct(neighbours_of(m, v)) == 3 && distinct(edges_of(m, v)) == 3 && distinct(faces_of(m, v)) == 3));
  }
  for (EdgeId e : edges(m)) {
    CHECK((distinct(vertices_of(m, e)) == 2 && distinct(faces_of(m, e)) == 2));
    CHECK((m.vertex(halfedges_of(e)[0]) == vertices_of(m, e)[0] && m.face(halfedges_of(e)[1]) == faces_of(m, e)[1]));
  }
  CHECK(list(vertices_of(m, FaceId{1})) == std::vector{VertexId{4}, VertexId{5}, VertexId{7}, VertexId{6}});
  CHECK(list(neighbours_of(m, FaceId{1})) == std::vector{FaceId{2}, FaceId{5}, FaceId{3}, FaceId{4}});
  check_reciprocity(m);
}

TEST_CASE("the segment, the loop and the spur: elements come as often as the walk passes them") {
  Bare m;
  const HalfedgeId h = *make_segment(m);
  const FaceId f = m.face(h);
  CHECK(list(neighbours_of(m, f)) == std::vector{f, f});
  CHECK(list(edges_of(m, f)) == std::vector{edge(h), edge(h)});
  CHECK(list(neighbours_of(m, m.vertex(h))) == std::vector{m.target(h)});
  check_reciprocity(m);
  const HalfedgeId loop = *split_face(m, h, h);
  const VertexId v = m.vertex(h);
  CHECK(m.face(twin(loop)) != f);
  CHECK(list(neighbours_of(m, m.face(twin(loop)))) == std::vector{f});
  const auto around = list(neighbours_of(m, v));
  CHECK((around.size() == 3 && std::count(around.begin(), around.end(), v) == 2));
  check_reciprocity(m);
}

TEST_CASE("incidence is mutual on random maps with every degenerate state") {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Bare m;
    REQUIRE(make_segment(m));
    for (int step = 0; step < 60; ++step) {
      const auto all = shapes::all_halfedges(m);
      const HalfedgeId a = all[random.below(all.size())], b = all[random.below(all.size())];
      switch (random.below(4)) {
        case 0:
          (void)split_face(m, a, m.face(a) == m.face(b) ? b : a);
          break;
        case 1:
          (void)split_vertex(m, a, a);
          break;
        case 2:
          (void)join_faces(m, a);
          break;
        default:
          (void)make_segment(m);
          break;
      }
    }
    check_reciprocity(m);
  }
}

TEST_CASE("all walks are forward ranges whose iterators outlive them, and the algorithms of std::ranges take them") {
  const auto check = [](const auto& range) {
    using R = std::decay_t<decltype(range)>;
    static_assert(std::ranges::forward_range<const R> && std::ranges::common_range<const R> && std::ranges::borrowed_range<R>);
    auto it = range.begin();
    const auto again = it++;  // forward: a copy passes the same elements
    std::vector<typename R::iterator::value_type> a(range.begin(), range.end()), b;
    for (auto other = again; other != range.end(); ++other) { b.push_back(*other); }
    CHECK(a == b);
    CHECK(!range.empty());
    CHECK(static_cast<std::size_t>(std::ranges::distance(range)) == a.size());
    CHECK((a.size() == 1 ? it == range.end() : *it == a[1]));
  };
  Bare m = shapes::build<Bare>(shapes::cube_builder());
  check(halfedges_of(m, FaceId{0}));
  check(vertices_of(m, FaceId{0}));
  check(edges_of(m, FaceId{0}));
  check(neighbours_of(m, FaceId{0}));
  check(halfedges_from(m, VertexId{0}));
  check(edges_of(m, VertexId{0}));
  check(faces_of(m, VertexId{0}));
  check(neighbours_of(m, VertexId{0}));
  check(vertices(m));
  check(edges(m));
  check(halfedges(m));
  check(faces(m));
  CHECK(std::ranges::all_of(faces(m), [&](FaceId f) { return degree(m, f) == 4; }));
  const auto found = std::ranges::find(halfedges_of(m, FaceId{2}), m.prev(m.halfedge(FaceId{2})));  // of a range that is gone
  CHECK(*found == m.prev(m.halfedge(FaceId{2})));
  CHECK(std::ranges::max(vertices(m)) == VertexId{7});
  CHECK((faces(Bare()).empty() && halfedges(Bare()).empty()));
}
