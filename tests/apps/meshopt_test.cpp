// SPDX-License-Identifier: MIT
// EXT_meshopt_compression: what this small encoder writes reads back; a file of gltfpack; what is damaged.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "apps/intake/meshopt.hpp"
#include "gltf_sample.hpp"
#include "models.hpp"
#include "seed.hpp"
#include "torus.hpp"

using apps::intake::MeshoptView;
using apps::intake::unpack_meshopt;
using gltf_sample::put;

namespace {

template <class T>
T zigzag(T v) {
  const bool negative = (v >> (8 * sizeof(T) - 1)) != 0;
  return static_cast<T>(negative ? ~(v << 1U) : v << 1U);
}

void put_varint(std::string& out, std::uint32_t value) {
  for (; value > 127; value >>= 7U) { out += static_cast<char>((value & 127U) | 128U); }
  out += static_cast<char>(value);
}

// Each group in a mode that is drawn from those that can hold it.
std::string packed_attributes(const std::string& bytes, std::size_t count, std::size_t stride, std::mt19937& random) {
  std::string out = "\xa0";
  const std::size_t block = std::min<std::size_t>(8192 / stride / 16 * 16, 256);
  const auto byte = [&](std::size_t i, std::size_t k) { return static_cast<std::uint8_t>(bytes[i * stride + k]); };
  for (std::size_t begin = 0; begin < count; begin += block) {
    const std::size_t elements = std::min(block, count - begin), groups = (elements + 15) / 16;
    for (std::size_t k = 0; k < stride; ++k) {
      std::string modes((groups + 3) / 4, '\0'), data;
      for (std::size_t g = 0; g < groups; ++g) {
        std::uint8_t differences[16] = {};
        for (std::size_t i = 16 * g; i < std::min(elements, 16 * g + 16); ++i) {
          const std::size_t at = begin + i;
          differences[i % 16] = zigzag(static_cast<std::uint8_t>(byte(at, k) - byte(at > 0 ? at - 1 : 0, k)));
        }
        const bool zero = std::all_of(std::begin(differences), std::end(differences), [](std::uint8_t d) { return d == 0; });
        const unsigned mode = zero ? static_cast<unsigned>(random() % 4) : 1 + static_cast<unsigned>(random() % 3), bits = 1U << mode;
        modes[g / 4] = static_cast<char>(static_cast<unsigned char>(modes[g / 4]) | mode << 2 * (g % 4));
        if (mode == 0) { continue; }
        std::string far;
        unsigned row = 0;
        for (std::size_t i = 0; i < 16; ++i) {
          const unsigned all = (1U << bits) - 1U, value = std::min<unsigned>(differences[i], all);
          if (mode < 3 && value == all) { far += static_cast<char>(differences[i]); }
          row = row << bits | value;
          if ((i + 1) * bits % 8 == 0) { data += static_cast<char>(row & 255U); }
        }
        data += far;
      }
      out += modes + data;
    }
  }
  return out + std::string(stride < 32 ? 32 - stride : 0, '\0') + bytes.substr(0, stride);
}

struct Stream {
  std::string bytes, expected;
  std::string mode;
  std::size_t count, stride;
  [[nodiscard]] MeshoptView view() const { return {mode, "", count, stride}; }
};

std::vector<Stream> streams(std::mt19937& random) {
  std::vector<Stream> out;
  for (int run = 0; run < 30; ++run) {
    const std::size_t stride = run == 0 ? 256 : 4 * (1 + random() % 8), count = 1 + random() % 700;
    std::string bytes(count * stride, '\0');
    const unsigned steps = 1U << random() % 9;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = static_cast<char>((i < stride ? 0U : static_cast<unsigned char>(bytes[i - stride])) + random() % steps);
    }
    out.push_back({packed_attributes(bytes, count, stride, random), bytes, "ATTRIBUTES", count, stride});

    const std::size_t corners = 3 * (1 + random() % 200);
    std::string indices("\xd1"), codes("\xe1"), data, expected;
    std::uint32_t last[2] = {}, before = 0;
    for (std::size_t i = 0; i < corners; ++i) {
      const auto index = static_cast<std::uint32_t>(random() % 100'000), base = static_cast<std::uint32_t>(random() % 2);
      put(expected, index);
      put_varint(indices, zigzag(index - last[base]) << 1U | base);
      last[base] = index;
      if (i % 3 == 0) {  // a triangle with three corners that are written
        codes += '\xff';
        data += '\xff';
      }
      put_varint(data, zigzag(index - before));
      before = index;
    }
    out.push_back({indices + std::string(4, '\0'), expected, "INDICES", corners, 4});
    out.push_back({codes + data + std::string(16, '\0'), expected, "TRIANGLES", corners, 4});
  }
  return out;
}

}  // namespace

