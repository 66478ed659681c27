// SPDX-License-Identifier: MIT
#pragma once

// Evaluates links: the form factor by contour integral, times the fraction of the light that arrives. This is expensive, so it is done
// only once the oracle has agreed to a link (paper 4.3).

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

// A sample of many pairs, evenly spaced in their order.
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
  [[nodiscard]] std::uint64_t each() const { return each_; }  // number of pairs that each sampled one represents

 private:
  static constexpr std::size_t least = 1 << 14;
  std::vector<glm::uvec2> pairs_;
  std::uint64_t count_ = 0, each_ = 1;
};

struct EvaluateResult {
  RayCount rays;
  std::uint64_t proven_clear = 0;  // links for which no segment was cast
  std::uint64_t blocked = 0;       // links left out because no light arrives
  PairSample unseen;               // sample of the links left out by make_links() because all their segments were blocked, without proof
  DoubtSum doubt;                  // of the links left out; from make_links() also of those kept (measured links store their own)
  bool cancelled = false;

  // Adds what was found for further links.
  void add(const EvaluateResult& other);
};

// What is stored for a link that may be split once its light is known: the list of possible blockers, and the link's errors (doubt.hpp)
// except the one by chords, which can be computed from the link.
struct LinkDoubt {
  std::uint32_t list = OccluderLists::none;  // of the link's ends
  float p = 0.0f, q = 0.0f, square = 0.0f;

  [[nodiscard]] Doubt of(const Link& link, const Hierarchy& hierarchy) const;
};

using LinkDoubts = BigArray<LinkDoubt>;

// The variation that a link cannot express, at each end: RMS values relative to the mean.
struct LinkVariation {
  struct End {
    float linear = 0.0f, rest = 0.0f;  // of the unoccluded light (exchange.hpp)
    float shadow = 0.0f;               // variation of the visible fraction
  };
  End p, q;
  float cross = 0.0f;     // variation of the kernel beyond that at each end: which part of one end lights which part of the other
  float sampling = 0.0f;  // standard error of the exchange, of cluster links and of partly blocked links
  float blocked = 0.0f;   // number of segments cast for its ancestor links, if all of them were blocked
  Doubt doubt;
};

// A link with all that is known about its error.
struct MeasuredLink {
  Link link;
  std::uint32_t list = OccluderLists::none;  // of its ends or of their ancestors
  LinkVariation variation;
};

using MeasuredLinks = BigArray<MeasuredLink>;

[[nodiscard]] inline const Link& link_of(const MeasuredLink& measured) { return measured.link; }

// Sets the gradients of a link between patches from the variation of the light over them.
void set_gradients(Link& link, const Variations& light);

// Rounds of 16 segments for each partly blocked link between patches. Where a lamp shines, the light oracle has split patches until the
// shadow within one matters little; the noise of 64 segments adds an eighth of that.
inline constexpr std::uint32_t patch_rounds = 4;

// Evaluates single links.
class LinkEvaluator {
 public:
  // The references must outlive the evaluator. `shown`: computed from exposed areas.
  LinkEvaluator(const SceneView& scene, const Exposure& exposure, const ShownAreas& shown, std::uint64_t seed);

  // A copy with other random numbers, for measuring links a second time.
  [[nodiscard]] LinkEvaluator reseeded(std::uint64_t seed) const {
    LinkEvaluator other{*this};
    other.seed_ = seed;
    return other;
  }

  // Casts this many rounds of segments for each partly blocked link between patches, or with a cluster of lamps.
  void cast_rounds(std::uint32_t rounds) { rounds_ = rounds; }

  // Casts no segments where `light` has measured which share of a lamp's light arrives. `light` must outlive the evaluator.
  void use(const LightMeshing& light) { light_ = &light; }

  // Sets the exchange (0 if nothing arrives), and the shapes if they have an effect or `variation` is given. Returns the number of
  // segments cast. The result depends only on the ends of the link and the seed; `list` only saves time.
  RayCount operator()(Link& link, const raycast::OccluderList& list, LinkVariation* variation = nullptr, Doubt* doubt = nullptr) const;

  // Uses `lamps` for links between its clusters and patches. `lamps` must outlive the evaluator.
  void use(const LampExchange& lamps) { lamps_ = &lamps; }

