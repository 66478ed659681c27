// SPDX-License-Identifier: MIT
#pragma once

// Is a text well-formed XML, as far as our own SVG and HTML go: elements close in order, attributes are quoted and stand once, entities are
// known?

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace markup {

// HTML's elements without content need no end.
inline bool is_void(const std::string& name) { return name == "meta" || name == "img" || name == "br"; }

// What is wrong, with what stands there; empty when nothing is.
inline std::string fault(std::string_view text) {
  std::vector<std::string> open;
  std::size_t at = 0;
  const auto wrong = [&](const std::string& what) { return what + " at: " + std::string(text.substr(at, 80)); };
  const auto bad_entity = [](std::string_view part) {
    for (std::size_t i = part.find('&'); i != std::string_view::npos; i = part.find('&', i + 1)) {
      const std::string_view rest = part.substr(i);
      const std::vector<std::string_view> known = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
      if (std::none_of(known.begin(), known.end(), [&](std::string_view k) { return rest.substr(0, k.size()) == k; })) { return true; }
    }
    return false;
  };
  while (at < text.size()) {
    if (text[at] != '<') {
      const std::size_t end = std::min(text.find('<', at), text.size());
      const bool style = !open.empty() && open.back() == "style";
      if (!style && (bad_entity(text.substr(at, end - at)) || text.substr(at, end - at).find('>') != std::string_view::npos)) {
        return wrong("a bare character");
      }
      at = end;
      continue;
    }
    if (text.substr(at, 2) == "<?" || text.substr(at, 2) == "<!") {
      at = text.find('>', at) + 1;
      continue;
    }
    if (text.substr(at, 2) == "</") {
      const std::size_t end = text.find('>', at);
      const std::string name(text.substr(at + 2, end - at - 2));
      if (open.empty() || open.back() != name) { return wrong("an end of '" + (open.empty() ? "nothing" : open.back()) + "'"); }
      open.pop_back();
      at = end + 1;
      continue;
    }
    std::size_t i = at + 1;
    while (i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0)) { ++i; }
    const std::string name(text.substr(at + 1, i - at - 1));
    std::set<std::string> attributes;
    while (i < text.size() && text[i] == ' ') {
      const std::size_t equals = text.find("=\"", i);
      const std::size_t quote = equals == std::string_view::npos ? equals : text.find('"', equals + 2);
      if (quote == std::string_view::npos) { return wrong("an attribute"); }
      if (!attributes.insert(std::string(text.substr(i + 1, equals - i - 1))).second) { return wrong("an attribute twice"); }
      const std::string_view value = text.substr(equals + 2, quote - equals - 2);
      if (bad_entity(value) || value.find('<') != std::string_view::npos) { return wrong("a value"); }
      i = quote + 1;
    }
    const bool closed = text.substr(i, 2) == "/>";
    if (!closed && (i >= text.size() || text[i] != '>')) { return wrong("a tag"); }
    if (!closed && !is_void(name)) { open.push_back(name); }
    at = i + (closed ? 2 : 1);
  }
  return open.empty() ? "" : "'" + open.back() + "' has no end";
}

}  // namespace markup
