// SPDX-License-Identifier: MIT
#pragma once

// The exercises that are scripts of Euler operators: what is wrong with one, or nothing.

#include <optional>
#include <string>

namespace apps::exercise {

[[nodiscard]] std::optional<std::string> tetrahedron(const std::string& text);
[[nodiscard]] std::optional<std::string> torus(const std::string& text);
[[nodiscard]] std::optional<std::string> holes(const std::string& text);
[[nodiscard]] std::optional<std::string> dual_of_prism(const std::string& text);
[[nodiscard]] std::optional<std::string> inverse(const std::string& text);
[[nodiscard]] std::optional<std::string> break_and_mend(const std::string& text);

}  // namespace apps::exercise
