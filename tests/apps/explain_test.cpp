// SPDX-License-Identifier: MIT
// What `halflight explain` records is what the solver does: watching changes nothing, and every number on the page follows from the
// solution.
#include "catch.hpp"

#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>

#include <raycast/objects/polygon.hpp>

#include <radiosity/radiosity.hpp>

#include "apps/explain/recording.hpp"
#include "browser.hpp"
#include "example_scenes.hpp"
#include "program.hpp"
#include "seed.hpp"

namespace {

using apps::explain::Recording;
using radiosity::Decision;

Recording recorded(const radiosity::Scene& scene, const apps::explain::Wanted& wanted = {}) {
  apps::explain::RecordResult result = apps::explain::record(scene, "scene", wanted);
  INFO((result.sentences.empty() ? "" : result.sentences.front()));
  REQUIRE(result.recording);
  return std::move(*result.recording);
}

// A lamp above and four rectangles that lie about at random, of which some stand in the way of others.
radiosity::Scene random_plates(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  radiosity::Scene scene;
  scene.materials = {{"lamp", {0.2, 0.2, 0.2}, {5.0, 5.0, 5.0}}, {"wall", {0.6, 0.6, 0.6}, {0.0, 0.0, 0.0}}};
  const auto plate = [&](double z, double size, bool up) {
    const double x = 2.0 * unit(random), y = 2.0 * unit(random), a = size * (0.5 + unit(random)), b = size * (0.5 + unit(random));
    std::vector<glm::dvec3> corners = {{x, y, z}, {x + a, y, z}, {x + a, y + b, z}, {x, y + b, z}};
    return raycast::Polygon::make(up ? corners : std::vector<glm::dvec3>{corners.rbegin(), corners.rend()}).object;
  };
  scene.objects.push_back({"lamp", plate(2.0, 0.8, false), {}, {0}});
  for (int i = 0; i < 4; ++i) { scene.objects.push_back({"plate" + std::to_string(i), plate(0.4 * i, 1.5, i % 2 == 0), {}, {1}}); }
  return scene;
}

}  // namespace

TEST_CASE("explain: watching changes nothing, and the recorded numbers are those of the solution") {
  const unsigned first = test::seed();
  for (unsigned k = 0; k < 7; ++k) {
    const unsigned seed = k < 6 ? first + k : 1843135162u;  // a generation in which only patches that were split before are to be split
    INFO("seed " << seed);
    const radiosity::Scene scene = random_plates(seed);
    apps::explain::Wanted wanted;
    wanted.epsilon = 0.1;
    const Recording r = recorded(scene, wanted);

    radiosity::Options options;
    options.epsilon = options.light_epsilon.emplace(wanted.epsilon);
    options.min_area = wanted.min_area;
    options.indirect = radiosity::Indirect::links;
    options.audit_points = 0;
    const radiosity::Outcome outcome = radiosity::solve(scene, options);
    REQUIRE(outcome.solution);
    REQUIRE(outcome.solution->links.size() == r.links.size());
    for (std::size_t i = 0; i < r.nodes.size(); ++i) { REQUIRE(outcome.solution->radiosity[i].y == r.radiosity[i]); }

    // Every question but those about input faces comes out of one that was split, and every link was decided.
    std::size_t links = 0;
    for (const apps::explain::Pair& pair : r.pairs) {
      const bool roots = r.nodes[pair.p].parent == radiosity::no_node && r.nodes[pair.q].parent == radiosity::no_node;
      REQUIRE(pair.parent.has_value() != roots);
      if (!roots) {
        const apps::explain::Pair& above = r.pairs[*pair.parent];
        CHECK(above.generation + 1 == pair.generation);
        CHECK((above.decision == Decision::split_p || above.decision == Decision::split_q));
      }
      links += pair.decision == Decision::link ? 1 : 0;
      if (pair.decision >= Decision::link && pair.estimate <= wanted.epsilon) { CHECK(pair.by_form_factor == Decision::link); }
    }
    CHECK(links == r.links.size() + r.too_faint);

    // The rays that are drawn are those that were cast. A link holds its exchange as a float: half a unit in the last place is 2^-24.
    for (const apps::explain::LinkRecord& link : r.links) {
      CHECK(link.exchange == test::Approx(link.unoccluded * link.visibility).epsilon(1e-7));
      bool stopped = false;
      for (const apps::explain::Ray& ray : link.rays) { stopped = stopped || !ray.arrives; }
      CHECK(stopped == (link.visibility < 1.0));
      CHECK_FALSE((link.proven && stopped));
    }

    // Jacobi's error falls by at least the greatest row sum times rho each time; it ended at 1e-4 or after twelve.
    const apps::explain::Iteration& last = r.iterations.back();
    for (std::size_t i = 0; i < r.nodes.size(); ++i) { CHECK(last.sent[i] == test::Approx(r.radiosity[i]).margin(0.01)); }
  }
}

