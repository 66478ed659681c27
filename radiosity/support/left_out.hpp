// SPDX-License-Identifier: MIT
#pragma once

// A shortcut: something that a run did not do because the scene does not need it.

#include <string>

namespace radiosity {

struct LeftOut {
  std::string what;
  std::string why;
  std::string saved;
  double seconds = 0.0;  // approximate CPU time saved; 0: unknown
};

}  // namespace radiosity
