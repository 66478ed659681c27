// SPDX-License-Identifier: MIT

// Leaves that are split by the light once links are there: what is arrived at the leaf arrives at its children, no more and no less.

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/object.hpp>
#include <raycast/objects/cylinder.hpp>
#include <raycast/objects/sphere.hpp>

#include <radiosity/geometry/form_factor.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/patch.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/refinement/leaf_splits.hpp>
#include <radiosity/run/run.hpp>
#include <radiosity/run/stages.hpp>
#include <radiosity/solver/transport.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/exposure.hpp>

#include "catch.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

namespace {

using radiosity::Color;
using radiosity::Hierarchy;
using radiosity::Links;

struct LeafSplitSeed {
  std::uint64_t seed = test::seed();
  std::mt19937_64 random{seed};
  double between(double a, double b) { return std::uniform_real_distribution<double>{a, b}(random); }
};

radiosity::Options leaf_split_options(double epsilon) {
  return {.epsilon = epsilon, .min_area = 4e-4, .indirect = radiosity::Indirect::links, .audit_points = 0, .threads = 2};
}

// A run whose links are evaluated and whose leaves are as refinement has left them.
struct LinkedRun {
  LinkedRun(const radiosity::Scene& scene, const radiosity::Options& options, const radiosity::Control& control = {})
      : run{scene, options, control, {}} {
    for (const auto next : {radiosity::stage::build, radiosity::stage::refine, radiosity::stage::expose}) { REQUIRE_FALSE(next(run)); }
    auto evaluated = radiosity::make_links({run.scene.evaluator, run.refined.occluders, run.scene.threads, {}}, run.refined.linked, links);
    doubt = std::move(evaluated.doubt);
    hierarchy = run.scene.hierarchy;
    exposure = run.scene.exposure;
    links_before = links;
  }
  radiosity::LeafSplits split() {
    return radiosity::split_leaves_by_light(run.scene, links, {run.solution.audit.light_epsilon, run.options.min_area}, doubt);
  }
  bool unchanged() const {
    bool same =
        run.scene.hierarchy.size() == hierarchy.size() && links.size() == links_before.size() && run.scene.exposure.area == exposure.area;
    for (std::size_t i = 0; same && i < links.size(); ++i) { same = links[i].exchange == links_before[i].exchange; }
    return same;
  }
  // What arrives at each node when the leaves send this.
  std::vector<double> arrived(const std::vector<double>& sent) {
    std::vector<double> result;
    radiosity::Transport{run.scene.hierarchy, links, run.scene.exposure}.apply(sent, result);
    return result;
  }
  std::vector<double> arrived_before(const std::vector<double>& sent) {
    std::vector<double> result;
    radiosity::Transport{hierarchy, links_before, exposure}.apply(sent, result);
    return result;
  }

  radiosity::detail::Run run;
  Links links, links_before;
  radiosity::DoubtSum doubt;
  Hierarchy hierarchy;  // before
  radiosity::Exposure exposure;
};

// A closed room with boxes that stand about and a lamp under the ceiling.
radiosity::Scene furnished(LeafSplitSeed& random) {
  radiosity::Scene scene;
  scene.materials = {{"wall", Color{0.6}, Color{0.0}}, {"lamp", Color{0.0}, Color{10.0}}, {"red", Color{0.7, 0.2, 0.2}, Color{0.0}}};
  scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, {2, 2, 2}), 0, true)};
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 at{random.between(0.2, 1.4), random.between(0.2, 1.4), 0.0};
    scene.objects.push_back(
        scenes::object("box" + std::to_string(i), scenes::box(at, at + glm::dvec3{0.35, 0.25, random.between(0.2, 1.0)}), 2));
  }
  scene.objects.push_back(scenes::square("lamp", {random.between(0.5, 1.5), random.between(0.5, 1.5), 1.9}, 0.2, false, 1));
  return scene;
}

}  // namespace

