// SPDX-License-Identifier: MIT
// The cut works on arrays of links (brep/csg/cut_faces.hpp). Here Euler operators make the same cut, edge by edge, and come to the same
// map.

#include <deque>
#include <map>

#include <brep/euler.hpp>
#include <brep/testing.hpp>

#include "csg_answers.hpp"

using namespace solids;

namespace {

using Key = std::array<double, 3>;
Key key(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

// Makes `cut` out of `whole` by split_edge, split_vertex and split_face; says in `fault` where that fails. Vertices are known by their
// positions, so no two may be in one place. Bridges of the whole may be drawn elsewhere in the cut, so the whole has no holes.
struct ByOperators {
  Mesh mesh;
  std::string fault;
  int operators = 0;

  ByOperators(const Mesh& whole, const Mesh& cut) : mesh(whole), cut_(cut), twin_of_(cut.halfedge_end()) {
    split_edges();
    if (fault.empty()) { add_edges(); }
  }

 private:
  [[nodiscard]] long chi() const {
    return static_cast<long>(mesh.vertex_count()) - static_cast<long>(mesh.edge_count()) + static_cast<long>(mesh.face_count());
  }
  [[nodiscard]] bool known(HalfedgeId t) const { return twin_of_[t.index].valid(); }

  void split_edges() {
    std::map<std::pair<Key, Key>, HalfedgeId> edge_of_cut;
    for (EdgeId e : edges(cut_)) {
      for (const HalfedgeId t : {halfedge(e), twin(halfedge(e))}) {
        edge_of_cut[{key(cut_.data(cut_.vertex(t)).position), key(cut_.data(cut_.target(t)).position)}] = t;
      }
    }
    std::vector<HalfedgeId> given;
    for (EdgeId e : edges(mesh)) { given.push_back(halfedge(e)); }
    for (const HalfedgeId first : given) {
      const glm::dvec3 from = mesh.data(mesh.vertex(first)).position, to = mesh.data(mesh.target(first)).position, d = to - from;
      std::map<double, glm::dvec3> on;  // vertices of the cut inside the edge, along it
      for (VertexId v : vertices(cut_)) {
        const glm::dvec3 p = cut_.data(v).position;
        const double t = glm::dot(p - from, d) / glm::dot(d, d);
        // Rounded to 2^-52 of coordinates of order 1; what belongs to other edges is much farther off in these tests.
        if (p != from && p != to && t > 0.0 && t < 1.0 && glm::length(from + t * d - p) < 1e-12) { on[t] = p; }
      }
      HalfedgeId h = first;
      for (const auto& [t, p] : on) {
        const HalfedgeId next = *split_edge(mesh, h);
        mesh.data(mesh.vertex(next)).position = p;
        know(h, edge_of_cut);
        h = next;
        ++operators;
      }
      know(h, edge_of_cut);
    }
  }
  void know(HalfedgeId h, const std::map<std::pair<Key, Key>, HalfedgeId>& edge_of_cut) {
    const auto found = edge_of_cut.find({key(mesh.data(mesh.vertex(h)).position), key(mesh.data(mesh.target(h)).position)});
    if (found == edge_of_cut.end()) {
      fault = "an edge of the whole is no edge of the cut";
      return;
    }
    twin_of_[found->second.index] = h;
    twin_of_[twin(found->second).index] = twin(h);
  }

  // The corner into which the edge t of the cut goes: before the first half-edge clockwise of it that is there.
  [[nodiscard]] HalfedgeId corner(HalfedgeId t) const {
    HalfedgeId x = cut_.next(twin(t));
    while (x != t && !known(x)) { x = cut_.next(twin(x)); }
    return twin_of_[x.index];
  }

  void add_edges() {
    const long before = chi();
    std::deque<HalfedgeId> open;  // half-edges of the cut that leave vertices which are there
    const auto reach = [&](HalfedgeId t) {
      for (HalfedgeId x : halfedges_from(cut_, cut_.vertex(t))) {
        if (!known(x)) { open.push_back(x); }
      }
    };
    for (EdgeId e : edges(cut_)) {
      if (known(halfedge(e))) { reach(halfedge(e)), reach(twin(halfedge(e))); }
    }
    while (!open.empty()) {
      const HalfedgeId t = open.front();
      open.pop_front();
      if (known(t)) { continue; }
      const HalfedgeId a = corner(t), b = corner(twin(t));
      const auto made = b.valid() ? split_face(mesh, a, b) : split_vertex(mesh, a, a);
      if (!made) {
        fault = made.refusal().sentence();
        return;
      }
      ++operators;
      twin_of_[t.index] = *made;
      twin_of_[twin(t).index] = twin(*made);
      mesh.data(mesh.target(*made)).position = cut_.data(cut_.target(t)).position;
      reach(twin(t));
      if (chi() != before) { fault = "v - e + f changed"; }
    }
  }

  const Mesh& cut_;
  std::vector<HalfedgeId> twin_of_;  // half-edge of the cut -> that of the mesh, once it is there
};

}  // namespace

TEST_CASE("split_edge, split_vertex and split_face cut a solid into the very map that imprint gives") {
  const Solid c = cube();
  const auto turned = [](double angle) {
    return made(moved(box(glm::dvec3(-.4), glm::dvec3(.4)), rotation({1, 2, 3}, angle), {.9, .8, .7}));
  };
  const std::pair<const char*, std::array<Solid, 2>> cases[] = {
      {"corner in corner", {c, made(box(glm::dvec3(.5), glm::dvec3(1.5)))}},
      {"a bar through it: islands", {c, made(box({.25, .25, -1}, {.75, .75, 2}))}},
      {"two bars: two islands on a face",
       {c, valid(csg::unite(made(box({.1, .1, -1}, {.3, .3, 2})), made(box({.6, .6, -1}, {.9, .9, 2}))))}},
      {"slide: coplanar faces", {c, made(box({.5, 0, 0}, {1.5, 1, 1}))}},
      {"stacked: an outline in a face", {c, made(box({.25, .25, 1}, {.75, .75, 2}))}},
      {"halved", {c, made(box({-1, -1, -1}, {2, 2, .5}))}},
      {"turned", {c, turned(.7)}},
      {"hardly turned", {c, turned(1e-3)}},
      {"spheres", {made(octasphere(3, glm::dvec3(0.0))), made(octasphere(3, {.503, .307, .201}))}},
  };
  for (const auto& [name, operands] : cases) {
    INFO(name);
    const auto both = csg::imprint(operands[0], operands[1]);
    REQUIRE(both);
    for (int side = 0; side < 2; ++side) {
      const Mesh whole = csg::to_brep<Mesh>(operands[static_cast<std::size_t>(side)]);
      const Mesh cut = csg::to_brep<Mesh>(side == 0 ? both->a : both->b);
      const ByOperators by(whole, cut);
      INFO("operand " << side << ": " << by.operators << " operators");
      CHECK(by.fault == "");
      CHECK_THAT(by.mesh, IsValid());
      CHECK_THAT(by.mesh, IsIsomorphicTo(cut));
    }
  }
}
