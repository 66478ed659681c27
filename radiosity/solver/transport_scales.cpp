// SPDX-License-Identifier: MIT
// Row sums of the transport, and the scales that correct them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

#include <brep/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/solver/balance.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

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

}  // namespace radiosity
