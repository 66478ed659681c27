// SPDX-License-Identifier: MIT
// Faces of many corners cut into a ring of cells around an inner face.

#include <brep/ring.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <brep/proportion.hpp>

#include "seed.hpp"
#include "shapes.hpp"

using namespace brep;
using shapes::faults;
using shapes::Mesh;

namespace {

constexpr FaceId prism_top{1};  // of a prism

// A square and an equilateral triangle have 1.
double relative_proportion(const Mesh& m, FaceId f) {
  const auto points = positions(m, f);
  return proportion(points) / std::cos(std::numbers::pi / static_cast<double>(points.size()));
}

}  // namespace

TEST_CASE("cut_ring: counts, corners, level and data of the cells and of the inner face, which cover the face") {
  for (const std::uint32_t n : {6u, 7u, 9u, 12u, 16u, 33u, 256u}) {
    INFO("n = " << n);
    Mesh m = shapes::build(shapes::prism_builder(n));
    m.data(prism_top).label = 5;
    const auto before = corners(m, prism_top);
    const double whole = area(m, prism_top);
    const std::size_t v = m.vertex_count(), e = m.edge_count(), f = m.face_count(), half = (n + 1) / 2;
    int placed = 0;
    const auto parts = cut_ring(m, prism_top, [&](Mesh&, VertexId) { ++placed; });
    REQUIRE(parts);
    REQUIRE(parts->size() == half + 1);
    CHECK(placed == static_cast<int>(half));
    CHECK(m.vertex_count() == v + half);
    CHECK(m.edge_count() == e + 2 * half);
    CHECK(m.face_count() == f + half);
    CHECK(faults(m) == "");
    CHECK(parts->back() == prism_top);
    double sum = 0.0;
    for (std::size_t k = 0; k <= half; ++k) {
      const FaceId part = (*parts)[k];
      const std::size_t wanted = k == half ? half : k + 1 == half && n % 2 == 1 ? 4 : 5;
      CHECK(corners(m, part).size() == wanted);
      CHECK((m.data(part).level == 0 && m.data(part).label == 5));
      CHECK(is_convex(m, part));
      if (k < half) { CHECK(m.halfedge(part) == before[2 * k]); }
      sum += area(m, part);
    }
    CHECK(sum == test::Approx(whole).epsilon(1e-12));
  }
}

// As outlines are in which coplanar polygons of a file were joined.
TEST_CASE("cut_ring: of a convex face with straight corners all parts are convex and cover it, however few corners are true ones") {
  const unsigned seed = test::seed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int run = 0; run < 300; ++run) {
    std::vector<double> angles;
    const std::size_t tips = 3 + random() % 8;
    for (std::size_t i = 0; i < tips; ++i) {
      angles.push_back((static_cast<double>(i) + number(0.0, 0.8)) * 2.0 * std::numbers::pi / static_cast<double>(tips));
    }
    const double flat = number(0.05, 1.0);
    std::vector<glm::dvec3> outline;
    for (std::size_t i = 0; i < tips; ++i) {
      const auto tip = [&](std::size_t k) { return glm::dvec3(std::cos(angles[k % tips]), flat * std::sin(angles[k % tips]), 1.0); };
      const std::size_t straight = random() % 3 == 0 ? random() % 30 : 0;
      for (std::size_t k = 0; k <= straight; ++k) {
        outline.push_back(tip(i) + static_cast<double>(k) / static_cast<double>(straight + 1) * (tip(i + 1) - tip(i)));
      }
    }
    if (outline.size() < 6) { continue; }
    Mesh m = shapes::build(shapes::prism_builder(static_cast<std::uint32_t>(outline.size())));
    const auto before = corners(m, prism_top);
    for (std::size_t k = 0; k < outline.size(); ++k) { m.data(m.vertex(before[k])).position = outline[k]; }
    CAPTURE(run, tips, outline.size());
    const double whole = area(m, prism_top);
    std::vector<FaceId> parts{prism_top};
    while (corners(m, prism_top).size() > most_regular_corners) {
      const std::size_t had = corners(m, prism_top).size();
      const auto cells = cut_ring(m, prism_top, [](Mesh&, VertexId) {});
      REQUIRE(cells);
      parts.insert(parts.end(), cells->begin(), cells->end() - 1);
      REQUIRE(corners(m, prism_top).size() < had);
    }
    double sum = 0.0;
    for (const FaceId f : parts) {
      CHECK(is_convex(m, f));
      CHECK(glm::dot(normal(Polygon(positions(m, f))), glm::dvec3(0, 0, 1)) > 0.0);
      sum += area(m, f);
    }
    CHECK(sum == test::Approx(whole).epsilon(1e-9));
    CHECK(faults(m) == "");
  }
}

