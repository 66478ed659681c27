// SPDX-License-Identifier: MIT

// What a pair inherits about its occluders changes no answer: not that of a segment, not that of a whole pair.

#include <vector>

#include "catch.hpp"
#include "generations.hpp"
#include "radiosity/scenes.hpp"

#include <raycast/bundle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/surface.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/scene/scene.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/prepare.hpp>

using radiosity::Decision;
using radiosity::OccluderLists;

namespace {

struct Refined {
  radiosity::Scene scene;
  radiosity::Prepared prepared;
  radiosity::Hierarchy hierarchy;
  radiosity::RefineResult result;
};

Refined refined(radiosity::Scene scene, double epsilon) {
  Refined r{std::move(scene), {{}, raycast::Scene{{}}, {}, {}}, {}, {}};
  radiosity::DiscreteScene discrete{r.scene, 2, 1};
  discrete.take(std::move(*radiosity::prepare(r.scene).prepared));
  discrete.hierarchy = radiosity::make_roots(discrete.surfaces);
  r.result = radiosity::refine(discrete, {epsilon, 1e-4, 1.0});
  r.hierarchy = std::move(discrete.hierarchy);
  r.prepared = {discrete.frame, std::move(discrete.objects), std::move(discrete.surfaces), std::move(discrete.plan)};
  return r;
}

std::uint32_t ancestor(const radiosity::Hierarchy& nodes, std::uint32_t i, std::uint64_t levels) {
  for (; levels > 0 && nodes[i].parent != radiosity::no_node; --levels) { i = nodes[i].parent; }
  return i;
}

}  // namespace

TEST_CASE("segments of a pair are occluded as its list says, from whichever ancestors the list was filtered") {
  const std::uint64_t seed = 20261121;
  CAPTURE(seed);
  for (const radiosity::Scene& scene : {scenes::room_with_box(), scenes::furnace_with_things(0.5)}) {
    const Refined r = refined(scene, 0.02);
    const radiosity::Hierarchy& nodes = r.hierarchy;
    radiosity::Patches patches{r.prepared.surfaces, nodes};
    patches.extend(1);
    const radiosity::SceneView view{r.prepared.objects, r.prepared.plan, r.prepared.surfaces, nodes, patches};
    radiosity::Random random{seed, 1};
    std::uint64_t clear = 0, listed = 0;
    for (int round = 0; round < 4000; ++round) {
      // A chain of pairs from some ancestors down to two leaves.
      const auto leaf = [&] {
        for (;;) {
          const auto i = static_cast<std::uint32_t>(random.bits() % nodes.size());
          if (nodes[i].leaf()) { return i; }
        }
      };
      const std::uint32_t p = leaf(), q = leaf();
      if (radiosity::face_away(nodes[p], nodes[q])) { continue; }
      OccluderLists lists;
      std::uint32_t index = OccluderLists::none;
      raycast::OccluderList list;
      for (std::uint64_t up = random.bits() % 6 + 1; up-- > 0 && !list.blocked();) {
        list = lists.of(ancestor(nodes, p, up), ancestor(nodes, q, up), index, view);
        if (!list.blocked()) { index = lists.keep(list, index); }
      }
      if (!list.blocked()) { list = lists[index]; }
      raycast::Segments16 segments;
      for (std::uint32_t i = 0; i < 16; ++i) {
        const glm::dvec3 x = radiosity::sample(patches[p], random.uniform(), random.uniform());
        const glm::dvec3 y = radiosity::sample(patches[q], random.uniform(), random.uniform());
        segments.set(i, {x, y - x}, nodes[p].object, nodes[q].object);
      }
      std::uint32_t hint = raycast::no_shape;
      REQUIRE(r.prepared.objects.occluded16(segments, list, hint) == r.prepared.objects.occluded16(segments));
      clear += list.clear() ? 1 : 0;
      listed += list.known() && !list.clear() && !list.blocked() ? 1 : 0;
    }
    CHECK(clear > 100);
    CHECK(listed > 100);
  }
}

TEST_CASE("two plates with a larger box between them are proven hidden from each other at once") {
  radiosity::Scene scene = scenes::two_plates(0.5);
  scene.objects.push_back(scenes::object("box", scenes::box({-0.5, -0.5, 0.45}, {1.5, 1.5, 0.55}), 1));
  const Refined r = refined(std::move(scene), 0.02);
  CHECK(r.result.pairs_hidden == 1);
  CHECK(r.result.rays.cast == 0);
  for (const radiosity::NodePair& link : r.result.linked) { CHECK((r.hierarchy[link.p].object == 2 || r.hierarchy[link.q].object == 2)); }
}
