// SPDX-License-Identifier: MIT
// The validator catches every damaged field, names the right rule, and never loses its way on damaged records.

#include <brep/validate.hpp>

#include <chrono>
#include <set>

#include <brep/euler.hpp>
#include <brep/refine.hpp>

#include "shapes.hpp"

using namespace brep;
using detail::Raw;

namespace {

using Bare = BRep<>;

// Some live and some dead elements, loops, spurs, a torus and a segment.
Bare mixed(shapes::Random& random) {
  Bare m = shapes::build<Bare>(shapes::torus_builder(3, 3));
  REQUIRE(make_segment(m));
  for (int i = 0; i < 60; ++i) {
    const auto all = shapes::all_halfedges(m);
    const HalfedgeId a = all[random.below(all.size())];
    const bool shrink = i >= 30;
    switch (random.below(3) + (shrink ? 3 : 0)) {
      case 0:
        (void)split_face(m, a, random.below(3) == 0 ? a : m.next(m.next(a)));
        break;
      case 1:
        (void)split_vertex(m, a, random.below(3) == 0 ? a : m.next(twin(a)));
        break;
      case 2:
        (void)split_edge(m, a);
        break;
      case 3:
      case 4:
        (void)join_faces(m, a);
        break;
      default:
        (void)join_vertices(m, a);
        break;
    }
  }
  return m;
}

std::set<int> rules(const Bare& m) {
  std::set<int> found;
  for (const Fault& fault : validate(m)) {
    CHECK(fault.sentence.substr(0, 3) == std::string{'R', static_cast<char>('0' + fault.rule), ':'});
    found.insert(fault.rule);
  }
  return found;
}
bool any_of(const std::set<int>& found, std::initializer_list<int> expected) {
  for (int rule : expected) {
    if (found.count(rule) != 0) return true;
  }
  return false;
}
template <class IdType>
IdType pick(const std::vector<IdType>& list, shapes::Random& random) {
  return list[random.below(list.size())];
}

}  // namespace

TEST_CASE("every flip of one field of one record is caught, by the right rule") {
  int flips = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    const Bare sound = mixed(random);
    REQUIRE(shapes::faults(sound) == "");
    std::vector<VertexId> all_vertices;
    std::vector<FaceId> all_faces;
    for (VertexId v : vertices(sound)) all_vertices.push_back(v);
    for (FaceId f : faces(sound)) all_faces.push_back(f);
    const auto all = shapes::all_halfedges(sound);
    for (int round = 0; round < 120; ++round) {
      Bare m = sound;
      const HalfedgeId h = pick(all, random);
      const int field = round % 6;
      INFO("field " << field << " of " << to_string(h));
      if (field == 0 || field == 1) {
        HalfedgeId& link = field == 0 ? Raw::at(m, h).next : Raw::at(m, h).prev;
        const HalfedgeId value{random.below(m.halfedge_end() + 2)};
        if (value == link) continue;
        link = value;
        CHECK(any_of(rules(m), {sound.alive(value) ? 3 : 1}));
      } else if (field == 2) {
        const VertexId value{random.below(m.vertex_end() + 2)};
        if (value == Raw::at(m, h).vertex) continue;
        Raw::at(m, h).vertex = value;
        if (sound.alive(value))
          CHECK(any_of(rules(m), {2, 5, 6}));
        else
          CHECK(any_of(rules(m), {1}));
      } else if (field == 3) {
        const FaceId value{random.below(m.face_end() + 2)};
        if (value == Raw::at(m, h).face) continue;
        Raw::at(m, h).face = value;
        if (sound.alive(value))
          CHECK(any_of(rules(m), {4, 6}));
        else
          CHECK(any_of(rules(m), {1}));
      } else {
        const HalfedgeId value{random.below(m.halfedge_end() + 2)};
        bool legal = false;  // another half-edge of the same loop or fan is as good an anchor
        if (field == 4) {
          const VertexId v = pick(all_vertices, random);
          legal = sound.alive(value) && sound.vertex(value) == v;
          Raw::at(m, v).halfedge = value;
        } else {
          const FaceId f = pick(all_faces, random);
          legal = sound.alive(value) && sound.face(value) == f;
          Raw::at(m, f).halfedge = value;
        }
        if (legal)
          CHECK(shapes::faults(m) == "");
        else
          CHECK(any_of(rules(m), {sound.alive(value) ? 6 : 1}));
      }
      ++flips;
    }
  }
  CHECK(flips > 6000);
}

