// SPDX-License-Identifier: MIT
// glTF: numbers that are packed, left out, or given for many instances.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "gltf_sample.hpp"
#include "models.hpp"
#include "seed.hpp"

using gltf_sample::formatted;
using gltf_sample::put;
using gltf_sample::Sample;
using gltf_sample::substitution;
using models::read;

TEST_CASE("glTF: a sparse accessor says the same as one with all its elements in a row") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const apps::Model whole = read("a.gltf", Sample().embedded());
  for (int run = 0; run < 20; ++run) {
    Sample sample;
    std::vector<std::string> corners, indices;
    for (std::size_t i = 0; i < 4; ++i) { corners.push_back(sample.binary.substr(12 * i, 12)); }
    for (std::size_t i = 0; i < 6; ++i) { indices.push_back(sample.binary.substr(48 + 2 * i, 2)); }
    const auto some = [&](std::size_t of, std::size_t at_most) {  // in order, as the format asks
      std::vector<std::size_t> all(of), picked;
      std::iota(all.begin(), all.end(), std::size_t{0});
      std::sample(all.begin(), all.end(), std::back_inserter(picked), 1 + random() % at_most, random);
      return picked;
    };
    // Half of the accessors have no view: all zeros but for what is substituted.
    const bool zeros = run % 2 == 0;
    std::vector<std::size_t> picked = some(4, 4);
    if (zeros) { picked = {1, 2, 3}; }
    for (const std::size_t i : picked) { std::fill_n(sample.binary.begin() + static_cast<std::ptrdiff_t>(12 * i), 12, '\x55'); }
    const std::string of_corners = substitution(sample, picked, corners, random() % 2 == 0);
    sample.accessors.replace(sample.accessors.find(zeros ? "\"bufferView\": 0, " : "\"componentType\""), zeros ? 17 : 0, of_corners);
    picked = some(6, 6);
    for (const std::size_t i : picked) { std::fill_n(sample.binary.begin() + static_cast<std::ptrdiff_t>(48 + 2 * i), 2, '\x55'); }
    const std::string of_indices = substitution(sample, picked, indices, random() % 2 == 0);
    sample.accessors.insert(sample.accessors.find("\"bufferView\": 1, \"componentType\": 5123"), of_indices);
    CAPTURE(run, sample.accessors);
    const apps::Model sparse = read("a.gltf", sample.embedded());
    CHECK(sparse.positions == whole.positions);
    CHECK(sparse.corners == whole.corners);
  }
}

TEST_CASE("glTF: instances of a mesh are where nodes of their own would be") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<float>(std::uniform_real_distribution(-2.0, 2.0)(random)); };
  for (int run = 0; run < 20; ++run) {
    const std::size_t count = 1 + random() % 5;
    const bool has[3] = {run % 4 != 1, run % 2 == 0, run % 4 != 2};
    const char* const names[3][2] = {{"TRANSLATION", "translation"}, {"ROTATION", "rotation"}, {"SCALE", "scale"}};
    std::vector<std::string> own(count);
    Sample sample;
    std::string attributes;
    for (int k = 0, added = 0; k < 3; ++k) {
      if (!has[k]) { continue; }
      sample.views.back() = ',';
      const std::size_t first = sample.binary.size(), components = k == 1 ? 4 : 3;
      for (std::size_t i = 0; i < count; ++i) {
        float v[4] = {number(), number(), number(), 0.0F};
        if (k == 1) {
          const float angle = number();
          v[0] = v[1] = 0.0F, v[2] = std::sin(angle), v[3] = std::cos(angle);
        }
        std::string list;
        for (std::size_t c = 0; c < components; ++c) {
          put(sample.binary, v[c]);
          list += (c > 0 ? ", " : "") + formatted(v[c]);
        }
        own[i] += std::string(", \"") + names[k][1] + "\": [" + list + "]";
      }
      sample.views += "{\"buffer\": 0, \"byteOffset\": " + std::to_string(first) +
                      ", \"byteLength\": " + std::to_string(sample.binary.size() - first) + "}]";
      sample.accessors.back() = ',';
      sample.accessors += "{\"bufferView\": " + std::to_string(2 + added) +
                          ", \"componentType\": 5126, \"count\": " + std::to_string(count) +
                          (k == 1 ? ", \"type\": \"VEC4\"}]" : ", \"type\": \"VEC3\"}]");
      attributes += (added > 0 ? ", \"" : "\"") + std::string(names[k][0]) + "\": " + std::to_string(2 + added);
      ++added;
    }
    Sample nodes = sample;
    const std::string outer = "\"translation\": [1, 2, 3], \"scale\": [2, -1, 1]";
    sample.nodes = "[{\"mesh\": 0, " + outer + ", \"extensions\": {\"EXT_mesh_gpu_instancing\": {\"attributes\": {" + attributes + "}}}}]";
    nodes.nodes = "[{" + outer + ", \"children\": [";
    for (std::size_t i = 0; i < count; ++i) { nodes.nodes += (i > 0 ? ", " : "") + std::to_string(i + 1); }
    nodes.nodes += "]}";
    for (std::size_t i = 0; i < count; ++i) { nodes.nodes += ", {\"mesh\": 0" + own[i] + "}"; }
    nodes.nodes += "]";
    CAPTURE(run, sample.nodes, nodes.nodes);
    const apps::Model one = read("a.gltf", sample.embedded()), other = read("a.gltf", nodes.embedded());
    CHECK(one.polygons() == 2 * count);
    CHECK(one.positions == other.positions);
    CHECK(one.corners == other.corners);
  }
}
