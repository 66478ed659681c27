// SPDX-License-Identifier: MIT
#pragma once

// The transport of light as one symmetric operator M on leaf radiosities: (M B)_i is the power that arrives at leaf i per W/m2
// sent, so the irradiance of leaf i is (M B)_i / A_i. One application pulls radiosity up to the nodes as area averages and
// first moments, carries it over every link in both directions, and pushes the arrived light down to the leaves (Hanrahan 1991;
// here with the gradients of links.hpp).
//
// A cluster (clusters.hpp) has no radiosity of its own. It sends what its faces show in each direction of a lattice, and distributes the
// light from a direction among its faces by their projected areas in that direction: P has one row for each direction of each cluster,
// and the link of a cluster uses the three rows around the direction of its other end.
//
// The links are divided into parts, M = M_1 + M_2 + ...: those of lamps, which are most accurate, all others, and those sampled by rays
// (rays/ray_links.hpp). An error of the row sums is corrected in the parts that cause it: the noise of rays only in links of rays, and
// light that seems to arrive from behind a lamp in all links except those of the lamp.
//
// In matrix form each part is D P' G P D, with P the pull, G the symmetric links, P' the transpose of P, and a diagonal D. D is 1 unless
// the scene is closed; there D makes every row sum exactly that of a closed scene.

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

// The leaves that lose no light, so that their form factors sum to 1, and the nodes that count as lamps.
struct ClosedNodes {
  std::vector<bool> nodes;  // by node; empty: all
  std::vector<bool> lamps;  // by node; links with one end in them form a separate part; empty: none
};

// Limits of scales. Wanted row sums are exact in closed scenes only, apart from lamps; in open scenes they are estimates, rough ones where
// little is met, and a scale carries the error of one row into all others: with scales up to 4 the light of a sunny ground that entered a
// room through a small window varied by a factor of 14 from seed to seed.
//
// Row sums that no scale can achieve, of a patch that sees little except one other patch, would drive the scales of sampled links to 0 and
// infinity. Two large patches of this kind, such as facing parts of the floor and ceiling of a wide hall, need scales far above and below 1
// if rays to other patches happened to meet more from one of them than from the other; the upper scale would draw the light of the small
// patches beside them away. In a closed scene, patches in a narrow gap beside a lamp need scales up to 3, and a leaf under a lamp may need
// a small one: if the lamp leaves least_left of its horizon, its links are those of a wider node around the lamp.
inline constexpr double least_left = 1e-3;  // least remaining row sum beside lamps: a row must not be scaled to 0
inline constexpr ScaleLimits scales_of_open{1.0 / 1.25, 1.25}, scales_of_closed{least_left / 4.0, 4.0};

class Transport {
 public:
  // The references must outlive the operator. Arranges the links (link_schedule.hpp). `closed`: the nodes for close().
  Transport(const Hierarchy& hierarchy, Links& links, const Exposure& exposure, unsigned threads = 1, ClosedNodes closed = {});

  // Should the form factors of the node sum to 1?
  [[nodiscard]] bool closed(std::size_t i) const { return closed_.empty() || closed_[i]; }
  // What a cluster of lamps sends is spread over its faces, whichever way they look, so these count as one node: the cluster.
  [[nodiscard]] std::size_t counts_as(std::size_t i) const {
    return lamp_cluster_.empty() || lamp_cluster_[i] == no_node ? i : lamp_cluster_[i];
  }

  // Adds sampled links between patches; to be called once. They must outlive the operator, which arranges them.
  void add_sampled(Links& links);
  // Scales the sampled links to the row sums `rows` (by node, read at the leaves), within 1e-6 or as far as the limits allow. Returns the
  // area-weighted RMS change of their row sums, relative to the RMS of these. (D - 1 would be no measure: in an open scene with row sums
  // near 0, D may be far from 1 without changing anything.)
  double scale_sampled(const std::vector<double>& rows, const ScaleLimits& limits);
  // The wanted row sums of the last part: at closed nodes, 1 minus those of the other parts; at other nodes, unchanged.
  [[nodiscard]] std::vector<double> left_by_lamps();
  // To be called before the other links are scaled: makes the row sums of closed lamps 1, by scales of the lamps only. A cluster of lamps
  // has one common scale, because it is not known which of its faces lights what is near it; each face then counts with the area that its
  // links give it (area()). Does nothing without lamps.
  void scale_lamps();

  // The light of a node in transport: what it sends (means over its area of B and of B (x - c)), or what arrives (irradiance at the
  // centroid c, and its gradient).
  struct Moments {
    double value = 0.0;
    glm::dvec3 slope{0.0};

    void divide(double area);
  };

  // y = M x, by node: x is read and y written at the leaves; other entries of y are 0.
  void apply(const std::vector<double>& x, std::vector<double>& y);

  // The steps of apply(), for solvers that visit nodes in another order. pull: computes what node i sends in a part, from the
  // radiosity of a leaf or from what its children send.
  void pull(std::size_t part, std::size_t i, const std::vector<double>& x, std::vector<Moments>& sent) const;
  // Adds what one end of a link sends to what arrives at the other end, times the area of that end.
  static void carry(const Link& link, const Moments& from, Moments& to, const glm::dvec3& gradient_from, const glm::dvec3& gradient_to);
  // The same in both directions for many links between patches. The result has the same bits with every instruction set (carry.cpp).
  static void carry(std::span<const Link> links, const std::vector<Moments>& sent, std::vector<Moments>& arrived, raycast::Isa set);
  // Adds what arrived at node i, by links of a part and from its parent, to its children or, for a leaf, to y. Parents first.
  void push(std::size_t part, std::size_t i, std::vector<Moments>& arrived, std::vector<double>& y) const;

