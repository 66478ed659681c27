// SPDX-License-Identifier: MIT
// CGAL's Surface_mesh and Polyhedron_3 in the course, through CGAL::Euler. A half-edge stands for the corner where it ends.

#include <algorithm>
#include <iterator>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>
#include <CGAL/boost/graph/iterator.h>

#include "bench.hpp"

namespace {

using Kernel = CGAL::Simple_cartesian<float>;

// What both have in common.
template <class M>
struct Graph {
  using Mesh = M;
  using Traits = boost::graph_traits<M>;
  using Face = typename Traits::face_descriptor;
  using Vertex = typename Traits::vertex_descriptor;
  using Halfedge = typename Traits::halfedge_descriptor;

  static void collect(Mesh&) {}
  static std::vector<Face> face_list(const Mesh& m) { return {CGAL::faces(m).begin(), CGAL::faces(m).end()}; }
  static std::vector<Vertex> vertex_list(const Mesh& m) { return {CGAL::vertices(m).begin(), CGAL::vertices(m).end()}; }
  static Halfedge next(const Mesh& m, Halfedge h) { return CGAL::next(h, m); }
  static Halfedge loop(const Mesh& m, Face f) { return CGAL::halfedge(f, m); }

  static void split_join_face(Mesh& m, Face f) {
    const Halfedge a = CGAL::halfedge(f, m);
    CGAL::Euler::join_face(CGAL::Euler::split_face(a, CGAL::next(CGAL::next(a, m), m), m), m);
  }
  static void split_join_edge(Mesh& m, Halfedge h) { CGAL::Euler::join_vertex(CGAL::opposite(CGAL::Euler::split_edge(h, m), m), m); }
  static void split_join_vertex(Mesh& m, Vertex v) {
    const Halfedge a = CGAL::halfedge(v, m);
    const Halfedge b = CGAL::opposite(CGAL::next(CGAL::opposite(CGAL::next(a, m), m), m), m);
    CGAL::Euler::join_vertex(CGAL::Euler::split_vertex(a, b, m), m);
  }
  static void split_edge(Mesh& m, Halfedge h) { CGAL::Euler::split_edge(h, m); }
  static void refine_face(Mesh& m, Halfedge m0, Halfedge m1, Halfedge m2, Halfedge m3) {
    const Halfedge h = CGAL::Euler::split_face(m0, m2, m), r = CGAL::Euler::split_edge(h, m);
    CGAL::Euler::split_face(r, m3, m);
    CGAL::Euler::split_face(CGAL::opposite(h, m), m1, m);
  }
};

struct SurfaceMesh : Graph<CGAL::Surface_mesh<Kernel::Point_3>> {
  static constexpr const char* name = "Surface_mesh";

  static void build(Mesh& m, const bench::Torus& torus) {
    const auto n = static_cast<Mesh::size_type>(torus.quads.size());
    m.reserve(n, 2 * n, n);
    for (const auto& p : torus.positions) { m.add_vertex(Kernel::Point_3(p[0], p[1], p[2])); }
    for (const auto& q : torus.quads) { m.add_face(Vertex(q[0]), Vertex(q[1]), Vertex(q[2]), Vertex(q[3])); }
  }
  static std::size_t vertices(const Mesh& m) { return m.number_of_vertices(); }
  static std::size_t edges(const Mesh& m) { return m.number_of_edges(); }
  static std::size_t faces(const Mesh& m) { return m.number_of_faces(); }
  static bool valid(const Mesh& m) { return m.is_valid(false); }
  static std::vector<Halfedge> halfedge_list(const Mesh& m) {
    std::vector<Halfedge> list;
    for (auto e : m.edges()) { list.push_back(m.halfedge(e)); }
    return list;
  }
  static bool first_half(const Mesh&, Halfedge h) { return static_cast<std::uint32_t>(h) % 2 == 0; }
  static std::uint64_t walk_faces(const Mesh& m) {
    std::uint64_t sum = 0;
    for (Face f : m.faces()) {
      for (Halfedge h : CGAL::halfedges_around_face(m.halfedge(f), m)) { sum += static_cast<std::uint32_t>(h); }
    }
    return sum;
  }
  static std::uint64_t walk_vertices(const Mesh& m) {
    std::uint64_t sum = 0;
    for (Vertex v : m.vertices()) {
      for (Halfedge h : CGAL::halfedges_around_target(m.halfedge(v), m)) { sum += static_cast<std::uint32_t>(h); }
    }
    return sum;
  }
};

struct Polyhedron : Graph<CGAL::Polyhedron_3<Kernel>> {
  static constexpr const char* name = "Polyhedron_3";

  struct FromList : CGAL::Modifier_base<Mesh::HalfedgeDS> {
    explicit FromList(const bench::Torus& t) : torus(t) {}
    void operator()(Mesh::HalfedgeDS& hds) override {
      CGAL::Polyhedron_incremental_builder_3<Mesh::HalfedgeDS> builder(hds, true);
      builder.begin_surface(torus.positions.size(), torus.quads.size(), 4 * torus.quads.size());
      for (const auto& p : torus.positions) { builder.add_vertex(Kernel::Point_3(p[0], p[1], p[2])); }
      for (const auto& q : torus.quads) { builder.add_facet(q.begin(), q.end()); }
      builder.end_surface();
    }
    const bench::Torus& torus;
  };
  static void build(Mesh& m, const bench::Torus& torus) {
    FromList list(torus);
    m.delegate(list);
  }
  static std::size_t vertices(const Mesh& m) { return m.size_of_vertices(); }
  static std::size_t edges(const Mesh& m) { return m.size_of_halfedges() / 2; }
  static std::size_t faces(const Mesh& m) { return m.size_of_facets(); }
  static bool valid(const Mesh& m) { return m.is_valid(false); }
  static std::vector<Halfedge> halfedge_list(const Mesh& m) {
    std::vector<Halfedge> list;
    for (auto e : CGAL::edges(m)) {
      const Halfedge h = CGAL::halfedge(e, m);
      list.push_back(first_half(m, h) ? h : CGAL::opposite(h, m));
    }
    return list;
  }
  static bool first_half(const Mesh&, Halfedge h) { return &*h < &*h->opposite(); }
  static std::uint64_t walk_faces(const Mesh& m) {
    std::uint64_t sum = 0;
    for (auto f = m.facets_begin(); f != m.facets_end(); ++f) {
      auto h = f->facet_begin();
      do sum += reinterpret_cast<std::uintptr_t>(&*h);
      while (++h != f->facet_begin());
    }
    return sum;
  }
  static std::uint64_t walk_vertices(const Mesh& m) {
    std::uint64_t sum = 0;
    for (auto v = m.vertices_begin(); v != m.vertices_end(); ++v) {
      auto h = v->vertex_begin();
      do sum += reinterpret_cast<std::uintptr_t>(&*h);
      while (++h != v->vertex_begin());
    }
    return sum;
  }
};

}  // namespace

std::vector<std::unique_ptr<bench::Course>> bench::cgal_courses(const Torus& torus) {
  std::vector<std::unique_ptr<Course>> list;
  list.push_back(std::make_unique<CourseOf<SurfaceMesh>>(torus));
  list.push_back(std::make_unique<CourseOf<Polyhedron>>(torus));
  return list;
}
