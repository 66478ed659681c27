// SPDX-License-Identifier: MIT

// Scenes whose cost must grow like their size, counted in pairs, links and patches: long rooms, objects at one place, shapes that fold.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <brep/validate.hpp>
#include <radiosity/clusters/clusters.hpp>
#include <radiosity/hierarchy/buried.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/long_faces.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/hierarchy/wall_cuts.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/superquadric.hpp>
#include <raycast/objects/torus.hpp>
#include <raycast/ray.hpp>
#include <raycast/spans.hpp>
#include <raycast/transform.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"

namespace {

struct Work {
  std::size_t roots = 0, nodes = 0, links = 0, pairs = 0;
  std::vector<double> areas;  // of the leaves of each object
};

// Refinement alone.
Work work_of(const radiosity::Scene& scene, double epsilon, double min_area) {
  radiosity::PrepareResult made = radiosity::prepare(scene);
  for (const std::string& fault : made.faults) { UNSCOPED_INFO(fault); }
  REQUIRE(made.prepared);
  radiosity::DiscreteScene discrete{scene, 1, 1};
  discrete.take(std::move(*made.prepared));
  std::vector<radiosity::Surface>& surfaces = discrete.surfaces;
  radiosity::Hierarchy& hierarchy = discrete.hierarchy;
  radiosity::cut_at_walls(surfaces, discrete.objects.diameter());
  radiosity::cut_long_faces(surfaces, min_area);
  hierarchy = radiosity::make_roots(surfaces);
  const std::size_t roots = hierarchy.size();
  if (roots >= radiosity::Options{}.cluster_from) { hierarchy = radiosity::make_clusters(surfaces, hierarchy); }
  const radiosity::RefineResult result = radiosity::refine(discrete, {epsilon, min_area, 0.25 * epsilon});
  REQUIRE(result.too_many == 0);
  for (const radiosity::Surface& surface : surfaces) { CHECK(brep::validate(surface.brep).empty()); }
  std::vector<double> areas(surfaces.size());
  for (const radiosity::Node& node : hierarchy) {
    if (node.leaf()) { areas[node.object] += node.area; }
  }
  return {roots, hierarchy.size(), result.linked.size(), static_cast<std::size_t>(result.pairs_tested), std::move(areas)};
}

radiosity::Scene lit(std::vector<radiosity::SceneObject> objects) {
  objects.push_back(scenes::square("lamp", {0.3, 0.3, 5.0}, 0.2, false, 1));
  return {{{"white", radiosity::Color{0.7}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{10.0}}},
          std::move(objects)};
}
constexpr double lamp_area = 0.4 * 0.4;

// The curve |x|^(2/e) + |y|^(2/e) = 1 in the first quadrant, with points close together where it bends.
std::vector<glm::dvec2> superellipse(double e) {
  constexpr int n = 500;
  std::vector<glm::dvec2> points;
  for (int k = 0; k <= n; ++k) {
    const double angle = 0.5 * std::numbers::pi * k / n;
    const double c = k == n ? 0.0 : std::cos(angle), s = std::sin(angle);
    const double scale = e > 1.0 ? 1.0 : std::max(c, s) * std::pow(1.0 + std::pow(std::min(c, s) / std::max(c, s), 2.0 / e), 0.5 * e);
    points.push_back(e > 1.0 ? glm::dvec2{std::pow(c, e), std::pow(s, e)} : glm::dvec2{c, s} / scale);
  }
  return points;
}

// Of a superquadric of radii 1: eight times that of a grid of triangles in the first octant.
double superquadric_area(double profile, double around) {
  const std::vector<glm::dvec2> side = superellipse(profile), ring = superellipse(around);
  const auto at = [&](std::size_t i, std::size_t j) { return glm::dvec3{side[i].x * ring[j], side[i].y}; };
  double area = 0.0;
  for (std::size_t i = 1; i < side.size(); ++i) {
    for (std::size_t j = 1; j < ring.size(); ++j) {
      const glm::dvec3 diagonal = at(i, j) - at(i - 1, j - 1);
      area += 0.5 * (glm::length(glm::cross(at(i, j - 1) - at(i - 1, j - 1), diagonal)) +
                     glm::length(glm::cross(diagonal, at(i - 1, j) - at(i - 1, j - 1))));
    }
  }
  return 8.0 * area;
}

}  // namespace

