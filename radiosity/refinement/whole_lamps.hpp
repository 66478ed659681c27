// SPDX-License-Identifier: MIT
#pragma once

// Lamps of many faces, such as a bulb in its shade, and patches too close to them for a link with the whole lamp. Where the light of one
// face rises, that of the next falls, so that their sum varies far less than each. F-refinement therefore asks the light oracle about the
// whole lamp first. If the lamp need not be resolved, its parts are not asked about again.

#include <cstdint>
#include <unordered_set>
#include <vector>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/oracle/oracle.hpp>
#include <radiosity/visibility/occlusion.hpp>

namespace radiosity {

class WholeLamps {
 public:
  // The hierarchy must outlive this and may grow. Where all its faces are under one cluster, no cluster is a lamp.
  explicit WholeLamps(const Hierarchy& hierarchy) : hierarchy_{&hierarchy} {}

  // Is the answer to this question to open a cluster of lamps that fills its sphere, for a patch?
  [[nodiscard]] bool opens(const NodePair& pair, Decision decision) const;
  // For such a pair: does the patch reach into the sphere around the lamp, where the light varies with the lamp's own faces?
  [[nodiscard]] bool reaches_in(const NodePair& pair) const;
  // If it does, patches of more than a quarter of the lamp's radius are split first; otherwise the decision stays.
  [[nodiscard]] Decision split_within(const Question& question, Decision decision) const;

  // Has the light oracle agreed to the light of a whole lamp, of which one node is a part, on the other node or on one above it?
  [[nodiscard]] bool settled(const NodePair& pair) const;
  // Notes the pairs whose lamp is opened after the light oracle has agreed to it as a whole.
  void settle(const NodePairs& pairs, const std::vector<Decision>& decisions);

 private:
  const Hierarchy* hierarchy_;
  std::unordered_set<std::uint64_t> settled_;  // number of the lamp, and below it that of the patch
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/refinement/whole_lamps.cpp>
#endif
