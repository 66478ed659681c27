// SPDX-License-Identifier: MIT
#include "apps/intake/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/camera/tone.hpp>

#include "apps/gzip.hpp"

#if defined(__clang__)  // stb_image shifts negative numbers
#pragma clang attribute push(__attribute__((no_sanitize("undefined"))), apply_to = function)
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#include <stb/stb_image.h>
#if defined(__clang__)
#pragma clang attribute pop
#endif

namespace apps {

bool inflate(std::string_view stream, std::span<char> out) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (stream.size() > most || out.size() > most) { return false; }
  const int size = static_cast<int>(out.size());
  return stbi_zlib_decode_noheader_buffer(out.data(), size, stream.data(), static_cast<int>(stream.size())) == size;
}

}  // namespace apps

namespace apps::intake {

std::shared_ptr<const Picture> Picture::read(std::string_view bytes) {
  if (bytes.empty() || bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) { return nullptr; }
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  constexpr std::size_t most_pixels = std::size_t{1} << 26;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0 || width <= 0 || height <= 0) { return nullptr; }
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (pixels > most_pixels) { return nullptr; }
  const std::unique_ptr<stbi_uc, void (*)(void*)> image(stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  return image ? of_pixels(static_cast<std::uint32_t>(width), {image.get(), 4 * pixels}) : nullptr;
}

std::shared_ptr<const Picture> Picture::of_pixels(std::uint32_t width, std::span<const std::uint8_t> rgba) {
  constexpr std::uint32_t most_side = 256;
  const auto height = static_cast<std::uint32_t>(width == 0 ? 0 : rgba.size() / 4 / width);
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) {
    linear[i] = static_cast<float>(radiosity::srgb_decode(static_cast<double>(i) / 255.0));
  }
  auto picture = std::make_shared<Picture>();
  picture->width_ = std::min(width, most_side);
  picture->height_ = std::min(height, most_side);
  picture->pixels_.resize(std::size_t{picture->width_} * picture->height_);
  glm::dvec4 sum(0.0);
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::size_t row = std::size_t{y} * picture->height_ / height * picture->width_;
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint8_t* const p = &rgba[4 * (std::size_t{y} * width + x)];
      const float opaque = static_cast<float>(p[3]) / 255.0F;
      const glm::vec4 pixel(opaque * linear[p[0]], opaque * linear[p[1]], opaque * linear[p[2]], opaque);
      picture->pixels_[row + std::size_t{x} * picture->width_ / width] += pixel;
      sum += glm::dvec4(pixel);
      picture->most_opaque_ = std::max(picture->most_opaque_, static_cast<double>(p[3]) / 255.0);
    }
  }
  if (!(sum.w > 0.0)) { return nullptr; }
  picture->mean_ = radiosity::Color(sum) / sum.w;
  picture->sum_rows();
  return picture;
}

void Picture::sum_rows() {
  float brightest = 0.0F;
  for (const glm::vec4& p : pixels_) { brightest = std::max({brightest, p.x, p.y, p.z}); }
  dark_ = brightest / 1000.0F;
  Sums all;
  before_.reserve(std::size_t{width_ + 1} * height_);
  for (std::size_t row = 0; row < height_; ++row) {
    Sums sum;
    for (std::size_t x = 0; x < width_; ++x) {
      before_.push_back(sum);
      sum.add(pixel(row * width_ + x), 1.0);
    }
    before_.push_back(sum);
    all.add(sum, 1.0);
  }
  whole_ = all.part();
}

void Picture::Sums::add(const Sums& other, double times) {
  color += times * other.color;
  squares += times * other.squares;
  bright += times * other.bright;
}

Picture::Part Picture::Sums::part() const {
  const radiosity::Color mean = glm::max(radiosity::Color(color) / color.w, 0.0);  // differences of sums have rounding
  return {mean, std::max(0.0, squares / color.w - glm::dot(mean, mean)), !(bright > 0.0)};
}

