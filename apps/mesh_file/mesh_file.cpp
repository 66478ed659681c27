// SPDX-License-Identifier: MIT
#include "apps/mesh_file.hpp"

#include <array>

#include <brep/builder_input.hpp>

#include "apps/mesh_file/reading.hpp"
#include "apps/words.hpp"

namespace apps {
std::span<const MeshFormat* const> mesh_formats() {
  static constexpr std::array formats{&mesh_file::obj_format, &mesh_file::ply_format, &mesh_file::off_format};
  return formats;
}

std::string mesh_endings() {
  std::vector<std::string_view> endings;
  for (const MeshFormat* const format : mesh_formats()) { endings.push_back(format->ending); }
  return list_of(endings);
}

bool has_ending(std::string_view path, std::string_view ending) {
  if (path.size() <= ending.size()) { return false; }
  return same_letters(path.substr(path.size() - ending.size()), ending);
}

const MeshFormat* mesh_format(std::string_view path) {
  for (const MeshFormat* const format : mesh_formats()) {
    if (has_ending(path, format->ending)) { return format; }
  }
  return nullptr;
}

MeshResult read_mesh(std::string_view bytes, const MeshFormat& format) {
  mesh_file::Output out;
  const std::size_t at = bytes.find('\0');
  if (!format.text || at == std::string_view::npos) {
    format.read(bytes, out);
    return out.take();
  }
  out.error(place_of(bytes, at), "expected text, found a zero byte; is this a binary file?");
  return out.take();
}

std::string write_mesh(const brep::Builder& builder, const MeshFormat& format, std::span<const MeshGroup> groups) {
  return format.write(builder, groups);
}

}  // namespace apps
