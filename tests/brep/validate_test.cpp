// SPDX-License-Identifier: MIT
// What the validator says: sentences that name the elements, all faults at once, what counting alone would miss, and the
// constraints from R9 on. (That it catches everything: mutation_test.cpp.)

#include <brep/validate.hpp>

#include <set>

#include <brep/euler.hpp>
#include <brep/testing.hpp>
#include <brep/validate_constraints.hpp>

#include "maps.hpp"

using namespace brep;
using detail::Raw;
using maps::Bare;

namespace {

std::vector<int> rules(const std::vector<Fault>& faults) {
  std::vector<int> found;
  for (const Fault& fault : faults) { found.push_back(fault.rule); }
  return found;
}
std::string all_sentences(const std::vector<Fault>& faults) { return detail::sentences(faults); }
bool says(const std::vector<Fault>& faults, const std::string& part) { return all_sentences(faults).find(part) != std::string::npos; }

// A sphere of two triangles; returns a half-edge.
HalfedgeId pillow(Bare& m) {
  const HalfedgeId h = *make_segment(m);
  const HalfedgeId n = *split_edge(m, h);
  return *split_face(m, h, m.next(n));
}

// A loose strip of n quadrilaterals closed to a ring, as a careless reader might append it: its two rims have half-edges, but no faces, so
// these name the face `beyond`. v = 2n, e = 3n, f = n. With n == 0 nothing.
void append_loose_ring(Bare& m, std::uint32_t n, FaceId beyond) {
  std::vector<HalfedgeId> lower(n), upper(n), post(n);  // lower and upper run with the quadrilateral on the left, post upwards
  std::vector<FaceId> face(n);
  std::vector<VertexId> v(2 * n);
  for (std::uint32_t i = 0; i < n; ++i) {
    lower[i] = Raw::new_edge(m);
    upper[i] = Raw::new_edge(m);
    post[i] = Raw::new_edge(m);
    face[i] = Raw::new_face(m);
    v[i] = Raw::new_vertex(m);
    v[n + i] = Raw::new_vertex(m);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = (i + 1) % n, j = (i + n - 1) % n;  // lower[i] from i to k, post[k] up, upper[i] back, down post[i]
    Raw::at(m, lower[i]) = {post[k], twin(post[i]), v[i], face[i]};
    Raw::at(m, post[k]) = {upper[i], lower[i], v[k], face[i]};
    Raw::at(m, upper[i]) = {twin(post[i]), post[k], v[n + k], face[i]};
    Raw::at(m, twin(post[i])) = {lower[i], upper[i], v[n + i], face[i]};
    Raw::at(m, twin(lower[i])) = {twin(lower[j]), twin(lower[k]), v[k], beyond};
    Raw::at(m, twin(upper[i])) = {twin(upper[k]), twin(upper[j]), v[n + i], beyond};
    Raw::at(m, face[i]).halfedge = lower[i];
    Raw::at(m, v[i]).halfedge = lower[i];
    Raw::at(m, v[n + i]).halfedge = twin(post[i]);
  }
}

}  // namespace

TEST_CASE("v - e + f alone can lie: a box and a loose ring of faces count like one sphere, and the validator is not deceived") {
  Bare m = shapes::build<Bare>(shapes::cube_builder());
  const FaceId bottom = *faces(m).begin();
  append_loose_ring(m, 4, bottom);
  const long v = static_cast<long>(m.vertex_count()), e = static_cast<long>(m.edge_count()), f = static_cast<long>(m.face_count());
  CHECK(v - e + f == 2);       // as one sphere has
  CHECK(shell_count(m) == 2);  // or as a sphere and a torus have: 2(2 - 1)
  CHECK(genus(m) == 1);
  CHECK_FALSE(is_valid(m));
  const auto found = validate(m);
  CHECK(rules(found) == std::vector<int>{4, 4});  // both rims name the bottom of the box
  CHECK(found[0].elements[0] == Element(bottom));
  CHECK(says(found, "the face has two loops"));
}

