// SPDX-License-Identifier: MIT
#include <radiosity/solver/transport.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
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
#include <radiosity/solver/balance.hpp>
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

HALFLIGHT_INLINE std::vector<double> Transport::row_sums() {
  std::vector<double> rows(hierarchy_->size(), 0.0);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const std::vector<double> more = row_sums(part);
    for (std::size_t i = 0; i < rows.size(); ++i) { rows[i] += more[i]; }
  }
  return rows;
}

HALFLIGHT_INLINE std::vector<double> Transport::row_sums(std::size_t part) {
  std::vector<double> y(hierarchy_->size(), 0.0);
  apply(part, std::vector<double>(hierarchy_->size(), 1.0), y);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const bool counts = (*hierarchy_)[i].leaf() && area_[i] > 0.0;
    y[i] = counts ? y[i] / area_[i] : 0.0;
  }
  return y;
}

HALFLIGHT_INLINE void Transport::limit_row_sums(std::vector<double> rows, double most, bool lamps_apart) {
  const auto wanted = [&](const auto& of) {
    std::vector<double> power(rows.size(), 0.0);  // 0: not to be scaled
    for (std::size_t i = 0; i < power.size(); ++i) { power[i] = rows[i] > most ? area_[i] * of(i) : 0.0; }
    return power;
  };
  constexpr Balance only_less{{0.0, 1.0}};
  const auto join_lamps = [&] {
    std::vector<double> power(rows.size(), 0.0), area(rows.size(), 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (lamps_apart || !(*hierarchy_)[i].leaf()) { continue; }
      power[counts_as(i)] += area_[i] * rows[i];
      area[counts_as(i)] += area_[i];
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool joined = (*hierarchy_)[i].leaf() && counts_as(i) != i && area[counts_as(i)] > 0.0;
      if (joined) { rows[i] = power[counts_as(i)] / area[counts_as(i)]; }
    }
  };
  join_lamps();
  if (!lamps_.empty() && parts_.size() > 1) {
    const std::vector<double> of_lamps = row_sums(std::size_t{0});
    scale_parts(1, wanted([&](std::size_t i) { return lamps_[i] ? 0.0 : std::max(least_left, 1.0 - of_lamps[i]); }), only_less);
    rows = row_sums();
    join_lamps();
  }
  scale_parts(0, wanted([](std::size_t) { return 1.0; }), only_less);
}

HALFLIGHT_INLINE void Transport::scale_lamps() {
  if (lamps_.empty()) { return; }
  const std::vector<double> of_lamps = row_sums(std::size_t{0});
  std::vector<double> of_others(of_lamps.size(), 0.0);
  for (std::size_t part = 1; part < parts_.size(); ++part) {
    const std::vector<double> rows = row_sums(part);
    for (std::size_t i = 0; i < rows.size(); ++i) { of_others[i] += rows[i]; }
  }
  std::vector<double> power(of_lamps.size(), 0.0), wanted(power);  // of each lamp, stored at the leaf or at the cluster
  for (std::size_t i = 0; i < of_lamps.size(); ++i) {
    if (!lamps_[i] || !(*hierarchy_)[i].leaf()) { continue; }
    power[counts_as(i)] += area_[i] * of_lamps[i];
    wanted[counts_as(i)] += area_[i] * (closed(i) ? 1.0 - of_others[i] : of_lamps[i]);
  }
  for (std::size_t i = 0; i < of_lamps.size(); ++i) {
    if (!lamps_[i]) { continue; }
    const double is = power[counts_as(i)], be = wanted[counts_as(i)], scale = is > 0.0 && be > 0.0 ? std::clamp(be / is, 0.5, 2.0) : 1.0;
    parts_[0].scale[i] *= scale;
    const double row = scale * of_lamps[i] + of_others[i];
    if (lamp_cluster_[i] != no_node && (*hierarchy_)[i].leaf() && row > 0.0 && closed(i)) { area_[i] *= row; }
  }
  for (std::size_t i = area_.size(); i-- > 0;) {
    const Node& node = (*hierarchy_)[i];
    if (lamp_cluster_[i] == no_node || node.leaf()) { continue; }
    area_[i] = std::accumulate(&area_[node.first_child], &area_[node.first_child] + node.child_count, 0.0);
  }
}

