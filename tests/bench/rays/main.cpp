// SPDX-License-Identifier: MIT
// Rays per second beside Debian's Embree 3, in the three scenes of sets.hpp. All engines see the same rays in turn, five rounds, CPU time
// of one thread, medians; filling the packets is part of the time. `differ` counts the rays on which an engine disagrees with the single
// rays of halflight. For Embree those are rays that graze within its single precision.

#include "sets.hpp"

#ifdef HALFLIGHT_EMBREE
#include "embree.hpp"
#endif

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>

#include <raycast/bundle.hpp>
#include <raycast/compiled.hpp>
#include <raycast/scene.hpp>
#include <raycast/shaft.hpp>

namespace {

using namespace bench;

double cpu_now() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Engine {
  std::string name;
  bool peer;
  double build;                                                     // seconds
  std::function<bool(const Set&, std::vector<std::uint8_t>&)> run;  // false: does not do this set
};

void single(const raycast::Scene& scene, const Set& set, std::vector<std::uint8_t>& verdicts) {
  verdicts.resize(set.rays.size());
  for (std::size_t i = 0; i < set.rays.size(); ++i) {
    const Ray& ray = set.rays[i];
    verdicts[i] = set.closest ? scene.closest(ray.segment, ray.source).has_value() : scene.occluded(ray.segment, ray.source, ray.target);
  }
}

raycast::Segments16 sixteen(const Set& set, std::size_t at) {
  raycast::Segments16 segments;
  for (unsigned i = 0; i < 16; ++i) { segments.set(i, set.rays[at + i].segment, set.rays[at + i].source, set.rays[at + i].target); }
  return segments;
}
void spread(std::uint32_t mask, std::uint8_t* out) {
  for (unsigned i = 0; i < 16; ++i) { out[i] = mask >> i & 1u; }
}

// Sixteen at a time, without knowledge of where they come from.
void bundles(const raycast::Scene& scene, const Set& set, std::vector<std::uint8_t>& verdicts) {
  verdicts.resize(set.rays.size());
  std::uint32_t hint = raycast::no_shape;
  for (std::size_t at = 0; at < set.rays.size(); at += 16) {
    const raycast::Segments16 segments = sixteen(set, at);
    spread(set.closest ? scene.closest16(segments).met : scene.occluded16(segments, hint), &verdicts[at]);
  }
}

raycast::PatchShape shape(const Patch& p) { return {p.contour, p.owner, p.bulge}; }

struct Count {
  std::size_t clear = 0, blocked = 0, unknown = 0, pairs = 0, listed = 0, shapes = 0, unknown_parents = 0;
};
// Between patches: the list of occluders of every pair, from that of its parent where there is one.
bool lists(const raycast::Scene& scene, const Set& set, std::vector<std::uint8_t>& verdicts, Count& count) {
  if (set.closest || set.pairs.empty()) { return false; }
  verdicts.resize(set.rays.size());
  count = {};
  std::uint32_t hint = raycast::no_shape;
  raycast::OccluderList parent;
  for (std::size_t at = 0; at < set.rays.size(); at += 16) {
    const std::size_t k = at / 16;
    if (!set.parents.empty() && k % 16 == 0) {
      parent = scene.occluders(shape(set.parents[k / 16].first), shape(set.parents[k / 16].second)),
      count.unknown_parents += !parent.known();
    }
    const auto& [p, q] = set.pairs[k];
    const raycast::OccluderList list = set.parents.empty() ? scene.occluders(shape(p), shape(q)) : scene.filter(parent, shape(p), shape(q));
    ++count.pairs;
    count.clear += list.clear();
    count.blocked += list.blocked();
    count.unknown += !list.known();
    count.listed += list.known() && !list.clear() && !list.blocked();
    count.shapes += list.shapes().size();
    if (list.clear() || list.blocked()) {
      spread(list.blocked() ? 0xffffu : 0u, &verdicts[at]);
    } else {
      spread(scene.occluded16(sixteen(set, at), list, hint), &verdicts[at]);
    }
  }
  return true;
}

// With `only`, other engines than the one of this name are left out.
void compare(const World& world, const std::string& only, const std::string& only_set) {
  std::printf("\n%s\n", world.name.c_str());
  std::vector<double> builds;
  for (int k = 0; k < 5; ++k) {
    auto copy = world.objects;
    const double start = cpu_now();
    const raycast::Scene scene(std::move(copy));
    builds.push_back(cpu_now() - start);
  }
  std::sort(builds.begin(), builds.end());
  const raycast::Scene scene(world.objects);
  std::vector<Engine> engines;
  engines.push_back({"halflight single", false, builds[2], [&](const Set& s, auto& v) { return single(scene, s, v), true; }});
  engines.push_back({"halflight 16", false, builds[2], [&](const Set& s, auto& v) { return bundles(scene, s, v), true; }});
  Count count;
  engines.push_back({"halflight 16, occluder lists", false, builds[2], [&](const Set& s, auto& v) { return lists(scene, s, v, count); }});
#ifdef HALFLIGHT_EMBREE
  const Embree built_in(world, false), user(world, true);
  for (const int width : {1, 8, 16}) {
    engines.push_back({"embree " + std::to_string(width), true, built_in.build_seconds(),
                       [&, width](const Set& s, auto& v) { return built_in.run(s, width, v), true; }});
    if (!world.balls.empty()) {
      engines.push_back({"embree user geometry " + std::to_string(width), true, user.build_seconds(),
                         [&, width](const Set& s, auto& v) { return user.run(s, width, v), true; }});
    }
  }
#endif
  if (!only.empty()) {
    std::erase_if(engines, [&](const Engine& e) { return e.name != only; });
  }
  double peer_build = 1e9;
  for (const Engine& e : engines) {
    if (e.peer) { peer_build = std::min(peer_build, e.build); }
  }
  std::printf("  build ms: halflight %.3f, best peer %.3f, ratio of times %.2f\n", 1e3 * builds[2], 1e3 * peer_build,
              builds[2] / peer_build);
  for (const Set& set : world.sets) {
    if (!only_set.empty() && set.name != only_set) { continue; }
    const std::size_t n = engines.size();
    std::vector<std::vector<double>> times(n);
    std::vector<std::vector<std::uint8_t>> verdicts(n);
    for (int round = 0; round < (only.empty() ? 6 : 60); ++round)  // the first warms up
      for (std::size_t e = 0; e < n; ++e) {
        const double start = cpu_now();
        if (!engines[e].run(set, verdicts[e])) { continue; }
        if (round > 0) { times[e].push_back(cpu_now() - start); }
      }
    double best_peer = 0.0;
    const auto rate = [&](std::size_t e) {
      std::sort(times[e].begin(), times[e].end());
      return times[e].empty() ? 0.0 : 1e-6 * static_cast<double>(set.rays.size()) / times[e][times[e].size() / 2];
    };
    for (std::size_t e = 0; e < n; ++e) {
      if (engines[e].peer) { best_peer = std::max(best_peer, rate(e)); }
    }
    const auto blocked = std::count(verdicts[0].begin(), verdicts[0].end(), 1);
    std::printf("  %s (%.0f %% %s)\n", set.name.c_str(), 100.0 * static_cast<double>(blocked) / static_cast<double>(set.rays.size()),
                set.closest ? "met" : "occluded");
    for (std::size_t e = 0; e < n; ++e) {
      if (times[e].empty()) { continue; }
      std::size_t differ = 0;
      for (std::size_t i = 0; i < verdicts[0].size(); ++i) { differ += verdicts[e][i] != verdicts[0][i]; }
      std::printf("    %-28s %8.2f Mrays/s", engines[e].name.c_str(), rate(e));
      if (best_peer > 0.0) { std::printf("   %5.2f x best peer", rate(e) / best_peer); }
      std::printf("   %zu differ\n", differ);
    }
    if (!set.closest && !set.pairs.empty()) {
      std::printf("    pairs: %zu, clear %zu, blocked %zu, listed %zu with %.1f shapes, unknown %zu (of parents %zu)\n", count.pairs,
                  count.clear, count.blocked, count.listed,
                  static_cast<double>(count.shapes) / static_cast<double>(std::max<std::size_t>(count.listed, 1)), count.unknown,
                  count.unknown_parents);
    }
  }
}

}  // namespace

// bench_rays [scene [engine [set]]]
int main(int argc, char** argv) {
  const auto argument = [&](int i) { return std::string(argc > i ? argv[i] : ""); };
  const std::string only = argument(1);
  if (only.empty() || only == "cornell") { compare(cornell(), argument(2), argument(3)); }
  if (only.empty() || only == "spheres") { compare(spheres(), argument(2), argument(3)); }
  if (only.empty() || only == "bumpy") { compare(bumpy(), argument(2), argument(3)); }
}