// F = cos cos A / (pi r^2 + A) of the numbers in a sentence; below 0 when it has none. The area is that of the named disk, else the larger.
double told_estimate(const Recording& r, const apps::explain::Pair& pair) {
  const std::string& told = pair.sentence;
  const auto after = [&](const std::string& word, std::size_t from = 0) {
    const std::size_t at = told.find(word, from);
    return at == std::string::npos ? -1.0 : std::stod(told.substr(at + word.size()));
  };
  const double a = after(" ("), b = after(" and ", told.find(" ("));
  double area = std::max(a, b);
  for (const auto& [node, own] : {std::pair{pair.p, a}, std::pair{pair.q, b}}) {
    if (told.find("disk of " + r.names[node] + ",") != std::string::npos) { area = own; }
  }
  const double product = after("multiply to ") >= 0.0 ? after("multiply to ") : after("cosines ") * after(" and ", told.find("cosines "));
  const double distance = told.find("centres ") != std::string::npos ? after("centres ") : after(" m2, ");
  return told.starts_with("disk estimate") ? product * area / (3.14159265 * distance * distance + area) : -1.0;
}

TEST_CASE("explain: the estimate of a sentence follows from the numbers that stand beside it") {
  const unsigned first = test::seed();
  int told = 0;
  for (unsigned k = 0; k < 6; ++k) {
    INFO("seed " << first + k);
    apps::explain::Wanted wanted;
    wanted.epsilon = 0.1;
    const Recording r = recorded(random_plates(first + k), wanted);
    for (const apps::explain::Pair& pair : r.pairs) {
      const double estimate = told_estimate(r, pair);
      if (estimate < 0.0) { continue; }
      INFO(r.names[pair.p] << " - " << r.names[pair.q] << ": " << pair.sentence);
      // Three digits each, .5 % at worst: two cosines, the area, and the distance, which is squared.
      CHECK(estimate == test::Approx(pair.estimate).epsilon(0.025));
      ++told;
    }
  }
  CHECK(told > 0);
}

TEST_CASE("explain: all solvers end at the same radiosities, over-shooting as well") {
  const Recording r = recorded(random_plates(7));
  for (const apps::explain::Comparison* comparison : {&r.as_is, &r.at_99}) {
    CHECK(comparison->methods.size() == 6);
    for (const apps::explain::Method& method : comparison->methods) {
      INFO(method.name);
      CHECK(method.residual.front() <= 1.0 + 1e-9);
      CHECK(method.residual.back() < 0.2);
      CHECK(method.residual.back() < 0.5 * method.residual.front());
    }
  }
}

TEST_CASE("explain refuses what cannot be looked at whole, with the number and what to do") {
  const auto refusal = [](const radiosity::Scene& scene, double epsilon) {
    apps::explain::Wanted wanted;
    wanted.epsilon = epsilon;
    wanted.min_area = 5e-4;
    const apps::explain::RecordResult result = apps::explain::record(scene, "scene", wanted);
    CHECK_FALSE(result.recording);
    return result.sentences.empty() ? std::string() : result.sentences.front();
  };
  CHECK(refusal(example_scene("boxes.scene"), 0.001).find("a larger --epsilon or --min-area asks about fewer") != std::string::npos);
  CHECK(refusal(example_scene("furnace.scene"), 0.05).find("more than 12000 pairs") !=
        std::string::npos);  // beyond it in the last generation
  CHECK(refusal(example_scene("primitives.scene"), 0.1).find("input faces; at most 256") != std::string::npos);
}

