// SPDX-License-Identifier: MIT
// Every operator on every half-edge or pair of every solid of up to four edges, of every genus, and of every two shells of four edges
// together.

#include <brep/euler_log.hpp>
#include <brep/isomorphism.hpp>

#include <array>

#include "calls.hpp"
#include "maps.hpp"

using namespace brep;
using calls::Call;
using maps::Bare;
using shapes::Anchors;
using shapes::picture;

namespace {

using Logged = BRep<NoData, NoData, NoData, EulerLog>;

// The same elements with a log that begins here.
Logged logged(const Bare& mesh) {
  using detail::Raw;
  Logged result;
  Raw::halfedges(result) = Raw::halfedges(mesh);
  Raw::vertices(result) = Raw::vertices(mesh);
  Raw::faces(result) = Raw::faces(mesh);
  return result;
}

// What must be true of the new edge, from the comments in euler.hpp.
void check_new_edge(const Logged& before, const Logged& m, const Call& call, HalfedgeId h) {
  const HalfedgeId a = call.a, b = call.b, t = twin(h);
  switch (call.op) {
    case Operator::split_face:
      CHECK((m.vertex(h) == before.vertex(a) && m.target(h) == before.vertex(b)));
      CHECK((m.face(h) == before.face(b) && !before.alive(m.face(t))));
      CHECK((a == b ? m.next(t) == t && m.next(h) == a : m.next(h) == b && m.next(t) == a));
      break;
    case Operator::split_vertex:
      CHECK((m.vertex(h) == before.vertex(b) && !before.alive(m.target(h))));
      CHECK((m.face(h) == before.face(a) && m.face(t) == before.face(b)));
      CHECK((m.next(h) == (a == b ? t : a) && m.next(t) == b));
      break;
    case Operator::split_edge:
      CHECK((h == m.next(a) && m.vertex(a) == before.vertex(a) && m.target(h) == before.target(a) && !before.alive(m.vertex(h))));
      break;
    case Operator::bridge:
      CHECK((m.vertex(h) == before.vertex(a) && m.target(h) == before.vertex(b)));
      CHECK((m.next(h) == b && m.next(t) == a));
      CHECK((m.face(h) == before.face(a) && m.face(t) == before.face(a) && !m.alive(before.face(b))));
      break;
    case Operator::weld:
      CHECK((m.next(h) == a && m.next(t) == b));
      CHECK((m.face(h) == before.face(a) && m.face(t) == before.face(b)));
      CHECK((m.vertex(h) == before.vertex(a) && m.vertex(t) == before.vertex(a) && !m.alive(before.vertex(b))));
      break;
    default:
      break;
  }
}

void check_shells(const Call& call, const calls::Shells& before, const calls::Shells& after) {
  CHECK(after.closed);
  const long ds = static_cast<long>(after.count) - static_cast<long>(before.count), dh = after.handles - before.handles;
  const calls::Change change = calls::change(call.op);
  CHECK(2 * (ds - dh) == change.v - change.e + change.f);
  if (calls::takes_two(call.op) || call.op == Operator::split_edge) { CHECK(ds <= 0); }
}

// Returns whether the call was possible.
bool check_call(const Logged& start, const Call& call) {
  INFO(calls::to_string(call));
  Logged m = start;
  const Code promised = calls::promised(start, call);
  const calls::Answer answer = calls::apply(m, call);
  CHECK(answer.refusal.code == promised);
  if (!answer.done) {
    CHECK(picture(m) == picture(start));
    CHECK_FALSE(answer.refusal.sentence().empty());
    return false;
  }
  CHECK(shapes::faults(m) == "");
  const calls::Change change = calls::change(call.op);
  CHECK(static_cast<int>(m.vertex_count()) - static_cast<int>(start.vertex_count()) == change.v);
  CHECK(static_cast<int>(m.edge_count()) - static_cast<int>(start.edge_count()) == change.e);
  CHECK(static_cast<int>(m.face_count()) - static_cast<int>(start.face_count()) == change.f);
  check_shells(call, calls::shells(start), calls::shells(m));
  if (answer.made.valid()) { check_new_edge(start, m, call, answer.made); }

  Logged back = m;
  CHECK(calls::apply(back, calls::inverse(start, call, answer.made)).done);
  CHECK(shapes::faults(back) == "");
  switch (calls::restores(start, call)) {
    case calls::Restores::every_record:
      CHECK(picture(back) == picture(start));
      break;
    case calls::Restores::all_but_anchors:
      CHECK(picture(back, Anchors::hidden) == picture(start, Anchors::hidden));
      break;
    case calls::Restores::the_shape:
      CHECK(find_isomorphism(back, start).has_value());
      break;
  }
  const auto after = picture(m);
  CHECK((undo(m) && picture(m) == picture(start)));
  CHECK((redo(m) && picture(m) == after));
  return true;
}

struct Calls {
  std::size_t possible = 0, refused = 0;
};
Calls check_all_calls(const Bare& mesh) {
  INFO("v " << mesh.vertex_count() << " e " << mesh.edge_count() << " f " << mesh.face_count());
  const Logged start = logged(mesh);
  Calls count;
  const auto check = [&](const Call& call) { ++(check_call(start, call) ? count.possible : count.refused); };
  check({Operator::make_segment, {}, {}});
  for (HalfedgeId a : shapes::all_halfedges(mesh)) {
    for (Operator op : {Operator::kill_segment, Operator::join_faces, Operator::join_vertices, Operator::split_edge, Operator::cut,
                        Operator::unweld, Operator::set_anchor}) {
      check({op, a, {}});
    }
    for (HalfedgeId b : shapes::all_halfedges(mesh)) {
      for (Operator op : {Operator::split_face, Operator::split_vertex, Operator::bridge, Operator::weld}) { check({op, a, b}); }
    }
  }
  return count;
}

}  // namespace

