// SPDX-License-Identifier: MIT
#include "apps/mesh_file.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <utility>

#include "apps/mesh_file/reading.hpp"

namespace apps {
namespace {

void put(std::string& out, double value) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

// The lowest bytes of the value, the lowest first.
void put_bytes(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) { out += static_cast<char>(static_cast<unsigned char>(value >> 8 * i)); }
}

void put_position(std::string& out, const glm::dvec3& p) {
  for (int i = 0; i < 3; ++i) {
    if (i > 0) { out += ' '; }
    put(out, p[i]);
  }
  out += '\n';
}

std::string to_obj(const brep::Builder& builder, std::span<const MeshGroup> groups) {
  std::string out;
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) {
    out += "v ";
    put_position(out, builder.position(v));
  }
  auto group = groups.begin();
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    for (; group != groups.end() && group->first_face <= f; ++group) { out += "o " + group->name + '\n'; }
    out += 'f';
    for (std::uint32_t v : builder.corners(f)) { out += ' ' + std::to_string(std::uint64_t{v} + 1); }
    out += '\n';
  }
  return out;
}

std::string to_off(const brep::Builder& builder) {
  std::string out = "OFF\n" + std::to_string(builder.vertex_count()) + " " + std::to_string(builder.face_count()) + " 0\n";
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) { put_position(out, builder.position(v)); }
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    out += std::to_string(builder.corners(f).size());
    for (std::uint32_t v : builder.corners(f)) { out += ' ' + std::to_string(v); }
    out += '\n';
  }
  return out;
}

std::string to_ply(const brep::Builder& builder) {
  std::size_t most = 0;
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) { most = std::max(most, builder.corners(f).size()); }
  std::string out = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(builder.vertex_count()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(builder.face_count()) +
                    "\nproperty list " + (most > 255 ? "int" : "uchar") + " int vertex_indices\nend_header\n";
  for (std::uint32_t v = 0; v < builder.vertex_count(); ++v) {
    for (int i = 0; i < 3; ++i) { put_bytes(out, std::bit_cast<std::uint64_t>(builder.position(v)[i]), 8); }
  }
  for (std::uint32_t f = 0; f < builder.face_count(); ++f) {
    put_bytes(out, builder.corners(f).size(), most > 255 ? 4 : 1);
    for (std::uint32_t v : builder.corners(f)) { put_bytes(out, v, 4); }
  }
  return out;
}

}  // namespace

std::optional<MeshFormat> mesh_format(std::string_view path) {
  if (path.size() < 5) { return std::nullopt; }
  std::string ending(path.substr(path.size() - 4));
  for (char& c : ending) { c = static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
  if (ending == ".obj") { return MeshFormat::obj; }
  if (ending == ".ply") { return MeshFormat::ply; }
  if (ending == ".off") { return MeshFormat::off; }
  return std::nullopt;
}

MeshResult read_mesh(std::string_view bytes, MeshFormat format) {
  mesh_file::Output out;
  if (const std::size_t at = bytes.find('\0'); format != MeshFormat::ply && at != std::string_view::npos) {
    const auto line = 1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const std::size_t before = bytes.substr(0, at).rfind('\n');
    const std::size_t column = before == std::string_view::npos ? at + 1 : at - before;
    out.error({static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(column)},
              "expected text, found a zero byte; is this a binary file?");
    return out.take();
  }
  switch (format) {
    case MeshFormat::obj:
      mesh_file::read_obj(bytes, out);
      break;
    case MeshFormat::ply:
      mesh_file::read_ply(bytes, out);
      break;
    case MeshFormat::off:
      mesh_file::read_off(bytes, out);
      break;
  }
  return out.take();
}

std::string to_text(const MeshResult& result, std::string_view name) {
  std::string text;
  for (const MeshError& error : result.errors) {
    const auto [line, column] = error.place;
    text.append(name).append(line == 0 ? ":byte " : ":" + std::to_string(line) + ":").append(std::to_string(column));
    text.append(": error: ").append(error.sentence).append("\n");
  }
  if (result.more_errors) {
    text.append(name).append(": given up after ").append(std::to_string(result.errors.size())).append(" errors\n");
  }
  return text;
}

std::string write_mesh(const brep::Builder& builder, MeshFormat format, std::span<const MeshGroup> groups) {
  return format == MeshFormat::obj ? to_obj(builder, groups) : format == MeshFormat::ply ? to_ply(builder) : to_off(builder);
}

}  // namespace apps
