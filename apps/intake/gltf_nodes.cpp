// SPDX-License-Identifier: MIT
#include "apps/intake/gltf_nodes.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "apps/intake/gltf_data.hpp"

namespace apps::intake {

glm::dmat4 gltf_matrix(std::span<const double, 16> columns) {
  glm::dmat4 matrix(1.0);
  for (std::size_t i = 0; i < 16; ++i) { matrix[static_cast<glm::length_t>(i / 4)][static_cast<glm::length_t>(i % 4)] = columns[i]; }
  return matrix;
}

glm::dmat4 gltf_placed(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale) {
  const glm::dmat3 linear = glm::mat3_cast(rotation);
  glm::dmat4 matrix(1.0);
  for (int c = 0; c < 3; ++c) { matrix[c] = glm::dvec4(linear[c] * scale[c], 0.0); }
  matrix[3] = glm::dvec4(translation, 1.0);
  return matrix;
}

glm::dmat4 gltf_matrix(const JsonValue& node) {
  if (const auto m = array_of<16>(node["matrix"])) { return gltf_matrix(std::span<const double, 16>(*m)); }
  const auto t = array_of<3>(node["translation"]).value_or(std::array{0.0, 0.0, 0.0});
  const auto r = array_of<4>(node["rotation"]).value_or(std::array{0.0, 0.0, 0.0, 1.0});
  const auto s = array_of<3>(node["scale"]).value_or(std::array{1.0, 1.0, 1.0});
  return gltf_placed({t[0], t[1], t[2]}, glm::dquat(r[3], r[0], r[1], r[2]), {s[0], s[1], s[2]});
}

std::vector<glm::dmat4> gltf_scene_matrices(const JsonValue& nodes) {
  const std::size_t count = nodes.items().size();
  std::vector<bool> child(count, false), done(count, false);
  const auto each_child = [&](std::size_t node, const auto& body) {
    for (const JsonValue& index : nodes[node]["children"].items()) {
      if (const auto i = index.index(); i && *i < count) { body(*i); }
    }
  };
  for (std::size_t n = 0; n < count; ++n) {
    each_child(n, [&](std::size_t i) { child[i] = true; });
  }
  std::vector<glm::dmat4> matrices(count, glm::dmat4(1.0));
  std::vector<std::size_t> open;
  for (std::size_t root = 0; root < count; ++root) {
    if (child[root]) { continue; }
    matrices[root] = gltf_matrix(nodes[root]);
    done[root] = true;
    open.push_back(root);
    while (!open.empty()) {
      const std::size_t parent = open.back();
      open.pop_back();
      each_child(parent, [&](std::size_t i) {
        if (done[i]) { return; }
        matrices[i] = matrices[parent] * gltf_matrix(nodes[i]);
        done[i] = true;
        open.push_back(i);
      });
    }
  }
  return matrices;
}

}  // namespace apps::intake
