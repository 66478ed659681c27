// SPDX-License-Identifier: MIT
#pragma once

// The numbers of a glTF file: buffers (the binary chunk of a GLB, data in the text itself, files beside it) and the accessors that
// describe their contents. Access beyond a buffer is an error. No allocation exceeds the number of existing bytes, except for accessors
// without data, which are zeros, and for what is compressed. A sparse accessor has some of its elements replaced.

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/intake/draco.hpp"
#include "apps/intake/json_reader.hpp"
#include "apps/intake/model.hpp"

namespace apps::intake {

inline constexpr std::size_t nowhere = ~std::size_t{0};  // the index of nothing

// The first `count` numbers of an array; nothing if there are fewer.
template <std::size_t count>
[[nodiscard]] std::optional<std::array<double, count>> array_of(const JsonValue& value) {
  std::array<double, count> out{};
  if (value.items().size() < count) { return std::nullopt; }
  for (std::size_t i = 0; i < count; ++i) {
    if (value[i].kind() != JsonValue::Kind::number) { return std::nullopt; }
    out[i] = value[i].number();
  }
  return out;
}

class GltfData {
 public:
  // `binary`: the binary chunk of a GLB, if any.
  GltfData(const JsonValue& root, std::optional<std::string_view> binary, const SideFile& side_file)
      : root_(root), binary_(binary), side_file_(side_file) {}

  // All numbers of an accessor with `components` per element: 1 for indices, 2 to 4, or 16 for matrices, column by column. After an error
  // nothing, and a sentence in `fault`.
  [[nodiscard]] std::optional<std::vector<double>> numbers(const JsonValue& accessor_index, std::size_t components, std::string& fault);

  // KHR_draco_mesh_compression: from now on, until the next call, the accessors of this primitive have the numbers of its compressed mesh.
  // Does it have one? After an error nothing, and a sentence in `fault`.
  [[nodiscard]] std::optional<bool> unpack(const JsonValue& primitive, std::string& fault);

  // The bytes of a picture, wherever they are; nothing if they cannot be found.
  [[nodiscard]] std::optional<std::string> picture(std::size_t image);

 private:
  // Consecutive elements: `place` names their buffer view and the offset of the first one in it.
  struct Elements {
    std::string who;  // for error sentences
    const JsonValue& place;
    const JsonValue& component_type;
    std::size_t count, components;
    bool normalized;
  };
  struct Unpacked {
    std::size_t components;
    std::vector<double> numbers;
  };

  [[nodiscard]] std::optional<std::string_view> buffer(std::size_t index, std::string& fault);
  // The bytes of a buffer view, without compression.
  [[nodiscard]] std::optional<std::string_view> view(const JsonValue& index, std::string& fault);
  // Appends the numbers of these elements to `out`.
  [[nodiscard]] bool elements(const Elements& at, std::vector<double>& out, std::string& fault);
  // Replaces the elements of an accessor that its member `sparse` names; `at` describes all elements of the accessor.
  [[nodiscard]] bool substitute(const JsonValue& sparse, Elements at, std::vector<double>& numbers, std::string& fault);

  const JsonValue& root_;
  std::optional<std::string_view> binary_;
  const SideFile& side_file_;
  std::vector<std::optional<std::string>> loaded_;
  std::map<std::size_t, std::string> views_;   // that were compressed
  std::size_t unpacked_bytes_ = 0;             // of them
  std::map<std::size_t, draco::Mesh> meshes_;  // compressed ones, by their buffer view
  std::map<std::size_t, Unpacked> unpacked_;   // by accessor
};

// A URI such as "a%20b.bin" as a file name; nothing if it does not name a file beside this one.
[[nodiscard]] std::optional<std::string> file_of_uri(std::string_view uri);

}  // namespace apps::intake
