// SPDX-License-Identifier: MIT
#include "apps/scene_source.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "apps/bytes.hpp"

namespace apps {
namespace {

void put_text(std::string& out, std::string_view text) {
  put(out, std::uint64_t{text.size()});
  out += text;
}

// What the bytes have not is zero or empty, and sound() is false from then on.
class SourceReader {
 public:
  explicit SourceReader(std::string_view bytes) : rest_{bytes} {}
  [[nodiscard]] bool sound() const { return sound_; }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  void require(bool sound) { sound_ = sound_ && sound; }
  [[nodiscard]] std::uint64_t bits(std::size_t size) {
    const std::string_view taken = take(size);
    return taken.empty() ? 0 : bits_at(taken, 0, size);
  }
  [[nodiscard]] double number() {
    const auto value = std::bit_cast<double>(bits(8));
    require(std::isfinite(value));
    return value;
  }
  [[nodiscard]] glm::dvec3 vector() {
    glm::dvec3 v{0.0};
    for (int c = 0; c < 3; ++c) { v[c] = number(); }
    return v;
  }
  [[nodiscard]] std::string text() { return std::string(take(bits(8))); }

 private:
  [[nodiscard]] std::string_view take(std::uint64_t size) {
    require(size <= rest_.size());
    if (!sound_) { return {}; }
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  std::string_view rest_;
  bool sound_ = true;
};

void put_options(std::string& out, const ModelOptions& options) {
  for (const double value : {options.reflectance, options.metres}) { put(out, value); }
  const auto up = options.up ? static_cast<std::uint8_t>(1 + static_cast<int>(*options.up)) : std::uint8_t{0};
  for (const std::uint8_t choice : {std::uint8_t{options.two_sided}, std::uint8_t{options.merge}, up}) { put(out, choice); }
  put(out, std::uint64_t{options.lamps.size()});
  for (const Lamp& lamp : options.lamps) {
    put_text(out, lamp.material);
    put(out, lamp.exitance);
  }
  put(out, std::uint8_t{options.camera.has_value()});
  if (!options.camera) { return; }
  for (const glm::dvec3& v : {options.camera->eye, options.camera->forward, options.camera->up}) { put(out, v); }
}

ModelOptions get_options(SourceReader& in) {
  ModelOptions options;
  options.reflectance = in.number();
  options.metres = in.number();
  in.require(options.reflectance >= 0.0 && options.reflectance <= most_reflectance && options.metres > 0.0);
  options.two_sided = in.bits(1) != 0;
  options.merge = in.bits(1) != 0;
  if (const std::uint64_t up = in.bits(1); up > 0) { options.up = static_cast<UpAxis>(std::min<std::uint64_t>(up, 3) - 1); }
  for (std::uint64_t left = in.bits(8); left > 0 && in.sound(); --left) {
    std::string material = in.text();
    options.lamps.push_back({std::move(material), in.number()});
    in.require(options.lamps.back().exitance >= 0.0);
  }
  if (in.bits(1) != 0) {
    radiosity::Camera& camera = options.camera.emplace();
    camera.eye = in.vector();
    camera.forward = in.vector();
    camera.up = in.vector();
    in.require(glm::length(glm::cross(camera.forward, camera.up)) > 0.0);
  }
  return options;
}

}  // namespace

std::string to_bytes(const SceneSource& source) {
  std::string out;
  put_text(out, source.path);
  put_text(out, source.text);
  put(out, std::uint64_t{source.beside.size()});
  for (const FileBeside& file : source.beside) {
    put_text(out, file.name);
    put_text(out, file.bytes);
  }
  put_options(out, source.options);
  return out;
}

std::optional<SceneSource> read_scene_source(std::string_view bytes) {
  SourceReader in(bytes);
  SceneSource source;
  source.path = in.text();
  source.text = in.text();
  for (std::uint64_t left = in.bits(8); left > 0 && in.sound(); --left) {
    std::string name = in.text();
    source.beside.push_back({std::move(name), {}, in.text()});
  }
  source.options = get_options(in);
  return in.sound() && in.at_end() ? std::optional(std::move(source)) : std::nullopt;
}

SideFile files_of(const SceneSource& source) {
  return [&source](const std::string& name, std::string& fault) -> std::optional<std::string> {
    const auto found = std::find_if(source.beside.begin(), source.beside.end(), [&](const FileBeside& file) { return file.name == name; });
    if (found != source.beside.end()) { return found->bytes; }
    fault = "is not in the .light file";
    return std::nullopt;
  };
}

}  // namespace apps
