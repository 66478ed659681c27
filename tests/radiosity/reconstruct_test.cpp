// SPDX-License-Identifier: MIT
// Reconstruction into half-edge colours (paper 4.5, fig. 5): smooth over a curved surface, no bleeding over the edge of a box.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/common.hpp>

#include "catch.hpp"
#include "radiosity/scenes.hpp"
#include "seed.hpp"

#include <brep/circulators.hpp>
#include <brep/handles.hpp>

#include <raycast/object.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/mesh.hpp>
#include <raycast/objects/sphere.hpp>
#include <raycast/objects/superquadric.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/picture/reconstruct.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/mesh.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/prepare.hpp>

using radiosity::Reconstruction;

namespace {

struct Reconstructed {
  radiosity::Prepared prepared;  // surfaces with colours
  radiosity::Hierarchy hierarchy;
  std::vector<radiosity::Color> radiosity;
};

// The leaves that divide(surfaces, hierarchy) makes, with the radiosity that `light` gives of each, reconstructed.
template <class Divide, class Light>
Reconstructed reconstructed(const radiosity::Scene& scene, Reconstruction kind, const Divide& divide, const Light& light) {
  Reconstructed r{std::move(*radiosity::prepare(scene).prepared), {}, {}};
  std::vector<radiosity::Surface>& surfaces = r.prepared.surfaces;
  r.hierarchy = radiosity::make_roots(surfaces);
  divide(surfaces, r.hierarchy);
  radiosity::Patches patches{surfaces, r.hierarchy};
  patches.extend(1);
  radiosity::Exposure exposure;
  radiosity::extend(exposure, {r.prepared.objects, r.prepared.plan, surfaces, r.hierarchy, patches}, 1, 1);
  for (const radiosity::Node& node : r.hierarchy) { r.radiosity.push_back(radiosity::Color{light(node)}); }
  const std::vector<std::uint32_t> materials(radiosity::surfaces(scene).size(), 0);
  radiosity::eliminate_t_vertices(surfaces);
  (void)radiosity::reconstruct(surfaces, {r.hierarchy, exposure, r.radiosity, materials}, kind);
  return r;
}

// Of leaves of a few levels.
template <class Light>
Reconstructed reconstructed(const radiosity::Scene& scene, Reconstruction kind, const Light& light) {
  const auto twice = [](std::vector<radiosity::Surface>& surfaces, radiosity::Hierarchy& hierarchy) {
    for (int level = 0; level < 2; ++level) {
      const auto count = static_cast<std::uint32_t>(hierarchy.size());
      for (std::uint32_t i = 0; i < count; ++i) {
        if (hierarchy[i].leaf()) { REQUIRE(radiosity::subdivide(surfaces, hierarchy, i)); }
      }
    }
  };
  return reconstructed(scene, kind, twice, light);
}

// Calls visit(brep, half-edge) for every corner of a radiating face of the first object.
template <class Visit>
void for_corners(const Reconstructed& r, const Visit& visit) {
  const radiosity::SurfaceBRep& brep = r.prepared.surfaces[0].brep;
  for (const brep::FaceId f : brep::faces(brep)) {
    if (brep.data(f).node == radiosity::no_node) { continue; }
    for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) { visit(brep, h); }
  }
}

radiosity::Scene lone(std::shared_ptr<const raycast::Object> shape) {
  return {{{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}}, {scenes::object("thing", std::move(shape))}};
}

// Each side of a box has its own brightness, 1 to 6.
double by_side(const radiosity::Node& node) { return 1.0 + node.surface; }

}  // namespace

TEST_CASE("weighted reconstruction: no colour bleeds over the edge of a box, simple reconstruction mixes both sides") {
  const radiosity::Scene scene = lone(scenes::box({0, 0, 0}, {1, 2, 1}));
  for (const auto kind : {Reconstruction::weighted, Reconstruction::simple}) {
    const Reconstructed r = reconstructed(scene, kind, by_side);
    double worst = 0.0;
    for_corners(r, [&](const radiosity::SurfaceBRep& brep, brep::HalfedgeId h) {
      const double own = r.radiosity[brep.data(brep.face(h)).node].x;
      worst = std::max(worst, std::abs(brep.data(h).radiosity.x - own));
    });
    CAPTURE(name(kind));
    // Simple: the corner of the box has the mean of three sides.
    CHECK((kind == Reconstruction::weighted ? worst == 0.0 : worst >= 1.0));
  }
}

