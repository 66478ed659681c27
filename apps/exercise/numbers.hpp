// SPDX-License-Identifier: MIT
#pragma once

// The exercises that are worked out by hand: a file of `name = number`, what is wrong with it, or nothing.

#include <optional>
#include <string>

namespace apps::exercise {

[[nodiscard]] std::optional<std::string> form_factors(const std::string& text);
[[nodiscard]] std::optional<std::string> push_pull(const std::string& text);
[[nodiscard]] std::optional<std::string> t_vertex(const std::string& text);

}  // namespace apps::exercise
