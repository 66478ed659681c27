// SPDX-License-Identifier: MIT

// Laws of the hierarchy above the input faces: what clusters may change and what they may not.

#include <numeric>
#include <radiosity/clusters/cluster_exchange.hpp>
#include <radiosity/clusters/clusters.hpp>
#include <radiosity/clusters/face_clusters.hpp>
#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/links/link_schedule.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/material.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <random>

#include <raycast/objects/cylinder.hpp>
#include "catch.hpp"

#include "radiosity/many_scene.hpp"
#include "radiosity/solved.hpp"

using radiosity::Hierarchy;
using radiosity::Node;
using scenes::clustered;
using scenes::solved;

namespace {

glm::dvec3 random_vector(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  const double x = normal(engine), y = normal(engine), z = normal(engine);
  return {x, y, z};
}

}  // namespace

TEST_CASE("every direction is a sum of three of the lattice, none of them with a negative weight") {
  std::mt19937_64 engine{1};
  const auto& lattice = radiosity::detail::direction_lattice;
  for (int i = 0; i < 10'000; ++i) {
    glm::dvec3 v = random_vector(engine) * std::exp2(20.0 * (i % 7) - 60.0);
    if (i % 10 == 0) { v[i % 3] = 0.0; }
    if (i % 11 == 0) { v = {v.x, v.x, -v.x}; }
    const radiosity::Aim aim = radiosity::aim(v);
    glm::dvec3 sum{0.0};
    for (std::size_t j = 0; j < 3; ++j) {
      REQUIRE(aim.weight[j] >= 0.0);
      const std::uint32_t k = aim.direction[j];
      sum += aim.weight[j] * glm::dvec3{lattice.x[k], lattice.y[k], lattice.z[k]};
    }
    REQUIRE(glm::length(sum - v) <= 1e-15 * 8.0 * glm::length(v));
  }
}

TEST_CASE("what a face shows in a direction is never too little, and nothing when it looks away by more than 35.3 degrees") {
  std::mt19937_64 engine{2};
  const double mesh = std::atan(std::sqrt(0.5));  // from the middle of a side of the cube to the far corner of the next cell
  const auto& lattice = radiosity::detail::direction_lattice;
  double all = 0.0;
  double from_behind = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    const glm::dvec3 n = glm::normalize(random_vector(engine));
    const glm::dvec3 d = glm::normalize(random_vector(engine));
    const double cosine = glm::dot(n, d);
    const double shown = radiosity::shown(n, radiosity::aim(d));
    REQUIRE(shown >= cosine - 1e-14);
    if (cosine < -std::sin(mesh)) { REQUIRE(shown == 0.0); }
    all += shown;
    if (cosine > 0.0 || shown == 0.0) { continue; }
    // The parts of n . d_k across d sum to 0, so what is positive of them is at most half of sum w |d_k| sin(angle to d); the parts along
    // d take away from that.
    double most = 0.0;
    const radiosity::Aim aim = radiosity::aim(d);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::uint32_t k = aim.direction[j];
      most += 0.5 * aim.weight[j] * glm::length(glm::cross(d, glm::dvec3{lattice.x[k], lattice.y[k], lattice.z[k]}));
    }
    REQUIRE(shown <= most + 1e-14);
    REQUIRE(most < 0.25);
    from_behind += shown;
  }
  CHECK(from_behind < 0.015 * all);  // measured over a million: 1.24 %
}

TEST_CASE("the tree of clusters holds every input face once and bounds what is below") {
  for (const std::uint32_t k : {2u, 13u, 97u, 1003u}) {
    radiosity::PrepareResult prepared =
        radiosity::prepare(k == 2 ? scenes::two_plates(0.5) : scenes::many(k, k == 97 ? scenes::Things::mesh : scenes::Things::boxes));
    REQUIRE(prepared.prepared);
    auto& surfaces = prepared.prepared->surfaces;
    const Hierarchy roots = radiosity::make_roots(surfaces);
    const Hierarchy tree = radiosity::make_clusters(surfaces, roots);
    std::size_t faces = 0;
    double area = 0.0;
    for (std::uint32_t i = 0; i < tree.size(); ++i) {
      const Node& node = tree[i];
      if (!node.is_cluster()) {
        ++faces;
        REQUIRE(radiosity::is_input_face(tree, i));
        REQUIRE(surfaces[node.object].brep.data(node.face).node == i);
        continue;
      }
      if (node.parent == radiosity::no_node) { area = node.area; }
      double sum = 0.0;
      for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
        REQUIRE(c > i);
        REQUIRE(tree[c].parent == i);
        sum += tree[c].area;
        REQUIRE(glm::length(tree[c].centre - node.centre) + tree[c].radius <= node.radius * (1.0 + 1e-12));
      }
      REQUIRE(sum == Approx(node.area).epsilon(1e-12));
    }
    double all = 0.0;
    for (const Node& root : roots) { all += root.area; }
    CHECK(area == Approx(all).epsilon(1e-12));
    CHECK(faces == roots.size());
    CHECK(3 * (tree.size() - faces) <= 2 * faces + 3);
  }
}

