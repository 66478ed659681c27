// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/mesh_file/reading.hpp"
#include "apps/vrml/scene_graph.hpp"

namespace apps::vrml {

std::string name_beside(const std::shared_ptr<const std::string>& file, std::string_view url) {
  if (url.empty() || url.find("://") != url.npos || url.starts_with("urn:")) { return {}; }
  std::string name(url);
  std::replace(name.begin(), name.end(), '\\', '/');  // some programs write paths as their system has them
  if (file != nullptr) { name.insert(0, *file, 0, file->rfind('/') + 1); }
  return std::filesystem::path(name).lexically_normal().generic_string();  // so that each file has only one name
}

const ParsedFile* OtherFiles::read(const std::string& name, const std::string& place) {
  constexpr std::size_t most = 1000, deepest = 20;
  const auto [known, is_new] = files_.emplace(name, nullptr);
  if (!is_new) { return known->second.get(); }
  std::string fault = depth_ >= deepest ? "is named by a file that is named by a file, and so on" : "is one of too many";
  const bool allowed = !name.empty() && files_.size() <= most && depth_ < deepest;
  const auto text = allowed ? side_file_(name, fault) : std::nullopt;
  if (!text) {
    notes_.add("the file " + mesh_file::shown(name) + " " + fault + ": left out", place);
    return nullptr;
  }
  Errors errors;
  ++depth_;
  auto parsed = parse(*text, errors, notes_, *this, std::make_shared<const std::string>(name));
  --depth_;
  if (errors.count() > 0) {
    notes_.add("left out " + first_error(errors.take(), name), place);
    return nullptr;
  }
  return (files_[name] = std::make_unique<ParsedFile>(std::move(parsed))).get();
}

std::shared_ptr<const Prototype> OtherFiles::prototype(std::string_view url, const std::shared_ptr<const std::string>& in,
                                                       const std::string& place) {
  const std::size_t mark = std::min(url.find('#'), url.size());
  const std::string name = name_beside(in, url.substr(0, mark));
  const ParsedFile* const file = name.empty() ? nullptr : read(name, place);
  if (file == nullptr) { return nullptr; }
  return mark < url.size() ? file->prototypes.find(url.substr(mark + 1)) : file->prototypes.first();
}

}  // namespace apps::vrml
