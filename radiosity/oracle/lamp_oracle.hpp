// SPDX-License-Identifier: MIT
#pragma once

// The oracle for a cluster of lamps (make_lamp_clusters()) and another node: the F-oracle's question, asked of the other end alone. All
// faces of a lamp shine about alike, so it may be large in the other's view: what arrives is summed over its points (lamp_exchange.hpp).
// It is opened where these lie too far apart for that.

#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

// Of two different nodes, one of them a cluster of lamps.
struct LampOracle {
  [[nodiscard]] Decision operator()(const Question& question) const;
};
static_assert(Oracle<LampOracle>);

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/oracle/lamp_oracle.cpp>
#endif
