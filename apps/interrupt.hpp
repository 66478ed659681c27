// SPDX-License-Identifier: MIT
#pragma once

// Ctrl-C. The first SIGINT or SIGTERM sets a flag that the solver and the picture look at; the command then ends with
// nothing half-written. A second one ends the program at once, after removing a file that was being written.

#include <atomic>

namespace apps {

// Installs the handlers and gives the flag.
const std::atomic<bool>& watch_interrupts();

}  // namespace apps
