// SPDX-License-Identifier: MIT
#include "apps/scene_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "apps/gzip.hpp"
#include "apps/scene_file/build.hpp"
#include "apps/scene_file/grammar.hpp"
#include "apps/scene_file/parser.hpp"
#include "apps/text.hpp"

namespace apps {

SceneResult parse_scene(std::string_view text, const SideFile& side_file, const std::optional<radiosity::Camera>& first) {
  Errors errors;
  scene_file::SceneSyntax syntax = scene_file::Parser(text, errors).scene();
  if (first) { syntax.cameras.insert(syntax.cameras.begin(), {*first, {}}); }
  SceneResult result;
  SceneFile file = scene_file::build(syntax, side_file, errors);
  static_cast<ErrorReport&>(result) = errors.take();
  if (result.errors.empty()) { result.file = std::move(file); }
  return result;
}

bool begins_camera(std::string_view text) {
  const std::string_view word = text.substr(0, text.find(' '));
  return word.size() < text.size() && contains(scene_file::camera_words, word);
}

std::optional<radiosity::Camera> parse_camera(std::string_view clauses, std::string& fault) {
  std::string text = "camera given " + std::string(clauses);
  std::replace(text.begin(), text.end(), ',', ' ');
  Errors errors;
  const scene_file::SceneSyntax syntax = scene_file::Parser(text, errors).scene();
  std::optional<radiosity::Camera> camera;
  if (errors.count() == 0 && text.find('\n') == text.npos) { camera = scene_file::make_camera(syntax.cameras.front(), errors); }
  if (errors.count() > 0) {
    fault = errors.take().errors.back().sentence;  // errors about missing clauses come first, because their place is the name
    constexpr std::string_view no_file = " of the file";
    if (fault.ends_with("the end" + std::string(no_file))) { fault.resize(fault.size() - no_file.size()); }
    return std::nullopt;
  }
  if (camera) { camera->name = "(given)"; }  // not a valid name in a file
  if (!camera) { fault = "expected the clauses of one camera in one line"; }
  return camera;
}

std::string camera_text(const radiosity::Camera& camera) {
  const auto triple = [](const glm::dvec3& v, double size) {
    const double step = std::pow(10.0, std::floor(std::log10(1e-5 * size)));  // 0 for size 0, when nothing is to be rounded
    std::string text;
    for (int i = 0; i < 3; ++i) {
      text += formatted(" %.15g", step > 0.0 ? std::round(v[i] / step) * step + 0.0 : v[i]);
    }  // + 0.0: no "-0"
    return text;
  };
  const glm::dvec3 up = glm::normalize(camera.up);
  const double way = glm::length(camera.forward), place = glm::length(camera.eye);
  return "eye" + triple(camera.eye, std::min(way, place)) + " target" + triple(camera.eye + camera.forward, way) +
         (up == glm::dvec3(0.0, 0.0, 1.0) ? std::string() : " up" + triple(up, 1.0)) + formatted(" fov %.6g", camera.field_of_view);
}

std::optional<std::string> there_or_beside(const std::string& name, const SideFile& side_file, std::string& fault) {
  constexpr int most_folders = 16;
  auto bytes = side_file(name, fault);
  std::string rest = name, ignored;
  for (int i = 0; i < most_folders && !bytes; ++i) {
    const std::size_t end = i + 1 < most_folders ? rest.find_first_of("/\\") : rest.find_last_of("/\\");
    if (end == std::string::npos) { break; }
    rest.erase(0, end + 1);
    if (!rest.empty() && rest != "-" && !rest.starts_with("..")) { bytes = side_file(rest, ignored); }
  }
  return bytes;
}

std::optional<std::string> read_text(const std::string& path, std::string& fault) {
  const auto refuse = [&fault](std::string sentence) {
    fault = std::move(sentence);
    return std::nullopt;
  };
  std::error_code ignored;
  if (path.empty()) { return refuse("names no file"); }
  if (std::filesystem::is_directory(path, ignored)) { return refuse("is a folder; expected a file"); }
  const auto close = [](std::FILE* stream) { return stream == stdin ? 0 : std::fclose(stream); };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(path == "-" ? stdin : std::fopen(path.c_str(), "rb"), close);
  if (file == nullptr) { return refuse(std::string("cannot be opened: ") + std::strerror(errno)); }
  std::string text;
  std::size_t size = 0;
  constexpr std::size_t step = 1 << 16;
  while (true) {
    text.resize(size + std::min(step + size, max_file_bytes + 1 - size));
    const std::size_t got = std::fread(text.data() + size, 1, text.size() - size, file.get());
    size += got;
    if (size > max_file_bytes) {
      return refuse("is larger than " + std::to_string(max_file_bytes >> 20) + " MiB, more than halflight reads");
    }
    if (got == 0 || std::feof(file.get()) != 0) { break; }
  }
  if (std::ferror(file.get()) != 0) { return refuse(std::string("cannot be read: ") + std::strerror(errno)); }
  text.resize(size);
  return is_gzip(text) ? gunzip(text, max_file_bytes, fault) : std::optional(std::move(text));
}

}  // namespace apps