TEST_CASE("weighted reconstruction: on the side of a cylinder all faces at a vertex have one colour there, and its caps have theirs") {
  const radiosity::Scene scene = lone(raycast::Cylinder::make({0, 0, 0}, {0, 0, 2}, 1.0).object);
  const auto light = [](const radiosity::Node& node) { return node.surface == 0 ? 1.0 + std::max(0.0, node.normal.x) : 10.0; };
  const Reconstructed r = reconstructed(scene, Reconstruction::weighted, light);
  std::size_t compared = 0;
  for_corners(r, [&](const radiosity::SurfaceBRep& brep, brep::HalfedgeId h) {
    for (const brep::HalfedgeId l : brep::halfedges_from(brep, brep.vertex(h))) {
      if (brep.data(brep.face(l)).sheet != brep.data(brep.face(h)).sheet) { continue; }
      // The weights are the same up to the rounding of the normals.
      CHECK(std::abs(brep.data(l).radiosity.x - brep.data(h).radiosity.x) <= 1e-12);
      compared += l != h ? 1 : 0;
    }
    if (brep.data(brep.face(h)).sheet != 0) { CHECK(brep.data(h).radiosity.x == test::Approx(10.0).epsilon(1e-12)); }
  });
  CHECK(compared > 100);
}

TEST_CASE("reconstruction of a cosine over a cylinder is at least four times nearer at the vertices than constant leaves are") {
  const radiosity::Scene scene = lone(raycast::Cylinder::make({0, 0, 0}, {0, 0, 2}, 1.0).object);
  const auto wave = [](const glm::dvec3& normal) { return 2.0 + normal.x; };
  const auto worst = [&](Reconstruction kind) {
    const Reconstructed r = reconstructed(scene, kind, [&](const radiosity::Node& node) { return wave(node.normal); });
    double error = 0.0;
    for_corners(r, [&](const radiosity::SurfaceBRep& brep, brep::HalfedgeId h) {
      if (brep.data(brep.face(h)).sheet != 0) { return; }
      const glm::dvec3& p = brep.data(brep.vertex(h)).position;
      const glm::dvec3 axis = -r.prepared.frame.centre * r.prepared.frame.scale;
      error = std::max(error, std::abs(brep.data(h).radiosity.x - wave(glm::normalize(glm::dvec3{p.x - axis.x, p.y - axis.y, 0.0}))));
    });
    return error;
  };
  // Over a leaf of the angle a the cosine changes by up to a, and what interpolation misses is of the order a^2.
  CHECK(4.0 * worst(Reconstruction::weighted) < worst(Reconstruction::constant));
}

TEST_CASE("constant reconstruction shows the leaves as they are") {
  const Reconstructed r = reconstructed(lone(raycast::Sphere::make({0, 0, 0}, 1.0).object), Reconstruction::constant,
                                        [](const radiosity::Node& node) { return node.centre.x; });
  for_corners(r, [&](const radiosity::SurfaceBRep& brep, brep::HalfedgeId h) {
    CHECK(brep.data(h).radiosity == r.radiosity[brep.data(brep.face(h)).node]);
  });
}

TEST_CASE("a buried leaf beside an exposed one takes the light of its neighbours in every reconstruction") {
  // The plate has 4 by 4 leaves; the box stands on those in the middle and a little beyond.
  radiosity::Scene scene{{{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}}, {scenes::square("plate", {0, 0, 0}, 2, true)}};
  scene.objects.push_back(scenes::object("box", scenes::box({-1.1, -1.1, 0}, {1.1, 1.1, 1})));
  const auto light = [](const radiosity::Node& node) { return glm::length(glm::dvec2{node.centre}) < 1.5 * node.radius ? 0.0 : 1.0; };
  for (const auto kind : {Reconstruction::weighted, Reconstruction::simple, Reconstruction::constant}) {
    CAPTURE(name(kind));
    for_corners(reconstructed(scene, kind, light),
                [&](const radiosity::SurfaceBRep& brep, brep::HalfedgeId h) { CHECK(brep.data(h).radiosity.x == test::Approx(1.0)); });
  }
}

