// SPDX-License-Identifier: MIT
#pragma once

// Text inside SVG and HTML.

#include <string>
#include <string_view>

#include "apps/utf8.hpp"

namespace apps {

// & < > " ' are written as entities, so the text may stand between tags and in an attribute; characters that XML forbids are
// left out, bytes that are no text replaced.
[[nodiscard]] inline std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : to_utf8(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') { result += c; }
    }
  }
  return result;
}

}  // namespace apps