TEST_CASE("v - e + f alone can lie: a box and two loose sheets, and R8 says which shell counts wrong") {
  Bare m = shapes::build<Bare>(shapes::cube_builder());
  const FaceId top = *faces(m).begin();
  for (int i = 0; i < 2; ++i) {  // a sheet: a pillow whose back names a face of the box
    const HalfedgeId h = pillow(m);
    const FaceId back = m.face(h);
    std::vector<HalfedgeId> loop;
    for (HalfedgeId x : halfedges_of(m, back)) { loop.push_back(x); }
    for (HalfedgeId x : loop) { Raw::at(m, x).face = top; }
    Raw::kill(m, back);
  }
  const long v = static_cast<long>(m.vertex_count()), e = static_cast<long>(m.edge_count()), f = static_cast<long>(m.face_count());
  CHECK(v - e + f == 2 + 1 + 1);  // as two spheres have
  const auto found = validate(m);
  CHECK(rules(found) == std::vector<int>{4, 4, 8, 8});
  CHECK(says(found, "v - e + f = 3 - 3 + 1 = 1, but a closed shell has 2, 0, -2"));
}

TEST_CASE("faults are sentences that name the elements: two loops of a face, two fans of a vertex") {
  Bare m;
  const HalfedgeId a = pillow(m), b = pillow(m);
  const Bare sound = m;
  const FaceId f = m.face(a), lost = m.face(b);
  std::vector<HalfedgeId> loop;
  for (HalfedgeId h : halfedges_of(m, lost)) { loop.push_back(h); }
  for (HalfedgeId h : loop) { Raw::at(m, h).face = f; }
  Raw::kill(m, lost);
  auto found = validate(m);
  REQUIRE(rules(found) == std::vector<int>{4, 8});
  CHECK(found[0].elements == std::vector<Element>{f, loop[0] < loop[1] && loop[0] < loop[2] ? loop[0] : std::min(loop[1], loop[2])});
  CHECK(found[0].sentence.find("R4: " + to_string(f) + " is also named by ") == 0);
  CHECK(says(found, "the face has two loops"));

  m = sound;
  const VertexId v = m.vertex(a), gone = m.vertex(b);
  std::vector<HalfedgeId> fan;
  for (HalfedgeId h : halfedges_from(m, gone)) { fan.push_back(h); }
  for (HalfedgeId h : fan) { Raw::at(m, h).vertex = v; }
  Raw::kill(m, gone);
  found = validate(m);
  REQUIRE(rules(found) == std::vector<int>{5, 8});
  CHECK(says(found, "the vertex has two fans"));
}

TEST_CASE("each rule has its own sentence: what, where, and the usual cause") {
  const Bare cube = shapes::build<Bare>(shapes::cube_builder());
  const HalfedgeId h{0};
  const FaceId f = cube.face(h);
  const auto damaged = [&](auto&& damage) {
    Bare m = cube;
    damage(m);
    CHECK_FALSE(is_valid(m));
    return validate(m);
  };
  auto found = damaged([&](Bare& m) { Raw::at(m, h).vertex = VertexId{99}; });
  CHECK(says(found, "R1: h0 has the vertex v99, which is not alive; usually a handle kept over a kill"));
  const VertexId other = cube.vertex(cube.next(cube.next(h)));
  found = damaged([&](Bare& m) { Raw::at(m, h).vertex = other; });
  CHECK(says(found, "R2: " + to_string(cube.prev(h)) + " ends at " + to_string(cube.vertex(h)) + ", but its next, h0, starts at " +
                        to_string(other)));
  found = damaged([&](Bare& m) { Raw::at(m, h).next = h; });
  CHECK(says(found, "R3: next(h0) is h0, but prev(h0) is " + to_string(cube.prev(h))));
  found = damaged([&](Bare& m) { Raw::at(m, cube.next(cube.halfedge(f))).face = cube.face(twin(h)); });
  CHECK(
      says(found, "R4: " + to_string(cube.next(cube.halfedge(f))) + " names " + to_string(cube.face(twin(h))) + ", but the walk by next"));
  found = damaged([&](Bare& m) { Raw::at(m, f).halfedge = twin(h); });
  CHECK(says(found, "R6: the anchor of " + to_string(f) + " is h1, which belongs to " + to_string(cube.face(twin(h)))));
  CHECK(found.size() == 1);
  found = damaged([&](Bare& m) { (void)Raw::vertices(m).allocate(); });
  CHECK(says(found, "R6: the anchor of v8 is h0, which belongs to v0"));
}

