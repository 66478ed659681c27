// SPDX-License-Identifier: MIT
#pragma once

// Mesh files for the tests of the readers: the cube in several forms, and how they are read.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

#include <brep/builder.hpp>

#include "apps/mesh_file.hpp"
#include "catch.hpp"

namespace mesh_files {

using apps::MeshFormat;
inline const MeshFormat& as_obj = *apps::mesh_format("a.obj");
inline const MeshFormat& as_ply = *apps::mesh_format("a.ply");
inline const MeshFormat& as_off = *apps::mesh_format("a.off");

inline const std::string cube_obj =
    "# a cube\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

inline brep::Builder cube() { return std::move(apps::read_mesh(cube_obj, as_obj).mesh->builder); }

inline void check_same(const brep::Builder& a, const brep::Builder& b) {
  REQUIRE(a.vertex_count() == b.vertex_count());
  REQUIRE(a.face_count() == b.face_count());
  for (std::uint32_t v = 0; v < a.vertex_count(); ++v) { CHECK(a.position(v) == b.position(v)); }
  for (std::uint32_t f = 0; f < a.face_count(); ++f) {
    CHECK(std::equal(a.corners(f).begin(), a.corners(f).end(), b.corners(f).begin(), b.corners(f).end()));
  }
}
inline brep::Builder read(const std::string& bytes, const MeshFormat& format) {
  apps::MeshResult result = apps::read_mesh(bytes, format);
  INFO(apps::to_text(result, "file"));
  REQUIRE(result.mesh.has_value());
  return std::move(result.mesh->builder);
}
// The first error as text, without the file's name.
inline std::string error(const std::string& bytes, const MeshFormat& format) {
  const apps::MeshResult result = apps::read_mesh(bytes, format);
  CHECK(result.mesh.has_value() == result.errors.empty());
  const std::string text = apps::to_text(result, "");
  return text.substr(0, text.find('\n'));
}
inline bool begins(const std::string& text, const std::string& start) { return text.compare(0, start.size(), start) == 0; }

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// Values for binary files, in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big) : big_(big) {}
  template <class T>
  void put(T value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (big_ == (std::endian::native == std::endian::little)) { std::reverse(bytes.begin(), bytes.end()); }
    text += bytes;
  }
  std::string text;

 private:
  bool big_;
};

// The cube with odd types, properties and elements around what is read.
template <class Count, class Index, class Real>
std::string odd_ply(bool big, const std::string& count, const std::string& index, const std::string& real) {
  const brep::Builder b = cube();
  Bytes out(big);
  out.text = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\ncomment odd\nelement camera 2\nproperty list " +
             count + " short path\nelement vertex 8\nproperty uchar red\nproperty " + real + " z\nproperty " + real + " x\nproperty list " +
             count + " double weights\nproperty " + real + " y\nelement face 6\nproperty float area\nproperty list " + count + " " + index +
             " vertex_index\nproperty uchar flag\nelement nothing 1000000000000\nend_header\n";
  for (int i = 0; i < 2; ++i) {
    out.put(static_cast<Count>(i));
    for (int k = 0; k < i; ++k) { out.put(std::int16_t{-7}); }
  }
  for (std::uint32_t v = 0; v < 8; ++v) {
    out.put(std::uint8_t{200});
    out.put(static_cast<Real>(b.position(v).z));
    out.put(static_cast<Real>(b.position(v).x));
    out.put(static_cast<Count>(v % 3));
    for (std::uint32_t k = 0; k < v % 3; ++k) { out.put(0.5); }
    out.put(static_cast<Real>(b.position(v).y));
  }
  for (std::uint32_t f = 0; f < 6; ++f) {
    out.put(1.5F);
    out.put(static_cast<Count>(b.corners(f).size()));
    for (std::uint32_t v : b.corners(f)) { out.put(static_cast<Index>(v)); }
    out.put(std::uint8_t{1});
  }
  return out.text;
}

}  // namespace mesh_files
