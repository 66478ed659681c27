// SPDX-License-Identifier: MIT
// Measures of polygons against known values.

#include <brep/geometry.hpp>

#include <limits>

#include "shapes.hpp"

using namespace brep;

namespace {

using Corners = std::vector<glm::dvec3>;

Corners regular(unsigned n, double radius = 1.0) {
  Corners p;
  for (unsigned i = 0; i < n; ++i) {
    const double angle = 2.0 * shapes::pi * i / n;
    p.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
  }
  return p;
}
// Turned out of the coordinate planes, scaled and moved.
Corners placed(const Corners& p, double scale, const glm::dvec3& move) {
  const glm::dvec3 x = glm::normalize(glm::dvec3{1.0, 2.0, 3.0}), z = glm::normalize(glm::cross(x, glm::dvec3{1.0, 0.0, 0.0}));
  const glm::dvec3 y = glm::cross(z, x);
  Corners q;
  for (const auto& a : p) { q.push_back(move + scale * (a.x * x + a.y * y + a.z * z)); }
  return q;
}

}  // namespace

TEST_CASE("unit square: area 1, normal up, centre in the middle, proportion 1 / sqrt 2") {
  const Corners p{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  CHECK(area(p) == 1.0);
  CHECK(normal(p) == glm::dvec3{0, 0, 1});
  CHECK(glm::distance(centroid(p), glm::dvec3{0.5, 0.5, 0.0}) < 1e-15);
  CHECK(is_convex(p));
  CHECK(planarity(p) == 0.0);
  CHECK(proportion(p) == test::Approx(std::sqrt(0.5)).epsilon(1e-12));
}

TEST_CASE("regular n-gons at any place, size and orientation") {
  // Rounding: coordinates of size M = 10 scale; the area is right to about n 2^-53 M / D.
  for (unsigned n : {3u, 4u, 5u, 6u, 7u, 12u, 64u, 257u}) {
    for (double scale : {1e-6, 1.0, 1e6}) {
      const Corners p = placed(regular(n), scale, scale * glm::dvec3{3.0, -7.0, 5.0});
      CHECK(area(p) == test::Approx(0.5 * n * std::sin(2.0 * shapes::pi / n) * scale * scale).epsilon(1e-12));
      CHECK(glm::distance(centroid(p), scale * glm::dvec3{3.0, -7.0, 5.0}) < 1e-12 * scale);
      CHECK(is_convex(p));
      CHECK(planarity(p) < 1e-14);
      CHECK(proportion(p) == test::Approx(std::cos(shapes::pi / n)).epsilon(1e-9));
    }
  }
}

TEST_CASE("proportion: triangles, rectangles, straight corners") {
  CHECK(proportion(regular(3)) == test::Approx(0.5).epsilon(1e-12));
  const Corners right{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};  // r = 1, R = 5/2
  CHECK(proportion(right) == test::Approx(0.4).epsilon(1e-12));
  const Corners obtuse{{0, 0, 0}, {10, 0, 0}, {5, 1, 0}};  // the longest side is the diameter
  const double r = 2.0 * area(obtuse) / (10.0 + 2.0 * std::sqrt(26.0));
  CHECK(proportion(obtuse) == test::Approx(r / 5.0).epsilon(1e-12));
  for (double w : {1.0, 2.0, 10.0, 1000.0}) {
    const Corners box{{0, 0, 0}, {w, 0, 0}, {w, 1, 0}, {0, 1, 0}};
    CHECK(proportion(box) == test::Approx(1.0 / std::sqrt(w * w + 1.0)).epsilon(1e-10));
    const Corners with_t{{0, 0, 0}, {w / 4, 0, 0}, {w / 2, 0, 0}, {w, 0, 0}, {w, 0.25, 0}, {w, 1, 0}, {0, 1, 0}, {0, 0.5, 0}};
    CHECK(proportion(with_t) == test::Approx(proportion(box)).epsilon(1e-10));
  }
  CHECK(proportion(Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}) == 0.0);
  CHECK(proportion(Corners{{0, 0, 0}, {1, 0, 0}}) == 0.0);
}

