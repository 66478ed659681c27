// SPDX-License-Identifier: MIT
// Pictures as bytes: what a reader of the format gets back.
#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <optional>
#include <string>

#include <radiosity/camera/mesh_picture.hpp>
#include <radiosity/support/random.hpp>

#include "apps/commands/render_outputs.hpp"
#include "apps/picture_file.hpp"

namespace {

using radiosity::Color;

// Of 16 decades of radiance.
radiosity::Picture any_picture(std::uint64_t seed) {
  radiosity::Random random{seed, 0};
  radiosity::Picture picture{37, 11};
  for (std::size_t i = 0; i < picture.shown.size(); ++i) {
    const double scale = std::pow(10.0, 16.0 * random.uniform() - 8.0);
    picture.set(i, Color{random.uniform(), random.uniform(), random.uniform()},
                scale * Color{random.uniform(), random.uniform(), random.uniform()});
  }
  return picture;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) { value = value << 8 | static_cast<std::uint8_t>(bytes[at + k]); }
  return value;
}

}  // namespace

TEST_CASE("a PNG has its signature, its size and its exposure, chunk by chunk") {
  const std::string png = apps::to_png(radiosity::Picture{300, 2}, {6.25, radiosity::ToneCurve::filmic});
  REQUIRE(png.size() > 40);
  CHECK(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  std::string kinds;
  for (std::size_t at = 8; at + 12 <= png.size(); at += 12 + number_at(png, at)) {
    const std::string kind = png.substr(at + 4, 4), body = png.substr(at + 4, 4 + number_at(png, at));
    kinds += kind + " ";
    // The checksum by its definition: the remainder of the bits, the first and last 32 inverted, by the polynomial of ISO 3309.
    std::uint32_t remainder = 0xffffffff;
    for (const char byte : body) {
      for (int bit = 0; bit < 8; ++bit) {
        const std::uint32_t out = (remainder ^ (static_cast<std::uint8_t>(byte) >> bit)) & 1u;
        remainder = remainder >> 1 ^ (out != 0 ? 0xedb88320u : 0u);
      }
    }
    CHECK(number_at(png, at + 4 + body.size()) == ~remainder);
    if (kind == "IHDR") { CHECK(body.substr(4, 8) == std::string("\0\0\x01\x2c\0\0\0\x02", 8)); }
    if (kind == "tEXt") { CHECK(body == std::string("tEXtExposure\0", 13) + "6.25 per W/m2/sr, tone filmic"); }
  }
  CHECK(kinds == "IHDR tEXt IDAT IEND ");
}

TEST_CASE("a PFM holds the radiance in single precision, rows from the bottom") {
  const radiosity::Picture picture = any_picture(1);
  const std::string pfm = apps::to_pfm(picture);
  const std::string header = "PF\n37 11\n-1.0\n";
  REQUIRE(pfm.substr(0, header.size()) == header);
  REQUIRE(pfm.size() == header.size() + 37 * 11 * 12);
  for (std::size_t i = 0; i < picture.radiosity.size(); ++i) {
    const std::size_t row = i / 37, column = i % 37;
    float value[3];
    std::memcpy(value, pfm.data() + header.size() + 12 * ((10 - row) * 37 + column), 12);
    for (int c = 0; c < 3; ++c) {
      CHECK(double{value[c]} == test::Approx(double{picture.radiosity[i][c]} / std::numbers::pi).epsilon(1e-6));
    }
  }
}

// RGBE: channel = (mantissa + 1/2) / 256 * 2^(exponent - 128); the largest mantissa is 128 or more, so that channels are exact to half a
// step, 1 / 256 of the largest channel.
TEST_CASE("an HDR holds the radiance to half a 128th of its largest channel, and says in what unit") {
  const std::uint64_t seed = 7;
  CAPTURE(seed);
  radiosity::Picture picture = any_picture(seed);
  picture.set(5, Color{0.0}, Color{0.0});
  const std::string hdr = apps::to_hdr(picture);
  const std::string size = "\n\n-Y 11 +X 37\n";
  CHECK(hdr.substr(0, 11) == "#?RADIANCE\n");
  CHECK(hdr.find("W/m2/sr") < hdr.find(size));
  const std::size_t first = hdr.find(size) + size.size();
  REQUIRE(hdr.size() == first + 37 * 11 * 4);
  for (std::size_t i = 0; i < picture.radiosity.size(); ++i) {
    const auto* const pixel = reinterpret_cast<const std::uint8_t*>(hdr.data()) + first + 4 * i;
    const glm::vec3& b = picture.radiosity[i];
    const double largest = double{std::max({b.x, b.y, b.z})} / std::numbers::pi;
    for (int c = 0; c < 3; ++c) {
      const double value = pixel[3] == 0 ? 0.0 : std::ldexp((pixel[c] + 0.5) / 256.0, pixel[3] - 128);
      CHECK(std::abs(value - double{b[c]} / std::numbers::pi) <= largest / 256.0 * 1.0001);
    }
    CHECK((pixel[3] == 0 || std::max({pixel[0], pixel[1], pixel[2]}) >= 128));  // else a row may look compressed
  }
}

// 64 x 64 independent thresholds would be off by 0.5 / 64 in the mean, one standard error; the thresholds keep off their ends by 0.001.
TEST_CASE("dithering keeps what is a level, and between two levels the mean") {
  for (int level = 0; level < 256; ++level) {
    const double encoded = level / 255.0;
    const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    radiosity::Picture picture{16, 16};
    for (std::size_t i = 0; i < 256; ++i) { picture.set(i, Color{linear}, Color{0.0}); }
    for (const std::uint8_t byte : apps::dithered(picture)) { CHECK(int{byte} == level); }
  }
  radiosity::Random random{3, 0};
  for (int repeat = 0; repeat < 20; ++repeat) {
    radiosity::Picture picture{64, 64};
    const double linear = random.uniform();
    for (std::size_t i = 0; i < 64 * 64; ++i) { picture.set(i, Color{linear}, Color{0.0}); }
    double sum = 0.0;
    for (const std::uint8_t byte : apps::dithered(picture)) { sum += byte; }
    CHECK(std::abs(sum / (3 * 64 * 64) - 255.0 * radiosity::srgb_encode(linear)) < 0.5 / 64 + 0.001);
  }
}

TEST_CASE("exposure is a factor, or stops from the automatic one") {
  using apps::Exposure;
  CHECK(Exposure::parse("6.5")->factor == 6.5);
  CHECK_FALSE(Exposure::parse("6.5")->of_automatic);
  CHECK(Exposure::parse("1ev")->factor == 2.0);
  CHECK(Exposure::parse("+1ev")->factor == 2.0);
  CHECK(Exposure::parse("-0.5EV")->factor == test::Approx(std::sqrt(0.5)));
  CHECK(Exposure::parse("-0.5ev")->of_automatic);
  for (const char* wrong : {"", "0", "-1", "+1", "nan", "inf", "1e999", "ev", "+-1ev", "1 ev", "65ev", "2stops"}) {
    INFO(wrong);
    CHECK_FALSE(Exposure::parse(wrong));
  }
}