  [[nodiscard]] const Hierarchy& hierarchy() const { return *hierarchy_; }
  // The parts in order; sampled links are the last part.
  [[nodiscard]] std::size_t parts() const { return parts_.size(); }
  [[nodiscard]] std::span<const Link> links(std::size_t part) const { return parts_[part].links; }
  template <class Visit>
  void each_link(const Visit& visit) const {
    for (const Part& part : parts_) { std::for_each(part.links.begin(), part.links.end(), visit); }
  }

  // By node: the area with which its light counts. This is the exposed area, except within clusters of lamps in closed scenes.
  [[nodiscard]] const std::vector<double>& area() const { return area_; }

  // By leaf: the sum of its form factors, 1 in a closed scene. 0 at inner nodes.
  [[nodiscard]] std::vector<double> row_sums();
  // Corrects leaves with row sums above `most`, which are impossible but occur for slivers and for leaves in gaps narrower than they are:
  // finds D, 1 at all other leaves and at most 1 at these, such that their rows sum to 1. So where they light each other, as on the two
  // sides of a gap, each takes half of what is too much. Beside a lamp the other links are scaled first, to 1 minus the row sums of the
  // lamps: what is too much there is light from places that the lamp hides. A cluster of lamps counts as one leaf; with
  // `lamps_apart` each of its leaves is limited, which loses some of their light. `rows`: row_sums().
  void limit_row_sums(std::vector<double> rows, double most, bool lamps_apart = false);

  // Closes the nodes that lose no light: finds D such that their row sums are 1 and all others unchanged, within the tolerance (symmetric
  // scaling, van Leersum 1989; see balance.hpp), so that row errors by quadrature and sampled visibility are not amplified in the solution
  // by rho / (1 - rho). Beside lamps the other links are scaled first, to 1 minus the row sums of the lamps, and D for all is then near 1.
  // Leaves that see nothing keep their row of 0. Returns the area-weighted RMS deviation of the row sums; if that exceeds `limit`,
  // something other than quadrature and sampling is wrong, and nothing is returned or scaled. D - 1 would be no measure of the deviation:
  // it is half of it if all rows err alike, and many times as large if two patches see little except each other.
  std::optional<double> close(double limit, double tolerance = 1e-12);

 private:
  [[nodiscard]] bool is_cluster(std::size_t i) const { return i < above_ && (*hierarchy_)[i].is_cluster(); }
  [[nodiscard]] double* bins(std::vector<double>& of, std::size_t i) const { return &of[(*hierarchy_)[i].cluster * direction_count]; }

  // Adds what the cluster or input face i sends to its parent cluster. Children before parents.
  void gather_into_cluster(std::size_t i);
  // Adds to i what arrived at its parent cluster from all directions. Parents before children.
  void hand_out_from_cluster(std::size_t i);
  // Mean radiosity that an end of a cluster link sends along it; adds power that arrives at such an end.
  [[nodiscard]] double sent_by(std::uint32_t i, const EndShape& shape);
  void arrive_at(std::uint32_t i, const EndShape& shape, double power);
  void carry_of_cluster(const Link& link);  // in both directions; one of its ends is a cluster

  void keep_lamps(std::vector<bool> lamps);

  struct Part {
    Part(const Hierarchy& hierarchy, std::span<Link> links);

    std::span<const Link> links;
    LinkSchedule schedule;
    std::vector<std::size_t> round_sizes;
    std::vector<std::size_t> of_clusters;  // the places of links with an end on a cluster, ascending; few, so the others go in runs
    std::vector<double> scale;             // D, at the leaves
  };
  // Adds to y the light carried by a part.
  void apply(std::size_t part, const std::vector<double>& x, std::vector<double>& y);
  [[nodiscard]] std::vector<double> row_sums(std::size_t part);
  // Scales the links of this part and all later ones to these row sums times areas, as far as the limits allow.
  void scale_parts(std::size_t first, const std::vector<double>& power, const Balance& goal);
  // Scales the links of a part to these row sums, as far as the limits allow.
  void scale(std::size_t part, const std::vector<double>& rows, const ScaleLimits& limits);
  // The area-weighted RMS deviation of the row sums of closed leaves from 1, without leaves that see nothing.
  [[nodiscard]] double row_sum_deviation(const std::vector<double>& rows) const;

  const Hierarchy* hierarchy_;
  const Exposure* exposure_;
  unsigned threads_;
  std::vector<double> area_;                 // by node, see area()
  std::vector<bool> closed_;                 // by node; empty: all
  std::vector<bool> lamps_;                  // by node; empty if lamps do not form a part of their own, which is then the first
  std::vector<std::uint32_t> lamp_cluster_;  // by node: the largest cluster of lamps that contains it, or no_node; may be empty
  std::vector<Part> parts_;
  std::size_t sampled_ = 0;  // number of parts from sampled links
  std::size_t above_ = 0;    // number of clusters and input faces, if there are clusters
  std::size_t clusters_ = 0;
  std::vector<Moments> sent_, arrived_;           // scratch memory of apply(), which is called many times
  std::vector<double> sent_bins_, arrived_bins_;  // by cluster and direction
};

}  // namespace radiosity

#ifdef HALFLIGHT_HEADER_ONLY
#include <radiosity/solver/carry.cpp>
#include <radiosity/solver/transport.cpp>
#include <radiosity/solver/transport_scales.cpp>
#endif
