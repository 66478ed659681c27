// SPDX-License-Identifier: MIT
#pragma once

// The last split of links, by what they carry. F-refinement asks for form factors alone, so after it one visible fraction may stand for all
// of a ceiling behind a lamp. Once links are evaluated, the light that they bring is known, and so is how far it is from what a link can
// express over each end: a shadow, or a kernel that is not linear there (doubt.hpp). Hardly any link matters alone, but the links of one
// patch err alike, so what counts is their sum over the patch. With the reflectance rho_i, the radiosity B_j of a link's other end and its
// doubt d_ij at i,
//
//     E_i = sum over the links of i of rho_i B_j d_ij,
//
// and patch i is resolved more finely where
//
//     A_i E_i^2  >  (0.35 light_epsilon)^2 * (what the scene reflects, squared, over its area).
//
// Then the largest of its links are replaced by links of its children, until the others leave a quarter of that. The children's links are
// looked at again with the light of the new links (coarse_light.hpp), four generations at most. A leaf is split first where it is larger
// than a quarter of min_area, and its other links hand their light down by their gradients.
//
// Measured at equal CPU time, where light goes by these links: a closed box with a lamp close under its ceiling has about half the error,
// rooms with openings in thin walls a tenth less. Where light is hidden by many things at once their shadows do not add up; E_i is too
// large then, and a scene of boxes or nested rooms pays a tenth to a half more time for hardly less error.
//
// Links of clusters stay as they are, and so do leaves that are partly buried and leaves at blades (leaf_splits.hpp).

#include <cstdint>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/evaluate.hpp>
#include <radiosity/refinement/discrete_scene.hpp>
#include <radiosity/refinement/f_refine.hpp>

namespace radiosity {

struct LinkSplitRule {
  double epsilon = 0.0;  // of the links that there are: for those who watch (Control::decided)
  double light_epsilon = 0.0;
  double min_area = 0.0;  // relative to the area of the input faces that are not buried
};

// The links of F-refinement and all that is known of them. The references must outlive the call.
struct EvaluatedLinks {
  RefineResult& refined;  // its occluder lists and counts grow by those of new pairs
  Links& links;
  LinkDoubts& doubts;  // of each link
  EvaluateResult& evaluated;
};

struct LinkSplits {
  std::uint64_t count = 0;      // links that were replaced
  std::uint64_t too_large = 0;  // bytes that would be needed when that is more than the budget allows; nothing more was split then
};

// Splits links, and leaves below them, which are exposed. A generation in which the run is cancelled leaves all links as they were, and one
// that would need more memory or links than there may be is not begun. The same for any number of threads.
[[nodiscard]] LinkSplits split_links_by_light(DiscreteScene& scene, const EvaluatedLinks& of, const LinkSplitRule& rule);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/link_splits.cpp>
#endif
