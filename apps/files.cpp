// SPDX-License-Identifier: MIT
#include "apps/files.hpp"

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "apps/output_paths.hpp"

namespace apps {
namespace {

std::atomic<const char*> unfinished{nullptr};

// A new file beside `target`; it is removed unless it was renamed. Its name is random, so that nobody has it: a signal may remove it at any
// time from before it is made until it is gone.
class Temporary {
 public:
  explicit Temporary(const std::filesystem::path& target) {
    std::random_device random;
    const std::uint64_t number = std::uint64_t{random()} << 32U | random();
    const auto folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
    name_ = (folder / (".halflight-" + std::to_string(number) + ".tmp")).string();
    unfinished.store(name_.c_str());
    file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    made_ = file_ >= 0;
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    const int code = errno;
    if (file_ >= 0) { ::close(file_); }
    if (made_) { ::unlink(name_.c_str()); }
    unfinished.store(nullptr);
    errno = code;
  }

  [[nodiscard]] bool made() const { return made_; }
  [[nodiscard]] int file() const { return file_; }
  // On Linux write-back errors (a full quota, a lost share) may show at fsync or close only.
  bool finish(const std::filesystem::path& target) {
    if (::fsync(file_) != 0) { return false; }
    const bool closed = ::close(file_) == 0;
    file_ = -1;
    if (!closed || ::rename(name_.c_str(), target.c_str()) != 0) { return false; }
    made_ = false;
    return true;
  }

 private:
  std::string name_;
  int file_ = -1;
  bool made_ = false;
};

// A stream that nobody reads could hold the program for ever: there a signal ends the attempt.
bool write_all(int file, std::string_view bytes, bool stream) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR && !stream) { continue; }
    if (written <= 0) { return false; }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool write_through(const Destination& to, std::string_view bytes) {
  if (to.descriptor >= 0) { return std::fflush(nullptr) == 0 && write_all(to.descriptor, bytes, true); }
  const int file = ::open(to.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);  // waits for the reader of a pipe
  if (file < 0) { return false; }
  const bool written = write_all(file, bytes, true);
  const int code = errno;
  const bool closed = ::close(file) == 0;
  if (!written) { errno = code; }
  return written && closed;
}

bool replace(const Destination& to, std::string_view bytes) {
  Temporary temporary(to.path);
  if (!temporary.made()) { return false; }
  struct ::stat old {};
  if (::stat(to.path.c_str(), &old) == 0) { static_cast<void>(::fchmod(temporary.file(), old.st_mode & 0777U)); }
  return write_all(temporary.file(), bytes, false) && temporary.finish(to.path);
}

}  // namespace

std::optional<std::string> write_file(const std::string& path, std::string_view bytes) {
  const auto to = destination(path);
  const bool through = to && (to->descriptor >= 0 || to->through);
  if (to && (through ? write_through(*to, bytes) : replace(*to, bytes))) { return std::nullopt; }
  if (through && errno == EPIPE) { return std::nullopt; }  // whoever reads has read enough
  return "cannot write " + path + ": " + std::strerror(errno);
}

NewFolder::NewFolder(std::string path) : path_(std::move(path)) {
  std::error_code failed;
  made_ = std::filesystem::create_directories(path_, failed);
}

NewFolder::~NewFolder() {
  std::error_code failed;
  if (made_) { std::filesystem::remove(path_, failed); }  // does nothing when something is in it
}

void remove_unfinished_file() noexcept {
  if (const char* name = unfinished.load()) { ::unlink(name); }
}

}  // namespace apps
