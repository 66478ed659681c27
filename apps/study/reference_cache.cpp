// SPDX-License-Identifier: MIT
// The file that stores a reference: JSON in a fixed layout. A file is valid if the values read from it, written again, give the same text.
//
// A study stores it beside the scene, where the user has not requested a file. Therefore an existing file is replaced only if it begins
// with this scene's key, so that it is an older or damaged copy of the same values.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/bytes.hpp"
#include "apps/files.hpp"
#include "apps/intake/json_reader.hpp"
#include "apps/scene_file.hpp"
#include "apps/study/reference.hpp"
#include "apps/text.hpp"

namespace study {
namespace {

// The beginning of a file for this key.
std::string opening(const std::string& key) { return "{\n  \"halflight_reference\": 1,\n  \"key\": \"" + key + "\",\n"; }

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
  apps::Checksum sum;
  sum.add(truth.paths);
  sum.add(values);
  return opening(key) + "  \"checksum\": \"" + sum.text() + "\",\n  \"paths\": " + std::to_string(truth.paths) +
         ",\n  \"points\": " + std::to_string(truth.points.size()) +
         ",\n  \"columns\": \"radiosity and standard error of each channel\",\n  \"values\": [" + values + "]\n}\n";
}

bool from_cache(std::string_view file, const std::string& key, std::uint64_t least, TrueRadiosity& truth) {
  apps::JsonFault unused;
  const std::optional<apps::JsonValue> root = apps::parse_json(file, unused);
  if (!root) { return false; }
  const std::optional<std::size_t> paths = (*root)["paths"].index();
  const std::vector<apps::JsonValue>& values = (*root)["values"].items();
  if (!paths || *paths < least || values.size() != 6 * truth.points.size()) { return false; }
  TrueRadiosity read = truth;
  read.paths = *paths;
  for (std::size_t i = 0; i < read.points.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      read.points[i].radiosity[static_cast<int>(c)] = values[6 * i + c].number();
      read.points[i].standard_error[static_cast<int>(c)] = values[6 * i + 3 + c].number();
    }
  }
  if (to_cache(read, key) != file) { return false; }  // another key, or damaged: then the checksum is not that of the values
  truth = std::move(read);
  truth.cached = true;
  return true;
}

}  // namespace study
