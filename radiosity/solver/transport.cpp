// SPDX-License-Identifier: MIT
#include <radiosity/solver/transport.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <raycast/inline.hpp>

#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/link_schedule.hpp>
#include <radiosity/solver/balance.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

HALFLIGHT_INLINE Transport::Transport(const Hierarchy& hierarchy, Links& links, const Exposure& exposure, unsigned threads)
    : hierarchy_{&hierarchy}, exposure_{&exposure}, threads_{threads} {
  parts_.emplace_back(hierarchy, links);
  while (above_ < hierarchy.size() && (hierarchy[above_].is_cluster() || is_input_face(hierarchy, above_))) { ++above_; }
  for (std::size_t i = 0; i < above_; ++i) { clusters_ += hierarchy[i].is_cluster() ? 1 : 0; }
  if (clusters_ == 0) { above_ = 0; }
}

HALFLIGHT_INLINE Transport::Part::Part(const Hierarchy& hierarchy, Links& of)
    : links{&of}, schedule{hierarchy.size(), of}, scale(hierarchy.size(), 1.0) {
  for (const auto& round : schedule.rounds()) { round_sizes.push_back(round.size()); }
}

HALFLIGHT_INLINE void Transport::add_sampled(Links& links) { parts_.emplace_back(*hierarchy_, links); }

HALFLIGHT_INLINE void Transport::Moments::divide(double area) {  // a node that is buried carries nothing
  const double factor = area > 0.0 ? 1.0 / area : 0.0;
  value *= factor;
  slope *= factor;
}

HALFLIGHT_INLINE void Transport::apply(const std::vector<double>& x, std::vector<double>& y) {
  y.assign(x.size(), 0.0);
  for (const Part& part : parts_) { apply(part, x, y); }
}

HALFLIGHT_INLINE void Transport::apply(const Part& part, const std::vector<double>& x, std::vector<double>& y) {
  sent_.resize(x.size());
  arrived_.assign(x.size(), {});
  sent_bins_.assign(clusters_ * direction_count, 0.0);
  arrived_bins_.assign(clusters_ * direction_count, 0.0);
  for (std::size_t i = x.size(); i-- > 0;) {
    if (!is_cluster(i)) { pull(i, x, part.scale, sent_); }
    if (i < above_) { gather_into_cluster(i); }
  }
  parallel_rounds(part.round_sizes, threads_, [&](std::size_t round, std::size_t b) {
    const LinkSchedule::Block block = part.schedule.rounds()[round][b];
    for (std::size_t k = block.begin; k < block.end; ++k) {
      const Link& link = (*part.links)[k];
      if (is_cluster(link.p) || is_cluster(link.q)) {
        const double from_p = sent_by(link.p, link.shape_p);
        const double from_q = sent_by(link.q, link.shape_q);
        arrive_at(link.q, link.shape_q, static_cast<double>(link.exchange) * from_p);
        arrive_at(link.p, link.shape_p, static_cast<double>(link.exchange) * from_q);
      } else {
        carry(link, sent_[link.p], arrived_[link.q], link.shape_p.gradient(), link.shape_q.gradient());
        carry(link, sent_[link.q], arrived_[link.p], link.shape_q.gradient(), link.shape_p.gradient());
      }
    }
  });
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i < above_) { hand_out_from_cluster(i); }
    if (!is_cluster(i)) { push(i, part.scale, arrived_, y); }
  }
}

HALFLIGHT_INLINE void Transport::pull(std::size_t i, const std::vector<double>& x, std::vector<Moments>& sent) const {
  pull(i, x, parts_.front().scale, sent);
}

HALFLIGHT_INLINE void Transport::pull(std::size_t i, const std::vector<double>& x, const std::vector<double>& scale,
                                      std::vector<Moments>& sent) const {
  const Node& node = (*hierarchy_)[i];
  const std::vector<glm::dvec3>& centroid = exposure_->centroid;
  Moments own;
  if (node.leaf()) {
    own.value = exposure_->area[i] > 0.0 ? x[i] * scale[i] : 0.0;
  } else {
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      own.value += exposure_->area[c] * sent[c].value;
      own.slope += exposure_->area[c] * (sent[c].slope + sent[c].value * (centroid[c] - centroid[i]));
    }
    own.divide(exposure_->area[i]);
  }
  sent[i] = own;
}

HALFLIGHT_INLINE void Transport::carry(const Link& link, const Moments& from, Moments& to, const glm::dvec3& gradient_from,
                                       const glm::dvec3& gradient_to) {
  const double exchange = static_cast<double>(link.exchange);
  to.value += exchange * (from.value + glm::dot(gradient_from, from.slope));
  to.slope += exchange * from.value * gradient_to;
}

HALFLIGHT_INLINE void Transport::push(std::size_t i, std::vector<Moments>& arrived, std::vector<double>& y) const {
  push(i, parts_.front().scale, arrived, y);
}

