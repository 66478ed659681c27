// SPDX-License-Identifier: MIT
// glTF: morph targets, and skins, whose vertices go with joints.

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
#include "seed.hpp"

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
  const auto seed = test::seed();
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
  const auto seed = test::seed();
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

TEST_CASE("glTF: joints and weights of a second set count as those of the first") {
  const auto seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int run = 0; run < 20; ++run) {
    const Skinned given = skinned(random, false);
    const apps::Model one = read("a.gltf", given.sample.embedded());
    // The same weights, some of them in the second set.
    Skinned two = given;
    std::string joints[2], weights[2];
    for (const float w : given.weights) {
      const float part = static_cast<float>(random() % 3) / 2.0F;
      for (std::size_t set = 0; set < 2; ++set) {
        const float share = set == 0 ? part : 1.0F - part;
        for (const int j : {0, 1, 1, 1}) { put(joints[set], static_cast<std::uint8_t>(j)); }
        for (const float x : {w * share, (1.0F - w) * share, 0.0F, 0.0F}) { put(weights[set], x); }
      }
    }
    std::string attributes = "{\"attributes\": {\"POSITION\": 0";
    for (std::size_t set = 0; set < 2; ++set) {
      attributes += ", \"JOINTS_" + std::to_string(set) + "\": " + std::to_string(add(two.sample, joints[set], 5121, 4, "VEC4"));
      attributes += ", \"WEIGHTS_" + std::to_string(set) + "\": " + std::to_string(add(two.sample, weights[set], 5126, 4, "VEC4"));
    }
    two.sample.primitive = attributes + "}, \"indices\": 1}";
    const apps::Model model = read("a.gltf", two.sample.embedded());
    for (std::size_t v = 0; v < one.positions.size(); ++v) {
      CHECK(glm::length(model.positions[v] - one.positions[v]) < 1e-9 * (1.0 + glm::length(one.positions[v])));
    }
  }
}

TEST_CASE("glTF: a vertex of a skin without a weight goes with its first joint, and that is told") {
  std::mt19937 random(3);
  Skinned given = skinned(random, false);
  std::string weights;
  for (int v = 0; v < 4; ++v) {
    for (int k = 0; k < 4; ++k) { put(weights, v != 2 && k == 1 ? 1.0F : 0.0F); }
  }
  const std::size_t w = add(given.sample, weights, 5126, 4, "VEC4");
  const std::size_t at = given.sample.primitive.find("\"WEIGHTS_0\": ") + 13;
  given.sample.primitive.replace(at, 1, std::to_string(w));
  const apps::Model model = read("a.gltf", given.sample.embedded()), plain = read("a.gltf", Sample().embedded());
  CHECK(models::noted(model.notes, "without a weight go with their first joint"));
  for (std::size_t v = 0; v < 4; ++v) {  // joints are 1, 0, 1, 1
    const glm::dvec3 expected(given.joints[v == 2 ? 1 : 0] * glm::dvec4(plain.positions[v], 1.0));
    CHECK(glm::length(model.positions[v] - expected) < 1e-9 * (1.0 + glm::length(expected)));
  }
}

// The weights of the node count before those of the mesh; a target may be sparse, and there may be a skin, too.
TEST_CASE("glTF: a vertex is moved by the weighted sum of its displacements, before its skin and its node move it") {
  const auto seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<float>(std::uniform_real_distribution<double>(-2.0, 2.0)(random)); };
  for (int run = 0; run < 20; ++run) {
    Skinned given = skinned(random, false);
    const bool has_skin = run % 2 == 0, of_node = run % 3 == 0;
    const glm::dmat4 own = glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 2.0, 3.0));
    if (!has_skin) {
      given.sample = Sample();
      given.sample.nodes = "[{\"mesh\": 0, \"translation\": [1, 2, 3]}]";
    }
    std::vector<glm::dvec3> expected = read("a.gltf", Sample().embedded()).positions;
    std::string targets, weights;
    for (int t = 0; t < 3; ++t) {
      const float weight = t == 1 ? 0.0F : number();
      std::vector<std::string> moves(4);
      std::string all;
      for (std::size_t v = 0; v < 4; ++v) {
        const bool moved = t < 2 || v == 2;  // the last one is sparse
        for (int k = 0; k < 3; ++k) {
          const float x = moved ? number() : 0.0F;
          put(moves[v], x);
          expected[v][k] += static_cast<double>(weight) * static_cast<double>(x);
        }
        all += moves[v];
      }
      const std::size_t accessor = add(given.sample, all, 5126, 4, "VEC3");
      if (t == 2) {
        const std::string sparse = gltf_sample::substitution(given.sample, {2}, moves, true);
        std::string& list = given.sample.accessors;
        const std::size_t last = list.rfind('{');
        list.replace(last, list.find("\"componentType\"", last) - last, "{" + sparse);
      }
      targets += (t > 0 ? ", " : "") + ("{\"NORMAL\": 77, \"POSITION\": " + std::to_string(accessor)) + "}";
      weights += (t > 0 ? ", " : "") + gltf_sample::formatted(weight);
    }
    std::string& primitive = given.sample.primitive;
    primitive.insert(primitive.size() - 1, ", \"targets\": [" + targets + "]");
    // The list of primitives ends with what comes after the last one.
    const std::string of_mesh = of_node ? "[9, 9, 9]" : "[" + weights + "]";
    primitive += "], \"weights\": " + of_mesh + ", \"extras\": [0";
    if (of_node) { given.sample.nodes.insert(2, "\"weights\": [" + weights + "], "); }
    const apps::Model model = read("a.gltf", given.sample.embedded());
    CHECK(model.notes.empty());
    REQUIRE(model.positions.size() == 4);
    for (std::size_t v = 0; v < 4; ++v) {
      const glm::dvec4 p(expected[v], 1.0);
      const auto w = has_skin ? static_cast<double>(given.weights[v]) : 0.0;
      const glm::dvec3 place(has_skin ? w * (given.joints[0] * p) + (1.0 - w) * (given.joints[1] * p) : own * p);
      CHECK(glm::length(model.positions[v] - place) < 1e-9 * (1.0 + glm::length(place)));
    }
  }
}

TEST_CASE("glTF: morph targets that cannot be read are left out, and that is told") {
  Sample sample;
  sample.primitive.insert(sample.primitive.size() - 1, ", \"targets\": [{\"POSITION\": 9}, {\"POSITION\": 1}]");
  sample.nodes = "[{\"mesh\": 0, \"weights\": [1, 1]}]";
  const apps::Model model = read("a.gltf", sample.embedded());
  CHECK(model.positions == read("a.gltf", Sample().embedded()).positions);
  CHECK(models::noted(model.notes, "morph targets that cannot be read"));
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