TEST_CASE("explain tells the story in the terminal and writes a page of its own") {
  program::Place place;
  const std::string scene = program::scene("three_plates");
  const program::Run run = place.run("explain " + scene + " --epsilon 0.2 --text -o page.html");
  INFO(run.err << run.out);
  CHECK(run.code == 0);
  for (const char* part :
       {"generation 0:\n  lamp - plate: disk estimate F = 0.241 (1 and 1 m2, centres 1 m apart, cosines 1 and 1) > 0.2: split lamp",
        "blocker - back: face away from each other: no link", "rays arrive, visibility 0.", "Gather, push, pull",
        "T-vertices: ", "Refinement by the light that links carry", "over-shooting by 1.8", "written: page.html\n"}) {
    INFO(part);
    CHECK(run.out.find(part) != std::string::npos);
  }
  const std::string page = place.read("page.html");
  CHECK(page.find("</html>") != std::string::npos);
  for (const char* network : {"src=", "href=", "@import", "fetch("}) { CHECK(page.find(network) == std::string::npos); }
  CHECK(place.run("explain " + scene).code == 2);
}

TEST_CASE("explain: every step of the page is drawn in a browser without an error") {
  if (!browser::found()) { SKIP_TEST("there is no chromium"); }
  program::Place place;
  const std::string scene = program::scene("three_plates");
  REQUIRE(place.run("explain " + scene + " --epsilon 0.2 -o page.html").code == 0);
  const std::string dom = browser::elements(place, place.read("page.html"), R"(
    let drawn = 0;
    chapters.forEach((c, i) => { for (let k = 0; k < c.steps; k += 1 + Math.floor(c.steps / 12)) { open(i, k); pick(k % 5); drawn += last.faces.length > 0; } });
    document.documentElement.dataset.drawn = drawn;
    document.documentElement.dataset.coarse = atThreshold(1).links.length;
    // The scene lies within the view and fills nine tenths of it, one way or the other.
    const size = [$('view').clientWidth, $('view').clientHeight], places = bounds.map(camera(...size).to);
    const spans = [0, 1].map(c => (Math.max(...places.map(p => p[c])) - Math.min(...places.map(p => p[c]))) / size[c]);
    const within = places.every(p => [0, 1].every(c => p[c] > 0 && p[c] < size[c]));
    document.documentElement.dataset.fills = within && Math.abs(Math.max(...spans) - 0.9) < 1e-6;
    // A face that is seen from its front hides what lies behind its middle, and nothing else on the way there.
    const {from, to} = camera(...size), along = (f, s) => plus(from, times(minus(centre(f.points), from), s));
    document.documentElement.dataset.hides = view.drawn.length > 9 && view.drawn.every(f => [0.9, 1, 1.1].every(s =>
      behind([f], from, along(f, s), to(along(f, s))) === (s > 1 && f.front && !f.wide)));
    // Over-shooting is said to pay where one of its residuals is below that of shooting.
    const residuals = (s, name) => s.methods.filter(m => m.name.startsWith(name)).map(m => m.residual);
    document.documentElement.dataset.pays = data.solvers.every(s => {
      const shooting = residuals(s, 'Southwell')[0], ahead = (r, k) => k > 0 && r[k] < (shooting[k] ?? shooting.at(-1));
      return overshooting(s.methods).includes('never') !== residuals(s, 'over').some(r => r.some((_, k) => ahead(r, k)));
    });
    const largest = Math.max(...data.iterations.at(-1).sent);  // numbers of the page have four digits
    const light = chapters.find(c => c.name === 'Light');
    document.documentElement.dataset.pulled = data.iterations.slice(1).every((next, n) =>
      next.sent.every((b, i) => Math.abs(b - light.value(3 * n + 2)(i)) <= 1e-3 * largest));
    document.documentElement.dataset.mine = atThreshold(data.epsilon).links.length === data.pairs.filter(p => p.is === 'link').length;
  )",
                                            "1200,800");
  INFO(dom.substr(0, 400));
  CHECK(dom.find("data-ready=\"1\"") != std::string::npos);
  CHECK(dom.find("data-error") == std::string::npos);
  CHECK(dom.find("data-drawn=\"") != std::string::npos);
  CHECK(dom.find("data-coarse=\"3\"") != std::string::npos);  // of six pairs three face each other
  CHECK(dom.find("data-mine=\"true\"") != std::string::npos);
  CHECK(dom.find("data-fills=\"true\"") != std::string::npos);
  CHECK(dom.find("data-hides=\"true\"") != std::string::npos);
  CHECK(dom.find("data-pays=\"true\"") != std::string::npos);
  CHECK(dom.find("data-pulled=\"true\"") != std::string::npos);  // what the page pulls up is what the program sends next
}
