// SPDX-License-Identifier: MIT
#pragma once

// The transport of light as one symmetric operator M on leaf radiosities: (M B)_i is the power that arrives at leaf i
// per W/m2 sent, so the irradiance of leaf i is (M B)_i / A_i. One application pulls radiosity up to the nodes as area
// averages and first moments, carries it over every link both ways, and pushes what arrived down to the leaves
// (Hanrahan 1991; here with the gradients of links.hpp).
//
// A cluster (clusters.hpp) has no radiosity of its own but sends what its faces show in each direction of a lattice, and hands
// what arrives from there to its faces by what they show of themselves to it: P has one row for each direction of each cluster, and
// the link of a cluster picks the three rows around the direction of its other end.
//
// The links come in parts, M = M_1 + M_2 + ...: those of lamps, which are known best, all others, and those that were sampled by rays
// (rays/ray_links.hpp). An error of the row sums is corrected in the parts that cause it: the noise of rays in the links of rays alone, and
// light that seems to arrive from behind a lamp in all links but those of the lamp.
//
// In matrix form each part is D P' G P D with P the pull, G the symmetric links, P' the transpose of P, and a diagonal D that is
// 1 unless the scene is closed: there the D make every row sum exactly what a closed scene demands.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <raycast/isa.hpp>

#include <radiosity/geometry/direction_lattice.hpp>
#include <radiosity/hierarchy/hierarchy.hpp>
#include <radiosity/hierarchy/links.hpp>
#include <radiosity/links/link_schedule.hpp>
#include <radiosity/solver/balance.hpp>
#include <radiosity/visibility/exposure.hpp>

namespace radiosity {

// The leaves that lose no light, whose form factors sum to 1, and the nodes that count as lamps.
struct ClosedNodes {
  std::vector<bool> nodes;  // empty: all
  std::vector<bool> lamps;  // the links with one end in them are a part of their own; empty: none
};

// Row sums that no scale brings about, of a patch that sees little else than one other, would drive scales of sampled links towards 0 and
// infinity. In a closed scene a leaf under a lamp may need a small one: where the lamp leaves least_left of the horizon, its links are
// those of a wider node around the lamp.
inline constexpr double least_left = 1e-3;  // of a row, beside lamps: no scale makes a row 0
inline constexpr ScaleLimits scales_of_open{1.0 / 4.0, 4.0}, scales_of_closed{least_left / 4.0, 16.0};

class Transport {
 public:
  // The references must outlive the operator. Arranges the links (link_schedule.hpp). `closed`: what close() is to bring about.
  Transport(const Hierarchy& hierarchy, Links& links, const Exposure& exposure, unsigned threads = 1, ClosedNodes closed = {});

  // Do the form factors of the node sum to 1?
  [[nodiscard]] bool closed(std::size_t i) const { return closed_.empty() || closed_[i]; }

  // Adds links that were sampled, between patches, once. They must outlive the operator, which arranges them.
  void add_sampled(Links& links);
  // Makes their row sums those of `rows`, one a node, read at the leaves, within 1e-6, as far as scales within the limits go.
  // Returns the area-weighted RMS by which their row sums changed, relative to the RMS of these: where an open scene has row sums near 0,
  // D may be far from 1 and change nothing.
  double scale_sampled(const std::vector<double>& rows, const ScaleLimits& limits);
  // What the row sums of the last part must be: at closed nodes, where rows sum to 1, what the other parts leave of 1; at others what they
  // are.
  [[nodiscard]] std::vector<double> left_by_lamps();
  // Before the other links are scaled: makes the row sums of closed lamps 1 by a scale of theirs, which other surfaces do not have. A
  // cluster of lamps has one for all its faces, since which of them lights what near it is not known: a face then counts for the area that
  // its links give it (area()). Without lamps nothing is done.
  void scale_lamps();

  // Light on its way, of a node: what it sends (mean of B over its area, and of B (x - c)), or what arrives at it (irradiance at the
  // centroid c, and its gradient).
  struct Moments {
    double value = 0.0;
    glm::dvec3 slope{0.0};

    void divide(double area);
  };

  // y = M x. Both have one value a node; x is read and y written at the leaves, the rest of y is 0.
  void apply(const std::vector<double>& x, std::vector<double>& y);

  // The three steps of apply(), for those who go through the scene in another order.
  // What node i sends by a part, from the radiosity of a leaf or from what its children send.
  void pull(std::size_t part, std::size_t i, const std::vector<double>& x, std::vector<Moments>& sent) const;
  // What one end of a link sends, added to what arrives at the other, times its area.
  static void carry(const Link& link, const Moments& from, Moments& to, const glm::dvec3& gradient_from, const glm::dvec3& gradient_to);
  // Likewise both ways over many links between patches. The same bits with every instruction set (carry.cpp).
  static void carry(std::span<const Link> links, const std::vector<Moments>& sent, std::vector<Moments>& arrived, raycast::Isa set);
  // Adds what arrived at node i, by the links of a part and from its parent, to its children or, for a leaf, to y. Parents first.
  void push(std::size_t part, std::size_t i, std::vector<Moments>& arrived, std::vector<double>& y) const;

