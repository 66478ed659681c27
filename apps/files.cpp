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
#include <tuple>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "apps/text.hpp"

namespace apps {
namespace {

namespace fs = std::filesystem;

struct Destination {
  std::filesystem::path path;  // after all symbolic links
  int descriptor = -1;         // of an inherited stream; -1: none
  bool through = false;        // not a regular file: opened, written and closed in place
};

constexpr int most_links = 40;  // maximal length of a chain of symbolic links, as in Linux

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// The descriptor that a name denotes; -1 for the name of a file.
int descriptor_of(const fs::path& path) {
  const std::string& name = path.native();
  if (name == "-" || name == "/dev/stdout") { return STDOUT_FILENO; }
  if (name == "/dev/stderr") { return STDERR_FILENO; }
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!name.starts_with(folder)) { continue; }
    const auto number = number_in<int>(std::string_view(name).substr(folder.size()));
    if (number && *number >= 0) { return *number; }
  }
  return -1;
}

// Identifies a file whatever its name: device and inode, or, if it does not exist yet, those of its folder and its name. A character
// device has no identity, because /dev/null and a terminal may be named twice.
struct Identity {
  ::dev_t device = 0;
  ::ino_t number = 0;
  std::string name;
  bool operator==(const Identity& other) const {
    return std::tie(device, number, name) == std::tie(other.device, other.number, other.name);
  }
};
std::optional<Identity> identity(const struct ::stat& status, std::string name = {}) {
  if (S_ISCHR(status.st_mode) || S_ISSOCK(status.st_mode)) { return std::nullopt; }
  return Identity{status.st_dev, status.st_ino, std::move(name)};
}
std::optional<Identity> identity_of(int descriptor) {
  struct ::stat status {};
  return ::fstat(descriptor, &status) == 0 ? identity(status) : std::nullopt;
}
std::optional<Identity> identity_of(const Destination& to) {
  if (to.descriptor >= 0) { return identity_of(to.descriptor); }
  struct ::stat status {};
  if (::stat(to.path.c_str(), &status) == 0) { return identity(status); }
  return ::stat(folder_of(to.path).c_str(), &status) == 0 ? identity(status, to.path.filename().string()) : std::nullopt;
}
std::optional<Identity> identity_of_input(const std::string& path) {
  struct ::stat status {};
  if (path == "-") { return identity_of(STDIN_FILENO); }
  return ::stat(path.c_str(), &status) == 0 ? identity(status) : std::nullopt;
}

bool same(const Destination& a, const Destination& b) {
  if (a.descriptor >= 0 && a.descriptor == b.descriptor) { return true; }
  const auto first = identity_of(a);
  return first && first == identity_of(b);
}

std::string because() { return std::string(": ") + std::strerror(errno); }

// Nothing if the path cannot be resolved; errno says why.
std::optional<Destination> destination(const std::string& path) {
  Destination to{path};
  struct ::stat status {};
  for (int links = 0; links < most_links; ++links) {
    to.descriptor = descriptor_of(to.path);
    if (to.descriptor >= 0) { return to; }
    if (::lstat(to.path.c_str(), &status) != 0) { return errno == ENOENT ? std::optional(to) : std::nullopt; }
    if (!S_ISLNK(status.st_mode)) {
      to.through = !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
      return to;
    }
    std::error_code failed;
    const fs::path next = fs::read_symlink(to.path, failed);
    if (failed) {
      errno = failed.value();
      return std::nullopt;
    }
    to.path = next.is_absolute() ? next : folder_of(to.path) / next;
  }
  errno = ELOOP;
  return std::nullopt;
}

}  // namespace

std::optional<std::string> check_writable(const std::string& path) {
  const auto to = destination(path);
  if (!to) { return "cannot write " + path + because(); }
  if (to->descriptor >= 0) {
    const int mode = ::fcntl(to->descriptor, F_GETFL);
    if (mode < 0) { return "cannot write " + path + because(); }
    return (mode & O_ACCMODE) == O_RDONLY ? std::optional("cannot write " + path + ": it is open for reading only") : std::nullopt;
  }
  const std::string folder = folder_of(to->path).string();
  struct ::stat status {};
  if (::stat(to->path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) { return path + " is a folder"; }
    if (S_ISSOCK(status.st_mode)) { return path + " is a socket, which cannot be written like a file"; }
    if (::access(to->path.c_str(), W_OK) != 0) { return "cannot write " + path + because(); }
    if (to->through) { return std::nullopt; }
  }
  std::error_code failed;
  if (!fs::is_directory(folder, failed)) { return "there is no folder " + folder + " to write " + path + " to"; }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) { return "cannot write to the folder " + folder + because(); }
  return std::nullopt;
}

bool same_output(const std::string& a, const std::string& b) {
  const auto first = destination(a);
  const auto second = destination(b);
  return first && second && same(*first, *second);
}

bool is_standard_output(const std::string& path) {
  const auto to = destination(path);
  return to && to->descriptor == STDOUT_FILENO;
}

std::optional<OutputFault> check_output_paths(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  constexpr const char* own = "; each output needs a file of its own";
  std::vector<std::pair<std::string, Destination>> earlier;
  for (const std::string& path : outputs) {
    if (path.empty()) { continue; }
    const auto to = destination(path);
    if (!to) { return OutputFault{"cannot write " + path + because()}; }
    const auto which = identity_of(*to);
    for (const std::string& input : inputs) {
      if (!which || which != identity_of_input(input)) { continue; }
      return OutputFault{path + (path == input ? " is the input" : " is the input, " + input) + own, true};
    }
    for (const auto& [name, other] : earlier) {
      if (!same(*to, other)) { continue; }
      return OutputFault{(path == name ? path + " is named twice" : path + " and " + name + " are one file") + own, true};
    }
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
      if (to->descriptor >= 0 || !which || which != identity_of(stream)) { continue; }
      const char* const words = stream == STDOUT_FILENO ? "standard output" : "standard error";
      return OutputFault{path + " is where the " + words + " goes, too" + own, true};
    }
    if (auto fault = check_writable(path)) { return OutputFault{std::move(*fault)}; }
    earlier.emplace_back(path, *to);
  }
  return std::nullopt;
}

namespace {

std::atomic<const char*> unfinished{nullptr};

// A new file beside `target`, removed unless it was renamed. Its name is random, so no other file has it, and a signal handler may remove
// it at any time.
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
  // On Linux, write-back errors (a full quota, a lost network share) may appear only at fsync or close.
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

// A write to a pipe waits for the reader, perhaps forever, so for a stream a signal ends the attempt.
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
  if (through && errno == EPIPE) { return std::nullopt; }  // the reader has read what it wanted
  return "cannot write " + path + ": " + std::strerror(errno);
}

NewFolder::NewFolder(std::string path) : path_(std::move(path)) { made_ = std::filesystem::create_directories(path_, failed_); }

std::optional<std::string> NewFolder::fault() const {
  std::error_code ignored;
  if (fs::is_directory(path_, ignored)) { return std::nullopt; }
  return "cannot make the folder " + path_ + ": " + failed_.message();
}

NewFolder::~NewFolder() {
  std::error_code failed;
  if (made_) { std::filesystem::remove(path_, failed); }  // has no effect if the folder contains anything
}

void remove_unfinished_file() noexcept {
  if (const char* name = unfinished.load()) { ::unlink(name); }
}

}  // namespace apps
