// SPDX-License-Identifier: MIT
// The stepper's pictures: no two edges cross, whatever the map; pictures of successive steps are alike.
#include "apps/euler/layout.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <glm/geometric.hpp>

#include <brep/brep.hpp>
#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/handles.hpp>

#include "catch.hpp"

namespace {

using namespace apps::euler;
using brep::HalfedgeId;
using Map = brep::BRep<>;
using Point = glm::dvec2;
using Word = std::vector<std::uint32_t>;

std::vector<HalfedgeId> halfedges(const Map& map) {
  std::vector<HalfedgeId> all;
  for (brep::EdgeId e : brep::edges(map)) { all.insert(all.end(), {brep::halfedge(e), brep::twin(brep::halfedge(e))}); }
  return all;
}

// Equal for two maps exactly when renaming makes them the same (as in tests/brep/euler_test.cpp).
Word canonical(const Map& map) {
  Word best;
  for (HalfedgeId root : halfedges(map)) {
    std::map<HalfedgeId, std::uint32_t> number{{root, 0}};
    std::vector<HalfedgeId> order{root};
    Word word;
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (HalfedgeId h : {map.next(order[i]), brep::twin(order[i])}) {
        const auto found = number.emplace(h, static_cast<std::uint32_t>(order.size()));
        if (found.second) { order.push_back(h); }
        word.push_back(found.first->second);
      }
    }
    if (best.empty() || word < best) { best = word; }
  }
  return best;
}

double turn(const Point& a, const Point& b, const Point& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }
bool cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}
double distance(const Point& p, const Point& a, const Point& b) {
  const Point d = b - a;
  return glm::length(p - a - std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0) * d);
}

// Crossings of all drawn curves, each with itself included; and the least distance of a vertex from a curve that does not end there.
struct Quality {
  int crossings = 0;
  double least = 1e9;
};
Quality quality(const Panel& panel) {
  Quality q;
  std::vector<std::vector<Point>> lines;
  for (const Strand& s : panel.strands) { lines.push_back(s.curve.flat(8)); }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i; j < lines.size(); ++j) {
      for (std::size_t k = 1; k < lines[i].size(); ++k) {
        for (std::size_t l = i == j ? k + 1 : 1; l < lines[j].size(); ++l) {
          q.crossings += cross(lines[i][k - 1], lines[i][k], lines[j][l - 1], lines[j][l]) ? 1 : 0;
        }
      }
    }
    for (const VertexMark& v : panel.vertices) {
      if (v.at == lines[i].front() || v.at == lines[i].back()) { continue; }
      for (std::size_t k = 1; k < lines[i].size(); ++k) { q.least = std::min(q.least, distance(v.at, lines[i][k - 1], lines[i][k])); }
    }
  }
  return q;
}

// Every edge whole or as two stubs, every vertex once, every face named.
void check_complete(const Map& map, const Layout& layout) {
  std::map<std::uint32_t, int> whole, stubs, vertices;
  std::set<std::uint32_t> faces;
  for (const Panel& panel : layout.panels) {
    for (const Strand& s : panel.strands) { ++(s.stub ? stubs : whole)[s.halfedge / 2]; }
    for (const VertexMark& v : panel.vertices) { ++vertices[v.vertex]; }
    for (const FaceLabel& l : panel.labels) { faces.insert(l.face); }
  }
  for (brep::EdgeId e : brep::edges(map)) { CHECK(2 * whole[e.index] + stubs[e.index] == 2); }
  for (brep::VertexId v : brep::vertices(map)) { CHECK(vertices[v.index] == 1); }
  CHECK(vertices.size() == map.vertex_count());
  CHECK(faces.size() == map.face_count());
}

}  // namespace

