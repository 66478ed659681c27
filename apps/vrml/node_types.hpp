// SPDX-License-Identifier: MIT
#pragma once

// The nodes of VRML 1.0 with their fields: what stands behind the name of a field can only be read when its type is known.

#include <span>
#include <string_view>
#include <vector>

namespace apps::vrml {

// How a value is written: so many numbers; in brackets any number of them (`many`); words and strings.
struct FieldType {
  enum class Kind : unsigned char { numbers, indices, image, strings, words };
  Kind kind = Kind::numbers;
  unsigned char count = 1;
  bool many = false;
};

struct FieldEntry {
  std::string_view name;
  FieldType type;
};

struct NodeType {
  std::string_view name;
  std::vector<FieldEntry> fields;
  bool group = false;  // may have children
};

// Null when there is no such node.
[[nodiscard]] const NodeType* node_type(std::string_view name);
[[nodiscard]] const FieldType* field_type(const NodeType& node, std::string_view field);
// "SFFloat", "MFVec3f"; null when there is no such type.
[[nodiscard]] const FieldType* named_type(std::string_view name);
// The names of all nodes.
[[nodiscard]] std::span<const NodeType> node_types();

}  // namespace apps::vrml
