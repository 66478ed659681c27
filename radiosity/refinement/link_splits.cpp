// SPDX-License-Identifier: MIT
#include <radiosity/refinement/link_splits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <brep/inline.hpp>

#include <raycast/shaft.hpp>

#include <radiosity/exchange/doubt.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/hierarchy/meshing.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/oracle/f_oracle.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/refinement/coarse_light.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/f_refine.hpp>
#include <radiosity/refinement/link_fitting.hpp>
#include <radiosity/support/memory.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

namespace detail {

// One call of split_links_by_light().
class LinkSplitting {
 public:
  LinkSplitting(DiscreteScene& scene, const EvaluatedLinks& of, const LinkSplitRule& rule)
      : scene_{scene},
        hierarchy_{scene.hierarchy},
        area_{scene.exposure.area},
        of_{of},
        epsilon_{rule.epsilon},
        share_{0.35 * rule.light_epsilon},
        least_area_{0.25 * rule.min_area * lit_area(scene)} {}

  [[nodiscard]] LinkSplits operator()() {
    constexpr int generations = 4;
    constexpr std::size_t few = 256;  // if fewer than one link in so many is chosen, splitting gains less than examining all links costs
    LinkSplits result;
    for (int k = 0; k < generations && !scene_.control.cancelled(); ++k) {
      stuck_.resize(hierarchy_.size(), false);
      const std::vector<Choice> chosen = choose();
      if (chosen.size() * few < of_.links.size() || chosen.empty() || !fits(chosen, result)) { break; }
      if (scene_.control.decided) { tell(chosen); }
      split_leaves(chosen);
      const std::uint64_t replaced = replace(chosen);
      if (replaced == 0) { break; }
      result.count += replaced;
    }
    return result;
  }

 private:
  // A link to be split at one of its ends.
  struct Choice {
    std::size_t link = 0;
    bool at_p = true;
  };
  struct Wish {
    Choice choice;
    double error = 0.0;  // squared error of the patch
  };
  // One end of a link, and the RMS error that the link causes there, in the unit of radiosity.
  struct End {
    std::uint32_t node = no_node;
    bool at_p = true;
    std::size_t link = 0;
    double error = 0.0;
  };

  [[nodiscard]] std::uint32_t split(const Choice& c) const { return c.at_p ? of_.links[c.link].p : of_.links[c.link].q; }
  [[nodiscard]] std::uint32_t other(const Choice& c) const { return c.at_p ? of_.links[c.link].q : of_.links[c.link].p; }

  // False also for lamps with clusters: links of lamp clusters are not made for parts of lamps.
  [[nodiscard]] bool may_split(std::uint32_t i) const {
    const Node& node = hierarchy_[i];
    if (node.is_cluster() || !(area_[i] > 0.0)) { return false; }
    if (!node.leaf()) { return true; }
    return node.area > least_area_ && !stuck_[i] && !scene_.exposure.partly_buried[i] && !at_blade(scene_, i) &&
           !(scene_.lamp_exchange && scene_.lamps[node.surface]);
  }

