// SPDX-License-Identifier: MIT
#pragma once

// Evaluates links: the form factor by contour, times the fraction of the light that arrives (paper 4.3: done once the oracle has agreed,
// because it is the expensive part).

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include <raycast/shaft.hpp>

#include <radiosity/clusters/cluster_exchange.hpp>
#include <radiosity/clusters/clusters.hpp>
#include <radiosity/clusters/lamp_exchange.hpp>
#include <radiosity/exchange/doubt.hpp>
#include <radiosity/exchange/exchange.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/scene/options.hpp>
#include <radiosity/support/big_array.hpp>
#include <radiosity/support/random.hpp>
#include <radiosity/visibility/exposure.hpp>
#include <radiosity/visibility/occlusion.hpp>
#include <radiosity/visibility/scene_view.hpp>
#include <radiosity/visibility/visibility.hpp>

namespace radiosity {

class LightMeshing;  // discontinuity/light_meshing.hpp

// Some of many pairs, spread evenly over them in their order.
class PairSample {
 public:
  void add(std::uint32_t p, std::uint32_t q) {
    if (count_++ % each_ == 0) { pairs_.push_back({p, q}); }
    if (pairs_.size() < 2 * least) { return; }
    for (std::size_t i = 0; i < least; ++i) { pairs_[i] = pairs_[2 * i]; }
    pairs_.resize(least);
    each_ *= 2;
  }
  void add(const PairSample& other) {
    for (const glm::uvec2& pair : other.pairs_) {
      for (std::uint64_t k = 0; k < other.each_; ++k) { add(pair.x, pair.y); }
    }
  }
  [[nodiscard]] const std::vector<glm::uvec2>& pairs() const { return pairs_; }
  [[nodiscard]] std::uint64_t each() const { return each_; }  // pairs that one stands for

 private:
  static constexpr std::size_t least = 1 << 14;
  std::vector<glm::uvec2> pairs_;
  std::uint64_t count_ = 0, each_ = 1;
};

struct EvaluateResult {
  RayCount rays;
  std::uint64_t proven_clear = 0;  // links for which no segment was cast
  std::uint64_t blocked = 0;       // links left out because nothing arrives
  PairSample unseen;               // of those that are not proven to be blocked; not of measured links
  DoubtSum doubt;                  // of the links left out, and, unless measured links hold theirs, of all
  bool cancelled = false;

  // Adds what was found for further links.
  void add(const EvaluateResult& other);
};

// What is kept of a link that may be split once its light is known: what can stand between its ends, and its share of the doubt
// (doubt.hpp), but for its chord, which follows from the link.
struct LinkDoubt {
  std::uint32_t list = OccluderLists::none;  // of its ends
  float p = 0.0f, q = 0.0f, square = 0.0f;

  [[nodiscard]] Doubt of(const Link& link, const Hierarchy& hierarchy) const;
};

using LinkDoubts = BigArray<LinkDoubt>;

// How far the light of a link is from what the link can express, at each end: RMS values relative to the mean.
struct LinkVariation {
  struct End {
    float linear = 0.0f, rest = 0.0f;  // of the unoccluded light (exchange.hpp)
    float shadow = 0.0f;               // of the visible fraction
  };
  End p, q;
  float cross = 0.0f;     // of the kernel, beyond what varies at each end: which part of one end is lit by which of the other
  float sampling = 0.0f;  // standard error of the exchange of a link of a cluster, and of any of which not all segments arrived
  float blocked = 0.0f;   // segments of the links that it was split from, where none of them arrived
  Doubt doubt;
};

// A link with all that is known of its error.
struct MeasuredLink {
  Link link;
  std::uint32_t list = OccluderLists::none;  // of its ends or of their ancestors
  LinkVariation variation;
};

using MeasuredLinks = BigArray<MeasuredLink>;

[[nodiscard]] inline const Link& link_of(const MeasuredLink& measured) { return measured.link; }

// The shapes of a link between patches, from how the light varies over them.
void set_gradients(Link& link, const Variations& light);

// Segments, in rounds of 16, for each link between patches that is partly blocked. Where a light shines, the light oracle has split until
// the shadow within a patch matters little; what 64 segments add to that is an eighth of it.
inline constexpr std::uint32_t patch_rounds = 4;

// Evaluates links one by one.
class LinkEvaluator {
 public:
  // The references must outlive the evaluator. `shown`: by exposed areas.
  LinkEvaluator(const SceneView& scene, const Exposure& exposure, const ShownAreas& shown, std::uint64_t seed);

  // The same with other random numbers, to measure links once more.
  [[nodiscard]] LinkEvaluator reseeded(std::uint64_t seed) const {
    LinkEvaluator other{*this};
    other.seed_ = seed;
    return other;
  }

  // Where that has measured the share of a lamp's light that arrives, no segment is cast. It must outlive the evaluator.
  void use(const LightMeshing& light) { light_ = &light; }

