// SPDX-License-Identifier: MIT
#include "apps/intake/gltf_nodes.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "apps/text.hpp"

namespace apps::intake {
namespace {

glm::dmat4 matrix_of(std::span<const double, 16> columns) {
  glm::dmat4 matrix(1.0);
  for (std::size_t i = 0; i < 16; ++i) { matrix[static_cast<glm::length_t>(i / 4)][static_cast<glm::length_t>(i % 4)] = columns[i]; }
  return matrix;
}

}  // namespace

glm::dmat4 gltf_placed(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale) {
  const glm::dmat3 linear = glm::mat3_cast(rotation);
  glm::dmat4 matrix(1.0);
  for (int c = 0; c < 3; ++c) { matrix[c] = glm::dvec4(linear[c] * scale[c], 0.0); }
  matrix[3] = glm::dvec4(translation, 1.0);
  return matrix;
}

glm::dmat4 gltf_matrix(const JsonValue& node) {
  if (const auto m = array_of<16>(node["matrix"])) { return matrix_of(*m); }
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

std::optional<std::vector<glm::dmat4>> gltf_skin(const JsonValue& skin, GltfData& data, const JsonValue& primitive,
                                                 std::span<const glm::dmat4> in_scene, std::size_t vertices, std::string& fault) {
  const auto fail = [&](std::string sentence) {
    fault = std::move(sentence);
    return std::nullopt;
  };
  const JsonValue &of_joints = primitive["attributes"]["JOINTS_0"], &of_weights = primitive["attributes"]["WEIGHTS_0"];
  if (!of_joints || !of_weights) { return std::nullopt; }
  if (!skin) { return fail("there is no such skin"); }
  const auto joints = data.numbers(of_joints, 4, fault), weights = joints ? data.numbers(of_weights, 4, fault) : std::nullopt;
  if (!weights) { return std::nullopt; }
  if (joints->size() < 4 * vertices || weights->size() < 4 * vertices) { return fail("it has fewer joints or weights than vertices"); }
  const std::size_t count = skin["joints"].items().size();
  const auto inverse = skin["inverseBindMatrices"] ? data.numbers(skin["inverseBindMatrices"], 16, fault) : std::nullopt;
  if (!fault.empty()) { return std::nullopt; }
  if (inverse && inverse->size() < 16 * count) { return fail("its skin has fewer inverse bind matrices than joints"); }
  std::vector<glm::dmat4> of_joint;
  for (std::size_t j = 0; j < count; ++j) {
    const auto node = skin["joints"][j].index();
    if (!node || *node >= in_scene.size()) { return fail("its skin names a node that does not exist"); }
    of_joint.push_back(in_scene[*node]);
    if (inverse) { of_joint.back() *= matrix_of(std::span<const double, 16>(inverse->data() + 16 * j, 16)); }
  }
  std::vector<glm::dmat4> result(vertices, glm::dmat4(0.0));
  for (std::size_t v = 0; v < vertices; ++v) {
    double sum = 0.0;
    for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
      const double weight = (*weights)[k], joint = (*joints)[k];
      if (!(weight > 0.0)) { continue; }
      if (!(joint >= 0.0 && joint < static_cast<double>(count))) {
        return fail("a vertex names joint " + formatted("%.0f", joint) + " of " + std::to_string(count));
      }
      result[v] += weight * of_joint[static_cast<std::size_t>(joint)];
      sum += weight;
    }
    if (!(sum > 0.0)) { return fail("a vertex has no weight for any joint"); }
    result[v] /= sum;
  }
  return result;
}

}  // namespace apps::intake