  // The ends of links at patches with too large an error, sorted by patch.
  [[nodiscard]] std::vector<End> find_ends(const CoarseLight& light, double least) const {
    const auto error = [&](std::uint32_t on, std::uint32_t from, float doubt) {
      return light.reflectance[hierarchy_[on].surface] * light.radiosity[from] * static_cast<double>(doubt);
    };
    std::vector<double> sum(hierarchy_.size(), 0.0);
    const auto each_end = [&](const auto& visit) {
      for (std::size_t k = 0; k < of_.links.size(); ++k) {
        const Link& link = of_.links[k];
        if (!scene_.evaluator.between_patches(link)) { continue; }
        if (of_.doubts[k].p > 0.0f) { visit(End{link.p, true, k, error(link.p, link.q, of_.doubts[k].p)}); }
        if (of_.doubts[k].q > 0.0f) { visit(End{link.q, false, k, error(link.q, link.p, of_.doubts[k].q)}); }
      }
    };
    each_end([&](const End& end) { sum[end.node] += end.error; });
    std::vector<char> uneven(hierarchy_.size(), 0);
    for (std::uint32_t i = 0; i < hierarchy_.size(); ++i) { uneven[i] = area_[i] * sum[i] * sum[i] > least && may_split(i) ? 1 : 0; }
    std::vector<End> ends;
    each_end([&](const End& end) {
      if (uneven[end.node] != 0 && end.error > 0.0) { ends.push_back(end); }
    });
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
      return a.node != b.node ? a.node < b.node : a.error != b.error ? a.error > b.error : a.link < b.link;
    });
    return ends;
  }

  // The links to be split, in order; if both ends are wanted, the end with the larger error.
  [[nodiscard]] std::vector<Choice> choose() const {
    const CoarseLight light = coarse_light(scene_, of_.links, 3);
    std::vector<Wish> wishes = find_wishes(share_ * share_ * light.reflected_square, light);
    std::sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) {
      if (a.choice.link != b.choice.link) { return a.choice.link < b.choice.link; }
      return a.error != b.error ? a.error > b.error : a.choice.at_p && !b.choice.at_p;
    });
    std::vector<Choice> chosen;
    for (const Wish& wish : wishes) {
      if (chosen.empty() || chosen.back().link != wish.choice.link) { chosen.push_back(wish.choice); }
    }
    return chosen;
  }

  // For each patch whose squared error exceeds `least`: its largest links, until the others amount to a quarter of that limit. By
  // measurement, a smaller share takes three times the links for a third less error, and a larger one forgoes half of the gain.
  [[nodiscard]] std::vector<Wish> find_wishes(double least, const CoarseLight& light) const {
    constexpr double kept = 0.25;
    const std::vector<End> ends = find_ends(light, least);
    std::vector<Wish> wishes;
    for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
      double left = 0.0;
      for (last = first; last < ends.size() && ends[last].node == ends[first].node; ++last) { left += ends[last].error; }
      const double node_area = area_[ends[first].node];
      const double error = node_area * left * left;
      for (std::size_t k = first; k < last && node_area * left * left > kept * least; ++k) {
        wishes.push_back({{ends[k].link, ends[k].at_p}, error});
        left -= ends[k].error;
      }
    }
    return wishes;
  }

  // Are so many nodes and links within the limits?
  [[nodiscard]] bool fits(const std::vector<Choice>& chosen, LinkSplits& result) const {
    std::uint64_t nodes = hierarchy_.size(), opened = 0;
    std::vector<char> asked(hierarchy_.size(), 0);
    for (const Choice& c : chosen) {
      const Node& node = hierarchy_[split(c)];
      opened += node.leaf() ? node.corners : node.child_count;
      if (node.leaf() && !asked[split(c)]) { nodes += node.corners; }
      asked[split(c)] = 1;
    }
    const std::uint64_t links = of_.links.size() + opened;
    if (links > link_limit) { return false; }
    const MemoryBudget::Counts needed{nodes, links, opened, of_.refined.occluders.bytes() + links * sizeof(LinkDoubt)};
    if (!scene_.budget.allows(needed)) { result.too_large = scene_.budget.peak(needed); }
    return result.too_large == 0;
  }

  void tell(const std::vector<Choice>& chosen) const {
    for (const Choice& c : chosen) {
      const Link& link = of_.links[c.link];
      scene_.control.decided({hierarchy_, link.p, link.q, scene_.shown, epsilon_, least_area_, &stuck_},
                             c.at_p ? Decision::split_p : Decision::split_q);
    }
  }

  // Splits the leaves at which links are split. Their other links with leaves get gradients.
  void split_leaves(const std::vector<Choice>& chosen) {
    const std::size_t before = hierarchy_.size();
    std::vector<char> leaf(before), cut(before, 0);
    for (std::size_t i = 0; i < before; ++i) { leaf[i] = hierarchy_[i].leaf() ? 1 : 0; }
    for (const Choice& c : chosen) { cut[split(c)] = leaf[split(c)]; }
    bool any = false;
    for (std::uint32_t i = 0; i < before; ++i) {
      if (cut[i] == 0) { continue; }
      stuck_[i] = !subdivide(scene_.surfaces, hierarchy_, i, scene_.meshing);
      cut[i] = stuck_[i] ? 0 : 1;
      any = any || !stuck_[i];
    }
    if (!any) { return; }
    const std::vector<double> area_before = area_;
    scene_.expose();
    set_gradients_at(scene_, of_.links, cut, leaf, [&](std::size_t k, const Doubt& left) {
      const Link& link = of_.links[k];
      LinkDoubt& doubt = of_.doubts[k];
      of_.evaluated.doubt.remove(link.p, link.q, {doubt.p, doubt.q});
      doubt.p = std::hypot(doubt.p, left.p);
      doubt.q = std::hypot(doubt.q, left.q);
      of_.evaluated.doubt.add(link.p, link.q, {doubt.p, doubt.q});
    });
    fit_links(scene_, of_.links, area_before);
    if (scene_.control.after_generation) { scene_.control.after_generation(scene_.surfaces); }
  }

  // The pairs of the children with the other end of each link.
  [[nodiscard]] NodePairs open(const std::vector<Choice>& chosen) const {
    NodePairs pairs(scene_.budget.arrays);
    for (const Choice& c : chosen) {
      const Node& node = hierarchy_[split(c)];
      for (std::uint32_t child = node.first_child; child < node.first_child + node.child_count; ++child) {
        pairs.push_back({child, other(c), of_.doubts[c.link].list});
      }
    }
    return pairs;
  }

  // Replaces the links by links of the children. Returns the number of replaced links; 0 after cancellation.
  [[nodiscard]] std::uint64_t replace(const std::vector<Choice>& chosen) {
    NodePairs pairs = open(chosen);
    const std::vector<Decision> decisions = decide(
        scene_, pairs, of_.refined,
        [&](std::uint32_t p, std::uint32_t q) { return face_away(hierarchy_[p], hierarchy_[q]) ? Decision::drop : Decision::link; },
        [](std::size_t, const raycast::OccluderList&, Decision&) {});
    std::size_t seeing = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (scene_.control.decided) {
        scene_.control.decided({hierarchy_, pairs[i].p, pairs[i].q, scene_.shown, epsilon_, least_area_, &stuck_}, decisions[i]);
      }
      if (decisions[i] >= first_seeing) { pairs[seeing++] = pairs[i]; }
    }
    pairs.resize(seeing);
    Control quiet = scene_.control;  // the stage has already reported its links as complete
    quiet.progress = nullptr;
    Links made(scene_.budget.arrays);
    LinkDoubts doubts(scene_.budget.arrays);
    EvaluateResult evaluated = make_links({scene_.evaluator, of_.refined.occluders, scene_.threads, quiet}, pairs, made, &doubts);
    if (evaluated.cancelled) { return 0; }
    const std::uint64_t removed = remove(chosen);
    of_.links.insert(of_.links.end(), made.begin(), made.end());
    of_.doubts.insert(of_.doubts.end(), doubts.begin(), doubts.end());
    of_.evaluated.add(evaluated);
    return removed;
  }

  std::uint64_t remove(const std::vector<Choice>& chosen) {
    std::vector<char> gone(of_.links.size(), 0);
    std::uint64_t count = 0;
    for (const Choice& c : chosen) {
      if (hierarchy_[split(c)].leaf()) { continue; }
      const Link& link = of_.links[c.link];
      gone[c.link] = 1;
      of_.evaluated.doubt.remove(link.p, link.q, of_.doubts[c.link].of(link, hierarchy_));
      ++count;
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < of_.links.size(); ++k) {
      if (gone[k] != 0) { continue; }
      of_.links[kept] = of_.links[k];
      of_.doubts[kept++] = of_.doubts[k];
    }
    of_.links.resize(kept);
    of_.doubts.resize(kept);
    return count;
  }

  DiscreteScene& scene_;
  Hierarchy& hierarchy_;
  const std::vector<double>& area_;
  const EvaluatedLinks& of_;
  double epsilon_ = 0.0;
  double share_ = 0.0;
  double least_area_ = 0.0;
  std::vector<bool> stuck_;  // leaves that the BRep refused to split
};

}  // namespace detail

HALFLIGHT_INLINE LinkSplits split_links_by_light(DiscreteScene& scene, const EvaluatedLinks& of, const LinkSplitRule& rule) {
  return detail::LinkSplitting{scene, of, rule}();
}

}  // namespace radiosity