// A square lamp lies in a square ceiling, both facing down, anywhere: over the edge, too. No face of the ceiling lies wholly under it,
// where two faces in one plane would fight for each pixel. (Faces that reach under the lamp from beside it are whole.)
TEST_CASE("the mesh has no face that lies wholly under one of the same plane") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    radiosity::Random random{seed, 0};
    const glm::dvec3 centre{1.2 * random.uniform() - 0.6, 1.2 * random.uniform() - 0.6, 1.0};
    const double r = 0.1 + 0.3 * random.uniform();
    radiosity::Scene scene{{{"grey", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}},
                           {}};
    scene.objects = {scenes::square("ceiling", {0, 0, 1}, 1.0, false), scenes::square("floor", {0, 0, 0}, 1.0, true),
                     scenes::square("lamp", centre, r, false, 1)};
    const radiosity::Options options{.epsilon = 0.02, .min_area = 1e-4, .audit_points = 0};
    const auto outcome = radiosity::solve(scene, options);
    REQUIRE(outcome.solution);
    const radiosity::Mesh& mesh = outcome.solution->mesh;
    std::size_t of_ceiling = 0;
    for (const radiosity::MeshFace& face : mesh.faces) {
      if (face.surface != 0) { continue; }
      ++of_ceiling;
      bool under = true;
      for (std::uint32_t c = face.first_corner; c < face.first_corner + face.corner_count; ++c) {
        const glm::dvec3 d = glm::abs(mesh.positions[mesh.corners[c].vertex] - centre);
        under = under && std::max(d.x, d.y) <= r * (1.0 + 1e-9);
      }
      CHECK_FALSE(under);
    }
    CHECK(of_ceiling > 16);
  }
}

TEST_CASE("corners of the mesh have the normals of the true surface, each side of a crease its own") {
  const auto outcome = radiosity::solve(lone(raycast::Cylinder::make({1, 2, 3}, {0, 0, 2}, 0.5).object), {});
  REQUIRE(outcome.solution);
  const radiosity::Mesh& mesh = outcome.solution->mesh;
  REQUIRE_FALSE(mesh.faces.empty());
  for (const radiosity::MeshFace& face : mesh.faces) {
    for (std::uint32_t c = 0; c < face.corner_count; ++c) {
      const radiosity::MeshCorner& corner = mesh.corners[face.first_corner + c];
      const glm::dvec3 p = mesh.positions[corner.vertex] - glm::dvec3{1, 2, 3};
      const glm::dvec3 n{corner.normal};
      const bool side = std::abs(n.z) < 0.5;
      CHECK(glm::length(n - (side ? glm::normalize(glm::dvec3{p.x, p.y, 0.0}) : glm::dvec3{0, 0, p.z > 1.0 ? 1.0 : -1.0})) < 1e-6);
    }
  }
}

TEST_CASE("corners of the mesh on the edges of blades have normals of their own side") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>{a, b}(random); };
  for (int i = 0; i < 4; ++i) {
    radiosity::Scene scene = lone(raycast::Superquadric::make({0, 0, 0}, {1, 1, 1}, uniform(0.8, 1.2), uniform(2.5, 3.5)).object);
    scene.materials.push_back({"lamp", radiosity::Color{0.0}, radiosity::Color{10.0}});
    scene.objects.push_back(scenes::object("lamp", scenes::polygon({{3, 3, 1}, {3, 4, 1}, {3, 4, -1}, {3, 3, -1}}), 1));
    const radiosity::Options options{.epsilon = 0.02, .audit_points = 0};
    const auto outcome = radiosity::solve(scene, options);
    REQUIRE(outcome.solution);
    const radiosity::Mesh& mesh = outcome.solution->mesh;
    for (const radiosity::MeshFace& face : mesh.faces) {
      if (face.surface != 0) { continue; }
      std::vector<glm::dvec3> corners;
      for (std::uint32_t c = 0; c < face.corner_count; ++c) {
        corners.push_back(mesh.positions[mesh.corners[face.first_corner + c].vertex]);
      }
      const glm::dvec3 flat = glm::normalize(radiosity::vector_area(corners));
      if (std::abs(corners[0].z) > 0.5) { continue; }  // near the tips surfaces bend within a face, too
      for (std::uint32_t c = 0; c < face.corner_count; ++c) {
        CHECK(glm::dot(glm::dvec3{mesh.corners[face.first_corner + c].normal}, flat) > 0.5);
      }
    }
  }
}

