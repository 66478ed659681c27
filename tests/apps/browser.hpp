// SPDX-License-Identifier: MIT
#pragma once

// Pages in a headless browser, where there is one (chromium). Begin a test with: if (!browser::found()) { SKIP_TEST("there is no
// chromium"); }

#include <cstdlib>
#include <string>

#include "catch.hpp"
#include "program.hpp"

namespace browser {

[[nodiscard]] inline bool found() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

// The elements of a page, as text, after `script` has run at its end, in a window of this size.
[[nodiscard]] inline std::string elements(const program::Place& place, std::string page, const std::string& script,
                                          const std::string& window) {
  page.insert(page.rfind("</body>"), "<script>" + script + "</script>");
  place.write("page.html", page);
  const std::string command = "cd '" + place.path().string() + "' && timeout 60 chromium --headless --no-sandbox --disable-gpu" +
                              " --user-data-dir=profile --window-size=" + window + " --dump-dom page.html >dom.html 2>/dev/null";
  REQUIRE(std::system(command.c_str()) == 0);
  return place.read("dom.html");
}

}  // namespace browser
