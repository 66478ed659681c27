// SPDX-License-Identifier: MIT
#include <array>

#include "apps/export/export_mesh.hpp"
#include "apps/mesh_file.hpp"

namespace apps {
namespace exported {

extern const ExportFormat glb, obj;

}  // namespace exported

const ExportFormat* export_format(std::string_view path) {
  static constexpr std::array formats{&exported::glb, &exported::obj};
  for (const ExportFormat* const format : formats) {
    if (has_ending(path, format->ending)) { return format; }
  }
  return nullptr;
}

}  // namespace apps
