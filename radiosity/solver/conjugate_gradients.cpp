// SPDX-License-Identifier: MIT
#include <radiosity/solver/conjugate_gradients.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <raycast/inline.hpp>

#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/solver/iteration.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

namespace detail {

// Reflecting leaves that light can reach from each other are one room: only within it do they share a constant mode.
struct Rooms {
  std::vector<std::uint32_t> of;  // of each node
  std::vector<double> weight;     // sum of A / rho of each room
  std::uint32_t count = 0;
};

HALFLIGHT_INLINE Rooms rooms_of(const Channel& channel) {
  const Hierarchy& hierarchy = *channel.hierarchy;
  const std::size_t n = hierarchy.size();
  std::vector<std::uint32_t> root(n);
  std::vector<std::uint32_t> up(n);  // of a root: towards the first root of its room
  std::vector<bool> reflects(n, false);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t parent = hierarchy[i].parent;
    root[i] = parent == no_node || hierarchy[parent].is_cluster() ? i : root[parent];
    up[i] = i;
    if (channel.counts(i) && channel.reflectance[i] > 0.0) { reflects[root[i]] = true; }
  }
  const auto first = [&](std::uint32_t i) {
    while (up[i] != i) { i = up[i] = up[up[i]]; }
    return i;
  };
  for (std::size_t i = n; i-- > 0;) {  // a cluster reflects when anything in it does
    if (hierarchy[i].parent != no_node && reflects[root[i]]) { reflects[root[hierarchy[i].parent]] = true; }
  }
  // The link of a cluster reaches everything in it.
  std::vector<bool> joined(n, false);
  channel.transport->each_link([&](const Link& link) {
    for (const std::uint32_t i : {link.p, link.q}) { joined[i] = joined[i] || hierarchy[i].is_cluster(); }
  });
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t parent = hierarchy[i].parent;
    if (parent == no_node || !joined[parent]) { continue; }
    joined[i] = hierarchy[i].is_cluster();
    if (!reflects[i]) { continue; }
    const std::uint32_t a = first(parent);
    const std::uint32_t b = first(i);
    up[std::max(a, b)] = std::min(a, b);
  }
  channel.transport->each_link([&](const Link& link) {
    const std::uint32_t p = root[link.p];
    const std::uint32_t q = root[link.q];
    if (!reflects[p] || !reflects[q]) { return; }
    const std::uint32_t a = first(p);
    const std::uint32_t b = first(q);
    up[std::max(a, b)] = std::min(a, b);
  });
  Rooms rooms;
  rooms.of.assign(n, no_node);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t room = first(root[i]);  // not after its members
    if (rooms.of[room] == no_node) {
      rooms.of[room] = rooms.count++;
      rooms.weight.push_back(0.0);
    }
    rooms.of[i] = rooms.of[room];
    if (channel.counts(i) && channel.reflectance[i] > 0.0) { rooms.weight[rooms.of[i]] += (*channel.area)[i] / channel.reflectance[i]; }
  }
  return rooms;
}

HALFLIGHT_INLINE LinearSolution conjugate_gradients(const Channel& channel, double wanted, std::uint32_t max_iterations) {
  const std::size_t n = channel.emission.size();
  const std::vector<double>& area = *channel.area;
  std::vector<double> weight(n, 0.0);  // A / rho where unknown, 0 where B = E is known
  for (std::size_t i = 0; i < n; ++i) {
    if (channel.counts(i) && channel.reflectance[i] > 0.0) { weight[i] = area[i] / channel.reflectance[i]; }
  }
  const auto inner = [&](const std::vector<double>& x, const std::vector<double>& y) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) { sum += weight[i] * x[i] * y[i]; }
    return sum;
  };
  const auto apply = [&](const std::vector<double>& x, std::vector<double>& y) {  // y := x - rho H(x), the preconditioned system
    channel.transport->apply(x, y);
    for (std::size_t i = 0; i < n; ++i) { y[i] = weight[i] > 0.0 ? x[i] - y[i] / weight[i] : 0.0; }
  };
  const Rooms rooms = rooms_of(channel);
  std::vector<double> constant(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) { constant[i] = weight[i] > 0.0 ? 1.0 : 0.0; }
  std::vector<double> image_of_constant;
  apply(constant, image_of_constant);
  // Of each room: the inner product of the image of the constant with x.
  const auto along_constant = [&](const std::vector<double>& x, std::vector<double>& sums) {
    sums.assign(rooms.count, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      if (weight[i] > 0.0) { sums[rooms.of[i]] += weight[i] * image_of_constant[i] * x[i]; }
    }
  };
  std::vector<double> stiffness;
  std::vector<double> amount;
  along_constant(constant, stiffness);
  for (std::size_t k = 0; k < rooms.count; ++k) {  // what is not positive beyond rounding has no steady state, and is not deflated
    if (!(stiffness[k] > 1e-14 * rooms.weight[k])) { stiffness[k] = std::numeric_limits<double>::infinity(); }
  }

  std::vector<double> b(channel.emission);
  std::vector<double> r;
  std::vector<double> step;
  std::vector<double> image;
  Progress progress{channel.norm(b), b};
  double square = 0.0;
  for (std::uint32_t iteration = 0;; ++iteration) {
    // The true residual is formed every 16 steps; rounding in the recurrence does not build up.
    if (iteration % 16 == 0) {
      channel.residual(b, r);
      amount.assign(rooms.count, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        if (weight[i] > 0.0) { amount[rooms.of[i]] += weight[i] * r[i]; }
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (!(weight[i] > 0.0)) { continue; }
        b[i] += amount[rooms.of[i]] / stiffness[rooms.of[i]];
        r[i] -= amount[rooms.of[i]] / stiffness[rooms.of[i]] * image_of_constant[i];
      }
    }
    const double norm = channel.norm(r);
    progress.offer(b, norm);
    if (norm <= std::max(wanted * progress.start, Progress::rounding(channel.norm(b))) || progress.diverged(norm) ||
        iteration == max_iterations) {
      return finish(channel, std::move(progress), iteration, wanted);
    }
    const double next_square = inner(r, r);
    const double along = step.empty() ? 0.0 : next_square / square;
    along_constant(r, amount);
    step.resize(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      step[i] = (weight[i] > 0.0 ? r[i] - amount[rooms.of[i]] / stiffness[rooms.of[i]] : 0.0) + along * step[i];
    }
    square = next_square;
    apply(step, image);
    const double curvature = inner(step, image);
    if (!(curvature > 0.0)) {  // rho times a row sum is 1 or more: there is no steady state
      return finish(channel, std::move(progress), iteration, wanted);
    }
    const double length = square / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      b[i] += length * step[i];
      r[i] -= length * image[i];
    }
  }
}

}  // namespace detail

}  // namespace radiosity
