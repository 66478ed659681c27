// SPDX-License-Identifier: MIT
// The unit tests of a stranger's project: its mesh is two arrays, and halflight is there to test it alone (halflight::testing).

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
#endif

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/testing_mesh.hpp>

namespace {

struct Triangles {
  std::uint32_t points = 0;
  std::vector<std::array<int, 3>> list;
};

struct Adapter {
  const Triangles& mesh;
  [[nodiscard]] std::size_t vertex_count() const { return mesh.points; }
  [[nodiscard]] std::size_t face_count() const { return mesh.list.size(); }
  [[nodiscard]] const std::array<int, 3>& corners(std::uint32_t f) const { return mesh.list[f]; }
};

// n by m quadrilaterals, each in two triangles, joined to a ring both ways: what the stranger has written and wants to know of.
Triangles torus(int n, int m) {
  Triangles mesh{static_cast<std::uint32_t>(n * m), {}};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const int a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m, d = i * m + (j + 1) % m;
      mesh.list.push_back({a, b, c});
      mesh.list.push_back({a, c, d});
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("our torus is a solid with one handle") {
  for (int n = 3; n < 7; ++n) {
    const Triangles mesh = torus(n, n + 1);
    CHECK_THAT(Adapter{mesh}, brep::IsSolid());
    CHECK_THAT(brep::as_brep(Adapter{mesh}), brep::IsValid());
    CHECK_THAT(brep::as_brep(Adapter{mesh}), brep::HasCounts({.v = n * (n + 1), .s = 1, .h = 1}));
  }
}

TEST_CASE("a triangle that is missing or turned is found, and the sentence says where") {
  Triangles open = torus(3, 4), turned = torus(3, 4);
  open.list.pop_back();
  std::swap(turned.list[5][0], turned.list[5][1]);
  CHECK_THAT(Adapter{open}, !brep::IsSolid());
  CHECK(brep::as_brep(Adapter{open}).face_count() == 0);
  const brep::IsSolid is_solid;
  CHECK_FALSE(is_solid.match(Adapter{turned}));
  CHECK(is_solid.toString().find("f5") != std::string::npos);
}
