// SPDX-License-Identifier: MIT
// The file that keeps a reference: JSON in one fixed layout, so that a reader compares its head with the expected text and reads numbers.
#include <charconv>
#include <cmath>

#include "apps/study/checksum.hpp"
#include "apps/study/reference.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

// Everything before the values.
std::string head(const std::string& key, const std::string& checksum, std::uint64_t paths, std::size_t points) {
  return "{\n  \"halflight_reference\": 1,\n  \"key\": \"" + key + "\",\n  \"checksum\": \"" + checksum +
         "\",\n  \"paths\": " + std::to_string(paths) + ",\n  \"points\": " + std::to_string(points) +
         ",\n  \"columns\": \"radiosity and standard error of each channel\",\n  \"values\": [";
}
constexpr std::string_view tail = "]\n}\n";

std::string checksum_of(std::uint64_t paths, std::string_view values) {
  Checksum sum;
  sum.add(paths);
  sum.add(values);
  return sum.text();
}

// The number after the first `name` in the file.
std::optional<std::uint64_t> count_after(std::string_view file, std::string_view name) {
  const std::size_t at = file.find(name);
  if (at == std::string_view::npos) { return std::nullopt; }
  std::uint64_t value = 0;
  const char* const begin = file.data() + at + name.size();
  return std::from_chars(begin, file.data() + file.size(), value).ec == std::errc() ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string to_cache(const TrueRadiosity& truth, const std::string& key) {
  std::string values;
  for (const ReferencePoint& p : truth.points) {
    values += values.empty() ? "\n" : ",\n";
    for (int c = 0; c < 3; ++c) { values += apps::shortest(p.radiosity[c]) + ","; }
    for (int c = 0; c < 3; ++c) { values += apps::shortest(p.standard_error[c]) + (c < 2 ? "," : ""); }
  }
  return head(key, checksum_of(truth.paths, values), truth.paths, truth.points.size()) + values + std::string(tail);
}

bool from_cache(std::string_view file, const std::string& key, std::uint64_t least, TrueRadiosity& truth) {
  const std::optional<std::uint64_t> paths = count_after(file, "\"paths\": ");
  const std::size_t bracket = file.find('[');
  if (!paths || *paths < least || bracket == std::string_view::npos || !file.ends_with(tail)) { return false; }
  const std::string_view values = file.substr(bracket + 1, file.size() - tail.size() - bracket - 1);
  const std::string expected = head(key, checksum_of(*paths, values), *paths, truth.points.size());
  if (file.substr(0, bracket + 1) != expected) { return false; }

  std::vector<double> numbers;
  numbers.reserve(6 * truth.points.size());
  const char* at = values.data();
  const char* const end = at + values.size();
  while (at != end) {
    at += *at == '\n' ? 1 : 0;
    double x = 0.0;
    const auto [next, code] = std::from_chars(at, end, x);
    if (code != std::errc() || !std::isfinite(x) || (next != end && *next != ',')) { return false; }
    numbers.push_back(x);
    at = next == end ? end : next + 1;
  }
  if (numbers.size() != 6 * truth.points.size()) { return false; }
  for (std::size_t i = 0; i < truth.points.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      truth.points[i].radiosity[c] = numbers[6 * i + static_cast<std::size_t>(c)];
      truth.points[i].standard_error[c] = numbers[6 * i + 3 + static_cast<std::size_t>(c)];
    }
  }
  truth.paths = *paths;
  truth.cached = true;
  return true;
}

}  // namespace study
