// SPDX-License-Identifier: MIT
#pragma once

// Transport tree by tree: the light that one input face receives from all others, or sends to them, without the rest of M. A tree is an
// input face with all nodes below it. Gauss-Seidel gathers into one tree after the other; Southwell shoots from the tree with the most
// unshot power. The sum of either over all trees is one application of Transport. Shot light waits at the nodes where it arrives until
// their tree receives it, so the cost of a shot does not depend on the size of the trees that it reaches.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <radiosity/hierarchy/links.hpp>
#include <radiosity/solver/transport.hpp>

namespace radiosity {

class TreeTransport {
 public:
  // `transport` must outlive the operator.
  explicit TreeTransport(const Transport& transport);

  [[nodiscard]] std::uint32_t trees() const { return static_cast<std::uint32_t>(nodes_.size()); }
  // The nodes of a tree, parents before children.
  [[nodiscard]] std::span<const std::uint32_t> nodes(std::uint32_t tree) const { return nodes_[tree]; }

  // From now on the tree sends the radiosities x of its leaves.
  void send(std::uint32_t tree, const std::vector<double>& x) {
    const auto all = nodes_[tree];
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      for (std::size_t k = all.size(); k-- > 0;) { transport_->pull(part, all[k], x, parts_[part].sent); }
    }
  }
  // Writes into y the light that arrives at the leaves of the tree from all trees.
  void gather(std::uint32_t tree, std::vector<double>& y);
  // Carries what this tree sends to the other ends of its links; calls reached(tree, power) for each of these.
  template <class Reached>
  void shoot(std::uint32_t tree, const Reached& reached) {
    for (std::size_t number = 0; number < parts_.size(); ++number) {
      Part& part = parts_[number];
      const auto carry = [&](const Link& link, std::uint32_t from, std::uint32_t to, const EndShape& at_from, const EndShape& at_to) {
        const double before = part.arrived[to].value;
        Transport::carry(link, part.sent[from], part.arrived[to], at_from.gradient(), at_to.gradient());
        reached(tree_[to], part.arrived[to].value - before);
      };
      for (const std::uint32_t l : part.links[tree]) {
        const Link& link = transport_->links(number)[l];
        if (tree_[link.p] == tree) { carry(link, link.p, link.q, link.shape_p, link.shape_q); }
        if (tree_[link.q] == tree) { carry(link, link.q, link.p, link.shape_q, link.shape_p); }
      }
    }
  }
  // Writes into y the light that has been shot at the leaves of the tree since the last call.
  void receive(std::uint32_t tree, std::vector<double>& y) { collect(tree, y); }

  // The cost of gathering into the tree, or of receiving and shooting: its nodes plus its link ends.
  [[nodiscard]] std::size_t work(std::uint32_t tree) const {
    std::size_t work = nodes_[tree].size();
    for (const Part& part : parts_) { work += part.links[tree].size(); }
    return work;
  }

 private:
  // Numbers sorted by group, with the index of the first number of each group.
  class Groups {
   public:
    Groups() = default;
    template <class Each>
    Groups(std::uint32_t groups, std::size_t numbers, Each&& each) : first_(groups + 1, 0) {
      each([&](std::uint32_t group, std::uint32_t) { ++first_[group + 1]; });
      std::partial_sum(first_.begin(), first_.end(), first_.begin());
      std::vector<std::uint64_t> next(first_.begin(), first_.end() - 1);
      numbers_.reserve(numbers);
      numbers_.resize(first_.back());
      each([&](std::uint32_t group, std::uint32_t number) { numbers_[next[group]++] = number; });
    }
    [[nodiscard]] std::size_t size() const { return first_.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t group) const {
      return std::span(numbers_).subspan(first_[group], first_[group + 1] - first_[group]);
    }

   private:
    std::vector<std::uint64_t> first_{0};
    std::vector<std::uint32_t> numbers_;
  };

  struct Part {
    Groups links;                                   // by tree
    std::vector<Transport::Moments> sent, arrived;  // arrived: shot but not yet received
  };

  // Pushes the arrived light of a tree's nodes into y and clears it.
  void collect(std::uint32_t tree, std::vector<double>& y);

  const Transport* transport_;
  std::vector<std::uint32_t> tree_;  // by node
  Groups nodes_;                     // by tree
  std::vector<Part> parts_;          // same parts as the operator
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/solver/tree_transport.cpp>
#endif
