// SPDX-License-Identifier: MIT
#pragma once

// A page of one file that is gone through step by step: its style, its elements, its data and the script that shows them, after what all pages
// share (page/). No network, no library; it works from a folder.

#include <string>

#include "apps/markup.hpp"
#include "embedded/page.hpp"

namespace apps {

struct HtmlDocument {
  std::string title, style, body;
  std::string data;  // JSON; the script knows it as `data`
  std::string script;
};

[[nodiscard]] inline std::string to_text(const HtmlDocument& page) {
  std::string data;
  for (const char c : page.data) { c == '<' ? data += "\\u003c" : data += c; }  // so that nothing in it ends the script element
  return "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n<meta name='viewport' content='width=device-width'>\n<title>" +
         escaped(page.title) + "</title>\n<style>" + embedded::page_common_css + page.style + "\n</style>\n</head>\n<body>" + page.body +
         "<script>\n'use strict';\nconst data = " + data + ";" + embedded::page_common_js + page.script + "</script>\n</body>\n</html>\n";
}

}  // namespace apps