TEST_CASE("damaged free lists and dead bits are R7") {
  shapes::Random random(5);
  Bare m = mixed(random);
  auto& pool = Raw::halfedges(m);
  REQUIRE(pool.first_free() != pool.end_of_list);
  const Bare sound = m;
  link(pool[pool.first_free()]) = pool.dead_bit | pool.first_free();  // a ring
  CHECK(any_of(rules(m), {7}));
  m = sound;
  link(Raw::halfedges(m)[pool.first_free()]) = pool.dead_bit | shapes::all_halfedges(sound)[0].index;  // to a living edge
  CHECK(any_of(rules(m), {7}));
  m = sound;
  link(Raw::halfedges(m)[pool.first_free()]) = pool.dead_bit | 0x7ffffff0;  // to nowhere
  CHECK(any_of(rules(m), {7}));
  m = sound;
  link(Raw::halfedges(m)[shapes::all_halfedges(sound)[0].index]) |= pool.dead_bit;  // a living edge looks dead
  CHECK(any_of(rules(m), {7}));
  CHECK(any_of(rules(m), {1}));
}

TEST_CASE("faults are sentences that name the elements: two loops of a face, two fans of a vertex") {
  Bare m;  // two triangles' pillows; then the second shell's front claims to be the first one's
  const auto pillow = [&] {
    const HalfedgeId h = *make_segment(m);
    const HalfedgeId n = *split_edge(m, h);
    return *split_face(m, h, m.next(n));
  };
  const HalfedgeId a = pillow(), b = pillow();
  const FaceId f = m.face(a), lost = m.face(b);
  for (HalfedgeId h : halfedges_of(m, lost)) Raw::at(m, h).face = f;
  Raw::kill(m, lost);
  auto found = validate(m);
  REQUIRE(found.size() == 2);
  CHECK((found[0].rule == 4 && found[1].rule == 8));  // the second shell has no face of its own: 3 - 3 + 1
  CHECK(found[0].elements[0] == Element(f));
  CHECK(found[0].sentence.find("the face has two loops") != std::string::npos);

  const VertexId v = m.vertex(a), gone = m.vertex(b);
  Raw::at(m, f).halfedge = a;
  const FaceId fresh = Raw::new_face(m);
  Raw::at(m, fresh).halfedge = b;
  for (HalfedgeId h = b;;) {
    Raw::at(m, h).face = fresh;
    if ((h = m.next(h)) == b) break;
  }
  REQUIRE(shapes::faults(m) == "");
  std::vector<HalfedgeId> fan;
  for (HalfedgeId h : halfedges_from(m, gone)) fan.push_back(h);
  for (HalfedgeId h : fan) Raw::at(m, h).vertex = v;
  Raw::kill(m, gone);
  found = validate(m);
  REQUIRE(found.size() == 2);
  CHECK((found[0].rule == 5 && found[1].rule == 8));
  CHECK(found[0].sentence.find("two fans") != std::string::npos);
}

TEST_CASE("two damages are reported together") {
  auto m = shapes::build<Bare>(shapes::cube_builder());
  Raw::at(m, HalfedgeId{0}).vertex = VertexId{7};
  Raw::at(m, HalfedgeId{9}).face = m.face(HalfedgeId{9}) == FaceId{0} ? FaceId{1} : FaceId{0};
  const auto found = rules(m);
  CHECK(any_of(found, {2}));
  CHECK(any_of(found, {4, 6}));
}

TEST_CASE("random garbage in many records neither crashes nor hangs the validator") {
  for (std::uint32_t seed = 1; seed <= 500; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    Bare m = mixed(random);
    const auto all = shapes::all_halfedges(m);
    for (std::uint32_t k = 1 + random.below(30); k > 0; --k) {
      auto& r = Raw::at(m, pick(all, random));
      const std::uint32_t value = random.below(3) == 0 ? random.below(0xffffffff) : random.below(m.halfedge_end());
      switch (random.below(4)) {
        case 0:
          r.next.index = value;
          break;
        case 1:
          r.prev.index = value;
          break;
        case 2:
          r.vertex.index = value;
          break;
        default:
          r.face.index = value;
          break;
      }
    }
    CHECK_FALSE(validate(m).empty());
  }
}