TEST_CASE("meshopt: what was packed in any modes unpacks to the same bytes") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (const Stream& stream : streams(random)) {
    std::string fault;
    const auto unpacked = unpack_meshopt(stream.bytes, stream.view(), fault);
    CAPTURE(stream.mode, stream.count, stream.stride, fault);
    REQUIRE(unpacked);
    CHECK((*unpacked == stream.expected));
  }
}

TEST_CASE("meshopt: damaged views end in the bytes announced or in a refusal") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (const Stream& stream : streams(random)) {
    for (int run = 0; run < 40; ++run) {
      std::string damaged = stream.bytes;
      if (run % 4 == 0) { damaged.resize(random() % damaged.size()); }
      for (int flips = run % 4; flips > 0; --flips) {
        char& byte = damaged[random() % damaged.size()];
        byte = static_cast<char>(static_cast<unsigned char>(byte) ^ 1U << random() % 8);
      }
      std::string fault;
      const auto unpacked = unpack_meshopt(damaged, stream.view(), fault);
      REQUIRE(unpacked.has_value() == fault.empty());
      if (unpacked) { REQUIRE(unpacked->size() == stream.count * stream.stride); }
    }
  }
}

// Three instances of a torus, with the modes ATTRIBUTES and TRIANGLES and the filters EXPONENTIAL and QUATERNION. Half a step of 14 bits of
// 6, scaled by at most 2, is 4e-4 each way. Rotations have 12 bits: 2e-4 in each of three components is twice as much in the angle, 7e-4,
// and that times 3 * 2 in length. Translations, of at most 14, have 16 bits, as have the offsets within.
TEST_CASE("glTF: a file compressed by gltfpack has the triangles of its instances where they were") {
  std::ifstream in(HALFLIGHT_TEST_DATA "/meshopt/torus_instances.glb", std::ios::binary);
  const apps::Model model = models::read("a.glb", {std::istreambuf_iterator<char>(in), {}});
  constexpr int n = 9;
  const auto expected = torus::triangles(n, true);
  REQUIRE(model.polygons() == 3 * expected.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double number = static_cast<double>(k), scale = 1.0 + 0.5 * number;
    const glm::dquat turn = glm::angleAxis(number, glm::dvec3(0, 0, 1));
    const glm::dvec3 move(7.0 * number, number, -number);
    std::multiset<torus::Triangle> triangles;
    for (std::size_t p = k * expected.size(); p < (k + 1) * expected.size(); ++p) {
      torus::Triangle triangle;
      for (std::size_t c = 0; c < 3; ++c) {
        const glm::dvec3 found = models::corner(model, p, c), local = glm::conjugate(turn) * ((found - move) / scale);
        const auto step = [](double angle) { return (static_cast<int>(std::lround(n * angle / (2.0 * std::numbers::pi))) + n) % n; };
        triangle[c] = {step(std::atan2(local.y, local.x)), step(std::atan2(local.z, std::hypot(local.x, local.y) - 2.0))};
        largest = std::max(largest, glm::length(found - (move + scale * (turn * torus::position(n, triangle[c])))));
      }
      triangles.insert(torus::turned(triangle));
    }
    CHECK(triangles == expected);
  }
  CHECK(largest < 6e-3);
}

TEST_CASE("glTF: a compressed view that is damaged or of a later version is refused with its accessor and byte") {
  gltf_sample::Sample sample;
  sample.views.insert(2,
                      "\"extensions\": {\"EXT_meshopt_compression\": {\"buffer\": 0, \"byteLength\": 48, \"byteStride\": 12, \"count\": 4, "
                      "\"mode\": \"ATTRIBUTES\"}}, ");
  CHECK(models::error("a.gltf", sample.embedded()).find("accessor 0: byte 1 of the compressed view: this version") != std::string::npos);
}
