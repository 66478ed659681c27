// SPDX-License-Identifier: MIT
#include "apps/scene_file/sheet_sides.hpp"

#include <cstddef>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include <brep/polygon.hpp>
#include <brep/union_find.hpp>

namespace apps::scene_file {

FaceLists with_sides_parted(const FaceLists& mesh) {
  constexpr double tol_flat = 1e-9;  // of 1 + the cosine between the normals
  std::vector<glm::dvec3> normals, outline;
  std::multimap<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;  // directed, with their faces
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<std::uint32_t>& face = mesh.faces[f];
    outline.clear();
    for (std::size_t i = 0; i < face.size(); ++i) {
      outline.push_back(mesh.positions[face[i]]);
      edges.emplace(std::pair(face[i], face[(i + 1) % face.size()]), f);
    }
    normals.push_back(glm::normalize(brep::vector_area(outline)));
  }
  brep::detail::UnionFind joined(mesh.faces.size());
  for (const auto& [edge, f] : edges) {
    const auto [first, last] = edges.equal_range({edge.second, edge.first});
    for (auto other = first; other != last; ++other) {
      if (glm::dot(normals[f], normals[other->second]) > tol_flat - 1.0) { joined.unite(f, other->second); }
    }
  }
  FaceLists parted;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;  // of a vertex for the faces that belong together
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    parted.faces.emplace_back();
    for (const std::uint32_t v : mesh.faces[f]) {
      const auto [copy, is_new] = copies.emplace(std::pair(joined.find(f), v), static_cast<std::uint32_t>(parted.positions.size()));
      if (is_new) { parted.positions.push_back(mesh.positions[v]); }
      parted.faces.back().push_back(copy->second);
    }
  }
  return parted;
}

}  // namespace apps::scene_file
