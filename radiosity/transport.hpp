// SPDX-License-Identifier: MIT
#pragma once

// The transport of light as one symmetric operator M on leaf radiosities: (M B)_i is the power that arrives at leaf i
// per W/m2 sent, so the irradiance of leaf i is (M B)_i / A_i. One application pulls radiosity up to the nodes as area
// averages and first moments, carries it over every link both ways, and pushes what arrived down to the leaves
// (Hanrahan 1991; here with the slopes of links.hpp).
//
// A cluster (clusters.hpp) has no radiosity of its own but sends what its faces show in each direction of a lattice, and hands
// what arrives from there to its faces by what they show of themselves to it: P has one row for each direction of each cluster, and
// the link of a cluster picks the three rows around the direction of its other end.
//
// In matrix form M = D P' G P D with P the pull, G the symmetric links, P' the transpose of P, and a diagonal D that is
// 1 unless the scene is closed: there D makes every row sum exactly what a closed scene demands.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <radiosity/directions.hpp>
#include <radiosity/exposure.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/link_schedule.hpp>
#include <radiosity/links.hpp>
#include <radiosity/parallel.hpp>

namespace radiosity {

class Transport {
 public:
  // The references must outlive the operator. Arranges the links (link_schedule.hpp).
  Transport(const Hierarchy& hierarchy, Links& links, const Exposure& exposure, unsigned threads = 1)
      : hierarchy_{&hierarchy},
        links_{&links},
        exposure_{&exposure},
        threads_{threads},
        schedule_{hierarchy.size(), links},
        scale_(hierarchy.size(), 1.0) {
    while (above_ < hierarchy.size() && (hierarchy[above_].is_cluster() || is_input_face(hierarchy, above_))) { ++above_; }
    for (std::size_t i = 0; i < above_; ++i) { clusters_ += hierarchy[i].is_cluster() ? 1 : 0; }
    if (clusters_ == 0) { above_ = 0; }
    for (const auto& round : schedule_.rounds()) { round_sizes_.push_back(round.size()); }
  }

  // Light on its way, of a node: what it sends (mean of B over its area, and of B (x - c)), or what arrives at it (irradiance at the
  // centroid c, and its gradient).
  struct Moments {
    double value = 0.0;
    glm::dvec3 slope{0.0};

    void divide(double area) {  // a node that is buried carries nothing
      const double factor = area > 0.0 ? 1.0 / area : 0.0;
      value *= factor;
      slope *= factor;
    }
  };

  // y = M x. Both have one value a node; x is read and y written at the leaves, the rest of y is 0.
  void apply(const std::vector<double>& x, std::vector<double>& y) {
    sent_.resize(x.size());
    arrived_.assign(x.size(), {});
    sent_bins_.assign(clusters_ * direction_count, 0.0);
    arrived_bins_.assign(clusters_ * direction_count, 0.0);
    for (std::size_t i = x.size(); i-- > 0;) {
      if (!is_cluster(i)) { pull(i, x, sent_); }
      if (i < above_) { gather_into_cluster(i); }
    }
    parallel_rounds(round_sizes_, threads_, [&](std::size_t round, std::size_t b) {
      const LinkSchedule::Block block = schedule_.rounds()[round][b];
      for (std::size_t k = block.begin; k < block.end; ++k) {
        const Link& link = (*links_)[k];
        if (is_cluster(link.p) || is_cluster(link.q)) {
          const double from_p = sent_by(link.p, link.slope_p);
          const double from_q = sent_by(link.q, link.slope_q);
          arrive_at(link.q, link.slope_q, static_cast<double>(link.exchange) * from_p);
          arrive_at(link.p, link.slope_p, static_cast<double>(link.exchange) * from_q);
        } else {
          carry(link, sent_[link.p], arrived_[link.q], link.slope_p.vector(), link.slope_q.vector());
          carry(link, sent_[link.q], arrived_[link.p], link.slope_q.vector(), link.slope_p.vector());
        }
      }
    });
    y.assign(x.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (i < above_) { hand_out_from_cluster(i); }
      if (!is_cluster(i)) { push(i, arrived_, y); }
    }
  }

