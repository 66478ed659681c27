// SPDX-License-Identifier: MIT
#pragma once

// Signals. Whatever ends the program - Ctrl-C, kill, a closed terminal, a limit of time - a file that is being written is removed first.
//
// A command that can stop early calls watch_interrupts(): the first signal then sets a flag that the solver and the picture look at, and
// the command ends with nothing half-written; a second one ends the program at once. Without, the first one does.
//
// A write beyond the limit of file size, or to a closed pipe, raises no signal: the write fails with an error.

#include <atomic>

namespace apps {

// Installs the handlers. Called once, before anything else.
void guard_process();

// From now on the first signal sets the flag.
const std::atomic<bool>& watch_interrupts();

}  // namespace apps
