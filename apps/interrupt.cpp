// SPDX-License-Identifier: MIT
#include "apps/interrupt.hpp"

#include <csignal>

#include <unistd.h>

#include "apps/exit_code.hpp"
#include "apps/files.hpp"

namespace apps {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

extern "C" void on_signal(int) {
  if (interrupted.exchange(true)) {
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