TEST_CASE("the area of superquadrics: an octahedron, a sphere, nearly a cube") {
  CHECK(superquadric_area(2.0, 2.0) == test::Approx(8.0 * std::sqrt(3.0) / 2.0).epsilon(1e-6));
  CHECK(superquadric_area(1.0, 1.0) == test::Approx(4.0 * std::numbers::pi).epsilon(1e-5));
  CHECK(superquadric_area(1e-3, 1e-3) == test::Approx(24.0).epsilon(0.01));
}

TEST_CASE("long rooms: the number of links does not grow with the proportion") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  for (int i = 0; i < 12; ++i) {
    const double length = std::pow(10.0, std::uniform_real_distribution<>{1.0, 6.0}(random));
    const int axis = std::uniform_int_distribution<>{0, 2}(random);
    glm::dvec3 size{1.0};
    size[axis] = length;
    radiosity::Scene scene = lit({scenes::object("room", scenes::box({0, 0, 0}, size), 0, true)});
    scene.objects.back() = scenes::square("lamp", {0.5, 0.5, 0.99}, 0.2, false, 1);
    INFO("length " << length << " along " << axis);
    const Work work = work_of(scene, 0.02, 1e-3);
    // Leaves are no smaller than an eighth of min_area (a quarter for the light oracle, halved by a cut), so there are at most 8000, and a
    // leaf of proportion 4 or less has at most 16 / epsilon others near by on each of four sides that it does not sink below epsilon.
    CHECK(work.roots <= 2000);
    CHECK(work.links <= 8000 * 40);
  }
}

TEST_CASE("long rooms of slabs: what walls cut out of a long face is cut across, too") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>{a, b}(random); };
  for (int i = 0; i < 12; ++i) {
    const double length = std::pow(10.0, uniform(1.2, 2.0)), t = uniform(0.05, 0.2);
    // Floor and ceiling reach under the walls, and those between the two at the ends.
    const glm::dvec3 inner{1.0, length, uniform(0.8, 1.5)}, outer = inner + glm::dvec3{t};
    const int turn = std::uniform_int_distribution<>{0, 2}(random);
    const auto turned = [&](const glm::dvec3& p) { return glm::dvec3{p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]}; };
    std::vector<radiosity::SceneObject> slabs;
    const auto add = [&](const glm::dvec3& from, const glm::dvec3& to) {
      slabs.push_back(scenes::object("slab", scenes::box(turned(from), turned(to))));
    };
    add({-t, -t, -t}, {outer.x, outer.y, 0.0});
    add({-t, -t, inner.z}, outer);
    add({-t, -t, 0.0}, {0.0, outer.y, inner.z});
    add({inner.x, -t, 0.0}, {outer.x, outer.y, inner.z});
    add({0.0, -t, 0.0}, {inner.x, 0.0, inner.z});
    add({0.0, inner.y, 0.0}, {inner.x, outer.y, inner.z});
    const radiosity::Scene scene = lit(std::move(slabs));
    radiosity::PrepareResult made = radiosity::prepare(scene);
    REQUIRE(made.prepared);
    std::vector<radiosity::Surface>& surfaces = made.prepared->surfaces;
    radiosity::cut_at_walls(surfaces, made.prepared->objects.diameter());
    constexpr double min_area = 2e-4;
    radiosity::cut_long_faces(surfaces, min_area);
    double all = 0.0;
    for (const radiosity::Node& root : radiosity::make_roots(surfaces)) { all += root.area; }
    INFO("length " << length << ", thickness " << t << ", turned " << turn);
    for (const radiosity::Surface& surface : surfaces) {
      CHECK(brep::validate(surface.brep).empty());
      for (const brep::FaceId f : brep::faces(surface.brep)) {
        const double area = glm::length(brep::vector_area(surface.brep, f));
        if (area < 0.01 * all || area <= 4.0 * min_area * all) { continue; }
        const radiosity::Polygon corners = radiosity::corner_polygon(surface.brep, f);
        double longest = 0.0;
        for (const glm::dvec3& a : corners) { longest = std::max(longest, glm::length(a - corners.front())); }
        CHECK(longest * longest < 8.2 * area);  // of a rectangle of 8 : 1 the diagonal is sqrt 65 widths long
      }
    }
  }
}

