// SPDX-License-Identifier: MIT
#include <radiosity/solver/transport.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <brep/inline.hpp>

#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/link_schedule.hpp>
#include <radiosity/support/instruction_sets.hpp>
#include <radiosity/support/parallel.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

HALFLIGHT_INLINE Transport::Transport(const Hierarchy& hierarchy, Links& links, const Exposure& exposure, unsigned threads,
                                      ClosedNodes closed)
    : hierarchy_{&hierarchy}, exposure_{&exposure}, threads_{threads}, area_{exposure.area}, closed_{std::move(closed.nodes)} {
  std::vector<bool>& lamps = closed.lamps;
  std::span<Link> rest{links};
  if (!lamps.empty()) {
    const auto of_lamp = [&](const Link& link) { return lamps[link.p] != lamps[link.q]; };
    const auto end = std::partition(links.begin(), links.end(), of_lamp);
    if (end != links.begin()) {
      const std::span<Link> own = rest.first(static_cast<std::size_t>(end - links.begin()));
      parts_.emplace_back(hierarchy, own);
      rest = rest.subspan(own.size());
      keep_lamps(std::move(lamps));
    }
  }
  if (parts_.empty() || !rest.empty()) { parts_.emplace_back(hierarchy, rest); }
  while (above_ < hierarchy.size() && (hierarchy[above_].is_cluster() || is_input_face(hierarchy, above_))) { ++above_; }
  for (std::size_t i = 0; i < above_; ++i) { clusters_ += hierarchy[i].is_cluster() ? 1 : 0; }
  if (clusters_ == 0) { above_ = 0; }
}

HALFLIGHT_INLINE void Transport::keep_lamps(std::vector<bool> lamps) {
  lamps_ = std::move(lamps);
  lamp_cluster_.assign(lamps_.size(), no_node);
  for (std::uint32_t i = 0; i < lamps_.size(); ++i) {
    const Node& node = (*hierarchy_)[i];
    if (node.parent != no_node && lamp_cluster_[node.parent] != no_node) {
      lamp_cluster_[i] = lamp_cluster_[node.parent];
    } else if (lamps_[i] && node.is_cluster()) {
      lamp_cluster_[i] = i;
    }
  }
}

HALFLIGHT_INLINE Transport::Part::Part(const Hierarchy& hierarchy, std::span<Link> of)
    : links{of}, schedule{hierarchy.size(), of}, scale(hierarchy.size(), 1.0) {
  for (const auto& round : schedule.rounds()) { round_sizes.push_back(round.size()); }
  const auto at_cluster = [&](const Link& link) { return hierarchy[link.p].is_cluster() || hierarchy[link.q].is_cluster(); };
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (at_cluster(links[k])) { of_clusters.push_back(k); }
  }
}

HALFLIGHT_INLINE void Transport::add_sampled(Links& links) {
  parts_.emplace_back(*hierarchy_, links);
  ++sampled_;
}

HALFLIGHT_INLINE void Transport::Moments::divide(double area) {  // a buried node carries nothing
  const double factor = area > 0.0 ? 1.0 / area : 0.0;
  value *= factor;
  slope *= factor;
}

HALFLIGHT_INLINE void Transport::apply(const std::vector<double>& x, std::vector<double>& y) {
  y.assign(x.size(), 0.0);
  for (std::size_t part = 0; part < parts_.size(); ++part) { apply(part, x, y); }
}

HALFLIGHT_INLINE void Transport::apply(std::size_t number, const std::vector<double>& x, std::vector<double>& y) {
  const Part& part = parts_[number];
  sent_.resize(x.size());
  arrived_.assign(x.size(), {});
  sent_bins_.assign(clusters_ * direction_count, 0.0);
  arrived_bins_.assign(clusters_ * direction_count, 0.0);
  for (std::size_t i = x.size(); i-- > 0;) {
    if (!is_cluster(i)) { pull(number, i, x, sent_); }
    if (i < above_) { gather_into_cluster(i); }
  }
  parallel_rounds(part.round_sizes, threads_, [&](std::size_t round, std::size_t b) {
    const LinkSchedule::Block block = part.schedule.rounds()[round][b];
    const auto carry_until = [&](std::size_t begin, std::size_t end) {
      carry(part.links.subspan(begin, end - begin), sent_, arrived_, detail::instruction_set());
    };
    std::size_t k = block.begin;
    for (auto of = std::lower_bound(part.of_clusters.begin(), part.of_clusters.end(), k); of != part.of_clusters.end() && *of < block.end;
         ++of) {
      carry_until(k, *of);
      carry_of_cluster(part.links[*of]);
      k = *of + 1;
    }
    carry_until(k, block.end);
  });
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i < above_) { hand_out_from_cluster(i); }
    if (!is_cluster(i)) { push(number, i, arrived_, y); }
  }
}

HALFLIGHT_INLINE void Transport::pull(std::size_t part, std::size_t i, const std::vector<double>& x, std::vector<Moments>& sent) const {
  const Node& node = (*hierarchy_)[i];
  const std::vector<glm::dvec3>& centroid = exposure_->centroid;
  Moments own;
  if (node.leaf()) {
    own.value = exposure_->area[i] > 0.0 ? x[i] * parts_[part].scale[i] : 0.0;
  } else {
    for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
      own.value += exposure_->area[c] * sent[c].value;
      own.slope += exposure_->area[c] * (sent[c].slope + sent[c].value * (centroid[c] - centroid[i]));
    }
    own.divide(exposure_->area[i]);
  }
  sent[i] = own;
}

HALFLIGHT_INLINE void Transport::push(std::size_t part, std::size_t i, std::vector<Moments>& arrived, std::vector<double>& y) const {
  const Node& node = (*hierarchy_)[i];
  const std::vector<glm::dvec3>& centroid = exposure_->centroid;
  Moments& own = arrived[i];  // the value of a child has already been divided by its parent
  if (node.parent == no_node || is_cluster(node.parent)) { own.divide(exposure_->area[i]); }
  if (node.leaf()) { y[i] += own.value * exposure_->area[i] * parts_[part].scale[i]; }
  for (std::uint32_t c = node.first_child; c < node.first_child + node.child_count; ++c) {
    arrived[c].divide(exposure_->area[c]);
    arrived[c].value += own.value + glm::dot(own.slope, centroid[c] - centroid[i]);
    arrived[c].slope += own.slope;
  }
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

HALFLIGHT_INLINE void Transport::carry_of_cluster(const Link& link) {
  const double from_p = sent_by(link.p, link.shape_p);
  const double from_q = sent_by(link.q, link.shape_q);
  arrive_at(link.q, link.shape_q, static_cast<double>(link.exchange) * from_p);
  arrive_at(link.p, link.shape_p, static_cast<double>(link.exchange) * from_q);
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
