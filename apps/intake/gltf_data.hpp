// SPDX-License-Identifier: MIT
#pragma once

// The numbers of a glTF file: buffers (the binary chunk of a GLB, data in the text itself, files beside it) and the accessors that say what
// stands where in them. Whatever reaches beyond a buffer is an error; nothing is made larger than the bytes that are there, except for
// accessors without any, which are zeros. A sparse accessor is one with some of its elements substituted.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/intake/json_reader.hpp"
#include "apps/intake/model.hpp"

namespace apps::intake {

// The first `count` numbers of an array; nothing when there are fewer.
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
  // `binary`: the chunk of a GLB, if there is one.
  GltfData(const JsonValue& root, std::optional<std::string_view> binary, const SideFile& side_file)
      : root_(root), binary_(binary), side_file_(side_file) {}

  // All numbers of an accessor, `components` for each element: of vectors, or 1 of indices. Nothing after an error: a sentence in `fault`.
  [[nodiscard]] std::optional<std::vector<double>> numbers(const JsonValue& accessor_index, std::size_t components, std::string& fault);

  // The bytes of the picture that a texture shows, from wherever they are; nothing when they are nowhere.
  [[nodiscard]] std::optional<std::string> picture(std::size_t image);

 private:
  // So many elements in a row: `place` says in which view, and from which byte of it on.
  struct Elements {
    std::string who;  // of sentences
    const JsonValue& place;
    const JsonValue& component_type;
    std::size_t count, components;
    bool normalized;
  };

  [[nodiscard]] std::optional<std::string_view> buffer(std::size_t index, std::string& fault);
  // Appends the numbers of these elements.
  [[nodiscard]] bool elements(const Elements& at, std::vector<double>& out, std::string& fault);
  // Replaces those elements of an accessor, all of which stand in `at`, that its member `sparse` names.
  [[nodiscard]] bool substitute(const JsonValue& sparse, Elements at, std::vector<double>& numbers, std::string& fault);

  const JsonValue& root_;
  std::optional<std::string_view> binary_;
  const SideFile& side_file_;
  std::vector<std::optional<std::string>> loaded_;
};

// A URI such as "a%20b.bin" as a name; nothing when it is no file beside this one.
[[nodiscard]] std::optional<std::string> file_of_uri(std::string_view uri);

}  // namespace apps::intake
