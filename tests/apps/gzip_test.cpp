// SPDX-License-Identifier: MIT
// Files compressed by gzip are read as what they hold, under any name.

#include <cstdint>
#include <random>
#include <string>

#include "apps/bytes.hpp"
#include "apps/gzip.hpp"
#include "apps/scene_file.hpp"
#include "gltf_sample.hpp"
#include "models.hpp"
#include "program.hpp"
#include "seed.hpp"

namespace {

// As gzip does it, in blocks that are stored. `flags`: those of the header, each with what it announces.
std::string gzipped(const std::string& bytes, unsigned flags = 0) {
  using gltf_sample::put;
  std::string out = "\x1f\x8b\x08";
  out += static_cast<char>(flags);
  out.append(6, '\0');
  if ((flags & 4U) != 0) { out += std::string("\x03\0abc", 5); }
  if ((flags & 8U) != 0) { out += std::string("a.wrl\0", 6); }
  if ((flags & 16U) != 0) { out += std::string("a comment\0", 10); }
  if ((flags & 2U) != 0) { out += "xy"; }
  constexpr std::size_t most = 65535;
  for (std::size_t at = 0; at == 0 || at < bytes.size(); at += most) {
    const std::string block = bytes.substr(at, most);
    out += at + most >= bytes.size() ? '\1' : '\0';
    put(out, static_cast<std::uint16_t>(block.size()));
    put(out, static_cast<std::uint16_t>(~block.size()));
    out += block;
  }
  put(out, apps::crc32(bytes));
  put(out, static_cast<std::uint32_t>(bytes.size()));
  return out;
}

constexpr std::size_t most = 1 << 20;

}  // namespace

TEST_CASE("gzip: a file holds what was put in, with any header, and no changed or cut file passes as whole") {
  const auto seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int run = 0; run < 60; ++run) {
    std::string bytes(random() % (run % 10 == 0 ? 200'000 : 100), '\0');
    for (char& c : bytes) { c = static_cast<char>(random()); }
    const std::string file = gzipped(bytes, 2U * static_cast<unsigned>(run % 16));
    std::string fault;
    CHECK(apps::gunzip(file, most, fault) == bytes);
    CHECK_FALSE(apps::gunzip(file.substr(0, random() % file.size()), most, fault));
    CHECK(fault.find("is damaged or cut") != std::string::npos);
    std::string changed = file;
    changed[file.size() - 1 - random() % std::min<std::size_t>(file.size() - 10, 8 + bytes.size())] ^= 0x10;
    const auto read = apps::gunzip(changed, most, fault);
    CHECK((!read || *read == bytes));  // a change of the header's text is no damage
    if (!bytes.empty()) { CHECK_FALSE(apps::gunzip(file, bytes.size() - 1, fault)); }
  }
}

// Made by zlib: with the fixed code of deflate, and with a code of its own.
TEST_CASE("gzip: compressed blocks hold what was put in") {
  const std::string fixed = *apps::from_base64("H4sIAAAAAAACA1MOC/L1UQgz0jNQKC1Js+AKzkgsSFWoVkhPzc9NLSmqVHDKr1CorlWo5VKmgUoAbTN0PH4AAAA=");
  const std::string own = *apps::from_base64(
      "H4sIAAAAAAACA13TUQrEMAhF0f9ZRZagVQtvY7P+sekNDNKP0NcYDpp+"
      "lz3P57v8eXq9Vq6r11jaea7aeXXy5HevT27k3vsu6mzXvef02857187vTnzXvfu9v9iui50H5yd59T6n7t"
      "p1jtNwOs7EKZw1nIGzcApn4nSchtNxJk7hrOEMnIVTOHP003A6zsQpnDWcgbNwCmeOfhpOx5k4hbOGM3AWTuHM0U/"
      "D6TgTp8bcjzNwFk7hzNFPw+k4E6fG3I8zcBZOjft5+mk4HWfi"
      "1Jj7cQbOwqlxP08/DafjTJwacz/OwFk4Ne7n6afhdJw5/qMazsBZOPV3P3+2dnS/wAMAAA==");
  std::string boxes, vertices, fault;
  for (int i = 0; i < 3; ++i) { boxes += "#VRML V2.0 utf8\nShape { geometry Box {} }\n"; }
  for (int i = 0; i < 120; ++i) {
    vertices += "v " + std::to_string(i % 7) + " " + std::to_string(i * i % 11) + " " + std::to_string(i % 3) + "\n";
  }
  CHECK(apps::gunzip(fixed, most, fault) == boxes);
  CHECK(apps::gunzip(own, most, fault) == vertices);
}

TEST_CASE("gzip: the program reads compressed files of other programs, whatever their names") {
  const program::Place place;
  const std::string text = "#VRML V2.0 utf8\nShape { geometry Box {} }\n";
  place.write("a.wrl", text);
  for (const char* const name : {"b.wrl", "b.wrz", "b.wrl.gz", "b.WRL.GZ"}) { place.write(name, gzipped(text, 8)); }
  place.write("inline.wrl", "#VRML V2.0 utf8\nInline { url \"b.wrz\" }\n");
  place.write("box.obj.gz", gzipped(models::room_obj));
  place.write("cut.wrl", gzipped(text).substr(0, 40));
  const auto told = [&](const std::string& name) {
    const program::Run run = place.run("info " + name);
    INFO(run.err);
    CHECK(run.code == 0);
    return run.out.substr(run.out.find('\n'));
  };
  const std::string plain = told("a.wrl");
  for (const char* const name : {"b.wrl", "b.wrz", "b.wrl.gz", "b.WRL.GZ", "inline.wrl", "- <b.wrz"}) {
    CAPTURE(name);
    CHECK(told(name) == plain);
  }
  CHECK(told("box.obj.gz").find("6 polygons became 6 faces") != std::string::npos);
  CHECK(place.run("info cut.wrl").err.find("cut.wrl is a compressed file (gzip) that is damaged or cut") != std::string::npos);
}
