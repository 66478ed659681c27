// SPDX-License-Identifier: MIT
#pragma once

// Where outputs go, which is known and checked before any work, and how they are written: completely or not at all.
//
// Pipes, terminals, devices such as /dev/null, and inherited streams (/dev/stdout, /dev/fd/3; "-" is the standard output) are opened and
// written, never replaced. Symbolic links are followed to their end, even if the file there does not exist yet. A regular file is written
// under a temporary name beside its target and then renamed, so the target is always the old file or the complete new one. If writing
// fails, or the program is terminated while it writes (remove_unfinished_file), the temporary file is removed and the old file remains.
//
// The functions return a sentence that says what went wrong, or nothing.

#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace apps {

// Why the output cannot be written (its folder is missing or protected, the path is a folder, the file is protected), or nothing if it can.
[[nodiscard]] std::optional<std::string> check_writable(const std::string& path);

// Do both paths lead to one file, through '.', '..', symbolic or hard links?
[[nodiscard]] bool same_output(const std::string& a, const std::string& b);

// Does output to this path appear on the standard output?
[[nodiscard]] bool is_standard_output(const std::string& path);

struct OutputFault {
  std::string sentence;
  bool usage = false;  // two names for one file; otherwise the output cannot be written
};
// Every output must be a file of its own: not another output, not an input, and not the target of the program's standard output or error.
// Empty names are ignored; an input "-" is the standard input.
[[nodiscard]] std::optional<OutputFault> check_output_paths(const std::vector<std::string>& outputs,
                                                            const std::vector<std::string>& inputs);

// --- writing

// Replaces the file at `path` by `bytes`, or writes them to the stream named by it. The permissions of an old file are kept, except
// setuid and setgid. A pipe whose reader has closed it is not an error: the reader has read what it wanted.
[[nodiscard]] std::optional<std::string> write_file(const std::string& path, std::string_view bytes);

// Creates a folder for later files, unless it exists. The destructor removes it again if it is still empty, e.g. after an interrupted
// command.
class NewFolder {
 public:
  explicit NewFolder(std::string path);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  // Why there is no such folder; nothing if there is one.
  [[nodiscard]] std::optional<std::string> fault() const;

 private:
  std::string path_;
  std::error_code failed_;
  bool made_ = false;
};

// Removes the temporary file that write_file() is writing, if any. Async-signal-safe, for signal handlers.
void remove_unfinished_file() noexcept;

}  // namespace apps
