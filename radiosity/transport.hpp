// SPDX-License-Identifier: MIT
#pragma once

// The transport of light as one symmetric operator M on leaf radiosities: (M B)_i is the power that arrives at leaf i
// per W/m2 sent, so the irradiance of leaf i is (M B)_i / A_i. One application pulls radiosity up to the nodes as area
// averages and first moments, carries it over every link both ways, and pushes what arrived down to the leaves
// (Hanrahan 1991; here with the slopes of links.hpp).
//
// In matrix form M = D P' G P D with P the pull, G the symmetric links, P' the transpose of P, and a diagonal D that is
// 1 unless the scene is closed: there D makes every row sum exactly what a closed scene demands.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <radiosity/exposure.hpp>
#include <radiosity/hierarchy.hpp>
#include <radiosity/links.hpp>

namespace radiosity {

class Transport {
 public:
  // The references must outlive the operator.
  Transport(const Hierarchy& hierarchy, const Links& links, const Exposure& exposure)
      : hierarchy_{&hierarchy}, links_{&links}, exposure_{&exposure}, scale_(hierarchy.size(), 1.0) {}

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
    for (std::size_t i = x.size(); i-- > 0;) { pull(i, x, sent_); }
    arrived_.assign(x.size(), {});
    for (const Link& link : *links_) {
      carry(link, sent_[link.p], arrived_[link.q], link.slope_p.vector(), link.slope_q.vector());
      carry(link, sent_[link.q], arrived_[link.p], link.slope_q.vector(), link.slope_p.vector());
    }
    y.assign(x.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) { push(i, arrived_, y); }
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
    if (node.parent == no_node) { own.divide(exposure_->area[i]); }
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
  const Hierarchy* hierarchy_;
  const Links* links_;
  const Exposure* exposure_;
  std::vector<double> scale_;            // D, at the leaves
  std::vector<Moments> sent_, arrived_;  // scratch of apply(), kept because it is asked for many times
};

}  // namespace radiosity