  // Sets the exchange, 0 when nothing arrives, and the shapes where they have an effect, or in any case when the variation is asked for.
  // Returns its segments. Depends on the ends of the link and the seed alone; `list` saves time.
  RayCount operator()(Link& link, const raycast::OccluderList& list, LinkVariation* variation = nullptr, Doubt* doubt = nullptr) const;

  // Links of its clusters with patches are evaluated by it. It must outlive the evaluator.
  void use(const LampExchange& lamps) { lamps_ = &lamps; }

  [[nodiscard]] bool between_patches(const Link& link) const {
    return !scene_.hierarchy[link.p].is_cluster() && !scene_.hierarchy[link.q].is_cluster();
  }
  // Casts the segments of a link between patches with exposed ends as if nothing were known of what can block them, and adds them to `seen`
  // when that is given.
  [[nodiscard]] VisibilityEstimate segments(const Link& link, std::vector<CastSegment>* seen = nullptr) const {
    return visibility(scene_, {}, end(link.p), end(link.q), patch_rounds, Random{seed_, key_of(link)}, seen);
  }

 private:
  [[nodiscard]] std::optional<VisibilityEstimate> measured_visibility(const Link& link) const;
  RayCount evaluate_lamp_link(Link& link, LinkVariation* variation, Doubt* doubt) const;
  // doubt.hpp. `sent`: what would arrive if nothing stood between. `at_leaves`: leaves may be split while the link stays as it is.
  [[nodiscard]] Doubt doubt_of(const Link& link, double sent, const VisibilityEstimate& seen, const Variations& varies,
                               bool at_leaves) const;
  // The exchange that a link may have although none of these segments arrived, and none of those before (Laplace's mean). `sent`: the
  // exchange if nothing stood between.
  [[nodiscard]] static double missed(double sent, const LinkVariation& before, std::uint64_t segments) {
    return sent / (static_cast<double>(before.blocked) + static_cast<double>(segments) + 2.0);
  }
  // Standard error of the exchange where some segments arrived and some did not.
  [[nodiscard]] static double partly_seen(double sent, const VisibilityEstimate& seen) {
    return seen.fraction < 1.0 ? sent * std::sqrt(visibility_variance(seen.fraction, static_cast<double>(seen.rays.cast))) : 0.0;
  }
  [[nodiscard]] static std::uint64_t key_of(const Link& link) { return (std::uint64_t{link.p} << 32) | link.q; }
  [[nodiscard]] static LinkVariation::End variation_at(const Variation& v, double shadow) {
    return {static_cast<float>(v.linear), static_cast<float>(std::hypot(v.rest, v.limited)), static_cast<float>(shadow)};
  }
  // Everything at an end is lit as if it stood at the centre, and what is seen of the other end varies: most of all where the end is large
  // from there, for the things in between then hide it from some and not from others. Light that reaches a cluster at all reaches few of
  // its faces: over random normals the mean of the squares of cosines above 0 is 8 / 3 of the square of their mean. The lattice of
  // directions adds a seventh. Measured on links of random boxes, polygons and a mesh, errors are .5 to 1.3 times these.
  [[nodiscard]] LinkVariation variation_of_cluster_link(const Link& link, const ClusterExchange& seen, const LinkVariation& before) const;
  // Every face and every link errs for itself: by its place, by what it sees, by the lattice of directions and by sampling.
  [[nodiscard]] double doubt_of_cluster_link(const Link& link, const LinkVariation& variation) const;
  [[nodiscard]] PatchEnd end(std::uint32_t i) const {
    return {&scene_.patches[i], scene_.hierarchy[i].object, exposure_->points(i), scene_.sheet(i)};
  }

  SceneView scene_;
  const Exposure* exposure_;
  ClusterSampler sampler_;
  std::uint64_t seed_;
  const LightMeshing* light_ = nullptr;
  const LampExchange* lamps_ = nullptr;
};

// Fits a cluster link to what its ends show now instead of `before`: exposed areas are known better where faces were split.
void refit_cluster_link(const Hierarchy& hierarchy, Link& link, const ShownAreas& before, const ShownAreas& now);

// What the evaluation of many links needs. The references must outlive it.
struct Evaluation {
  const LinkEvaluator& evaluator;
  const OccluderLists& occluders;  // of the pairs or links
  unsigned threads;
  const Control& control;
};

// Makes the links of these pairs, in their order, except for those that carry nothing. With `doubts`, what is kept of each link.
[[nodiscard]] EvaluateResult make_links(const Evaluation& by, const NodePairs& pairs, Links& links, LinkDoubts* doubts = nullptr);

// Measures the links from `first` on and removes those that carry no light. A link whose samples are all blocked stays if it may still
// carry some (LinkVariation::sampling).
[[nodiscard]] EvaluateResult measure_links(const Evaluation& by, MeasuredLinks& links, std::size_t first);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/links/evaluate.cpp>
#endif
