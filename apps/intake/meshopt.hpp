// SPDX-License-Identifier: MIT
#pragma once

// EXT_meshopt_compression of glTF: the bytes of a buffer view, compressed (Kapoulkine; the format is appendix A and B of the extension).
// Of its filters that for normals is not undone, because nothing reads normals.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace apps::intake {

// Members of the extension, as they are called there.
struct MeshoptView {
  std::string_view mode, filter;  // filter: empty or "NONE" if there is none
  std::size_t count, stride;
};

// The bytes without compression: count * stride. Nothing if they are damaged or of another kind, with a sentence in `fault`; no allocation
// exceeds 64 times the bytes given.
[[nodiscard]] std::optional<std::string> unpack_meshopt(std::string_view bytes, const MeshoptView& view, std::string& fault);

}  // namespace apps::intake
