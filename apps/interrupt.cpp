// SPDX-License-Identifier: MIT
#include "apps/interrupt.hpp"

#include <csignal>
#include <ctime>

#include <unistd.h>

#include "apps/exit_code.hpp"
#include "apps/files.hpp"

namespace apps {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

std::atomic<long> first_signal{0};  // second at which it came
static_assert(std::atomic<long>::is_always_lock_free);

// The first signal asks the run to end, a later one ends it at once. Signals within a second of the first are the same request:
// timeout(1) sends one to the program and another to its process group.
extern "C" void on_signal(int) {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  if (!interrupted) {
    first_signal = now.tv_sec;
    interrupted = true;
  } else if (now.tv_sec > first_signal + 1) {
    remove_unfinished_file();
    ::_exit(static_cast<int>(ExitCode::failure));
  }
}

}  // namespace

const std::atomic<bool>& watch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  return interrupted;
}

}  // namespace apps
