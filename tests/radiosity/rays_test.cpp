// SPDX-License-Identifier: MIT

// Laws of stored rays: links of rays are the form factors within their noise, reciprocal and closed, and the noise is what they say.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/radiosity.hpp>
#include <radiosity/rays/ray_choice.hpp>
#include <radiosity/rays/ray_links.hpp>
#include <radiosity/rays/spacing.hpp>
#include <radiosity/rays/stored_rays.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/visibility/leaf_locator.hpp>
#include <radiosity/visibility/prepare.hpp>
#include <radiosity/visibility/visibility.hpp>

#include "catch.hpp"
#include "many_scene.hpp"
#include "roots.hpp"
#include "scenes.hpp"
#include "seed.hpp"
#include "solved.hpp"

using radiosity::DiscreteScene;
using radiosity::Indirect;
using radiosity::Options;
using roots::casters_of;
using roots::closed_room;
using roots::leaves_of;
using roots::roots_of;
using roots::split_at_random;

namespace {

radiosity::RayLinks links_of(DiscreteScene& scene, const std::vector<std::uint32_t>& counts) {
  scene.expose();
  const radiosity::LeafLocator locator{scene.hierarchy, scene.patches, scene.inputs.size()};
  return radiosity::make_ray_links(scene, radiosity::cast_rays(scene, locator, counts), casters_of(scene));
}

}  // namespace

TEST_CASE("links of rays between the walls of a cube are its form factors, within the noise that they tell") {
  // Opposite faces .199825, adjacent ones .200044 (Howell, C-11, C-14). The lamp covers a part of the ceiling, so pairs with the ceiling
  // are left out.
  const radiosity::Scene scene = closed_room({});
  const auto discrete = roots_of(scene, 2);
  std::vector<std::uint32_t> counts(discrete->hierarchy.size(), 4096);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (!radiosity::is_black(discrete->emission[discrete->hierarchy[i].surface])) { counts[i] = 0; }
  }
  const radiosity::RayLinks made = links_of(*discrete, counts);
  const auto& area = discrete->exposure.area;
  int checked = 0;
  for (const radiosity::Link& link : made.links) {
    const glm::dvec3 p = discrete->hierarchy[link.p].normal;
    const glm::dvec3 q = discrete->hierarchy[link.q].normal;
    if (p.z < -0.5 || q.z < -0.5) { continue; }
    const double exact = glm::dot(p, q) < -0.5 ? 0.199825 : 0.200044;
    const double factor = static_cast<double>(link.exchange) / area[link.p];
    const double variance = static_cast<double>(link.exchange) / (made.density[link.p] + made.density[link.q]);
    CHECK(std::abs(factor - exact) <= 4.0 * std::sqrt(variance) / area[link.p]);
    ++checked;
  }
  CHECK(checked == 10);
  // Rays that do not go to the lamp meet a leaf that has rays. The lamp is .09 of the ceiling, of which floor and walls see .2: they see
  // some .02 of it, and the standard error of the share of 4096 rays is .0022.
  for (const std::uint32_t i : leaves_of(*discrete)) {
    if (counts[i] > 0) { CHECK(made.share[i] > 0.95); }
  }
}

