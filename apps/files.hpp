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
// its power to run as another user (setuid, setgid).
[[nodiscard]] std::optional<std::string> write_file(const std::string& path, std::string_view bytes);

// Removes the temporary that write_file() has open just now, if any. For signal handlers: async-signal-safe.
void remove_unfinished_file() noexcept;

}  // namespace apps
