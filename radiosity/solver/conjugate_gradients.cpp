// SPDX-License-Identifier: MIT
#include <radiosity/solver/conjugate_gradients.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <brep/inline.hpp>
#include <brep/union_find.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/solver/iteration.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

namespace detail {

// Reflecting leaves connected by links form one room: the constant mode exists only within it.
struct Rooms {
  std::vector<std::uint32_t> of;  // by node
  std::vector<double> weight;     // by room: sum of A / rho
  std::uint32_t count = 0;
};

HALFLIGHT_INLINE Rooms rooms_of(const Channel& channel) {
  const Hierarchy& hierarchy = *channel.hierarchy;
  const std::size_t n = hierarchy.size();
  const auto unknown = [&](std::size_t i) { return channel.counts(i) && channel.reflectance[i] > 0.0; };
  std::vector<std::uint32_t> root(n);
  std::vector<bool> reflects(n, false);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t parent = hierarchy[i].parent;
    root[i] = parent == no_node || hierarchy[parent].is_cluster() ? i : root[parent];
    if (unknown(i)) { reflects[root[i]] = true; }
  }
  for (std::size_t i = n; i-- > 0;) {  // a cluster reflects if anything in it does
    if (hierarchy[i].parent != no_node && reflects[root[i]]) { reflects[root[hierarchy[i].parent]] = true; }
  }
  // The link of a cluster connects everything in it.
  std::vector<bool> joined(n, false);
  channel.transport->each_link([&](const Link& link) {
    for (const std::uint32_t i : {link.p, link.q}) { joined[i] = joined[i] || hierarchy[i].is_cluster(); }
  });
  brep::detail::UnionFind sets(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t parent = hierarchy[i].parent;
    if (parent == no_node || !joined[parent]) { continue; }
    joined[i] = hierarchy[i].is_cluster();
    if (reflects[i]) { sets.unite(parent, i); }
  }
  channel.transport->each_link([&](const Link& link) {
    if (reflects[root[link.p]] && reflects[root[link.q]]) { sets.unite(root[link.p], root[link.q]); }
  });
  Rooms rooms;
  rooms.of.assign(n, no_node);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t room = sets.find(root[i]);  // its index is not larger than those of its members
    if (rooms.of[room] == no_node) {
      rooms.of[room] = rooms.count++;
      rooms.weight.push_back(0.0);
    }
    rooms.of[i] = rooms.of[room];
    if (unknown(i)) { rooms.weight[rooms.of[i]] += (*channel.area)[i] / channel.reflectance[i]; }
  }
  return rooms;
}

// The system x - rho H(x) of the reflecting leaves, in the inner product with weights A / rho, in which it is symmetric and positive
// definite; and the constant of each room, which is removed from residual and steps (deflation).
class DeflatedSystem {
 public:
  explicit DeflatedSystem(const Channel& channel) : channel_{channel}, weight_(channel.emission.size(), 0.0), rooms_{rooms_of(channel)} {
    const std::size_t n = weight_.size();
    std::vector<double> constant(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      if (!channel.counts(i) || !(channel.reflectance[i] > 0.0)) { continue; }
      weight_[i] = (*channel.area)[i] / channel.reflectance[i];
      constant[i] = 1.0;
    }
    apply(constant, image_of_constant_);
    stiffness_ = along_constants(constant);
    // A room whose stiffness is not positive beyond rounding has no steady state and is not deflated.
    for (std::size_t k = 0; k < rooms_.count; ++k) {
      if (!(stiffness_[k] > 1e-14 * rooms_.weight[k])) { stiffness_[k] = std::numeric_limits<double>::infinity(); }
    }
  }

  [[nodiscard]] double inner(const std::vector<double>& x, const std::vector<double>& y) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) { sum += weight_[i] * x[i] * y[i]; }
    return sum;
  }

  // y := x - rho H(x), the preconditioned system.
  void apply(const std::vector<double>& x, std::vector<double>& y) const {
    channel_.transport->apply(x, y);
    for (std::size_t i = 0; i < x.size(); ++i) { y[i] = weight_[i] > 0.0 ? x[i] - y[i] / weight_[i] : 0.0; }
  }

  // Adds to b the constant of each room that makes the residual r orthogonal to it.
  void correct(std::vector<double>& b, std::vector<double>& r) const {
    std::vector<double> amount(rooms_.count, 0.0);
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (weight_[i] > 0.0) { amount[rooms_.of[i]] += weight_[i] * r[i]; }
    }
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!(weight_[i] > 0.0)) { continue; }
      b[i] += amount[rooms_.of[i]] / stiffness_[rooms_.of[i]];
      r[i] -= amount[rooms_.of[i]] / stiffness_[rooms_.of[i]] * image_of_constant_[i];
    }
  }

  // The next direction: the residual without its part along the constants, plus `along` times the previous direction.
  void turn(std::vector<double>& step, const std::vector<double>& r, double along) const {
    const std::vector<double> amount = along_constants(r);
    step.resize(r.size(), 0.0);
    for (std::size_t i = 0; i < r.size(); ++i) {
      step[i] = (weight_[i] > 0.0 ? r[i] - amount[rooms_.of[i]] / stiffness_[rooms_.of[i]] : 0.0) + along * step[i];
    }
  }

 private:
  // By room: the inner product of the image of its constant with x.
  [[nodiscard]] std::vector<double> along_constants(const std::vector<double>& x) const {
    std::vector<double> sums(rooms_.count, 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (weight_[i] > 0.0) { sums[rooms_.of[i]] += weight_[i] * image_of_constant_[i] * x[i]; }
    }
    return sums;
  }

  const Channel& channel_;
  std::vector<double> weight_;  // A / rho where B is unknown, 0 where B = E is known
  Rooms rooms_;
  std::vector<double> image_of_constant_, stiffness_;
};

HALFLIGHT_INLINE LinearSolution conjugate_gradients(const Channel& channel, double wanted, std::uint32_t max_iterations) {
  const DeflatedSystem system(channel);
  std::vector<double> b(channel.emission);
  std::vector<double> r;
  std::vector<double> step;
  std::vector<double> image;
  Progress progress{channel};
  double square = 0.0;
  for (std::uint32_t iteration = 0;; ++iteration) {
    if (iteration % 16 == 0) {  // the true residual, so that rounding errors of the recurrence do not accumulate
      channel.residual(b, r);
      system.correct(b, r);
    }
    const double norm = channel.norm(r);
    progress.offer(b, norm);
    if (norm <= std::max(wanted * progress.reflected, channel.rounding(b)) || progress.diverged(norm) || iteration == max_iterations) {
      return finish(channel, std::move(progress), iteration, wanted);
    }
    const double next_square = system.inner(r, r);
    system.turn(step, r, step.empty() ? 0.0 : next_square / square);
    square = next_square;
    system.apply(step, image);
    const double curvature = system.inner(step, image);
    if (!(curvature > 0.0)) {  // rho times a row sum is 1 or more: no steady state exists
      return finish(channel, std::move(progress), iteration, wanted);
    }
    const double length = square / curvature;
    for (std::size_t i = 0; i < b.size(); ++i) {
      b[i] += length * step[i];
      r[i] -= length * image[i];
    }
  }
}

}  // namespace detail

}  // namespace radiosity