TEST_CASE("casters cover once what does not shine and is exposed, where less light is seen they are fewer") {
  // Lamps that reach all, a corner, and nothing but each other's back.
  const auto casters_by = [](double lamp_height, double emission) {
    const radiosity::Scene scene =
        closed_room({scenes::object("box", scenes::box({0.05, 0.05, 0.0}, {0.25, 0.25, 0.4}))}, lamp_height, emission);
    const auto discrete = roots_of(scene);
    discrete->expose();
    radiosity::Links lamps;
    for (std::uint32_t i = 0; i < discrete->hierarchy.size(); ++i) {
      for (std::uint32_t j = i + 1; j < discrete->hierarchy.size(); ++j) {
        const auto shines = [&](std::uint32_t k) { return !radiosity::is_black(discrete->emission[discrete->hierarchy[k].surface]); };
        radiosity::Link link{i, j};
        if (!shines(i) && !shines(j)) { continue; }
        discrete->evaluator(link, {});
        if (link.exchange > 0.0f) { lamps.push_back(link); }
      }
    }
    radiosity::Importance by_area;
    const radiosity::SpacingResult spacing = radiosity::space_casters(*discrete, lamps, by_area, 0.02, 1e-4);
    REQUIRE(discrete->exposure.area.size() == discrete->hierarchy.size());
    std::vector<std::uint32_t> above(discrete->hierarchy.size(), 0);
    for (const radiosity::Caster& caster : spacing.casters) { ++above[caster.node]; }
    for (std::size_t i = 0; i < above.size(); ++i) {
      const radiosity::Node& node = discrete->hierarchy[i];
      if (node.parent != radiosity::no_node) { above[i] += above[node.parent]; }
      const bool casts = radiosity::is_black(discrete->emission[node.surface]) && discrete->exposure.area[i] > 0.0 && emission > 0.0;
      if (node.leaf()) { CHECK(above[i] == (casts ? 1u : 0u)); }
    }
    return spacing.casters.size();
  };
  const std::size_t bright = casters_by(1.0, 1.0);
  CHECK(bright > 50);
  CHECK(casters_by(1.0, 1000.0) == bright);  // the unit of light does not matter
  CHECK(casters_by(1.0, 0.0) == 0);
  CHECK(casters_by(0.1, 1.0) < bright);  // low over the floor: most of the room is dark
}

TEST_CASE("rays do not depend on the number of threads") {
  const radiosity::Scene scene = scenes::many(150, scenes::Things::boxes);
  Options options{.epsilon = 0.05, .indirect = Indirect::rays, .audit_points = 0, .threads = 1};
  const radiosity::Solution one = scenes::solved(scene, options);
  options.threads = 3;
  const radiosity::Solution three = scenes::solved(scene, options);
  REQUIRE(one.ray_links.size() == three.ray_links.size());
  CHECK(one.radiosity == three.radiosity);
}

TEST_CASE("rooms by stored rays: closed rows, no energy lost, and the radiosities of links", "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  for (const scenes::Things kind : {scenes::Things::boxes, scenes::Things::polygons, scenes::Things::mesh}) {
    const radiosity::Scene scene = scenes::many(110 + static_cast<std::uint32_t>(random() % 100), kind);
    Options options;
    options.epsilon = 0.03;
    options.audit_points = 0;
    options.seed = random();
    const radiosity::Solution rays = scenes::solved(scene, options);
    REQUIRE(rays.audit.stored_rays > 0);
    if (kind == scenes::Things::boxes) { CHECK(std::abs(rays.audit.row_sum.mean - 1.0) < 0.01); }  // backs of polygons absorb
    CHECK(rays.audit.energy_balance < 1e-6);
    options.indirect = Indirect::links;
    const radiosity::Solution links = scenes::solved(scene, options);
    CHECK(links.audit.stored_rays == 0);
    double sum_rays = 0.0, sum_links = 0.0;
    for (std::size_t i = 0; i < rays.audit.surfaces.size(); ++i) {
      const auto& [name, area, radiosity] = rays.audit.surfaces[i];
      sum_rays += area * radiosity.x;
      sum_links += links.audit.surfaces[i].area * links.audit.surfaces[i].radiosity.x;
    }
    CHECK(std::abs(sum_rays / sum_links - 1.0) < 0.02);
  }
}