TEST_CASE("split leaves: their children receive together what the leaf received, and send what it sent") {
  LeafSplitSeed random;
  INFO("seed " << random.seed);
  LinkedRun linked{furnished(random), leaf_split_options(0.03)};
  const radiosity::LeafSplits splits = linked.split();
  CHECK(splits.count > 10);
  REQUIRE(linked.links.size() == linked.links_before.size());
  const Hierarchy& now = linked.run.scene.hierarchy;
  const std::size_t before = linked.hierarchy.size();
  std::vector<double> sent(now.size(), 0.0);
  for (std::size_t i = 0; i < now.size(); ++i) { sent[i] = i < before ? random.between(0.0, 1.0) : sent[now[i].parent]; }
  std::vector<double> arrived = linked.arrived(sent);
  for (std::size_t i = now.size(); i-- > before;) { arrived[now[i].parent] += arrived[i]; }
  sent.resize(before);
  const std::vector<double> expected = linked.arrived_before(sent);
  double most = 0.0, off = 0.0;
  for (std::size_t i = 0; i < before; ++i) {
    if (!linked.hierarchy[i].leaf()) { continue; }
    most = std::max(most, expected[i]);
    off = std::max(off, std::abs(arrived[i] - expected[i]));
  }
  CHECK(off < 1e-12 * static_cast<double>(before) * most);  // sums in another order
}

TEST_CASE("split leaves: none below min_area, none that is partly buried, and two levels at most") {
  LeafSplitSeed random;
  INFO("seed " << random.seed);
  LinkedRun linked{furnished(random), leaf_split_options(0.02)};
  CHECK(linked.split().count > 10);
  double total = 0.0;
  for (std::size_t i = 0; i < linked.hierarchy.size(); ++i) {
    const bool buried = !(linked.exposure.area[i] > 0.0);
    if (radiosity::is_input_face(linked.hierarchy, i) && !buried) { total += linked.hierarchy[i].area; }
  }
  const Hierarchy& now = linked.run.scene.hierarchy;
  for (std::size_t i = linked.hierarchy.size(); i < now.size(); ++i) {
    const std::uint32_t parent = now[i].parent;
    CHECK(now[parent].area > linked.run.options.min_area * total * (1.0 - 1e-12));
    const std::uint32_t leaf = parent < linked.hierarchy.size() ? parent : now[parent].parent;
    REQUIRE(leaf < linked.hierarchy.size());
    CHECK(linked.hierarchy[leaf].leaf());
    CHECK_FALSE(linked.exposure.partly_buried[leaf]);
  }
}

TEST_CASE("split leaves: nothing changes where all variation is allowed, where memory does not suffice, and once a run was cancelled") {
  LeafSplitSeed random;
  INFO("seed " << random.seed);
  const radiosity::Scene scene = furnished(random);
  radiosity::Options options = leaf_split_options(0.05);
  {
    LinkedRun linked{scene, options};
    linked.run.solution.audit.light_epsilon = 1e9;
    CHECK(linked.split().count == 0);
    CHECK(linked.unchanged());
  }
  {
    LinkedRun linked{scene, options};
    linked.run.scene.budget.allowed = linked.run.scene.budget.peak({linked.hierarchy.size(), linked.links.size()});
    const radiosity::LeafSplits splits = linked.split();
    CHECK(splits.count == 0);
    CHECK(splits.too_large > linked.run.scene.budget.allowed);
    CHECK(linked.unchanged());
  }
  std::atomic<bool> cancel = false;
  radiosity::Control control;
  control.cancel = &cancel;
  LinkedRun linked{scene, options, control};
  cancel = true;
  CHECK(linked.split().count == 0);
  CHECK(linked.unchanged());
}

