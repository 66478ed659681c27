// SPDX-License-Identifier: MIT
#pragma once

// Whole files or none. A file is written under a temporary name beside its target and then renamed, so at every moment
// the target is the old file or the complete new one. When writing fails the temporary is removed and the old file
// stays; so it is when the program is interrupted while writing (see remove_unfinished_file).
//
// Functions return a sentence that says what went wrong, or nothing.

#include <optional>
#include <string>
#include <string_view>

namespace apps {

// Whether a file could be written there: its folder exists and may be written to, the path itself is no folder.
// Asked before the work begins.
[[nodiscard]] std::optional<std::string> check_writable(const std::string& path);

// Replaces the file at `path` by `bytes`. A symbolic link is followed; the permissions of an old file are kept.
[[nodiscard]] std::optional<std::string> write_file(const std::string& path, std::string_view bytes);

// Removes the temporary that write_file() has open just now, if any. For signal handlers: async-signal-safe.
void remove_unfinished_file() noexcept;

}  // namespace apps
