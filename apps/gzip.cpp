// SPDX-License-Identifier: MIT
#include "apps/gzip.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "apps/bytes.hpp"

namespace apps {
namespace {

// The length of the header: ten bytes and, as the flags in the fourth say, an extra field, a name, a comment and a checksum.
std::size_t length_of_header(std::string_view bytes) {
  constexpr std::uint64_t checksum = 2, extra = 4, name = 8, comment = 16;
  const auto flags = bits_at(bytes, 3, 1);
  std::size_t at = 10;
  if ((flags & extra) != 0) { at += at + 2 <= bytes.size() ? 2 + bits_at(bytes, at, 2) : 2; }
  for (const std::uint64_t text : {name, comment}) {
    if ((flags & text) != 0) { at = bytes.find('\0', at) + 1; }  // 0 if there is no end
    if (at == 0) { return bytes.size(); }
  }
  return at + ((flags & checksum) != 0 ? 2 : 0);
}

}  // namespace

std::optional<std::string> gunzip(std::string_view bytes, std::size_t most, std::string& fault) {
  const auto refuse = [&fault](const char* sentence) {
    fault = sentence;
    return std::nullopt;
  };
  constexpr std::size_t shortest_header = 10, end = 8;  // at the end: a checksum and the length, of four bytes each
  constexpr const char* damaged = "is a compressed file (gzip) that is damaged or cut";
  constexpr std::size_t best_ratio = 1032;  // of deflate: one bit for 258 bytes, and some
  if (!is_gzip(bytes) || bytes.size() < shortest_header + end) { return refuse(damaged); }
  const std::size_t header = length_of_header(bytes), size = bits_at(bytes, bytes.size() - 4, 4);
  if (header + end > bytes.size() || size > best_ratio * bytes.size()) { return refuse(damaged); }
  if (size > most) { return refuse("is a compressed file (gzip) that holds more than halflight reads, or is damaged or cut"); }
  std::string out(size, '\0');
  if (size > 0 && !inflate(bytes.substr(header), out)) { return refuse(damaged); }
  return crc32(out) == bits_at(bytes, bytes.size() - end, 4) ? std::optional(std::move(out)) : refuse(damaged);
}

}  // namespace apps