TEST_CASE("proportion of needles stays between 0 and 1, and falls with their width") {
  for (double width = 1e-1; width > 1e-15; width *= 0.1) {
    INFO(width);
    // The radius of the circle within a triangle is twice the area over the perimeter; that around it half of its length, or a little more.
    CHECK(proportion(Corners{{0, 0, 0}, {1, 0, 0}, {0, width, 0}}) == test::Approx(width).epsilon(0.11));
    for (const Corners& needle :
         {Corners{{0, 0, 0}, {1, 0, 0}, {1, width, 0}, {0, width, 0}}, Corners{{0, 0, 0}, {1, -width, 0}, {2, 0, 0}, {1, width, 0}},
          Corners{{0, 0, 0}, {1, 0, 0}, {1, width, 0}, {0.5, 1.5 * width, 0}, {0, width, 0}}}) {
      const double of_needle = proportion(needle);
      CHECK(of_needle >= 0.0);
      CHECK(of_needle <= 2.0 * width);
    }
  }
}

TEST_CASE("proportion of random convex polygons agrees with a search over all triples of sides") {
  // The inscribed circle touches three sides whose normals surround it: the smallest such radius over all triples.
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    shapes::Random random(seed);
    std::vector<double> angles(4 + random.below(8));
    for (double& a : angles) { a = 2.0 * shapes::pi * random.unit(); }
    std::sort(angles.begin(), angles.end());
    Corners p;  // on an ellipse, hence convex
    for (double a : angles) { p.push_back({3.0 * std::cos(a), std::sin(a), 0.0}); }
    const Outline outline(p);
    double best = HUGE_VAL;
    std::vector<detail::Side> sides;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec2 along = glm::normalize(outline[outline.next(i)] - outline[i]);
      const glm::dvec2 n{-along.y, along.x};
      sides.push_back({n, glm::dot(n, outline[i])});
    }
    const auto left = [](const detail::Side& a, const detail::Side& b) { return detail::cross2(a.normal, b.normal) > 0.0; };
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (std::size_t j = i + 1; j < sides.size(); ++j) {
        for (std::size_t k = j + 1; k < sides.size(); ++k) {
          if (left(sides[i], sides[j]) && left(sides[j], sides[k]) && left(sides[k], sides[i])) {
            best = std::min(best, detail::meeting_time(sides[i], sides[j], sides[k]));
          }
        }
      }
    }
    CHECK(detail::inscribed_radius(outline) == test::Approx(best).epsilon(1e-9));
    const double outer = detail::circumscribed_radius(outline);
    double widest = 0.0;
    for (const auto& a : p) {
      for (const auto& b : p) { widest = std::max(widest, glm::distance(a, b)); }
    }
    CHECK(outer >= 0.5 * widest * (1.0 - 1e-12));
    CHECK(outer <= widest / std::sqrt(3.0) * (1.0 + 1e-12));  // Jung's theorem
  }
}

TEST_CASE("convex means one turn to the left, straight corners allowed") {
  CHECK(is_convex(Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0}}));
  CHECK_FALSE(is_convex(Corners{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {1, 1, 0}, {0, 1, 0}}));
  Corners pentagram;
  for (unsigned i = 0; i < 5; ++i) { pentagram.push_back(regular(5)[2 * i % 5]); }
  CHECK_FALSE(is_convex(pentagram));
  CHECK_FALSE(is_convex(Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  CHECK_FALSE(is_convex(Corners{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 3, 0}, {2, 2, 0}, {0, 2, 0}}));  // a spike
  CHECK(is_convex(Corners{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));                   // a repeated point
}

TEST_CASE("planarity is relative to the size") {
  for (double scale : {1e-3, 1.0, 1e3}) {
    const Corners bent = placed({{0, 0, 0}, {1, 0, 0.01}, {1, 1, 0}, {0, 1, 0.01}}, scale, glm::dvec3{0.0});
    CHECK(planarity(bent) == test::Approx(0.005 / std::sqrt(2.0)).epsilon(0.3));  // extent lies between D and sqrt(3) D
  }
}

TEST_CASE("the faces of a cube: unit areas, normals outward, sum of vector areas zero") {
  const auto m = shapes::build(shapes::cube_builder());
  glm::dvec3 sum{0.0};
  for (FaceId f : faces(m)) {
    CHECK(area(m, f) == 1.0);
    CHECK(is_convex(m, f));
    CHECK(glm::dot(normal(m, f), centroid(m, f) - glm::dvec3{0.5}) == test::Approx(0.5));
    sum += vector_area(m, f);
  }
  CHECK(sum == glm::dvec3{0.0});
}
