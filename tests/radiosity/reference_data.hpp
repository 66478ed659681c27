// SPDX-License-Identifier: MIT
#pragma once

// Where the reference data lie, when they are at hand.

#include <fstream>
#include <string>

#include "catch.hpp"
#include "json.hpp"

namespace reference {

inline const std::string data_folder = HALFLIGHT_REFERENCE_DATA;

// False, with a warning, where the file is not at hand.
inline bool present(const std::string& file) {
  if (std::ifstream{data_folder + "/" + file}) { return true; }
  WARN("skipped: no reference data at " << data_folder << "/" << file);
  return false;
}

// The file; null where it is not at hand.
inline json::Value read(const std::string& file) { return present(file) ? json::parse_file(data_folder + "/" + file) : json::Value{}; }

}  // namespace reference