TEST_CASE("no edges cross in the picture of any planar map of up to four edges") {
  Map segment, loop;
  const HalfedgeId h = *brep::make_segment(loop);
  REQUIRE(brep::make_segment(segment));
  REQUIRE(brep::split_face(loop, h, brep::twin(h)));
  REQUIRE(brep::join_vertices(loop, h));
  std::map<Word, Map> level{{canonical(segment), segment}, {canonical(loop), loop}};
  std::size_t maps = 0;
  double least = 1e9;
  for (int edges = 1; edges <= 4; ++edges) {
    std::map<Word, Map> next;
    for (const auto& [word, map] : level) {
      const Layout layout = lay_out(records_of(map), {}, 0.03);
      REQUIRE(layout.panels.size() == 1);
      const Quality q = quality(layout.panels[0]);
      INFO(edges << " edges, map " << maps);
      CHECK(q.crossings == 0);
      check_complete(map, layout);
      least = std::min(least, q.least);
      ++maps;
      for (HalfedgeId a : halfedges(map)) {
        for (HalfedgeId b : halfedges(map)) {
          if (edges == 4) { continue; }
          Map grown = map;
          if (brep::split_face(grown, a, b)) { next.emplace(canonical(grown), grown); }
          grown = map;
          if (brep::split_vertex(grown, a, b)) { next.emplace(canonical(grown), grown); }
        }
      }
    }
    level = std::move(next);
  }
  CHECK(maps == 2 + 4 + 14 + 57);
  // The panel is 2 wide. A vertex as near as a hundredth of it could not be told from the edge.
  CHECK(least > 0.02);
}

TEST_CASE("no edges cross in the pictures of random sequences, with handles cut open and several shells") {
  int most_stubs = 0;
  std::size_t pictures = 0;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    Map map;
    REQUIRE(brep::make_segment(map));
    Layout layout;
    for (int step = 0; step < 30; ++step) {
      const auto all = halfedges(map);
      const auto any = [&] { return all[random() % all.size()]; };
      HalfedgeId a = any(), b = a;
      for (auto k = random() % 4; k > 0; --k) { b = map.next(b); }
      HalfedgeId c = a;
      for (auto k = random() % 3; k > 0; --k) { c = map.next(brep::twin(c)); }
      switch (random() % 12) {
        case 0:
          static_cast<void>(brep::bridge(map, a, any()));
          break;
        case 1:
          static_cast<void>(brep::weld(map, a, any()));
          break;
        case 2:
          static_cast<void>(brep::join_faces(map, a));
          break;
        case 3:
          static_cast<void>(brep::join_vertices(map, a));
          break;
        case 4:
          if (brep::shell_count(map) < 3) { static_cast<void>(brep::make_segment(map)); }
          break;
        case 5:
        case 6:
        case 7:
          static_cast<void>(brep::split_vertex(map, a, c));
          break;
        default:
          static_cast<void>(brep::split_face(map, a, b));
      }
      layout = lay_out(records_of(map), layout, 0.03);
      ++pictures;
      check_complete(map, layout);
      CHECK(layout.panels.size() == brep::shell_count(map));
      int stubs = 0;
      for (const Panel& panel : layout.panels) {
        REQUIRE_FALSE(panel.strands.empty());
        INFO("step " << step << ", " << panel.strands.size() << " strands");
        CHECK(quality(panel).crossings == 0);
        stubs += static_cast<int>(std::count_if(panel.strands.begin(), panel.strands.end(), [](const Strand& s) { return s.stub; }));
      }
      CHECK((stubs > 0) == (brep::genus(map) > 0));
      most_stubs = std::max(most_stubs, stubs);
    }
  }
  CHECK(pictures == 240);
  CHECK(most_stubs >= 6);
}

TEST_CASE("a new spur leaves the rest of the picture nearly where it was, and the outer face outside") {
  Map map;
  const HalfedgeId h = *brep::make_segment(map);
  const HalfedgeId k = *brep::split_vertex(map, brep::twin(h), brep::twin(h));
  const HalfedgeId m = *brep::split_vertex(map, brep::twin(k), brep::twin(k));
  REQUIRE(brep::split_face(map, brep::twin(m), h));
  const Layout before = lay_out(records_of(map), {}, 0.03);
  REQUIRE(brep::split_vertex(map, brep::twin(h), brep::twin(h)));
  const Layout after = lay_out(records_of(map), before, 0.03);
  CHECK(before.panels[0].outer_face == after.panels[0].outer_face);
  for (const VertexMark& v : before.panels[0].vertices) {
    for (const VertexMark& w : after.panels[0].vertices) {
      if (v.vertex == w.vertex) { CHECK(glm::length(v.at - w.at) < 0.3); }
    }
  }
}
