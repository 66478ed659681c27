// SPDX-License-Identifier: MIT
#pragma once

// Reference answers. Our own lie in tests/data (its README.md says what each file is); answers of other programs keep their licences and
// are read from a folder outside, where there is one.

#include <fstream>
#include <string>

#include "json.hpp"

namespace reference {

inline json::Value read(const std::string& file) { return json::parse_file(HALFLIGHT_TEST_DATA "/" + file); }

// The path of a file of others; empty where it is not at hand.
inline std::string of_others(const std::string& file) {
  const std::string path = HALFLIGHT_REFERENCE_DATA "/" + file;
  return std::ifstream{path} ? path : std::string();
}

}  // namespace reference
