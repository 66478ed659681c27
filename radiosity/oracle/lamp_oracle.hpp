// SPDX-License-Identifier: MIT
#pragma once

// The oracle for a cluster of lamps (make_lamp_clusters()) and another node: the rule of the F-oracle, applied only to the other end. All
// faces of a lamp emit about the same, so it may fill a large part of the other's view: its light is a sum over its points
// (lamp_exchange.hpp). The cluster is opened if these points are too far apart for that.

#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

// Least distance of the centres, relative to the sum of the radii. With 1.5, bulbs in their shades had errors of 4 % instead of 3.
inline constexpr double lamp_separation = 2.0;

// For two different nodes of which one is a cluster of lamps.
struct LampOracle {
  [[nodiscard]] Decision operator()(const Question& question) const;
};
static_assert(Oracle<LampOracle>);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/lamp_oracle.cpp>
#endif
