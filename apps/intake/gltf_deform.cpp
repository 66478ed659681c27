// SPDX-License-Identifier: MIT
#include "apps/intake/gltf_deform.hpp"

#include <utility>

#include "apps/intake/gltf_nodes.hpp"
#include "apps/text.hpp"

namespace apps::intake {
namespace {

// Four joints and their weights per vertex. A primitive may have several such sets, JOINTS_0, JOINTS_1, ...
struct Influences {
  std::vector<double> joints, weights;
};

// Empty if the primitive has none, or after an error, with a sentence in `fault`.
std::vector<Influences> influences(GltfData& data, const JsonValue& primitive, std::size_t vertices, std::string& fault) {
  std::vector<Influences> sets;
  while (true) {
    const std::string number = std::to_string(sets.size());
    const JsonValue &joints = primitive["attributes"]["JOINTS_" + number], &weights = primitive["attributes"]["WEIGHTS_" + number];
    if (!joints || !weights) { return sets; }
    auto of_joints = data.numbers(joints, 4, fault);
    auto of_weights = of_joints ? data.numbers(weights, 4, fault) : std::nullopt;
    if (!of_weights) { return {}; }
    if (of_joints->size() < 4 * vertices || of_weights->size() < 4 * vertices) {
      fault = "it has fewer joints or weights than vertices";
      return {};
    }
    sets.push_back({std::move(*of_joints), std::move(*of_weights)});
  }
}

}  // namespace

void gltf_morph(const JsonValue& node, const JsonValue& mesh, const JsonValue& primitive, GltfData& data, std::vector<double>& positions,
                Notes& notes, const std::string& place) {
  const JsonValue& weights = node["weights"] ? node["weights"] : mesh["weights"];
  const auto& targets = primitive["targets"].items();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const double weight = weights[t].number(0.0);
    if (weight == 0.0 || !targets[t]["POSITION"]) { continue; }
    std::string fault;
    const auto moved = data.numbers(targets[t]["POSITION"], 3, fault);
    if (!moved || moved->size() != positions.size()) {
      notes.add("morph targets that cannot be read, or have another number of vertices, are left out", place);
      continue;
    }
    for (std::size_t i = 0; i < positions.size(); ++i) { positions[i] += weight * (*moved)[i]; }
  }
}

std::optional<std::vector<glm::dmat4>> gltf_skin(const JsonValue& skin, GltfData& data, const JsonValue& primitive,
                                                 std::span<const glm::dmat4> in_scene, std::size_t vertices, std::string& fault,
                                                 Notes& notes, const std::string& place) {
  const auto fail = [&](std::string sentence) {
    fault = std::move(sentence);
    return std::nullopt;
  };
  const std::vector<Influences> sets = influences(data, primitive, vertices, fault);
  if (sets.empty()) { return std::nullopt; }
  if (!skin) { return fail("there is no such skin"); }
  const std::size_t count = skin["joints"].items().size();
  const auto inverse = skin["inverseBindMatrices"] ? data.numbers(skin["inverseBindMatrices"], 16, fault) : std::nullopt;
  if (!fault.empty()) { return std::nullopt; }
  if (inverse && inverse->size() < 16 * count) { return fail("its skin has fewer inverse bind matrices than joints"); }
  std::vector<glm::dmat4> of_joint;
  for (std::size_t j = 0; j < count; ++j) {
    const auto node = skin["joints"][j].index();
    if (!node || *node >= in_scene.size()) { return fail("its skin names a node that does not exist"); }
    of_joint.push_back(in_scene[*node]);
    if (inverse) { of_joint.back() *= gltf_matrix(std::span<const double, 16>(inverse->data() + 16 * j, 16)); }
  }
  std::vector<glm::dmat4> result(vertices, glm::dmat4(0.0));
  for (std::size_t v = 0; v < vertices; ++v) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 4 * sets.size(); ++k) {
      const auto& [joints, weights] = sets[k / 4];
      const double weight = weights[4 * v + k % 4], joint = joints[4 * v + k % 4];
      if (!(weight > 0.0)) { continue; }
      if (!(joint >= 0.0 && joint < static_cast<double>(count))) {
        return fail("a vertex names joint " + formatted("%.0f", joint) + " of " + std::to_string(count));
      }
      result[v] += weight * of_joint[static_cast<std::size_t>(joint)];
      sum += weight;
    }
    if (sum > 0.0) {
      result[v] /= sum;
      continue;
    }
    const double first = sets[0].joints[4 * v];
    if (!(first >= 0.0 && first < static_cast<double>(count))) { return fail("a vertex has no weight for any joint"); }
    result[v] = of_joint[static_cast<std::size_t>(first)];
    notes.add("vertices of skins without a weight go with their first joint", place);
  }
  return result;
}

}  // namespace apps::intake
