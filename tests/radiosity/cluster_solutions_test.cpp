// SPDX-License-Identifier: MIT

// Laws of solutions with clusters, by F- and by BF-refinement: what they agree with, and that they are the same for any number of threads.

#include <radiosity/radiosity.hpp>
#include <radiosity/result/audit.hpp>
#include <radiosity/result/outcome.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/left_out.hpp>
#include <radiosity/visibility/plan.hpp>

#include "catch.hpp"

#include "radiosity/many_scene.hpp"
#include "radiosity/solved.hpp"

using radiosity::Options;
using scenes::clustered;
using scenes::solved;

namespace {

Options by_light(double target, std::uint32_t from) {
  Options options = clustered(0.1, from);
  options.refinement = radiosity::Refinement::a_posteriori;
  options.target = target;
  return options;
}

constexpr std::uint32_t never = 0xffffffff;

// Area-weighted relative L2 difference of the means of the input surfaces, lamps left out.
double difference(const radiosity::Solution& a, const radiosity::Solution& b) {
  double square = 0.0;
  double norm = 0.0;
  for (std::size_t i = 0; i < a.audit.surfaces.size(); ++i) {
    const radiosity::SurfaceMean& p = a.audit.surfaces[i];
    const radiosity::SurfaceMean& q = b.audit.surfaces[i];
    if (p.name == "lamp") { continue; }
    square += p.area * glm::dot(p.radiosity - q.radiosity, p.radiosity - q.radiosity);
    norm += p.area * glm::dot(q.radiosity, q.radiosity);
  }
  return std::sqrt(square / norm);
}

}  // namespace

TEST_CASE("furnace with many things: B = 1 on every leaf, whatever stands in the way") {
  const radiosity::Solution solution = solved(scenes::many(301, scenes::Things::boxes, 0.7), clustered(0.1));
  REQUIRE(solution.audit.cluster_links > 0);
  REQUIRE(solution.audit.closure);
  INFO("closure " << *solution.audit.closure << " rows " << solution.audit.computed_row_sum.min << " ... "
                  << solution.audit.computed_row_sum.max);
  CHECK(solution.audit.computed_row_sum.mean == Approx(1.0).epsilon(0.05));
  CHECK(solution.audit.energy_balance < 1e-6);
  for (std::size_t i = 0; i < solution.hierarchy.size(); ++i) {
    if (!solution.hierarchy[i].leaf() || !(solution.row_sum[i] > 0.0)) { continue; }
    REQUIRE(solution.radiosity[i].x == Approx(1.0).epsilon(1e-6));
  }
}

TEST_CASE("with clusters the result converges to the one without", "[accuracy]") {
  const radiosity::Scene scene = scenes::many(61, scenes::Things::boxes);
  double before = 1.0;
  for (const double epsilon : {0.4, 0.1, 0.025}) {
    const radiosity::Solution with = solved(scene, clustered(epsilon));
    const radiosity::Solution without = solved(scene, clustered(epsilon, never));
    CHECK(without.audit.clusters == 0);
    CHECK(with.audit.clusters > 0);
    const double off = difference(with, without);
    INFO("epsilon " << epsilon << ": " << with.audit.cluster_links << " links of clusters, difference " << off);
    CHECK(off < 0.7 * before);
    before = off;
  }
  CHECK(before < 0.01);
}