  [[nodiscard]] bool between_patches(const Link& link) const {
    return !scene_.hierarchy[link.p].is_cluster() && !scene_.hierarchy[link.q].is_cluster();
  }
  // Casts the segments of a link between patches with exposed ends as if nothing were known about blockers; appends them to `seen` if
  // given.
  [[nodiscard]] VisibilityEstimate segments(const Link& link, std::vector<CastSegment>* seen = nullptr) const {
    return visibility(scene_, {}, ends(link), rounds_, Random{seed_, key_of(link)}, seen);
  }

 private:
  [[nodiscard]] std::optional<VisibilityEstimate> measured_visibility(const Link& link) const;
  RayCount evaluate_lamp_link(Link& link, LinkVariation* variation, Doubt* doubt) const;
  // The link's errors (doubt.hpp). `sent`: unoccluded exchange. `at_leaves`: leaves may still be split while the link stays.
  [[nodiscard]] Doubt doubt_of(const Link& link, double sent, const VisibilityEstimate& seen, const Variations& varies,
                               bool at_leaves) const;
  // Expected exchange (Laplace's mean) although all segments, these and those of the ancestors, were blocked. `sent`: unoccluded exchange.
  [[nodiscard]] static double missed(double sent, const LinkVariation& before, std::uint64_t segments) {
    return sent / (static_cast<double>(before.blocked) + static_cast<double>(segments) + 2.0);
  }
  // Standard error of the exchange if only some of the segments arrived.
  [[nodiscard]] static double partly_seen(double sent, const VisibilityEstimate& seen) {
    return seen.fraction < 1.0 ? sent * std::sqrt(visibility_variance(seen.fraction, static_cast<double>(seen.rays.cast))) : 0.0;
  }
  [[nodiscard]] static std::uint64_t key_of(const Link& link) { return (std::uint64_t{link.p} << 32) | link.q; }
  [[nodiscard]] static LinkVariation::End variation_at(const Variation& v, double shadow) {
    return {static_cast<float>(v.linear), static_cast<float>(std::hypot(v.rest, v.limited)), static_cast<float>(shadow)};
  }
  // A cluster link treats all faces at an end as if they were at its centre, but their view of the other end varies, most of all if the
  // end is large, because blockers then hide the other end from some faces only. In addition, light that reaches a cluster falls on few
  // of its faces: over random normals the mean square of the positive cosines is 8/3 of their squared mean. The lattice of directions
  // adds a seventh. Measured on links of random boxes, polygons and a mesh, the true errors are 0.5 to 1.3 times this estimate.
  [[nodiscard]] LinkVariation variation_of_cluster_link(const Link& link, const ClusterExchange& seen, const LinkVariation& before) const;
  // The errors of faces and links are independent: by position, view, the lattice of directions, and sampling.
  [[nodiscard]] double doubt_of_cluster_link(const Link& link, const LinkVariation& variation) const;
  [[nodiscard]] PatchPair ends(const Link& link) const {
    return {patch_end(scene_, exposure_, link.p), patch_end(scene_, exposure_, link.q)};
  }

  SceneView scene_;
  const Exposure* exposure_;
  ClusterSampler sampler_;
  std::uint64_t seed_;
  std::uint32_t rounds_ = patch_rounds;
  const LightMeshing* light_ = nullptr;
  const LampExchange* lamps_ = nullptr;
};

// Adapts a cluster link to the areas that its ends show `now` instead of `before`; exposed areas are known better after faces were split.
void refit_cluster_link(const Hierarchy& hierarchy, Link& link, const ShownAreas& before, const ShownAreas& now);

// Parameters for evaluating many links. The references must outlive it.
struct Evaluation {
  const LinkEvaluator& evaluator;
  const OccluderLists& occluders;  // of the pairs or links
  unsigned threads;
  const Control& control;
};

// Makes the links of these pairs, in order, except those without light. `doubts`, if given, receives an entry for each link.
[[nodiscard]] EvaluateResult make_links(const Evaluation& by, const NodePairs& pairs, Links& links, LinkDoubts* doubts = nullptr);

// Measures the links from index `first` on and removes those without light. A link whose samples are all blocked stays if it may carry
// light all the same (LinkVariation::sampling).
[[nodiscard]] EvaluateResult measure_links(const Evaluation& by, MeasuredLinks& links, std::size_t first);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/links/evaluate.cpp>
#endif
