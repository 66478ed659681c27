// SPDX-License-Identifier: MIT
// OpenMesh in the course. It deletes lazily: killed elements stay until the garbage collection, which is not timed here. A
// half-edge stands for the corner where it ends.

#include <algorithm>
#include <sstream>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Utils/MeshCheckerT.hh>

#include "bench.hpp"

namespace {

struct OpenMeshKernel {
  using Mesh = OpenMesh::PolyMesh_ArrayKernelT<>;
  using Face = OpenMesh::FaceHandle;
  using Vertex = OpenMesh::VertexHandle;
  using Halfedge = OpenMesh::HalfedgeHandle;
  static constexpr const char* name = "OpenMesh";

  static void build(Mesh& m, const bench::Torus& torus) {
    m.request_vertex_status();
    m.request_edge_status();
    m.request_halfedge_status();
    m.request_face_status();
    const std::size_t n = torus.quads.size();
    m.reserve(n, 2 * n, n);
    for (const auto& p : torus.positions) { m.add_vertex({p[0], p[1], p[2]}); }
    for (const auto& q : torus.quads) {
      m.add_face(Vertex(static_cast<int>(q[0])), Vertex(static_cast<int>(q[1])), Vertex(static_cast<int>(q[2])),
                 Vertex(static_cast<int>(q[3])));
    }
  }
  static std::size_t vertices(const Mesh& m) { return m.n_vertices(); }
  static std::size_t edges(const Mesh& m) { return m.n_edges(); }
  static std::size_t faces(const Mesh& m) { return m.n_faces(); }
  static bool valid(const Mesh& m) {
    std::ostringstream faults;
    return OpenMesh::Utils::MeshCheckerT<Mesh>(m).check(OpenMesh::Utils::MeshCheckerT<Mesh>::CHECK_ALL, faults);
  }
  static void collect(Mesh& m) { m.garbage_collection(); }
  static std::vector<Face> face_list(const Mesh& m) { return std::vector<Face>(m.faces_begin(), m.faces_end()); }
  static std::vector<Vertex> vertex_list(const Mesh& m) { return std::vector<Vertex>(m.vertices_begin(), m.vertices_end()); }
  static std::vector<Halfedge> halfedge_list(const Mesh& m) {
    std::vector<Halfedge> list;
    for (auto e : m.edges()) { list.push_back(m.halfedge_handle(e, 0)); }
    return list;
  }
  static bool first_half(const Mesh&, Halfedge h) { return h.idx() % 2 == 0; }
  static Halfedge next(const Mesh& m, Halfedge h) { return m.next_halfedge_handle(h); }
  static Halfedge loop(const Mesh& m, Face f) { return m.halfedge_handle(f); }

  static void split_join_face(Mesh& m, Face f) {
    const Halfedge a = m.halfedge_handle(f), b = m.next_halfedge_handle(m.next_halfedge_handle(a));
    m.remove_edge(m.edge_handle(m.insert_edge(a, m.next_halfedge_handle(b))));
  }
  static void split_join_edge(Mesh& m, Halfedge h) {
    split_edge(m, h);
    m.collapse(m.opposite_halfedge_handle(m.prev_halfedge_handle(h)));
  }
  static void split_edge(Mesh& m, Halfedge h) { m.split_edge(m.edge_handle(h), m.add_vertex(Mesh::Point(0, 0, 0))); }
  static void refine_face(Mesh& m, Halfedge m0, Halfedge m1, Halfedge m2, Halfedge m3) {
    const Halfedge h = m.insert_edge(m0, m.next_halfedge_handle(m2));
    split_edge(m, h);
    m.insert_edge(m.prev_halfedge_handle(h), m.next_halfedge_handle(m3));
    m.insert_edge(m.opposite_halfedge_handle(h), m.next_halfedge_handle(m1));
  }
  static std::uint64_t walk_faces(const Mesh& m) {
    std::uint64_t sum = 0;
    for (auto f = m.faces_begin(); f != m.faces_end(); ++f) {
      for (auto h = m.cfh_iter(*f); h.is_valid(); ++h) { sum += static_cast<std::uint64_t>(h->idx()); }
    }
    return sum;
  }
  static std::uint64_t walk_vertices(const Mesh& m) {
    std::uint64_t sum = 0;
    for (auto v = m.vertices_begin(); v != m.vertices_end(); ++v) {
      for (auto h = m.cvoh_iter(*v); h.is_valid(); ++h) { sum += static_cast<std::uint64_t>(h->idx()); }
    }
    return sum;
  }
};

}  // namespace

std::vector<std::unique_ptr<bench::Course>> bench::openmesh_courses(const Torus& torus) {
  std::vector<std::unique_ptr<Course>> list;
  list.push_back(std::make_unique<CourseOf<OpenMeshKernel>>(torus));
  return list;
}
