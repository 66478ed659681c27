// SPDX-License-Identifier: MIT
// The file that stores a reference: JSON in a fixed layout, so that reading only compares its head with the expected text and reads
// numbers.
//
// A study stores it beside the scene, where the user has not requested a file. Therefore an existing file is replaced only if it begins
// with this scene's key, so that it is an older or damaged copy of the same values.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "apps/bytes.hpp"
#include "apps/files.hpp"
#include "apps/scene_file.hpp"
#include "apps/study/reference.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

// The beginning of a file for this key.
std::string opening(const std::string& key) { return "{\n  \"halflight_reference\": 1,\n  \"key\": \"" + key + "\",\n"; }

// The text before the values.
std::string text_before_values(const std::string& key, const std::string& checksum, std::uint64_t paths, std::size_t points) {
  return opening(key) + "  \"checksum\": \"" + checksum + "\",\n  \"paths\": " + std::to_string(paths) +
         ",\n  \"points\": " + std::to_string(points) +
         ",\n  \"columns\": \"radiosity and standard error of each channel\",\n  \"values\": [";
}
constexpr std::string_view tail = "]\n}\n";

std::string checksum_of(std::uint64_t paths, std::string_view values) {
  apps::Checksum sum;
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

namespace fs = std::filesystem;

// Another name for the file: "room.reference.json" becomes "room.KEY.reference.json".
std::string with_key(const std::string& path, const std::string& key) {
  const fs::path whole(path);
  const std::string name = whole.filename().string();
  const std::size_t dot = std::min(name.find('.'), name.size());
  return (whole.parent_path() / (name.substr(0, dot) + "." + key + name.substr(dot))).string();
}

enum class Place { free, ours, taken };

// May a reference be written there? Sets `text` to the content of the file if it is ours. A file that cannot be read counts as foreign,
// and so does one for another scene.
Place look_at(const std::string& path, const std::string& key, std::string& text) {
  std::error_code ignored;
  const fs::file_type type = fs::status(path, ignored).type();
  if (type == fs::file_type::not_found) { return Place::free; }
  std::string unreadable;
  std::optional<std::string> file = type == fs::file_type::regular ? apps::read_text(path, unreadable) : std::nullopt;
  if (!file || !file->starts_with(opening(key))) { return Place::taken; }
  text = std::move(*file);
  return Place::ours;
}

std::vector<std::string> places(std::vector<std::string> caches, const std::string& key) {
  if (!caches.empty()) { caches.push_back(with_key(caches.back(), key)); }
  return caches;
}

}  // namespace

bool read_cache(const std::vector<std::string>& caches, const std::string& key, std::uint64_t least, TrueRadiosity& truth) {
  for (const std::string& path : places(caches, key)) {
    std::string text;
    if (look_at(path, key, text) == Place::ours && from_cache(text, key, least, truth)) { return true; }
  }
  return false;
}

void write_cache(const std::vector<std::string>& caches, const std::string& key, TrueRadiosity& truth) {
  for (const std::string& path : places(caches, key)) {
    std::string text;
    if (look_at(path, key, text) == Place::taken) {
      truth.taken.push_back(path);
    } else if (!apps::write_file(path, to_cache(truth, key))) {
      return;
    }
  }
}

std::string to_cache(const TrueRadiosity& truth, const std::string& key) {
  std::string values;
  for (const ReferencePoint& p : truth.points) {
    values += values.empty() ? "\n" : ",\n";
    for (int c = 0; c < 3; ++c) { values += apps::shortest(p.radiosity[c]) + ","; }
    for (int c = 0; c < 3; ++c) { values += apps::shortest(p.standard_error[c]) + (c < 2 ? "," : ""); }
  }
  return text_before_values(key, checksum_of(truth.paths, values), truth.paths, truth.points.size()) + values + std::string(tail);
}

bool from_cache(std::string_view file, const std::string& key, std::uint64_t least, TrueRadiosity& truth) {
  const std::optional<std::uint64_t> paths = count_after(file, "\"paths\": ");
  const std::size_t bracket = file.find('[');
  if (!paths || *paths < least || bracket == std::string_view::npos || !file.ends_with(tail)) { return false; }
  const std::string_view values = file.substr(bracket + 1, file.size() - tail.size() - bracket - 1);
  const std::string expected = text_before_values(key, checksum_of(*paths, values), *paths, truth.points.size());
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
