// SPDX-License-Identifier: MIT
// halflight in the course: with the checked operators, and with their unchecked twins (what the peers have).

#include <algorithm>

#include <brep/builder.hpp>
#include <brep/circulators.hpp>
#include <brep/euler.hpp>
#include <brep/refine.hpp>
#include <brep/validate.hpp>

#include "bench.hpp"

namespace {

using namespace brep;

struct Point {
  glm::vec3 position{0.0f};
};
struct LevelPoint : Tag {
  glm::vec3 position{0.0f};
};

Builder builder_of(const bench::Torus& torus) {
  Builder builder;
  builder.reserve(torus.positions.size(), torus.quads.size(), 4 * torus.quads.size());
  for (const auto& p : torus.positions) { builder.vertex({p[0], p[1], p[2]}); }
  for (const auto& q : torus.quads) { builder.face(q, 0); }
  return builder;
}

struct Checked {
  static constexpr const char* name = "halflight";
  static HalfedgeId split_face(auto& m, HalfedgeId a, HalfedgeId b) { return *brep::split_face(m, a, b); }
  static void join_faces(auto& m, HalfedgeId h) { (void)*brep::join_faces(m, h); }
  static HalfedgeId split_edge(auto& m, HalfedgeId h) { return *brep::split_edge(m, h); }
  static HalfedgeId split_vertex(auto& m, HalfedgeId a, HalfedgeId b) { return *brep::split_vertex(m, a, b); }
  static void join_vertices(auto& m, HalfedgeId h) { (void)*brep::join_vertices(m, h); }
};
struct Unchecked {
  static constexpr const char* name = "unchecked";
  static HalfedgeId split_face(auto& m, HalfedgeId a, HalfedgeId b) { return unchecked::split_face(m, a, b); }
  static void join_faces(auto& m, HalfedgeId h) { unchecked::join_faces(m, h); }
  static HalfedgeId split_edge(auto& m, HalfedgeId h) { return unchecked::split_edge(m, h); }
  static HalfedgeId split_vertex(auto& m, HalfedgeId a, HalfedgeId b) { return unchecked::split_vertex(m, a, b); }
  static void join_vertices(auto& m, HalfedgeId h) { unchecked::join_vertices(m, h); }
};

template <class Operators>
struct Halflight {
  using Mesh = BRep<Point>;
  using Face = FaceId;
  using Vertex = VertexId;
  using Halfedge = HalfedgeId;
  static constexpr const char* name = Operators::name;

  static void build(Mesh& m, const bench::Torus& torus) { m = std::move(*close<Mesh>(builder_of(torus)).brep); }
  static std::size_t vertices(const Mesh& m) { return m.vertex_count(); }
  static std::size_t edges(const Mesh& m) { return m.edge_count(); }
  static std::size_t faces(const Mesh& m) { return m.face_count(); }
  static bool valid(const Mesh& m) { return validate(m).empty(); }
  static void collect(Mesh&) {}
  static std::vector<Face> face_list(const Mesh& m) { return {brep::faces(m).begin(), brep::faces(m).end()}; }
  static std::vector<Vertex> vertex_list(const Mesh& m) { return {brep::vertices(m).begin(), brep::vertices(m).end()}; }
  static std::vector<Halfedge> halfedge_list(const Mesh& m) {
    std::vector<Halfedge> list;
    for (EdgeId e : brep::edges(m)) { list.push_back(halfedge(e)); }
    return list;
  }
  static bool first_half(const Mesh&, Halfedge h) { return h.index % 2 == 0; }
  static Halfedge next(const Mesh& m, Halfedge h) { return m.next(h); }
  static Halfedge loop(const Mesh& m, Face f) { return m.halfedge(f); }

  static void split_join_face(Mesh& m, Face f) {
    const Halfedge a = m.halfedge(f);
    Operators::join_faces(m, Operators::split_face(m, a, m.next(m.next(a))));
  }
  static void split_join_edge(Mesh& m, Halfedge h) { Operators::join_vertices(m, twin(Operators::split_edge(m, h))); }
  static void split_join_vertex(Mesh& m, Vertex v) {
    const Halfedge a = m.halfedge(v);
    Operators::join_vertices(m, Operators::split_vertex(m, a, m.next(twin(m.next(twin(a))))));
  }
  static void split_edge(Mesh& m, Halfedge h) { Operators::split_edge(m, h); }
  static void refine_face(Mesh& m, Halfedge m0, Halfedge m1, Halfedge m2, Halfedge m3) {
    const Halfedge h = Operators::split_face(m, m0, m2), n = Operators::split_edge(m, h);
    Operators::split_face(m, n, m3);
    Operators::split_face(m, twin(h), m1);
  }
  static std::uint64_t walk_faces(const Mesh& m) {
    std::uint64_t sum = 0;
    for (Face f : brep::faces(m)) {
      for (Halfedge h : halfedges_of(m, f)) { sum += h.index; }
    }
    return sum;
  }
  static std::uint64_t walk_vertices(const Mesh& m) {
    std::uint64_t sum = 0;
    for (Vertex v : brep::vertices(m)) {
      for (Halfedge h : halfedges_from(m, v)) { sum += h.index; }
    }
    return sum;
  }
};

struct Plain : Halflight<Checked> {
  // refine.hpp: corners and mid-edge points found by levels, positions placed. No peer has its like.
  static double refine_by_level(const bench::Torus& torus) {
    using Tagged = BRep<LevelPoint, NoData, Tag>;
    Tagged m = std::move(*close<Tagged>(builder_of(torus)).brep);
    const double start = bench::thread_seconds();
    for (std::uint32_t f = 0; f < torus.quads.size(); ++f) { (void)*refine(m, FaceId{f}); }
    const double seconds = bench::thread_seconds() - start;
    if (m.face_count() != 4 * torus.quads.size() || !validate(m).empty()) { bench::fail(name, "refinement by level"); }
    return 1e9 * seconds / static_cast<double>(4 * torus.quads.size());
  }
};

}  // namespace

std::vector<std::unique_ptr<bench::Course>> bench::halflight_courses(const Torus& torus) {
  std::vector<std::unique_ptr<Course>> list;
  list.push_back(std::make_unique<CourseOf<Plain>>(torus));
  list.push_back(std::make_unique<CourseOf<Halflight<Unchecked>>>(torus));
  return list;
}
