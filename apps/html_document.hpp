// SPDX-License-Identifier: MIT
#pragma once

// Common parts of all pages that the program writes: each is one file without network access or libraries, which works when
// opened from a folder.

#include <string>
#include <string_view>

#include "apps/text.hpp"
#include "embedded/page.hpp"

namespace apps {

// Text for SVG and HTML: & < > " ' become entities, so the text may stand between tags and in an attribute; characters that XML forbids
// are left out, and bytes that are not UTF-8 are replaced.
[[nodiscard]] inline std::string escaped(std::string_view text) {
  constexpr std::string_view marks = "&<>\"'";
  constexpr const char* entities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  std::string result;
  for (const char c : to_utf8(text)) {
    if (const std::size_t mark = marks.find(c); mark != marks.npos) {
      result += entities[mark];
    } else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') {
      result += c;
    }
  }
  return result;
}

[[nodiscard]] inline std::string html_document(const std::string& title, const std::string& style, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
         escaped(title) + "</title>\n<style>" + style + "\n</style>\n</head>\n<body>" + body + "</body>\n</html>\n";
}

// The elements of a page and its script, which reads the JSON as `data`.
[[nodiscard]] inline std::string with_script(const std::string& elements, const std::string& json, const std::string& script) {
  std::string data;
  for (const char c : json) { c == '<' ? data += "\\u003c" : data += c; }  // so that no text in it ends the script element
  return elements + "<script>\n'use strict';\nconst data = " + data + ";" + script + "</script>\n";
}

// A page that shows one step after the other, with the controls that all these pages share (page/).
[[nodiscard]] inline std::string stepped_document(const std::string& title, const std::string& style, const std::string& elements,
                                                  const std::string& json, const std::string& script) {
  return html_document(title, embedded::page_common_css + style, with_script(elements, json, embedded::page_common_js + script));
}

}  // namespace apps