TEST_CASE("face clusters of a cylinder keep its caps apart from its side until the end") {
  radiosity::Scene scene;
  scene.materials = {{"grey", radiosity::Color{0.5}, radiosity::Color{1.0}}};
  scene.objects = {scenes::object("cylinder", raycast::Cylinder::make({0, 0, 0}, {0, 0, 1}, 0.5).object)};
  radiosity::PrepareResult prepared = radiosity::prepare(scene);
  REQUIRE(prepared.prepared);
  auto& surfaces = prepared.prepared->surfaces;
  const Hierarchy roots = radiosity::make_roots(surfaces);
  const auto items = static_cast<std::uint32_t>(roots.size());
  std::vector<std::uint32_t> numbers(items);
  std::iota(numbers.begin(), numbers.end(), 0u);
  const radiosity::Grouping tree = radiosity::cluster_faces(surfaces[0], roots, numbers);
  REQUIRE(tree.tops.size() == 1);
  REQUIRE(tree.groups.size() == items - 1);
  // Each group is connected and flatter than what is above it: a binary tree whose lower half never mixes a cap and the side.
  std::vector<std::vector<std::uint32_t>> below;
  for (const auto& members : tree.groups) {
    std::vector<std::uint32_t> all;
    for (const std::uint32_t m : members) {
      if (tree.is_group(m)) {
        all.insert(all.end(), below[m - items].begin(), below[m - items].end());
      } else {
        all.push_back(m);
      }
    }
    below.push_back(all);
    if (all.size() > 4) { continue; }
    for (const std::uint32_t i : all) { CHECK((std::abs(roots[i].normal.z) > 0.5) == (std::abs(roots[all[0]].normal.z) > 0.5)); }
  }
}

TEST_CASE("transport with clusters is symmetric and never negative") {
  radiosity::Solution solution = solved(scenes::many(301, scenes::Things::boxes), clustered(0.1));
  REQUIRE(solution.audit.cluster_links > 0);
  radiosity::Exposure exposure;
  exposure.area = solution.area;
  exposure.centroid.assign(solution.area.size(), glm::dvec3{0.0});
  for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) { exposure.centroid[i] = solution.hierarchy[i].centre; }
  radiosity::Transport transport{solution.hierarchy, solution.links, exposure};
  std::mt19937_64 engine{3};
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  for (int round = 0; round < 4; ++round) {
    std::vector<double> x(solution.area.size(), 0.0);
    std::vector<double> y(solution.area.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!solution.hierarchy[i].leaf()) { continue; }
      x[i] = uniform(engine);
      y[i] = uniform(engine) < 0.05 ? 1.0 : 0.0;
    }
    std::vector<double> mx;
    std::vector<double> my;
    transport.apply(x, mx);
    transport.apply(y, my);
    double left = 0.0;
    double right = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      REQUIRE(mx[i] >= 0.0);
      left += y[i] * mx[i];
      right += x[i] * my[i];
    }
    // Sums of some 10^4 positive terms.
    CHECK(left == Approx(right).epsilon(1e-12));
  }
}

