// SPDX-License-Identifier: MIT
// CGAL's corefinement with exact points (EPECK), which may be chained, and with rounded ones (EPICK).
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

#include "bench.hpp"

namespace bench {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

template <class Kernel, bool exact>
class Cgal : public Engine {
 public:
  using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;

  [[nodiscard]] std::string name() const override { return exact ? "CGAL EPECK" : "CGAL EPICK"; }

  std::optional<Outcome> run(const Case& c) override {
    // Chains of rounded coplanar cuts end the process (notes in README.md); level 3 takes minutes.
    const bool sponge = c.name.rfind("Menger", 0) == 0;
    if (sponge && (!exact || c.operands.size() > 100)) { return std::nullopt; }
    Outcome outcome;
    const double begin = thread_seconds();
    std::vector<Mesh> meshes;
    for (const Polygons& polygons : c.operands) { meshes.push_back(make(polygons)); }
    const double ready = thread_seconds();
    bool good = true;
    Mesh& result = meshes[0];
    for (std::size_t i = 1; i < meshes.size() && good; ++i) {
      good = c.operation == Operation::unite       ? pmp::corefine_and_compute_union(result, meshes[i], result)
             : c.operation == Operation::intersect ? pmp::corefine_and_compute_intersection(result, meshes[i], result)
                                                   : pmp::corefine_and_compute_difference(result, meshes[i], result);
    }
    outcome.seconds = thread_seconds() - ready;
    outcome.in_and_out = ready - begin;
    outcome.failed = !good;
    if (!good) { return outcome; }
    outcome.volume = CGAL::to_double(pmp::volume(result));
    outcome.faces = result.number_of_faces();
    outcome.vertices = result.number_of_vertices();
    return outcome;
  }

 private:
  static Mesh make(const Polygons& polygons) {
    Mesh mesh;
    std::vector<typename Mesh::Vertex_index> v;
    for (const auto& p : polygons.positions) { v.push_back(mesh.add_vertex(typename Kernel::Point_3(p[0], p[1], p[2]))); }
    for (const auto& face : polygons.faces) {
      for (std::size_t i = 2; i < face.size(); ++i) { mesh.add_face(v[face[0]], v[face[i - 1]], v[face[i]]); }
    }
    return mesh;
  }
};

}  // namespace

std::unique_ptr<Engine> cgal_exact_engine() { return std::make_unique<Cgal<CGAL::Exact_predicates_exact_constructions_kernel, true>>(); }
std::unique_ptr<Engine> cgal_inexact_engine() {
  return std::make_unique<Cgal<CGAL::Exact_predicates_inexact_constructions_kernel, false>>();
}

}  // namespace bench
