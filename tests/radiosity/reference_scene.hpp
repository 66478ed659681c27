// SPDX-License-Identifier: MIT
#pragma once

// Reads the Monte-Carlo reference scenes (materials, surfaces, patches with radiosities and standard errors) and compares
// a solution with them. A patch of the reference is a cell of the parameters of its surface; the solution is averaged over it by
// points spread over the mesh, hidden parts left out.

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/polygon.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/radiosity.hpp>

#include "json.hpp"

namespace reference {

inline glm::dvec3 point(const json::Value& v) { return {v[0].number(), v[1].number(), v[2].number()}; }

inline std::vector<glm::dvec3> points(const json::Value& v) {
  std::vector<glm::dvec3> result;
  for (const json::Value& p : v.array()) { result.push_back(point(p)); }
  return result;
}

// Quads on the outside of the scene face inwards; the files leave their order open.
inline void face_inwards(std::vector<glm::dvec3>& quad, const std::vector<glm::dvec3>& all) {
  const glm::dvec3 n = glm::cross(quad[1] - quad[0], quad[2] - quad[0]);
  double low = 0.0;
  double high = 0.0;
  for (const glm::dvec3& p : all) {
    const double height = glm::dot(glm::normalize(n), p - quad[0]);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  if (high < 0.01 * -low) { std::reverse(quad.begin(), quad.end()); }
}

struct ReferenceScene {
  radiosity::Scene scene;
  std::vector<std::string> surface_names;  // in the file, one an input surface; empty: not in the file
};

// The quads of one block (its names begin with the same word and '_') as one closed mesh; the bottom that they leave open is added.
inline std::shared_ptr<const raycast::Object> block(const std::vector<std::vector<glm::dvec3>>& quads) {
  std::vector<glm::dvec3> positions;
  std::vector<std::vector<std::uint32_t>> faces;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> open;  // directed edges without a twin
  for (const auto& quad : quads) {
    faces.emplace_back();
    for (const glm::dvec3& p : quad) {
      const auto found = std::find(positions.begin(), positions.end(), p);
      faces.back().push_back(static_cast<std::uint32_t>(found - positions.begin()));
      if (found == positions.end()) { positions.push_back(p); }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t a = faces.back()[i];
      const std::uint32_t b = faces.back()[(i + 1) % 4];
      if (open.erase({b, a}) == 0) { open[{a, b}] = 1; }
    }
  }
  std::vector<std::uint32_t> bottom{open.begin()->first.second};
  while (bottom.size() < open.size()) {
    for (const auto& [edge, count] : open) {
      if (edge.second == bottom.back()) {
        bottom.push_back(edge.first);
        break;
      }
    }
  }
  faces.push_back(bottom);
  return raycast::Mesh::make(positions, faces).object;
}

// The scene with the three channels that start at `channel`.
inline ReferenceScene read_scene(const json::Value& data, std::size_t channel) {
  ReferenceScene result;
  radiosity::Scene& scene = result.scene;
  std::vector<std::vector<glm::dvec3>> block_quads;
  std::map<std::string, std::uint32_t> materials;
  for (const json::Value& m : data["materials"].array()) {
    radiosity::Material material;
    material.name = m["name"].string();
    for (int c = 0; c < 3; ++c) {
      material.reflectance[c] = m["rho"][channel + static_cast<std::size_t>(c)].number();
      material.emission[c] = m["E"][channel + static_cast<std::size_t>(c)].number();
    }
    materials[material.name] = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
  }
  std::vector<glm::dvec3> all;
  for (const json::Value& s : data["surfaces"].array()) {
    if (s["kind"].string() == "quad") {
      for (const glm::dvec3& p : points(s["vertices"])) { all.push_back(p); }
    }
  }
  for (const json::Value& s : data["surfaces"].array()) {
    radiosity::SceneObject object;
    object.name = s["name"].string();
    object.material = {materials.at(s["material"].string())};
    const std::string kind = s["kind"].string();
    if (kind == "quad" && object.name.starts_with("short_")) {
      block_quads.push_back(points(s["vertices"]));
      result.surface_names.push_back(object.name);
      if (block_quads.size() < 5) { continue; }
      object.shape = block(block_quads);
      result.surface_names.emplace_back();
    } else if (kind == "quad") {
      std::vector<glm::dvec3> quad = points(s["vertices"]);
      face_inwards(quad, all);
      const auto flat = raycast::Polygon::make(quad);
      // A quad that is not planar is split along its first diagonal, as the reference does.
      object.shape = flat ? std::shared_ptr<const raycast::Object>{flat.object} : raycast::Mesh::make(quad, {{0, 1, 2}, {0, 2, 3}}).object;
      result.surface_names.insert(result.surface_names.end(), object.shape->sheet_count(), object.name);
    } else if (kind == "sphere") {
      object.shape = raycast::Sphere::make(point(s["center"]), s["radius"].number()).object;
      result.surface_names.push_back(object.name);
    } else if (kind == "cylinder_side") {
      object.shape = raycast::Cylinder::make(point(s["base"]), s["height"].number() * point(s["axis"]), s["radius"].number()).object;
      result.surface_names.insert(result.surface_names.end(), {object.name, "", object.name + "_top"});
    } else {
      continue;  // the disk on top of a cylinder is a sheet of the cylinder
    }
    scene.objects.push_back(std::move(object));
  }
  return result;
}

// Parameters in [0,1]^2 of a point of a quad, corners v0 v1 v2 v3 (bilinear, inverted by Newton).
inline glm::dvec2 quad_parameters(const std::vector<glm::dvec3>& v, const glm::dvec3& p) {
  double s = 0.5;
  double t = 0.5;
  for (int i = 0; i < 10; ++i) {
    const glm::dvec3 q = (1.0 - t) * ((1.0 - s) * v[0] + s * v[1]) + t * ((1.0 - s) * v[3] + s * v[2]);
    const glm::dvec3 ds = (1.0 - t) * (v[1] - v[0]) + t * (v[2] - v[3]);
    const glm::dvec3 dt = (1.0 - s) * (v[3] - v[0]) + s * (v[2] - v[1]);
    const glm::dvec3 r = p - q;
    const double a = glm::dot(ds, ds);
    const double b = glm::dot(ds, dt);
    const double c = glm::dot(dt, dt);
    const double determinant = a * c - b * b;
    s += (c * glm::dot(ds, r) - b * glm::dot(dt, r)) / determinant;
    t += (a * glm::dot(dt, r) - b * glm::dot(ds, r)) / determinant;
  }
  return {s, t};
}

struct Comparison {
  double relative_l2 = 0.0;   // area-weighted over the patches, all channels together, lights left out
  double worst = 0.0;         // largest |B - reference| of a patch relative to its own reference
  double worst_to_max = 0.0;  // the same relative to the largest reference
  std::string worst_patch;
  double reference_noise = 0.0;  // area-weighted relative L2 of the standard errors
};

// Compares the mesh of a solution with the patches of the file. `leaf`: the constants on the leaves instead of the picture.
inline Comparison compare(const json::Value& data, std::size_t channel, const ReferenceScene& reference_scene,
                          const radiosity::Solution& solution, bool leaf) {
  const radiosity::Scene& scene = reference_scene.scene;
  const auto inputs = radiosity::surfaces(scene);
  const raycast::Scene objects = radiosity::compile(scene, solution.frame);
  const radiosity::Mesh& mesh = solution.mesh;

  // Which patches belong to which input surface?
  struct Cell {
    const json::Value* patch;
    double weight = 0.0;
    radiosity::Color sum{0.0};
  };
  std::map<std::string, const json::Value*> surface_data;
  std::map<std::string, std::vector<Cell>> cells;
  for (const json::Value& s : data["surfaces"].array()) { surface_data[s["name"].string()] = &s; }
  for (const json::Value& p : data["patches"].array()) { cells[p["surface"].string()].push_back({&p}); }

  const auto find_cell = [&](const std::string& name, const glm::dvec3& p) -> Cell* {
    const json::Value& s = *surface_data.at(name);
    const std::string kind = s["kind"].string();
    const auto angle = [](double y, double x) { return std::fmod(std::atan2(y, x) + 2.0 * std::numbers::pi, 2.0 * std::numbers::pi); };
    for (Cell& cell : cells[name]) {
      const json::Value& patch = *cell.patch;
      if (kind == "quad") {
        const auto n = static_cast<int>(s["grid"].number());
        const glm::dvec2 st = quad_parameters(points(s["vertices"]), p);
        const int i = std::clamp(static_cast<int>(st.x * n), 0, n - 1);
        const int j = std::clamp(static_cast<int>(st.y * n), 0, n - 1);
        return &cells[name][static_cast<std::size_t>(i * n + j)];
      }
      if (kind == "disk") { return &cell; }
      if (kind == "sphere") {
        const glm::dvec3 d = (p - point(s["center"])) / s["radius"].number();
        const double phi = angle(d.y, d.x);
        if (d.z >= patch["cos_theta"][0].number() && d.z <= patch["cos_theta"][1].number() && phi >= patch["phi"][0].number() &&
            phi <= patch["phi"][1].number()) {
          return &cell;
        }
      } else {
        const glm::dvec3 d = p - point(s["base"]);
        const double phi = angle(d.y, d.x);
        if (d.z >= patch["height"][0].number() - 1e-9 && d.z <= patch["height"][1].number() + 1e-9 && phi >= patch["phi"][0].number() &&
            phi <= patch["phi"][1].number()) {
          return &cell;
        }
      }
    }
    return nullptr;
  };

  double total = 0.0;
  const auto corner = [&](std::uint32_t c) { return mesh.positions[mesh.corners[c].vertex]; };
  for (const radiosity::MeshFace& face : mesh.faces) {
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      const glm::dvec3 a = corner(face.first_corner);
      total += 0.5 * glm::length(glm::cross(corner(face.first_corner + k) - a, corner(face.first_corner + k + 1) - a));
    }
  }
  for (const radiosity::MeshFace& face : mesh.faces) {
    const radiosity::InputSurface& input = inputs[face.surface];
    if (!radiosity::is_black(scene.materials[input.material].emission)) { continue; }
    const std::string& name = reference_scene.surface_names[face.surface];
    if (name.empty()) { continue; }
    for (std::uint32_t k = 1; k + 1 < face.corner_count; ++k) {
      const std::uint32_t c[3] = {face.first_corner, face.first_corner + k, face.first_corner + k + 1};
      const double area = 0.5 * glm::length(glm::cross(corner(c[1]) - corner(c[0]), corner(c[2]) - corner(c[0])));
      const int side = std::clamp(static_cast<int>(std::sqrt(200000.0 * area / total)), 2, 64);
      for (int i = 0; i < side * side; ++i) {  // centres of side^2 equal triangles
        const int row = static_cast<int>(std::sqrt(static_cast<double>(i)));
        const int in_row = i - row * row;
        const bool up = in_row % 2 == 0;
        const double u = (in_row / 2 + (up ? 1.0 / 3.0 : 2.0 / 3.0)) / side;
        const double r = (row + (up ? 2.0 / 3.0 : 1.0 / 3.0)) / side;
        const double w[3] = {1.0 - r, r - u, u};
        glm::dvec3 p{0.0};
        radiosity::Color shown{0.0};
        for (int q = 0; q < 3; ++q) {
          p += w[q] * corner(c[q]);
          shown += w[q] * mesh.corners[c[q]].radiosity;
        }
        const raycast::SurfacePoint on =
            objects.object(input.object).project(input.sheet, (p - solution.frame.centre) * solution.frame.scale);
        if (objects.covered(on.position, on.normal, input.object)) { continue; }
        if (Cell* cell = find_cell(name, solution.frame.to_scene(on.position))) {
          cell->weight += area / (side * side);
          cell->sum += area / (side * side) * (leaf ? face.radiosity : shown);
        }
      }
    }
  }

  Comparison result;
  double square = 0.0;
  double reference = 0.0;
  double noise = 0.0;
  double largest = 0.0;
  double worst_difference = 0.0;
  for (const auto& [name, list] : cells) {
    for (const Cell& cell : list) {
      const double exposed = (*cell.patch)["exposed_fraction"].number();
      if (!(cell.weight > 0.0) || exposed < 0.01) { continue; }
      const double weight = (*cell.patch)["area"].number() * exposed;
      for (int k = 0; k < 3; ++k) {
        const double expected = (*cell.patch)["B"][channel + static_cast<std::size_t>(k)].number();
        const double error = (*cell.patch)["B_se"][channel + static_cast<std::size_t>(k)].number();
        const double difference = std::abs(cell.sum[k] / cell.weight - expected);
        square += weight * difference * difference;
        reference += weight * expected * expected;
        noise += weight * error * error;
        largest = std::max(largest, expected);
        worst_difference = std::max(worst_difference, difference);
        if (expected > 0.0 && difference / expected > result.worst) {
          result.worst = difference / expected;
          result.worst_patch = name + " #" + std::to_string(&cell - list.data()) + " channel " + std::to_string(k) + ": " +
                               std::to_string(cell.sum[k] / cell.weight) + " for " + std::to_string(expected) + " exposed " +
                               std::to_string(exposed);
        }
      }
    }
  }
  result.relative_l2 = std::sqrt(square / reference);
  result.worst_to_max = worst_difference / largest;
  result.reference_noise = std::sqrt(noise / reference);
  return result;
}

}  // namespace reference
