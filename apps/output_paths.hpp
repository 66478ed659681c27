// SPDX-License-Identifier: MIT
#pragma once

// Where outputs go, known and checked before any work. One check serves every command.
//
// A regular file is replaced whole (files.hpp). Pipes, terminals, devices such as /dev/null, and the streams that the program was started
// with (/dev/stdout, /dev/fd/3; "-" is the standard output) are opened and written, never replaced. Symbolic links are followed to their
// end, even when the file at the end does not exist yet.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace apps {

struct Destination {
  std::filesystem::path path;  // behind all symbolic links
  int descriptor = -1;         // of a stream that the program was started with
  bool through = false;        // no regular file: opened, written, closed
};

// Nothing when the path leads nowhere; errno says why.
[[nodiscard]] std::optional<Destination> destination(const std::string& path);

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

}  // namespace apps
