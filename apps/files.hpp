// SPDX-License-Identifier: MIT
#pragma once

// Where outputs go, known and checked before any work, and how they are written: whole files or none.
//
// Pipes, terminals, devices such as /dev/null, and the streams that the program was started with (/dev/stdout, /dev/fd/3; "-" is the
// standard output) are opened and written, never replaced. Symbolic links are followed to their end, even when the file at the end does not
// exist yet. A regular file is written under a temporary name beside its target and then renamed, so at every moment the target is the old
// file or the complete new one. When writing fails, or the program is ended while it writes (remove_unfinished_file), the temporary is
// removed and the old file stays.
//
// Functions return a sentence that says what went wrong, or nothing.

#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace apps {

// Why the output cannot be written: its folder is missing or protected, the path is a folder, the file is protected. Nothing when it can.
[[nodiscard]] std::optional<std::string> check_writable(const std::string& path);

// Whether both paths lead to one file: through '.', '..', symbolic and hard links.
[[nodiscard]] bool same_output(const std::string& a, const std::string& b);

// Whether what is written there appears on the standard output.
[[nodiscard]] bool is_standard_output(const std::string& path);

struct OutputFault {
  std::string sentence;
  bool usage = false;  // two names of one file; otherwise the output cannot be written
};
// Every output must be a file of its own: no other output, none of the inputs, not where the program's own words go. Empty names are
// passed over, an input "-" is the standard input.
[[nodiscard]] std::optional<OutputFault> check_output_paths(const std::vector<std::string>& outputs,
                                                            const std::vector<std::string>& inputs);

// --- writing

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
  // Why there is no such folder; nothing when there is one.
  [[nodiscard]] std::optional<std::string> fault() const;

 private:
  std::string path_;
  std::error_code failed_;
  bool made_ = false;
};

// Removes the temporary that write_file() has open just now, if any. For signal handlers: async-signal-safe.
void remove_unfinished_file() noexcept;

}  // namespace apps