  // The three steps of apply(), for those who go through the scene in another order.
  // What node i sends, from the radiosity of a leaf or from what its children send.
  void pull(std::size_t i, const std::vector<double>& x, std::vector<Moments>& sent) const {
    const Node& node = (*hierarchy_)[i];
    const std::vector<glm::dvec3>& centroid = exposure_->centroid;
    Moments own;
    if (node.leaf()) {
      own.value = exposure_->area[i] > 0.0 ? x[i] * scale_[i] : 0.0;
    } else {
      for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
        own.value += exposure_->area[c] * sent[c].value;
        own.slope += exposure_->area[c] * (sent[c].slope + sent[c].value * (centroid[c] - centroid[i]));
      }
      own.divide(exposure_->area[i]);
    }
    sent[i] = own;
  }
  // What one end of a link sends, added to what arrives at the other, times its area.
  static void carry(const Link& link, const Moments& from, Moments& to, const glm::dvec3& slope_from, const glm::dvec3& slope_to) {
    const double exchange = static_cast<double>(link.exchange);
    to.value += exchange * (from.value + glm::dot(slope_from, from.slope));
    to.slope += exchange * from.value * slope_to;
  }
  // Adds what arrived at node i, by links and from its parent, to its children or, for a leaf, to y. Parents first.
  void push(std::size_t i, std::vector<Moments>& arrived, std::vector<double>& y) const {
    const Node& node = (*hierarchy_)[i];
    const std::vector<glm::dvec3>& centroid = exposure_->centroid;
    Moments& own = arrived[i];  // of a child, its parent has divided it
    if (node.parent == no_node || is_cluster(node.parent)) { own.divide(exposure_->area[i]); }
    if (node.leaf()) { y[i] += own.value * exposure_->area[i] * scale_[i]; }
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      arrived[c].divide(exposure_->area[c]);
      arrived[c].value += own.value + glm::dot(own.slope, centroid[c] - centroid[i]);
      arrived[c].slope += own.slope;
    }
  }

  [[nodiscard]] const Hierarchy& hierarchy() const { return *hierarchy_; }
  [[nodiscard]] const Links& links() const { return *links_; }

  // What each leaf sees of the scene: the sum of its form factors. 1 in a closed scene. Inner nodes hold 0.
  [[nodiscard]] std::vector<double> row_sums() {
    std::vector<double> y;
    apply(std::vector<double>(hierarchy_->size(), 1.0), y);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const bool counts = (*hierarchy_)[i].leaf() && exposure_->area[i] > 0.0;
      y[i] = counts ? y[i] / exposure_->area[i] : 0.0;
    }
    return y;
  }

  // Closes a scene that is proven closed: finds D with all row sums 1, within the tolerance (symmetric scaling, van Leersum 1989), so that
  // what quadrature and sampled visibility got wrong in the rows does not grow by rho / (1 - rho) in the solution.
  // Leaves that see nothing at all keep their row of 0. Returns the area-weighted RMS of D - 1, or nothing, and no D, when that
  // is beyond `limit`: then something other than quadrature and sampling is wrong.
  std::optional<double> close(double limit, double tolerance = 1e-12) {
    const std::vector<double>& area = exposure_->area;
    for (int round = 0; round < 400; ++round) {
      const std::vector<double> rows = row_sums();
      double worst = 0.0;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!(rows[i] > 0.0)) { continue; }
        worst = std::max(worst, std::abs(rows[i] - 1.0));
        scale_[i] /= std::sqrt(rows[i]);
      }
      if (worst < tolerance) { break; }
    }
    double square = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < scale_.size(); ++i) {
      if (!(*hierarchy_)[i].leaf()) { continue; }
      square += area[i] * (scale_[i] - 1.0) * (scale_[i] - 1.0);
      total += area[i];
    }
    const double rms = total > 0.0 ? std::sqrt(square / total) : 0.0;
    if (rms <= limit) { return rms; }
    std::fill(scale_.begin(), scale_.end(), 1.0);
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_cluster(std::size_t i) const { return i < above_ && (*hierarchy_)[i].is_cluster(); }
  [[nodiscard]] double* bins(std::vector<double>& of, std::size_t i) const { return &of[(*hierarchy_)[i].cluster * direction_count]; }

  // What the cluster or input face i sends, added to what its cluster sends. Children before their parents.
  void gather_into_cluster(std::size_t i) {
    const Node& node = (*hierarchy_)[i];
    if (node.parent == no_node) { return; }
    double* const to = bins(sent_bins_, node.parent);
    if (node.is_cluster()) {
      const double* const from = bins(sent_bins_, i);
      for (std::size_t k = 0; k < direction_count; ++k) { to[k] += from[k]; }
    } else {
      add_shown(node.normal, exposure_->area[i] * sent_[i].value, to);
    }
  }
  // What arrived at the cluster of i from all directions, added to what arrives at i. Parents first.
  void hand_out_from_cluster(std::size_t i) {
    const Node& node = (*hierarchy_)[i];
    if (node.parent == no_node) { return; }
    const double* const from = bins(arrived_bins_, node.parent);
    if (node.is_cluster()) {
      double* const to = bins(arrived_bins_, i);
      for (std::size_t k = 0; k < direction_count; ++k) { to[k] += from[k]; }
    } else {
      arrived_[i].value += exposure_->area[i] * dot_shown(node.normal, from);
    }
  }
  // Mean radiosity that an end of a cluster link sends along it. `towards` of a cluster: cluster_exchange.hpp.
  [[nodiscard]] double sent_by(std::uint32_t i, const Slope& towards) {
    if (!is_cluster(i)) { return sent_[i].value; }
    const Aim at = aim(towards.vector());
    const double* const from = bins(sent_bins_, i);
    return at.weight[0] * from[at.direction[0]] + at.weight[1] * from[at.direction[1]] + at.weight[2] * from[at.direction[2]];
  }
  void arrive_at(std::uint32_t i, const Slope& towards, double power) {
    if (!is_cluster(i)) {
      arrived_[i].value += power;
      return;
    }
    const Aim at = aim(towards.vector());
    double* const to = bins(arrived_bins_, i);
    for (std::size_t j = 0; j < 3; ++j) { to[at.direction[j]] += at.weight[j] * power; }
  }

  const Hierarchy* hierarchy_;
  const Links* links_;
  const Exposure* exposure_;
  unsigned threads_;
  LinkSchedule schedule_;
  std::vector<std::size_t> round_sizes_;
  std::size_t above_ = 0;  // clusters and input faces, when there are clusters
  std::size_t clusters_ = 0;
  std::vector<double> scale_;                     // D, at the leaves
  std::vector<Moments> sent_, arrived_;           // scratch of apply(), kept because it is asked for many times
  std::vector<double> sent_bins_, arrived_bins_;  // of the clusters, direction by direction
};

}  // namespace radiosity
