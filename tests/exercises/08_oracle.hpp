// SPDX-License-Identifier: MIT
#include <algorithm>

#include <glm/geometric.hpp>

#include <radiosity/oracle/oracle.hpp>

// Far apart compared with their size.
struct OracleOfMine {
  radiosity::Decision operator()(const radiosity::Question& question) const {
    const radiosity::Node &p = question.node_p(), &q = question.node_q();
    if (glm::length(q.centre - p.centre) >= 1.5 * (p.radius + q.radius)) { return radiosity::Decision::link; }
    if (std::max(p.area, q.area) <= question.min_area) { return radiosity::Decision::link; }
    return p.area >= q.area ? radiosity::Decision::split_p : radiosity::Decision::split_q;
  }
};