Picture::Sums Picture::pixel(std::size_t index) const {
  const glm::dvec4 p(pixels_[index]);
  const radiosity::Color color(p);
  return {p, p.w > 0.0 ? glm::dot(color, color) / p.w : 0.0, std::max({p.x, p.y, p.z}) > dark_ ? 1.0 : 0.0};
}

Picture::Sums Picture::along_row(std::size_t row, double x) const {
  const double repeats = std::floor(x / width_);
  const double within = std::clamp(x - repeats * width_, 0.0, static_cast<double>(width_));
  const std::size_t whole = std::min(static_cast<std::size_t>(within), std::size_t{width_ - 1});
  const Sums* const before = &before_[row * (width_ + 1)];
  Sums sum = before[whole];
  sum.add(before[width_], repeats);
  sum.add(pixel(row * width_ + whole), within - static_cast<double>(whole));
  return sum;
}

namespace {

using Triangle = std::array<glm::dvec2, 3>;  // in pixels

double area_of(const Triangle& t) {
  const glm::dvec2 ab = t[1] - t[0], ac = t[2] - t[0];
  return 0.5 * std::abs(ab.x * ac.y - ab.y * ac.x);
}

// For a triangle whose corners lie on a line, as on a strip of colours: one of about the same points that is a hundredth of a pixel wide.
Triangle widened(Triangle t) {
  const auto side = [&](std::size_t opposite) { return t[(opposite + 2) % 3] - t[(opposite + 1) % 3]; };
  std::size_t moved = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (glm::length(side(i)) > glm::length(side(moved))) { moved = i; }
  }
  const glm::dvec2 along = side(moved);
  (std::abs(along.x) > std::abs(along.y) ? t[moved].y : t[moved].x) += 0.01;
  return t;
}

}  // namespace

Picture::Part Picture::on_triangle(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) const {
  const glm::dvec2 size(width_, height_);
  constexpr double rounding = 1e-6;  // of the sums of a row, in pixels: coordinates are floats
  Triangle corners{a * size, b * size, c * size};
  if (area_of(corners) <= rounding) { corners = widened(corners); }
  const double area = area_of(corners);
  const double top = std::min({corners[0].y, corners[1].y, corners[2].y}), bottom = std::max({corners[0].y, corners[1].y, corners[2].y});
  constexpr double most_repeats = 16.0, far = 1e9;
  if (!(bottom - top <= most_repeats * height_)) { return whole_; }
  for (const glm::dvec2& p : corners) {
    if (!(std::abs(p.x) < far && std::abs(p.y) < far)) { return whole_; }
  }
  const auto row_of = [&](double y) { return static_cast<std::size_t>(y - std::floor(y / height_) * height_) % height_; };
  Sums sum;
  const auto add_strip = [&](double y, double height) {
    double left = far, right = -far;  // where the sides of the triangle cross it
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 &p = corners[i], &q = corners[(i + 1) % 3];
      if ((p.y <= y) == (q.y <= y)) { continue; }
      const double x = p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (!(left < right)) { return; }
    sum.add(along_row(row_of(y), right), height);
    sum.add(along_row(row_of(y), left), -height);
  };
  // More than pixels from left to right, because a thin triangle may cross many of them in a row.
  const auto [left_end, right_end] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const double least_strips = std::clamp(4.0 * (right_end - left_end), 64.0, 4096.0);
  for (double row = std::floor(top); row < bottom; row += 1.0) {
    const double from = std::max(row, top), height = std::min(row + 1.0, bottom) - from;
    const double strips = std::ceil(least_strips * height / (bottom - top));
    for (double i = 0.0; i < strips; i += 1.0) { add_strip(from + (i + 0.5) / strips * height, height / strips); }
  }
  if (area <= rounding) {  // as in a palette, where all corners lie at one colour
    const glm::dvec2 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    sum = pixel(row_of(middle.y) * width_ + static_cast<std::size_t>(middle.x - std::floor(middle.x / width_) * width_) % width_);
  }
  return sum.color.w > rounding * area ? sum.part() : whole_;
}

}  // namespace apps::intake