HALFLIGHT_INLINE void Transport::push(std::size_t i, const std::vector<double>& scale, std::vector<Moments>& arrived,
                                      std::vector<double>& y) const {
  const Node& node = (*hierarchy_)[i];
  const std::vector<glm::dvec3>& centroid = exposure_->centroid;
  Moments& own = arrived[i];  // of a child, its parent has divided it
  if (node.parent == no_node || is_cluster(node.parent)) { own.divide(exposure_->area[i]); }
  if (node.leaf()) { y[i] += own.value * exposure_->area[i] * scale[i]; }
  for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
    arrived[c].divide(exposure_->area[c]);
    arrived[c].value += own.value + glm::dot(own.slope, centroid[c] - centroid[i]);
    arrived[c].slope += own.slope;
  }
}

HALFLIGHT_INLINE std::vector<double> Transport::row_sums() {
  std::vector<double> rows(hierarchy_->size(), 0.0);
  for (const Part& part : parts_) {
    const std::vector<double> more = row_sums(part);
    for (std::size_t i = 0; i < rows.size(); ++i) { rows[i] += more[i]; }
  }
  return rows;
}

HALFLIGHT_INLINE std::vector<double> Transport::row_sums(const Part& part) {
  std::vector<double> y(hierarchy_->size(), 0.0);
  apply(part, std::vector<double>(hierarchy_->size(), 1.0), y);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const bool counts = (*hierarchy_)[i].leaf() && exposure_->area[i] > 0.0;
    y[i] = counts ? y[i] / exposure_->area[i] : 0.0;
  }
  return y;
}

HALFLIGHT_INLINE double Transport::root_mean_square(const std::vector<double>& scale) const {
  const std::vector<double>& area = exposure_->area;
  double square = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < scale.size(); ++i) {
    if (!(*hierarchy_)[i].leaf()) { continue; }
    square += area[i] * (scale[i] - 1.0) * (scale[i] - 1.0);
    total += area[i];
  }
  return total > 0.0 ? std::sqrt(square / total) : 0.0;
}

HALFLIGHT_INLINE double Transport::scale_sampled(const std::vector<double>& wanted, double most) {
  Part& part = parts_.back();
  std::vector<double> power(wanted);
  for (std::size_t i = 0; i < power.size(); ++i) { power[i] *= exposure_->area[i]; }
  // Row sums that no scale brings about, of a patch that sees little else than one other, would drive scales towards 0 and infinity.
  const auto apply_part = [&](const std::vector<double>& x, std::vector<double>& y) {
    y.assign(x.size(), 0.0);
    apply(part, x, y);
  };
  const std::vector<double> scale = balance(apply_part, power, {.most = most, .tolerance = 1e-6});
  std::vector<double> before, after;
  apply_part(std::vector<double>(power.size(), 1.0), before);
  apply_part(scale, after);
  double correction = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < scale.size(); ++i) {
    const double area = exposure_->area[i];
    if (!(*hierarchy_)[i].leaf() || !(area > 0.0)) { continue; }
    const double row = scale[i] * after[i] / area;
    correction += area * (row - before[i] / area) * (row - before[i] / area);
    all += area * row * row;
  }
  part.scale = scale;
  return all > 0.0 ? std::sqrt(correction / all) : 0.0;
}

HALFLIGHT_INLINE std::optional<double> Transport::close(double limit, double tolerance) {
  std::vector<double> power(hierarchy_->size(), 0.0);
  for (std::size_t i = 0; i < power.size(); ++i) { power[i] = (*hierarchy_)[i].leaf() ? exposure_->area[i] : 0.0; }
  const std::vector<double> scale =
      balance([&](const std::vector<double>& x, std::vector<double>& y) { apply(x, y); }, power, {.tolerance = tolerance});
  const double rms = root_mean_square(scale);
  if (!(rms <= limit)) { return std::nullopt; }
  for (Part& part : parts_) {
    for (std::size_t i = 0; i < scale.size(); ++i) { part.scale[i] *= scale[i]; }
  }
  return rms;
}

HALFLIGHT_INLINE void Transport::gather_into_cluster(std::size_t i) {
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

HALFLIGHT_INLINE void Transport::hand_out_from_cluster(std::size_t i) {
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

HALFLIGHT_INLINE double Transport::sent_by(std::uint32_t i, const EndShape& shape) {
  if (!is_cluster(i)) { return sent_[i].value + glm::dot(shape.gradient(), sent_[i].slope); }
  const Aim at = aim(shape.direction_over_shown());
  const double* const from = bins(sent_bins_, i);
  return at.weight[0] * from[at.direction[0]] + at.weight[1] * from[at.direction[1]] + at.weight[2] * from[at.direction[2]];
}

HALFLIGHT_INLINE void Transport::arrive_at(std::uint32_t i, const EndShape& shape, double power) {
  if (!is_cluster(i)) {
    arrived_[i].value += power;
    arrived_[i].slope += power * shape.gradient();
    return;
  }
  const Aim at = aim(shape.direction_over_shown());
  double* const to = bins(arrived_bins_, i);
  for (std::size_t j = 0; j < 3; ++j) { to[at.direction[j]] += at.weight[j] * power; }
}

}  // namespace radiosity
