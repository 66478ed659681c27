// SPDX-License-Identifier: MIT
// brep/csg in the bench.
#include <brep/brep.hpp>
#include <brep/builder.hpp>
#include <brep/builder_input.hpp>
#include <brep/csg/csg.hpp>

#include <algorithm>

#include "bench.hpp"

namespace bench {
namespace {

struct Vertex {
  glm::dvec3 position{0.0};
};
struct Face {
  std::uint32_t sheet = 0;
};
using Mesh = brep::BRep<Vertex, brep::NoData, Face>;

class Halflight : public Engine {
 public:
  [[nodiscard]] std::string name() const override { return "halflight"; }

  std::optional<Outcome> run(const Case& c) override {
    glm::dvec3 lo(1e30), hi(-1e30);
    std::vector<Mesh> meshes;
    for (const Polygons& polygons : c.operands) {
      brep::Builder builder;
      for (const auto& p : polygons.positions) {
        const glm::dvec3 at(p[0], p[1], p[2]);
        lo = glm::min(lo, at);
        hi = glm::max(hi, at);
        builder.vertex(at);
      }
      for (const auto& face : polygons.faces) { builder.face(std::span<const std::uint32_t>(face), 0); }
      meshes.push_back(std::move(*brep::close<Mesh>(builder).brep));
    }
    Outcome outcome;
    const double begin = thread_seconds();
    const brep::csg::Grid grid(lo, hi);
    std::vector<brep::csg::Solid<std::uint32_t>> solids;
    for (const Mesh& mesh : meshes) {
      auto solid = brep::csg::make_solid(mesh, grid);
      if (!solid) { return Outcome{.failed = true}; }
      solids.push_back(std::move(*solid));
    }
    const double ready = thread_seconds();
    brep::csg::Solid<std::uint32_t> result = solids[0];
    for (std::size_t i = 1; i < solids.size(); ++i) {
      auto next = c.operation == Operation::unite       ? brep::csg::unite(result, solids[i])
                  : c.operation == Operation::intersect ? brep::csg::intersect(result, solids[i])
                                                        : brep::csg::subtract(result, solids[i]);
      if (!next) { return Outcome{.failed = true}; }
      result = std::move(*next);
    }
    const double done = thread_seconds();
    const Mesh mesh = brep::csg::to_brep<Mesh>(result);
    outcome.seconds = done - ready;
    outcome.in_and_out = thread_seconds() - done + ready - begin;
    outcome.volume = brep::csg::volume(result);
    outcome.faces = mesh.face_count();
    outcome.vertices = mesh.vertex_count();
    return outcome;
  }
};

}  // namespace

std::unique_ptr<Engine> halflight_engine() { return std::make_unique<Halflight>(); }

}  // namespace bench