TEST_CASE("a cluster lights no face that looks away") {
  // A cluster of one box, linked with a plate far above it: its floor and nothing else stays dark; what the plate gives is shared by
  // the areas that the faces show to it.
  radiosity::Scene scene;
  scene.materials = {{"grey", radiosity::Color{0.5}, radiosity::Color{1.0}}};
  scene.objects = {scenes::object("box", scenes::box({0, 0, 0}, {1, 1, 1})),
                   scenes::object("plate", scenes::polygon({{3, 0, 9}, {3, 1, 9}, {4, 1, 9}, {4, 0, 9}}))};
  radiosity::PrepareResult prepared = radiosity::prepare(scene);
  REQUIRE(prepared.prepared);
  auto& surfaces = prepared.prepared->surfaces;
  const Hierarchy tree = radiosity::make_clusters(surfaces, radiosity::make_roots(surfaces));
  radiosity::Patches patches{surfaces, tree};
  patches.extend(1);
  radiosity::Exposure exposure;
  const radiosity::SceneView view{prepared.prepared->objects, prepared.prepared->plan, surfaces, tree, patches};
  radiosity::extend(exposure, view, 1, 1);
  const radiosity::ShownAreas shown{tree, [&](std::size_t i) { return exposure.area[i]; }};
  std::uint32_t box = 0;
  std::uint32_t plate = 0;
  for (std::uint32_t i = 1; i < tree.size(); ++i) {
    if (tree[i].is_cluster()) { box = i; }
    if (tree[i].object == 1) { plate = i; }
  }
  REQUIRE(box != 0);
  const radiosity::ClusterSampler sampler{view, &exposure, shown};
  radiosity::Links links{{box, plate}};
  (void)radiosity::evaluate_cluster_link(sampler, tree, links[0], 16, radiosity::Random{1, 2});
  REQUIRE(links[0].exchange > 0.0f);
  radiosity::Transport transport{tree, links, exposure};
  std::vector<double> x(tree.size(), 0.0);
  std::vector<double> y;
  x[plate] = 1.0;
  transport.apply(x, y);
  const glm::dvec3 d = glm::normalize(tree[plate].centre - tree[box].centre);
  double sum = 0.0;
  for (std::uint32_t i = tree[box].first_child; i < tree[box].first_child + 6; ++i) {
    const double cosine = glm::dot(tree[i].normal, d);
    if (cosine < 1e-9 && std::abs(tree[i].normal.y) < 0.5) {
      CHECK(y[i] == 0.0);  // the floor, and the side away from the plate
    } else if (std::abs(tree[i].normal.y) < 0.5) {
      // The irradiance of a plate that is ten sides away: the kernel differs by the square of the half diagonals, a few per cent.
      const double r = glm::length(tree[plate].centre - tree[box].centre);
      const double kernel = cosine * glm::dot(-tree[plate].normal, d) / (3.14159265358979 * r * r);
      CHECK(y[i] / (tree[i].area * tree[plate].area) == Approx(kernel).epsilon(0.15));
    }
    sum += y[i];
  }
  CHECK(sum == Approx(static_cast<double>(links[0].exchange)).epsilon(0.01));  // the direction is kept to 8 bits
}

TEST_CASE("the schedule of the links holds each once, and in no round a tile twice") {
  std::mt19937_64 engine{4};
  constexpr std::uint32_t nodes = 5'000;
  std::uniform_int_distribution<std::uint32_t> any{0, nodes - 1};
  radiosity::Links links(100'000);
  for (radiosity::Link& link : links) {
    link.p = any(engine) * (any(engine) % 2);  // half of them at node 0
    link.q = any(engine);
  }
  for (std::uint32_t i = 0; i < links.size(); ++i) { links[i].exchange = static_cast<float>(i); }
  const radiosity::Links given = links;
  radiosity::MeasuredLinks measured;  // records move whole, and as links alone do
  for (std::uint32_t i = 0; i < links.size(); ++i) { measured.push_back({links[i], i, {}}); }
  radiosity::LinkSchedule::arrange(nodes, measured);
  const radiosity::LinkSchedule schedule{nodes, links};
  std::vector<int> seen(links.size(), 0);
  for (const auto& round : schedule.rounds()) {
    std::vector<std::size_t> block_of_node(nodes, 0);
    for (std::size_t b = 0; b < round.size(); ++b) {
      for (std::size_t k = round[b].begin; k < round[b].end; ++k) {
        const radiosity::Link& link = links[k];
        const auto was = static_cast<std::uint32_t>(link.exchange);
        REQUIRE((measured[k].list == was && measured[k].link.exchange == link.exchange));
        REQUIRE((link.p == given[was].p && link.q == given[was].q));
        REQUIRE((k == round[b].begin || links[k - 1].exchange < link.exchange));  // in the order in which they stood
        ++seen[was];
        for (const std::uint32_t i : {link.p, link.q}) {
          REQUIRE((block_of_node[i] == 0 || block_of_node[i] == b + 1));
          block_of_node[i] = b + 1;
        }
      }
    }
  }
  CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
}
