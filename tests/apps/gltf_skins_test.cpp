// SPDX-License-Identifier: MIT
// glTF: skins, whose vertices go with joints.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "gltf_sample.hpp"
#include "models.hpp"

using gltf_sample::put;
using gltf_sample::Sample;
using models::read;

namespace {

// Adds an accessor; returns its number.
std::size_t add(Sample& sample, const std::string& bytes, int component_type, std::size_t count, const std::string& type) {
  const auto number = [](const std::string& list) { return static_cast<std::size_t>(std::count(list.begin(), list.end(), '{')); };
  sample.binary.resize((sample.binary.size() + 3) / 4 * 4, '\0');
  sample.views.back() = ',';
  sample.views += "{\"buffer\": 0, \"byteOffset\": " + std::to_string(sample.binary.size()) +
                  ", \"byteLength\": " + std::to_string(bytes.size()) + "}]";
  sample.binary += bytes;
  sample.accessors.back() = ',';
  sample.accessors += "{\"bufferView\": " + std::to_string(number(sample.views) - 1) +
                      ", \"componentType\": " + std::to_string(component_type) + ", \"count\": " + std::to_string(count) +
                      ", \"type\": \"" + type + "\"}]";
  return number(sample.accessors) - 1;
}

std::string text_of(const glm::dmat4& m) {
  std::string out = "[";
  for (int i = 0; i < 16; ++i) { out += (i > 0 ? ", " : "") + gltf_sample::formatted(static_cast<float>(m[i / 4][i % 4])); }
  return out + "]";
}

// As the file has it.
glm::dmat4 rounded(const glm::dmat4& m) { return glm::dmat4(glm::mat4(m)); }

struct Skinned {
  Sample sample;
  std::vector<glm::dmat4> joints;  // to the scene
  std::vector<float> weights;      // of joint 0, by vertex; that of joint 1 is the rest
};

// The square, on a node that stands somewhere, with two joints below it, one of them the child of the other.
Skinned skinned(std::mt19937& random, bool bound) {
  const auto number = [&] { return std::uniform_real_distribution<double>(-2.0, 2.0)(random); };
  const auto matrix = [&] {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(number(), number(), 3.0));
    return rounded(glm::rotate(glm::translate(glm::dmat4(1.0), {number(), number(), number()}), number(), axis) *
                   glm::scale(glm::dmat4(1.0), glm::dvec3(0.5 + std::abs(number()))));
  };
  Skinned result;
  Sample& sample = result.sample;
  const glm::dmat4 own = matrix(), first = matrix(), second = matrix();
  result.joints = {own * first, own * first * second};
  sample.nodes = "[{\"mesh\": 0, \"skin\": 0, \"children\": [1], \"matrix\": " + text_of(own) +
                 "}, {\"children\": [2], \"matrix\": " + text_of(first) + "}, {\"matrix\": " + text_of(second) + "}]";
  std::string joints, weights, inverse;
  for (int v = 0; v < 4; ++v) {
    result.weights.push_back(static_cast<float>(random() % 5) / 4.0F);
    for (const int j : {1, 0, 1, 1}) { put(joints, static_cast<std::uint8_t>(j)); }
    for (const float w : {0.0F, result.weights.back(), 1.0F - result.weights.back(), 0.0F}) { put(weights, w); }
  }
  for (const glm::dmat4& joint : result.joints) {
    const glm::mat4 m(glm::inverse(joint));
    for (int i = 0; i < 16; ++i) { put(inverse, m[i / 4][i % 4]); }
  }
  const std::size_t j = add(sample, joints, 5121, 4, "VEC4"), w = add(sample, weights, 5126, 4, "VEC4");
  sample.primitive = "{\"attributes\": {\"POSITION\": 0, \"JOINTS_0\": " + std::to_string(j) + ", \"WEIGHTS_0\": " + std::to_string(w) +
                     "}, \"indices\": 1}";
  sample.more = ", \"skins\": [{\"joints\": [1, 2]";
  if (bound) { sample.more += ", \"inverseBindMatrices\": " + std::to_string(add(sample, inverse, 5126, 2, "MAT4")); }
  sample.more += "}]";
  return result;
}

}  // namespace

TEST_CASE("glTF: a skin in the pose in which it was bound is the mesh as it was drawn, wherever its node stands") {
  const auto seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int run = 0; run < 20; ++run) {
    const Skinned given = skinned(random, true);
    const apps::Model model = read("a.gltf", given.sample.embedded()), plain = read("a.gltf", Sample().embedded());
    REQUIRE(model.positions.size() == plain.positions.size());
    // Numbers of single precision, multiplied by others of size 10 and their inverses.
    for (std::size_t v = 0; v < plain.positions.size(); ++v) { CHECK(glm::length(model.positions[v] - plain.positions[v]) < 1e-4); }
    CHECK(model.corners == plain.corners);
    CHECK(model.notes.empty());
  }
}

TEST_CASE("glTF: vertices of a skin go with their joints, between them by their weights") {
  const auto seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int run = 0; run < 20; ++run) {
    const Skinned given = skinned(random, false);
    const apps::Model model = read("a.gltf", given.sample.embedded()), plain = read("a.gltf", Sample().embedded());
    for (std::size_t v = 0; v < plain.positions.size(); ++v) {
      const glm::dvec4 p(plain.positions[v], 1.0);
      const auto w = static_cast<double>(given.weights[v]);
      const glm::dvec3 expected(w * (given.joints[0] * p) + (1.0 - w) * (given.joints[1] * p));
      CHECK(glm::length(model.positions[v] - expected) < 1e-9 * (1.0 + glm::length(expected)));
    }
  }
}

TEST_CASE("glTF: what is wrong with a skin is told") {
  std::mt19937 random(1);
  const Skinned given = skinned(random, true);
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& reason) {
    Sample changed = given.sample;
    for (std::string* text : {&changed.more, &changed.nodes, &changed.accessors, &changed.primitive}) {
      const std::size_t at = text->find(from);
      if (at != text->npos) { text->replace(at, from.size(), to); }
    }
    CAPTURE(from, to);
    CHECK(models::error("a.gltf", changed.embedded()).find(reason) != std::string::npos);
  };
  refused("\"joints\": [1, 2]", "\"joints\": [1, 7]", "names a node that does not exist");
  refused("\"joints\": [1, 2]", "\"joints\": [1]", "names joint 1 of 1");
  refused("\"skin\": 0", "\"skin\": 3", "no such skin");
  // Joints as numbers of single precision: bytes of which some are no numbers.
  Skinned wild = given;
  wild.sample.binary += std::string(64, '\xff');
  const std::size_t j = add(wild.sample, std::string(64, '\xff'), 5126, 4, "VEC4");
  const std::size_t at = wild.sample.primitive.find("\"JOINTS_0\": ") + 12;
  wild.sample.primitive.replace(at, 1, std::to_string(j));
  CHECK(models::error("a.gltf", wild.sample.embedded()).find("names joint") != std::string::npos);
  refused("\"type\": \"MAT4\"", "\"type\": \"VEC4\"", "MAT4");
}