  [[nodiscard]] const Hierarchy& hierarchy() const { return *hierarchy_; }
  // One part after the other, those that were sampled last.
  [[nodiscard]] std::size_t parts() const { return parts_.size(); }
  [[nodiscard]] std::span<const Link> links(std::size_t part) const { return parts_[part].links; }
  template <class Visit>
  void each_link(const Visit& visit) const {
    for (const Part& part : parts_) { std::for_each(part.links.begin(), part.links.end(), visit); }
  }

  // Of each node the area for which its light counts: what is exposed, but within clusters of lamps in closed scenes.
  [[nodiscard]] const std::vector<double>& area() const { return area_; }

  // What each leaf sees of the scene: the sum of its form factors. 1 in a closed scene. Inner nodes hold 0.
  [[nodiscard]] std::vector<double> row_sums();
  // Leaves that receive more than `most` times what there is, which nothing can, as slivers may and leaves in gaps narrower than they are:
  // scales their links in both directions, so that their rows sum to 1, or less where they light each other. `rows`: row_sums().
  void limit_row_sums(const std::vector<double>& rows, double most);

  // Closes what loses no light: finds D with the row sums of closed nodes 1, and all others as they are, within the tolerance (symmetric
  // scaling, van Leersum 1989; see balance.hpp), so that what quadrature and sampled visibility got wrong in the rows does not grow by
  // rho / (1 - rho) in the solution. Beside lamps the others are scaled first, to what the lamps leave of 1, and the D of all is near 1.
  // Leaves that see nothing at all keep their row of 0. Returns the area-weighted RMS by which the row sums were off, or nothing, and no D,
  // when that is beyond `limit`: then something other than quadrature and sampling is wrong. D - 1 is no measure of that: it is half of
  // what a row is off where all rows err alike, and many times as much where two patches see little but each other.
  std::optional<double> close(double limit, double tolerance = 1e-12);

 private:
  [[nodiscard]] bool is_cluster(std::size_t i) const { return i < above_ && (*hierarchy_)[i].is_cluster(); }
  [[nodiscard]] double* bins(std::vector<double>& of, std::size_t i) const { return &of[(*hierarchy_)[i].cluster * direction_count]; }

  // What the cluster or input face i sends, added to what its cluster sends. Children before their parents.
  void gather_into_cluster(std::size_t i);
  // What arrived at the cluster of i from all directions, added to what arrives at i. Parents first.
  void hand_out_from_cluster(std::size_t i);
  // Mean radiosity that an end of a cluster link sends along it, and power that arrives at one.
  [[nodiscard]] double sent_by(std::uint32_t i, const EndShape& shape);
  void arrive_at(std::uint32_t i, const EndShape& shape, double power);

  void keep_lamps(std::vector<bool> lamps);

  struct Part {
    Part(const Hierarchy& hierarchy, std::span<Link> links);

    std::span<const Link> links;
    LinkSchedule schedule;
    std::vector<std::size_t> round_sizes;
    std::vector<double> scale;  // D, at the leaves
  };
  // Adds to y what arrives over the links of a part.
  void apply(std::size_t part, const std::vector<double>& x, std::vector<double>& y);
  [[nodiscard]] std::vector<double> row_sums(std::size_t part);
  // Scales the links of a part to these row sums, as far as scales within the limits go.
  void scale(std::size_t part, const std::vector<double>& rows, const ScaleLimits& limits);
  // The area-weighted RMS by which the row sums of closed leaves differ from 1, those that see nothing left out.
  [[nodiscard]] double amiss(const std::vector<double>& rows) const;

  const Hierarchy* hierarchy_;
  const Exposure* exposure_;
  unsigned threads_;
  std::vector<double> area_;                 // by node, see area()
  std::vector<bool> closed_;                 // nodes; empty: all
  std::vector<bool> lamps_;                  // nodes; none where lamps have no part of their own, which is the first
  std::vector<std::uint32_t> lamp_cluster_;  // of each node the largest cluster of lamps that holds it, or no_node; likewise
  std::vector<Part> parts_;
  std::size_t sampled_ = 0;  // parts
  std::size_t above_ = 0;    // clusters and input faces, when there are clusters
  std::size_t clusters_ = 0;
  std::vector<Moments> sent_, arrived_;           // scratch of apply(), kept because it is asked for many times
  std::vector<double> sent_bins_, arrived_bins_;  // of the clusters, direction by direction
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/solver/carry.cpp>
#include <radiosity/solver/transport.cpp>
#endif
