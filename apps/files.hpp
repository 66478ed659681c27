// SPDX-License-Identifier: MIT
#pragma once

// Whole files or none. A regular file is written under a temporary name beside its target and then renamed, so at every moment the target
// is the old file or the complete new one. When writing fails, or the program is ended while it writes (remove_unfinished_file), the
// temporary is removed and the old file stays. Pipes, terminals and devices are opened and written (output_paths.hpp).
//
// Functions return a sentence that says what went wrong, or nothing.

#include <optional>
#include <string>
#include <string_view>

namespace apps {

// Replaces the file at `path` by `bytes`, or writes them to the stream that it names. The permissions of an old file are kept, but not
// its power to run as another user (setuid, setgid). A pipe whose reader has gone is no fault: it has read what it wanted.
[[nodiscard]] std::optional<std::string> write_file(const std::string& path, std::string_view bytes);

// Makes a folder, when it is not there, for files to come. When none has come, as of a command that was interrupted, it goes again.
class NewFolder {
 public:
  explicit NewFolder(std::string path);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

 private:
  std::string path_;
  bool made_ = false;
};

// Removes the temporary that write_file() has open just now, if any. For signal handlers: async-signal-safe.
void remove_unfinished_file() noexcept;

}  // namespace apps
