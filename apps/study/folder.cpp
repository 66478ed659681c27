// SPDX-License-Identifier: MIT
#include "apps/study/folder.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <system_error>
#include <utility>

#include "apps/files.hpp"
#include "apps/study/error_picture.hpp"
#include "apps/study/plot.hpp"
#include "apps/study/svg.hpp"

namespace study {
namespace {

// A file's name and what makes its bytes, when it is its turn.
struct File {
  std::string name;
  std::function<std::string()> bytes;
};

// Letters, digits and '-' stay, anything else becomes '_'; a letter beyond ASCII stays as it is.
std::string file_name(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       (static_cast<unsigned char>(c) & 0x80U) != 0;
    if (plain) {
      result += c;
    } else if (!result.empty() && result.back() != '_') {
      result += '_';
    }
  }
  return result;
}

std::vector<File> files(const Study& study) {
  std::vector<File> result;
  const auto add = [&result](const std::string& stem, const std::string& ending, std::function<std::string()> bytes) {
    std::string name = stem + ending;
    const auto taken = [&] { return std::any_of(result.begin(), result.end(), [&](const File& f) { return f.name == name; }); };
    for (int i = 2; taken(); ++i) { name = stem + "_" + std::to_string(i) + ending; }
    result.push_back({std::move(name), std::move(bytes)});
  };
  add("index", ".html", [&study] { return page(study); });
  add("results", ".csv", [&study] { return to_csv(study); });
  add("results", ".json", [&study] { return to_json(study); });
  for (const SceneStudy& scene : study.scenes) {
    const std::string stem = file_name(scene.scene) + "_";
    for (Figure& figure : figures(study, scene)) {
      add(stem + figure.name, ".svg", [figure] { return to_svg_file(figure.drawing, figure.caption); });
    }
    const double limit = error_limit(scene);
    for (const ErrorPicture& picture : scene.pictures) {
      add(stem + "error_" + file_name(picture.method), ".svg", [&scene, &picture, limit] {
        return to_svg_file(error_figure(picture, scene.camera, limit), "error picture: " + picture.method + ", " + picture.setting);
      });
    }
  }
  return result;
}

}  // namespace

std::vector<std::string> page_files(const Study& study) {
  std::vector<std::string> names;
  for (const File& file : files(study)) { names.push_back(file.name); }
  return names;
}

std::optional<std::string> write_pages(const Study& study, const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) { return "cannot make the folder " + folder + ": " + failed.message(); }
  for (const File& file : files(study)) {
    if (auto fault = apps::write_file((std::filesystem::path(folder) / file.name).string(), file.bytes())) { return fault; }
  }
  return std::nullopt;
}

}  // namespace study
