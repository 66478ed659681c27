// SPDX-License-Identifier: MIT
// Faces cut along planes: solids, and faces with holes.

#include <brep/split.hpp>

#include <algorithm>

#include "outlines.hpp"
#include "shapes.hpp"

using namespace brep;
using outlines::check_cover;
using outlines::Points;
using shapes::faults;
using shapes::Mesh;

TEST_CASE("a plane through a cube cuts four faces, T-vertices of the neighbours are shared, parts lie on one side") {
  Mesh m = shapes::build(shapes::cube_builder());
  const glm::dvec3 point{0.3, 0.0, 0.0}, across{2.0, 0.5, 0.0};
  const auto parts = split_recursively(m, AlongPlane{point, across}, BesidePlane{point, across});
  REQUIRE(parts);
  CHECK((m.vertex_count() == 12 && m.edge_count() == 20 && m.face_count() == 10));
  CHECK(faults(m) == "");
  CHECK(shapes::total_area(m) == test::Approx(6.0).epsilon(1e-14));
  for (FaceId f : faces(m)) {
    double lo = 0.0, hi = 0.0;
    for (const glm::dvec3& p : positions(m, f)) {
      lo = std::min(lo, glm::dot(p - point, across));
      hi = std::max(hi, glm::dot(p - point, across));
    }
    CHECK((lo > -1e-14 || hi < 1e-14));
    CHECK(is_convex(m, f));
  }
  // Through four corners: no new vertex.
  Mesh diagonal = shapes::build(shapes::cube_builder());
  REQUIRE(split_recursively(diagonal, AlongPlane{{0, 0, 0}, {1, -1, 0}}, BesidePlane{{0, 0, 0}, {1, -1, 0}}));
  CHECK((diagonal.vertex_count() == 8 && diagonal.face_count() == 8));
  // Beside the cube, along a face, and without a normal: nothing.
  for (const glm::dvec3& n : {glm::dvec3{0, 0, 1}, glm::dvec3{0.0}, glm::dvec3{NAN, 0, 0}}) {
    Mesh same = shapes::build(shapes::cube_builder());
    REQUIRE(split_recursively(same, AlongPlane{{0, 0, 1}, n}, BesidePlane{{0, 0, 1}, n}));
    CHECK(same.face_count() == 6);
  }
}

TEST_CASE("a plane cuts a face with a hole, reached by a bridge edge, beside, through and along the bridge") {
  // A square of side 4 with a square hole of side 2, bridged from (0, 0) to (1, 1), or straight along y = 2 with corners on the line.
  for (const bool straight : {false, true}) {
    Points p;
    if (straight) {
      p = {{0, 2}, {0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 2}, {1, 2}, {1, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 2}};
    } else {
      p = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
    }
    for (const glm::dvec3& n :
         {glm::dvec3{0, 1, 0}, glm::dvec3{1, 0, 0}, glm::dvec3{1, 1, 0}, glm::dvec3{1, -1, 0}, glm::dvec3{-2, 1, 0}}) {
      for (const glm::dvec3& point : {glm::dvec3{2, 2, 0}, glm::dvec3{0.5, 0.5, 0}, glm::dvec3{0.5, 2, 0}}) {
        CAPTURE(straight, n.x, n.y, point.x, point.y);
        Mesh m;  // one shell: the loop and its back, with coinciding corners as separate vertices
        m = shapes::build(shapes::pillow_builder(p));
        const double whole = area(m, FaceId{0});
        CHECK(whole == test::Approx(12.0));
        const auto parts = split_recursively(m, FaceId{0}, AlongPlane{point, n}, BesidePlane{point, n});
        REQUIRE(parts);
        CHECK(parts->faces.size() >= 2);
        CHECK(faults(m) == "");
        check_cover(m, parts->faces, 12.0, glm::dvec3{0, 0, 1});
        for (FaceId f : parts->faces) {
          double lo = 0.0, hi = 0.0;
          for (const glm::dvec3& x : positions(m, f)) {
            lo = std::min(lo, glm::dot(x - point, n));
            hi = std::max(hi, glm::dot(x - point, n));
          }
          CHECK((lo > -1e-12 || hi < 1e-12));
        }
      }
    }
  }
}
