// SPDX-License-Identifier: MIT
#include "apps/files.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace apps {
namespace {

std::atomic<const char*> unfinished{nullptr};

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

// Where the bytes end up: the file that a symbolic link names.
std::filesystem::path target_of(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_symlink(path, failed)) { return path; }
  const auto target = std::filesystem::weakly_canonical(path, failed);
  return failed ? std::filesystem::path(path) : target;
}

// A new file beside `target` under a name that nobody has; -1 with errno set when there is none to be had.
int open_temporary(const std::filesystem::path& target, std::string& name) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    const std::string hidden = ".halflight-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp";
    name = (folder_of(target) / hidden).string();
    const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) { return file; }
  }
  return -1;
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) { continue; }
    if (written <= 0) { return false; }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// On Linux write-back errors (a full quota, a lost share) may show at fsync or close only.
bool fill_and_close(int file, std::string_view bytes, const std::filesystem::path& target) {
  struct ::stat old {};
  if (::stat(target.c_str(), &old) == 0) { static_cast<void>(::fchmod(file, old.st_mode & 07777U)); }
  const bool filled = write_all(file, bytes) && ::fsync(file) == 0;
  const int code = errno;
  const bool closed = ::close(file) == 0;
  if (!filled) { errno = code; }
  return filled && closed;
}

}  // namespace

std::optional<std::string> check_writable(const std::string& path) {
  std::error_code failed;
  const std::filesystem::path target = target_of(path);
  if (std::filesystem::is_directory(target, failed)) { return path + " is a folder"; }
  const std::filesystem::path folder = folder_of(target);
  if (!std::filesystem::is_directory(folder, failed)) { return "there is no folder " + folder.string() + " to write " + path + " to"; }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) { return "cannot write to the folder " + folder.string() + ": " + std::strerror(errno); }
  return std::nullopt;
}

std::optional<std::string> write_file(const std::string& path, std::string_view bytes) {
  const std::filesystem::path target = target_of(path);
  std::string temporary;
  const auto failure = [&] { return "cannot write " + path + ": " + std::strerror(errno); };
  const int file = open_temporary(target, temporary);
  if (file < 0) { return failure(); }
  unfinished.store(temporary.c_str());
  std::optional<std::string> fault;
  if (!fill_and_close(file, bytes, target) || ::rename(temporary.c_str(), target.c_str()) != 0) {
    fault = failure();
    ::unlink(temporary.c_str());
  }
  unfinished.store(nullptr);
  return fault;
}

void remove_unfinished_file() noexcept {
  if (const char* name = unfinished.load()) { ::unlink(name); }
}

}  // namespace apps
