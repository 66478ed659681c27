// SPDX-License-Identifier: MIT
#pragma once

// How the program ends; documented in `halflight --help`.

namespace apps {

enum class ExitCode : int {
  ok = 0,
  failure = 1,        // cannot read or write a file, out of memory, interrupted with nothing to show
  usage = 2,          // the command line is wrong
  invalid_input = 3,  // the scene file or the mesh is wrong; the output says where
  not_converged = 4,  // the error target or the residual was not reached, or interrupted; what was found is written all the same
};

}  // namespace apps