HALFLIGHT_INLINE void Transport::scale(std::size_t number, const std::vector<double>& rows, const ScaleLimits& limits) {
  std::vector<double> power(rows);
  for (std::size_t i = 0; i < power.size(); ++i) { power[i] *= area_[i]; }
  const auto apply_part = [&](const std::vector<double>& x, std::vector<double>& y) {
    y.assign(x.size(), 0.0);
    apply(number, x, y);
  };
  parts_[number].scale = balance(apply_part, power, {limits, 1e-6});
}

HALFLIGHT_INLINE double Transport::scale_sampled(const std::vector<double>& wanted, const ScaleLimits& limits) {
  const std::size_t part = parts_.size() - 1;
  const std::vector<double> before = row_sums(part);
  scale(part, wanted, limits);
  const std::vector<double> after = row_sums(part);
  double correction = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    correction += area_[i] * (after[i] - before[i]) * (after[i] - before[i]);
    all += area_[i] * after[i] * after[i];
  }
  return all > 0.0 ? std::sqrt(correction / all) : 0.0;
}

HALFLIGHT_INLINE std::vector<double> Transport::left_by_lamps() {
  std::vector<double> left(hierarchy_->size(), 1.0);
  for (std::size_t part = 0; part + 1 < parts_.size(); ++part) {
    const std::vector<double> rows = row_sums(part);
    for (std::size_t i = 0; i < left.size(); ++i) { left[i] -= rows[i]; }
  }
  const std::vector<double> own = row_sums(parts_.size() - 1);
  for (std::size_t i = 0; i < left.size(); ++i) { left[i] = closed(i) ? std::max(least_left, left[i]) : own[i]; }
  return left;
}

HALFLIGHT_INLINE double Transport::row_sum_deviation(const std::vector<double>& rows) const {
  std::vector<double> power(rows.size(), 0.0), area(rows.size(), 0.0);
  double total = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!(*hierarchy_)[i].leaf()) { continue; }
    total += area_[i];
    if (!closed(i) || !(rows[i] > 0.0)) { continue; }
    power[counts_as(i)] += area_[i] * rows[i];
    area[counts_as(i)] += area_[i];
  }
  double square = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (area[i] > 0.0) { square += (power[i] - area[i]) * (power[i] - area[i]) / area[i]; }
  }
  return total > 0.0 ? std::sqrt(square / total) : 0.0;
}

HALFLIGHT_INLINE std::optional<double> Transport::close(double limit, double tolerance) {
  const double rms = row_sum_deviation(row_sums());
  if (!(rms <= limit)) { return std::nullopt; }
  if (!lamps_.empty() && sampled_ == 0 && parts_.size() > 1) {
    scale_lamps();
    scale(parts_.size() - 1, left_by_lamps(), scales_of_closed);
  }
  std::vector<double> power(hierarchy_->size(), 0.0);
  const std::vector<double> own = closed_.empty() ? std::vector<double>{} : row_sums();
  for (std::size_t i = 0; i < power.size(); ++i) { power[i] = !(*hierarchy_)[i].leaf() ? 0.0 : closed(i) ? area_[i] : area_[i] * own[i]; }
  scale_parts(0, power, {{}, tolerance});
  return rms;
}

HALFLIGHT_INLINE void Transport::scale_parts(std::size_t first, const std::vector<double>& power, const Balance& goal) {
  const auto apply_parts = [&](const std::vector<double>& x, std::vector<double>& y) {
    y.assign(x.size(), 0.0);
    for (std::size_t part = first; part < parts_.size(); ++part) { apply(part, x, y); }
  };
  const std::vector<double> scale = balance(apply_parts, power, goal);
  for (std::size_t part = first; part < parts_.size(); ++part) {
    for (std::size_t i = 0; i < scale.size(); ++i) { parts_[part].scale[i] *= scale[i]; }
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