TEST_CASE("the operators reach all maps of up to four edges, of every genus, and no others") {
  // Rooted maps of n edges and genus g (Tutte 1963 for g = 0; Walsh and Lehman 1972): each map of e edges has 2e / |automorphisms| roots
  // that differ. Unrooted: OEIS A006384 for the plane; 2, 5, 20, 107 for all genera together (A170946).
  constexpr std::array<std::array<std::size_t, 3>, 5> rooted{{{}, {2, 0, 0}, {9, 1, 0}, {54, 20, 0}, {378, 307, 21}}};
  constexpr std::array<std::size_t, 5> planar{0, 2, 4, 14, 57}, all{0, 2, 5, 20, 107};
  const auto levels = maps::all_maps(4);
  for (std::size_t n = 1; n <= 4; ++n) {
    INFO(n << " edges");
    CHECK(levels[n].size() == all[n]);
    std::array<std::size_t, 3> roots{}, unrooted{};
    for (const auto& [word, mesh] : levels[n]) {
      REQUIRE(shapes::faults(mesh) == "");
      const auto handles = static_cast<std::size_t>(genus(mesh));
      REQUIRE((handles < 3 && shell_count(mesh) == 1));
      const std::size_t automorphisms = maps::canonical(mesh).automorphisms;
      REQUIRE(2 * n % automorphisms == 0);
      roots[handles] += 2 * n / automorphisms;
      ++unrooted[handles];
    }
    CHECK(roots == rooted[n]);
    CHECK(unrooted[0] == planar[n]);
  }
}

TEST_CASE("every operator on every half-edge and pair of every map of up to four edges") {
  Calls sum;
  for (const maps::Level& level : maps::all_maps(4)) {
    for (const auto& [word, mesh] : level) {
      const Calls count = check_all_calls(mesh);
      sum.possible += count.possible;
      sum.refused += count.refused;
    }
  }
  CHECK(sum.possible > 10000);
  CHECK(sum.refused > 10000);
  std::printf("exhaustive: %zu calls possible, %zu refused\n", sum.possible, sum.refused);
}

TEST_CASE("every operator on every half-edge and pair of every two shells of up to four edges together") {
  const auto levels = maps::all_maps(3);
  std::size_t pairs = 0;
  for (std::size_t i = 1; i <= 3; ++i) {
    for (std::size_t k = i; i + k <= 4; ++k) {
      for (const auto& [word, first] : levels[i]) {
        for (const auto& [other_word, second] : levels[k]) {
          if (i == k && other_word < word) { continue; }
          check_all_calls(maps::together(first, second));
          ++pairs;
        }
      }
    }
  }
  CHECK(pairs == 3 + 2 * 5 + 2 * 20 + 15);
}