TEST_CASE("pairs grow like the number of objects: of those at one place or inside each other only what shows is refined") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>{a, b}(random); };
  const auto scene_of = [&](int kind, int count) {
    std::vector<radiosity::SceneObject> objects;
    for (int k = 0; k < count; ++k) {
      const double r = kind == 0 ? 1.0 : kind == 1 ? uniform(0.4, 1.0) : std::pow(uniform(0.85, 0.9), k);  // gaps wider than chords bulge
      if (kind == 2) {
        objects.push_back(scenes::object("s", raycast::Sphere::make({0, 0, 0}, r).object));
      } else {
        objects.push_back(scenes::object("b", scenes::box(glm::dvec3{-r}, glm::dvec3{r})));
      }
    }
    return lit(std::move(objects));
  };
  for (const int kind : {0, 1, 2}) {  // identical boxes, nested boxes, nested spheres
    INFO("kind " << kind);
    const Work few = work_of(scene_of(kind, 20), 0.05, 1e-2);
    const Work many = work_of(scene_of(kind, 160), 0.05, 1e-2);
    // Without what is buried the pairs are those of the outermost, some chord patches below it, and a look at each cluster: eight times the
    // objects make less than twelve times the pairs. All pairs of faces would be 64 times as many.
    CHECK(many.pairs <= 12 * few.pairs + 8 * 160 * 6);
  }
}

TEST_CASE("what is buried before refinement is what the exposure finds") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>{a, b}(random); };
  for (int i = 0; i < 20; ++i) {
    std::vector<radiosity::SceneObject> objects;
    for (int k = 0; k < 12; ++k) {
      const glm::dvec3 c{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      const double r = uniform(0.1, 1.5);
      if (k % 2 == 0) {
        objects.push_back(scenes::object("s", raycast::Sphere::make(c, r).object));
      } else {
        objects.push_back(scenes::object("b", scenes::box(c - r, c + r)));
      }
      if (k == 5) { objects.push_back(objects.back()); }
    }
    const radiosity::Scene scene = lit(std::move(objects));
    radiosity::PrepareResult made = radiosity::prepare(scene);
    REQUIRE(made.prepared);
    const radiosity::Hierarchy roots = radiosity::make_roots(made.prepared->surfaces);
    radiosity::Patches patches{made.prepared->surfaces, roots};
    patches.extend(1);
    radiosity::Exposure exposure;
    radiosity::extend(exposure, {made.prepared->objects, made.prepared->plan, made.prepared->surfaces, roots, patches}, 1, seed);
    const std::vector<bool> buried = radiosity::buried_nodes(made.prepared->surfaces, roots);
    for (std::size_t n = 0; n < roots.size(); ++n) {
      if (buried[n]) { CHECK(exposure.area[n] == 0.0); }
    }
  }
}

TEST_CASE("superquadrics of any exponents that are accepted are refined into a bounded number of patches") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  for (int i = 0; i < 10; ++i) {
    const auto exponent = [&] { return std::pow(10.0, std::uniform_real_distribution<>{-3.0, 1.0}(random)); };
    const double profile = exponent();
    const double around = exponent();
    INFO("exponents " << profile << " " << around);
    const auto made = raycast::Superquadric::make({0, 0, 0}, {1, 1, 1}, profile, around);
    REQUIRE(made);
    const Work work = work_of(lit({scenes::object("q", made.object)}), 0.1, 1e-3);
    // A mesh that folds grows beyond the surface with every split. Chords have less area than a convex surface; about ridges of others up
    // to a fifth more. Chords within 1 % of the size of the surface tell an arm thinner than that from a tube of this radius no better: six
    // arms of length 1, tubes of radius .02.
    constexpr double tubes = 6.0 * 2.0 * std::numbers::pi * 0.02;
    CHECK(work.areas[0] / work.areas[1] * lamp_area <= 1.2 * superquadric_area(profile, around) + tubes);
    // A patch of area min_area or more has at most four children and at most four generations that do not shrink: 4 / min_area leaves of
    // honest splits (areas of curved surfaces may double), and 4^4 times as many at the few that fold.
    CHECK(work.nodes <= 40000);
  }
  CHECK(!raycast::Superquadric::make({0, 0, 0}, {1, 1, 1}, 0.001, 20.0));
}

