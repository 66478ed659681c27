// SPDX-License-Identifier: MIT
//
// Error against CPU time on the Cornell-like box of tests/data/box.json (16 quads and a light, path-traced means of 8 x 8
// cells a quad). One row a setting; one thread; the audit left out. Errors are of cell means, of the constants of the leaves and of
// the picture, which is interpolated between them: relative L2 over all cells, worst cell over the brightest.
//
//   bench_radiosity [FILE]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <raycast/object.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/scene.hpp>

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/frame.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>

#include "json.hpp"

namespace {

struct Quad {
  std::string name;
  std::vector<glm::dvec3> corners;
  double reflectance = 0.0, emission = 0.0, area = 0.0;
  std::vector<double> radiosity, error;  // of the cells: mean and standard error
};

struct Box {
  std::vector<Quad> quads;
  std::size_t grid = 0;
  radiosity::Scene scene;
  std::vector<std::size_t> quad_of_surface;  // quads.size(): none
};

Box read_box(const std::string& path) {
  Box box;
  const json::Value data = json::parse_file(path);
  box.grid = static_cast<std::size_t>(data["grid"].number());
  for (const json::Value& q : data["quads"].array()) {
    Quad quad{q["name"].string(), {}, q["rho"].number(), q["E"].number(), q["area"].number(), {}, {}};
    for (const json::Value& p : q["vertices"].array()) { quad.corners.emplace_back(p[0].number(), p[1].number(), p[2].number()); }
    if (const json::Value* b = q.find("B")) {
      for (const json::Value& x : b->array()) { quad.radiosity.push_back(x.number()); }
      for (const json::Value& x : q["B_se"].array()) { quad.error.push_back(x.number()); }
    }
    box.quads.push_back(std::move(quad));
  }
  // Walls and light are polygons; the five quads of a block and the bottom that they leave open are one solid.
  radiosity::Scene& scene = box.scene;
  for (std::size_t i = 0; i < box.quads.size(); ++i) {
    const Quad& quad = box.quads[i];
    radiosity::Material material;
    material.name = quad.name;
    material.reflectance = radiosity::Color{quad.reflectance};
    material.emission = radiosity::Color{quad.emission};
    scene.materials.push_back(material);
    radiosity::SceneObject object;
    object.name = quad.name;
    object.material = {static_cast<std::uint32_t>(i)};
    if (!quad.name.ends_with(" top")) {
      if (quad.name.find(' ') != std::string::npos) { continue; }
      object.shape = raycast::Polygon::make(quad.corners).object;
      box.quad_of_surface.push_back(i);
      scene.objects.push_back(std::move(object));
      continue;
    }
    std::vector<glm::dvec3> positions = box.quads[i].corners;
    for (std::size_t s = 1; s < 5; ++s) { positions.push_back(box.quads[i + s].corners[0]); }
    object.shape =
        raycast::Mesh::make(positions, {{0, 1, 2, 3}, {4, 5, 1, 0}, {5, 6, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}, {7, 6, 5, 4}}).object;
    for (std::size_t s = 0; s < 5; ++s) { box.quad_of_surface.push_back(i + s); }
    box.quad_of_surface.push_back(box.quads.size());
    scene.objects.push_back(std::move(object));
  }
  return box;
}

struct Error {
  double relative_l2 = 0.0, worst = 0.0;
  std::string worst_cell;
};

enum class Result { leaves, picture };

Error compare(const Box& box, const radiosity::Solution& solution, Result result) {
  const auto inputs = radiosity::surfaces(box.scene);
  const raycast::Scene objects = radiosity::compile(box.scene, solution.frame);
  const radiosity::Mesh& mesh = solution.mesh;
  const std::size_t cells = box.grid * box.grid;
  std::vector<std::vector<double>> sum(box.quads.size(), std::vector<double>(cells, 0.0));
  for (const radiosity::MeshFace& face : mesh.faces) {
    const std::size_t index = box.quad_of_surface[face.surface];
    if (index == box.quads.size()) { continue; }
    const Quad& quad = box.quads[index];
    const glm::dvec3 s = quad.corners[1] - quad.corners[0], t = quad.corners[3] - quad.corners[0];
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      const std::uint32_t c[3] = {face.first_corner, face.first_corner + k, face.first_corner + k + 1};
      glm::dvec3 p[3];
      double b[3];
      for (int i = 0; i < 3; ++i) {
        p[i] = mesh.positions[mesh.corners[c[i]].vertex];
        b[i] = (result == Result::leaves ? face.radiosity : mesh.corners[c[i]].radiosity).x;
      }
      const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
      const int side = std::clamp(static_cast<int>(std::sqrt(60000.0 * area / quad.area)), 2, 64);
      for (int i = 0; i < side * side; ++i) {  // centres of side^2 equal triangles
        const int row = static_cast<int>(std::sqrt(static_cast<double>(i))), in_row = i - row * row;
        const bool up = in_row % 2 == 0;
        const double u = (in_row / 2 + (up ? 1.0 / 3.0 : 2.0 / 3.0)) / side, r = (row + (up ? 2.0 / 3.0 : 1.0 / 3.0)) / side;
        const double w[3] = {1.0 - r, r - u, u};
        const glm::dvec3 x = w[0] * p[0] + w[1] * p[1] + w[2] * p[2];
        const radiosity::InputSurface& input = inputs[face.surface];
        const raycast::SurfacePoint on =
            objects.object(input.object).project(input.sheet, (x - solution.frame.centre) * solution.frame.scale);
        if (objects.covered(on.position, on.normal, input.object)) { continue; }
        const auto cell = [&](const glm::dvec3& axis) {
          const double at = glm::dot(x - quad.corners[0], axis) / glm::dot(axis, axis) * static_cast<double>(box.grid);
          return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(box.grid) - 1.0));
        };
        sum[index][cell(t) * box.grid + cell(s)] += area / (side * side) * (w[0] * b[0] + w[1] * b[1] + w[2] * b[2]);
      }
    }
  }
  Error error;
  double square = 0.0, reference = 0.0, brightest = 0.0;
  for (const Quad& quad : box.quads) {
    for (const double b : quad.radiosity) { brightest = std::max(brightest, quad.emission > 0.0 ? 0.0 : b); }
  }
  for (std::size_t q = 0; q < box.quads.size(); ++q) {
    const Quad& quad = box.quads[q];
    if (quad.emission > 0.0) { continue; }
    const double cell_area = quad.area / static_cast<double>(cells);
    for (std::size_t i = 0; i < cells; ++i) {
      const double wrong = sum[q][i] / cell_area - quad.radiosity[i];
      square += cell_area * wrong * wrong;
      reference += cell_area * quad.radiosity[i] * quad.radiosity[i];
      if (std::abs(wrong) / brightest <= error.worst) { continue; }
      error.worst = std::abs(wrong) / brightest;
      error.worst_cell = quad.name + " " + std::to_string(i / box.grid) + "," + std::to_string(i % box.grid) + " of " +
                         std::to_string(quad.radiosity[i]) + " off " + std::to_string(wrong);
    }
  }
  error.relative_l2 = std::sqrt(square / reference);
  return error;
}

}  // namespace

