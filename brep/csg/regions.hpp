// SPDX-License-Identifier: MIT
#pragma once

// Which boundary cycles in a plane belong to one region? A connected drawing inside a face has at most one cycle that looks at it from
// outside, as a hole of the region around it. From the extreme point of the drawing a ray runs outwards; the first edge that it meets
// bounds the same region.
//
// The ray starts at the point of largest u (then largest v) and runs along u, an infinitesimal above the point's v, so it never runs
// through a point. Everything is decided by compare() and side().

#include <cstdint>
#include <optional>
#include <vector>

#include <brep/csg/boundary.hpp>
#include <brep/csg/directions.hpp>
#include <brep/csg/plane.hpp>
#include <brep/csg/predicates.hpp>
#include <brep/csg/work.hpp>
#include <brep/edge_uses.hpp>

namespace brep::csg::detail {

class Regions {
 public:
  explicit Regions(Work& work) : work_(work) {}

  // Numbers the cycles of a face from its half-edges, whose `face` it uses: afterwards that is the number of the cycle. Returns which
  // cycles are one region, or nothing when the face is not bounded as a face must be.
  [[nodiscard]] std::optional<brep::detail::UnionFind> run(const WorkFace& face, const std::vector<std::uint32_t>& halves);

 private:
  [[nodiscard]] bool beyond(const Point& a, const Point& b, const Projection& on) const {
    const int order = work_.predicates.compare(a, b, on.u);
    return order != 0 ? order > 0 : work_.predicates.compare(a, b, on.v) > 0;
  }

  // The cycle in whose corner at the extreme point the ray starts; invalid_index: the drawing's outside is not part of the face. All edges
  // there leave to the left, so the corner is after the last of them counter-clockwise.
  [[nodiscard]] std::uint32_t cycle_around(const Plane& plane, const Projection& on, const std::vector<std::uint32_t>& halves,
                                           std::uint32_t point) const;

  [[nodiscard]] std::uint32_t first_met(const WorkFace& face, const Projection& on, const std::vector<std::uint32_t>& halves,
                                        brep::detail::UnionFind& drawings, std::uint32_t drawing, const Point& from) const;
  // Both run upwards past the ray.
  [[nodiscard]] bool nearer(const WorkFace& face, const Projection& on, std::uint32_t a, std::uint32_t b) const;
  // +1: the point of the plane lies left of the half-edge.
  [[nodiscard]] int side_of(const WorkFace& face, std::uint32_t h, const Point& point) const;

  Work& work_;
  std::vector<std::uint32_t> first_at_;
};

}  // namespace brep::csg::detail

#ifdef HALFLIGHT_HEADER_ONLY
#include <brep/csg/regions.cpp>
#endif
