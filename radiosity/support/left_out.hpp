// SPDX-License-Identifier: MIT
#pragma once

// One thing that a run did not do, because the scene does not need it.

#include <string>

namespace radiosity {

struct LeftOut {
  std::string what;
  std::string why;
  std::string saved;
  double seconds = 0.0;  // of CPU time that were saved, about; 0: not known
};

}  // namespace radiosity