TEST_CASE("split leaves: the same bits from any number of threads, by links and by stored rays") {
  LeafSplitSeed random;
  INFO("seed " << random.seed);
  radiosity::Scene scene = furnished(random);
  scene.objects.push_back(scenes::object("ball", raycast::Sphere::make({1.0, 1.0, 1.2}, 0.2).object, 0));
  for (const auto indirect : {radiosity::Indirect::links, radiosity::Indirect::rays}) {
    radiosity::Options options = leaf_split_options(0.05);
    options.indirect = indirect;
    options.threads = 1;
    const radiosity::Solution one = scenes::solved(scene, options);
    CHECK(one.audit.leaf_splits > 10);
    options.threads = 3;
    const radiosity::Solution three = scenes::solved(scene, options);
    CHECK(one.audit.leaf_splits == three.audit.leaf_splits);
    CHECK(one.audit.closure_limit == three.audit.closure_limit);
    CHECK(one.radiosity == three.radiosity);
  }
}

// The true radiosity under one lamp that reflects nothing is known at each point.
TEST_CASE("split leaves: on curved objects under a lamp the same links give a smaller error") {
  LeafSplitSeed random;
  INFO("seed " << random.seed);
  for (int k = 0; k < 4; ++k) {
    const glm::dvec3 at{random.between(-0.5, 0.5), random.between(-0.5, 0.5), 0.0};
    const double r = random.between(0.3, 0.8), height = random.between(2.2, 3.5), side = random.between(0.5, 1.2);
    std::shared_ptr<const raycast::Object> shape = raycast::Sphere::make(at, r).object;
    if (k % 2 != 0) { shape = raycast::Cylinder::make(at, {1, 0, 0.3}, r).object; }
    radiosity::Scene scene;
    scene.materials = {{"lamp", Color{0.0}, Color{1.0}}, {"thing", Color{0.5}, Color{0.0}}};
    scene.objects = {scenes::square("lamp", {0, 0, height}, 0.5 * side, false, 0), scenes::object("thing", shape, 1)};
    CAPTURE(k, at.x, at.y, r, height, side);
    radiosity::Options options = leaf_split_options(0.01);
    options.min_area = 2e-5;  // stands in no leaf's way
    LinkedRun linked{scene, options};
    const auto& discrete = linked.run.scene;
    const double h = 0.5 * side;
    const radiosity::Polygon lamp{{-h, h, height}, {h, h, height}, {h, -h, height}, {-h, -h, height}};
    const auto square_error = [&](const Hierarchy& hierarchy, const radiosity::Exposure& exposure, const std::vector<double>& arrived) {
      double sum = 0.0;
      for (std::size_t i = 0; i < hierarchy.size(); ++i) {
        if (!hierarchy[i].leaf() || hierarchy[i].object == 0) { continue; }
        const std::uint32_t sheet = hierarchy[i].surface - 1;
        for (const radiosity::QuadraturePoint& q : discrete.patches[i].rule3) {
          const raycast::SurfacePoint p = discrete.objects.object(1).project(sheet, q.position);
          radiosity::Polygon above;
          const glm::dvec3 x = discrete.frame.to_scene(p.position);
          radiosity::clip_to_horizon(lamp, x, p.normal, above);
          const double truth = above.size() < 3 ? 0.0 : radiosity::point_to_polygon(x, p.normal, above);
          const double error = arrived[i] / exposure.area[i] - truth;
          sum += q.weight * error * error;
        }
      }
      return sum;
    };
    const auto emission = [](const Hierarchy& hierarchy) {
      std::vector<double> sent(hierarchy.size(), 0.0);
      for (std::size_t i = 0; i < hierarchy.size(); ++i) { sent[i] = hierarchy[i].leaf() && hierarchy[i].object == 0 ? 1.0 : 0.0; }
      return sent;
    };
    const double before = square_error(linked.hierarchy, linked.exposure, linked.arrived_before(emission(linked.hierarchy)));
    const radiosity::LeafSplits splits = linked.split();
    CHECK(splits.count > 10);
    CHECK(linked.links.size() == linked.links_before.size());
    const double after = square_error(discrete.hierarchy, discrete.exposure, linked.arrived(emission(discrete.hierarchy)));
    // By one level a linear part falls to a half, its square to a quarter; some leaves stay whole, and light is not linear everywhere.
    CHECK(after < 0.5 * before);
  }
}
