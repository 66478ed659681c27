// SPDX-License-Identifier: MIT
// What the command line says about files of other formats, and how it is written.
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "apps/intake/to_scene.hpp"
#include "apps/text.hpp"

namespace apps {
namespace {

std::optional<double> positive(std::string_view text, bool zero) {
  const auto value = number_in<double>(text);
  return value && (*value > 0.0 || (zero && *value == 0.0)) && *value <= 1e12 ? value : std::nullopt;
}

}  // namespace

std::string ModelOptions::key() const {
  std::string text =
      formatted("%.17g", reflectance) + formatted(" %.17g", metres) + (two_sided ? " two-sided" : "") + (merge ? "" : " as given");
  if (up) { text += " up " + std::to_string(static_cast<int>(*up)); }
  for (const Lamp& lamp : lamps) { text += " lamp " + lamp.material + formatted("=%.17g", lamp.exitance); }
  return text;
}

std::optional<Lamp> parse_lamp(std::string_view text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string_view::npos) { return text.empty() ? std::nullopt : std::optional(Lamp{std::string(text)}); }
  const auto value = positive(text.substr(equals + 1), true);
  if (!value || equals == 0) { return std::nullopt; }
  return Lamp{std::string(text.substr(0, equals)), *value};
}

std::optional<double> parse_unit(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 6> units{
      {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"km", 1e3}, {"in", 0.0254}, {"ft", 0.3048}}};
  for (const auto& [name, metres] : units) {
    if (name == text) { return metres; }
  }
  return positive(text, false);
}

}  // namespace apps
