// SPDX-License-Identifier: MIT
#pragma once

// Splits links by the light that they carry. F-refinement considers only form factors, so a single visible fraction may represent a whole
// ceiling behind a lamp. Once links are evaluated, their light is known, and so is the variation that they cannot express over each end:
// a shadow, or a kernel that is not linear there (doubt.hpp). Hardly any single link matters, but the links of one patch err alike, so
// their sum over the patch counts. With the reflectance rho_i, the radiosity B_j of the other end of a link, and the link's error d_ij at
// i,
//
//     E_i = sum over the links of i of rho_i B_j d_ij,
//
// and patch i is resolved more finely if
//
//     A_i E_i^2  >  (0.35 light_epsilon)^2 * (what the scene reflects, squared, over its area).
//
// Then the largest of its links are replaced by links of its children, until the others amount to a quarter of the limit. The children's
// links are examined again with the light of the new links (coarse_light.hpp), in at most four generations. A leaf larger than a quarter
// of min_area is split first, and its other links pass their light down by their gradients.
//
// Measured at equal CPU time, where light goes by these links: a closed box with a lamp close under its ceiling has about half the error,
// rooms with openings in thin walls a tenth less. If light is blocked by many objects at once, their shadows do not add up, and E_i is
// too large: a scene of boxes or nested rooms takes 10 to 50 % more time for hardly less error.
//
// Not split are links of clusters, partly buried leaves, and leaves at blades (leaf_splits.hpp).

#include <cstdint>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/f_refine.hpp>

namespace radiosity {

struct LinkSplitRule {
  double epsilon = 0.0;  // of the existing links; passed on to Control::decided
  double light_epsilon = 0.0;
  double min_area = 0.0;  // relative to the area of the input faces that are not buried
};

// The links of F-refinement and what is known of them. The references must outlive the call.
struct EvaluatedLinks {
  RefineResult& refined;  // its occluder lists and counts are extended by those of new pairs
  Links& links;
  LinkDoubts& doubts;  // by link
  EvaluateResult& evaluated;
};

struct LinkSplits {
  std::uint64_t count = 0;      // links that were replaced
  std::uint64_t too_large = 0;  // bytes needed, if that exceeded the budget; then no more was split
};

// Splits links and, where necessary, leaves, which are exposed. If a generation is cancelled all links stay as they were; a generation
// that would exceed the limits of memory or links is not begun. The result does not depend on the number of threads.
[[nodiscard]] LinkSplits split_links_by_light(DiscreteScene& scene, const EvaluatedLinks& of, const LinkSplitRule& rule);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/link_splits.cpp>
#endif