TEST_CASE("the noise of rays is what they tell: solutions by other rays differ by it") {
  const radiosity::Scene scene = closed_room({scenes::object("box", scenes::box({0.1, 0.2, 0.0}, {0.4, 0.5, 0.4}))});
  // What arrives over the links from leaves whose radiosity is their height, times the reflectance .7.
  const auto arrived = [&](std::uint64_t seed, double& told) {
    const auto discrete = roots_of(scene, 1, seed);
    for (std::uint32_t i = 0; i < discrete->hierarchy.size() && discrete->hierarchy.size() < 1000; ++i) {
      REQUIRE(radiosity::subdivide(discrete->surfaces, discrete->hierarchy, i, discrete->meshing));
    }
    discrete->expose();
    std::vector<std::uint32_t> counts = radiosity::ray_counts(*discrete, casters_of(*discrete), 64.0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (!radiosity::is_black(discrete->emission[discrete->hierarchy[i].surface])) { counts[i] = 0; }
    }
    radiosity::RayLinks made = links_of(*discrete, counts);
    std::vector<radiosity::Color> light;
    std::vector<double> height, y;
    for (const radiosity::Node& node : discrete->hierarchy) {
      height.push_back(1.0 + node.centre.z);
      light.emplace_back(height.back());
    }
    told = made.noise(*discrete, made.links, light);
    radiosity::Links none;
    radiosity::Transport transport{discrete->hierarchy, none, discrete->exposure};
    transport.add_sampled(made.links);
    static_cast<void>(transport.scale_sampled(made.share, radiosity::scales_of_open));
    transport.apply(height, y);
    std::vector<std::pair<double, double>> result;  // area and reflected radiosity
    for (const std::uint32_t i : leaves_of(*discrete)) {
      const double area = discrete->exposure.area[i];
      if (counts[i] > 0) { result.emplace_back(area, 0.7 * y[i] / area); }
    }
    return result;
  };
  double told = 0.0, squares = 0.0;
  constexpr int seeds = 6;
  std::vector<std::vector<std::pair<double, double>>> all;
  for (int seed = 1; seed <= seeds; ++seed) { all.push_back(arrived(static_cast<std::uint64_t>(seed), told)); }
  std::size_t compared = 0;
  for (std::size_t a = 0; a < seeds; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      REQUIRE(all[a].size() == all[b].size());
      ++compared;
      for (std::size_t i = 0; i < all[a].size(); ++i) { squares += all[a][i].first * std::pow(all[a][i].second - all[b][i].second, 2.0); }
    }
  }
  const double measured = 0.5 * squares / static_cast<double>(compared) * 3.0;  // noise() counts three channels
  INFO("told " << told << ", measured " << measured);
  CHECK(measured < 2.0 * told);  // even points err less than random ones
  CHECK(measured > 0.1 * told);
}

TEST_CASE("rays of small things are as good beside something far away") {
  // A box on a plate under a lamp, and a plate that none of them sees. The frame is 10 or 100 000 times as large as they are: floats of the
  // frame would tell places on them to .6 % of their size. Form factors to what is that far away are below 1e-10; some rays of a million
  // may pass an edge on its other side.
  const auto means = [](double distance) {
    radiosity::Scene scene;
    scene.materials = {{"white", radiosity::Color{0.7}, radiosity::Color{0.0}}, {"lamp", radiosity::Color{0.0}, radiosity::Color{5.0}}};
    scene.objects = {scenes::square("floor", {0.0, 0.0, 0.0}, 1.0, true),
                     scenes::object("box", scenes::box({-0.3, -0.3, 0.0}, {0.3, 0.3, 0.6})),
                     scenes::square("lamp", {0.8, 0.0, 1.5}, 0.3, false, 1), scenes::square("far", {0.0, 0.0, -distance}, 1.0, false)};
    const Options options{.epsilon = 0.05, .indirect = Indirect::rays, .audit_points = 0};
    const radiosity::Solution solution = scenes::solved(scene, options);
    std::vector<double> result{static_cast<double>(solution.audit.leaves)};
    for (const auto& surface : solution.audit.surfaces) { result.push_back(surface.radiosity.x); }
    return result;
  };
  const std::vector<double> near = means(10.0);
  const std::vector<double> far = means(1e5);
  REQUIRE(near.size() == far.size());
  CHECK(near[0] == far[0]);
  for (std::size_t i = 1; i < near.size(); ++i) { CHECK(std::abs(near[i] - far[i]) <= 1e-4 * near[i]); }
}

