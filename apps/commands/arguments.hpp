// SPDX-License-Identifier: MIT
#pragma once

// Values of options: each check says what was expected and what was found, in words for the user.

#include <charconv>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/scene_file/words.hpp"

namespace apps {

inline constexpr std::uint64_t most_threads = 1024;

// A number in (0, most]; NaN is refused, too.
[[nodiscard]] inline CLI::Validator above_zero(double most) {
  return CLI::Validator(
      [most](std::string& text) {
        double value = 0.0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool good = code == std::errc() && end == text.data() + text.size() && value > 0.0 && value <= most;
        return good ? std::string() : "expected a number above 0 and at most " + CLI::detail::to_string(most) + ", found '" + text + "'";
      },
      "NUMBER");
}

// Digits alone: no sign, so that -1 does not become the largest number.
[[nodiscard]] inline CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        std::uint64_t value = 0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool good = code == std::errc() && end == text.data() + text.size() && value >= least && value <= most;
        return good ? std::string()
                    : "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most) + ", found '" + text + "'";
      },
      "NUMBER");
}

// One of the names; the value that it stands for goes into the option.
template <class Value>
[[nodiscard]] CLI::Validator one_of(const std::map<std::string, Value>& known) {
  return CLI::Validator(
      [known](std::string& text) {
        if (const auto found = known.find(text); found != known.end()) {
          text = std::to_string(static_cast<int>(found->second));
          return std::string();
        }
        std::vector<std::string_view> names;
        for (const auto& [name, value] : known) { names.push_back(name); }
        return "expected " + scene_file::list_of(names) + ", found '" + text + "'" + scene_file::suggestion(text, names);
      },
      "NAME");
}

}  // namespace apps