TEST_CASE("BF-refinement with clusters: the result becomes that without as the target falls, and the audit agrees", "[accuracy]") {
  // The estimate is of the L2 error of the leaves, and the mean of a surface errs by less than its leaves do.
  radiosity::Scene few = scenes::many(13, scenes::Things::boxes);
  few.objects.pop_back();
  few.objects.push_back(scenes::object("low", scenes::box({0.1, 0.1, 0}, {0.3, 0.3, 0.2}), 1));
  few.objects.push_back(scenes::object("tall", scenes::box({0.7, 0.65, 0}, {0.9, 0.85, 0.4}), 1));
  for (const auto& [scene, finest] : {std::pair{scenes::many(201, scenes::Things::boxes), 0.03}, std::pair{few, 0.01}}) {
    const radiosity::Solution reference = solved(scene, by_light(finest, never));
    double before = 1.0;
    for (const double target : {4.0 * finest, 2.0 * finest, finest}) {
      const radiosity::Solution with = solved(scene, by_light(target, 2));
      const double off = difference(with, reference);
      INFO("target " << target << ": " << with.audit.links << " links, " << with.audit.cluster_links << " of clusters, off " << off);
      CHECK(with.audit.cluster_links > 0);
      CHECK(*with.audit.estimated_error <= target);
      CHECK(off < target);
      CHECK(off < before);
      before = off;
    }
  }
  Options options = by_light(0.02, never);
  options.audit_points = 1000;
  const radiosity::Solution without = solved(few, options);
  options.cluster_from = 2;
  const radiosity::Solution with = solved(few, options);
  REQUIRE(without.audit.leaf_error);
  REQUIRE(with.audit.leaf_error);
  const double noise = with.audit.leaf_error->standard_error + without.audit.leaf_error->standard_error;
  INFO(with.audit.leaf_error->relative_l2 << " with, " << without.audit.leaf_error->relative_l2 << " without, +- " << noise);
  CHECK(with.audit.leaf_error->relative_l2 <= 1.2 * without.audit.leaf_error->relative_l2 + 2.0 * noise);
}

TEST_CASE("BF-refinement: what the segments of a coarse link miss is found again", "[accuracy]") {
  // Between the floor and the lamp stand nine boxes, and a third of the light passes: parts of which all 16 segments are blocked are many.
  // If they are given up the floor loses 3.5 %.
  const radiosity::Scene scene = scenes::many(61, scenes::Things::boxes);
  const auto floor = [&](const Options& options) {
    const radiosity::Solution solution = solved(scene, options);
    for (const radiosity::SurfaceMean& mean : solution.audit.surfaces) {
      if (mean.name == "room.z0") { return mean.radiosity.x; }
    }
    return 0.0;
  };
  Options fine = clustered(0.02, never);
  fine.min_area = 1e-4;
  const double truth = floor(fine);
  CHECK(floor(by_light(0.02, never)) == Approx(truth).epsilon(0.015));
  CHECK(floor(by_light(0.02, 2)) == Approx(truth).epsilon(0.015));
}

TEST_CASE("clusters: the same bits for any number of threads, and energy is conserved") {
  const radiosity::Scene scene = scenes::many(601, scenes::Things::polygons);
  Options options = clustered(0.05);
  const radiosity::Solution one = solved(scene, options);
  options.threads = 3;
  const radiosity::Solution three = solved(scene, options);
  REQUIRE(one.audit.links == three.audit.links);
  CHECK(one.audit.links > (1 << 14));  // so the links go in rounds
  CHECK(one.radiosity == three.radiosity);
  CHECK(one.audit.energy_balance < 1e-6);

  options = by_light(0.1, 2);
  const radiosity::Solution bf_one = solved(scene, options);
  options.threads = 3;
  const radiosity::Solution bf_three = solved(scene, options);
  CHECK(bf_one.audit.links > (1 << 14));
  CHECK(bf_one.audit.cluster_links == bf_three.audit.cluster_links);
  CHECK(bf_one.radiosity == bf_three.radiosity);
}

TEST_CASE("where clusters do not pay, none are built and the report says so") {
  const radiosity::Solution solution = solved(scenes::room_with_box(), clustered(0.1, Options{}.cluster_from));
  CHECK(solution.audit.clusters == 0);
  CHECK(std::any_of(solution.audit.left_out.begin(), solution.audit.left_out.end(),
                    [](const radiosity::LeftOut& out) { return out.what == "clusters above the input faces"; }));
}

TEST_CASE("a scene that would need too many links is refused with their number, before any is made") {
  Options options = clustered(0.1, never);
  const radiosity::Outcome outcome = radiosity::solve(scenes::many(14'507, scenes::Things::polygons), options);
  REQUIRE(!outcome.solution);
  const std::string& sentence = outcome.failure.sentences.front();
  INFO(sentence);
  const std::size_t at = sentence.find("at least ");
  REQUIRE(at != std::string::npos);
  CHECK(std::stoul(sentence.substr(at + 9)) >= 105);  // million pairs of 14 507 faces; polygons that stick in others have parts
}
