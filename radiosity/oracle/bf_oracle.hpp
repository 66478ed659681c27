// SPDX-License-Identifier: MIT
#pragma once

// The BF-oracle (paper 4.4) is asked about links with the largest errors: which end is split? It chooses the end that causes more of the
// error. If that end cannot be split any further, it chooses the other one, if that reduces the error by at least a quarter or is a
// cluster. A question about a single leaf is answered by splitting it.

#include <algorithm>
#include <cstdint>

#include <radiosity/oracle/oracle.hpp>

namespace radiosity {

struct BfOracle {
  [[nodiscard]] Decision operator()(const Question& question) const {
    if (question.p == question.q) { return question.can_split(question.p) ? Decision::split_p : Decision::link; }
    const LinkError& e = *question.error;
    const bool p_first = e.p >= e.q;
    if (question.can_split(p_first ? question.p : question.q)) { return p_first ? Decision::split_p : Decision::split_q; }
    const std::uint32_t second = p_first ? question.q : question.p;
    const bool helps = question.hierarchy[second].is_cluster() || std::min(e.p, e.q) >= 0.25f * e.sum();
    if (question.can_split(second) && helps) { return p_first ? Decision::split_q : Decision::split_p; }
    return Decision::link;
  }
};
static_assert(Oracle<BfOracle>);

}  // namespace radiosity