// 1000 to 90 000 times the area of the leaves that have it, when a neighbour's light counted in a corner however small the neighbour was.
TEST_CASE("reconstruction: the light of a few small leaves is not spread over leaves a thousand times as wide beside them") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 1};
  for (int turn = 0; turn < 20; ++turn) {
    double least = 0.0;
    // At random first, then along a border of the leaves of one level.
    const auto towards_a_border = [&](std::vector<radiosity::Surface>& surfaces, radiosity::Hierarchy& hierarchy) {
      const int at_random = static_cast<int>(4.0 * random.uniform());
      glm::dvec3 border{0.0};
      std::uint32_t leaf = 0;
      for (int level = 0; level < 12; ++level) {
        if (level <= at_random) { border = hierarchy[leaf].centre; }
        REQUIRE(radiosity::subdivide(surfaces, hierarchy, leaf));
        const radiosity::Node& node = hierarchy[leaf];
        leaf = node.first_child + static_cast<std::uint32_t>(random.uniform() * node.child_count);
        for (std::uint32_t c = node.first_child; level > at_random && c < node.first_child + node.child_count; ++c) {
          if (glm::length(hierarchy[c].centre - border) < glm::length(hierarchy[leaf].centre - border)) { leaf = c; }
        }
      }
      least = hierarchy[leaf].area;
    };
    const auto light = [&](const radiosity::Node& node) { return node.area < 1.5 * least ? 1.0 : 0.0; };
    radiosity::Scene scene = lone(nullptr);
    scene.objects = {scenes::plate("floor", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0)};
    const auto kind = turn % 2 == 0 ? Reconstruction::simple : Reconstruction::weighted;
    const Reconstructed r = reconstructed(scene, kind, towards_a_border, light);
    const radiosity::SurfaceBRep& brep = r.prepared.surfaces[0].brep;
    double spread = 0.0;  // the light of all triangles
    for (const brep::FaceId f : brep::faces(brep)) {
      if (brep.data(f).node == radiosity::no_node) { continue; }
      std::vector<brep::HalfedgeId> loop;
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) { loop.push_back(h); }
      const auto at = [&](std::size_t k) { return brep.data(brep.vertex(loop[k])).position; };
      for (std::size_t k = 2; k < loop.size(); ++k) {
        double mean = 0.0;
        for (const std::size_t corner : {std::size_t{0}, k - 1, k}) { mean += brep.data(loop[corner]).radiosity.x / 3.0; }
        spread += 0.5 * glm::length(glm::cross(at(k - 1) - at(0), at(k) - at(0))) * mean;
      }
    }
    const double in_areas = spread / (4.0 * least);  // of the four leaves that shine
    CAPTURE(turn, in_areas);
    CHECK(in_areas > 0.5);
    CHECK(in_areas < 40.0);
  }
}

TEST_CASE("reconstruction: the light of a sliver, as long as the leaf beside it, is not spread over that") {
  for (const double width : {1e-2, 1e-3, 1e-5}) {
    radiosity::Scene scene = lone(nullptr);
    const std::vector<glm::dvec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1 + width, 0, 0}, {1 + width, 1, 0}};
    scene.objects = {scenes::object("floor", raycast::Mesh::make(positions, {{0, 1, 2, 3}, {1, 4, 5, 2}}).object, 0)};
    const auto light = [&](const radiosity::Node& node) { return node.area < 0.5 ? 1.0 : 0.0; };
    const Reconstructed r = reconstructed(
        scene, Reconstruction::weighted, [](auto&, auto&) {}, light);
    const radiosity::SurfaceBRep& brep = r.prepared.surfaces[0].brep;
    for (const brep::FaceId f : brep::faces(brep)) {
      if (brep.data(f).node == radiosity::no_node || r.hierarchy[brep.data(f).node].area < 0.5) { continue; }
      for (const brep::HalfedgeId h : brep::halfedges_of(brep, f)) { CHECK(brep.data(h).radiosity.x <= 64.0 * width); }
    }
  }
}

TEST_CASE("weighted reconstruction: over random facets it errs less than the constant radiosity of the leaves", "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  radiosity::Random random{seed, 0};
  for (int turn = 0; turn < 4; ++turn) {
    constexpr std::uint32_t n = 8;  // squares a side, of two triangles each
    const double steep = 0.05 + 0.15 * random.uniform();
    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t i = 0; i <= n; ++i) {
      for (std::uint32_t j = 0; j <= n; ++j) { positions.push_back({2.0 * i / n - 1.0, 2.0 * j / n - 1.0, steep * random.uniform()}); }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
        faces.push_back({a, b, b + 1});
        faces.push_back({a, b + 1, a + 1});
      }
    }
    const radiosity::Polygon lamp{{-1, -2, 2}, {-1, 2, 3}, {1, 2, 3}, {1, -2, 2}};  // looks down
    radiosity::Scene scene;
    scene.materials = {{"ground", radiosity::Color{0.5}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{1.0}}};
    scene.objects = {scenes::object("ground", raycast::Mesh::make(positions, faces).object, 0), scenes::plate("lamp", lamp, 1)};
    const radiosity::Options options{.audit_points = 1000, .threads = 1};
    const radiosity::Outcome outcome = radiosity::solve(scene, options);
    REQUIRE(outcome.solution);
    const radiosity::Audit& audit = outcome.solution->audit;
    CAPTURE(turn, steep, audit.surface_error->relative_l2, audit.leaf_error->relative_l2);
    CHECK(audit.leaf_error->relative_l2 < 0.05);
    CHECK(audit.surface_error->low < audit.leaf_error->relative_l2);
  }
}
