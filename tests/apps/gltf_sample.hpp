// SPDX-License-Identifier: MIT
#pragma once

// A glTF file of one square, to which tests add what they are about.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace gltf_sample {

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));  // the machines of the tests are little endian, as glTF is
  out.append(bytes, sizeof(T));
}

// All digits of a number.
inline std::string formatted(float value) {
  char text[32];
  static_cast<void>(std::snprintf(text, sizeof text, "%.17g", static_cast<double>(value)));
  return text;
}

inline std::string base64(const std::string& bytes) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) { bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U); }
    for (std::size_t k = 0; k < 4; ++k) { text += i + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63U]; }
  }
  return text;
}

// A square of two triangles, with indices of this type, on top of what `extra` adds to the object.
struct Sample {
  std::string binary, views, accessors;
  std::string nodes = "[{\"mesh\": 0, \"name\": \"square\"}]", more, primitive;

  explicit Sample(int index_type = 5123) {
    for (const float x : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.0F}) { put(binary, x); }
    for (const unsigned i : {0U, 1U, 2U, 0U, 2U, 3U}) {
      if (index_type == 5121) { put(binary, static_cast<std::uint8_t>(i)); }
      if (index_type == 5123) { put(binary, static_cast<std::uint16_t>(i)); }
      if (index_type == 5125) { put(binary, i); }
    }
    views =
        "[{\"buffer\": 0, \"byteLength\": 48}, {\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": " + std::to_string(binary.size() - 48) +
        "}]";
    accessors = "[{\"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\"}, {\"bufferView\": 1, \"componentType\": " +
                std::to_string(index_type) + ", \"count\": 6, \"type\": \"SCALAR\"}]";
    primitive = "{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}";
  }
  [[nodiscard]] std::string text(const std::string& uri) const {
    return "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [0]}], \"nodes\": " + nodes +
           ", \"meshes\": [{\"primitives\": [" + primitive + "]}], \"buffers\": [{" + (uri.empty() ? "" : "\"uri\": \"" + uri + "\", ") +
           "\"byteLength\": " + std::to_string(binary.size()) + "}], \"bufferViews\": " + views + ", \"accessors\": " + accessors + more +
           "}";
  }
  [[nodiscard]] std::string embedded() const { return text("data:application/octet-stream;base64," + base64(binary)); }
  // `multiple` other than 4: chunks begin where glTF does not allow it, as some programs write them.
  [[nodiscard]] std::string glb(std::size_t multiple = 4) const {
    std::string json = text(""), bytes = binary;
    json.resize((json.size() + multiple - 1) / multiple * multiple, ' ');
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    std::string out = "glTF";
    for (const std::size_t n : {std::size_t{2}, 28 + json.size() + bytes.size(), json.size()}) { put(out, static_cast<std::uint32_t>(n)); }
    out += "JSON" + json;
    put(out, static_cast<std::uint32_t>(bytes.size()));
    return out + std::string("BIN\0", 4) + bytes;
  }
};

// The member of an accessor that substitutes the elements at `picked`; their bytes, and their indices, are added to the binary part.
inline std::string substitution(Sample& sample, const std::vector<std::size_t>& picked, const std::vector<std::string>& elements,
                                bool bytes) {
  const std::size_t views = static_cast<std::size_t>(std::count(sample.views.begin(), sample.views.end(), '{'));
  const auto view = [&](const std::string& added) {
    sample.binary.resize((sample.binary.size() + 3) / 4 * 4, '\0');
    sample.views.back() = ',';
    sample.views += "{\"buffer\": 0, \"byteOffset\": " + std::to_string(sample.binary.size()) +
                    ", \"byteLength\": " + std::to_string(added.size()) + "}]";
    sample.binary += added;
  };
  std::string indices, values;
  for (const std::size_t i : picked) {
    bytes ? put(indices, static_cast<std::uint8_t>(i)) : put(indices, static_cast<std::uint32_t>(i));
    values += elements[i];
  }
  view(indices);
  view(values);
  return "\"sparse\": {\"count\": " + std::to_string(picked.size()) + ", \"indices\": {\"bufferView\": " + std::to_string(views) +
         ", \"componentType\": " + (bytes ? "5121" : "5125") + "}, \"values\": {\"bufferView\": " + std::to_string(views + 1) + "}}, ";
}

}  // namespace gltf_sample