TEST_CASE("damaged free lists and dead bits are R7") {
  Bare m;
  for (int i = 0; i < 4; ++i) { REQUIRE(make_segment(m)); }
  for (std::uint32_t i = 0; i < 6; i += 2) { REQUIRE(kill_segment(m, HalfedgeId{i})); }
  const Bare sound = m;
  auto& pool = Raw::halfedges(m);
  CHECK(pool.first_free() == 4);
  link(pool[4]) = pool.dead_bit | 4;
  CHECK(says(validate(m), "R7: the free list of the edges goes from e2 to e2 for the second time; it was killed twice"));
  CHECK(says(validate(m), "R7: e1 is dead but not in the free list"));
  m = sound;
  link(pool[4]) = pool.dead_bit | 6;
  CHECK(says(validate(m), "R7: the free list of the edges goes from e2 to e3, which is alive"));
  m = sound;
  link(pool[4]) = pool.dead_bit | 0x7ffffff0;
  CHECK(says(validate(m), "R7: the free list of the edges goes from e2 to a slot that does not exist"));
  m = sound;
  link(pool[6]) |= pool.dead_bit;
  CHECK(says(validate(m), "R7: e3 is dead but not in the free list"));
  CHECK(says(validate(m), "R8: 0 edges are alive, but 1 are counted"));
  CHECK(says(validate(m), "R1: "));
}

TEST_CASE("two damages are reported together") {
  Bare m = shapes::build<Bare>(shapes::cube_builder());
  const FaceId f = m.face(HalfedgeId{9});
  const HalfedgeId x = m.next(m.halfedge(f));
  Raw::at(m, HalfedgeId{0}).vertex = VertexId{99};
  Raw::at(m, x).face = m.face(twin(x));
  const auto found = rules(validate(m));
  CHECK(std::set<int>(found.begin(), found.end()) == std::set<int>{1, 4});
}

TEST_CASE("constraints are asked for one by one, and a valid structure may break each of them") {
  const Bare cube = shapes::build<Bare>(shapes::cube_builder());
  CHECK(validate(cube, Constraint::polyhedron).empty());
  const HalfedgeId h{0};
  const auto with = [&](auto&& change, Constraint set) {
    Bare m = cube;
    change(m);
    CHECK(is_valid(m));
    return validate(m, set);
  };
  const auto spur = [&](Bare& m) { REQUIRE(split_vertex(m, h, h)); };
  auto found = with(spur, Constraint::no_spurs);
  CHECK(rules(found) == std::vector<int>{9});
  CHECK(says(found, "v8 is the end of a spur: only h25 leaves it; join_vertices(h24) takes it away"));
  CHECK(with(spur, Constraint::no_loops | Constraint::three_edges | Constraint::one_edge_between_vertices).empty());

  const auto loop = [&](Bare& m) { REQUIRE(split_face(m, h, h)); };
  CHECK(rules(with(loop, Constraint::no_loops)) == std::vector<int>{10});
  CHECK(rules(with(loop, Constraint::three_edges)) == std::vector<int>{11});
  CHECK(rules(with(loop, Constraint::vertex_once_on_face)) == std::vector<int>{12});
  CHECK(with(loop, Constraint::no_spurs | Constraint::two_faces_at_edge).empty());

  const auto lens = [&](Bare& m) { REQUIRE(split_face(m, h, m.next(h))); };  // a second edge beside h
  CHECK(rules(with(lens, Constraint::three_edges)) == std::vector<int>{11});
  CHECK(rules(with(lens, Constraint::one_edge_between_vertices)) == std::vector<int>{14});
  CHECK(with(lens, Constraint::no_spurs | Constraint::no_loops | Constraint::vertex_once_on_face).empty());

  const auto handle = [&](Bare& m) { REQUIRE(bridge(m, h, twin(h))); };  // two faces with a common edge
  CHECK(rules(with(handle, Constraint::two_faces_at_edge)) == std::vector<int>{13, 13});

  const auto joint = [&](Bare& m) { REQUIRE(split_edge(m, h)); };
  CHECK(rules(with(joint, Constraint::three_edges_at_vertex)) == std::vector<int>{15});
  CHECK(with(joint, Constraint::polygons).empty());

  const auto every = [&](Bare& m) { spur(m), loop(m); };
  found = with(every, Constraint::polygons);
  const auto named = rules(found);
  CHECK(std::set<int>(named.begin(), named.end()) == std::set<int>{9, 10, 11, 12});  // all at once

  Bare broken = cube;
  Raw::at(broken, h).next = h;
  CHECK(rules(validate(broken, Constraint::polyhedron)) == rules(validate(broken)));  // structure first
}