int main(int argc, char** argv) {
  const Box box = read_box(argc > 1 ? argv[1] : HALFLIGHT_TEST_DATA "/box.json");
  std::printf("%-12s %9s %9s %9s %7s %8s   %-17s   %-17s  %s\n", "refinement", "setting", "links", "rays", "MB", "CPU s",
              "leaves L2 / worst", "picture L2 / worst", "worst cell of the leaves");
  const auto row = [&](const char* name, double setting, radiosity::Options options) {
    options.audit_points = 0;
    options.threads = 1;
    const radiosity::Outcome outcome = radiosity::solve(box.scene, options);
    if (!outcome.solution) {
      std::printf("%s\n", outcome.failure.sentences.front().c_str());
      return;
    }
    const radiosity::Audit& audit = outcome.solution->audit;
    const Error leaves = compare(box, *outcome.solution, Result::leaves), picture = compare(box, *outcome.solution, Result::picture);
    std::printf("%-12s %9.3g %9llu %9llu %7.1f %8.3f   %7.2f%% %7.2f%%   %7.2f%% %7.2f%%   %s\n", name, setting,
                static_cast<unsigned long long>(audit.links), static_cast<unsigned long long>(audit.rays),
                static_cast<double>(audit.bytes) * 1e-6, audit.cpu_seconds, 100.0 * leaves.relative_l2, 100.0 * leaves.worst,
                100.0 * picture.relative_l2, 100.0 * picture.worst, leaves.worst_cell.c_str());
  };
  for (const double epsilon : {0.08, 0.04, 0.02, 0.0095, 0.005, 0.0025}) {
    const radiosity::Options options{.epsilon = epsilon, .min_area = 0.2 * epsilon};
    row("a priori", epsilon, options);
  }
  for (const bool clusters : {false, true}) {
    for (const double target : {0.08, 0.04, 0.02, 0.01}) {
      radiosity::Options options{.refinement = radiosity::Refinement::a_posteriori, .target = target};
      if (clusters) { options.cluster_from = 2; }
      row(clusters ? "  clusters" : "a posteriori", target, options);
    }
  }
}
