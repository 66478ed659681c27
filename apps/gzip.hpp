// SPDX-License-Identifier: MIT
#pragma once

// Files compressed by gzip (RFC 1952), as VRML files often are, whatever their names say.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace apps {

[[nodiscard]] inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b\x08"); }

// What the first file in the archive holds; nothing, and a sentence in `fault`, if it is damaged or holds more than `most` bytes.
[[nodiscard]] std::optional<std::string> gunzip(std::string_view bytes, std::size_t most, std::string& fault);

// Decodes a stream of deflate (RFC 1951) that fills `out` exactly; false if it does not. At least two bytes must follow the stream.
// Defined in intake/texture.cpp, beside the decoder of PNG.
[[nodiscard]] bool inflate(std::string_view stream, std::span<char> out);

}  // namespace apps