TEST_CASE("cut_ring: cells stay well proportioned however often they are refined, where wedges around one centre do not") {
  for (const std::uint32_t n : {12u, 16u, 32u}) {
    INFO("n = " << n);
    Mesh ring = shapes::build(shapes::prism_builder(n)), wedges = ring;
    std::vector<FaceId> cells{prism_top};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      while (corners(ring, cells[i]).size() > most_regular_corners) {
        const auto parts = cut_ring(ring, cells[i], [](Mesh&, VertexId) {});
        REQUIRE(parts);
        cells.insert(cells.end(), parts->begin(), parts->end() - 1);
      }
    }
    std::vector<FaceId> thin{prism_top};
    double worst = 1.0, worst_wedge = 1.0;
    for (int level = 0; level < 3; ++level) {
      for (auto* faces : {&cells, &thin}) {
        Mesh& m = faces == &cells ? ring : wedges;
        std::vector<FaceId> next;
        for (const FaceId f : *faces) {
          const auto children = refine(m, f);
          REQUIRE(children);
          next.insert(next.end(), children->begin(), children->end());
        }
        *faces = next;
      }
    }
    for (const FaceId f : cells) { worst = std::min(worst, relative_proportion(ring, f)); }
    for (const FaceId f : thin) { worst_wedge = std::min(worst_wedge, relative_proportion(wedges, f)); }
    // A wedge has right angles at its mid-edges, so its circumscribed circle has the diameter R, and the inscribed one the radius
    // R sin cos / (sin + cos) of half its angle pi / n: the proportion is below 2 pi / n sqrt(2), and finer parts are no better.
    CHECK(worst_wedge < 2.0 * std::sqrt(2.0) * std::numbers::pi / n);
    CHECK(worst > 0.4);
    CHECK(worst > worst_wedge);
  }
}

TEST_CASE("cut_ring: T-vertices of finer neighbours stay T-vertices, and are eliminated like others") {
  Mesh m = shapes::build(shapes::prism_builder(12));
  std::size_t refined = 0;
  for (HalfedgeId h : corners(m, prism_top)) {
    if (++refined % 3 == 0) { REQUIRE(refine(m, m.face(twin(h)))); }
  }
  const auto parts = cut_ring(m, prism_top, [](Mesh&, VertexId) {});
  REQUIRE(parts);
  std::size_t t_vertices = 0;
  for (const FaceId f : *parts) {
    for (HalfedgeId h : halfedges_of(m, f)) { t_vertices += is_t_vertex(m, h); }
  }
  CHECK(t_vertices == 4);
  REQUIRE(refine(m, parts->front()));  // whose neighbours are the next cells and the inner face
  REQUIRE(refine(m, parts->back()));
  CHECK(faults(m) == "");
  std::vector<FaceId> all;
  for (const FaceId f : faces(m)) { all.push_back(f); }
  for (const FaceId f : all) { (void)eliminate_t_vertices(m, f); }
  CHECK(faults(m) == "");
  for (const FaceId f : faces(m)) { CHECK(NoTVertices{}(m, f)); }
}

TEST_CASE("cut_ring: a flat ellipse keeps convex cells that cover it, what has too few corners is refused") {
  Mesh m = shapes::build(shapes::prism_builder(16));
  for (VertexId v : vertices(m)) { m.data(v).position.x *= 1e-3; }
  const double whole = area(m, prism_top);
  const auto parts = cut_ring(m, prism_top, [](Mesh&, VertexId) {});
  REQUIRE(parts);
  double sum = 0.0;
  for (const FaceId f : *parts) {
    CHECK(is_convex(m, f));
    sum += area(m, f);
  }
  CHECK(sum == test::Approx(whole).epsilon(1e-12));
  const auto refused = cut_ring(m, parts->front(), [](Mesh&, VertexId) {});
  REQUIRE(!refused);
  CHECK(refused.refusal().code == Code::few_corners);
  CHECK(faults(m) == "");
}
