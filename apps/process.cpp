// SPDX-License-Identifier: MIT
#include "apps/process.hpp"

#include <csignal>
#include <cstddef>
#include <new>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "apps/files.hpp"

namespace apps {
namespace {

std::atomic<bool> watched{false};
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

std::atomic<long> first_signal{0};  // time in seconds at which it arrived
static_assert(std::atomic<long>::is_always_lock_free);

constexpr std::size_t stack_needed = 1 << 20;

// Under a lower limit (`ulimit -s`) the main thread must do with the stack that there is.
[[nodiscard]] bool may_grow() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur >= 2 * stack_needed;
}

[[gnu::noinline]] void touch_stack() {
  constexpr std::size_t page = 4096;
  volatile char stack[stack_needed];
  for (std::size_t i = stack_needed; i > 0; i -= page) { stack[i - 1] = 0; }  // downwards, in the direction in which it grows
  static_cast<void>(stack[0]);
}

// Signals within a second of the first count as the same request: timeout(1) sends one to the program and another to its process group.
extern "C" void on_signal(int number) {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  if (!watched || number == SIGQUIT) {
    remove_unfinished_file();
    std::signal(number, SIG_DFL);  // so that the parent sees which signal ended the program
    ::raise(number);               // delivered when the handler returns
  } else if (!interrupted) {
    first_signal = now.tv_sec;
    interrupted = true;
  } else if (now.tv_sec > first_signal + 1) {
    remove_unfinished_file();
    ::_exit(static_cast<int>(ExitCode::failure));
  }
}

}  // namespace

void claim_stack() {
  ::operator delete(::operator new(stack_needed));  // throws if there is not so much memory
  if (may_grow()) { touch_stack(); }
}

void guard_process() {
  // Closed standard streams are opened on /dev/null, so that no other file gets their numbers. Writing to them fails, as before.
  while (true) {
    const int file = ::open("/dev/null", O_RDONLY);
    if (file < 0 || file > STDERR_FILENO) {
      if (file >= 0) { ::close(file); }
      break;
    }
  }
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  struct ::sigaction action {};
  action.sa_handler = on_signal;
  ::sigemptyset(&action.sa_mask);
  action.sa_flags = 0;  // a waiting read or write ends with EINTR
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
    struct ::sigaction old {};
    const bool ignored = ::sigaction(number, nullptr, &old) == 0 && old.sa_handler == SIG_IGN;
    if (number == SIGHUP && ignored) { continue; }  // nohup(1)
    ::sigaction(number, &action, nullptr);
  }
}

const std::atomic<bool>& watch_interrupts() {
  watched = true;
  return interrupted;
}

}  // namespace apps