TEST_CASE("rings: no crossing is looked for where the line passes the tube once, and the answer is that of the spans") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>{a, b}(random); };
  int once = 0, twice = 0;
  for (const double ratio : {0.9, 0.5, 0.1, 0.01, 1e-4}) {
    const auto torus = raycast::Torus::make({0, 0, 0}, {uniform(-1, 1), uniform(-1, 1), 1}, 1.0, ratio);
    REQUIRE(torus);
    const raycast::PlacedObject room{torus.object, {glm::dmat3{1.0}, {0, 0, 0}, true}};
    const auto on_surface = [&](const glm::dvec3& near) { return room.project(0, near).position; };
    for (int k = 0; k < 4000; ++k) {
      const glm::dvec3 a = on_surface({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
      const double far = ratio * std::pow(10.0, uniform(-1, 1));  // of the size of the tube, where most links are
      const glm::dvec3 b = on_surface(a + far * glm::dvec3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
      if (a == b) { continue; }
      const raycast::Segment segment = raycast::between(a, b);
      raycast::Spans body;
      torus->spans(segment, body);
      CHECK((body.size() <= 1 || !torus->passes_once(segment)));
      ++(torus->passes_once(segment) ? once : twice);
    }
  }
  CHECK(once > 2 * twice);  // so that it saves most of the crossings: 80 to 90 % of these lines
}

TEST_CASE("what is not cut at walls because there are too many is counted") {
  std::vector<radiosity::SceneObject> objects;
  for (int k = 0; k < 12; ++k) {  // in a row, each touches its neighbours
    objects.push_back(scenes::object("b", scenes::box({1.0 * k, 0, 0}, {k + 1.0, 1.0 + 0.1 * k, 1})));
  }
  radiosity::PrepareResult made = radiosity::prepare(lit(objects));
  REQUIRE(made.prepared);
  std::vector<radiosity::Surface> few = made.prepared->surfaces;
  CHECK(radiosity::cut_at_walls(few, made.prepared->objects.diameter(), 4) == 10);  // of 13, where three have the first five pairs
  CHECK(radiosity::cut_at_walls(made.prepared->surfaces, made.prepared->objects.diameter()) == 0);
}

TEST_CASE("segments on an open mesh see the crossings of the whole line, as far as they lie on them, bit for bit") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>{a, b}(random); };
  std::vector<glm::dvec3> positions;
  std::vector<std::vector<std::uint32_t>> faces;
  const std::uint32_t n = 12;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) { positions.emplace_back(1.0 * i, 1.0 * j, uniform(-1.0, 1.0)); }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j;
      const std::uint32_t b = a + n + 1;
      faces.push_back({a, b, a + 1});
      faces.push_back({a + 1, b, b + 1});
    }
  }
  const auto mesh = raycast::Mesh::make(positions, faces);
  REQUIRE(mesh);
  for (int k = 0; k < 2000; ++k) {
    const glm::dvec3 a{uniform(-2, 14), uniform(-2, 14), uniform(-1, 1)};
    const double length = std::pow(10.0, uniform(-3, 1.3));
    const raycast::Segment segment{a, length * glm::dvec3{uniform(-1, 1), uniform(-1, 1), uniform(-0.2, 0.2)}};
    raycast::Spans line, part;
    mesh->spans(segment, line);
    const double t0 = uniform(-0.5, 0.5), t1 = t0 + uniform(0, 1);
    mesh->spans_near(segment, t0, t1, part);
    std::vector<std::pair<double, std::uint32_t>> of_line, of_part;
    for (const raycast::Span& s : line) {
      if (s.in.t >= t0 && s.in.t <= t1) { of_line.emplace_back(s.in.t, s.in.sheet); }
    }
    for (const raycast::Span& s : part) {
      if (s.in.t >= t0 && s.in.t <= t1) { of_part.emplace_back(s.in.t, s.in.sheet); }
    }
    CHECK(of_line == of_part);
  }
}
