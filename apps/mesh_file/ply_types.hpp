// SPDX-License-Identifier: MIT
#pragma once

// The number types of PLY files (Turk 1994), and their values in binary files.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "apps/bytes.hpp"

namespace apps::mesh_file::ply {

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline std::optional<Type> type_of(std::string_view name) {
  struct Name {
    std::string_view old, sized;
  };
  constexpr std::array<Name, 8> names{{{"char", "int8"},
                                       {"uchar", "uint8"},
                                       {"short", "int16"},
                                       {"ushort", "uint16"},
                                       {"int", "int32"},
                                       {"uint", "uint32"},
                                       {"float", "float32"},
                                       {"double", "float64"}}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (name == names[i].old || name == names[i].sized) { return static_cast<Type>(i); }
  }
  return std::nullopt;
}
constexpr std::size_t size_of(Type type) { return std::array<std::size_t, 8>{1, 1, 2, 2, 4, 4, 4, 8}[static_cast<std::size_t>(type)]; }
constexpr bool is_float(Type type) { return type >= Type::float32; }

// The number that begins at this byte. Every type can be represented exactly as a double.
inline double number_at(std::string_view bytes, std::size_t at, Type type, bool big_endian) {
  const std::uint64_t bits = bits_at(bytes, at, size_of(type), big_endian);
  switch (type) {
    case Type::int8:
      return static_cast<std::int8_t>(bits);
    case Type::int16:
      return static_cast<std::int16_t>(bits);
    case Type::int32:
      return static_cast<std::int32_t>(bits);
    case Type::float32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case Type::float64:
      return std::bit_cast<double>(bits);
    default:
      return static_cast<double>(bits);
  }
}

}  // namespace apps::mesh_file::ply
