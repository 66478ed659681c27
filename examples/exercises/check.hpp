// SPDX-License-Identifier: MIT
#pragma once

// What the programming exercises are tested with: the first thing that is wrong ends the program with a sentence.

#include <cstdio>
#include <cstdlib>
#include <string>

inline void check(bool holds, const std::string& sentence) {
  if (holds) { return; }
  std::printf("not yet: %s\n", sentence.c_str());
  std::exit(1);
}

inline int solved(const char* name) {
  std::printf("%s: solved\n", name);
  return 0;
}