// Two stacks of plates at gaps that are a hundredth to half of their width.
TEST_CASE("narrow gaps: rows of form factors near 1 before they are closed, and the light of a closed room", "[accuracy]") {
  const auto seed = test::seed();
  INFO("seed " << seed);
  std::mt19937_64 random{seed};
  const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<double>{lo, hi}(random); };
  for (int round = 0; round < 3; ++round) {
    radiosity::Scene scene;
    scene.materials = {{"wall", radiosity::Color{0.7}, radiosity::Color{0.0}},
                       {"plate", radiosity::Color{0.8}, radiosity::Color{0.0}},
                       {"lamp", radiosity::Color{0.1}, radiosity::Color{20.0}}};
    scene.objects = {scenes::object("room", scenes::box({0, 0, 0}, {4, 3, 2.5}), 0, true),
                     scenes::object("lamp", scenes::polygon({{1.6, 1.2, 2.5}, {1.6, 1.8, 2.5}, {2.4, 1.8, 2.5}, {2.4, 1.2, 2.5}}), 2)};
    const double width = between(0.3, 0.7), gap = width * std::exp(between(std::log(0.01), std::log(0.5))), thick = between(0.002, 0.02);
    for (int row = 0; row < 2; ++row) {
      for (int k = 0; k < 8; ++k) {
        const glm::dvec3 lo{0.5 + k * (gap + thick), 0.6 + 1.2 * row * width, 0.5};
        scene.objects.push_back(scenes::object("plate", scenes::box(lo, lo + glm::dvec3{thick, width, width}), 1));
      }
    }
    const Options options{.epsilon = 0.02, .min_area = 2e-4, .audit_points = 500};
    const radiosity::Audit audit = scenes::solved(scene, options).audit;
    REQUIRE(audit.leaf_error);
    CAPTURE(round, width, gap / width, audit.stored_rays, audit.leaf_error->relative_l2, audit.leaf_error->low, audit.leaf_error->high);
    CHECK(audit.computed_row_sum.min > 0.5);
    CHECK(audit.computed_row_sum.max < 1.5);
    CHECK(std::abs(audit.computed_row_sum.mean - 1.0) < 0.01);
    CHECK(audit.leaf_error->low < 0.12);
  }
}

TEST_CASE("which runs cast rays") {
  const radiosity::Scene few = scenes::room_with_box();
  const radiosity::Scene many = scenes::many(150, scenes::Things::boxes);
  Options options{.epsilon = 0.1, .audit_points = 0};
  CHECK(scenes::solved(few, options).audit.stored_rays == 0);
  CHECK(scenes::solved(many, options).audit.stored_rays > 0);
  options.indirect = Indirect::rays;
  CHECK(scenes::solved(few, options).audit.stored_rays > 0);
  // All shine, none more than others: no lamp is linked to everything.
  CHECK(scenes::solved(scenes::many(150, scenes::Things::boxes, 0.5), options).audit.stored_rays > 0);
  for (const radiosity::Solver solver : {radiosity::Solver::gauss_seidel, radiosity::Solver::southwell}) {
    options.solver = solver;
    CHECK(radiosity::solve(many, options).failure.kind == radiosity::Failure::Kind::invalid_options);
  }
  options.solver = radiosity::Solver::conjugate_gradients;
  options.refinement = radiosity::Refinement::a_posteriori;
  CHECK(radiosity::solve(many, options).failure.kind == radiosity::Failure::Kind::invalid_options);
}

TEST_CASE("without light, or without reflection, no ray is cast") {
  Options options{.epsilon = 0.1, .indirect = Indirect::rays, .audit_points = 0};
  const auto check_dark = [&](const radiosity::Scene& scene, double emission) {
    for (const bool lit : {false, true}) {
      radiosity::Scene dark = scene;
      for (radiosity::Material& material : dark.materials) { (lit ? material.reflectance : material.emission) = radiosity::Color{0.0}; }
      for (const bool shortcuts : {true, false}) {
        options.shortcuts = shortcuts;
        const radiosity::Solution solution = scenes::solved(dark, options);
        for (const radiosity::Color& b : solution.radiosity) { CHECK((b.x == 0.0 || b.x == emission)); }
        if (shortcuts) { CHECK(solution.audit.stored_rays == 0); }
      }
    }
  };
  check_dark(scenes::many(150, scenes::Things::boxes), 5.0);
  check_dark(scenes::two_plates(0.5), 1.0);  // open: its row sums are not known beforehand
}

TEST_CASE("stored rays obey the memory limit and the cancel flag") {
  const radiosity::Scene scene = scenes::many(150, scenes::Things::boxes);
  Options options{.epsilon = 0.01, .audit_points = 0, .memory = 20'000'000};
  const radiosity::Solution coarser = scenes::solved(scene, options);
  CHECK_FALSE(coarser.audit.shortage.empty());
  CHECK(coarser.audit.epsilon > options.epsilon);
  options.memory = 300'000;
  CHECK(radiosity::solve(scene, options).failure.kind == radiosity::Failure::Kind::out_of_memory);
  options.memory.reset();
  const std::atomic<bool> stop{true};
  radiosity::Control control;
  control.cancel = &stop;
  CHECK(radiosity::solve(scene, options, control).failure.kind == radiosity::Failure::Kind::cancelled);
}
